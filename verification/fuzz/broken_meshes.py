"""Mesh files with something wrong in them, and some that are only unusual."""

import copy

import msh_file
from fuzz_case import ANY, REFUSED
from msh_file import Section, Value

ROLES_OF_COUNTS = ("number of nodes", "number of elements", "number of blocks", "number of names",
                   "number of nodes in the block", "number of elements in the block", "number of tags",
                   "number of physical tags", "number of bounding entities", "number of entities")
NUMBERS = (0, -1, 1, 2**31 - 1, 2**31, -(2**31), 2**63, 2**64 - 1, 10**6)
STRANGE_NAMES = ('""', '"', '"a\nb"', '"\x1b[31mred\x07"', '"=1+1"', '"' + "n" * 5000 + '"', "bare", '"\udcff"')
REALS = (float("nan"), float("inf"), float("-inf"), 1e308, -1e308, 5e-324, 1e30, 0.0)


def values(listed, *roles):
    return [v for section in listed for v in section.values if not roles or v.role in roles]


def named(listed, name):
    return next((section for section in listed if section.name == name), None)


def count_off(random, listed):
    """A count is one more or one less than what follows."""
    value = random.choice(values(listed, *ROLES_OF_COUNTS))
    step = random.choice((-1, 1))
    value.value = max(0, int(value.value) + step)
    # A block with one tag less or one bounding entity more may still be read, with the numbers that follow shifted.
    strict = value.role in ROLES_OF_COUNTS[:3]
    return f"{value.role}: {value.value}, {step:+d}", REFUSED if strict else ANY


def count_wild(random, listed):
    value = random.choice(values(listed, *ROLES_OF_COUNTS))
    value.value = random.choice(NUMBERS)
    return f"{value.role}: {value.value}", ANY


def number_wild(random, listed):
    """Any whole number becomes another one."""
    value = random.choice([v for v in values(listed) if v.kind in "iz"])
    value.value = random.choice(NUMBERS)
    return f"{value.role}: {value.value}", ANY


def tag_below_one(random, listed):
    value = random.choice(values(listed, "node tag"))
    old, value.value = value.value, random.choice((0, -1, -(2**31)))
    if random.random() < 0.5:  # and all that refer to it
        for other in values(listed, "node of an element"):
            other.value = value.value if other.value == old else other.value
    return f"node tag {value.value}", REFUSED


def tag_huge(random, listed):
    value = random.choice(values(listed, "node tag"))
    old, value.value = value.value, random.choice((2**31 - 1, 10**9, 10**7))
    for other in values(listed, "node of an element"):
        other.value = value.value if other.value == old else other.value
    return f"node tag {value.value}", ANY


def node_twice(random, listed):
    tags = values(listed, "node tag")
    first, second = random.sample(tags, 2)
    second.value = first.value
    return "a node tag twice", REFUSED


def unknown_node(random, listed):
    value = random.choice(values(listed, "node of an element"))
    value.value = random.choice((0, -1, 999999, 2**31 - 1))
    return f"an element with the node {value.value}", REFUSED


def unknown_type(random, listed):
    value = random.choice(values(listed, "element type"))
    value.value = random.choice((0, -1, 15, 17, 20, 21, 26, 31, 66, 140, 999, 2**31 - 1))
    return f"element type {value.value}", REFUSED


def not_finite(random, listed):
    value = random.choice(values(listed, "coordinate", "z"))
    value.value = random.choice(REALS[:3])
    return f"{value.role} {value.value}", REFUSED


def coordinate_wild(random, listed):
    value = random.choice(values(listed, "coordinate", "z"))
    value.value = random.choice(REALS[3:])
    return f"{value.role} {value.value}", ANY


def nodes_swapped(random, listed):
    """An element lists its nodes in another order."""
    members = values(listed, "node of an element")
    place = random.randrange(len(members) - 1)
    members[place].value, members[place + 1].value = members[place + 1].value, members[place].value
    return "two nodes of elements exchanged", ANY


