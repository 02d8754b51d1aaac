"""Outlines of two bodies, one on the other, as a .geo with edges as long as a mesh or a reference wants them; and the
scene that goes with them, whose curves have the names of plates.py: the contact is upper_bottom on lower_top.
"""

import random
from dataclasses import dataclass, field

import toml_text
from fuzz_case import solve_case

ASKED = (0.05, 0.02, 0.01, 0.005, 0.002, 0.001)
OWN = 0.35  # share of cases on a mesh of one's own
SHARED = 4  # cases in a row that ask the same scene for different accuracies: one reference serves them all
GROWTH = 0.15  # of edges away from where they are short


@dataclass
class Drawing:
    """Curves as (name, gmsh's word, points) in order round each body; further loops are holes."""

    what: str
    lower: list
    upper: list
    tips: list = field(default_factory=list)  # points where stresses have no limit
    one_line: bool = False  # both contact curves are the same
    hole: tuple | None = None  # centre and radius
    sides: tuple = ()  # curves on rollers along x
    load: dict = field(default_factory=lambda: {"pressure": 1e-3})
    planes: tuple = ("strain", "strain", "stress")
    joined: bool = False  # the curves called joint are of both bodies, which are one: the contact is a crack's


def rim(first, *curves):
    """Straight curves (name, end) after one another from the first point."""
    starts = [first, *(end for _, end in curves)]
    return [(name, "Line", [start, end]) for start, (name, end) in zip(starts, curves)]


def below(left, right, contact):
    """A block from y = 0 to the contact curves (word, points), which are given from left to right."""
    back = [("top", word, points[::-1]) for word, points in reversed(contact)]
    ends = contact[0][1][0], contact[-1][1][-1]
    return [rim(ends[0], ("left", (left, 0.0)), ("bottom", (right, 0.0)), ("right", ends[1])) + back]


def above(top, contact, leans=(0.0, 0.0)):
    """A block from the contact curves to `top`, as much narrower there at its ends as it leans."""
    first, last = contact[0][1][0], contact[-1][1][-1]
    corners = ("right", (last[0] - leans[1], top)), ("top", (first[0] + leans[0], top)), ("left", first)
    return [[("bottom", word, points) for word, points in contact] + rim(last, *corners)]


def draw_body(name, loops, tag, lines, joints=None):
    """Appends the body's statements, tags from `tag` on; returns {curve: its tags}. `joints`: its curves called joint by
    their ends, added to or, turned round, taken from there; the body is then a part of "plate"."""
    curves, loop_tags, taken = {}, [], list((joints or {}).values())
    for loop in loops:
        known, listed = {point: tag for _, ends in taken for point, tag in ends.items()}, []
        for curve, word, points in loop:
            if joints and (points[-1], points[0]) in joints:
                listed.append(-joints[points[-1], points[0]][0])
                continue
            for x, y in points:
                if (x, y) not in known:
                    tag = known[x, y] = tag + 1
                    lines.append(f"Point({tag}) = {{{x!r}, {y!r}, 0}};")
            tag += 1
            lines.append(f"{word}({tag}) = {{{', '.join(str(known[p]) for p in points)}}};")
            listed.append(tag)
            if curve == "joint":
                joints[points[0], points[-1]] = tag, {point: known[point] for point in points}
            else:
                curves.setdefault(f"{name}_{curve}", []).append(tag)
        tag += 1
        lines.append(f"Curve Loop({tag}) = {{{', '.join(map(str, listed))}}};")
        loop_tags.append(tag)
    physical = f'("{name if joints is None else "plate"}") {"+" if taken else ""}='
    lines.append(f'Plane Surface({tag}) = {{{", ".join(map(str, loop_tags))}}}; Physical Surface{physical} {{{tag}}};')
    lines += [f'Physical Curve("{key}") = {{{", ".join(map(str, tags))}}};' for key, tags in curves.items()]
    return curves


