"""What the sweeps around the command line share: runs with their time and memory, volumes, the independent check."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading

import nibabel
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = pathlib.Path(os.environ.get("VOXTET_DATA", ROOT / ".." / "shared" / "data"))
CHECK = pathlib.Path(os.environ.get("VOXTET_CHECK_MESH", DATA / ".." / "tools" / "check_mesh.py"))
ENGINES = {"native": [str(ROOT / "build/native/voxtet")], "wasm": ["node", str(ROOT / "build/wasm/voxtet.mjs")]}
SUFFIXES = (".nii", ".nii.gz", ".nrrd", ".mha", ".mhd")


def add_options(parser):
    parser.add_argument("--engine", default="native", help="native, wasm, or the path of a command line")
    parser.add_argument("--method", help="remesh.method of the recipe")
    parser.add_argument("--timeout", type=float, default=1800, help="seconds a command may take")
    parser.add_argument("--json", help="write all figures to this file")


def add_check(parser):
    parser.add_argument("--check", type=pathlib.Path, default=CHECK, help="check_mesh.py; default: $VOXTET_CHECK_MESH, or ../tools beside the data")


def method(options):
    """Arguments of the command line for the method that was asked for."""
    return ["--set", f"remesh.method={options.method}"] if options.method else []


def engine(options):
    return ENGINES.get(options.engine, [options.engine])


def run(command, timeout):
    """Exit code ('timeout' when it had to be stopped), output, error text, processor seconds, peak memory (MB)."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        process = subprocess.Popen([str(c) for c in command], stdout=out, stderr=err)
        stopped = threading.Event()
        timer = threading.Timer(timeout, lambda: (stopped.set(), os.kill(process.pid, signal.SIGKILL)))
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0), err.seek(0)
        return {"code": "timeout" if stopped.is_set() else process.returncode,
                "out": out.read().decode(errors="replace"), "err": err.read().decode(errors="replace"),
                "seconds": usage.ru_utime + usage.ru_stime, "mb": usage.ru_maxrss / 1024}


def as_nifti(path, folder, options):
    """The volume as a file that nibabel reads, by the command line's own reader where it is none."""
    if path.name.endswith((".nii", ".nii.gz")):
        return path
    copy = pathlib.Path(folder) / (path.name + ".nii.gz")
    done = run([*engine(options), "convert", path, copy], options.timeout)
    if done["code"] != 0:
        raise RuntimeError(f"convert {path.name}: {done['err']}")
    return copy


def read_labels(path):
    image = nibabel.load(path)
    return np.rint(np.asarray(image.dataobj)).astype(np.int64), image.affine


def mesh(volume, mesh_file, edge_mm, options, arguments=()):
    """Meshes a volume by the command line. `report` is its JSON, {} without one; `failures` what went wrong."""
    report_file = pathlib.Path(str(mesh_file) + ".json")
    done = run([*engine(options), "mesh", volume, "--edge-mm", f"{edge_mm:.6g}", "-o", mesh_file,
                "--report", report_file, *method(options), *arguments], options.timeout)
    done["report"] = json.loads(report_file.read_text()) if report_file.exists() else {}
    lines = [line for line in done["err"].splitlines() if line.strip()]
    done["failures"] = [] if done["code"] == 0 else [f"exit code {done['code']}: {lines[-1][:300] if lines else ''}"]
    return done


def check(mesh_file, volume, options, labels=None):
    """The independent check's findings, of the mesh alone where `volume` is None; `failures` is its list, with a
    word where it did not come to an end."""
    beside = ["--volume", volume] if volume else []
    wanted = ["--labels", ",".join(map(str, labels))] if labels else []
    done = run([sys.executable, options.check, mesh_file, *beside, *wanted], options.timeout)
    try:
        found = json.loads(done["out"])
    except ValueError:
        lines = done["err"].splitlines()
        found = {"error": f"exit code {done['code']}, {lines[-1][:200] if lines else 'no output'}"}
    if "error" in found:
        found["failures"] = ["check_mesh: " + found["error"]]
    return found


def finish(rows, failures, options, title):
    """Prints what failed, writes the JSON file, gives the exit code. No row is a failure: nothing was measured."""
    failures = failures if rows or failures else ["no case has such a name"]
    if options.json:
        pathlib.Path(options.json).write_text(json.dumps({"title": title, "rows": rows, "failures": failures}, indent=1) + "\n")
    print(f"\n{len(failures)} failures" + "".join("\n- " + text for text in failures))
    return 1 if failures else 0
