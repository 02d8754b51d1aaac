"""Shape functions of edges and cells, where errors are integrated or stresses taken again."""

import numpy as np

import launch  # noqa: F401  makes src/python/pictures known
import shapes


def edge(xi):
    """Of a 3-node edge, in the order start, middle, end, along the last axis: values and derivatives."""
    values = np.stack([xi * (xi - 1) / 2, 1 - xi * xi, xi * (xi + 1) / 2], axis=-1)
    return values, np.stack([xi - 0.5, -2 * xi, xi + 0.5], axis=-1)


def gradients(kind, x, y):
    """Of a VTK cell's shape functions at places of the reference cell: places x 2 x nodes."""
    nodes = np.array(shapes.NODES[kind], dtype=float)
    powers = shapes.POWERS[: len(nodes)]
    inverse = np.linalg.inv(np.stack([nodes[:, 0] ** m * nodes[:, 1] ** n for m, n in powers], axis=1))
    along = [m * x ** max(m - 1, 0) * y**n for m, n in powers], [n * x**m * y ** max(n - 1, 0) for m, n in powers]
    return np.moveaxis(np.array(along), -1, 0) @ inverse
