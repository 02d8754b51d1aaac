"""Assemblies of many bodies that only contact holds: heaps, chains, bearings, arches, pins, wedges, bricks, nested rings,
bolts, sectors of rings.

Whether anything carries the load is a matter of the rigid motions alone (rigid_motions.py).
"""

import math
import random
from dataclasses import dataclass, field
from typing import NamedTuple

from drawings import draw_body, rim, scene_text
from fuzz_case import solve_case


class Part(NamedTuple):
    """A body: its loops as in drawings.py; `held`: which of x, y its first curve of that name prescribes."""

    name: str
    loops: list
    held: dict = {}  # curve: the components that are zero
    force: tuple = (0.0, 0.0)  # per volume


@dataclass
class Assembly:
    what: str
    parts: list
    pairs: list  # of curves "body_curve"
    size: float  # edges, over which contact is rough
    ties: list = field(default_factory=list)  # straight cuts: two curves, and the pretension
    cyclic: list = field(default_factory=list)  # cuts of sectors about the origin: two curves


def disc(name, x, y, r, force, held=None):
    return Part(name, [circle("rim", x, y, r)], held or {}, force)


def circle(curve, x, y, r):
    at = lambda k: (x + r * round(math.cos(k * math.pi / 2)), y + r * round(math.sin(k * math.pi / 2)))
    return [(curve, "Circle", [at(k), (x, y), at((k + 1) % 4)]) for k in range(4)]


def block(name, x0, y0, x1, y1, force=(0.0, 0.0), held=None):
    sides = ("bottom", (x1, y0)), ("right", (x1, y1)), ("top", (x0, y1)), ("left", (x0, y0))
    return Part(name, [rim((x0, y0), *sides)], held or {}, force)


GROUND = {"bottom": "xy"}
FINE = 8  # pairs that two meshes to an accuracy resolve in seconds


def heap(r, weight):
    """Logs in rows on a floor between two walls; with a play, or none."""
    rows, base, play = r.randint(1, 4), r.randint(2, 5), r.choice((0.0, 0.0, 1e-4, 1e-2))
    rows = min(rows, base)
    walls = r.random() < 0.8
    wide = base * (2 + play)
    parts, pairs = [block("floor", -1.0, -1.0, wide + 1.0, 0.0, held=GROUND)], []
    if walls:
        parts += [block("west", -1.0, 0.2, 0.0, 2.5, held={"left": "xy"}),
                  block("east", wide, 0.2, wide + 1, 2.5, held={"right": "xy"})]  # fmt: skip
    rise = math.sqrt(4 - (1 + play / 2) ** 2)
    for k in range(rows):
        for j in range(base - k):
            x, y = 1 + play / 2 + (2 + play) * (j + k / 2), 1 + k * rise
            parts.append(disc(f"log{k}{j}", x, y, 1.0, (0.0, -weight)))
            under = [f"log{k - 1}{i}_rim" for i in (j, j + 1)] if k else ["floor_top"]
            pairs += [(f"log{k}{j}_rim", other) for other in under + ([f"log{k}{j - 1}_rim"] if j else [])]
    if walls:
        pairs += [("log00_rim", "west_right"), (f"log0{base - 1}_rim", "east_left")]
    return Assembly("heap", parts, pairs, r.uniform(0.2, 0.4))


def chain(r, weight):
    """Discs in a row, or bent, pushed against a wall from one side."""
    count, bend = r.randint(2, 8), r.choice((0.0, 0.0, 0.05))
    places = [(2.0 * k * math.cos(bend), (k % 2) * 2.0 * math.sin(bend)) for k in range(count)]
    wall = block("wall", -2.0, -1.5, -1.0, 1.5, held={"left": "xy"})
    x, y = places[-1]
    pusher = block("pusher", x + 1.0, y - 1.5, x + 2.0, y + 1.5, (-weight, 0.0), {"top": "y"})
    discs = [disc(f"d{k}", *at, 1.0, (-weight, 0.0)) for k, at in enumerate(places)]
    names = ["wall_right", *(f"d{k}_rim" for k in range(count)), "pusher_left"]
    return Assembly("chain", [wall, *discs, pusher], list(zip(names, names[1:])), r.uniform(0.2, 0.4))


