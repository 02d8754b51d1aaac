"""Scenes with exact solutions, each with what of it is compared.

A case is a geometry with its parameters, the scene beside [mesh], what is measured (a function of the results' folder
that gives the largest relative error) and its source.
"""

from dataclasses import dataclass
from math import cbrt, pi
from typing import Callable

import numpy as np

import launch

STEEL = "[materials.steel]\nyoung = 210e9\npoisson = 0.3\nthermal_expansion = 1e-5\ndensity = 7800\n"
E, NU, ALPHA = 210e9, 0.3, 1e-5


@dataclass(frozen=True)
class Case:
    name: str
    feature: str
    compared: str
    source: str
    geometry: str  # a .geo beside this file, or one of geo/
    scene: str
    measure: Callable
    sizes: tuple = (2, 4, 8, 16)
    parameters: str = ""
    exact: bool = False  # round-off is expected, no rate


def pressure_error(exact):
    """Of p at the nodes of the multiplier side, over the largest exact p. `exact`: of x and y."""

    def measure(folder):
        line = launch.contact(folder)
        known = exact(line["x"], line["y"]) + np.zeros_like(line["x"])
        return np.abs(line["p"] - known).max() / np.abs(known).max()

    return measure


def blocks(materials, extra, left=0):
    """Two blocks, one on the other, on a smooth ground; u_x on their left side."""
    return (
        f'{materials}[[boundary]]\non = ["ground"]\ndisplacement = {{ y = 0 }}\n'
        f'[[boundary]]\non = ["left"]\ndisplacement = {{ x = {left} }}\n{extra}'
        '[[contact]]\nbetween = ["lower_contact", "upper_contact"]\n'
    )


def both(lower, upper, first="steel", second="steel"):
    return f'[bodies]\n{lower} = "{first}"\n{upper} = "{second}"\n'


RINGS = '[model]\nplane = "axisymmetric"\n'
BETWEEN = '[[contact]]\nbetween = ["seat", "hole"]\n'
HELD = '[[boundary]]\non = ["bottom", "top"]\ndisplacement = { y = 0 }\n'


def lame(r, order):
    """Of 100 MPa in the bore of a tube (order 2) or a hollow sphere (3) between the radii 1 and 3."""
    return 100e6 * ((3 / r) ** order - 1) / (3**order - 1)


def shrink_fit(delta):
    """Lame, plane strain: two tubes of one material, 1 to 2 and 2 to 3, the inner one larger by delta in radius."""
    a, c, b = 1.0, 2.0, 3.0
    return E / (1 - NU**2) * delta * (c**2 - a**2) * (b**2 - c**2) / (2 * c**3 * (b**2 - a**2))


def sphere_errors(folder):
    force = pi * 48970.7517
    a = cbrt(3 * force / (4 * E / (2 * (1 - NU**2))))
    pair = launch.summary(folder)["contact"][0]
    return max(abs(pair["length_in_contact"] / a - 1), abs(pair["pressure"]["max"] / (1.5 * force / (pi * a * a)) - 1))


def contact_displacement(folder):
    """u_y of the lower body's contact nodes."""
    line = launch.contact(folder)
    upwards = -1 if line["curve"][0] == "upper_contact" else 1  # its normal points down
    return upwards * line["u_n"]


def shortening_error(folder):
    """Plane stress, 1 / E of wood at 30 degrees to its fibres across them (Jones, eq. 2.97), 1 MPa, height 1."""
    c2, s2 = 0.25, 0.75  # of the angle from y to direction 1
    compliance = c2**2 / 12e9 + (1 / 0.7e9 - 0.8 / 12e9) * c2 * s2 + s2**2 / 1e9
    return np.abs(contact_displacement(folder) / (-1e6 * compliance) - 1).max()


def sinking_error(folder):
    """Plane strain: the springs and the lower block, under 1 MPa."""
    exact = -1e6 / 1e9 - 1e6 * (1 - NU**2) / E
    return max(np.abs(contact_displacement(folder) / exact - 1).max(), pressure_error(lambda x, y: 1e6)(folder))


