"""The contact line of one answer: places and p of its nodes; the reference beside it, and how far the two are apart."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.spatial import cKDTree

from elements import edge

GAUSS = 5  # points an edge: p is linear on it, the reference is not


@dataclass
class Line:
    """Nodes in order, two edges' middles among them at the odd places; `bar` is what is promised of p."""

    x: np.ndarray  # nodes x 2
    p: np.ndarray
    bar: np.ndarray

    @classmethod
    def of(cls, columns):
        return cls(np.column_stack([columns["x"], columns["y"]]), np.array(columns["p"]), np.array(columns["p_error"]))

    def vertices(self):
        return Line(self.x[::2], self.p[::2], self.bar[::2])


def samples(line):
    """Places along the edges (curved through their middles), p there, and the length that each stands for."""
    xi, weight = np.polynomial.legendre.leggauss(GAUSS)
    shape, slope = (part.T for part in edge(xi))
    ends = lambda values: np.stack([values[:-2:2], values[1::2], values[2::2]], 1)  # edges x 3
    x = np.einsum("eac,aq->eqc", ends(line.x), shape).reshape(-1, 2)
    ds = weight * np.linalg.norm(np.einsum("eac,aq->eqc", ends(line.x), slope), axis=2)
    return x, (ends(line.p) @ shape).ravel(), ds.ravel()


def pressure_of(line):
    """p of a line as a function of places: of the point of its polyline that is nearest, linear between the nodes."""
    tree = cKDTree(line.x)
    step = np.diff(line.x, axis=0)
    last = len(step) - 1

    def pressure(places):
        _, node = tree.query(places)
        best, found = np.full(len(places), np.inf), np.zeros(len(places))
        for e in (np.clip(node - 1, 0, last), np.clip(node, 0, last)):
            t = np.clip(((places - line.x[e]) * step[e]).sum(1) / (step[e] ** 2).sum(1), 0, 1)
            distance = np.linalg.norm(places - line.x[e] - t[:, None] * step[e], axis=1)
            here = distance < best
            best[here], found[here] = distance[here], ((1 - t) * line.p[e] + t * line.p[e + 1])[here]
        return found

    return pressure


def fitted(line, u, degree, inner=0.95):
    """p = sqrt(1 - t) times a polynomial of t = u(x) / u at the end of contact: what p is where contact ends smoothly,
    u being an even, smooth function of the place. The end and the coefficients are those that fit the inner part of the
    line: p near the end, where meshes are worst, is not asked. Returns the function and u at the end."""
    x, p, ds = samples(line)
    at = u(x)
    guess, size = at[p > 0].max(), p.max()
    kept = at < inner**2 * guess
    at, p, w = at[kept], p[kept] / size, np.sqrt(ds[kept])
    basis = lambda t: np.sqrt(np.maximum(1 - t, 0))[:, None] * t[:, None] ** np.arange(degree + 1)

    def solve(end):
        matrix = w[:, None] * basis(at / end)
        c = np.linalg.lstsq(matrix, w * p, rcond=None)[0]
        return c, np.linalg.norm(matrix @ c - w * p)

    shift = minimize_scalar(lambda z: solve(guess * (1 + z))[1], bounds=(-0.01, 0.01), options={"xatol": 1e-9}).x
    end = guess * (1 + shift)
    c = size * solve(end)[0]
    return lambda places: basis(u(places) / end) @ c, end


def distance(places, points):
    """From each place to the nearest of the points; infinite without any."""
    if len(points) == 0:
        return np.full(len(places), np.inf)
    return np.min([np.linalg.norm(places - point, axis=1) for point in np.asarray(points)], axis=0)


def at_vertices(line):
    """As samples: the vertices, and half of the edges beside each."""
    v = line.vertices()
    step = np.linalg.norm(np.diff(v.x, axis=0), axis=1)
    return v.x, v.p, (np.r_[step, 0] + np.r_[0, step]) / 2


def rms_error(line, exact, points=(), excluded=0, places=at_vertices):
    """Root mean square of p - exact over that of exact; what is nearer than `excluded` to one of the points is left
    out."""
    x, p, ds = places(line)
    kept, q = distance(x, points) >= excluded, exact(x)
    return float(np.sqrt((ds * (p - q) ** 2)[kept].sum() / (ds * q**2)[kept].sum()))


def inside_bars(line, exact, points=(), excluded=0):
    """Of the vertices under load: the share with exact within the bar, outside the excluded zones and within them (None
    where there are none; the points themselves are not counted), and where the worst outside them is: place, times the
    bar (infinite where there is none)."""
    v = line.vertices()
    q, away = exact(v.x), distance(v.x, points)
    loaded = (v.p != 0) | (v.bar > 0) | (q > 1e-9 * q.max())
    off = np.abs(v.p - q)
    ratio = np.divide(off, v.bar, out=np.where(off > 1e-12 * q.max(), np.inf, 0), where=v.bar > 0)
    outer, inner = loaded & (away >= excluded), loaded & (away < excluded) & (away > 1e-9 * excluded)
    share = lambda some: float((ratio[some] <= 1).mean()) if some.any() else None
    worst = int(np.argmax(np.where(outer, ratio, -1)))
    return share(outer), share(inner), [*v.x[worst].tolist(), float(ratio[worst])]

