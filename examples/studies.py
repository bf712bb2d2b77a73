"""What the pages of studies share: `voxtet study` run on a study.json, and its table."""
import csv
import json
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[1]


def run_study(name, *options):
    """Runs examples/NAME/study.json into build/studies/NAME, where what is done is not done again. The folder, and the rows of
    the table with seconds, peak_mb and forecasts. Needs build/native/voxtet (scripts/build native)."""
    out = ROOT / "build/studies" / name
    subprocess.run([ROOT / "build/native/voxtet", "study", ROOT / "examples" / name / "study.json", "-o", out, *options], check=True)
    rows = [json.loads(line) for line in (out / "table.jsonl").read_text().splitlines()]
    with open(out / "costs.csv", newline="") as lines:
        for row, cost in zip(rows, csv.DictReader(lines)):
            assert row["case"] == int(cost.pop("case"))
            row |= {name: float(value) if value else None for name, value in cost.items()}
    return out, rows


def put_into_page(page, mark, text):
    """Replaces what stands between <!-- MARK --> and <!-- end --> in a page."""
    head, _, rest = page.read_text().partition(f"<!-- {mark} -->\n")
    _, end, tail = rest.partition("<!-- end -->")
    assert end, f"{page}: no <!-- {mark} --> with <!-- end --> after it"
    page.write_text(f"{head}<!-- {mark} -->\n{text}<!-- end -->{tail}")
