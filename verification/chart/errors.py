"""Errors of a run against what is known of a charted problem, from the files that it wrote.

All are relative; None where nothing is known. Those of p are along the multiplier side, against p's own norm or largest
value there; those called inner leave out a part of the line at each end.
"""

from dataclasses import dataclass

import meshio
import numpy as np
from numpy.polynomial.legendre import leggauss
from scipy.spatial import cKDTree

from chart_methods import ERRORS
import elements
import launch  # makes src/python/pictures known
import shapes

LEFT_OUT = 0.1  # of the line's length, at each end
NEAR = 1e-9  # m: nodes of two programs nearer than this are one


@dataclass
class Fields:
    """Displacements of the cells' points, and the multiplier side edge by edge: nodes x 2 and p of two or three nodes."""

    mesh: meshio.Mesh
    u: np.ndarray
    places: np.ndarray
    p: np.ndarray

    def body_of_points(self):
        found = np.zeros(len(self.u), dtype=int)
        for block, bodies in zip(self.mesh.cells, self.mesh.cell_data["body"]):
            found[block.data] = np.ravel(bodies).astype(int)[:, None]
        return found


def by_edges(values, step):
    """Rows of the two or three values of each edge: ends, then the middle."""
    return np.stack([values[:-1:step], values[step::step], *([values[1::2]] if step == 2 else [])], axis=1)


def read(folder):
    mesh, line = meshio.read(folder / "result.vtu"), launch.contact(folder)
    step = 1 if {block.type for block in mesh.cells} <= {"triangle", "quad"} else 2
    places = np.stack([line["x"], line["y"]], axis=1)
    return Fields(mesh, mesh.point_data["displacement"][:, :2], by_edges(places, step), by_edges(line["p"], step))


def at(rows, places):
    """The last two values of the rows (x, y, value, value) at some places. StudyError where a place has no row."""
    distance, row = cKDTree(rows[:, :2]).query(places)
    if distance.max() > NEAR:
        raise launch.StudyError(f"another program's results have no row at {places[distance.argmax()]}")
    return rows[row, 2:]


def of_another(fields, files):
    """The same with the answer of another program on the same nodes: FILES_bodies.txt (body x y u1 u2 a line),
    FILES_contact.txt (0 x y p and another value at each vertex)."""
    bodies, contact = (np.loadtxt(f"{files}_{name}.txt") for name in ("bodies", "contact"))
    of_point, u = fields.body_of_points(), np.empty_like(fields.u)
    for body in np.unique(of_point):
        u[of_point == body] = at(bodies[bodies[:, 0] == body, 1:], fields.mesh.points[of_point == body, :2])
    p = np.stack([at(contact[:, 1:], fields.places[:, k])[:, 0] for k in (0, 1)], axis=1)
    p = np.hstack([p, p.mean(axis=1, keepdims=True)])[:, : fields.p.shape[1]]
    return Fields(fields.mesh, u, fields.places, p)


def rule(kind):
    """Four points each way of a reference cell, of a triangle collapsed: shape functions, gradients, weights."""
    (s, w), corners = leggauss(4), shapes.CORNERS[kind]
    x, y, weights = (part.ravel() for part in (*np.meshgrid(s, s, indexing="ij"), np.outer(w, w)))
    if corners == 3:
        x, y, weights = (1 + x) / 2, (1 - x) * (1 + y) / 4, weights * (1 - x) / 8
    return shapes.shape_functions(kind, x, y), elements.gradients(kind, x, y), weights


