#!/usr/bin/python3
"""Meshes every case with every mesher, each in a process of its own, and keeps the figures.

The same adapted surface goes to TetGen, Netgen and Gmsh; CGAL gets the label image. What a mesher cannot do, or does not
do in time, is a row with a word about it. Where voxtet was not built as WebAssembly, its row says so. Use run, which
builds what is needed first.
"""
import argparse
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests" / "sweep"))
import runs  # noqa: E402

PROGRAMS = ROOT / "build/native/peers"
WORK = ROOT / "build/peers"
RESULTS = ROOT / "examples/mesher-benchmark/results.json"
EDGE_VOXELS, DISTANCE_VOXELS = 2, 0.5
VOLUMES = {"biv_mean_1mm": [1, 2], "biv_ed_scar_1mm": [1, 2, 5, 6], "biv_es_oblique_sax": [1, 2],
           "ct_aorta_dissection_1.5mm": [1, 2]}
# Name, program, variant, whether sizes are scaled to a like number of tetrahedra, whether it takes several labels.
FILLERS = [("tetgen_paper", "peer_tetgen", "paper", False, True), ("tetgen_angles", "peer_tetgen", "angles", False, True),
           ("netgen", "peer_netgen", "default", False, False), ("gmsh_delaunay", "peer_gmsh", "delaunay", True, True),
           ("gmsh_hxt", "peer_gmsh", "hxt", True, True)]
KEPT_METRICS = {"min_dihedral_deg": ("min", "p01", "p1", "mean", "histogram"), "max_dihedral_deg": ("max",), "radius_ratio": ("mean",)}


def why_failed(done):
    lines = [line for line in done["err"].splitlines() if line.strip()]
    if done["code"] == "timeout":
        return "not finished within the time limit"
    if isinstance(done["code"], int) and done["code"] < 0:
        return f"ended by {signal.Signals(-done['code']).name}"
    return lines[-1][:300] if lines else f"exit code {done['code']}, no message"


def measured(surface, mesh, options):
    done = runs.run([PROGRAMS / "measure_peer", surface, mesh], options.time_limit)
    if done["code"] != 0:
        return {"error": "not measured: " + why_failed(done)}
    found = json.loads(done["out"])
    metrics = {m["name"]: m for m in found["metrics"]}
    shapes = {name: {key: metrics[name][key] for key in keys} for name, keys in KEPT_METRICS.items()}
    row = {"tets": found["tets"], "shapes": shapes, "sizes": found["sizes"], "volumes_mm3": found["volumes_mm3"]}
    broken = [f"{c['name']}: {c['found']}" for c in found["checklist"] if c["hard"] and not c["passed"]]
    return row | ({"error": "; ".join(broken)} if broken else {})


def peer(command, out, surface, options):
    """The figures of a peer program; of several runs, which give the same mesh, the fastest one's time."""
    row = {}

    def whole(figures):
        return figures["seconds"] + figures.get("surface_seconds", 0)

    for _ in range(options.runs):
        for old in (out.with_suffix(".json"), out.with_suffix(".vtu")):
            old.unlink(missing_ok=True)
        done = runs.run(command, options.time_limit)
        if done["code"] != 0 or not out.with_suffix(".json").exists():
            return {"error": why_failed(done)}
        again = json.loads(out.with_suffix(".json").read_text())
        row = again if not row or whole(again) < whole(row) else row
    if out.with_suffix(".vtu").exists():
        row = measured(surface, out.with_suffix(".vtu"), options) | row
    return row


