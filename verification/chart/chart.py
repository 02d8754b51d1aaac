#!/usr/bin/python3
"""Accuracy against speed: errors and seconds of every method on finer and finer meshes, drawn and put into words.

Written into the output folder are chart.csv (a row a run: errors, seconds of the stages, their medians and range),
chart.json (machine, versions, the reference), a picture a problem, economy.csv and section.html. Runs are kept below
the folder and not repeated while the executables and their settings are the same: a run that was stopped goes on.
Other work on the machine falsifies the seconds.

Exit status: 0; 1 if a program is missing or fails, or the half models or the bilateral contact change p.
"""

import argparse
import json
import sys
import time
from pathlib import Path

import advice
import chart_page
import chart_pictures
import chart_runs
import economy
import launch
import measure
import timing_check


def from_files(output):
    """What an earlier run has written: rows with numbers, and the table of chart.json."""
    path = output / "chart.csv"
    if not path.is_file():
        raise chart_runs.ToolError(f"{path} is missing; expected a run without --draw before")
    columns = launch.columns(path)
    rows = [dict(zip(columns, values)) for values in zip(*columns.values())]
    whole = ("n", "turns", *chart_runs.SIZES)
    rows = [{key: int(v) if key in whole else None if v == "" else v for key, v in row.items()} for row in rows]
    return rows, json.loads((output / "chart.json").read_text())


def checked(rows, about, output, quick):
    """The seconds of chart.json's timing check, measured now where there are none."""
    if "timing_check" not in about:
        about["timing_check"] = timing_check.check(rows, output, quick)
        chart_runs.write_json(output / "chart.json", about)
    for c in about["timing_check"]:
        print(
            f"{c['problem']} {c['method']} {c['mesh']}: chart {c['chart']:.4f} s, process {c['process']:.4f} s, "
            f"ratio {c['ratio']:.3f}; processor {c['processor']:.4f} s, ratio {c['processor_ratio']:.3f}"
        )
    return about["timing_check"]


def write_all(rows, about, checks, saved, output, docs):
    chart_pictures.draw_all(output, rows)
    parts = list(chart_page.contents(rows, about, checks, saved, list(economy.elements(rows))))
    chart_page.write_html(output, parts, list(advice.rates(rows)))
    if docs:
        chart_page.write_docs(output, parts)


def run(output, quick, draw_only, docs):
    """Everything; returns whether p stayed the same where it must."""
    start = time.perf_counter()
    rows, about = from_files(output) if draw_only else measure.measure(output, quick)
    quick = about["quick"]
    checks = checked(rows, about, output, quick)
    saved, _ = economy.measure(output, quick)
    write_all(rows, about, checks, saved, output, docs)
    for row in advice.table(rows):
        print("  ".join(row))
    print(*advice.recommendation(rows), sep="\n")
    worst = max(row["difference_of_p"] for row in saved)
    print(f"half models and bilateral contact: p differs by at most {worst:.1e} of its largest value")
    print(f"{output}/section.html ({time.perf_counter() - start:.0f} s)")
    return worst <= economy.SAME


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, default=Path("out/chart"), help="folder (default: out/chart)")
    parser.add_argument("--quick", action="store_true", help="a few methods on coarse meshes, 1 minute")
    parser.add_argument("--draw", action="store_true", help="only draw and write again, from chart.csv")
    parser.add_argument("--docs", action="store_true", help="write docs/charts.md and its pictures too")
    options = parser.parse_args(arguments)
    if options.quick and options.docs:
        parser.error("--docs is for the figures of a whole run, not of --quick")
    options.output.mkdir(parents=True, exist_ok=True)
    try:
        same = run(options.output.absolute(), options.quick, options.draw, options.docs)
    except (launch.MortiseError, chart_runs.ToolError) as error:
        sys.exit(f"chart.py: {error}")
    sys.exit(0 if same else 1)


if __name__ == "__main__":
    main()
