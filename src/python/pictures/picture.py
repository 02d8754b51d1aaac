#!/usr/bin/python3
"""One picture of a run: the deformed bodies with von Mises stress, loads and reactions, and the pressure along each
contact line; of many contact pairs the forces between the bodies, p along a curve that many have and of the most loaded.

Usage: picture.py RESULTS [MORE...] [PICTURE] [--format FORMAT] [--zoom [X0,X1,Y0,Y1]] [--field FIELD] [--pair K] [--bodies]
[--pressure] [--history] [--along COLUMN] [--scale FACTOR] [--dpi DPI]
(mortise picture does the same)

RESULTS is the folder that `mortise solve` wrote; read are result.vtu, contact.vtu, summary.json
(docs/files.md) and contact.csv, or with 3-node triangles contact_centres.csv: p zigzags at their nodes. PICTURE is a
.png, .pdf or .svg, by default RESULTS.png beside the folder (--format: another kind). With --history RESULTS
is the folder of a scene with cases, and the picture what cases.csv says over the load, or over any of its COLUMNs. With MORE folders it is p of all runs
over each other, with --pressure p of one, as of a case without result.vtu. A scene that is much taller than wide is turned. --scale magnifies the
displacements; by default the largest is drawn as about 4 % of the size of what is shown, less where bodies whose gap
closes would be drawn over each other. --zoom shows the bodies where contact carries pressure, or in a box, without loads
and reactions; --pair K takes the Kth contact pair alone, from 0. --field: von_mises; sigma_n, the normal stress across
the direction of the nearest place of the contact line; error, where the energy of the estimated error lies. An arrow is the sum of a load, or the reaction of a curve of a
support, at the middle of what it acts on; of a clamp its moment about that is told too, and a rigid curve's force,
reaction and their moments at the point that they are about.
"""

import argparse
import json
import math
import sys
from pathlib import Path

try:
    import meshio
    import numpy as np
    import figure
except ImportError as missing:
    raise SystemExit(f"picture.py: {missing}: apt-get install python3-matplotlib python3-meshio") from missing

import result_tables
from drawn_bodies import CONTACT, FIELDS, MANY_PAIRS, PAIR_COLOURS, SLENDER, draw_bodies, shown_box, turn
from drawn_cases import draw_history
from drawn_forces import draw_forces
from drawn_pairs import COLUMNS, SMALL, draw_along, draw_runs, draw_small, most_loaded, shared_curve
from drawn_pressure import draw_pair, has_limit
from script import Parser, run


FORMATS = ("png", "pdf", "svg")


def refuse_older(results, model):
    """Ends the program where summary.json does not say where forces act."""
    acting = [load for load in model.get("loads", []) if "sum" in load]
    acting += [curve for support in model.get("supports", []) for curve in support.get("curves", [{}])]
    if not all("centre" in entry for entry in acting):
        raise SystemExit(f"picture.py: {results}: of an older mortise, without the places of forces; solve it again")


def is_given(gaps):
    """Whether a pair's gap is a length or an expression, or has a clearance, rather than what is drawn."""
    return any(gap not in ("curve", "measured", "closed") for gap in gaps)


def summary_of(results):
    summary = json.loads((results / "summary.json").read_text())
    refuse_older(results, summary["model"])
    return summary


def zigzags(results):
    """Whether p at the nodes does: with 3-node triangles, or where no bodies were written with edges of two nodes."""
    name, kind = ("contact.vtu", "line") if without_bodies(results) else ("result.vtu", "triangle")
    return any(block.type == kind for block in meshio.vtu.read(results / name).cells)


def without_bodies(results):
    """Whether it is a case of [cases] write = "contact"."""
    return not (results / "result.vtu").is_file() and (results.resolve().parent.parent / "cases.csv").is_file()


def shown_pairs(summary, options):
    """The numbers of the pairs that are shown."""
    pairs = summary["contact"]
    if options.pair is None:
        return list(range(len(pairs)))
    if not 0 <= options.pair < len(pairs):
        refuse_without(pairs, "--pair")
        raise SystemExit(f"picture.py: --pair {options.pair}: the scene's pairs have the numbers 0 to {len(pairs) - 1}")
    return [options.pair]


def refuse_without(pairs, asked):
    if not pairs:
        raise SystemExit(f"picture.py: {asked}: the scene has no contact pair")


def entitle(row, summary):
    """Above the first row of panels."""
    title = figure.wrapped(summary["title"] or summary["scene"])
    if summary["status"] == "solved":
        row.suptitle(title, fontsize=11)
    else:
        row.suptitle(f"{title}\n{summary['status'].replace('_', ' ')}", fontsize=11, color=figure.RED)


