#!/usr/bin/python3
"""One picture of a run: the deformed bodies with von Mises stress, loads and reactions, and the pressure along each
contact line; of many contact pairs the forces between the bodies instead.

Usage: picture.py RESULTS [PICTURE] [--zoom [X0,X1,Y0,Y1]] [--field FIELD] [--pair K] [--bodies] [--scale FACTOR] [--dpi DPI]
(mortise picture does the same)

RESULTS is the folder that `mortise solve` wrote; read are result.vtu, contact.vtu, summary.json
(docs/files.md) and contact.csv, or with 3-node triangles contact_centres.csv: p zigzags at their nodes. PICTURE is a
.png, .pdf or .svg, by default RESULTS.png beside the folder. --scale magnifies the
displacements; by default the largest is drawn as about 4 % of the size of what is shown, less where bodies whose gap
closes would be drawn over each other. --zoom shows the bodies where contact carries pressure, or in a box, without loads
and reactions; --pair K takes the Kth contact pair alone, from 0. --field: von_mises; sigma_n, the normal stress across
the direction of the nearest place of the contact line; error, where the energy of the estimated error lies. An arrow is the sum of a load, or the reaction of a curve of a
support, at the middle of what it acts on; of a clamp its moment about that is told too, and a rigid curve's force,
reaction and their moments at the point that they are about.
"""

import argparse
import json
import sys
from pathlib import Path

try:
    import meshio
    import numpy as np
    import figure
except ImportError as missing:
    raise SystemExit(f"picture.py: {missing}: apt-get install python3-matplotlib python3-meshio") from missing

import result_tables
from drawn_bodies import CONTACT, FIELDS, MANY_PAIRS, PAIR_COLOURS, draw_bodies, shown_box
from drawn_forces import draw_forces
from drawn_pressure import draw_pair, has_limit


ENDINGS = (".png", ".pdf", ".svg")


def refuse_older(results, model):
    """Ends the program where summary.json does not say where forces act."""
    acting = [load for load in model.get("loads", []) if "sum" in load]
    acting += [curve for support in model.get("supports", []) for curve in support.get("curves", [{}])]
    if not all("centre" in entry for entry in acting):
        raise SystemExit(f"picture.py: {results}: of an older mortise, without the places of forces; solve it again")


def is_given(gaps):
    """Whether a pair's gap is a length or an expression, or has a clearance, rather than what is drawn."""
    return any(gap not in ("curve", "measured", "closed") for gap in gaps)


def draw(results, picture, options):
    """One picture of the results: `options` as of the command line."""
    summary = json.loads((results / "summary.json").read_text())
    refuse_older(results, summary["model"])
    pairs = summary["contact"]
    shown = list(range(len(pairs)))
    if options.pair is not None:
        if not 0 <= options.pair < len(pairs):
            raise SystemExit(f"picture.py: --pair {options.pair}: the scene's pairs have the numbers 0 to {len(pairs) - 1}")
        shown = [options.pair]
    mesh = meshio.vtu.read(results / "result.vtu")
    table = result_tables.columns(results / "contact.csv") if pairs else {}
    if options.zoom == CONTACT and not pairs:
        raise SystemExit("picture.py: --zoom: the scene has no contact pair")
    of_shown = {name: column[np.isin(table["pair"], shown)] for name, column in table.items()}
    extent = np.ptp(shown_box(mesh, of_shown, options.zoom), axis=0)
    if options.bodies:
        shown, pairs = [], []
    above = float(np.clip(6.6 * extent[1] / extent[0], 2.5, 6.5))
    below = 2.5
    many = len(shown) > MANY_PAIRS
    if many and extent[1] > 3 * extent[0]:  # a tall scene
        drawing, panels = figure.panels(1, 2, (8, above + 0.6), squeeze=False)
        panels = panels.T
    else:
        heights = [above] + ([above] if many else [below] * len(shown))
        drawing, panels = figure.panels(len(heights), 1, (8, sum(heights) + 0.6), height_ratios=heights, squeeze=False)
    used, why = draw_bodies(panels[0, 0], results, summary, table if options.pair is None else of_shown, options)
    given = " (a gap that is given, not drawn, is not to be seen)" if is_given(summary["method"]["initial_gap"]) else ""
    panels[0, 0].set_title(f"displacements \u00d7 {used:g}{why},\nundeformed outline dashed{given}", fontsize=9)
    title = figure.wrapped(summary["title"] or summary["scene"])
    if summary["status"] == "solved":
        drawing.suptitle(title, fontsize=11)
    else:
        drawing.suptitle(f"{title}\n{summary['status'].replace('_', ' ')}", fontsize=11, color=figure.RED)
    if pairs:
        zigzags = any(block.type == "triangle" for block in mesh.cells)
        if zigzags:
            table = result_tables.columns(results / "contact_centres.csv")
        label = ("$p$ (means over edges)",) if zigzags else ()
        if many:
            draw_forces(panels[1, 0], mesh, table, pairs)
            shown = []
        for panel, k in zip(panels[1:, 0], shown):
            colour = PAIR_COLOURS[k] if len(pairs) <= MANY_PAIRS else PAIR_COLOURS[0]
            draw_pair(panel, table, k, has_limit(summary, k), *label, colour=colour)
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
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("results", type=Path, help="folder that mortise solve wrote")
    parser.add_argument("picture", type=Path, nargs="?", help=".png, .pdf or .svg (default: RESULTS.png)")
    zoom_help = "this box only; without numbers, where contact carries pressure"
    parser.add_argument("--zoom", type=box_of, metavar="[X0,X1,Y0,Y1]", help=zoom_help)
    parser.add_argument("--field", choices=FIELDS, default="von_mises", help="what colours the bodies (default: von_mises)")
    parser.add_argument("--pair", type=int, metavar="K", help="the Kth contact pair only, from 0")
    parser.add_argument("--bodies", action="store_true", help="the bodies only, without the pressure")
    parser.add_argument("--scale", type=float, help="magnification of the displacements")
    parser.add_argument("--dpi", type=int, default=130)
    options = parser.parse_args(with_box(sys.argv[1:]))
    if not (options.results / "summary.json").is_file():
        parser.error(f"{options.results}: no summary.json there; expected the folder of a run of mortise solve")
    picture = options.picture or options.results.with_name(options.results.resolve().name + ".png")
    if picture.suffix not in ENDINGS:
        parser.error(f"{picture}: expected a name that ends in {', '.join(ENDINGS)}")
    try:
        draw(options.results, picture, options)
    except Exception as error:  # of damaged files whatever their readers throw
        words = " ".join(str(error).split())
        raise SystemExit(f"picture.py: {options.results}: cannot be drawn to {picture} ({type(error).__name__}: {words})") from None
    print(picture)


if __name__ == "__main__":
    main()
