"""What is known of the charted problems: exact stresses, and the exact or a reference pressure along the line."""

from dataclasses import dataclass
from typing import Callable

import numpy as np

import manufactured  # makes common/ known
from lame import RINGS, lame


@dataclass
class Known:
    """None where nothing is known. `materials`: E and nu of each body, plane strain."""

    materials: list
    stress: Callable = None  # (xx, yy, xy) of x, y and the body's number
    pressure: Callable = None  # of x, y on the line


def of_manufactured():
    _, stress = manufactured.field()

    def pressure(x, y):
        (xx, yy, xy), slope = (s(x, y) for s in stress), manufactured.SLOPE(x, y)
        return -(slope**2 * xx - 2 * slope * xy + yy) / (1 + slope**2)

    both = [(manufactured.YOUNG, manufactured.POISSON)] * 2
    return Known(both, lambda x, y, body: [s(x, y) for s in stress], pressure)


def of_rings():
    exact, rings = lame(RINGS["materials"])
    A, B = (np.array([ring[k] for ring in rings]) for k in (0, 1))

    def stress(x, y, body):
        mean, half = A[body], B[body] / (x**2 + y**2) ** 2
        return mean - half * (x**2 - y**2), mean + half * (x**2 - y**2), -2 * half * x * y

    return Known(RINGS["materials"], stress, lambda x, y: exact)


def of_parabola_1(reference):
    """`reference`: a CSV of x,p along the line, or None."""
    if reference is None:
        return Known([])
    x, p = np.loadtxt(reference, delimiter=",", skiprows=1).T
    return Known([], None, lambda at, _: np.interp(at, x, p))


def known(problem, reference=None):
    return {"manufactured": of_manufactured, "rings": of_rings}.get(problem, lambda: of_parabola_1(reference))()