def rows_of_panels(heights):
    """A figure with a row of panels for each height, inches; each row may have several."""
    drawing = figure.plt.figure(figsize=(8, sum(heights) + 0.6), layout="constrained")
    drawing.get_layout_engine().set(h_pad=0.08)
    return drawing, list(drawing.subfigures(len(heights), 1, height_ratios=heights, squeeze=False)[:, 0])


def draw_many(rows, mesh, table, pairs, turned):
    """Forces between the bodies, p along a curve that most pairs have, and the most loaded pairs one by one."""
    draw_forces(rows.pop(0).subplots(), mesh, table, pairs, turned)
    if shared := shared_curve(pairs):
        draw_along(rows.pop(0).subplots(), table, *shared)
    numbers = most_loaded(pairs)
    rows[0].suptitle(f"the {len(numbers)} pairs with the largest forces: p over the arc length", fontsize=9)
    draw_small(rows[0].subplots(-(-len(numbers) // COLUMNS), COLUMNS).ravel(), table, pairs, numbers)


def draw(results, picture, options):
    """One picture of the results: `options` as of the command line."""
    summary = summary_of(results)
    shown, pairs = shown_pairs(summary, options), summary["contact"]
    mesh = meshio.vtu.read(results / "result.vtu")
    curve = meshio.vtu.read(results / "contact.vtu") if pairs else None
    table = result_tables.contact_table(results) if pairs else {}
    if pairs:
        curve.point_data["pair"] = table["pair"]  # points stand in the order of contact.csv
    if options.zoom == CONTACT:
        refuse_without(pairs, "--zoom")
    of_shown = {name: column[np.isin(table["pair"], shown)] for name, column in table.items()}
    extent = np.ptp(shown_box(mesh, of_shown, options.zoom), axis=0)
    turned = bool(extent[1] > SLENDER * extent[0])
    if turned:
        turn(mesh, curve, table)
        extent = extent[::-1]
        of_shown = {name: column[np.isin(table["pair"], shown)] for name, column in table.items()}
        options.zoom = options.zoom if options.zoom in (None, CONTACT) else options.zoom[2:] + options.zoom[:2]
    if options.bodies:
        shown, pairs = [], []
    above, many = float(np.clip(6.6 * extent[1] / extent[0], 1.4 if turned else 2.5, 6.5)), len(shown) > MANY_PAIRS
    below = [2.5] * len(shown)
    if many:
        below = [above + turned, *([2.5] if shared_curve(pairs) else []), 0.3 + 1.25 * -(-min(len(pairs), SMALL) // COLUMNS)]
    drawing, rows = rows_of_panels([above + (1.4 if turned else 0.6), *below])
    entitle(rows[0], summary)
    axes = rows.pop(0).subplots()
    used, why = draw_bodies(axes, mesh, curve, summary, table if options.pair is None else of_shown, options, turned)
    given = " (a gap that is given, not drawn, is not to be seen)" if is_given(summary["method"]["initial_gap"]) else ""
    closed = ", closed contact in red" if summary["contact"] else ""
    axes.set_title(f"displacements \u00d7 {figure.grouped(used)}{why},\nundeformed outline dashed{closed}{given}", fontsize=9)
    if many:
        draw_many(rows, mesh, table, pairs, turned)
    elif pairs:
        draw_pairs(rows, results, summary, shown, len(pairs) <= MANY_PAIRS)
    figure.save(drawing, picture, options.dpi)


def draw_pairs(rows, results, summary, numbers, coloured):
    """p along the lines of these pairs; means over edges where p zigzags at the nodes."""
    means = zigzags(results)
    table, label = result_tables.contact_table(results, means), "$p$ (means over edges)" if means else "$p$"
    for row, k in zip(rows, numbers):
        draw_pair(row.subplots(), table, k, has_limit(summary, k), label, PAIR_COLOURS[k] if coloured else PAIR_COLOURS[0])


def run_of(folder):
    """Name, summary and table of a run."""
    summary = summary_of(folder)
    return folder.name or folder.resolve().name, summary, result_tables.contact_table(folder, zigzags(folder)) if summary["contact"] else {}


def draw_pressures(folders, picture, options):
    """p along the lines alone, of several runs over each other; of many pairs the most loaded."""
    summary = summary_of(folders[0])
    refuse_without(summary["contact"], "p")
    numbers = shown_pairs(summary, options)
    if len(numbers) > MANY_PAIRS:
        numbers = most_loaded(summary["contact"])[:MANY_PAIRS]
    drawing, rows = rows_of_panels([3.2] * len(numbers))
    entitle(rows[0], summary)
    if len(folders) == 1:
        draw_pairs(rows, folders[0], summary, numbers, False)
    else:
        draw_runs([row.subplots() for row in rows], list(map(run_of, folders)), numbers, summary)
    figure.save(drawing, picture, options.dpi)


def box_of(text):
    """X0,X1,Y0,Y1 as numbers, or CONTACT."""
    if text == CONTACT:
        return text
    try:
        x0, x1, y0, y1 = (float(number) for number in text.split(","))
        if x0 < x1 and y0 < y1:
            return [x0, x1, y0, y1]
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"'{text}' is no box; expected X0,X1,Y0,Y1 with X0 < X1 and Y0 < Y1")


def finite(text):
    try:
        if math.isfinite(number := float(text)):
            return number
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"expected a number, found '{text}'")


def with_box(arguments):
    """The arguments with "--zoom=X0,..." for "--zoom X0,...", as a box may begin with a minus, and "--zoom=contact" where
    none follows."""
    words = list(arguments)
    if "--zoom" in words:
        k = words.index("--zoom")
        box = [word for word in words[k + 1 : k + 2] if "," in word]
        words[k : k + 1 + len(box)] = [f"--zoom={box[0] if box else CONTACT}"]
    return words


def main():
    parser = Parser(__doc__)
    parser.add_argument("results", type=Path, help="folder that mortise solve wrote")
    parser.add_argument("more", type=Path, nargs="*", help="more such folders: p of all runs; a .png, .pdf or .svg (default: RESULTS.png)")
    parser.add_argument("--format", choices=FORMATS, help="of the picture without a name (default: png)")
    zoom_help = "this box only; without numbers, where contact carries pressure"
    parser.add_argument("--zoom", type=box_of, metavar="[X0,X1,Y0,Y1]", help=zoom_help)
    parser.add_argument("--field", choices=FIELDS, default="von_mises", help="what colours the bodies (default: von_mises)")
    parser.add_argument("--pair", type=int, metavar="K", help="the Kth contact pair only, from 0")
    parser.add_argument("--bodies", action="store_true", help="the bodies only, without the pressure")
    parser.add_argument("--pressure", action="store_true", help="p along the lines only, without the bodies")
    parser.add_argument("--history", action="store_true", help="of a scene's cases: figures over the load, from cases.csv")
    parser.add_argument("--along", metavar="COLUMN", help="of --history: over this column (default: the scale, or what cases change)")
    parser.add_argument("--scale", type=finite, help="magnification of the displacements")
    parser.add_argument("--dpi", type=int, default=130)
    options = parser.parse_intermixed_args(with_box(sys.argv[1:]))
    *others, last = [options.results, *options.more]
    folders = [*others, last] if last.is_dir() or not options.more else others
    for folder in folders:
        if not (folder / "summary.json").is_file():
            parser.error(f"{folder}: no summary.json there; expected the folder of a run of mortise solve")
    for folder in folders:
        if options.history != (folder / "cases.csv").is_file():
            parser.error(f"{folder}: no cases.csv there; expected the folder of a scene with [[case]]" if options.history
                         else f"{folder}: the cases of a scene; expected --history, or the folder cases/NAME of one of them")
    of_bodies = options.bodies or options.zoom or options.scale is not None or options.field != parser.get_default("field")
    if of_bodies and without_bodies(options.results):
        parser.error(f'{options.results}: no result.vtu there, and so no bodies to draw; expected a scene with [cases] write = "all"')
    picture = options.results.with_name(f"{options.results.resolve().name}.{options.format or FORMATS[0]}") if last in folders else last
    if picture.suffix[1:] not in FORMATS:
        parser.error(f"{picture}: expected a name that ends in {', '.join(f'.{name}' for name in FORMATS)}")
    try:
        if options.history:
            draw_history(options.results, picture, options)
        elif options.pressure or len(folders) > 1 or without_bodies(options.results):
            draw_pressures(folders, picture, options)
        else:
            draw(options.results, picture, options)
    except Exception as error:  # of damaged files whatever their readers throw
        words = " ".join(str(error).split())
        raise SystemExit(f"picture.py: {options.results}: cannot be drawn to {picture} ({type(error).__name__}: {words})") from None
    print(picture)


if __name__ == "__main__":
    run(main)
