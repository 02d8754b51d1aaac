"""The cells of result.vtu as they are drawn: triangles with curved sides, outlines, areas."""

import math

import numpy as np

from shapes import CORNERS, shape_functions, subdivision

MANY_LINES = 400  # of more, no curve within an edge is seen


def shaded_triangles(mesh, points, values):
    """Points, values and triangles of all cells, fine enough for curved sides."""
    cells = [block for block in mesh.cells if block.type in CORNERS]
    total = sum(len(block.data) for block in cells)
    positions, colours, triangles, first = [], [], [], 0
    for block in cells:
        linear = block.type in ("triangle", "quad")
        n = 1 if block.type == "triangle" else int(np.clip(math.sqrt(40000 / total), 1 if linear else 2, 8))
        x, y, local = subdivision(block.type, n)
        N = shape_functions(block.type, x, y)
        positions.append(np.einsum("qa,eac->eqc", N, points[block.data]).reshape(-1, 2))
        colours.append(np.einsum("qa,ea->eq", N, values[block.data]).ravel())
        offsets = first + len(x) * np.arange(len(block.data))
        triangles.append((offsets[:, None, None] + local[None]).reshape(-1, 3))
        first += len(x) * len(block.data)
    return np.concatenate(positions), np.concatenate(colours), np.concatenate(triangles)


def outlines(mesh):
    """Sides that one cell has alone, a row of nodes each (start, end, and middle or start again)."""
    sides = {}
    for block in mesh.cells:
        corners = CORNERS.get(block.type, 0)
        for cell in block.data:
            for i in range(corners):
                start, end = cell[i], cell[(i + 1) % corners]
                middle = cell[corners + i] if len(cell) > corners else -1
                sides.setdefault((min(start, end), max(start, end)), []).append((start, end, middle))
    return [found[0] for found in sides.values() if len(found) == 1]


def polylines(points, edges):
    """Edges (start, end, middle; middle < 0 if straight) as lists of points."""
    xi = np.linspace(-1, 1, 7)[:, None]
    lines = []
    for start, end, middle in edges:
        a, b = points[start], points[end]
        c = points[middle] if middle >= 0 else (a + b) / 2
        lines.append(xi * (xi - 1) / 2 * a + xi * (xi + 1) / 2 * b + (1 - xi * xi) * c)
    return lines


def joined(lines):
    """Lines of points in as few as they are when each begins where another ends: a file of vectors is as long as it has
    lines. Of many, the ends and middles only."""
    lines = [line[:: (len(line) - 1) // 2 or 1] for line in lines] if len(lines) > MANY_LINES else lines
    following = {}
    for line in lines:
        following.setdefault(tuple(line[0]), []).append(line)
    ends = {tuple(line[-1]) for line in lines}
    chains = []
    for first in sorted(lines, key=lambda line: tuple(line[0]) in ends):  # those that nothing leads to
        chain = []
        while waiting := following.get(tuple(chain[-1][-1] if chain else first[0])):
            chain.append(waiting.pop())
        if chain:
            chains.append(np.concatenate([chain[0], *(line[1:] for line in chain[1:])]))
    return chains


def size_of(points):
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def percentiles(values, weights, at):
    """Values that these percents of the weight lie below: of a line or an area, however its nodes are spaced."""
    order = np.argsort(values)
    part = np.cumsum(weights[order]) - weights[order] / 2
    return np.interp(np.array(at) / 100, part / weights.sum(), values[order])


def cell_areas(mesh):
    """Blocks of cells with the areas of their cells, by their corners."""
    for block in mesh.cells:
        if block.type in CORNERS:
            x, y = np.moveaxis(mesh.points[block.data[:, : CORNERS[block.type]], :2], 2, 0)
            yield block, np.abs((x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum(axis=1) / 2)


def areas_at_nodes(mesh):
    """Of each node the area of the cells that meet there."""
    areas = np.zeros(len(mesh.points))
    for block, of_cells in cell_areas(mesh):
        np.add.at(areas, block.data, of_cells[:, None])
    return areas


def body_areas(mesh):
    numbers = [number for block, number in zip(mesh.cells, mesh.cell_data["body"]) if block.type in CORNERS]
    return np.bincount(np.concatenate(numbers).astype(int).ravel(), np.concatenate([areas for _, areas in cell_areas(mesh)]))


def at_points(mesh, values):
    """Of values of the cells, the mean at each point, by area."""
    total = np.zeros(len(mesh.points))
    for (block, areas), value in zip(cell_areas(mesh), values):
        np.add.at(total, block.data, (areas * np.ravel(value))[:, None])
    return total / areas_at_nodes(mesh)


def nearest(points, places):
    """Index of the place nearest to each point."""
    parts = np.array_split(points, 1 + len(points) * len(places) // 10**7)
    square = (places**2).sum(axis=1)
    return np.concatenate([(square - 2 * part @ places.T).argmin(axis=1) for part in parts])


def touches(corners, box):
    """Whether any of these triangles (n x 3 x 2) and a box have a place in common: no side of either lies between them."""
    frame = np.array([box[0], (box[1][0], box[0][1]), box[1], (box[0][0], box[1][1])])
    sides = np.roll(corners, -1, axis=1) - corners
    axes = np.concatenate([sides[:, :, ::-1] * (1, -1), np.broadcast_to(np.eye(2), (len(corners), 2, 2))], axis=1)
    of_cells, of_box = axes @ corners.swapaxes(1, 2), axes @ frame.T
    apart = (of_cells.max(axis=2) < of_box.min(axis=2)) | (of_box.max(axis=2) < of_cells.min(axis=2))
    return not apart.any(axis=1).all()


def inside(points, box):
    return ((points >= box[0]) & (points <= box[1])).all(axis=1)