def flat_punch(mean):
    """Of a smooth rigid cylinder of radius 1 pressed on a half space: displacements in it as expressions, y upwards, how
    deep it sinks, and p of the radius. Green & Zerna's potential of a disc, phi = 2 C / pi atan2(1 + I, z + R) with
    R + i I = sqrt(x^2 + (z + i)^2): 2 G u_z = 2 (1 - nu) phi - z phi_z, 2 G u_x = -z phi_x - (1 - 2 nu) F_x, F_z = phi.
    """
    a = "(x^2 + y^2 - 1)"
    m = f"sqrt({a}^2 + 4 * y^2)"
    real, imaginary = f"sqrt(({m} + {a}) / 2)", f"sqrt(({m} - {a}) / 2)"
    k = mean / 4 * 2 * (1 + NU) / E  # C / (pi G)
    u_x = f"x < 1e-9 ? 0 : {k} / x * ({2 * NU - 1} * (1 - {imaginary}) - y * ({real} + y * {imaginary}) / {m})"
    u_y = f"-{k} * ({2 * (1 - NU)} * atan2(1 + {imaginary}, {real} - y) - y * {imaginary} / {m})"
    return u_x, u_y, pi * (1 - NU) * k, lambda x: mean / 2 / np.sqrt(1 - x**2)


def flat_punch_error(folder):
    """Of p at the nodes within 0.8 of the radius, to its value there, and of how deep the punch sinks."""
    *_, sinking, pressure = flat_punch(100e6)
    line = launch.contact(folder)
    inner = line["x"] < 0.8
    moved = next(s["rigid"]["displacement"][1] for s in launch.summary(folder)["model"]["supports"] if "rigid" in s)
    return max(np.abs(line["p"][inner] / pressure(line["x"][inner]) - 1).max(), abs(moved / -sinking - 1))


