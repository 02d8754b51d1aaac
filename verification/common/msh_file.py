"""A .msh file as a list of sections of single values, so that each of them can be changed before it is written.

All four kinds: format 2.2 and 4.1, as text and binary (gmsh's manual, "MSH file format"). A value knows what it stands
for (`role`: 'node tag', 'x', 'number of nodes', ...) and how the format writes it.
"""

import struct
from dataclasses import dataclass, field

KINDS = ("2.2 ascii", "2.2 binary", "4.1 ascii", "4.1 binary")
WIDTHS = {"i": 4, "z": 8}  # bytes


@dataclass
class Value:
    role: str
    kind: str  # i: int, z: size_t, d: double, t: text in both forms
    value: object
    end: str = " "  # what follows it in text


@dataclass
class Section:
    name: str
    values: list = field(default_factory=list)
    closed: bool = True  # whether $EndNAME is written


def section(name, *lines):
    """A section of lines; a line is a list of (role, kind, values...)."""
    made = Section(name)
    for line in lines:
        made.values += [Value(role, kind, value) for role, kind, *values in line for value in values]
        made.values[-1].end = "\n"
    return made


def sections(mesh, kind, tag_of=lambda node: node + 1):
    """The sections of `mesh` in the format `kind`; `tag_of` numbers the nodes."""
    version, form = kind.split()
    binary = form == "binary"
    head = [("version", "t", version), ("whether binary", "t", int(binary)), ("size of a real number", "t", 8)]
    names = [(1, name) for name in mesh.curves] + [(2, name) for name in mesh.bodies]
    return [
        section("MeshFormat", head, *([[("byte order", "i", 1)]] if binary else [])),
        section("PhysicalNames", [("number of names", "t", len(names))], *(
            [("dimension of a name", "t", dimension), ("tag of a name", "t", tag), ("name", "t", f'"{name}"')]
            for tag, (dimension, name) in enumerate(names, 1))),
        *(sections_2_2(mesh, tag_of, binary) if version == "2.2" else sections_4_1(mesh, tag_of)),
    ]  # fmt: skip


def elements_of(mesh):
    """(dimension, entity, type, nodes); an entity of its own for each curve and body, its number that of the name."""
    for curve, kind, nodes in mesh.edges:
        yield 1, curve + 1, kind, nodes
    for body, kind, nodes in mesh.cells:
        yield 2, len(mesh.curves) + body + 1, kind, nodes


def sections_2_2(mesh, tag_of, binary):
    listed = list(elements_of(mesh))
    nodes = [[("node tag", "i", tag_of(node)), ("coordinate", "d", x, y), ("z", "d", 0.0)]
             for node, (x, y) in enumerate(mesh.nodes)]
    elements = []
    for number, (_, entity, kind, members) in enumerate(listed, 1):
        tag, type_, tags = ("element tag", "i", number), ("element type", "i", kind), ("number of tags", "i", 2)
        one = ("number of elements in the block", "i", 1)  # in binary, a block for each
        elements.append([*([type_, one, tags, tag] if binary else [tag, type_, tags]), ("physical tag", "i", entity),
                         ("entity", "i", entity), ("node of an element", "i", *map(tag_of, members))])
    return [section("Nodes", [("number of nodes", "t", len(nodes))], *nodes),
            section("Elements", [("number of elements", "t", len(listed))], *elements)]


def sections_4_1(mesh, tag_of):
    (xs, ys), tags = zip(*mesh.nodes), [tag_of(node) for node in range(len(mesh.nodes))]
    box = (min(xs), min(ys), 0.0, max(xs), max(ys), 0.0)
    entities = [[("entity", "i", entity), ("box", "d", *box), ("number of physical tags", "z", 1),
                 ("physical tag", "i", entity), ("number of bounding entities", "z", 0)]
                for entity in range(1, len(mesh.curves) + len(mesh.bodies) + 1)]
    nodes = [
        [("number of blocks", "z", 1), ("number of nodes", "z", len(tags)),
         ("smallest or largest tag", "z", min(tags), max(tags))],
        [("dimension of a block", "i", 2), ("entity of a block", "i", len(mesh.curves) + 1),
         ("whether parametric", "i", 0), ("number of nodes in the block", "z", len(tags))],
        *([("node tag", "z", tag)] for tag in tags),
        *([("coordinate", "d", x, y), ("z", "d", 0.0)] for x, y in mesh.nodes),
    ]  # fmt: skip
    blocks, elements, number = {}, [], 0
    for dimension, entity, kind, members in elements_of(mesh):
        blocks.setdefault((dimension, entity, kind), []).append(members)
    for (dimension, entity, kind), block in blocks.items():
        elements.append([("dimension of a block", "i", dimension), ("entity of a block", "i", entity),
                         ("element type", "i", kind), ("number of elements in the block", "z", len(block))])
        for number, members in enumerate(block, number + 1):
            elements.append([("element tag", "z", number), ("node of an element", "z", *map(tag_of, members))])
    head = [("number of blocks", "z", len(blocks)), ("number of elements", "z", number),
            ("smallest or largest tag", "z", 1, number)]
    counts = ("number of entities", "z", 0, len(mesh.curves), len(mesh.bodies), 0)
    return [section("Entities", [counts], *entities), section("Nodes", *nodes), section("Elements", head, *elements)]


def as_text(value):
    number = repr(value.value) if isinstance(value.value, float) else str(value.value)
    return (number + value.end).encode("utf-8", "surrogateescape")


def as_binary(value):
    """A value as the format's bytes; one that does not fit is cut to its lowest bytes."""
    if value.kind == "t" or isinstance(value.value, str):
        return as_text(value)
    if value.kind == "d":
        return struct.pack("<d", float(value.value))
    size = WIDTHS[value.kind]
    return (int(value.value) % 256**size).to_bytes(size, "little")


def write(listed, kind):
    """The bytes of a file with these sections."""
    binary, parts = kind.endswith("binary"), []
    for part in listed:
        body = b"".join(map(as_binary if binary else as_text, part.values))
        text_last = part.values and (not binary or part.values[-1].kind == "t")
        parts += [f"${part.name}\n", body if text_last and body.endswith(b"\n") else body + b"\n"]
        parts += [f"$End{part.name}\n"] if part.closed else []
    return b"".join(part if isinstance(part, bytes) else part.encode("utf-8", "surrogateescape") for part in parts)