def energy_error(fields, known):
    """In the energy norm of plane strain, over that of the exact stresses."""
    squares = np.zeros(2)
    for block, bodies in zip(fields.mesh.cells, fields.mesh.cell_data["body"]):
        body = np.ravel(bodies).astype(int)
        young, nu = np.array(known.materials)[body].T
        mu, lam = young / 2 / (1 + nu), young * nu / (1 + nu) / (1 - 2 * nu)
        X, U = fields.mesh.points[block.data, :2], fields.u[block.data]
        for N, dN, weight in zip(*rule(block.type)):
            J, x = dN @ X, N @ X  # of all cells
            H = np.linalg.solve(J, dN @ U)
            trace = lam * (H[:, 0, 0] + H[:, 1, 1])
            own = np.stack([trace + 2 * mu * H[:, 0, 0], trace + 2 * mu * H[:, 1, 1], mu * (H[:, 0, 1] + H[:, 1, 0])])
            exact = np.stack(np.broadcast_arrays(*known.stress(x[:, 0], x[:, 1], body)))
            for k, (xx, yy, xy) in enumerate((own - exact, exact)):
                density = (1 + nu) / young * (xx**2 + yy**2 + 2 * xy**2 - nu * (xx + yy) ** 2)
                squares[k] += weight * (np.linalg.det(J) * density).sum()
    return float(np.sqrt(squares[0] / squares[1]))


def along_edges(values, xi):
    """Values at places xi of the edges, and their derivatives: edges x places (x 2)."""
    one = np.ones_like(xi)
    N, dN = np.stack([(1 - xi) / 2, (1 + xi) / 2]), np.stack([-one / 2, one / 2])
    if values.shape[1] == 3:
        N, dN = (part.T[[0, 2, 1]] for part in elements.edge(xi))
    return np.einsum("aq,ea...->eq...", N, values), np.einsum("aq,ea...->eq...", dN, values)


def pressure_errors(fields, known):
    """Relative errors of p: in L2 of the whole line and without its ends, and the largest there, at quadrature points and
    nodes."""
    points, weights = leggauss(5)
    places, steps = along_edges(fields.places, points)
    ds, exact = weights * np.linalg.norm(steps, axis=2), known.pressure(*np.moveaxis(places, 2, 0)) + np.zeros(places.shape[:2])
    off = along_edges(fields.p, points)[0] - exact
    ends = np.cumsum(ds).reshape(ds.shape)
    inside = lambda s: (s >= LEFT_OUT * ends[-1, -1]) & (s <= (1 - LEFT_OUT) * ends[-1, -1])
    inner = inside(ends - ds / 2)
    nodes = along_edges(fields.places, np.array([-1.0, 0, 1]))[0]
    at_nodes = np.abs(along_edges(fields.p, np.array([-1.0, 0, 1]))[0] - known.pressure(*np.moveaxis(nodes, 2, 0)))
    before, after = ends[:, 0] - ds[:, 0], ends[:, -1]
    worst = max(np.abs(off[inner]).max(), at_nodes[inside(np.stack([before, (before + after) / 2, after], axis=1))].max(initial=0))
    norm = lambda values, some: np.sqrt((ds * values**2)[some].sum())
    everywhere = np.ones_like(inner)
    return {"e_p_l2": float(norm(off, everywhere) / norm(exact, everywhere)),
            "e_p_l2_inner": float(norm(off, inner) / norm(exact, inner)),
            "e_p_max_inner": float(worst / np.abs(exact[inner]).max())}  # fmt: skip


def of_run(folder, known, files=None):
    """The errors of the run in a folder, or of another program's answer on its nodes."""
    found = dict.fromkeys(ERRORS)
    if known.stress or known.pressure:
        fields = read(folder)
        fields = of_another(fields, files) if files else fields
        found |= {"e_energy": energy_error(fields, known)} if known.stress else {}
        found |= pressure_errors(fields, known) if known.pressure else {}
    return found


def write_pressure(folder, path):
    """x,p along the multiplier side by x: 16 points an edge of 3 nodes, the ends of one of 2 (p is linear between)."""
    fields = read(folder)
    xi = np.linspace(-1, 1, 17 if fields.p.shape[1] == 3 else 2)
    rows = np.stack([along_edges(fields.places, xi)[0][..., 0], along_edges(fields.p, xi)[0]], axis=-1)
    rows = np.concatenate([rows[0, :1], *rows[:, 1:]])
    rows = rows[:: 1 if rows[0, 0] < rows[-1, 0] else -1]
    np.savetxt(path, rows, delimiter=",", header="x,p", comments="", fmt="%.17g")
