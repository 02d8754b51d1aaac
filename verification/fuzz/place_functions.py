"""Functions of place with a feature that a mesh may miss, as text for a scene; the generator knows where it is."""

import math
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

import graded_grid


class Mark(NamedTuple):
    """What a reference mesh must resolve along one axis: vertices `size` apart up to `reach` from `at`."""

    at: float
    size: float
    reach: float = 0.0
    vertex: bool = False  # one stands at `at`


@dataclass
class Feature:
    name: str
    text: str  # of x and y, about 1 at its largest
    width: float  # 1 where it is everywhere
    x: list = field(default_factory=list)  # marks
    y: list = field(default_factory=list)
    steepest: float = 1.0  # the largest slope, 1 / length

    def finest(self):
        return min([mark.size for mark in self.x + self.y], default=1.0)

    def at(self, x):
        """Its values at places x; of features along x only."""
        names = {"x": x, "exp": np.exp, "abs": np.abs, "max": np.maximum}
        return eval(self.text.replace("^", "**"), {"__builtins__": {}}, names)


JUMP = 2e-5  # of the length: vertices beside a jump
PER_WIDTH = 10  # vertices a width of a spike, 5 of the coarser reference


def jump(at):
    return Mark(at, JUMP, 0.0, True)


def smooth(at, width):
    return Mark(at, width / PER_WIDTH, 3 * width)


def spike(r, a, w):
    return Feature("spike", f"exp(-((x - {a!r}) / {w!r})^2)", w, [smooth(a, w)], steepest=0.86 / w)


def step(r, a, w):
    return Feature("step", f"(x < {a!r} ? 1 : 0)", 1.0, [jump(a)])


def box(r, a, w):
    return Feature("box", f"(abs(x - {a!r}) < {w!r} ? 1 : 0)", 2 * w, [jump(a - w), jump(a + w)])


def hat(r, a, w):
    return Feature("hat", f"max(0, 1 - abs(x - {a!r}) / {w!r})", w, [jump(a - w), jump(a), jump(a + w)], steepest=1 / w)


def wave(r, a, w):
    count = r.randint(3, 12)
    evenly = Mark(a, 1 / (24 * count), 1.0)
    return Feature("wave", f"sin({2 * math.pi * count!r} * (x - {a!r}))", 1.0, [evenly], steepest=2 * math.pi * count)


def spot(r, a, w, b):
    text = f"exp(-((x - {a!r})^2 + (y - {b!r})^2) / {w!r}^2)"
    return Feature("spot", text, w, [smooth(a, w)], [smooth(b, w)], steepest=0.86 / w)


def block(r, a, w, b):
    text = f"(abs(x - {a!r}) < {w!r} && abs(y - {b!r}) < {w!r} ? 1 : 0)"
    return Feature("block", text, 2 * w, [jump(a - w), jump(a + w)], [jump(b - w), jump(b + w)])


def layer(r, a, w, b):
    return Feature("layer", f"(y < {b!r} ? 1 : 0)", 1.0, [], [jump(b)])


ALONG, SMOOTH = (spike, spike, step, box, hat, wave), (spike, spike, wave)  # of x; without jumps
INSIDE = (spot, spot, block, layer, spike, step, box)


def draw(r, makers, narrowest, start, heights):
    """One of the makers' features, along x from `start` to start + 1; `heights`: of the body in which it stands."""
    make, w = r.choice(makers), 10 ** r.uniform(math.log10(narrowest), -1)
    a = start + r.uniform(max(0.08, 1.2 * w), min(0.92, 1 - 1.2 * w))
    if make not in (spot, block, layer):
        return make(r, a, w)
    below, above = heights
    w = min(w, 0.3 * (above - below))
    ends = (below + 1.2 * w, above - 1.2 * w)  # near one of them, or anywhere between
    return make(r, a, w, r.choice((*ends, r.uniform(*ends))))


def sampled(feature, start, top):
    """The feature as a field `f` of a table of points, in two rows of the same values, between which it is linear in x."""
    x = graded_grid.lines(start - 0.01, start + 1.01, feature.x, 0.05)
    rows = [f"{x!r},{y!r},{f!r}" for x, f in zip(x.tolist(), feature.at(x).tolist()) for y in (-0.1, top + 0.1)]
    return replace(feature, text="f"), "\n".join(["x,y,f", *rows, ""]).encode()
