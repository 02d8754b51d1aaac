"""Pressures of frictionless contact of half planes and half spaces, in closed form, with the half width a = 1.

Lengths in units of a. A body of profile f on a half plane: two half planes with the gap f and E* of both,
1 / E* = sum (1 - nu^2) / E. `load` is the force on the whole contact (per thickness in the plane).
"""

from dataclasses import dataclass
from math import asin, pi
from typing import Callable

import numpy as np

RADIUS, SLOPE, FLAT = 200.0, 0.005, 0.5  # of cylinder, sphere, rounded edges; of wedge and cone; half the flat width


@dataclass(frozen=True)
class Indenter:
    gap: str  # f as an expression of x, for a scene
    slope: Callable  # f'(x), an array
    load: float  # over E*
    pressure: Callable  # p(x) / E*, an array, for 0 < x < 1


def cylinder_pressure(x):
    """Hertz 1882; Johnson, Contact Mechanics (1985), eqs. 4.43 to 4.45."""
    return np.sqrt(1 - x**2) / (2 * RADIUS)


def sphere_pressure(x):
    """Hertz 1882; Johnson, eqs. 4.22 to 4.24."""
    return 2 / (pi * RADIUS) * np.sqrt(1 - x**2)


def wedge_pressure(x):
    """Sneddon 1951; Johnson, eq. 5.114."""
    return SLOPE / pi * np.arccosh(1 / x)


def cone_pressure(x):
    """Love 1939, Sneddon 1965; Johnson, eq. 5.116."""
    return SLOPE / 2 * np.arccosh(1 / x)


ANGLE = asin(FLAT)
ROUNDED_LOAD = (pi - 2 * ANGLE - np.sin(2 * ANGLE)) / (4 * RADIUS)


def rounded_pressure(x):
    """Ciavarella, Hills & Monno, Proc. Inst. Mech. Eng. C 212 (1998) 319-328: flat, with round edges; x = sin(phi)."""
    phi, t = np.arcsin(x), ANGLE
    first = np.abs(np.sin(phi + t) / np.sin(phi - t)) ** np.sin(phi)
    second = np.abs(np.tan((phi + t) / 2) * np.tan((phi - t) / 2)) ** np.sin(t)
    scale = 2 * ROUNDED_LOAD / (pi * (pi - 2 * t - np.sin(2 * t)))
    return scale * ((pi - 2 * t) * np.cos(phi) + np.log(first * second))


PLANE = {
    "cylinder": Indenter(f"x^2 / {2 * RADIUS}", lambda x: x / RADIUS, pi / (4 * RADIUS), cylinder_pressure),
    "rounded_punch": Indenter(
        f"x < {FLAT} ? 0 : (x - {FLAT})^2 / {2 * RADIUS}",
        lambda x: np.maximum(x - FLAT, 0) / RADIUS,
        ROUNDED_LOAD,
        rounded_pressure,
    ),
    "wedge": Indenter(f"{SLOPE} * x", lambda x: SLOPE + 0 * x, SLOPE, wedge_pressure),
}
AXISYMMETRIC = {
    "sphere": Indenter(f"x^2 / {2 * RADIUS}", lambda x: x / RADIUS, 4 / (3 * RADIUS), sphere_pressure),
    "cone": Indenter(f"{SLOPE} * x", lambda x: SLOPE + 0 * x, pi * SLOPE / 2, cone_pressure),
}
# Flat ends touch where they are flat: the load is free.
FLAT_LOAD = 0.005
FLAT_ENDS = {
    "flat_punch": lambda x: FLAT_LOAD / (pi * np.sqrt(1 - x**2)),  # Sadowsky 1928; Johnson, eq. 2.64
    "circular_punch": lambda x: FLAT_LOAD / (2 * pi * np.sqrt(1 - x**2)),  # Boussinesq 1885; Johnson, eq. 3.34
}