def section_twice(random, listed):
    section = random.choice(listed[2:])
    listed.append(copy.deepcopy(section))
    return f"${section.name} twice", REFUSED


def section_missing(random, listed):
    section = random.choice(listed)
    listed.remove(section)
    return f"no ${section.name}", REFUSED


def section_open(random, listed):
    section = random.choice(listed)
    section.closed = False
    return f"no $End{section.name}", REFUSED


def section_empty(random, listed):
    section = random.choice(listed)
    section.values = []
    return f"${section.name} is empty", REFUSED


def sections_swapped(random, listed):
    """Any order but that the header comes first; gmsh asks for nodes before elements."""
    random.shuffle(listed)
    return "sections: " + ", ".join(section.name for section in listed), ANY


def other_sections(random, listed):
    """Sections that other programs write: to be passed over."""
    strange = Section(random.choice(("Comments", "NodeData", "Periodic", "\x1b[31mRed", "N" * 5000)))
    strange.values = [Value("strange", "t", "some text", "\n")]
    listed.insert(random.randrange(1, len(listed) + 1), strange)
    return f"a section ${strange.name[:20]!r}", ANY


def name_strange(random, listed):
    value = random.choice(values(listed, "name"))
    value.value = random.choice(STRANGE_NAMES)
    return f"a physical name {value.value[:20]!r}", ANY


def name_twice(random, listed):
    first, second = random.sample(values(listed, "name"), 2)
    second.value = first.value
    return "a physical name twice", ANY


def header(random, listed):
    value = random.choice(listed[0].values)
    value.value = random.choice((0, 1, 2, 3, "4.0", "2.1", "9.9", -1, "abc", ""))
    return f"{value.role}: {value.value!r}", ANY


# After these the mesh is the same, if it can be read at all.
KEEPS_THE_MESH = (tag_huge, sections_swapped, other_sections, name_strange, name_twice, header)
CHANGES = (count_off, count_off, count_wild, number_wild, tag_below_one, node_twice, unknown_node, unknown_type,
           not_finite, coordinate_wild, nodes_swapped, section_twice, section_missing, section_open, section_empty,
           *KEEPS_THE_MESH)


def cell_twice(random, mesh):
    """A cell or an edge of the mesh listed twice: not a change of the file but of the mesh."""
    listed = random.choice((mesh.cells, mesh.edges))
    listed.append(random.choice(listed))
    return ("a cell" if listed is mesh.cells else "an edge") + " listed twice", REFUSED if listed is mesh.cells else ANY


def change_bytes(random, data):
    """Bytes lost, added or changed anywhere in the file."""
    choice = random.choice(("cut off", "cut off", "one byte", "garbage", "empty", "text behind", "zeros"))
    place = random.randrange(len(data))
    if choice == "cut off":
        ends_early = place < data.rfind(b"$EndElements")
        return data[:place], choice, REFUSED if ends_early else ANY
    if choice == "one byte":
        return data[:place] + bytes([random.randrange(256)]) + data[place + 1 :], choice, ANY
    if choice == "garbage":
        return bytes(random.randrange(256) for _ in range(random.choice((1, 50, 5000)))), choice, REFUSED
    if choice == "empty":
        return b"", choice, REFUSED
    if choice == "text behind":
        return data + b"the end\n", choice, ANY
    return data[:place] + bytes(len(data) - place), choice, ANY


def broken_file(random, mesh):
    """The kind of a file, its bytes, what is wrong, what must come of it, and whether the mesh is still the same."""
    kind = random.choice(msh_file.KINDS)
    sort = random.random()
    if sort < 0.05:
        changed = copy.deepcopy(mesh)
        what, expect = cell_twice(random, changed)
        return kind, msh_file.write(msh_file.sections(changed, kind), kind), what, expect, False
    listed = msh_file.sections(mesh, kind)
    if sort < 0.75:
        change = random.choice(CHANGES)
        what, expect = change(random, listed)
        return kind, msh_file.write(listed, kind), what, expect, change in KEEPS_THE_MESH
    return kind, *change_bytes(random, msh_file.write(listed, kind)), False
