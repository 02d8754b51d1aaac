#!/usr/bin/python3
"""The stability atlas: where each method fails, how it shows, why, where it begins, and what mortise does about it.

STUDIES is the table of the studies, a module each. A study has
  TITLE, INTRODUCTION, CAPTION   words
  runs(quick)           its runs (atlas_runs), or an empty list
  extra(folder, quick)  rows of another study that this one shows (optional)
  complete(rows)        rows with figures that compare runs with one another (optional)
  draw(rows, path)      one picture
  regions(rows)         the failures found (atlas_regions.region): name, where it begins in words and as a number, state
                        (fixed, default, guarded, shown, open), why (theory, source), what mortise does, quoted
Written are OUT/STUDY/rows.jsonl, rows.csv, picture.png, regions.json, and OUT/section.html. A run whose result is there
is not repeated. --docs writes docs/stability.md and its pictures from what the full atlas has found.
Exit status 1 if a run ends as it must not: an internal error, a crash, a hang.
"""

import argparse
import importlib
import json
import sys
import time
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import atlas_page
import atlas_runs
import launch

STUDIES = [
    (1, "infsup", "study_1_infsup"),
    (2, "ratio", "study_2_ratio"),
    (3, "contrast", "study_3_contrast"),
    (4, "incompressible", "study_4_incompressible"),
    (5, "geometry", "study_5_geometry"),
    (6, "overconstraint", "study_6_overconstraint"),
    (7, "iterations", "study_7_iterations"),
    (8, "numbers", "study_8_numbers"),
]
NEVER = ("internal error", "hang", "crash")


def find(number, module):
    """The study's module, or None if it is not there (yet)."""
    if importlib.util.find_spec(module) is None:
        print(f"study {number}: {module}.py is not there; skipped", flush=True)
        return None
    return importlib.import_module(module)


def carry_out(number, name, study, folder, quick):
    """Runs, table, picture and regions of one study."""
    start = time.monotonic()
    print(f"study {number}: {study.TITLE}", flush=True)
    rows, fresh = atlas_runs.run_all(study.runs(quick), folder / name, name)
    rows += study.extra(folder, quick) if hasattr(study, "extra") else []
    rows = study.complete(rows) if hasattr(study, "complete") else rows
    atlas_runs.write_table(folder / name / "rows.csv", rows)
    study.draw(rows, folder / name / "picture.png")
    regions = study.regions(rows)
    (folder / name / "regions.json").write_text(json.dumps(regions, indent=1) + "\n")
    for region in regions:
        print(f"  [{region['state']}] {region['name']}: {region['begins']}", flush=True)
    print(f"  {fresh} of {len(rows)} runs were new; {time.monotonic() - start:.0f} s", flush=True)
    return {"number": number, "name": name, "study": study, "rows": rows, "regions": regions, "fresh": fresh}


def ended_badly(results):
    for result in results:
        for row in result["rows"]:
            if row["outcome"].startswith(NEVER):
                yield f"study {result['number']}: {row['outcome']}: {row}"[:600]


def run_studies(folder, quick, only=()):
    """The results of all studies that are there, or of those named."""
    wanted = [entry for entry in STUDIES if not only or entry[1] in only or str(entry[0]) in only]
    found = [(number, name, find(number, module)) for number, name, module in wanted]
    return [carry_out(number, name, study, folder, quick) for number, name, study in found if study]


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, default=Path("out/atlas"), help="folder (default: out/atlas)")
    parser.add_argument("--quick", action="store_true", help="fewer runs: at most 2 minutes")
    parser.add_argument("--study", action="append", default=[], help="number or name: only this one (repeat for more)")
    parser.add_argument("--docs", action="store_true", help="also write docs/stability.md and docs/stability/")
    options = parser.parse_args(arguments)
    if options.docs and (options.quick or options.study):
        parser.error("--docs needs the full atlas")
    start = time.monotonic()
    try:
        results = run_studies(options.output, options.quick, options.study)
    except launch.MortiseError as error:
        sys.exit(f"atlas.py: {error}")
    if not results:
        sys.exit(f"atlas.py: no study of that name; known: {', '.join(name for _, name, _ in STUDIES)}")
    atlas_page.write_html(options.output, results, options.quick)
    if options.docs:
        atlas_page.write_docs(options.output, results)
    bad = list(ended_badly(results))
    print(*bad, f"{options.output}/section.html; {time.monotonic() - start:.0f} s", sep="\n")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
