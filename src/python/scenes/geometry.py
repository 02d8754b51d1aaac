"""What a geometry or a mesh has that a scene can name (src/results/setup_json.hpp): bodies, curves, and which curves meet."""

import json
import re
import sys
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from pathlib import Path

import numpy as np
from numpy.polynomial import chebyshev

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
    arcs: np.ndarray  # n x 9 x 2: coefficients of Chebyshev's polynomials, from -1 to 1 along each arc

    def on(self, u):
        """The same places' u on the curve: of a closed one any, of others none beyond an end."""
        count = len(self.arcs)
        return np.mod(u, count) if np.array_equal(self.points[0], self.points[-1]) else np.clip(u, 0, count)

    def at(self, u):
        """Places where u = k + 1/2 is the middle of arc k, and is so for all u of a closed curve."""
        count, u = len(self.arcs), self.on(u)
        k = np.minimum(u.astype(int), count - 1)
        T = chebyshev.chebvander(2 * (u - k) - 1, self.arcs.shape[1] - 1)
        return np.einsum("ij,ijk->ik", T, self.arcs[k])

    @cached_property
    def samples(self):
        u = np.linspace(0, len(self.arcs), 8 * len(self.arcs) + 1)
        return u, self.at(u)

    def near(self, x):
        """For each of some places a u near that of the curve's nearest place."""
        u, places = self.samples
        return u[np.linalg.norm(places - x[:, None], axis=2).argmin(axis=1)]

    def unknown(self):
        """How far the curve may lie from its arcs, which are those of a mesh: by how they turn where they meet."""
        ends = [chebyshev.chebval(end, chebyshev.chebder(np.moveaxis(self.arcs, 1, 0))).T for end in (-1, 1)]
        before, behind = ends[1][:-1], ends[0][1:]
        lengths = [np.maximum(np.linalg.norm(tangents, axis=1), 1e-300) for tangents in (before, behind)]
        turns = np.linalg.norm(before / lengths[0][:, None] - behind / lengths[1][:, None], axis=1)
        return float((turns * 2 * lengths[1])[turns < 0.5].max(initial=0) / 8 + 1e-9 * np.abs(self.points).max())

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
    known: float  # how well the gap is: as well as the curves are

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

    def one_piece(self):
        """Bodies that share nodes, two a line: no contact can be between them."""
        owner, shared = {}, {}
        for k, body in enumerate(self.json["bodies"]):
            for node in {node for cell in body["cells"] for node in cell}:
                if owner.setdefault(node, k) != k:
                    shared.setdefault((owner[node], k), []).append(node)
        needs = "one piece; contact between them needs a curve for each (no BooleanFragments or Coherence)"
        return [f"{self.bodies[a]}, {self.bodies[b]}: share {len(nodes)} node{'s' * (len(nodes) > 1)} near {place(self.nodes[sorted(nodes)[len(nodes) // 2]])}, {needs}"
                for (a, b), nodes in shared.items()]  # fmt: skip

    def meetings(self):
        """Pairs of curves of different bodies that face each other at no distance or a small one."""
        found = [meeting(a, b) for a, b in combinations(self.curves, 2) if not set(a.bodies) & set(b.bodies)]
        return [pair for pair in found if pair]


def curve_of(nodes, name, edges):
    return curve_through(name, sorted({edge[3] for edge in edges}), lines_of(nodes, edges))


def curve_through(name, bodies, lines):
    """The curve of lines of points as lines_of has them, one behind another."""
    points = np.concatenate([lines[0], *(line[1:] if np.array_equal(line[0], before[-1]) else line for before, line in zip(lines, lines[1:]))])
    arcs = np.array([arc for line in lines for arc in polynomials(line)])
    length = sum(np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in lines)
    return Curve(name, bodies, points, float(length), numbered(name), arcs)


def polynomials(line):
    """Coefficients of the arcs of an edge, from its points: where it is as drawn, nine a piece, at -cos(pi k / 8)
    (src/mesh/edge_samples.hpp); else seven evenly spaced ones of a polynomial of degree two."""
    if len(line) % 9 == 0:
        at, pieces = -np.cos(np.pi * np.arange(9) / 8), np.split(line, len(line) // 9)
        return [chebyshev.chebfit(at, piece, 8) for piece in pieces]
    return [np.pad(chebyshev.chebfit(np.linspace(-1, 1, len(line)), line, 2), ((0, 6), (0, 0)))]


def pieces(curve):
    """Middles, outward normals and lengths of short straight pieces of a curve."""
    s = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(curve.points, axis=0), axis=1))])
    at = np.union1d(s, np.linspace(0, s[-1], 241))
    at = at[:: len(at) // MANY_PLACES + 1]
    ends = np.stack([np.interp(at, s, x) for x in curve.points.T], axis=1)
    step = np.diff(ends, axis=0)
    length = np.linalg.norm(step, axis=1)
    kept = length > 1e-9 * s[-1]
    step, length = step[kept], length[kept]
    return (ends[:-1] + ends[1:])[kept] / 2, np.stack([step[:, 1], -step[:, 0]], axis=1) / length[:, None], length


def nearest(function, at, known):
    """Parameters of the least values of a function, known so well: on finer and finer grids round some near them."""
    half = 0.5
    while half > known:
        grid = at[:, None] + np.linspace(-half, half, 9)
        at, half = grid[np.arange(len(at)), function(grid).argmin(axis=1)], half / 3
    return at


def gaps_to(b, x):
    """How far places lie before b, along its normals (negative: behind it); infinite beyond its ends."""
    places = lambda v: b.at(v.ravel()).reshape(*v.shape, 2)
    v = b.on(nearest(lambda v: np.linalg.norm(places(v) - x[:, None], axis=2), b.near(x), 1e-9))  # at an end, not behind it
    across, along = x - places(v), places(v + 1e-6) - places(v - 1e-6)
    along /= np.linalg.norm(along, axis=1)[:, None]
    beyond = np.abs((across * along).sum(axis=1)) > 1e-3 * np.linalg.norm(across, axis=1) + 1e-7 * b.length
    return np.where(beyond, np.inf, across[:, 0] * along[:, 1] - across[:, 1] * along[:, 0])


def least_gap(a, b, x):
    """The least gap between two curves near a place x of a."""
    gaps = lambda u: gaps_to(b, a.at(u.ravel())).reshape(u.shape)
    return float(gaps(nearest(gaps, a.near(x[None]), 1e-6))[0])


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
    gap = least_gap(a, b, x[facing.any(axis=1)][gaps.argmin()])
    return Meeting((a, b), gap, float(along), a.unknown() + b.unknown())
