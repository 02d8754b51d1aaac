"""Cells of a .vtu: their shape functions, and the triangles that they are drawn as."""

import numpy as np

CORNERS = {"triangle": 3, "triangle6": 3, "quad": 4, "quad8": 4, "quad9": 4}
TRIANGLE = [(0, 0), (1, 0), (0, 1), (0.5, 0), (0.5, 0.5), (0, 0.5)]  # reference cells: nodes in VTK's order
SQUARE = [(-1, -1), (1, -1), (1, 1), (-1, 1), (0, -1), (1, 0), (0, 1), (-1, 0), (0, 0)]
POWERS = [(0, 0), (1, 0), (0, 1), (1, 1), (2, 0), (0, 2), (2, 1), (1, 2), (2, 2)]  # of x and y
NODES = {"triangle": TRIANGLE[:3], "triangle6": TRIANGLE, "quad": SQUARE[:4], "quad8": SQUARE[:8], "quad9": SQUARE}


def shape_functions(kind, x, y):
    """Shape functions of a VTK cell, points x nodes: of the first powers, as many as nodes, each 1 at its own."""
    powers = lambda x, y: np.stack([x**m * y**n for m, n in POWERS[: len(NODES[kind])]], axis=1)
    return powers(x, y) @ np.linalg.inv(powers(*np.array(NODES[kind], dtype=float).T))


def subdivision(kind, n):
    """Reference points that cut a cell n times along each side, and the triangles between them."""
    i, j = np.meshgrid(np.arange(n + 1), np.arange(n + 1), indexing="ij")
    number = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    a, b, c, d = (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:])
    lower, upper = np.stack([a, b, d], axis=-1), np.stack([b, c, d], axis=-1)
    if CORNERS[kind] == 4:
        triangles = np.concatenate([lower.reshape(-1, 3), upper.reshape(-1, 3)])
        return 2 * i.ravel() / n - 1, 2 * j.ravel() / n - 1, triangles
    inside = i[:-1, :-1] + j[:-1, :-1]
    triangles = np.concatenate([lower[inside < n], upper[inside < n - 1]])
    return i.ravel() / n, j.ravel() / n, triangles
