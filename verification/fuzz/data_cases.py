"""Two blocks with data that a mesh may miss: a spike, a step, a wave or a spot in any place where a function may stand."""

import random
from dataclasses import dataclass

import numpy as np

import graded_grid
import msh_file
import place_functions
import plates
from drawings import SHARED, Drawing, above, below, held_case, scene_of, scene_text
from place_functions import Mark

STRAIN = 1e-3  # p over Young's modulus
EXPANSION = 1e-5
ENTRIES = {"foundation": "boundary.0", "body_force": "body_force.0", "initial_strain": "initial_strain.0",
           "initial_gap": "contact.0", "clearance": "contact.0"}  # fmt: skip
FAR = {"pressure": "upper", "traction": "upper", "displacement": "upper", "foundation": "lower"}  # from the line
SLOPED = ("displacement", "initial_gap", "clearance")  # a jump of slope makes p endless
WIDEST = 1 / 60  # columns of a reference mesh


@dataclass
class Blocks:
    """From `start` to start + 1, from y = 0 to the line, and on to `top`. The line is flat, inclined or an arc."""

    start: float
    top: float
    height: float  # of the line at its left end
    rise: float  # to its right end, or of an arc in the middle
    shape: str

    def line(self, x):
        if self.shape == "arc":
            radius = self.radius()
            return self.height + self.rise + radius * (np.sqrt(1 - ((x - self.start - 0.5) / radius) ** 2) - 1)
        return self.height + self.rise * (x - self.start)

    def radius(self):
        return (0.25 + self.rise**2) / (2 * self.rise)

    def drawing(self, young, planes):
        left, right = ((x, float(self.line(x))) for x in (self.start, self.start + 1))
        middle = [(self.start + 0.5, self.height + self.rise - self.radius())] if self.shape == "arc" else []
        contact = [("Circle" if middle else "Line", [left, *middle, right])]
        sides = [f"{body}_{side}" for body in ("lower", "upper") for side in ("left", "right")]
        return Drawing("blocks", below(left[0], right[0], contact), above(self.top, contact), sides=tuple(sides),
                       load={"pressure": STRAIN * young}, planes=planes)  # fmt: skip


def draw_blocks(r):
    """The blocks and their plane; mostly flat: the ends of other lines are corners of their own."""
    plane, shape = r.choice(("strain", "strain", "stress", "axisymmetric")), r.choice(("flat",) * 8 + ("inclined", "arc"))
    start = r.choice((0.0, 0.4)) if plane == "axisymmetric" else 0.0
    height, rise = r.uniform(0.3, 0.6), 0.0 if shape == "flat" else r.choice((1, -1)) * r.uniform(0.01, 0.1)
    return Blocks(start, height + max(rise, 0) + r.uniform(0.2, 0.5), height, rise, shape), plane


# ---- Where the feature stands ----


def share(r, feature):
    """Amplitude: the feature adds a part of 0.1 to 1 of all, but never more than 40 times what stands around it."""
    return r.choice((1, 1, -0.3)) * min(10 ** r.uniform(-1, 0) / feature.width, 40)


def put(r, scene, key, body, young, f):
    """Writes the feature into the scene under the key."""
    p, size, slope = STRAIN * young, share(r, f), f.steepest
    if key in ("pressure", "traction"):
        load = f"{p!r} * (1 + {size!r} * {f.text})"
        scene["boundary"][1] = {"on": "upper_top", key: load if key == "pressure" else [0.0, f"-({load})"]}
    elif key == "body_force":
        scene[key] = [{"body": body, "force": [0.0, f"{-p!r} * (1 + {size!r} * {f.text})"]}]
    elif key == "initial_strain":
        size = STRAIN * r.uniform(0.3, 1.5)
        given = ({"temperature_change": f"{size / EXPANSION!r} * {f.text}"},
                 {"strain": {"xx": 0.0, "yy": f"{size!r} * {f.text}", "zz": 0.0, "xy": 0.0}})  # fmt: skip
        scene[key] = [{"body": body, **r.choice(given)}]
    elif key == "displacement":  # a strain of 3 % at most
        words = f"{-STRAIN!r} * (1 + {min(size, 30 / slope)!r} * {f.text})"
        scene["boundary"][1] = {"on": "upper_top", key: {"y": words}}
    elif key == "foundation":
        scene["boundary"][0] = {"on": "lower_bottom", key: f"{young!r} * (1 + {abs(size)!r} * {f.text})"}
    else:  # a bump that changes p by a part of 0.2 to 1.5: of the larger ones contact opens beside it
        scene["contact"][0][key] = f"{r.choice((1, -1)) * r.uniform(0.2, 1.5) * STRAIN / slope!r} * {f.text}"


def draw_feature(r, blocks, key, body):
    """A feature that may stand under the key; what jumps there must not make p endless."""
    makers = place_functions.INSIDE if key in ("body_force", "initial_strain") else place_functions.ALONG
    if key in SLOPED:
        makers = place_functions.SMOOTH
    heights = [float(y) for y in blocks.line(blocks.start + np.linspace(0, 1, 101))]
    ends = (0.0, min(heights)) if body == "lower" else (max(heights), blocks.top)
    narrowest = 0.002 if key in ("pressure", "traction", "body_force") else 0.01
    return place_functions.draw(r, makers, narrowest, blocks.start, ends)