def bearing(r, weight):
    """Free rollers between a loaded shaft and a held race, with a clearance, none, or pressed."""
    count, clearance = r.choice((6, 8, 12, 16)), r.choice((0.0, 0.0, 1e-4, -1e-5))
    radius, inner = 1.0, 1.15 / math.sin(math.pi / count) - 1.0
    outer = inner + 2 * radius + clearance
    shaft, race = circle("rim", 0.0, 0.0, inner), [circle("out", 0.0, 0.0, outer + 1), circle("in", 0.0, 0.0, outer)]
    parts, pairs = [Part("shaft", [shaft], {}, (0.0, -weight)), Part("race", race, {"out": "xy"})], []
    for k in range(count):
        angle, far = 2 * math.pi * (k + 0.25) / count, inner + radius + clearance / 2
        parts.append(disc(f"r{k}", far * math.cos(angle), far * math.sin(angle), radius, (0.0, 0.0)))
        pairs += [("shaft_rim", f"r{k}_rim"), (f"r{k}_rim", "race_in")]
    return Assembly("bearing", parts, pairs, r.uniform(0.25, 0.5))


def arch(r, weight):
    """Voussoirs between held springers; without friction few of them stand."""
    count, thick, half = r.randint(2, 7), r.uniform(0.1, 0.4), r.uniform(0.3, 0.5) * math.pi
    at = lambda k, far: (far * math.sin(half * (2 * k / count - 1)), far * math.cos(half * (2 * k / count - 1)))
    parts, pairs = [], []
    for k in range(count):
        corners = at(k, 1.0), at(k + 1, 1.0), at(k + 1, 1 + thick), at(k, 1 + thick)
        names = zip(("in", "next", "out", "last"), (*corners[1:], corners[0]))
        held = {"last": "xy"} if k == 0 else {"next": "xy"} if k == count - 1 else {}
        parts.append(Part(f"v{k}", [rim(corners[0], *names)], held, (0.0, -weight)))
    pairs = [(f"v{k}_next", f"v{k + 1}_last") for k in range(count - 1)]
    return Assembly("arch", parts, pairs, thick / r.uniform(1.5, 4))


def pin(r, weight):
    """A pin in a slot with play, pulled down, up or aside."""
    play, angle = r.choice((0.0, 1e-4, 1e-2)), r.choice((0, 90, 180, 270, 225, 315, r.uniform(0, 360)))
    force = (weight * math.cos(math.radians(angle)), weight * math.sin(math.radians(angle)))
    floor = block("floor", -3.0, -2.0, 3.0, -1.0, held=GROUND)
    west = block("west", -3.0, -0.9, -1.0 - play, 2.0, held={"left": "xy"})
    east = block("east", 1.0 + play, -0.9, 3.0, 2.0, held={"right": "xy"})
    pairs = [("pin_rim", "floor_top"), ("pin_rim", "west_right"), ("pin_rim", "east_left")]
    return Assembly("pin", [floor, west, east, disc("pin", 0.0, 0.0, 1.0, force)], pairs, r.uniform(0.2, 0.4))


def wedge(r, weight):
    """Driven between two held cheeks, or between a held one and one that only slides towards nothing."""
    lean, loose = r.uniform(0.1, 0.6), r.random() < 0.3
    points = (-0.5, 0.0), (0.5, 0.0), (0.5 + lean, 1.0), (-0.5 - lean, 1.0)
    sides = zip(("bottom", "right", "top", "left"), (*points[1:], points[0]))
    parts = [Part("wedge", [rim(points[0], *sides)], {}, (0.0, -weight))]
    for name, sign in (("west", -1), ("east", 1)):
        corners = [(sign * x, y) for x, y in ((0.5, 0.0), (2.0, 0.0), (2.0, 1.0), (0.5 + lean, 1.0))]
        held = {"bottom": "y"} if loose and sign > 0 else {"out": "xy"}
        parts.append(Part(name, [rim(corners[0], *zip(("bottom", "out", "top", "in"), (*corners[1:], corners[0])))], held))
    return Assembly("wedge", parts, [("wedge_left", "west_in"), ("wedge_right", "east_in")], r.uniform(0.15, 0.35))


