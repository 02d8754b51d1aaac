"""Stresses of 8-node quadrilaterals from displacements, in the folder of a run: by other nodal stresses than mortise's,
or of displacements that are not mortise's.

mortise samples an element's stress at its 2 x 2 Gauss points, where it is most accurate, and extends it to the nodes
(theory, eq. 20). The plain way is to differentiate the displacements at the nodes themselves; the average over the
elements that meet at a node is the same in both. The preprint says only that nodal stresses are averages.
"""

import meshio
import numpy as np
from scipy.spatial import cKDTree

import elements
import launch  # makes src/python/pictures known
import shapes

YOUNG, POISSON = 210e9, 0.3  # of the preprint's scenes; plane strain
HOOKE = (YOUNG / (1 + POISSON) / (1 - 2 * POISSON)) * np.array(
    [[1 - POISSON, POISSON, 0], [POISSON, 1 - POISSON, 0], [0, 0, 0.5 - POISSON]]
)
BODIES = {"upper_contact": 0, "lower_contact": 1}
NODES = np.array(shapes.NODES["quad8"])
SAMPLES = np.array([(a, b) for a in (-1, 1) for b in (-1, 1)]) / np.sqrt(3)


def strains(points, x, y):
    """What makes strains 11, 22, 2 x 12 of the displacements (elements x 3 x 16) at a reference point of elements, and
    |d x / d xi| there; coordinates are elements x 8 x 2."""
    (dN,) = elements.gradients("quad8", np.array([x]), np.array([y]))
    J = points.transpose(0, 2, 1) @ dN.T  # d x_i / d xi_j
    G, B = dN.T @ np.linalg.inv(J), np.zeros((len(points), 3, 16))
    B[:, 0, ::2], B[:, 1, 1::2], B[:, 2, ::2], B[:, 2, 1::2] = G[..., 0], G[..., 1], G[..., 1], G[..., 0]
    return B, np.linalg.det(J)


def element_stresses(points, displacements, places=NODES):
    """Stresses 11, 22, 12 of elements: elements x places x 3, of coordinates and displacements, elements x 8 x 2."""
    u = displacements.reshape(-1, 16, 1)
    return np.stack([(HOOKE @ strains(points, *place)[0] @ u)[..., 0] for place in places], axis=1)


def recovered(points, displacements):
    """The same at the nodes by eq. 20 of theory."""
    monomials = lambda places: np.stack([np.ones(len(places)), *places.T, places.prod(axis=1)], axis=1)
    extend = monomials(NODES) @ np.linalg.inv(monomials(SAMPLES))
    return extend @ element_stresses(points, displacements, SAMPLES)


class Run:
    """result.vtu and contact.csv of a folder: points and the body of each, cells, displacements u, and the nodes of
    each curve by x1."""

    def __init__(self, folder):
        self.folder, self.mesh = folder, meshio.read(folder / "result.vtu")
        if wrong := {block.type for block in self.mesh.cells} - {"quad8"}:
            raise ValueError(f"{folder}: cells of type {wrong}; expected quad8")
        self.points, self.u = self.mesh.points[:, :2], self.mesh.point_data["displacement"][:, :2]
        self.cells = np.concatenate([block.data for block in self.mesh.cells])
        self.body = np.zeros(len(self.points), dtype=int)
        self.body[self.cells] = np.concatenate(self.mesh.cell_data["body"]).reshape(-1, 1)
        self.lines = {}
        for curve, number in BODIES.items():
            line, own = launch.contact(folder, curve), np.flatnonzero(self.body == number)
            places = np.stack([line["x"], line["y"]], axis=1)
            distance, nearest = cKDTree(self.points[own]).query(places[np.argsort(places[:, 0])])
            if distance.max() > 1e-6:
                raise ValueError(f"{folder}: nodes of {curve} are not in result.vtu")
            self.lines[curve] = own[nearest]

    def write(self, at_the_nodes=False):
        """The stresses of u in place of those in result.vtu, contact.csv and contact_centres.csv (the last two with
        their places and stresses only)."""
        elements = self.points[self.cells], self.u[self.cells]
        total, count = np.zeros((len(self.points), 3)), np.zeros((len(self.points), 1))
        np.add.at(total, self.cells, (element_stresses if at_the_nodes else recovered)(*elements))
        np.add.at(count, self.cells, 1)
        nodal, centres = total / count, np.empty_like(total)
        centres[self.cells] = element_stresses(*elements, [(0, 0)])  # a middle node on the line has one element
        self.mesh.point_data = {"displacement": self.u, "stress": nodal}
        self.mesh.write(self.folder / "result.vtu")
        for name, stresses, first, step in (("contact", nodal, 0, 1), ("contact_centres", centres, 1, 2)):
            lines = {curve: line[first::step] for curve, line in self.lines.items()}
            table = [row for curve, line in lines.items() for row in rows(curve, self.points[line], stresses[line])]
            launch.write_csv(self.folder / f"{name}.csv", table)


def rows(curve, points, stresses):
    """Of a curve's table by x1; the normal by differences along the curve, vertical at the ends as in the preprint."""
    slope = np.gradient(points[:, 1], points[:, 0])
    slope[[0, -1]] = 0  # (no measure looks at the first and the last centre)
    n1, n2 = -slope / np.hypot(1, slope), 1 / np.hypot(1, slope)
    s11, s22, s12 = stresses.T
    sigma_n = s11 * n1**2 + s22 * n2**2 + 2 * s12 * n1 * n2
    for (x, y), sigma_2, normal in zip(points, s22, sigma_n):
        yield {"curve": curve, "x": x, "y": y, "sigma_2": sigma_2, "sigma_n": normal}