def processor_share(command, timeout):
    """Runs a program; output, exit code, and the share of the time that a processor worked for its first thread.

    Node compiles in other threads while the first one works: that is not the mesher's time."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        start = time.monotonic()
        process = subprocess.Popen([str(c) for c in command], stdout=out, stderr=err)
        stat, seen = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/stat"), (0, 1)
        while process.poll() is None and time.monotonic() - start < timeout:
            fields = stat.read_text().rpartition(")")[2].split()
            ticks = int(fields[11]) + int(fields[12])
            if ticks:
                seen = ticks / os.sysconf("SC_CLK_TCK"), time.monotonic() - start
            time.sleep(0.02)
        code = process.returncode
        if code is None:
            process.kill()
            process.wait()
            code = "timeout"
        out.seek(0), err.seek(0)
        return {"out": out.read().decode(), "err": err.read().decode(), "code": code}, seen[0] / seen[1]


def wasm(case_file, native, options):
    """voxtet under node. Its stages know wall time only: times the share of a processor that it had."""
    engine = pathlib.Path(runs.ENGINES["wasm"][1])
    if not engine.exists():
        return {"error": "skipped: not built (scripts/build wasm)"}
    best = {}
    for _ in range(options.runs):
        done, share = processor_share([*runs.ENGINES["wasm"], "mesh", case_file, "--json", "--threads", "1"], options.time_limit)
        if done["code"] not in (0, 4):
            return {"error": why_failed(done)}
        report = json.loads(done["out"])
        stages = {s["name"]: s for s in report["stages"]}
        if "optimise" not in stages:
            return {"error": report["error"]["message"]}
        surface = share * sum(stages[name]["seconds"] for name in ("volume", "surface", "smooth", "sizing", "remesh"))
        fill = share * (stages["tetra"]["seconds"] + stages["optimise"]["seconds"])
        if not best or surface + fill < best["surface_seconds"] + best["seconds"]:
            best = {"seconds": fill, "surface_seconds": surface, "digest": report["digest"],
                    "peak_mb": max(s["peak_mb"] for s in stages.values())}
    if best["digest"] != native.get("digest"):
        return best | {"error": "its mesh differs from the native one"}
    shared = ("tets", "shapes", "sizes", "volumes_mm3")  # the same bytes, hence measured once
    return best | {key: native[key] for key in shared}


def compare(name, labels, merged, options):
    """All rows of a case."""
    volume = next(p for p in runs.DATA.iterdir() if p.name.startswith(name + ".") and p.name.endswith(runs.SUFFIXES))
    voxels, affine = runs.read_labels(volume)
    spacing = float(np.linalg.norm(affine[:3, :3], axis=0).min())
    folder = WORK / f"{name}-{'merged' if merged else 'conforming'}"
    folder.mkdir(parents=True, exist_ok=True)
    case = {"source": {"file": {"name": str(volume.resolve())}}, "labels": labels, "merge": [labels] if merged else [],
            "sizing": {"edge_mm": EDGE_VOXELS * spacing}}
    case_file = folder / "case.json"
    case_file.write_text(json.dumps(case))
    surface, volume_file = folder / "voxtet.surface", folder / "voxtet.nii"
    for old in (surface, volume_file):
        old.unlink(missing_ok=True)

    rows = []

    def add(mesher, row):
        rows.append({"mesher": mesher} | row)
        print(f"{folder.name:38} {mesher:14} {row.get('tets', ''):>8} {row.get('shapes', {}).get('min_dihedral_deg', {}).get('min', 0):6.2f} "
              f"{row.get('seconds', 0):8.2f} s  {row.get('error', '')}", flush=True)

    ours = peer([PROGRAMS / "peer_voxtet", case_file, folder / "voxtet"], folder / "voxtet", surface, options)
    add("voxtet", ours)
    add("voxtet_wasm", wasm(case_file, ours, options))
    for mesher, program, variant, scaled, takes_labels in FILLERS:
        if not surface.exists():
            add(mesher, {"error": "no surface to start from"})
        elif not (merged or takes_labels):
            add(mesher, {"error": "takes one region only"})
        else:
            tets = ours.get("tets", 0) if scaled else 0
            add(mesher, peer([PROGRAMS / program, surface, folder / mesher, variant, tets], folder / mesher, surface, options))
    add("cgal", peer([PROGRAMS / "peer_cgal", volume_file, folder / "cgal", EDGE_VOXELS * spacing,
                      DISTANCE_VOXELS * spacing, ours.get("tets", 100000)], folder / "cgal", surface, options))
    return {"volume": name, "labels": labels, "merged": merged, "edge_mm": EDGE_VOXELS * spacing, "rows": rows,
            "voxel_mm3": float(np.isin(voxels, labels).sum() * abs(np.linalg.det(affine[:3, :3])))}


def versions():
    def debian(package):
        done = subprocess.run(["dpkg-query", "-W", "-f=${source:Upstream-Version}", package], capture_output=True, text=True)
        return done.stdout.split("+really")[-1].split("+")[0]
    return {"netgen": debian("libnglib-dev"), "gmsh": debian("libgmsh-dev"), "cgal": debian("libcgal-dev"), "tetgen": "1.5.0"}


def processor():
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    return next((line.partition(": ")[2] for line in lines if line.startswith("model name")), "an unknown processor")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="", help="cases whose name holds this, as biv_mean_1mm-merged; the others keep their figures")
    parser.add_argument("--runs", type=int, default=3, help="the fastest of so many counts")
    parser.add_argument("--time-limit", type=float, default=600, help="seconds a mesher may take, calibration included")
    options = parser.parse_args()
    if not runs.DATA.is_dir():
        print(f"no volumes in {runs.DATA}: set VOXTET_DATA")
        return 77
    old = json.loads(RESULTS.read_text())["cases"] if RESULTS.exists() else []
    known = {(c["volume"], c["merged"]): c for c in old}
    for merged in (True, False):
        for name, labels in VOLUMES.items():
            if options.only not in f"{name}-{'merged' if merged else 'conforming'}":
                continue
            known[name, merged] = compare(name, labels, merged, options)
            ordered = [known[v, m] for m in (True, False) for v in VOLUMES if (v, m) in known]
            RESULTS.parent.mkdir(exist_ok=True)
            results = {"versions": versions(), "processor": processor(), "runs": options.runs, "cases": ordered}
            RESULTS.write_text(json.dumps(results) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
