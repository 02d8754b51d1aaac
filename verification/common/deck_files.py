"""Meshes of plates.py as other programs' decks: .inp of Abaqus, universal files."""

import plates

INP = {plates.TRI3: "CPS3", plates.TRI6: "CPS6", plates.QUAD4: "CPS4", plates.QUAD8: "CPS8", plates.LINE2: "T2D2",
       plates.LINE3: "T2D3"}  # fmt: skip
UNV = {plates.TRI3: 41, plates.TRI6: 42, plates.QUAD4: 44, plates.QUAD8: 45, plates.LINE2: 11, plates.LINE3: 24}


def groups(mesh):
    """(name, [(number, type, nodes)]) of each body and curve; elements are numbered from 1."""
    found = [(name, []) for name in [*mesh.bodies, *mesh.curves]]
    listed = mesh.cells + [(len(mesh.bodies) + curve, kind, nodes) for curve, kind, nodes in mesh.edges]
    for number, (owner, kind, nodes) in enumerate(listed, 1):
        found[owner][1].append((number, kind, nodes))
    return found


def inp(mesh, tag_of):
    lines = ["*NODE", *(f"{tag_of(node)}, {x!r}, {y!r}" for node, (x, y) in enumerate(mesh.nodes))]
    for name, elements in groups(mesh):
        for number, kind, nodes in elements:
            ordered = [nodes[0], nodes[2], nodes[1]] if kind == plates.LINE3 else nodes
            lines += [f"*ELEMENT, TYPE={INP[kind]}, ELSET={name}", ", ".join(map(str, [number, *map(tag_of, ordered)]))]
    return "\n".join(lines) + "\n"


def unv(mesh, tag_of):
    """Corners and middle nodes take turns; beams have a line of their own behind the head."""
    head = lambda *numbers: "".join(f"{n:10d}" for n in numbers)
    dataset = lambda number, lines: ["    -1", f"{number:6d}", *lines, "    -1"]
    nodes, elements, named = [], [], []
    for node, (x, y) in enumerate(mesh.nodes):
        nodes += [head(tag_of(node), 1, 1, 11), "".join(f"{v:25.16E}".replace("E", "D") for v in (x, y, 0.0))]
    for tag, (name, members) in enumerate(groups(mesh), 1):
        named += [head(tag, 0, 0, 0, 0, 0, 0, len(members)), name]
        named += [head(8, number, 0, 0) for number, _, _ in members]
        for number, kind, own in members:
            corners = {plates.LINE3: 2, plates.TRI6: 3, plates.QUAD8: 4}.get(kind, len(own))
            turns = [n for pair in zip(own, own[corners:]) for n in pair] if corners < len(own) else own
            turns += own[1:2] if kind == plates.LINE3 else []
            elements += [head(number, UNV[kind], 1, 1, 7, len(own)), *([head(0, 1, 1)] if UNV[kind] < 41 else []),
                         head(*map(tag_of, turns))]  # fmt: skip
    return "\n".join([*dataset(2411, nodes), *dataset(2412, elements), *dataset(2467, named)]) + "\n"


WRITERS = {".inp": inp, ".unv": unv}