def bricks(r, weight):
    """A wall in bond with half bricks at the ends of every other row, and play between the bricks of a row."""
    rows, count, play = r.randint(1, 4), r.randint(1, 4), r.choice((0.0, 1e-5, 1e-3, 5e-2))
    wide = (2 + play) * count
    parts, pairs, under = [block("floor", -1.0, -1.0, wide + 1, 0.0, held=GROUND)], [], [("floor_top", -1.0, wide + 1)]
    for k in range(rows):
        joints = [wide * j / count for j in range(count + 1)]
        joints = [0.0, *(x + 1 + play / 2 for x in joints[:-1]), wide] if k % 2 else joints
        row = [(f"b{k}{j}", x, y - play) for j, (x, y) in enumerate(zip(joints, joints[1:]))]
        parts += [block(name, x, float(k), y, k + 1.0, (0.0, -weight)) for name, x, y in row]
        pairs += [(f"{name}_bottom", top) for name, x, y in row for top, start, end in under
                  if min(y, end) - max(x, start) > play]  # fmt: skip
        pairs += [(f"{one}_right", f"{other}_left") for (one, *_), (other, *_) in zip(row, row[1:])]
        under = [(f"{name}_top", x, y) for name, x, y in row]
    return Assembly("bricks", parts, pairs, r.uniform(0.25, 0.5))


def rings(r, weight):
    """One in the other, shrunk on or with play, a disc in the middle that is pulled."""
    count, fit = r.randint(1, 3), r.choice((0.0, 1e-5, 1e-3, -1e-4))
    parts, pairs, far, inside = [disc("core", 0.0, 0.0, 1.0, (weight, 0.0))], [], 1.0, "core_rim"
    for k in range(count):
        loops = [circle("out", 0.0, 0.0, far + fit + 0.6), circle("in", 0.0, 0.0, far + fit)]
        parts.append(Part(f"ring{k}", loops, {"out": "xy"} if k == count - 1 else {}))
        pairs.append((inside, f"ring{k}_in"))
        far, inside = far + fit + 0.6, f"ring{k}_out"
    return Assembly("rings", parts, pairs, r.uniform(0.15, 0.35))


def bolts(r, weight):
    """Two plates on a bolt with play, cut across its shank and tightened; the upper plates are pulled or pushed."""
    high, play, pull = r.uniform(1.0, 3.0), r.uniform(0.1, 0.5), r.choice((0.0, r.uniform(-4, 4), r.uniform(0, 40))) * weight
    parts = []
    for name, up in (("upper", 1), ("lower", -1)):
        corners = [(up * x, up * y) for x, y in ((-1, 0), (1, 0), (1, high), (2, high), (2, high + 1), (-2, high + 1), (-2, high), (-1, high))]
        curves = ("cut", "side", "seat", "end", "top", "back", "other", "wall")
        parts.append(Part(name, [rim(corners[0], *zip(curves, (*corners[1:], corners[0])))]))
    for side, sign in (("west", -1), ("east", 1)):
        x = sorted((sign * (1 + play), sign * 4))
        held = {"left" if sign < 0 else "right": "xy"}
        parts += [block(f"high{side}", x[0], 0.0, x[1], high, (0.0, pull)), block(f"low{side}", x[0], -high, x[1], 0.0, held=held)]
    pairs = [("upper_other", "highwest_top"), ("upper_seat", "higheast_top"), ("lower_seat", "lowwest_bottom"),
             ("lower_other", "loweast_bottom"), ("highwest_bottom", "lowwest_top"), ("higheast_bottom", "loweast_top")]  # fmt: skip
    return Assembly("bolts", parts, pairs, r.uniform(0.2, 0.4), [("upper_cut", "lower_cut", r.uniform(1, 30) * weight)])


