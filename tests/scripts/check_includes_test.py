"""scripts/check_includes: green on a copy of core/ and wasm/, red once a violation is planted in it."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


class CheckIncludes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for part in ("core", "wasm", "scripts"):
            shutil.copytree(ROOT / part, self.root / part)

    def plant(self, place, text):
        path = self.root / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def check(self):
        done = subprocess.run([sys.executable, self.root / "scripts/check_includes"], capture_output=True, text=True)
        return done.returncode, done.stdout

    def expect_fault(self, *words):
        status, output = self.check()
        self.assertEqual(status, 1, output)
        faults = output.splitlines()
        self.assertEqual(len(faults), 1, output)
        for word in words:
            self.assertIn(word, faults[0])

    def test_holds_as_it_is(self):
        self.assertEqual(self.check(), (0, "include rules hold\n"))

    def test_an_arrow_upward_between_rooms(self):
        self.plant("core/remesh/field/planted.h", '#include "remesh/adapt/adapt_complex.h"\n')
        self.expect_fault("core/remesh/field/planted.h:1", "remesh/adapt/adapt_complex.h")

    def test_an_arrow_upward_between_folders(self):
        self.plant("core/base/planted.h", '#pragma once\n#include "geometry/search/closest_point.h"\n')
        self.expect_fault("core/base/planted.h:2", "geometry/search/closest_point.h", "types")

    def test_a_stage_that_sees_another(self):
        self.plant("core/tetra/fill/planted.cpp", '#include "remesh/remesh_surface.h"\n')
        self.expect_fault("core/tetra/fill/planted.cpp:1", "remesh/remesh_surface.h")

    def test_a_header_that_is_for_its_folder_alone(self):
        self.plant("core/pipeline/planted.h", '#include "remesh/field/label_field.h"\n')
        self.expect_fault("core/pipeline/planted.h:1", "remesh/remesh_surface.h")

    def test_a_third_party_header_outside_its_adapter(self):
        self.plant("core/base/planted.h", "#include <CGAL/Kernel.h>\n")
        self.expect_fault("core/base/planted.h:1", "geometry, remesh, tetra")

    def test_a_room_without_a_rule(self):
        self.plant("core/remesh/attic/planted.h", "#pragma once\n")
        self.expect_fault("core/remesh/attic/planted.h", "remesh/attic")

    def test_a_folder_without_a_rule(self):
        self.plant("core/attic/planted.h", "#pragma once\n")
        self.expect_fault("core/attic/planted.h", "attic")

    def test_a_full_folder(self):
        for number in range(21):
            self.plant(f"core/remesh/motion/planted_{number}.h", "#pragma once\n")
        self.expect_fault("core/remesh/motion", "at most 20")

    def test_rules_in_a_circle(self):
        script = self.root / "scripts/check_includes"
        script.write_text(script.read_text().replace('"field": set(),', '"field": {"delaunay"},'))
        self.expect_fault("cells, delaunay, field", "circle")


if __name__ == "__main__":
    unittest.main()
