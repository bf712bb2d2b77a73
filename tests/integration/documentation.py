#!/usr/bin/python3
"""What the documentation says of the command line, held against the command line.

  documentation.py VOXTET

1. docs/help.txt is what the commands say of themselves; scripts/update_contract writes it.
2. Every line "voxtet ..." in a block of code of a page runs, those of a page one after another in an empty folder that
   has the examples. Exit 0 if all do, 1 if not.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
BLOCK = re.compile(r"^```\w*\n(.*?)^```$", re.M | re.S)


def commands_of(page):
    lines = [line for block in BLOCK.findall(page) for line in block.splitlines()]
    return [line for line in lines if line.startswith("voxtet ")]


def help_faults(voxtet):
    said = subprocess.run([ROOT / "scripts/print_help", voxtet], capture_output=True, text=True, check=True).stdout
    same = said == (DOCS / "help.txt").read_text()
    return [] if same else ["docs/help.txt is not what `voxtet --help` says: run scripts/update_contract"]


def command_faults(voxtet, page):
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        (place / "bin").mkdir()
        (place / "bin/voxtet").symlink_to(voxtet)
        (place / "work").mkdir()
        (place / "work/examples").symlink_to(ROOT / "examples")
        environment = {**os.environ, "PATH": f"{place / 'bin'}:{os.environ['PATH']}"}
        for command in commands_of(page.read_text()):
            run = subprocess.run(command, shell=True, cwd=place / "work", env=environment, capture_output=True)
            if run.returncode != 0:
                yield f"{page.relative_to(ROOT)}: {command}: exit code {run.returncode}\n{run.stderr.decode()[-500:]}"


def main(voxtet):
    faults = help_faults(voxtet)
    pages = [page for page in sorted(DOCS.rglob("*.md")) if "node_modules" not in page.parts]
    count = sum(len(commands_of(page.read_text())) for page in pages)
    for page in pages:
        faults += command_faults(voxtet, page)
    if count < 20:
        faults.append(f"only {count} commands were found in {len(pages)} pages")
    print("\n".join(faults) or f"{count} commands of {len(pages)} pages run")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(str(pathlib.Path(sys.argv[1]).resolve())))
