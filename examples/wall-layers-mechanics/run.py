#!/usr/bin/env python3
"""One beat of a heart with so many layers through its walls, by element and by fibres: a line of the table each.

    run.py VOXTET [--layers 1 2] [--elements p1_anp p2] [--fibres one four] [--case CASE]

Each run's report is kept in a folder, and a run whose report is there is not made again.
"""
import argparse
import json
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("voxtet")
    parser.add_argument("--layers", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--elements", nargs="+", default=["p1", "p1_anp", "p1_stabilised", "p2"])
    parser.add_argument("--fibres", nargs="+", choices=["one", "four"], default=["one", "four"])
    parser.add_argument("--case", type=pathlib.Path, default=HERE / "heart.json")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("wall-layers-mechanics"))
    return parser.parse_args()


def report_of(options, layers, element, fibres):
    """The report of a run; with a key `error` where it failed."""
    path = options.out / f"{layers}_{element}_{fibres}.json"
    if not path.exists():
        fine = "true" if fibres == "four" else "false"
        settings = [
            f"sizing.thickness[0].layers={layers}",
            f"physics.mechanics.element={element}",
            f"physics.mechanics.fine_fibres={fine}",
        ]
        command = [options.voxtet, "simulate", options.case, "--report", path]
        for setting in settings:
            command += ["--set", setting]
        subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    return json.loads(path.read_text())


def line(layers, element, fibres, report):
    seconds = {stage["name"]: stage["seconds"] for stage in report["stages"]}
    tets = next(stage["counts"]["tets"] for stage in report["stages"] if stage["name"] == "optimise")
    meshing = sum(seconds[name] for name in seconds if name not in ("anatomy", "fibres", "mechanics"))
    if "error" in report:
        return f"| {layers} | {element} | {fibres} | {tets} | {meshing:.0f} | failed: {report['error']['message']} |"
    beat = report["simulation"]["mechanics"]["beats"][-1]
    lv, rv = (100 * beat[name]["ejection_fraction"] for name in ("lv", "rv"))
    return f"| {layers} | {element} | {fibres} | {tets} | {meshing:.0f} | {seconds['mechanics']:.0f} | {lv:.1f} | {rv:.1f} |"


def main():
    options = arguments()
    options.out.mkdir(parents=True, exist_ok=True)
    print("| layers | element | fibres | tetrahedra | meshing, s | beat, s | LV EF, % | RV EF, % |")
    print("|---|---|---|---|---|---|---|---|")
    for layers in options.layers:
        for element in options.elements:
            for fibres in options.fibres:
                print(line(layers, element, fibres, report_of(options, layers, element, fibres)), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
