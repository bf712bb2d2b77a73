#!/usr/bin/python3
"""Writes the page and the plots of examples/mesher-benchmark from its results.json: no number there is typed by hand."""
import json
import math
import pathlib

import plots

FOLDER = pathlib.Path(__file__).resolve().parents[3] / "examples/mesher-benchmark"
# Name, local sizing, licence; {version} where the packages say it.
MESHERS = {
    "voxtet": ("voxtet, native", "sizing field", "AGPL-3.0"),
    "voxtet_wasm": ("voxtet, WebAssembly (node)", "sizing field", "AGPL-3.0, in a browser"),
    "tetgen_paper": ("TetGen {tetgen} `pYAq1.414`", "sizes at points", "AGPL-3.0"),
    "tetgen_angles": ("TetGen {tetgen} `pYAq1.414/14o/145`", "sizes at points", "AGPL-3.0"),
    "netgen": ("Netgen {netgen}", "from the surface", "LGPL-2.1"),
    "gmsh_delaunay": ("Gmsh {gmsh} Delaunay", "size callback", "GPL-2.0"),
    "gmsh_hxt": ("Gmsh {gmsh} HXT", "size callback", "GPL-2.0"),
    "cgal": ("CGAL {cgal} Mesh_3, perturb and exude", "sizing field", "GPL-3.0"),
}


def span(values, form):
    """The range of some values: "12.0–13.8", one number where they look the same, a dash without any."""
    texts = [format(v, form) for v in sorted(values)]
    if not texts:
        return "–"
    return texts[0] if texts[0] == texts[-1] else f"{texts[0]}–{texts[-1]}"


def geometric_mean(values):
    return math.exp(sum(map(math.log, values)) / len(values)) if values else None


def whole_seconds(row, ours):
    """From the volume to the mesh: who starts from our surface waits for it as well."""
    if row["mesher"] == "cgal":
        return row["seconds"]
    return row["seconds"] + row.get("surface_seconds", ours.get("surface_seconds", 0))


def volume_error(row, case):
    return 100 * (sum(row["volumes_mm3"].values()) / case["voxel_mm3"] - 1)


def rows_of(cases, mesher):
    """(row, ours) of each case in which the mesher gave a mesh."""
    for case in cases:
        ours = next(r for r in case["rows"] if r["mesher"] == "voxtet")
        for row in case["rows"]:
            if row["mesher"] == mesher and "tets" in row:
                yield row, ours


def dihedral(row):
    return row["shapes"]["min_dihedral_deg"]


def times(value):
    return "–" if value is None else f"{value:.2f}"


def signed(value):
    return f"{round(value, 2) + 0.0:+.2f}"  # -0 as 0


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def summary(cases, names):
    """The paper's Table 1: every mesher over all these cases."""
    header = ["mesher", "local sizing", "availability", "smallest dihedral °", "0.1 % °", "1 % °", "largest dihedral °",
              "fill, 1000 tets/s", "volume to mesh, 1000 tets/s", "fill, relative time", "volume to mesh, relative time", "failed"]
    rows = []
    for mesher, (name, sizing, licence) in names.items():
        found = list(rows_of(cases, mesher))
        with_ours = [(row, ours) for row, ours in found if "tets" in ours]
        fills = mesher != "cgal"
        fill = geometric_mean([r["seconds"] / o["seconds"] for r, o in with_ours if fills])
        failed = sum("error" in r for case in cases for r in case["rows"] if r["mesher"] == mesher)
        rows.append([name, sizing, licence] + [span([dihedral(r)[key] for r, _ in found], ".1f") for key in ("min", "p01", "p1")]
                    + [span([r["shapes"]["max_dihedral_deg"]["max"] for r, _ in found], ".0f"),
                       span([r["tets"] / r["seconds"] / 1000 for r, _ in found if fills], ".0f"),
                       span([r["tets"] / whole_seconds(r, o) / 1000 for r, o in found], ".0f"), times(fill),
                       times(geometric_mean([whole_seconds(r, o) / whole_seconds(o, o) for r, o in with_ours])),
                       f"{failed} of {len(cases)}"])
    return table(header, rows)


