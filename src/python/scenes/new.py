"""Writes a scene from a geometry or a mesh: what is there, and what is still to be said as commented lines.

Usage: new.py GEOMETRY.json SCENE.toml
(mortise new PART.geo does it)
"""

import json
import os
import re
import sys
from pathlib import Path

import numpy as np

import geometry
from curves import entry, gap_words
from script import Parser, run

METRES = 5  # a part that is larger is drawn in millimetres, more likely than not
MANY_BODIES = 20
STEEL = {"m": ("Pa", "210e9", "10e6"), "mm": ("MPa", "210e3", "10")}  # unit of stress; Young's modulus, a pressure
CLAMPED, GUIDED = "displacement = { x = 0, y = 0 }", "displacement = { x = 0 }"


def sides_of(part, curves):
    """The straight curves at the bottom, the left and the top of the whole part; "rest", the others."""
    points = np.concatenate([curve.points for curve in part.curves])
    low, high = points.min(axis=0), points.max(axis=0)
    levels = {"bottom": (1, low[1]), "left": (0, low[0]), "top": (1, high[1])}
    found = {side: [] for side in (*levels, "rest")}
    for curve in curves:
        on = [side for side, (axis, level) in levels.items() if np.abs(curve.points[:, axis] - level).max() < 1e-6 * (high - low).max()]
        found[on[0] if on else "rest"].append(curve)
    if not found["bottom"] and found["rest"]:  # a ring: by its rim
        found["bottom"].append(found["rest"].pop(int(np.argmax([curve.length for curve in found["rest"]]))))
    if not found["top"]:
        found["top"], found["rest"] = found["rest"], []
    return found


def boundary_lines(part, sides, pressure):
    """Supports and loads to choose from, as comments."""
    held = {body for curve in sides["bottom"] + sides["left"] for body in curve.bodies}
    line = lambda curve, what: f"  # {{ on = {quoted(curve.name)}, {what} }},  # length {curve.length:.4g}, {curve.words()}"
    lines = ["  # Supports. x = 0 alone: a line of symmetry, or a guide."]
    lines += [line(curve, CLAMPED) for curve in sides["bottom"]] + [line(curve, GUIDED) for curve in sides["left"]]
    lines += [line(curve, GUIDED) for curve in sides["top"] if not held & set(curve.bodies)]
    lines += ["  # Loads. A pressure pushes; traction = [tx, ty] per area, force = [fx, fy] in sum."]
    lines += [line(curve, f"pressure = {pressure}") for curve in sides["top"] or sides["left"]]
    return lines + [f"  # free: {curve.name}, length {curve.length:.4g}, {curve.words()}" for curve in sides["rest"]]


def quoted(name):
    return json.dumps(name, ensure_ascii=False)


def scene(part, target):
    """The text of the scene."""
    usable = [curve for curve in part.curves if part.by_number or not curve.numbered]
    pairs = [pair for pair in part.meetings() if all(curve in usable for curve in pair.curves)]
    in_pairs = {curve.name for pair in pairs for curve in pair.curves}
    sides = sides_of(part, [curve for curve in usable if curve.name not in in_pairs])
    unit = "m" if np.ptp(np.concatenate([curve.points for curve in part.curves]), axis=0).max() < METRES else "mm"
    stress, young, pressure = STEEL[unit]
    lines = [
        f"title = {quoted(part.source.stem)}",
        f"# From {part.source.name}. Take the # off what is so, with its numbers; mortise check {target.name} says what it means.",
        f"# Lengths are in the unit of {part.source.name}. If that is {unit}, as it looks, stresses are in {stress}, forces in N.",
        "",
        f"mesh.file = {quoted(Path(os.path.relpath(part.source, target.parent)).as_posix())}",
        'model.plane = "strain"  # or "stress", or "axisymmetric": x is the radius',
        "boundary = [",
        *boundary_lines(part, sides, pressure),
        "]",
        "contact = [",
        *(f"  # {words}" for words in part.one_piece()[:MANY_BODIES]),
        *(f"  {'' if pair.close() else '# '}{entry(pair, {})},  # {gap_words(pair)}, along {pair.along:.3g}" for pair in pairs),
        "]",
        *("", "[materials.steel]", f"# young = {young}", "# poisson = 0.3"),
        *("", "[bodies]", *body_lines(part)),
        *body_force_lines(part, sides),
    ]
    return "\n".join(lines) + "\n"


def body_lines(part):
    key = lambda name: name if re.fullmatch(r"[\w-]+", name, re.ASCII) else quoted(name)
    lines = [f'{key(body)} = "steel"  # {part.size_words(k)}' for k, body in enumerate(part.bodies)]
    return lines if len(lines) <= MANY_BODIES else ['"*" = "steel"']


def body_force_lines(part, sides):
    """For bodies without a free curve to load."""
    free = {body for side in sides.values() for curve in side for body in curve.bodies}
    lone = [body for k, body in enumerate(part.bodies) if k not in free]
    blocks = [("", "# [[body_force]]  # per volume", f"# body = {quoted(body)}", "# force = [0, -1]") for body in lone]
    return [line for block in blocks if len(blocks) <= MANY_BODIES for line in block]


def main():
    parser = Parser(__doc__)
    parser.add_argument("geometry", type=Path, help=".json")
    parser.add_argument("scene", type=Path, help=".toml to write; one that is there stays")
    options = parser.parse_args()
    try:
        with options.scene.open("x") as file:
            file.write(scene(geometry.Geometry(options.geometry), options.scene))
    except OSError as error:
        sys.exit(f"mortise: error: {options.scene}: {error.strerror}")
    print(options.scene)


if __name__ == "__main__":
    run(main)
