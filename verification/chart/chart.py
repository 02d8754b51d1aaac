#!/usr/bin/python3
"""Accuracy against speed: errors and seconds of every method on finer and finer meshes, drawn and put into words.

Written into the output folder are chart.csv (a row a run: errors, seconds of the stages, their medians and range), a
picture a problem, economy.csv and chart.md. Runs are kept below the folder and not repeated while the executables,
scenes and measures are the same: a run that was stopped goes on. Other work on the machine falsifies the seconds.

Exit status: 0; 1 if a program is missing or fails, or the half models or the bilateral contact change p.
"""

import sys
import time

import advice
import chart_page
import chart_pictures
import chart_runs
import economy
import launch
import measure
import timing_check


def run(output, quick, docs):
    """Everything; returns whether p stayed the same where it must."""
    start, store = time.perf_counter(), chart_runs.make_store(output, quick)
    rows, about = measure.measure(store, output, quick)
    checks = store.row("timing check", lambda _: timing_check.check(rows, quick))
    for c in checks:
        print("{problem} {method} {mesh}: chart {chart:.4f} s, process {process:.4f} s, ratio {ratio:.3f}; "
              "processor {processor:.4f} s, ratio {processor_ratio:.3f}".format(**c))  # fmt: skip
    saved = economy.measure(store, quick)
    launch.write_csv(output / "economy.csv", saved)
    chart_pictures.draw_all(output, rows)
    chart_page.write(output, rows, chart_page.contents(rows, about, checks, saved), docs)
    print(*("  ".join(row) for row in advice.table(rows)), *advice.recommendation(rows), sep="\n")
    worst = max(row["difference_of_p"] for row in saved)
    print(f"half models and bilateral contact: p differs by at most {worst:.1e} of its largest value")
    print(f"{output}/chart.md ({time.perf_counter() - start:.0f} s)")
    return worst <= economy.SAME


def main(arguments=None):
    options = launch.command_line(__doc__, "chart", arguments, jobs=False, docs=True)
    options.output.mkdir(parents=True, exist_ok=True)
    try:
        same = run(options.output.absolute(), options.quick, options.docs)
    except launch.StudyError as error:
        sys.exit(f"chart.py: {error}")
    sys.exit(0 if same else 1)


if __name__ == "__main__":
    main()
