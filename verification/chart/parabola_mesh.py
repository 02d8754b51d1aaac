"""The plates of parabola_1 as the same structured mesh for three programs: mortise's .msh, FreeFEM's .msh, arrays."""

import numpy as np

WIDTH, HEIGHT = 0.8, 0.6
# gmsh's Q8 on a lattice of 3 x 3 nodes, numbered row by row; the two triangles on the corners of a lattice of vertices.
Q8 = [(0, 0), (0, 2), (2, 2), (2, 0), (0, 1), (1, 2), (2, 1), (1, 0)]
TRIANGLES = [[(0, 0), (0, 1), (1, 1)], [(0, 0), (1, 1), (1, 0)]]
SIDES = ("left", "right", "down", "up")
CURVES = {  # of the upper and of the lower plate, in the order of SIDES
    "upper": ("upper_left", "upper_right", "upper_contact", "top"),
    "lower": ("lower_left", "lower_right", "bottom", "lower_contact"),
}


def line(x):
    return -1.25 * x * x + x + 0.2


def with_middles(vertices):
    places = np.empty(2 * len(vertices) - 1)
    places[::2], places[1::2] = vertices, (vertices[1:] + vertices[:-1]) / 2
    return places


def lattice(body, columns, grading):
    """Places (rows, columns, 2) of the 9 nodes of each of columns x 3/8 columns elements, from below, left. Column i
    begins at (2 i / columns)^grading / 2 of the width, mirrored; rows shrink likewise towards the contact line."""
    s = np.linspace(0, 1, columns + 1)
    x = WIDTH * with_middles(np.where(s < 0.5, (2 * s) ** grading / 2, 1 - (2 - 2 * s) ** grading / 2))
    t = with_middles(np.linspace(0, 1, round(0.375 * columns) + 1) ** grading)[:, None]
    end = HEIGHT if body == "upper" else 0
    y = line(x) * (1 - t) + end * t
    places = np.stack([np.broadcast_to(x, y.shape), y], axis=-1)
    return places if body == "upper" else places[::-1]


def elements(numbers, corners, step):
    """Rows of node numbers; `numbers` is a lattice of them, an element begins at each step-th."""
    rows, columns = numbers.shape[0] - step, numbers.shape[1] - step
    return np.stack([numbers[j : j + rows : step, i : i + columns : step].ravel() for j, i in corners], axis=1)


def edges(numbers, step):
    """{side: rows of node numbers (ends, then the middle)}."""
    of = {"left": numbers[:, 0], "right": numbers[:, -1], "down": numbers[0], "up": numbers[-1]}
    return {side: np.stack([of[side][k : len(of[side]) - step + k : step] for k in ((0, 2, 1) if step == 2 else (0, 1))],
                           axis=1) for side in SIDES}  # fmt: skip


def numbered(places, step, first):
    """The numbers of a lattice's nodes from `first` on (the middles of elements have none), and the nodes' places."""
    used = np.ones(places.shape[:2], dtype=bool)
    if step == 2:
        used[1::2, 1::2] = False
    numbers = np.full(used.shape, -1)
    numbers[used] = first + np.arange(used.sum())
    return numbers, places[used]


def bodies(sizes, grading, step):
    """Of each body its name, the numbers of its lattice and the places of its nodes; `step` 2: with middle nodes."""
    first = 1
    for name, columns in zip(CURVES, sizes):
        numbers, places = numbered(lattice(name, columns, grading)[:: 3 - step, :: 3 - step], step, first)
        first += len(places)
        yield name, numbers, places


def write_gmsh(path, sizes, grading):
    """8-node quadrilaterals, MSH 2.2, binary."""
    names, blocks, nodes = [], [], []
    for body, numbers, places in bodies(sizes, grading, 2):
        nodes.append(places)
        groups = [(1, 8, curve, edges(numbers, 2)[side]) for side, curve in zip(SIDES, CURVES[body])]
        for dimension, kind, name, cells in [*groups, (2, 16, body, elements(numbers, Q8, 2))]:
            names.append((dimension, len(names) + 1, name))
            blocks.append((kind, len(names), cells))
    nodes = np.concatenate(nodes)
    table = np.zeros(len(nodes), dtype=[("tag", "i4"), ("x", "f8", 3)])
    table["tag"], table["x"][:, :2] = 1 + np.arange(len(nodes)), nodes
    with open(path, "wb") as file:
        say = lambda text: file.write(text.encode())
        say("$MeshFormat\n2.2 1 8\n")
        file.write(np.int32(1).tobytes())
        say(f"\n$EndMeshFormat\n$PhysicalNames\n{len(names)}\n")
        say("".join(f'{dimension} {tag} "{name}"\n' for dimension, tag, name in names))
        say(f"$EndPhysicalNames\n$Nodes\n{len(nodes)}\n")
        file.write(table.tobytes())
        say(f"\n$EndNodes\n$Elements\n{sum(len(cells) for _, _, cells in blocks)}\n")
        first = 1
        for kind, tag, cells in blocks:
            tags = np.stack([first + np.arange(len(cells)), *np.full((2, len(cells)), tag)], axis=1)
            file.write(np.array([kind, len(cells), 2], dtype="i4").tobytes())
            file.write(np.hstack([tags, cells]).astype("i4").tobytes())
            first += len(cells)
        say("\n$EndElements\n")


def write_freefem(path, sizes, grading):
    """Triangles, two of each quadrilateral, as FreeFEM's savemesh() writes them; curve k of CURVES has label k + 1."""
    vertices, triangles, ends = [], [], []
    for number, (body, numbers, places) in enumerate(bodies(sizes, grading, 1)):
        vertices.append(places)
        triangles += [np.pad(elements(numbers, corners, 1), ((0, 0), (0, 1)), constant_values=number)
                      for corners in TRIANGLES]  # fmt: skip
        ends += [np.pad(edges(numbers, 1)[side], ((0, 0), (0, 1)), constant_values=4 * number + k + 1)
                 for k, side in enumerate(SIDES)]  # fmt: skip
    vertices, triangles, ends = map(np.concatenate, (vertices, triangles, ends))
    with open(path, "w") as file:
        file.write(f"{len(vertices)} {len(triangles)} {len(ends)}\n")
        np.savetxt(file, np.pad(vertices, ((0, 0), (0, 1))), fmt="%.17g %.17g %d")
        np.savetxt(file, triangles, fmt="%d")
        np.savetxt(file, ends, fmt="%d")
