"""Says what a geometry or a mesh has that a scene can name, and draws it: bodies, curves, and which curves meet.

Usage: curves.py GEOMETRY.json [--picture PICTURE] [--quiet]
(mortise check PART.geo --picture PICTURE does it)
"""

import json
import sys
from pathlib import Path

import geometry
from script import Parser, run

MANY_LINES = 60  # of curves; more are not listed one by one


def gap_words(pair):
    if abs(pair.gap) <= pair.known:
        return "touching"
    return f"gap {pair.gap:.3g}" if pair.gap > 0 else f"overlap {-pair.gap:.3g}"


def proposed(part):
    """Names for curves without one, that say where they are: the side of their body, or the number."""
    names, taken = {}, {curve.name for curve in part.curves} | set(part.bodies)
    for curve in (curve for curve in part.curves if curve.numbered and len(curve.bodies) == 1):
        low, high = part.box(curve.bodies[0])
        middle, near = curve.points.mean(axis=0), 1e-6 * (high - low).max()
        sides = {"left": middle[0] - low[0], "right": high[0] - middle[0], "bottom": middle[1] - low[1], "top": high[1] - middle[1]}
        side = next((side for side, off in sides.items() if curve.straight and off < near), None)
        body = part.bodies[curve.bodies[0]].replace("surface_", "body_")
        name = f"{body}_{side}" if side and f"{body}_{side}" not in taken else f"{body}_{curve.name}"
        taken.add(name)
        names[curve.name] = name
    return names


def lines_for_geo(part):
    """Physical curves and surfaces, ready to paste, for those that have no name."""
    names = proposed(part)
    bodies = [f'Physical Surface("{body.replace("surface_", "body_")}") = {{{body.removeprefix("surface_")}}};'
              for body in part.bodies if geometry.numbered(body)]  # fmt: skip
    return bodies + [f'Physical Curve("{name}") = {{{curve.removeprefix("curve_")}}};' for curve, name in names.items()]


def text(part, pairs):
    lines = [f"{part.source}: {len(part.bodies)} bodies, {len(part.curves)} curves; lengths in its unit"]
    lines += [f"  body      {body}: {part.size_words(k)}" for k, body in enumerate(part.bodies[:MANY_LINES])]
    for curve in part.curves[:MANY_LINES]:
        lines.append(f"  curve     {curve.name} of {', '.join(part.bodies[k] for k in curve.bodies)}: length {curve.length:.4g}, {curve.words()}")
    if len(part.curves) > MANY_LINES:
        lines.append(f"            and {len(part.curves) - MANY_LINES} more curves")
    lines += [f"  joined    {words}" for words in part.one_piece()[:MANY_LINES]]
    for pair in pairs[:MANY_LINES]:
        kind = "meet     " if pair.close() else "near     "
        lines.append(f"  {kind} {pair.curves[0].name} - {pair.curves[1].name}: along {pair.along:.3g}, {gap_words(pair)}")
    if pairs:
        lines += ["", "for the scene's file (mortise new writes one):"]
        names = {} if part.by_number else proposed(part)
        lines += ["contact = [", *(f"  {entry(pair, names)}," for pair in pairs[:MANY_LINES]), "]"]
    if part.source.suffix == ".geo" and (names := lines_for_geo(part)):
        why = "names instead of these numbers" if part.by_number else "the curves that a scene cannot name yet"
        lines += ["", f"for {part.source.name}, {why}:", *names]
    return "\n".join(lines)


def entry(pair, names):
    """A line of [[contact]]."""
    between = ", ".join(json.dumps(names.get(curve.name, curve.name)) for curve in pair.curves)
    return f"{{ between = [{between}] }}"


def draw(part, pairs, picture):
    import setup  # matplotlib takes a while

    contact = [{"between": [curve.name for curve in pair.curves], "words": gap_words(pair)} for pair in pairs]
    nothing = {"supports": [], "loads": [], "ties": [], "rest": [], "points": {}}
    setup.draw(part.json | nothing | {"title": part.source.name, "contact": contact}, picture)


def main():
    parser = Parser(__doc__)
    parser.add_argument("geometry", type=Path, help=".json")
    parser.add_argument("--picture", type=Path, help=".png, .pdf or .svg")
    parser.add_argument("--quiet", action="store_true", help="draw only")
    options = parser.parse_args()
    if options.picture and options.picture.suffix not in (".png", ".pdf", ".svg"):
        parser.error(f"{options.picture}: expected a .png, .pdf or .svg to write")
    part = geometry.Geometry(options.geometry)
    pairs = part.meetings()
    if not options.quiet:
        print(text(part, pairs))
    if options.picture:
        draw(part, pairs, options.picture)
        print(options.picture)


if __name__ == "__main__":
    run(main)
