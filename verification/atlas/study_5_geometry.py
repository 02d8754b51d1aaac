"""Geometry: kinks, walls, straight edges on curves, gaps, curvature, slivers."""

import math

import atlas_geometry_picture
import atlas_geometry_regions
from atlas_mesh import PRESSED, WIDTH, even, plates, run, touching
from atlas_regions import ends, solved

TITLE = "Geometry of the contact line"
INTRODUCTION = (
    "Two plates of 8-node quadrilaterals in the stress state -10 MPa in all directions (pressure on top and right, "
    "sliding on the left and below): whatever the line between them, p is exactly 10 MPa on it. Lines: tents (kinks "
    "up to 85 degrees, with or without a vertex at the kinks), a cosine with 1 to 16 elements a period, flat lines "
    "whose vertices miss each other. Rings against Lamé: edges straight or curved, gap closed or measured. Walls: "
    "an inclined line between fixed vertical walls, pressure on top, refined twice: how the largest p grows with "
    "each."
)
CAPTION = (
    "Each panel one part. Crosses: refused. Open symbols: a check of mortise fails. The dashed lines are 1 %."
)
LIMIT = 0.01
HYDROSTATIC = [
    'on = ["upper_left", "lower_left"], displacement = { x = 0 }',
    'on = "lower_bottom", displacement = { y = 0 }',
    'on = ["upper_top", "upper_right", "lower_right"], pressure = 10e6',
]
KINKS = [15, 30, 45, 60, 70, 75, 80, 85]
KINK_MESHES = {"vertex in both": (16, 24), "vertex in one": (17, 24), "vertex in none": (17, 23)}
WALL_ANGLES = [0, 15, 30, 45, 60, 70, 75]
WALL_COUNTS = [8, 16, 32]
WALLS = {"sliding": PRESSED[0], "clamped": PRESSED[0].replace("x = 0", "x = 0, y = 0")}
RING_COUNTS = [4, 8, 16, 32, 64]
RING_EDGES = {"linear": {"order": 1}, "straight quadratic": {"straight": 1}, "curved quadratic": {}}
PERIODS = [1, 1.5, 2, 3, 4, 6, 8, 16]
SLIVERS = [10.0**-k for k in range(1, 15)]
SPACES = ["linear", "quadratic", "dual"]
SIDES = ["upper_bottom", "lower_top"]


def tent(angle):
    """A rise between two kinks and a top at x = 0.3, 0.5 and 0.4."""
    slope = math.tan(math.radians(angle))
    return lambda x: 0.3 + slope * max(0.0, 0.1 - abs(x - 0.4))


def kink(angle, name, side):
    upper, lower = (even(count) for count in KINK_MESHES[name])
    bodies = plates(tent(angle), upper, lower, top=0.6 + 0.1 * math.tan(math.radians(angle)))
    axes = {"part": "kink", "value": angle, "line": name, "side": side}
    return run(axes, bodies, HYDROSTATIC, touching(multipliers=side), measures=["uniform", "pressure"])


def wall(angle, kind, count):
    slope = math.tan(math.radians(angle))
    bottom = 0.3 + WIDTH / 2 * slope
    bodies = plates(lambda x: bottom + slope * (x - WIDTH / 2), even(count), even(count * 5 // 4), top=2 * bottom)
    axes = {"part": "wall", "value": angle, "line": kind, "count": count}
    return run(axes, bodies, [WALLS[kind], *PRESSED[1:]], touching(condition="bilateral"), measures=["pressure"])


def rings(count, edges, gap):
    axes = {"part": "rings", "value": count, "line": f"{edges}, {gap}"}
    parameters = {**RING_EDGES[edges], "n_inner": count, "n_outer": count * 5 // 4}
    settings = {f"mesh.parameters.{key}": value for key, value in parameters.items()}
    settings["contact.initial_gap"] = gap
    return {"axes": axes, "scene": "rings", "settings": settings, "measures": ["rings"]}


def cosine(count, space, side):
    """`count` elements of the upper body a period, 5 / 4 of that of the lower one; two periods, amplitude 0.1 m."""
    curve = lambda x: 0.3 + 0.1 * math.cos(math.pi * (x + 0.4) / 0.2)
    bodies = plates(curve, even(round(2 * count)), even(round(2.5 * count)))
    axes = {"part": "cosine", "value": count, "line": space, "side": side}
    settings = {"method.multipliers": space}
    return run(axes, bodies, HYDROSTATIC, touching(multipliers=side), settings, ["uniform", "pressure"])


def sliver(eps, space):
    """The inner vertices of the upper body miss those of the lower one by `eps` of an element."""
    count = 8
    columns = [i / count if i in (0, count) else (i + eps) / count for i in range(count + 1)]
    bodies = plates(lambda x: 0.3, columns, even(count))
    axes = {"part": "sliver", "value": eps, "line": f"vertices missed, {space}"}
    return run(axes, bodies, HYDROSTATIC, touching(), {"method.multipliers": space}, ["uniform"])


def sticking_out(eps, space):
    """The upper body stands `eps` of an element to the right: it sticks out there, the lower one on the left."""
    bodies = plates(lambda x: 0.3, even(8), even(8))
    move = lambda name, x, y: (x + eps * WIDTH / 8, y) if name == "upper" else (x, y)
    axes = {"part": "sliver", "value": eps, "line": f"sticking out, {space}"}
    return run(axes, bodies, HYDROSTATIC, touching(), {"method.multipliers": space}, ["uniform"], move)


def runs(quick):
    some = (lambda values: ends(values, 4)) if quick else (lambda values: values)
    listed = [kink(angle, name, side) for name in KINK_MESHES for side in SIDES for angle in some(KINKS)]
    counts = WALL_COUNTS[:2] if quick else WALL_COUNTS
    listed += [wall(angle, kind, count) for kind in WALLS for count in counts for angle in some(WALL_ANGLES)]
    listed += [
        rings(count, edges, gap)
        for edges in RING_EDGES
        for gap in ("closed", "measured")
        for count in RING_COUNTS[: 2 if quick else 5]
    ]
    listed += [cosine(count, space, side) for space in SPACES for side in SIDES for count in some(PERIODS)]
    listed += [sliver(eps, space) for space in SPACES for eps in some(SLIVERS)]
    return listed + [sticking_out(eps, space) for space in SPACES for eps in some(SLIVERS)]


def complete(rows):
    """growth: of the largest p from one mesh to the next finer one (part wall)."""
    p_max = {
        (row["line"], row["value"], row["count"]): row["p_max"] for row in rows if row["part"] == "wall" and solved(row)
    }
    for row in rows:
        if row["part"] == "wall" and solved(row) and (row["line"], row["value"], row["count"] // 2) in p_max:
            row["growth"] = row["p_max"] / p_max[row["line"], row["value"], row["count"] // 2]
    return rows


def draw(rows, path):
    atlas_geometry_picture.draw(rows, path, LIMIT)


def regions(rows):
    return atlas_geometry_regions.regions(rows, LIMIT)