def sectors(r, weight):
    """A sector of rings shrunk on one another, about the origin."""
    turn, start = 2 * math.pi / r.randint(4, 24), r.uniform(0, 2 * math.pi)
    at = lambda radius, k: (radius * math.cos(start + k * turn), radius * math.sin(start + k * turn))
    parts, pairs, inner = [], [], r.uniform(0.3, 2.0)
    for k in range(r.randint(2, 4)):
        outer = inner + r.uniform(0.3, 1.0)
        arc = lambda curve, radius, ends: (curve, "Circle", [at(radius, ends[0]), (0.0, 0.0), at(radius, ends[1])])
        cut = lambda curve, radii, end: (curve, "Line", [at(radii[0], end), at(radii[1], end)])
        loop = [cut("low", (inner, outer), 0), arc("out", outer, (0, 1)), cut("high", (outer, inner), 1), arc("in", inner, (1, 0))]
        parts.append(Part(f"ring{k}", [loop]))
        pairs += [(f"ring{k - 1}_out", f"ring{k}_in")] if k else []
        inner = outer - 10 ** r.uniform(-5, -3)
    cuts = [(f"{part.name}_low", f"{part.name}_high") for part in parts]
    return Assembly("sectors", parts, pairs, r.uniform(0.1, 0.3), cyclic=cuts)


FAMILIES = (heap, chain, bearing, arch, pin, wedge, bricks, rings)


# ---- Cases ----


class View(NamedTuple):
    """The same assembly seen otherwise: in other units of length, mirrored, turned by quarters, then moved by lengths of its
    own. Stresses are the same, forces as many times larger as lengths."""

    unit: float = 1.0
    mirrored: bool = False
    quarters: int = 0
    far: float = 0.0

    def turned(self, x, y):
        x = -x if self.mirrored else x
        for _ in range(self.quarters):
            x, y = -y, x
        return x, y

    def of(self, assembly):
        size = assembly.size * self.unit

        def place(point):
            x, y = self.turned(*point)
            return self.unit * x + self.far * size, self.unit * y - self.far * size

        def part(one):
            loops = [[(name, word, [place(point) for point in points]) for name, word, points in loop] for loop in one.loops]
            axes = "yx" if self.quarters % 2 else "xy"
            held = {curve: "".join(axes["xy".index(axis)] for axis in held) for curve, held in one.held.items()}
            force = tuple(component / self.unit for component in self.turned(*one.force))
            return Part(one.name, loops, held, force)

        ties = [(*cut, self.unit * force) for *cut, force in assembly.ties]
        return Assembly(assembly.what, [part(one) for one in assembly.parts], assembly.pairs, size, ties)


def other_view(r):
    return View(r.choice((1.0, 1e-3, 1e3)), r.random() < 0.5, r.randint(0, 3), r.choice((0.0, 1e3, 1e6)))


def geo(assembly, order, quads):
    lines = [f"Mesh.ElementOrder = {order}; Mesh.SecondOrderIncomplete = 1; Mesh.RecombineAll = {quads};"]
    for k, part in enumerate(assembly.parts):
        draw_body(part.name, part.loops, 1000 * (k + 1), lines)
    return "\n".join([*lines, f"MeshSize{{:}} = {assembly.size!r};", ""]).encode()


