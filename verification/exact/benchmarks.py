#!/usr/bin/python3
"""Benchmarks of frictionless contact with known pressures, on four meshes each and with --accuracy 1%.

Written are OUT/benchmarks.csv (a row a run), a picture a benchmark and benchmarks.md; the runs are kept in OUT/runs.
--docs writes docs/benchmarks.md. Exit status 1 where a run fails or an error is above its limit.
"""

import os
import re
import sys
from math import log2
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.with_name("common")))

import numpy as np

import benchmark_cases
import closed_forms
import launch  # makes src/python/pictures known
import figure
import layer
import page
import peers
import persson
import runs
import template
from template import percent

ASKED = 0.01  # of --accuracy
WIDTH_LIMIT = 5e-3  # of the half width of contact on the finest mesh
SIZES = (25, 50, 100, 200)  # of the blocks that stand for half planes


def left_out_at_axis(summary):
    """What --accuracy leaves out beside a point on the axis at which p has no limit, as the wedge's tip."""
    points = summary["estimate"]["pressure"]["singular"]
    return max((point["left_out"] for point in points if point["position"][0] == 0), default=0)


def execute(run):
    """One run: `error` of p, `width`: relative error of the half width, unknowns, seconds, and the line for pictures."""
    case = benchmark_cases.by_name(run["case"])
    parameters = run.get("parameters", {})
    scene = benchmark_cases.scene_text(case, run["size"] or case.sizes[1], parameters)
    if "size" in parameters:  # the load stays
        scale = benchmark_cases.SIZE / parameters["size"]
        scene = re.sub(r"(?<=pressure = )[\d.e-]+", lambda found: repr(scale * float(found[0])), scene)
    before = launch.processor_seconds()

    def measure(folder, summary):
        seconds, line = launch.processor_seconds() - before, launch.contact(folder)
        at = benchmark_cases.places(case, line)
        near = np.flatnonzero(at <= 1.3 * case.half_width)
        return {
            "error": benchmark_cases.error(case, at, line["p"], 0 if run["size"] else left_out_at_axis(summary)),
            "width": summary["contact"][0]["length_in_contact"] / case.half_width - 1,
            "unknowns": summary["mesh"]["dofs"],
            "seconds": seconds,
            "line": [list(map(float, values[near])) for values in (at, line["p"], line["p_error"])],
        }

    nothing = dict.fromkeys(("failed", "error", "width", "unknowns", "seconds", "line"))
    return nothing | launch.measured(scene, measure, {} if run["size"] else {"accuracy.value": ASKED})


def verdict(case, meshes, asked):
    """What does not hold: texts. All four meshes, or fewer of which only the runs are judged."""
    wrong = [row["failed"] for row in [*meshes, asked] if row["failed"]]
    if wrong:
        return wrong
    measured = [(asked["error"], ASKED, "p where that was asked")]
    if len(meshes) == len(case.sizes):
        measured += [(meshes[-1]["error"], case.limit, "p on mesh 4")]
        measured += [(abs(meshes[-1]["width"]), WIDTH_LIMIT, "half width on mesh 4")]
    return [f"{name} off by {value:.2%}, expected {limit:.2%}" for value, limit, name in measured if not value < limit]


def draw(case, meshes, asked, path):
    drawing, (left, right) = figure.panels(1, 2, (9, 3.3))
    scale = 180 / np.pi if case.place == "angle" else 1
    fine = (np.arange(2000) + 0.5) / 2000 * min(case.compared, 1) * case.half_width
    left.plot(scale * fine, case.exact(fine), "k-", linewidth=1, label="exact")
    for row, style, name in ((meshes[0], "C1o", "mesh 1"), (asked, "C0.", "1 % asked, with its bars")):
        at, p, bar = (np.array(values) for values in row["line"])
        order = np.argsort(at)
        left.plot(scale * at[order], p[order], style, markersize=3, linestyle="", label=name)
    left.fill_between(scale * at[order], (p - bar)[order], (p + bar)[order], color="C0", alpha=0.25, linewidth=0)
    word = "degrees" if case.place == "angle" else "r / a" if case.ring else "x / a" if case.half_width == 1 else "x / h"
    inner = fine[(fine > 0.05 * case.half_width) & (fine < 0.95 * case.half_width)]
    top = 1.25 * case.exact(inner).max()
    figure.label(left, word, "p, MPa", case.title, legend=True, ylim=(0, top), xlim=(0, 1.2 * scale * case.half_width))
    figure.curve(right, [(row["unknowns"], row["error"]) for row in meshes], "o-C1", label="meshes 1 to 4")
    figure.curve(right, [(asked["unknowns"], asked["error"])], "sC0", label="1 % asked")
    widths = [(row["unknowns"], max(abs(row["width"]), 1e-6)) for row in meshes]
    if case.compared > 1:
        figure.curve(right, widths, "^:C2", label="half width")
    figure.label(right, "unknowns", "relative error of p", log="xy", limit=case.limit, legend=True)
    figure.save(drawing, path)