# ---- Meshes ----


def reference_mesh(blocks, plane, feature, key, coarser, borders):
    """Graded around the feature, also across the edge on which it stands, towards where contact ends and, but for lines of
    symmetry, towards the ends of the line; edges `coarser` times as long as the finest that is used."""
    left, right, widest = blocks.start, blocks.start + 1, WIDEST * coarser / (6 if borders else 1)
    finer = lambda marks: [m._replace(size=m.size * coarser) for m in marks]
    corners = [] if blocks.shape == "flat" and plane != "axisymmetric" else [Mark(x, 1e-4) for x in (left, right)]
    columns = graded_grid.lines(left, right, finer(feature.x + corners + [Mark(x, 2e-3) for x, _ in borders]), widest)
    at_line = 1e-4 if corners else 2e-3 if borders else 2e-2
    bounds = {"lower": (lambda x: 0 * x, blocks.line), "upper": (blocks.line, lambda x: blocks.top + 0 * x)}
    bodies, first = {}, 0
    for name, (under, over) in bounds.items():
        low, high = float(under(left)), float(over(left))
        line, far = (high, low) if name == "lower" else (low, high)
        sizes = {line: at_line, far: 2e-2}
        if FAR.get(key, name) == name:
            sizes[far if key in FAR else line] = min(2 * feature.finest(), sizes[line])
        marks = [Mark(*size) for size in sizes.items()] + [m for m in feature.y if low < m.at < high]
        heights = graded_grid.lines(low, high, finer(marks), 3 * WIDEST * coarser)
        bodies[name] = graded_grid.block(columns, (heights - low) / (high - low), under, over, first)
        first += len(bodies[name][0])
    return graded_grid.msh(bodies)


def own_mesh(r, blocks):
    cell, left = r.choice(plates.CELL_TYPES), blocks.start
    bounds = {"lower": (0.0, blocks.line), "upper": (blocks.line, blocks.top)}
    bodies = [plates.Body(name, plates.even(r.randint(8, 50)), r.randint(4, 16), plates.between(left, left + 1, *ends), cell)
              for name, ends in bounds.items()]  # fmt: skip
    mesh = msh_file.write(msh_file.sections(plates.mesh_of(bodies), "4.1 ascii"), "4.1 ascii")
    return "mesh.msh", mesh, cell not in (plates.TRI3, plates.QUAD4), plates.CELL_NAMES[cell]


def draw_law(r, young):
    """A number, a power or a table: overlaps of a hundredth to twice the blocks' own shortening at the mean pressure."""
    overlap, pressure = STRAIN * 10 ** r.uniform(-2, 0.3), STRAIN * young
    if r.random() < 0.2:
        return pressure / overlap
    if r.random() < 0.5:
        return {"pressure": pressure, "overlap": overlap, "exponent": 1 + 6 * r.random() ** 2}
    steps = [(0.1 + r.random(), 10 ** r.uniform(-1.5, 0.5)) for _ in range(r.randint(2, 5))]
    sums = np.cumsum(steps, axis=0) * (overlap / 2, pressure / 2)
    return [[float(d), float(p)] for d, p in sums]


def gives_way(seed, number, scene, blocks, young):
    """What the contact of these cases is besides: of a part of them it gives way, or a fluid gets into it from its left end."""
    r = random.Random(f"{seed}:data:{number // SHARED}:pair")
    pair, drawn = scene["contact"][0], r.random()
    if drawn < 0.25:
        pair["stiffness"] = draw_law(r, young)
        return ", gives way"
    if drawn < 0.35:
        start = [blocks.start, float(blocks.line(blocks.start))]
        pair["fluid"] = {"pressure": STRAIN * young * 10 ** r.uniform(-2, -0.1), "from": start}
        return ", wet"
    return ""


def make_data(seed, number):
    r = random.Random(f"{seed}:data:{number // SHARED}")
    (blocks, plane), young = draw_blocks(r), r.choice((1.0, 7e4, 2.1e11))
    drawing = blocks.drawing(young, (plane,))
    scene = scene_of(r, drawing, young)
    key, body = r.choice(sorted(FAR | ENTRIES)), r.choice(("lower", "upper"))
    feature, files = draw_feature(r, blocks, key, body), {}
    # A table is linear between its points: of a gap or a displaced edge each is a kink, at which p has no limit.
    if r.random() < 0.3 and feature.name in ("spike", "hat") and key not in SLOPED:
        feature, files["f.csv"] = place_functions.sampled(feature, blocks.start, blocks.top)
        scene["fields"] = {"f": {"file": "f.csv"}}
    put(r, scene, key, body, young, feature)
    what = f"{feature.name} of width {feature.width:.2g} in {key}, {blocks.shape}" + gives_way(seed, number, scene, blocks, young)
    case = held_case("data", what, key, scene, drawing, number, seed, lambda r: own_mesh(r, blocks))
    text = {"scene.toml": scene_text(scene, "mesh.msh")} | files
    case.reference = lambda *how: text | {"mesh.msh": reference_mesh(blocks, plane, feature, key, *how)}
    case.files = files | case.files
    case.named = [ENTRIES.get(key, "boundary.1"), key]
    case.places = [(mark.at, None) for mark in feature.x] + [(None, mark.at) for mark in feature.y]
    return case