def case_table(case, names):
    header = ["mesher", "tetrahedra", "smallest °", "0.1 % °", "1 % °", "mean °", "largest °", "radius ratio, mean",
              "log2(l/h), median", "its 95 %", "volume error %", "fill s", "volume to mesh s", "volume to mesh, tets/s", "peak MB", "relative time"]
    ours = next(r for r in case["rows"] if r["mesher"] == "voxtet")
    rows = []
    for row in case["rows"]:
        name = names[row["mesher"]][0]
        if "tets" not in row:
            rows.append([name] + ["–"] * (len(header) - 1))
            continue
        whole = whole_seconds(row, ours)
        rows.append([name + (" ⚠" if "error" in row else ""), f"{row['tets']:,}"]
                    + [f"{dihedral(row)[key]:.1f}" for key in ("min", "p01", "p1", "mean")]
                    + [f"{row['shapes']['max_dihedral_deg']['max']:.1f}", f"{row['shapes']['radius_ratio']['mean']:.3f}",
                       signed(row["sizes"]["median"]), f"{row['sizes']['p95_absolute']:.2f}",
                       signed(volume_error(row, case)), "–" if row["mesher"] == "cgal" else f"{row['seconds']:.2f}",
                       f"{whole:.2f}", f"{row['tets'] / whole:,.0f}",
                       f"{row['peak_mb']:.0f}", times(whole / whole_seconds(ours, ours) if "tets" in ours else None)])
    return table(header, rows)


def title_of(case):
    labels = ", ".join(map(str, case["labels"]))
    return f"{case['volume']}, labels {labels}, {'merged' if case['merged'] else 'conforming'}"


def surface_of(case):
    found = [f", a surface of {row['triangles']:,} triangles" for row in case["rows"] if "triangles" in row]
    return "".join(found[:1])


def failures(cases, names):
    lines = [f"- {title_of(case)}: {names[row['mesher']][0]}: {row['error']}" for case in cases for row in case["rows"] if "error" in row]
    return "\n".join(lines) or "None."


def warnings(cases):
    """What voxtet said of its own meshes: another method of the surface, say, which takes longer."""
    lines = [f"- {title_of(case)}: {words}" for case in cases for row in case["rows"] for words in row.get("warnings", [])]
    return "\n".join(lines) or "Nothing."


def page(results):
    names = {key: (name.format(**results["versions"]), *rest) for key, (name, *rest) in MESHERS.items()}
    cases = results["cases"]
    text = (pathlib.Path(__file__).parent / "page.md").read_text()
    parts = {"processor": results["processor"], "runs": str(results["runs"]), "failures": failures(cases, names),
             "warnings": warnings(cases), "remark": results.get("remark", "")}
    for kind, merged in (("merged", True), ("conforming", False)):
        chosen = [c for c in cases if c["merged"] == merged]
        parts["summary_" + kind] = summary(chosen, names)
        parts["cases_" + kind] = "\n\n".join(
            f"### {title_of(c)}\n\nEdge {c['edge_mm']:.2f} mm{surface_of(c)}.\n\n{case_table(c, names)}" for c in chosen)
    for key, value in parts.items():
        text = text.replace("{{" + key + "}}", value)
    return text


def main():
    results = json.loads((FOLDER / "results.json").read_text())
    names = {key: name.format(**results["versions"]).replace("`", "") for key, (name, *_) in MESHERS.items()}
    (FOLDER / "README.md").write_text(page(results))
    for kind, merged in (("merged", True), ("conforming", False)):
        cases = [c for c in results["cases"] if c["merged"] == merged]
        (FOLDER / f"dihedral-{kind}.svg").write_text(plots.distributions(cases, names))
        points = [(mesher, row["tets"] / whole_seconds(row, ours), dihedral(row)["min"])
                  for mesher in names for row, ours in rows_of(cases, mesher)]
        (FOLDER / f"speed-{kind}.svg").write_text(plots.speed(points, names))


if __name__ == "__main__":
    main()
