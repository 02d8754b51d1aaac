"""The integration that the preprint states in its section 4, solved here: mortise itself integrates otherwise.

"Nodes of the master projected by normals, integration on the elements that result, as quadratic ones": the three nodes
of each edge of the opposite side, projected onto the multiplier side, make a 3-node element with 3 Gauss points, a
length and normals of its own. It is not cut where edges of the multiplier side meet. `cut`: it is, so that both sides'
shape functions are smooth on it, as on mortise's segments. The gap is that between these elements and the opposite
edges, or zero. (Along whose normals one projects makes no difference: the sides are some 1e-6 m apart.)

The mesh is that of a run of mortise. Two plates in bilateral contact, as in all tables of the preprint.
"""

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

import nodal_stress
from elements import edge

PRESSURE = 10e6
GAUSS = np.sqrt(0.6) * np.array([-1, 0, 1]), np.array([5, 8, 5]) / 9


class Side:
    """A contact line: its nodes in order of x1 and their coordinates; a place on edge k is s = 2 k + 1 + xi."""

    def __init__(self, nodes, x):
        self.nodes, self.x = nodes, x

    def at(self, s):
        """The three nodes of the edge at each s (places in self.nodes), values and derivatives of their functions."""
        k = np.clip(s // 2, 0, len(self.x) // 2 - 1).astype(int)
        return 2 * k[..., None] + [0, 1, 2], *edge(s - 2 * k - 1)

    def position(self, s):
        near, N, _ = self.at(s)
        return np.einsum("...a,...ai->...i", N, self.x[near])

    def foot(self, x):
        """The s at which a normal of the line passes through x: Newton's steps from the nearest node."""
        s = np.argmin(np.linalg.norm(x[..., None, :] - self.x, axis=-1), axis=-1).astype(float)
        for _ in range(20):
            near, _, dN = self.at(s)
            tangent = np.einsum("...a,...ai->...i", dN, self.x[near])
            step = ((x - self.position(s)) * tangent).sum(-1) / (tangent**2).sum(-1)
            s = np.clip(s + step, 0, len(self.x) - 1)
        return s


def coupling(multiplier, opposite, out, size, cut=False):
    """B, with a row for each node of the multiplier side, and the integrals of psi g0. `out`: 1 if upwards is out of
    the multiplier side's body, else -1."""
    ends = np.arange(0, len(opposite.x), 2.0)
    if cut:
        ends = np.sort(np.concatenate([ends, opposite.foot(multiplier.x[::2])]))
        ends = ends[np.diff(ends, prepend=-1) > 1e-9]
    places = np.stack([ends[:-1], (ends[:-1] + ends[1:]) / 2, ends[1:]], axis=-1)
    Q = opposite.position(places)
    P = multiplier.position(multiplier.foot(Q))
    N, dN = edge(GAUSS[0])
    length = np.linalg.norm(dN @ P, axis=-1)
    normal = out * (dN @ P)[..., ::-1] * [-1, 1] / length[..., None]
    gap = ((N @ (Q - P)) * normal).sum(-1)
    rows, psi, _ = multiplier.at(multiplier.foot(N @ P))
    psi_ds = psi * (length * GAUSS[1])[..., None]
    B = sparse.csc_matrix((len(multiplier.x), size))
    for side, sign in ((multiplier, -1), (opposite, 1)):
        near, M, _ = (rows, psi, None) if side is multiplier else side.at(places @ N.T)
        values = sign * psi_ds[..., :, None, None] * M[..., None, :, None] * normal[..., None, None, :]
        columns = 2 * side.nodes[near][..., None, :, None] + [0, 1]
        places_of = np.broadcast_arrays(rows[..., :, None, None], columns)
        B = B + sparse.coo_matrix((values.ravel(), [k.ravel() for k in places_of]), shape=B.shape).tocsc()
    gaps = np.zeros(len(multiplier.x))
    np.add.at(gaps, rows, psi_ds * gap[..., None])
    return B, gaps


def stiffness(points, cells):
    """Of 8-node quadrilaterals, 3 x 3 Gauss points."""
    K, dofs = np.zeros((len(cells), 16, 16)), (2 * cells[:, :, None] + [0, 1]).reshape(-1, 16)
    for x, wx in zip(*GAUSS):
        for y, wy in zip(*GAUSS):
            B, det = nodal_stress.strains(points[cells], x, y)
            K += wx * wy * det[:, None, None] * (B.transpose(0, 2, 1) @ nodal_stress.HOOKE @ B)
    places = np.broadcast_arrays(dofs[:, :, None], dofs[:, None, :])
    return sparse.coo_matrix((K.ravel(), [k.ravel() for k in places])).tocsc()


def top_load(points):
    f, top = np.zeros(points.size), np.flatnonzero(np.abs(points[:, 1] - 0.6) < 1e-9)
    top = top[np.argsort(points[top, 0])]
    widths = points[top[2::2], 0] - points[top[:-2:2], 0]
    for k, part in enumerate((1 / 6, 4 / 6, 1 / 6)):
        np.add.at(f, 2 * top[k : len(top) - 2 + k : 2] + 1, -PRESSURE * part * widths)
    return f


def solve(run, multiplier, gap, cut=False):
    """u on the mesh of a run (nodal_stress.Run) with the multipliers on a curve of it; `gap`: enforced, or zero."""
    points, upwards = run.points, multiplier == "lower_contact"  # out of the multiplier side's body
    sides = {curve: Side(line, points[line]) for curve, line in run.lines.items()}
    other = sides["upper_contact" if upwards else "lower_contact"]
    B, gaps = coupling(sides[multiplier], other, 1 if upwards else -1, points.size, cut)
    held = np.abs(points - [0.4, 0]) > [0.4 - 1e-9, np.inf]
    held[points[:, 1] < 1e-9] = True
    free = np.flatnonzero(~held.ravel())
    E, d = nodal_stress.YOUNG, np.abs(B).sum(axis=1).A1
    K, B = stiffness(points, run.cells)[free][:, free] / E, sparse.diags(1 / d) @ B[:, free]
    right = np.concatenate([top_load(points)[free] / E, -gaps / d * bool(gap)])
    u = np.zeros(points.size)
    u[free] = splu(sparse.bmat([[K, B.T], [B, None]], format="csc")).solve(right)[: len(free)]
    return u.reshape(-1, 2)
