"""What a geometry or a mesh has that a scene can name (src/results/setup_json.hpp): bodies, curves, and which curves meet."""

import json
import re
import sys
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.with_name("pictures")))

from drawn_curves import lines_of

MEET = 0.01  # of the shorter curve: a gap that is a fit, no distance
NEAR = 0.05  # the same of one that a load may close
MANY_PLACES = 400  # of a curve, when it is held against others


@dataclass
class Curve:
    name: str
    bodies: list  # their numbers; several where it goes on along, or is shared by, them
    points: np.ndarray  # along it, with its body on the left
    length: float
    numbered: bool  # without a name of its own

    @property
    def straight(self):
        return bool(np.linalg.norm(self.points[-1] - self.points[0]) >= (1 - 1e-9) * self.length)

    def circle(self):
        """Centre and radius, where it is an arc, else None."""
        x = self.points - self.points.mean(axis=0)
        solved = np.linalg.lstsq(np.column_stack([x, np.ones(len(x))]), (x**2).sum(axis=1), rcond=None)[0]
        centre, radius = solved[:2] / 2, np.sqrt(solved[2] + (solved[:2] ** 2).sum() / 4)
        off = np.abs(np.linalg.norm(x - centre, axis=1) - radius).max()
        return (centre + self.points.mean(axis=0), radius) if off < 1e-3 * radius and not self.straight else None

    def words(self):
        start, end = (place(at) for at in self.points[[0, -1]])
        if self.straight:
            return f"straight, {start} to {end}"
        circle = self.circle()
        round_ = f"radius {circle[1]:.4g} round {place(circle[0])}" if circle else "curved"
        return f"closed, {round_}" if start == end else f"{round_}, {start} to {end}"


@dataclass
class Meeting:
    curves: tuple
    gap: float  # the least, negative where they overlap as drawn
    along: float  # length over which they face each other so near
    known: float  # how well the gap is, which is that of short straight pieces

    def close(self):
        return abs(self.gap) <= MEET * min(curve.length for curve in self.curves)


def numbered(name):
    """Whether mortise has called it so, by the number that it has in its file."""
    return bool(re.fullmatch(r"(curve|surface)_\d+", name))


def place(at):
    return "({:.4g}, {:.4g})".format(*(np.round(at, 11) + 0.0))


class Geometry:
    def __init__(self, path):
        self.json = json.loads(Path(path).read_text())
        self.source = Path(self.json["source"])
        self.nodes = np.array(self.json["nodes"])
        self.bodies = [body["name"] for body in self.json["bodies"]]
        curves = [curve_of(self.nodes, name, edges) for name, edges in self.json["curves"].items()]
        number = lambda curve: [int(word) if word.isdigit() else word for word in re.split(r"(\d+)", curve.name)]
        self.curves = sorted(curves, key=lambda curve: (curve.bodies, curve.numbered, number(curve)))

    @property
    def by_number(self):
        """Whether a scene can name the curves that have only a number: where the file names no curve (docs/files.md)."""
        return all(curve.numbered for curve in self.curves)

    def box(self, body):
        """Lower left and upper right corner of a body."""
        nodes = {node for cell in self.json["bodies"][body]["cells"] for node in cell}
        at = np.concatenate([self.nodes[list(nodes)], *(curve.points for curve in self.curves if curve.bodies == [body])])
        return at.min(axis=0), at.max(axis=0)

    def size_words(self, body):
        low, high = self.box(body)
        return "{:.4g} x {:.4g}, centre {}".format(*(high - low), place((low + high) / 2))

    def meetings(self):
        """Pairs of curves of different bodies that face each other at no distance or a small one."""
        found = [meeting(a, b) for a, b in combinations(self.curves, 2) if not set(a.bodies) & set(b.bodies)]
        return [pair for pair in found if pair]


def curve_of(nodes, name, edges):
    lines = lines_of(nodes, edges)
    points = np.concatenate([lines[0], *(line[1:] if np.array_equal(line[0], before[-1]) else line for before, line in zip(lines, lines[1:]))])
    length = sum(np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in lines)
    return Curve(name, sorted({edge[3] for edge in edges}), points, float(length), numbered(name))


def pieces(curve):
    """Middles, outward normals and lengths of short straight pieces of a curve; of an arc as on it."""
    s = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(curve.points, axis=0), axis=1))])
    at = np.union1d(s, np.linspace(0, s[-1], 241))
    at = at[:: len(at) // MANY_PLACES + 1]
    ends = np.stack([np.interp(at, s, x) for x in curve.points.T], axis=1)
    step = np.diff(ends, axis=0)
    length = np.linalg.norm(step, axis=1)
    kept = length > 1e-9 * s[-1]
    step, length = step[kept], length[kept]
    middles, normals = (ends[:-1] + ends[1:])[kept] / 2, np.stack([step[:, 1], -step[:, 0]], axis=1) / length[:, None]
    if circle := curve.circle():
        out = (middles - circle[0]) / np.linalg.norm(middles - circle[0], axis=1)[:, None]
        middles, normals = circle[0] + circle[1] * out, out * np.sign((out * normals).sum(axis=1))[:, None]
    return middles, normals, length


def arrow(curve, normals, lengths):
    """How far a curve may lie from its pieces, by how they turn."""
    turns = np.linalg.norm(np.diff(normals, axis=0), axis=1)
    return float(max((turns * lengths[1:])[turns < 0.5].max(initial=0) / 8, 1e-6 * curve.length))


def meeting(a, b):
    """How near the outsides of two curves come to each other, along their normals; None: not near."""
    near = NEAR * min(a.length, b.length)
    if (np.maximum(a.points.min(axis=0), b.points.min(axis=0)) - np.minimum(a.points.max(axis=0), b.points.max(axis=0))).max() > near:
        return None
    (x, n, dx), (y, m, dy) = pieces(a), pieces(b)
    gap = np.einsum("jk,ijk->ij", m, x[:, None] - y[None])  # of a's pieces over b's
    across = np.linalg.norm(x[:, None] - y[None] - gap[..., None] * m[None], axis=2)
    facing = (n @ m.T < -0.7) & (np.abs(gap) <= near) & (across <= dx[:, None] / 2 + dy[None] / 2)
    along = min(dx[facing.any(axis=1)].sum(), dy[facing.any(axis=0)].sum())
    if along < NEAR * min(a.length, b.length):
        return None
    opposite = np.where(facing, across, np.inf).argmin(axis=1)  # of each piece, that which it faces most squarely
    gaps = gap[np.arange(len(x)), opposite][facing.any(axis=1)]
    return Meeting((a, b), float(gaps[np.abs(gaps).argmin()]), float(along), arrow(a, n, dx) + arrow(b, m, dy))