def scene_of(assembly, stiffness=None):
    gives_way = {"stiffness": stiffness} if stiffness else {}
    boundary = [{"on": f"{part.name}_{curve}", "displacement": {axis: 0 for axis in axes}}
                for part in assembly.parts for curve, axes in part.held.items()]  # fmt: skip
    return {"materials": {"one": {"young": 1.0, "poisson": 0.3}}, "bodies": {part.name: "one" for part in assembly.parts},
            "boundary": boundary, "contact": [{"between": list(pair)} | gives_way for pair in assembly.pairs]
            + [{"between": cut, "condition": "tied", "pretension": force} for *cut, force in assembly.ties]
            + [{"between": list(cut), "condition": "cyclic"} for cut in assembly.cyclic],
            "body_force": [{"body": part.name, "force": list(part.force)} for part in assembly.parts if any(part.force)],
            }  # fmt: skip


def with_fluid(scene, assembly, own):
    """The scene with a fluid that gets into one of its pairs, from where the first curve starts, at up to ten times the
    pressure of the loads on the bodies' own size."""
    pair = own.choice(scene["contact"][: len(assembly.pairs)])
    name, curve = pair["between"][0].split("_")
    part = next(part for part in assembly.parts if part.name == name)
    place = next(points[0] for loop in part.loops for end, word, points in loop if end == curve)
    load = max((sum(abs(f) for f in part.force) for part in assembly.parts), default=0.0) * assembly.size
    fluid = {"pressure": load * 10 ** own.uniform(-1, 2), "from": list(place)}
    return scene | {"contact": [one | {"fluid": fluid} if one is pair else one for one in scene["contact"]]}


def make_assembly(seed, number):
    r = random.Random(f"{seed}:assembly:{number}")
    rare = lambda what, part: random.Random(f"{seed}:assembly:{number}:{what}").random() < part
    family = bolts if rare("bolt", 0.1) else sectors if rare("sectors", 0.05) else r.choice(FAMILIES)
    assembly = family(r, 10 ** r.uniform(-6, -4))
    own = random.Random(f"{seed}:assembly:{number}:stiffness")
    stiffness = 10 ** own.uniform(-2, 2) / assembly.size if own.random() < 0.2 else None  # of edges as stiff as the bodies: 1
    scene, order, quads = scene_of(assembly, stiffness), r.choice((1, 2, 2)), r.choice((0, 1))
    variant, view = r.choice(("feti", "other side", "again")), View()
    variant = "view" if variant == "again" and r.random() < 0.7 and not assembly.cyclic else variant
    variant = "accuracy" if variant == "feti" and len(assembly.pairs) <= FINE and r.random() < 0.5 else variant
    other, solver = scene | {"method": {"solver": "direct"}}, {"method": {"solver": "feti"}}
    if variant == "feti":
        scene, other = other, scene | solver
    elif variant == "again":
        scene = other = with_fluid(scene, assembly, own) if assembly.pairs and own.random() < 0.5 else scene
    elif variant == "accuracy":  # on meshes of its own
        scene, other = (scene | {"accuracy": {"value": asked, "first_edges": r.randint(8, 40)}} for asked in (0.1, 0.03))
    elif variant == "view":
        view = other_view(r)
        other = scene_of(view.of(assembly), stiffness and stiffness / view.unit)
    else:
        sides = [[{**pair, "multipliers_on": pair["between"][k]} for pair in scene["contact"]] for k in (0, 1)]
        scene, other = scene | {"contact": sides[0]}, scene | {"contact": sides[1]}
    mesh = geo(assembly, order, quads)
    case = solve_case("assembly", f"{assembly.what} of {len(assembly.parts)} bodies, {'TQ'[quads]}{order}, {variant}{', gives way' if stiffness else ''}",
                      scene_text(scene, "mesh.geo"), mesh, mesh_file="mesh.geo")  # fmt: skip
    case.setting, case.group, case.variant = assembly, f"assembly: {assembly.what}", variant
    case.wet = any("fluid" in pair for pair in scene["contact"])
    case.view, seen = view, geo(view.of(assembly), order, quads) if variant == "view" else mesh
    case.other = {"scene.toml": scene_text(other, "mesh.geo"), "mesh.geo": seen}
    return case
