#!/usr/bin/python3
"""The tables of the mesher benchmark, and that its page stands for its results.json."""
import json
import unittest

import draw


def row(mesher, **more):
    shapes = {"min_dihedral_deg": {"min": 10.04, "p01": 20, "p1": 30, "mean": 40}, "max_dihedral_deg": {"max": 150},
              "radius_ratio": {"mean": 0.8}}
    return {"mesher": mesher, "tets": 1000, "shapes": shapes, "sizes": {"median": 0, "p95_absolute": 0.5}, "seconds": 1,
            "peak_mb": 10, "volumes_mm3": {"1": 99}} | more


def case(*rows):
    return {"volume": "heart", "labels": [1], "merged": True, "edge_mm": 2, "voxel_mm3": 100, "rows": list(rows)}


NAMES = draw.MESHERS
OURS = row("voxtet", surface_seconds=3)


def line_of(table, name):
    return next(line for line in table.splitlines() if NAMES[name][0] in line)


class Tables(unittest.TestCase):
    def test_who_fills_our_surface_waits_for_it(self):
        self.assertEqual(draw.whole_seconds(row("gmsh_hxt"), OURS), 4)
        self.assertEqual(draw.whole_seconds(row("cgal"), OURS), 1)

    def test_ranges_collapse_where_they_look_the_same(self):
        self.assertEqual(draw.span([10.04, 9.96], ".1f"), "10.0")
        self.assertEqual(draw.span([12, 10], ".1f"), "10.0–12.0")
        self.assertEqual(draw.span([], ".1f"), "–")

    def test_relative_times_are_geometric_means_over_cases(self):
        cases = [case(OURS, row("gmsh_hxt", seconds=0.5)), case(OURS, row("gmsh_hxt", seconds=8))]
        self.assertIn("| 2.00 |", line_of(draw.summary(cases, NAMES), "gmsh_hxt"))

    def test_failures_are_rows_and_are_told(self):
        failed = case(OURS, {"mesher": "netgen", "error": "ended by SIGSEGV"})
        self.assertIn("| – |", line_of(draw.case_table(failed, NAMES), "netgen"))
        self.assertIn("| 1 of 1 |", line_of(draw.summary([failed], NAMES), "netgen"))
        self.assertIn("ended by SIGSEGV", draw.failures([failed], NAMES))

    def test_without_our_mesh_there_is_no_relative_time(self):
        alone = case({"mesher": "voxtet", "error": "no"}, row("cgal"))
        self.assertTrue(line_of(draw.case_table(alone, NAMES), "cgal").endswith("| – |"))

    def test_the_page_stands_for_the_results(self):
        results = json.loads((draw.FOLDER / "results.json").read_text())
        self.assertEqual(draw.page(results), (draw.FOLDER / "README.md").read_text())


if __name__ == "__main__":
    unittest.main()
