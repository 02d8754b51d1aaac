"""Contact points with the gap and the normals of the curves that two straight-sided meshes stand for.

FreeFEM's scripts read them instead of their own. A contact point is a normal of the multiplier side's curve: it passes
through the place on that side's edge, through the one on the opposite edge, and through both curves, whose distance
along it is the gap (docs/theory.md, section 9). Two curves that their vertices cannot tell from one are one: they have
no gap. Written from these definitions, not from mortise.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from cases import StudyError

LEAST_KINK, KINK, SURE_KINK = np.radians([0.1, 20, 60])  # a vertex between edges that turn by more
NEAR_VERTEX = 5e-10  # of an edge's length
BEYOND = 0.25  # of its length: how far the curve of an edge goes on beyond the edge's ends
PIECES = 30  # of an edge and what is beyond: a cubic has at most three feet of a point, and a twentieth apart they are one


@dataclass
class Chain:
    """A contact curve of one mesh: its vertices, the body on the left, and the cubic of each edge."""

    x: np.ndarray  # vertices x 2
    cubics: np.ndarray  # edges x 4 x 2: coefficients of 1, t, t^2, t^3, t from 0 to 1

    def place(self, edge, t):
        return (1 - t) * self.x[edge] + t * self.x[edge + 1]

    def curve(self, edge, t):
        return np.power.outer(t, np.arange(4)) @ self.cubics[edge]

    def tangent(self, edge, t):
        return np.power.outer(t, np.arange(3)) @ (self.cubics[edge][1:] * [[1], [2], [3]])

    def normal(self, edge, t):
        """Out of the body."""
        x, y = self.tangent(edge, t) / np.linalg.norm(self.tangent(edge, t))
        return np.array([y, -x])


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


# ---- The curve through the vertices ----


def is_closed(x):
    return (x[0] == x[-1]).all()


def inner_kinks(x):
    """Vertices between the ends at which the curve turns: much more than at those beside, or by more than 60 degrees."""
    along = np.diff(x, axis=0)
    turn = np.abs(np.arctan2(cross(along[:-1], along[1:]), np.sum(along[:-1] * along[1:], axis=1)))
    beside = np.minimum(np.append(np.inf, turn[:-1]), np.append(turn[1:], np.inf))
    alike = np.isfinite(beside) & (turn < 3 * beside) & (turn < SURE_KINK)
    most = np.maximum(np.append(0, turn[:-1]), np.append(turn[1:], 0))
    inner = (np.arange(len(turn)) > 0) & (np.arange(len(turn)) < len(turn) - 1)
    alone = inner & (turn > LEAST_KINK) & (turn > 3 * most)
    return 1 + np.flatnonzero((turn > KINK) & ~alike | alone)


def kinks(x):
    """Of an open curve the inner ones; of a closed one all, its start as 0."""
    if not is_closed(x):
        return inner_kinks(x)
    found = inner_kinks(np.concatenate([x[-3:-1], x, x[1:3]])) - 2
    return found[(found >= 0) & (found < len(x) - 1)]


def tangents(x):
    """At vertices of a smooth curve, by the length along the chords: of the polynomials through seven of them."""
    s = np.append(0, np.cumsum(np.linalg.norm(np.diff(x, axis=0), axis=1)))
    found = []
    for k in range(len(x)):
        first = max(0, min(k - 3, len(x) - 7))
        near = slice(first, first + 7)
        fits = [np.polynomial.Polynomial.fit(s[near], part, len(s[near]) - 1) for part in x[near].T]
        found.append([fit.deriv()(s[k]) for fit in fits])
    return np.array(found)


def smooth_cubics(x, slope):
    """Of each edge: Hermite's, with these tangents at its ends."""
    length = np.linalg.norm(np.diff(x, axis=0), axis=1)[:, None]
    a, b, ta, tb = x[:-1], x[1:], length * slope[:-1], length * slope[1:]
    return np.stack([a, ta, 3 * (b - a) - 2 * ta - tb, 2 * (a - b) + ta + tb], axis=1)


def chain_through(x):
    """The curve through vertices, smooth between its kinks; of a closed one across its start too."""
    turns = kinks(x)
    if is_closed(x) and len(turns) == 0:
        return Chain(x, smooth_cubics(x, tangents(np.concatenate([x[-4:-1], x, x[1:4]]))[3:-3]))
    start = turns[0] if is_closed(x) else 0
    from_start, ends = np.concatenate([x[start:], x[1 : start + 1]]), sorted({0, *(turns - start), len(x) - 1})
    parts = [from_start[a : b + 1] for a, b in zip(ends, ends[1:])]
    return Chain(x, np.roll(np.concatenate([smooth_cubics(part, tangents(part)) for part in parts]), start, axis=0))


def vertices_of(body, label):
    """Those of a curve of a body, which is on its left, in the order of FreeFEM's scripts; of a closed one the first again."""
    named = set(map(tuple, np.sort(body.edges[body.labels == label], axis=1)))
    sides = np.concatenate([body.triangles[:, [0, 1]], body.triangles[:, [1, 2]], body.triangles[:, [2, 0]]])
    following = {a: b for a, b in sides if (min(a, b), max(a, b)) in named}
    starts = set(following) - set(following.values())
    if len(starts) > 1:
        raise StudyError(f"the contact curve of '{body.name}' has {len(starts)} starts; expected 1")
    order = [min(starts or following)]
    for _ in following:
        order.append(following[order[-1]])
    return body.points[order]


# ---- From one side to the other ----


