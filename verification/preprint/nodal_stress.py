"""Stresses taken directly at the nodes of 8-node quadrilaterals, the other way to nodal stresses.

mortise samples an element's stress at its 2 x 2 Gauss points, where it is most accurate, and extends it to the nodes
(theory, eq. 20). The plain way is to differentiate the displacements at the nodes themselves; the average over the
elements that meet at a node is the same in both. The preprint says only that nodal stresses are averages.
"""

import meshio
import numpy as np
from scipy.spatial import cKDTree

YOUNG, POISSON = 210e9, 0.3  # of the preprint's scenes; plane strain
BODIES = {"upper_contact": 0, "lower_contact": 1}
NODES = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1), (0, -1), (1, 0), (0, 1), (-1, 0)])  # in VTK's order


def derivatives(x, y):
    """d N_a / d (x, y) of the 8-node quadrilateral at a reference point: 8 x 2."""
    found = []
    for a, b in NODES:
        if a and b:
            found.append((a * (1 + b * y) * (2 * a * x + b * y) / 4, b * (1 + a * x) * (a * x + 2 * b * y) / 4))
        elif b:
            found.append((-x * (1 + b * y), b * (1 - x * x) / 2))
        else:
            found.append((a * (1 - y * y) / 2, -y * (1 + a * x)))
    return np.array(found)


def element_stresses(points, displacements):
    """Stresses 11, 22, 12 of elements at their own nodes: elements x 8 x 3, of coordinates and u, elements x 8 x 2."""
    mu = YOUNG / 2 / (1 + POISSON)
    lame = 2 * mu * POISSON / (1 - 2 * POISSON)
    stresses = np.empty((len(points), 8, 3))
    for k, (x, y) in enumerate(NODES):
        D = derivatives(x, y)
        J = np.einsum("eai,aj->eij", points, D)  # d x_i / d xi_j
        gradient = np.einsum("eai,aj,ejk->eik", displacements, D, np.linalg.inv(J))
        e11, e22, e12 = gradient[:, 0, 0], gradient[:, 1, 1], (gradient[:, 0, 1] + gradient[:, 1, 0]) / 2
        trace = lame * (e11 + e22)
        stresses[:, k] = np.stack([trace + 2 * mu * e11, trace + 2 * mu * e22, 2 * mu * e12], axis=1)
    return stresses


def averaged(folder):
    """Points of result.vtu, the body of each, and its averaged stresses 11, 22, 12 (a point belongs to one body)."""
    mesh = meshio.read(folder / "result.vtu")
    points = mesh.points[:, :2]
    total, count, body = np.zeros((len(points), 3)), np.zeros(len(points)), np.zeros(len(points), dtype=int)
    for k, block in enumerate(mesh.cells):
        if block.type != "quad8":
            raise ValueError(f"{folder}: cells of type {block.type}; expected quad8")
        stresses = element_stresses(points[block.data], mesh.point_data["displacement"][block.data][:, :, :2])
        np.add.at(total, block.data, stresses)
        np.add.at(count, block.data, 1)
        body[block.data] = mesh.cell_data["body"][k].reshape(-1, 1)
    return points, body, total / count[:, None]


def at_contact(folder, table):
    """Columns s_11, s_22, s_12: the stresses at the rows of contact.csv (its columns), in each row's own body."""
    points, body, stresses = averaged(folder)
    places, found = np.stack([table["x"], table["y"]], axis=1), np.empty((len(table["x"]), 3))
    for curve, number in BODIES.items():
        here, own = np.flatnonzero(np.array(table["curve"]) == curve), np.flatnonzero(body == number)
        distance, nearest = cKDTree(points[own]).query(places[here])
        if distance.max() > 1e-6:
            raise ValueError(f"{folder}: nodes of {curve} are not in result.vtu")
        found[here] = stresses[own[nearest]]
    return dict(zip(("s_11", "s_22", "s_12"), found.T.tolist()))


def replaced(curve):
    """A curve by x1 with sigma_2 and sigma_n made of s_11, s_22, s_12: the normal by differences along the curve."""
    slope = np.gradient(curve["y"], curve["x"])
    slope[[0, -1]] = 0  # the normal at the ends is vertical, as in the preprint
    n1, n2 = -slope / np.hypot(1, slope), 1 / np.hypot(1, slope)
    sigma_n = curve["s_11"] * n1**2 + curve["s_22"] * n2**2 + 2 * curve["s_12"] * n1 * n2
    return {**curve, "sigma_2": curve["s_22"], "sigma_n": sigma_n}
