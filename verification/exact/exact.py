#!/usr/bin/python3
"""Exact solutions: what a scene can say, held against formulas on four meshes.

Written are OUT/exact.csv (a row a run) and exact.md; the runs are kept in OUT/runs. --docs writes docs/exact.md.
Exit status 1 where a run fails, an error is above its limit or a rate is lost.
"""

import sys
from math import log2
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.with_name("common")))

import exact_cases
import launch
import page
import runs
import template

ROUND_OFF = 1e-8  # of cases that elements represent exactly
FINEST, RATE = 2e-3, 1.7  # of the others: error on the finest mesh, rate over all four


def scene_of(case, size):
    if case.name == "hertz_sphere":
        return launch.scene_file(case.name).read_text().replace('"hertz.geo"', f'"{launch.ROOT / "geo/hertz.geo"}"')
    parameters = ", ".join(filter(None, [f"n = {size}", case.parameters]))
    return f'[mesh]\nfile = "{HERE / case.geometry}.geo"\nparameters = {{ {parameters} }}\n{case.scene}'


def execute(run):
    """The error of a case on a mesh."""
    case = exact_cases.by_name(run["case"])
    settings = launch.sizes((run["size"], round(1.25 * run["size"]))) if case.name == "hertz_sphere" else {}
    measure = lambda folder, summary: {"error": float(case.measure(folder)), "unknowns": summary["mesh"]["dofs"]}
    return dict.fromkeys(("failed", "error", "unknowns")) | launch.measured(scene_of(case, run["size"]), measure, settings)


def verdict(case, errors):
    """Whether the errors are what they should be."""
    if None in errors:
        return False
    if case.exact:
        return all(error < ROUND_OFF for error in errors)
    return errors[-1] < FINEST and rate(errors) > RATE


def rate(errors):
    return log2(errors[0] / errors[-1]) / (len(errors) - 1)


def main(arguments=None):
    names = [case.name for case in exact_cases.CASES]
    options = launch.command_line(__doc__, "exact", arguments, names=names, docs=True)
    cases = [case for case in exact_cases.CASES if not options.only or case.name in options.only]
    depends = [__file__, exact_cases.__file__, *sorted(HERE.glob("*.geo"))]
    store = runs.Store(options.output / "runs", depends, jobs=options.jobs)
    rows, lines, good = [], [], True
    for case in cases:
        sizes = case.sizes[:3] if options.quick else case.sizes
        found = store.rows([{"case": case.name, "size": size} for size in sizes], execute, case.name)
        errors = [row["error"] for row in found]
        holds = verdict(case, errors) and not any(row["failed"] for row in found)
        good = good and holds
        rows += [{"case": case.name, "size": size} | row for size, row in zip(sizes, found)]
        shown = ["–" if error is None else f"{error:.1e}" for error in errors]
        of_rate = "exact" if case.exact else "–" if None in errors else f"{rate(errors):.1f}"
        lines.append([case.feature, case.source, case.compared, *shown, of_rate, "holds" if holds else "does not"])
        for row in found:
            if row["failed"]:
                print(f"{case.name}: {row['failed']}")
    launch.write_csv(options.output / "exact.csv", rows)
    meshes = [f"mesh {k + 1}" for k in range(len(lines[0]) - 5)]
    table = template.table(["of the scene", "exact solution", "compared", *meshes, "rate", ""], lines)
    text = template.fill((HERE / "exact.md").read_text(), table=table)
    page.write(options.output, "exact", text, options.docs)
    print(table)
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
