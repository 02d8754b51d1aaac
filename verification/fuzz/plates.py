"""Tiny meshes of plates that lie on one another, as plain data: what the scenes and the broken meshes are made from."""

from dataclasses import dataclass, field, replace

# gmsh's numbers of the element types, and of the edges that belong to them.
TRI3, TRI6, QUAD4, QUAD8, QUAD9 = 2, 9, 3, 16, 10
LINE2, LINE3 = 1, 8
CELL_TYPES = (TRI3, TRI6, QUAD4, QUAD8, QUAD9)
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
class Plate:
    """One plate: between the lines `below` and `above` (functions of x) from x = left to right."""

    name: str
    left: float
    right: float
    below: object
    above: object
    columns: int
    rows: int
    cell: int  # gmsh's element type
    straight: bool = False  # second-order nodes at the middles of straight edges


def add_plate(mesh, plate):
    """Adds the plate's nodes, its cells, and its four curves NAME_bottom, NAME_right, NAME_top, NAME_left."""
    step = 2 if plate.cell in (TRI6, QUAD8, QUAD9) else 1
    width, height, numbers = step * plate.columns, step * plate.rows, {}

    def position(i, j):
        x = plate.left + (plate.right - plate.left) * i / width
        low, high = plate.below(x), plate.above(x)
        return x, low + (high - low) * j / height

    def node(i, j):
        if (i, j) not in numbers:
            place = position(i, j)
            if plate.straight and (i % step or j % step):
                before = (i - i % step, j - j % step)
                after = (before[0] + step * (i % step > 0), before[1] + step * (j % step > 0))
                place = tuple(sum(pair) / 2 for pair in zip(position(*before), position(*after)))
            numbers[i, j] = len(mesh.nodes)
            mesh.nodes.append(place)
        return numbers[i, j]

    for column, row in ((column, row) for column in range(plate.columns) for row in range(plate.rows)):
        for lattice in CELLS[plate.cell]:
            nodes = [node(step * column + i, step * row + j) for i, j in lattice]
            mesh.cells.append((len(mesh.bodies), plate.cell, nodes))
    mesh.bodies.append(plate.name)

    def edges(name, starts, along):
        for i, j in starts:
            places = [(i, j), (i + step * along[0], j + step * along[1]), (i + along[0], j + along[1])][: step + 1]
            nodes = [node(*place) for place in places]
            mesh.edges.append((len(mesh.curves), LINE3 if step == 2 else LINE2, nodes))
        mesh.curves.append(f"{plate.name}_{name}")

    edges("bottom", [(i, 0) for i in range(0, width, step)], (1, 0))
    edges("right", [(width, j) for j in range(0, height, step)], (0, 1))
    edges("top", [(i, height) for i in range(width, 0, -step)], (-1, 0))
    edges("left", [(0, j) for j in range(height, 0, -step)], (0, -1))


def plates_mesh(plates):
    mesh = Mesh()
    for plate in plates:
        add_plate(mesh, plate)
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