def geo(drawing, line=0.05, widest=0.1, order=2, quads=0, points=()):
    """The .geo: edges `line` long along contact and `size` within `reach` of the points (place, reach, size)."""
    lines = []
    joints = {} if drawing.joined else None
    curves = draw_body("lower", drawing.lower, 1000, lines, joints) | draw_body("upper", drawing.upper, 2000, lines, joints)
    lines += [f"Mesh.ElementOrder = {order}; Mesh.SecondOrderIncomplete = 1; Mesh.RecombineAll = {quads};",
              "Mesh.MeshSizeFromPoints = 0; Mesh.MeshSizeExtendFromBoundary = 0; fields[] = {};"]  # fmt: skip

    def size_field(number, near, reach, size):
        far = reach + max(widest - size, 1e-9) / GROWTH
        values = f"SizeMin = {size!r}", f"SizeMax = {widest!r}", f"DistMin = {reach!r}", f"DistMax = {far!r}"
        lines.append(f"Field[{number}] = Distance; " + " ".join(f"Field[{number}].{value};" for value in near))
        lines.append(f"Field[{number + 1}] = Threshold; Field[{number + 1}].InField = {number}; "
                     + " ".join(f"Field[{number + 1}].{value};" for value in values)
                     + f" fields[] += {{{number + 1}}};")  # fmt: skip

    contact = ", ".join(map(str, curves["lower_top"] + curves["upper_bottom"]))
    size_field(1, [f"CurvesList = {{{contact}}}", "NumPointsPerCurve = 400"], 0.0, line)
    for k, ((x, y), reach, size) in enumerate(points):
        lines.append(f"Point({5000 + k}) = {{{x!r}, {y!r}, 0}};")
        size_field(11 + 2 * k, [f"PointsList = {{{5000 + k}}}"], reach, size)
    lines.append("Field[9] = Min; Field[9].FieldsList = {fields[]}; Background Field = 9;")
    return "\n".join([*lines, ""]).encode()


def scene_of(r, drawing, young=1.0, softest=-1):
    """The drawing's load on top, the bottom held; one material, or another below."""
    one, p = {"young": young, "poisson": r.choice((0.0, 0.2, 0.3, 0.45)), "thermal_expansion": 1e-5}, drawing.load
    made = {"model": {"plane": r.choice(drawing.planes)}, "materials": {"one": one},
            "bodies": {"plate": "one"} if drawing.joined else {"lower": "one", "upper": "one"},
            "boundary": [{"on": "lower_bottom", "displacement": {"y": 0}}, {"on": "upper_top", **p}],
            "contact": [{"between": ["upper_bottom", "lower_top"]}]}  # fmt: skip
    if drawing.sides and made["model"]["plane"] != "axisymmetric":
        made["boundary"].append({"on": list(drawing.sides), "displacement": {"x": 0}})
    if r.random() < 0.2 and not drawing.joined:
        made["materials"]["two"] = one | {"young": young * 10 ** r.uniform(softest, -softest), "poisson": 0.3}
        made["bodies"]["lower"] = "two"
    return made


def scene_text(scene, mesh):
    return toml_text.document({"mesh": {"file": mesh}, **scene}).encode()


def held_case(kind, what, group, scene, drawing, number, seed, own_mesh):
    """A case of the scene that asks for an accuracy, or one on a mesh of its own: own_mesh(r) is its file's name, bytes,
    whether edges have middle nodes, and its kind."""
    r = random.Random(f"{seed}:{number}")
    if r.random() < OWN:
        method = {"multipliers": r.choice(("linear", "linear", "quadratic", "dual"))}
        pair = {"multipliers_on": r.choice(("upper_bottom", "lower_top"))} | scene["contact"][0]
        name, mesh, middles, cells = own_mesh(r)
        told, asked = scene | {"method": method, "contact": [pair]}, None
        how = f"own mesh of {cells}, {method['multipliers']}"
    else:
        name, mesh, middles, asked = "bodies.geo", geo(drawing), True, r.choice(ASKED)
        told, how = scene | {"accuracy": {"value": asked, "first_edges": r.randint(10, 40)}}, f"{asked:g}"
    made = solve_case(kind, f"{what}, {scene['model']['plane']}, {how}", scene_text(told, name), mesh, mesh_file=name)
    made.asked, made.middles, made.group = asked, middles, f"{kind}: {group}" + ("" if asked else ", own mesh")
    return made