def truncation(store, quick):
    """The cylinder on blocks of 25 to 200 half widths."""
    wanted = [{"case": "cylinder", "size": 20 if quick else 160, "parameters": {"size": size}} for size in SIZES]
    return store.rows(wanted, execute, "size of the blocks")


def half_widths(case, *rows):
    return ", ".join(percent(abs(row["width"])) for row in rows) if case.compared > 1 else "given"


def peak(row):
    """Relative error of p at the middle, of the cylinder."""
    exact = benchmark_cases.by_name("cylinder").exact(np.array([0.0]))[0]
    at, p, _ = row["line"]
    return abs(p[int(np.argmin(at))] / exact - 1)


def table_line(case, meshes, asked):
    rate = log2(meshes[0]["error"] / meshes[-1]["error"]) / (len(meshes) - 1)
    errors = [percent(row["error"]) for row in meshes] + ["–"] * (4 - len(meshes))
    at_last = [f"{rate:.1f}", percent(case.limit), half_widths(case, meshes[-1], asked)]
    return [case.title, *errors, *at_last, percent(asked["error"]), asked["unknowns"], f"{asked['seconds']:.2g}"]


def by_others(store, meshes):
    """The table of other programs' figures; `meshes`: (case, mortise's row on mesh 2)."""
    wanted = [(case.name, case.sizes[1]) for case, _ in meshes]
    others = {by: peers.rows(store, wanted, by) for by in ("FreeFEM", "GetFEM")}
    there = [by for by in others if others[by]]
    heading = ["mesh 2", "unknowns", "p by mortise", *(f"by {by}" for by in there)]
    heading += [f"{by}, s" for by in ("mortise", *there)]
    lines = []
    for k, (case, ours) in enumerate(meshes):
        theirs = [others[by][k] for by in there]
        errors = [row["failed"] or percent(row["error"]) for row in theirs]
        seconds = ["–" if row["failed"] else f"{row['seconds']:.2g}" for row in theirs]
        lines.append([case.title, ours["unknowns"], percent(ours["error"]), *errors, f"{ours['seconds']:.2g}", *seconds])
    return template.table(heading, lines)


def page_text(lines, asked, pictures, large, others):
    heading = ["", *(f"mesh {k + 1}" for k in range(4)), "rate", "limit", "half width: finest mesh, 1 % asked",
               "p: 1 % asked", "unknowns", "seconds"]  # fmt: skip
    peaks = ["failed" if row["failed"] else f"{100 * peak(row):.3f} %" for row in large]
    return template.fill(
        (HERE / "benchmarks.md").read_text(),
        table=template.table(heading, lines),
        pictures="\n\n".join(pictures),
        fewest=min(row["unknowns"] for row in asked),
        most=max(row["unknowns"] for row in asked),
        best=percent(min(row["error"] for row in asked)),
        worst=percent(max(row["error"] for row in asked)),
        others=others,
        sizes=template.table(["size of the blocks, a", *SIZES], [["error of the largest p", *peaks]]),
        layer_width=layer.solve(1)[0],
        radius=closed_forms.RADIUS,
    )


def main(arguments=None):
    names = [case.name for case in benchmark_cases.CASES]
    options = launch.command_line(__doc__, "benchmarks", arguments, names=names, jobs=False, docs=True)
    others = [persson.__file__, HERE.with_name("stability") / "pin.geo", *HERE.with_name("chart").glob("*getfem*.py")]
    depends = [*HERE.glob("*.py"), *HERE.glob("*.geo"), *map(Path, others)]
    store = runs.Store(options.output / "runs", sorted(depends))
    os.environ.update(launch.ONE_THREAD)
    rows, lines, answers, pictures, second, wrong = [], [], [], [], [], []
    for case in benchmark_cases.CASES:
        if options.only and case.name not in options.only:
            continue
        sizes = case.sizes[:2] if options.quick and case.sizes[-1] > 100 else case.sizes  # the others are quick
        found = store.rows([{"case": case.name, "size": n} for n in (*sizes, 0)], execute, case.name)
        *meshes, asked = found
        wrong += [f"{case.name}: {text}" for text in verdict(case, meshes, asked)]
        for n, row in zip((*sizes, "1%"), found):
            rows.append({"case": case.name, "n": n} | {key: value for key, value in row.items() if key != "line"})
        if all(row["line"] for row in found):
            draw(case, meshes, asked, options.output / f"{case.name}.png")
            lines.append(table_line(case, meshes, asked))
            answers.append(asked)
            if not options.quick or case.name == "flat_punch":
                second.append((case, meshes[1]))
            pictures.append(f"![{case.title}. {case.source}.](benchmarks/{case.name}.png)")
    large = truncation(store, options.quick)
    wrong += [row["failed"] for row in large if row["failed"]]
    launch.write_csv(options.output / "benchmarks.csv", rows)
    text = page_text(lines, answers, pictures, large, by_others(store, second))
    page.write(options.output, "benchmarks", text, options.docs)
    print("\n".join(" | ".join(map(str, line)) for line in lines))
    print("\n".join(wrong) or "all hold")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
