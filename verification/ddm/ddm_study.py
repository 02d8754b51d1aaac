#!/usr/bin/python3
"""The study of domain decomposition: region.py, steps.py and one history, as a section of the report.

Region and steps are kept where their CSV files are there already and --again is not given.
"""

import argparse
import csv
import sys
from pathlib import Path

import ddm_runs  # makes launch and page known
import history
import launch
import page
import region
import steps

ACCELERATIONS = ["none", "aitken", "anderson", "krylov"]


def run_part(main, arguments):
    """Runs a script's main(), which ends by SystemExit; its exit status."""
    try:
        main(arguments)
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else 1
    return 0


def draw_histories(output, mesh):
    """Residuals step by step, an acceleration each, drawn into history.png."""
    folders = []
    for acceleration in ACCELERATIONS:
        folder = output / "runs" / acceleration
        settings = {"method.solver": "ddm", "method.acceleration": acceleration, **launch.sizes(mesh)}
        launch.solve("parabola_1", settings, folder)
        folders.append(str(folder))
    run_part(history.main, [*folders, str(output / "history.png")])


def steps_table(path):
    """A row a scene, scheme and acceleration; in a cell the steps on all meshes."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    ratios = list(dict.fromkeys(row["ratio"] for row in rows))
    found = []
    for key in dict.fromkeys((row["scene"], row["scheme"], row["acceleration"]) for row in rows):
        mine = [row for row in rows if (row["scene"], row["scheme"], row["acceleration"]) == key]
        cells = []
        for ratio in ratios:
            of_ratio = [row for row in mine if row["ratio"] == ratio]
            ends = (row["steps"] if row["outcome"] == "converged" else row["outcome"] for row in of_ratio)
            cells.append(", ".join(ends))
        found.append([*key, *cells])
    return page.table(["scene", "scheme", "acceleration", *(f"E ratio {float(ratio):g}" for ratio in ratios)], found)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, default=Path("out/ddm"), help="folder (default: out/ddm)")
    parser.add_argument("--quick", action="store_true", help="the small versions of both parts")
    parser.add_argument("--again", action="store_true", help="measure what is already there once more")
    options = parser.parse_args(arguments)
    options.output.mkdir(parents=True, exist_ok=True)
    common = ["-o", str(options.output), *(["--quick"] if options.quick else [])]
    failed = 0
    for part, name in ((region, "region.csv"), (steps, "steps.csv")):
        if options.again or not (options.output / name).is_file():
            failed += run_part(part.main, common) != 0
    draw_histories(options.output, (20, 25) if options.quick else (80, 100))
    parts = [
        page.paragraph(
            "Each body solved alone, the interface brought to agreement by iteration. With a fixed relaxation the "
            "error is "
            "multiplied by at most max |1 - beta mu| in a step, mu the eigenvalues of the interface: predicted "
            "limit and "
            "measured factors."
        ),
        page.picture("region.png", "Where a fixed beta converges: measured factors (colour), predicted limit (line)."),
        page.picture("history.png", "parabola_1: residuals step by step, plain and accelerated."),
        page.heading("Steps to 1e-8"),
        page.paragraph(
            "The numbers of a cell belong to the meshes of steps.csv, coarsest first; the default is krylov."
        ),
        steps_table(options.output / "steps.csv"),
    ]
    page.write_section(options.output, "ddm", "Domain decomposition: where it converges, and how fast", parts)
    print(options.output / "section.html")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
