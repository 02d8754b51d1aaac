"""A gmsh mesh as FreeFEM reads it: triangles of the corner nodes with a vertex for each body, curves as edge references."""

from dataclasses import dataclass
from fnmatch import fnmatchcase

import numpy as np

from cases import StudyError

UNNAMED = 0  # reference of the boundary edges that no physical curve names


@dataclass
class Body:
    """One body as FreeFEM sees it: straight-sided triangles on the corner nodes of the mesh."""

    name: str
    points: np.ndarray  # vertices x 2, in the order of the mesh's nodes
    triangles: np.ndarray  # counterclockwise
    edges: np.ndarray  # of the boundary
    labels: np.ndarray  # of the edges: tag of the physical curve

    def size(self):
        return float(np.linalg.norm(np.ptp(self.points, axis=0)))

    def nodes(self, order):
        """Nodes and triangles with the middles of the sides where the order is 2 (as VTK numbers triangle6)."""
        if order == 1:
            return self.points, self.triangles
        sides, number = np.unique(sides_of(self.triangles), axis=0, return_inverse=True)
        middles = self.points[sides].mean(axis=1)
        number = len(self.points) + number.reshape(3, -1).T
        return np.concatenate([self.points, middles]), np.concatenate([self.triangles, number], axis=1)


def sides_of(triangles):
    """The sides 01, 12, 20 of all triangles, first all 01; each as sorted pair."""
    return np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)


def split_quadrilaterals(points, quads):
    """Two triangles for each quadrilateral, cut by its shorter diagonal; corner 0 to corner 2 if they are equal.

    Diagonals count as equal up to 1e-9 of their length, so that round-off of the coordinates decides nothing.
    """
    first = np.linalg.norm(points[quads[:, 2]] - points[quads[:, 0]], axis=1)
    second = np.linalg.norm(points[quads[:, 3]] - points[quads[:, 1]], axis=1)
    by_first = (first <= second * (1 + 1e-9))[:, None, None]
    cut_02, cut_13 = quads[:, [[0, 1, 2], [0, 2, 3]]], quads[:, [[0, 1, 3], [1, 2, 3]]]
    return np.where(by_first, cut_02, cut_13).reshape(-1, 3)


def counterclockwise(points, triangles):
    a, b = points[triangles[:, 1]] - points[triangles[:, 0]], points[triangles[:, 2]] - points[triangles[:, 0]]
    clockwise = a[:, 0] * b[:, 1] < a[:, 1] * b[:, 0]
    return np.where(clockwise[:, None], triangles[:, [0, 2, 1]], triangles)


def corners_of(mesh, name, kinds):
    """Corner nodes of the cells of a physical group, block by block. `kinds`: their types, and corners of each."""
    for block, chosen in zip(mesh.cells, mesh.cell_sets[name]):
        if block.type in kinds and chosen is not None and len(chosen) > 0:
            yield block.data[np.asarray(chosen, dtype=int), : kinds[block.type]]


def corner_triangles(mesh, name):
    """The triangles of a body on the nodes of the whole mesh."""
    points = mesh.points[:, :2]
    found = [split_quadrilaterals(points, cells) if cells.shape[1] == 4 else cells
             for cells in corners_of(mesh, name, {"triangle": 3, "triangle6": 3, "quad": 4, "quad8": 4, "quad9": 4})]
    if not found:
        raise StudyError(f"the mesh has no cells of the body '{name}'")
    return counterclockwise(points, np.concatenate(found).astype(int))


def curve_edges(mesh, name):
    """Corner nodes of the edges of a physical curve."""
    found = list(corners_of(mesh, name, {"line": 2, "line3": 2}))
    return np.sort(np.concatenate(found), axis=1).astype(int) if found else np.empty((0, 2), dtype=int)


def curve_tags(mesh):
    """Tag of each physical curve by name."""
    return {name: int(tag) for name, (tag, dimension) in mesh.field_data.items() if dimension == 1}


def edge_labels(mesh):
    """Tag of the physical curve of each named edge, by its two nodes."""
    labels, names = {}, {}
    for name, tag in curve_tags(mesh).items():
        for edge in map(tuple, curve_edges(mesh, name)):
            if edge in labels:
                raise StudyError(f"curves '{names[edge]}' and '{name}' share an edge; FreeFEM's edges have one reference")
            labels[edge], names[edge] = tag, name
    return labels


def read_body(mesh, name, labels):
    """A body out of a mesh; `labels` as edge_labels finds them."""
    triangles = corner_triangles(mesh, name)
    used, local = np.unique(triangles, return_inverse=True)
    sides, count = np.unique(sides_of(triangles), axis=0, return_counts=True)
    boundary = sides[count == 1]
    of_edges = np.array([labels.get(tuple(edge), UNNAMED) for edge in boundary])
    points, edges = np.ascontiguousarray(mesh.points[used, :2]), np.searchsorted(used, boundary)
    return Body(name, points, local.reshape(triangles.shape), edges, of_edges)


def read_bodies(mesh, patterns):
    """The bodies of a mesh that the patterns name, by name; in mortise's order, that of the physical surfaces' tags."""
    labels, tags = edge_labels(mesh), {name: tag for name, (tag, dimension) in mesh.field_data.items() if dimension == 2}
    found = [name for name in sorted(tags, key=tags.get) if any(fnmatchcase(name, pattern) for pattern in patterns)]
    for pattern in patterns:
        if not any(fnmatchcase(name, pattern) for name in found):
            raise StudyError(f"the mesh has no physical surface '{pattern}'")
    return {name: read_body(mesh, name, labels) for name in found}


def bodies_of_curve(bodies, tag):
    """Names of the bodies on whose boundary a curve lies."""
    return [name for name, body in bodies.items() if tag in body.labels]


def write_mesh(bodies, path):
    """FreeFEM's own format, 17 digits, with the bodies' numbers as references of the triangles; of the vertices 0."""
    first = np.cumsum([0, *(len(body.points) for body in bodies)])
    of_body = lambda cells, labels, k: np.column_stack([cells + first[k] + 1, np.broadcast_to(labels, len(cells))])
    blocks = [np.pad(np.concatenate([body.points for body in bodies]), ((0, 0), (0, 1))),
              np.concatenate([of_body(body.triangles, k, k) for k, body in enumerate(bodies)]),
              np.concatenate([of_body(body.edges, body.labels, k) for k, body in enumerate(bodies)])]  # fmt: skip
    with open(path, "w") as file:
        print(*map(len, blocks), file=file)
        for block, form in zip(blocks, (["%.17g", "%.17g", "%d"], "%d", "%d")):
            np.savetxt(file, block, fmt=form)