def zeros(function):
    """The coordinates near an edge at which it changes its sign."""
    near = np.linspace(-BEYOND, 1 + BEYOND, PIECES + 1)
    positive = function(near) > 0
    return [zero(function, *near[k : k + 2]) for k in np.flatnonzero(positive[1:] != positive[:-1])]


def zero(function, *ends):
    """Between two coordinates; the better of them where the function is round-off at one."""
    if function(ends[0]) * function(ends[1]) > 0:
        return min(ends, key=lambda t: abs(function(t)))
    # At worst it takes the square of the 50 steps of bisection (Brent 1973, section 4.4).
    return brentq(function, *ends, xtol=1e-15, rtol=1e-15, maxiter=2500)


def foot(chain, edge, x):
    """The nearest place whose normal on an edge's curve passes through x, None where there is none near the edge."""
    found = zeros(lambda t: np.sum((x - chain.curve(edge, t)) * chain.tangent(edge, t), axis=-1))
    return min(found, key=lambda t: np.linalg.norm(x - chain.curve(edge, t)), default=None)


def crossing(chain, edge, x, n, at):
    """The place nearest to `at` in which an edge's curve meets the line through x along n, None where there is none."""
    return min(zeros(lambda t: cross(chain.curve(edge, t) - x, n)), key=lambda t: abs(t - at), default=None)


def facing(opposite, x, n):
    """The nearest edge of a chain of vertices that faces x along n, the coordinate on it and the distance along n; None
    where there is none."""
    along, to = np.diff(opposite, axis=0), opposite[:-1] - x
    across = cross(along, n)
    with np.errstate(divide="ignore", invalid="ignore"):
        t, distance = -cross(to, n) / across, cross(along, to) / across
    faces = (across > 1e-12) & (t > -NEAR_VERTEX) & (t < 1 + NEAR_VERTEX)
    faces &= distance > -np.linalg.norm(along, axis=1)
    if not faces.any():
        return None
    edge = int(np.argmin(np.where(faces, np.abs(distance), np.inf)))
    return edge, t[edge], distance[edge]


def cuts(chain, edge, opposite):
    """Coordinates on an edge at which its curve's normals pass through the opposite vertices that it faces."""
    a, along = chain.x[edge], chain.x[edge + 1] - chain.x[edge]
    found = {0.0, 1.0}
    for number, vertex in enumerate(opposite.x):
        t = foot(chain, edge, vertex)
        if t is None:
            continue
        n = chain.normal(edge, t)
        s = cross(vertex - a, n) / cross(along, n)
        hit = facing(opposite.x, a + s * along, n)
        if hit and hit[0] in (number - 1, number) and NEAR_VERTEX < s < 1 - NEAR_VERTEX:
            found.add(float(s))
    return sorted(found)


def contact_points(chain, opposite, gauss):
    """Rows: edge and place on it (0 to 1), weight times length, the normal, opposite edge and place, gap."""
    at, weight = np.polynomial.legendre.leggauss(gauss)
    rows = []
    for edge, length in enumerate(np.linalg.norm(np.diff(chain.x, axis=0), axis=1)):
        ends = cuts(chain, edge, opposite)
        for a, b in zip(ends, ends[1:]):
            for s, w in zip(a + (b - a) * (1 + at) / 2, (b - a) * length * weight / 2):
                x = chain.place(edge, s)
                here = foot(chain, edge, x)
                if here is None:
                    raise StudyError(f"no normal of the contact curve passes through its edge near ({x[0]:.6g}, {x[1]:.6g}); expected shorter edges there")
                n = chain.normal(edge, here)
                hit = facing(opposite.x, x, n)
                if hit is None:
                    continue
                there = crossing(opposite, hit[0], x, n, hit[1])
                if there is None:  # n passes the curve by beside the edge, as at the end of a half circle
                    continue
                gap = (opposite.curve(hit[0], there) - chain.curve(edge, here)) @ n
                rows.append([edge, s, w, *n, *hit[:2], gap])
    return np.array(rows)


def sagittas(x):
    """Of each edge, how far a curve that turns as its vertices say may lie from it: h turn / 8 (theory, eq. 28)."""
    along = np.diff(x, axis=0)
    angle = np.unwrap(np.arctan2(along[:, 1], along[:, 0]))
    turns = np.abs(np.diff(angle))
    turn = np.maximum(np.append(turns, 0), np.append(0, turns))
    return np.linalg.norm(along, axis=1) * turn / 8


def close_one_line(rows, first, second):
    """No gaps (rows as of contact_points) if none is larger than what two meshes of one curve show."""
    shown = sagittas(first)[rows[:, 0].astype(int)] + sagittas(second)[rows[:, 5].astype(int)]
    if (np.abs(rows[:, 7]) <= shown).all():
        rows[:, 7] = 0


def points_of_pairs(pairs, gauss):
    """The points of all pairs (vertices of the multiplier side, of the opposite side); edges are counted over all."""
    rows, edges = [], 0
    for sides in pairs:
        found = contact_points(*map(chain_through, sides), gauss)
        close_one_line(found, *sides)
        found[:, 0] += edges
        found[:, 5] += edges + len(sides[0]) - 1
        edges += sum(len(x) - 1 for x in sides)
        rows.append(found)
    return np.concatenate(rows)


def save(points, path):
    """The file that freefem/contact.idp reads."""
    formats = ["%d", *["%.17g"] * 4, "%d", *["%.17g"] * 2]
    np.savetxt(path, points, fmt=formats, header=str(len(points)), comments="")
