"""Tiny meshes of plates that lie on one another, as plain data: what the scenes and the broken meshes are made from."""

from dataclasses import dataclass, field, replace

# gmsh's numbers of the element types, and of the edges that belong to them.
TRI3, TRI6, QUAD4, QUAD8, QUAD9 = 2, 9, 3, 16, 10
LINE2, LINE3 = 1, 8
CELL_TYPES = (TRI3, TRI6, QUAD4, QUAD8, QUAD9)
NODES_OF = {LINE2: 2, LINE3: 3, TRI3: 3, TRI6: 6, QUAD4: 4, QUAD8: 8, QUAD9: 9, 15: 1}


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


def is_quadratic(cell):
    return cell in (TRI6, QUAD8, QUAD9)


def add_plate(mesh, plate):
    """Adds the plate's nodes, its cells, and its four curves NAME_bottom, NAME_right, NAME_top, NAME_left."""
    step = 2 if is_quadratic(plate.cell) else 1
    width, height = step * plate.columns, step * plate.rows

    def position(i, j):
        x = plate.left + (plate.right - plate.left) * i / width
        low, high = plate.below(x), plate.above(x)
        return x, low + (high - low) * j / height

    def mean(*places):
        return tuple(sum(values) / len(places) for values in zip(*places))

    numbers = {}

    def node(i, j):
        if (i, j) not in numbers:
            place = position(i, j)
            if plate.straight and (i % step or j % step):
                before = (i - i % step, j - j % step)
                after = (before[0] + step * (i % step > 0), before[1] + step * (j % step > 0))
                place = mean(position(*before), position(*after))
            numbers[i, j] = len(mesh.nodes)
            mesh.nodes.append(place)
        return numbers[i, j]

    body = len(mesh.bodies)
    mesh.bodies.append(plate.name)
    for column in range(plate.columns):
        for row in range(plate.rows):
            for lattice in cells_at(plate.cell, step * column, step * row):
                mesh.cells.append((body, plate.cell, [node(i, j) for i, j in lattice]))

    def edges(name, starts, along):
        curve = len(mesh.curves)
        mesh.curves.append(f"{plate.name}_{name}")
        for i, j in starts:
            places = [(i, j), (i + step * along[0], j + step * along[1])]
            if step == 2:
                places.append((i + along[0], j + along[1]))
            mesh.edges.append((curve, LINE3 if step == 2 else LINE2, [node(*place) for place in places]))

    edges("bottom", [(i, 0) for i in range(0, width, step)], (1, 0))
    edges("right", [(width, j) for j in range(0, height, step)], (0, 1))
    edges("top", [(i, height) for i in range(width, 0, -step)], (-1, 0))
    edges("left", [(0, j) for j in range(height, 0, -step)], (0, -1))


def cells_at(cell, i, j):
    """Places of the nodes, on the lattice, of the one quadrilateral or the two triangles at (i, j); gmsh's order."""
    if cell in (QUAD4, TRI3):
        a, b, c, d = (i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)
        return [[a, b, c, d]] if cell == QUAD4 else [[a, b, c], [a, c, d]]
    a, b, c, d = (i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2)
    ab, bc, cd, da, centre = (i + 1, j), (i + 2, j + 1), (i + 1, j + 2), (i, j + 1), (i + 1, j + 1)
    if cell == TRI6:
        return [[a, b, c, ab, bc, centre], [a, c, d, centre, cd, da]]
    return [[a, b, c, d, ab, bc, cd, da] + ([centre] if cell == QUAD9 else [])]


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
    cells = [(body, kind, [new[n] for n in nodes]) for body, kind, nodes in mesh.cells]
    edges = [(curve, kind, [new[n] for n in nodes]) for curve, kind, nodes in mesh.edges]
    random.shuffle(cells)
    random.shuffle(edges)
    return replace(mesh, nodes=[mesh.nodes[old] for old in order], cells=cells, edges=edges)
