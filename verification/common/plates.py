"""Small structured meshes of a few bodies as plain data, with cells of any kind; msh_file writes them."""

from dataclasses import dataclass, field, replace
from typing import Callable

import numpy as np

# gmsh's numbers of the element types, and of the edges that belong to them.
TRI3, TRI6, QUAD4, QUAD8, QUAD9 = 2, 9, 3, 16, 10
LINE2, LINE3 = 1, 8
CELL_TYPES = (TRI3, TRI6, QUAD4, QUAD8, QUAD9)
CELL_NAMES = dict(zip(CELL_TYPES, ("T3", "T6", "Q4", "Q8", "Q9")))
# Places of the nodes on the lattice, in gmsh's order, of the one quadrilateral or the two triangles at (0, 0): corners
# A ... D, and with second-order nodes (lattice of half the width) also the middles of the sides and the centre.
A, B, C, D = (0, 0), (1, 0), (1, 1), (0, 1)
A2, B2, C2, D2, AB, BC, CD, DA, CENTRE = (0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1), (1, 1)
CELLS = {
    QUAD4: [[A, B, C, D]],
    TRI3: [[A, B, C], [A, C, D]],
    TRI6: [[A2, B2, C2, AB, BC, CENTRE], [A2, C2, D2, CENTRE, CD, DA]],
    QUAD8: [[A2, B2, C2, D2, AB, BC, CD, DA]],
    QUAD9: [[A2, B2, C2, D2, AB, BC, CD, DA, CENTRE]],
}


@dataclass
class Mesh:
    """Nodes by their index from 0; `cells` (body, type, nodes) and `edges` (curve, type, nodes) refer to them."""

    nodes: list = field(default_factory=list)  # (x, y)
    bodies: list = field(default_factory=list)  # names of the physical surfaces
    curves: list = field(default_factory=list)  # names of the physical curves
    cells: list = field(default_factory=list)
    edges: list = field(default_factory=list)


@dataclass
class Body:
    """One body: the unit square, put to place(s, t)."""

    name: str
    columns: list  # s of the vertices across, from 0 to 1
    rows: int
    place: Callable
    cell: int = QUAD8
    straight: bool = False  # second-order nodes at the middles of straight edges; else where place() has them
    split: float | None = None  # the top from there on (in s) is a curve of its own, NAME_top2

    def put(self, to):
        """The same body with every place (x, y) put to to(x, y)."""
        return replace(self, place=lambda s, t: to(*self.place(s, t)))


def even(count):
    return [i / count for i in range(count + 1)]


def between(left, right, below, above):
    """Place of a body between two curves y(x): numbers or functions."""
    y = lambda curve, x: curve(x) if callable(curve) else curve

    def place(s, t):
        x = left + (right - left) * s
        return x, y(below, x) * (1 - t) + y(above, x) * t

    return place


def add_body(mesh, body, known):
    """Adds the body's nodes, its cells, and its curves NAME_bottom, _right, _top, (_top2,) _left; returns the nodes'
    numbers by their places. A node at a place that is `known` is that one."""
    step = 2 if body.cell in (TRI6, QUAD8, QUAD9) else 1
    width, height, numbers, places = step * (len(body.columns) - 1), step * body.rows, {}, {}
    s_of = np.interp(np.arange(width + 1) / step, np.arange(len(body.columns)), body.columns)
    t_of = np.linspace(0, 1, height + 1)
    position = lambda i, j: tuple(map(float, body.place(s_of[i], t_of[j])))

    def node(i, j):
        if (i, j) not in numbers:
            place = position(i, j)
            if body.straight and (i % step or j % step):
                before = (i - i % step, j - j % step)
                after = (before[0] + step * (i % step > 0), before[1] + step * (j % step > 0))
                place = tuple(sum(pair) / 2 for pair in zip(position(*before), position(*after)))
            rounded = tuple(round(x, 12) for x in place)
            if rounded not in known:
                mesh.nodes.append(place)
            numbers[i, j] = places[rounded] = known.get(rounded, len(mesh.nodes) - 1)
        return numbers[i, j]

    for row, column in ((row, column) for row in range(body.rows) for column in range(len(body.columns) - 1)):
        for lattice in CELLS[body.cell]:
            nodes = [node(step * column + i, step * row + j) for i, j in lattice]
            mesh.cells.append((len(mesh.bodies), body.cell, nodes))
    mesh.bodies.append(body.name)
    second = lambda i: body.split is not None and s_of[i] + s_of[i + step] > 2 * body.split
    across, up = range(0, width, step), range(0, height, step)
    sides = {
        "bottom": [((i, 0), (i + step, 0)) for i in across],
        "right": [((width, j), (width, j + step)) for j in up],
        "top": [((i + step, height), (i, height)) for i in across if not second(i)],
        "left": [((0, j + step), (0, j)) for j in up],
        "top2": [((i + step, height), (i, height)) for i in across if second(i)],
    }
    for name, edges in ((name, edges) for name, edges in sides.items() if edges):
        for a, b in edges:
            ends = [a, b, ((a[0] + b[0]) // 2, (a[1] + b[1]) // 2)][: step + 1]
            mesh.edges.append((len(mesh.curves), LINE3 if step == 2 else LINE2, [node(*end) for end in ends]))
        mesh.curves.append(f"{body.name}_{name}")
    return places


def mesh_of(bodies, join=()):
    """`join`: pairs of bodies whose nodes at the same places are one."""
    mesh, places = Mesh(), {}
    for body in bodies:
        partners = [name for pair in join if body.name in pair for name in pair if name in places]
        known = {place: node for name in partners for place, node in places[name].items()}
        places[body.name] = add_body(mesh, body, known)
    return mesh


def moved(mesh, place):
    """The same mesh with every node put to place(x, y)."""
    return replace(mesh, nodes=[place(x, y) for x, y in mesh.nodes])


def shuffled(mesh, random):
    """The same mesh with its nodes, cells and edges in another order."""
    order = list(range(len(mesh.nodes)))
    random.shuffle(order)
    new = {old: number for number, old in enumerate(order)}
    cells, edges = ([(owner, kind, [new[n] for n in nodes]) for owner, kind, nodes in listed]
                    for listed in (mesh.cells, mesh.edges))
    random.shuffle(cells)
    random.shuffle(edges)
    return replace(mesh, nodes=[mesh.nodes[old] for old in order], cells=cells, edges=edges)
