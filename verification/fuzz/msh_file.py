"""A .msh file as a list of sections of single values, so that each of them can be changed before it is written.

All four kinds: format 2.2 and 4.1, as text and binary (gmsh's manual, "MSH file format"). A value knows what it stands
for (`role`: 'node tag', 'x', 'number of nodes', ...) and how the format writes it.
"""

import struct
from dataclasses import dataclass, field

KINDS = ("2.2 ascii", "2.2 binary", "4.1 ascii", "4.1 binary")
WIDTHS = {"i": "<i", "z": "<Q", "d": "<d"}


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

    def add(self, role, kind, *values, end=" "):
        self.values += [Value(role, kind, value) for value in values]
        self.values[-1].end = end


def sections(mesh, kind, tag_of=lambda node: node + 1):
    """The sections of `mesh` in the format `kind`; `tag_of` numbers the nodes."""
    version, form = kind.split()
    start = Section("MeshFormat")
    start.add("version", "t", version)
    start.add("whether binary", "t", int(form == "binary"))
    start.add("size of a real number", "t", 8, end="\n")
    if form == "binary":
        start.add("byte order", "i", 1, end="\n")
    rest = sections_2_2(mesh, tag_of, form) if version == "2.2" else sections_4_1(mesh, tag_of)
    return [start, physical_names(mesh), *rest]


def physical_names(mesh):
    names = Section("PhysicalNames")
    names.add("number of names", "t", len(mesh.bodies) + len(mesh.curves), end="\n")
    groups = [(1, k + 1, name) for k, name in enumerate(mesh.curves)]
    groups += [(2, len(mesh.curves) + k + 1, name) for k, name in enumerate(mesh.bodies)]
    for dimension, tag, name in groups:
        names.add("dimension of a name", "t", dimension)
        names.add("tag of a name", "t", tag)
        names.add("name", "t", f'"{name}"', end="\n")
    return names


def elements_of(mesh):
    """(dimension, entity, type, nodes); an entity of its own for each curve and body, its number that of the name."""
    for curve, kind, nodes in mesh.edges:
        yield 1, curve + 1, kind, nodes
    for body, kind, nodes in mesh.cells:
        yield 2, len(mesh.curves) + body + 1, kind, nodes


def sections_2_2(mesh, tag_of, form):
    nodes = Section("Nodes")
    nodes.add("number of nodes", "t", len(mesh.nodes), end="\n")
    for node, (x, y) in enumerate(mesh.nodes):
        nodes.add("node tag", "i", tag_of(node))
        nodes.add("coordinate", "d", x, y)
        nodes.add("z", "d", 0.0, end="\n")
    elements = Section("Elements")
    listed = list(elements_of(mesh))
    elements.add("number of elements", "t", len(listed), end="\n")
    for number, (_, entity, kind, members) in enumerate(listed):
        if form == "binary":  # a block of one element each
            elements.add("element type", "i", kind)
            elements.add("number of elements in the block", "i", 1)
            elements.add("number of tags", "i", 2)
            elements.add("element tag", "i", number + 1)
        else:
            elements.add("element tag", "i", number + 1)
            elements.add("element type", "i", kind)
            elements.add("number of tags", "i", 2)
        elements.add("physical tag", "i", entity)
        elements.add("entity", "i", entity)
        elements.add("node of an element", "i", *(tag_of(node) for node in members), end="\n")
    return [nodes, elements]


def sections_4_1(mesh, tag_of):
    xs, ys = [x for x, _ in mesh.nodes], [y for _, y in mesh.nodes]
    box = (min(xs), min(ys), 0.0, max(xs), max(ys), 0.0)
    entities = Section("Entities")
    entities.add("number of entities", "z", 0, len(mesh.curves), len(mesh.bodies), 0, end="\n")
    for entity in range(1, len(mesh.curves) + len(mesh.bodies) + 1):
        entities.add("entity", "i", entity)
        entities.add("box", "d", *box)
        entities.add("number of physical tags", "z", 1)
        entities.add("physical tag", "i", entity)
        entities.add("number of bounding entities", "z", 0, end="\n")

    tags = [tag_of(node) for node in range(len(mesh.nodes))]
    nodes = Section("Nodes")
    nodes.add("number of blocks", "z", 1)
    nodes.add("number of nodes", "z", len(tags))
    nodes.add("smallest or largest tag", "z", min(tags), max(tags), end="\n")
    nodes.add("dimension of a block", "i", 2)
    nodes.add("entity of a block", "i", len(mesh.curves) + 1)
    nodes.add("whether parametric", "i", 0)
    nodes.add("number of nodes in the block", "z", len(tags), end="\n")
    for tag in tags:
        nodes.add("node tag", "z", tag, end="\n")
    for x, y in mesh.nodes:
        nodes.add("coordinate", "d", x, y)
        nodes.add("z", "d", 0.0, end="\n")

    blocks = {}
    for dimension, entity, kind, members in elements_of(mesh):
        blocks.setdefault((dimension, entity, kind), []).append(members)
    count = sum(len(block) for block in blocks.values())
    elements = Section("Elements")
    elements.add("number of blocks", "z", len(blocks))
    elements.add("number of elements", "z", count)
    elements.add("smallest or largest tag", "z", 1, count, end="\n")
    number = 0
    for (dimension, entity, kind), block in blocks.items():
        elements.add("dimension of a block", "i", dimension)
        elements.add("entity of a block", "i", entity)
        elements.add("element type", "i", kind)
        elements.add("number of elements in the block", "z", len(block), end="\n")
        for members in block:
            number += 1
            elements.add("element tag", "z", number)
            elements.add("node of an element", "z", *(tag_of(node) for node in members), end="\n")
    return [entities, nodes, elements]


def as_text(value):
    number = repr(value.value) if isinstance(value.value, float) else str(value.value)
    return (number + value.end).encode("utf-8", "surrogateescape")


def as_binary(value):
    """A value as the format's bytes; one that does not fit is cut to its lowest bytes."""
    if value.kind == "t" or isinstance(value.value, str):
        return as_text(value)
    if value.kind == "d":
        return struct.pack("<d", float(value.value))
    size = struct.calcsize(WIDTHS[value.kind])
    return (int(value.value) % 256**size).to_bytes(size, "little")


def write(listed, kind):
    """The bytes of a file with these sections."""
    binary = kind.endswith("binary")
    parts = []
    for section in listed:
        parts.append(f"${section.name}\n".encode("utf-8", "surrogateescape"))
        body = b"".join(as_binary(v) if binary else as_text(v) for v in section.values)
        text_last = section.values and (not binary or section.values[-1].kind == "t")
        parts.append(body if text_last and body.endswith(b"\n") else body + b"\n")
        if section.closed:
            parts.append(f"$End{section.name}\n".encode("utf-8", "surrogateescape"))
    return b"".join(parts)
