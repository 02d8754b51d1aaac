"""The benchmarks: of each the scene, the exact pressure along the line, and how it is compared."""

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Callable

import closed_forms
import layer
import numpy as np
import persson

HERE = Path(__file__).resolve().parent

STEEL, ALUMINIUM = (210e3, 0.3), (70e3, 0.33)
SIZE = 100  # of the blocks that stand for half planes, in half widths of the contact


@dataclass(frozen=True)
class Case:
    name: str
    title: str
    source: str
    geometry: Path
    scene: str
    exact: Callable  # p at places of the line, in the scene's units
    half_width: float  # of the exact contact, along the line
    parameters: dict = field(default_factory=dict)
    sizes: tuple = (10, 20, 40, 80)
    compared: float = 1.2  # up to where on the line, in half widths
    ring: bool = False  # p is weighed by its distance from the axis
    place: str = "x"  # along the line: x, or the angle
    limit: float = 0.01  # of the error of p on the finest mesh


def modulus(*materials):
    """E*."""
    return 1 / sum((1 - nu**2) / young for young, nu in materials)


def materials(lower, upper):
    names = "".join(f"materials.{name} = {{ young = {young}, poisson = {nu} }}\n"
                    for name, (young, nu) in (("first", lower), ("second", upper)))  # fmt: skip
    return names + 'bodies = { lower = "first", upper = "second" }\n'


def blocks(pair, gap, pressure, plane="strain", head='{ on = "head", pressure = '):
    """The scene of two_blocks.geo beside its mesh."""
    return (
        f'model.plane = "{plane}"\n{materials(*pair)}boundary = [\n'
        '  { on = "axis", displacement = { x = 0 } },\n  { on = "ground", displacement = { y = 0 } },\n'
        f"  {head}{pressure} }},\n]\n"
        f'contact = [{{ between = ["lower_contact", "upper_contact"], initial_gap = {gap} }}]\n'
    )


def indented(name, title, source, indenter, pair=(STEEL, STEEL), ring=False, limit=0.01):
    star = modulus(*pair)
    area = math.pi * SIZE**2 if ring else 2 * SIZE
    scene = blocks(pair, f'"{indenter.gap}"', indenter.load * star / area, "axisymmetric" if ring else "strain")
    inside = lambda x: np.where(x < 1, star * indenter.pressure(np.minimum(x, 1 - 1e-15)), 0)
    return Case(name, title, source, HERE / "two_blocks.geo", scene, inside, 1.0, {"size": SIZE}, ring=ring, limit=limit)


def flat(name, title, source, ring=False):
    star = modulus(STEEL, STEEL)
    load = closed_forms.FLAT_LOAD * star / (math.pi * SIZE**2 if ring else 2 * SIZE)
    pressure = lambda x: star * closed_forms.FLAT_ENDS[name](x)
    scene = blocks((STEEL, STEEL), 0, load, "axisymmetric" if ring else "strain")
    parameters = {"size": SIZE, "fine": 1, "only_fine": 1}
    return Case(name, title, source, HERE / "two_blocks.geo", scene, pressure, 1.0, parameters, compared=0.9,
                ring=ring)  # fmt: skip


def receding():
    half_width, pressure = layer.solve(1)
    load = f'"x < {layer.HALF_LOAD} ? (1 - (x / {layer.HALF_LOAD})^2)^2 : 0"'
    parameters = {"size": SIZE, "fine": 2, "width": 8, "height": 1}
    return Case("receding_layer", "A layer pressed on a half plane: receding contact",
                "Keer, Dundurs & Tsai 1972; the integral equation solved anew", HERE / "two_blocks.geo",
                blocks((STEEL, STEEL), '"curve"', load), pressure, half_width, parameters, (16, 32, 64, 128))


def pin(degrees, title, plate=200):
    """Persson's pin: contact over `degrees` to either side, its clearance and load from closed form."""
    angle, force = math.radians(degrees), 40.0
    star = STEEL[0] / (1 - STEEL[1] ** 2)
    weight = force / math.pi  # of the disk of radius 1
    scene = (
        f"materials.steel = {{ young = {STEEL[0]}, poisson = {STEEL[1]} }}\n"
        'bodies = { pin = "steel", plate = "steel" }\n'
        'boundary = [\n  { on = "axis", displacement = { x = 0 } },\n'
        '  { on = "rim", displacement = { x = 0, y = 0 } },\n]\n'
        f'body_force = [{{ body = "pin", force = [0, {-weight!r}] }}]\n'
        f'contact = [{{ between = ["pin_side", "hole"] }}]\n'
    )
    parameters = {"size": plate, "clearance": persson.clearance(angle) * force / star}
    return Case(f"pin_{degrees}", title, "Persson 1964; Ciavarella & Decuzzi 2001",
                HERE.with_name("stability") / "pin.geo", scene, lambda phi: force * persson.pressure(phi, angle), angle,
                parameters, (15, 30, 60, 120), place="angle")  # fmt: skip


CASES = [
    indented("cylinder", "A cylinder on a half plane, steel on aluminium", "Hertz 1882; Johnson 1985, section 4.2",
             closed_forms.PLANE["cylinder"], (ALUMINIUM, STEEL)),
    indented("rounded_punch", "A flat punch with rounded edges", "Ciavarella, Hills & Monno 1998",
             closed_forms.PLANE["rounded_punch"]),
    indented("wedge", "A blunt wedge", "Sneddon 1951; Johnson 1985, section 5.2", closed_forms.PLANE["wedge"],
             limit=0.04),
    flat("flat_punch", "A flat punch", "Sadowsky 1928; Johnson 1985, section 2.8"),
    receding(),
    pin(30, "A pin in a hole, contact over 30 degrees to either side"),
    pin(70, "A pin in a hole, contact over 70 degrees to either side"),
    indented("sphere", "A sphere on a half space, steel on aluminium", "Hertz 1882; Johnson 1985, section 4.2",
             closed_forms.AXISYMMETRIC["sphere"], (ALUMINIUM, STEEL), True),
    indented("cone", "A blunt cone", "Love 1939, Sneddon 1965; Johnson 1985, section 5.2",
             closed_forms.AXISYMMETRIC["cone"], ring=True),
    flat("circular_punch", "A flat circular punch", "Boussinesq 1885; Johnson 1985, section 3.4", True),
]  # fmt: skip


def scene_text(case, n, changed=None):
    """The scene file, its geometry with n elements on half the contact and some parameters changed."""
    parameters = case.parameters | (changed or {}) | {"n": n}
    table = ", ".join(f"{key} = {value!r}" for key, value in parameters.items())
    return f'mesh.file = "{case.geometry}"\nmesh.parameters = {{ {table} }}\n{case.scene}'


def by_name(name):
    return next(case for case in CASES if case.name == name)


def places(case, line):
    """Of the nodes of contact.csv along the exact line, from the middle of the contact."""
    if case.place == "x":
        return line["x"]
    return np.abs(np.arctan2(line["x"], -line["y"]))


def error(case, at, p, left_out=0):
    """Root of the mean square of p - exact along the line over that of the exact p; p is linear between its nodes.

    `left_out`: the length beside the axis that is not compared."""
    end = case.compared * case.half_width
    fine = left_out + (np.arange(20000) + 0.5) / 20000 * (end - left_out)
    order = np.argsort(at)
    known = case.exact(fine)
    weights = fine if case.ring else np.ones_like(fine)
    square = lambda values: float(np.sqrt((weights * values**2).sum()))
    return square(np.interp(fine, at[order], p[order]) - known) / square(known)
