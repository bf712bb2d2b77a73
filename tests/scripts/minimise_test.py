"""scripts/minimise: what it ends with, and that it refuses what does not fail."""
import importlib.machinery
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "minimise"


def load(path):
    loader = importlib.machinery.SourceFileLoader(path.name, str(path))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(path.name, loader))
    loader.exec_module(module)
    return module


sys.dont_write_bytecode = True  # beside the scripts
minimiser = load(SCRIPT)


def ball_of_labels(size=24):
    """A ball of label 1 with a few voxels of 5 and 7 that touch, off its middle."""
    x = numpy.indices((size,) * 3) - size / 2
    labels = ((x**2).sum(axis=0) < (size / 2.5) ** 2).astype(numpy.uint16)
    labels[7:10, 8:11, 9:12] = 5
    labels[10:13, 8:11, 9:12] = 7
    return minimiser.Volume(labels, numpy.diag([2.0, 2, 2, 1]))


def have_contact(volume):
    before, after = volume.labels[:-1], volume.labels[1:]
    return bool(((before == 5) & (after == 7)).any())


class Minimise(unittest.TestCase):
    def test_keeps_the_two_voxels_that_matter(self):
        small = minimiser.minimise(ball_of_labels(), have_contact)
        self.assertEqual(small.labels.tolist(), [[[5]], [[7]]])

    def test_keeps_voxels_where_they_were(self):
        volume = ball_of_labels()
        small = minimiser.minimise(volume, have_contact)
        at = numpy.linalg.solve(volume.affine, small.affine @ [0, 0, 0, 1])[:3].astype(int)
        self.assertEqual(volume.labels[tuple(at)], 5)

    def test_merges_labels_that_do_not_matter(self):
        small = minimiser.minimise(ball_of_labels(), lambda volume: numpy.count_nonzero(volume.labels) >= 4)
        self.assertEqual(numpy.count_nonzero(small.labels), 4)
        self.assertEqual(small.values(), [1])

    def test_runs_a_command_on_files(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "ball.nii.gz"
            minimiser.write(ball_of_labels(6), path)
            run = [sys.executable, SCRIPT, path, "--"]
            done = subprocess.run([*run, "sh", "-c", "test -s {} && exit 3"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("exit code 3", done.stdout)
            self.assertEqual(minimiser.read(path.with_name("ball.small.nii.gz")).labels.size, 1)
            fine = subprocess.run([*run, "test", "-s", "{}"], capture_output=True, text=True)
            self.assertNotEqual(fine.returncode, 0)
            self.assertIn("does not fail", fine.stderr)
            no_file = subprocess.run([*run, "false"], capture_output=True, text=True)
            self.assertEqual(no_file.returncode, 2)


if __name__ == "__main__":
    unittest.main()