CASES = [
    Case("tubes", "axisymmetric", "p", "Lamé: two tubes, one in the other, pressed from within", "tubes",
         RINGS + STEEL + both("inner", "outer") + HELD + '[[boundary]]\non = ["bore"]\npressure = 100e6\n' + BETWEEN,
         pressure_error(lambda x, y: lame(2, 2))),
    Case("spheres", "axisymmetric, contact on the axis", "p", "Lamé: two hollow spheres, pressed from within", "shells",
         RINGS + STEEL + both("inner", "outer") + '[[boundary]]\non = ["equator"]\ndisplacement = { y = 0 }\n'
         '[[boundary]]\non = ["bore"]\npressure = 100e6\n' + BETWEEN,
         pressure_error(lambda x, y: lame(2, 3))),
    Case("hertz_sphere", "axisymmetric, unilateral", "half width and largest p", "Hertz: a sphere on a block",
         "../../geo/hertz", "", sphere_errors, sizes=(5, 10, 20, 40)),
    Case("flat_punch", "a rigid curve, displacements of the place", "p at r < 0.8 a, sinking",
         "Sneddon: a flat-ended cylinder on a half space", "flat_punch",
         RINGS + STEEL + both("punch", "ground") + '[[boundary]]\non = ["far"]\n'
         'displacement = {{ x = "{}", y = "{}" }}\n'.format(*flat_punch(100e6)[:2])
         + f'[[boundary]]\non = ["punch_contact"]\nrigid = {{ force = [0, {-100e6 * pi}] }}\n'
         '[[contact]]\nbetween = ["punch_contact", "ground_contact"]\n', flat_punch_error, sizes=(8, 16, 32, 64)),
    Case("interference", "initial_gap = number", "p", "Lamé: a shrink fit of two tubes", "tubes",
         RINGS + STEEL + both("inner", "outer") + HELD + BETWEEN + "initial_gap = -1e-3\n",
         pressure_error(lambda x, y: shrink_fit(1e-3))),
    Case("hot_cylinder", "temperature of the place", "p at x = c", "Timoshenko & Goodier, section 151", "tubes",
         RINGS + STEEL + both("inner", "outer") + HELD + BETWEEN
         + ''.join(f'[[initial_strain]]\nbody = "{body}"\ntemperature_change = "100 * (1 - x^2)"\n'
                   for body in ("inner", "outer")),
         pressure_error(lambda x, y: E * ALPHA * 100 / (4 * (1 - NU)) * (1 - 0.25)),
         parameters="r0 = 0, c = 0.5, r1 = 1, height = 0.25"),
    Case("rotating_cylinder", "body force of the place", "p at x = c, tension", "Timoshenko & Goodier, section 32", "tubes",
         RINGS + STEEL + both("inner", "outer") + HELD + BETWEEN + 'condition = "bilateral"\n'
         + ''.join(f'[[body_force]]\nbody = "{body}"\nforce = ["7800 * 100^2 * x", 0]\n' for body in ("inner", "outer")),
         pressure_error(lambda x, y: -(3 - 2 * NU) / (8 * (1 - NU)) * 7800 * 1e4 * (1 - 0.25)),
         parameters="r0 = 0, c = 0.5, r1 = 1, height = 0.25"),
    Case("linear_pressure", "pressure and displacement of the place", "p", "linear stress: sigma_yy = -(1 + x) MPa",
         "blocks", blocks(STEEL + both("lower", "upper"), '[[boundary]]\non = ["head"]\npressure = "1e6 * (1 + x)"\n',
                          f'"1e6 * (1 - {NU}^2) / {E} * y^2 / 2"'),
         pressure_error(lambda x, y: 1e6 * (1 + x)), exact=True),
    Case("gravity", "gravity and density", "p", "weight of the upper block over its area", "blocks",
         '[model]\ngravity = [0, -9.81]\n' + blocks(STEEL.replace("0.3", "0") + both("lower", "upper"), ""),
         pressure_error(lambda x, y: 7800 * 9.81 * 0.5), exact=True),
    Case("orthotropic", "young = [E1, E2, E3] at an angle", "shortening", "uniform stress: S_22 sigma_yy", "blocks",
         "[materials.wood]\nyoung = [12e9, 1e9, 0.8e9]\npoisson = [0.4, 0.35, 0.5]\nshear = 0.7e9\nangle = 30\n"
         + both("lower", "upper", "wood", "wood") + '[model]\nplane = "stress"\n[[boundary]]\non = ["ground"]\n'
         'displacement = { y = 0 }\n[[boundary]]\non = ["head"]\npressure = 1e6\n'
         '[[contact]]\nbetween = ["lower_contact", "upper_contact"]\n', shortening_error, exact=True),
    Case("foundation", "springs under a curve", "p and sinking", "pressure over the modulus", "blocks",
         STEEL + both("lower", "upper") + '[[boundary]]\non = ["ground"]\nfoundation = 1e9\n'
         '[[boundary]]\non = ["left"]\ndisplacement = { x = 0 }\n[[boundary]]\non = ["head"]\npressure = 1e6\n'
         '[[contact]]\nbetween = ["lower_contact", "upper_contact"]\n', sinking_error, exact=True),
    Case("sector", "displacement along the normal, tied curves", "p", "Lamé: sectors of two tubes, the outer one tied of two",
         "sector", STEEL + '[bodies]\ninner = "steel"\nouter = "steel"\nrim = "steel"\n'
         '[[boundary]]\non = "ends"\ndisplacement = { normal = 0 }\n[[boundary]]\non = "bore"\npressure = 100e6\n'
         '[[contact]]\nbetween = ["inner_seat", "outer_hole"]\n'
         '[[contact]]\nbetween = ["outer_seat", "rim_hole"]\ncondition = "tied"\n',
         pressure_error(lambda x, y: lame(2, 2))),
    Case("rigid_head", "a rigid curve with force and moment", "p", "linear stress: sigma_yy = -(1 + x) MPa, nu = 0", "blocks",
         blocks(STEEL.replace("0.3", "0") + both("lower", "upper"),
                f'[[boundary]]\non = ["head"]\nrigid = {{ x = {1e6 / E * 1.5**2 / 2}, force = [0, -4e6], moment = {-2e6 / 3} }}\n',
                f'"1e6 / {E} * y^2 / 2"'),
         pressure_error(lambda x, y: 1e6 * (1 + x)), exact=True),
    Case("total_force", "force on a curve", "p", "force over the area", "blocks",
         blocks(STEEL + both("lower", "upper"), '[[boundary]]\non = ["head"]\nforce = [0, -3e6]\n'),
         pressure_error(lambda x, y: 1.5e6), exact=True),
]  # fmt: skip


def by_name(name):
    return next(case for case in CASES if case.name == name)
