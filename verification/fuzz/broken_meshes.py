"""Mesh files with something wrong in them, and some that are only unusual.

A change takes the random numbers and the sections, and says what it has done and what must come of it.
"""

import copy

import msh_file
from fuzz_case import ANY, REFUSED
from msh_file import Section, Value

COUNTS = ("number of nodes", "number of elements", "number of blocks", "number of names",
          "number of nodes in the block", "number of elements in the block", "number of tags",
          "number of physical tags", "number of bounding entities", "number of entities")  # fmt: skip
NUMBERS = (0, -1, 1, 2**31 - 1, 2**31, -(2**31), 2**63, 2**64 - 1, 10**6)
TYPES = (0, -1, 15, 17, 20, 21, 26, 31, 66, 140, 999, 2**31 - 1)
STRANGE_NAMES = ('""', '"', '"a\nb"', '"\x1b[31mred\x07"', '"=1+1"', '"' + "n" * 5000 + '"', "bare", '"\udcff"')
NOT_FINITE, REALS = (float("nan"), float("inf"), float("-inf")), (1e308, -1e308, 5e-324, 1e30, 0.0)
HEADS = (0, 1, 2, 3, "4.0", "2.1", "9.9", -1, "abc", "")


def values(listed, *roles):
    return [v for section in listed for v in section.values if not roles or v.role in roles]


def one_value(choose, others, say, expect):
    """The change that gives one of the values choose(listed) another value."""

    def change(random, listed):
        value = random.choice(choose(listed))
        value.value = random.choice(others)
        return say(value.role, value.value), expect

    return change


def one_role(roles, others, say, expect):
    return one_value(lambda listed: values(listed, *roles), others, say, expect)


def count_off(random, listed):
    """A count is one more or one less than what follows."""
    value, step = random.choice(values(listed, *COUNTS)), random.choice((-1, 1))
    value.value = max(0, int(value.value) + step)
    # A block with one tag less or one bounding entity more may still be read, with the numbers that follow shifted.
    return f"{value.role}: {value.value}, {step:+d}", REFUSED if value.role in COUNTS[:3] else ANY


def renumbered(random, listed, tags, follow):
    """A node has another tag; follow() says whether all that refer to it follow."""
    value = random.choice(values(listed, "node tag"))
    old, value.value = value.value, random.choice(tags)
    for other in values(listed, "node of an element") if follow() else ():
        other.value = value.value if other.value == old else other.value
    return f"node tag {value.value}"


def tag_below_one(random, listed):
    return renumbered(random, listed, (0, -1, -(2**31)), lambda: random.random() < 0.5), REFUSED


def tag_huge(random, listed):
    return renumbered(random, listed, (2**31 - 1, 10**9, 10**7), lambda: True), ANY


def twice(role, words, expect):
    """The change that gives a value of a role the value of another."""

    def change(random, listed):
        first, second = random.sample(values(listed, role), 2)
        second.value = first.value
        return words, expect

    return change


def nodes_swapped(random, listed):
    """An element lists its nodes in another order."""
    members = values(listed, "node of an element")
    place = random.randrange(len(members) - 1)
    members[place].value, members[place + 1].value = members[place + 1].value, members[place].value
    return "two nodes of elements exchanged", ANY


def one_section(say, act, first=0):
    """The change that does act(section, listed) to a section."""

    def change(random, listed):
        section = random.choice(listed[first:])
        act(section, listed)
        return say.format(section.name), REFUSED

    return change


def sections_swapped(random, listed):
    """Any order but that the header comes first; gmsh asks for nodes before elements."""
    random.shuffle(listed)
    return "sections: " + ", ".join(section.name for section in listed), ANY


def other_sections(random, listed):
    """Sections that other programs write: to be passed over."""
    name = random.choice(("Comments", "NodeData", "Periodic", "\x1b[31mRed", "N" * 5000))
    strange = Section(name, [Value("strange", "t", "some text", "\n")])
    listed.insert(random.randrange(1, len(listed) + 1), strange)
    return f"a section ${strange.name[:20]!r}", ANY


# After these the mesh is the same, if it can be read at all.
KEEPS_THE_MESH = (
    tag_huge, sections_swapped, other_sections,
    one_role(["name"], STRANGE_NAMES, lambda role, value: f"a physical name {value[:20]!r}", ANY),
    twice("name", "a physical name twice", ANY),
    one_value(lambda listed: listed[0].values, HEADS, lambda role, value: f"{role}: {value!r}", ANY),
)  # fmt: skip
CHANGES = (
    count_off, count_off,
    one_role(COUNTS, NUMBERS, "{}: {}".format, ANY),
    one_value(lambda listed: [v for v in values(listed) if v.kind in "iz"], NUMBERS, "{}: {}".format, ANY),
    tag_below_one,
    twice("node tag", "a node tag twice", REFUSED),
    one_role(["node of an element"], (0, -1, 999999, 2**31 - 1), "an element with the node {1}".format, REFUSED),
    one_role(["element type"], TYPES, "{} {}".format, REFUSED),
    one_role(["coordinate", "z"], NOT_FINITE, "{} {}".format, REFUSED),
    one_role(["coordinate", "z"], REALS, "{} {}".format, ANY),
    nodes_swapped,
    one_section("${} twice", lambda section, listed: listed.append(copy.deepcopy(section)), first=2),
    one_section("no ${}", lambda section, listed: listed.remove(section)),
    one_section("no $End{}", lambda section, listed: setattr(section, "closed", False)),
    one_section("${} is empty", lambda section, listed: section.values.clear()),
    *KEEPS_THE_MESH,
)  # fmt: skip


def cell_twice(random, mesh):
    """A cell or an edge of the mesh listed twice: not a change of the file but of the mesh."""
    listed = random.choice((mesh.cells, mesh.edges))
    listed.append(random.choice(listed))
    return ("a cell" if listed is mesh.cells else "an edge") + " listed twice", REFUSED if listed is mesh.cells else ANY


def change_bytes(random, data):
    """Bytes lost, added or changed anywhere in the file."""
    choice = random.choice(("cut off", "cut off", "one byte", "garbage", "empty", "text behind", "zeros"))
    place, expect = random.randrange(len(data)), ANY
    if choice == "cut off":
        expect = REFUSED if place < data.rfind(b"$EndElements") else ANY
        data = data[:place]
    elif choice == "one byte":
        data = data[:place] + bytes([random.randrange(256)]) + data[place + 1 :]
    elif choice in ("garbage", "empty"):
        count = random.choice((1, 50, 5000)) if choice == "garbage" else 0
        data, expect = bytes(random.randrange(256) for _ in range(count)), REFUSED
    else:
        data = data + b"the end\n" if choice == "text behind" else data[:place] + bytes(len(data) - place)
    return data, choice, expect


def broken_file(random, mesh):
    """The kind of a file, its bytes, what is wrong, what must come of it, and whether the mesh is still the same."""
    kind, sort = random.choice(msh_file.KINDS), random.random()
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
