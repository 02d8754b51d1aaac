"""Two bodies with outlines that are hard to see: one spline drawn twice, slits and holes beside the line, corners,
crowns, cones, cracks. The reference knows the points: its mesh is graded towards them, and of one line drawn twice the pair is
closed.
"""

import math
import random

from drawings import SHARED, Drawing, above, below, geo, held_case, rim, scene_of, scene_text

TIP, LINE, WIDEST = 2e-5, 6e-3, 6e-2  # edges of a reference: at a point, along contact, elsewhere


def one_line(r):
    """The same points in both bodies: a spline, or straight pieces that meet in kinks."""
    height, rise, waves, steep = r.uniform(0.3, 0.5), r.uniform(0.02, 0.12), r.uniform(0.5, 7), r.uniform(2, 8)
    curve = r.choice((lambda x: height + rise * math.tanh(steep * (x - 0.5)), lambda x: height + rise * math.sin(waves * x),
                      lambda x: height + rise * (x - 0.5) ** 2 * 4))  # fmt: skip
    word, count = r.choice(("Spline", "Spline", "BSpline", "Line")), r.choice((5, 9, 21, 41, 81))
    if word == "Line":
        x = [0.0, *sorted(r.uniform(0.15, 0.85) for _ in range(r.randint(1, 2))), 1.0]
        contact = [(word, [(a, curve(a)), (b, curve(b))]) for a, b in zip(x, x[1:])]
    else:
        contact = [(word, [(k / (count - 1), curve(k / (count - 1))) for k in range(count)])]
    tips = [points[0] for _, points in contact] + [contact[-1][1][-1]]
    sides = ("lower_left", "lower_right", "upper_left", "upper_right")
    what = "one line with kinks" if word == "Line" else f"one {word}"
    return Drawing(what, below(0.0, 1.0, contact), above(height + 0.4, contact), tips, True, sides=sides)


def slit(r, x, y, sign, loops):
    """A rhombus, in any direction, whose nearest corner is at the height y."""
    half, thin, angle = r.uniform(0.02, 0.1), r.uniform(0.001, 0.01), r.uniform(0, math.pi)
    y += sign * max(half * abs(math.sin(angle)), thin * abs(math.cos(angle)))
    c, s = math.cos(angle), math.sin(angle)
    tips = [(x + a * c - b * s, y + a * s + b * c) for a, b in ((half, 0), (0, thin), (-half, 0), (0, -thin))]
    return [*loops, rim(tips[0], *(("slit", tip) for tip in (*tips[1:], tips[0])))], tips, None


def hole(r, x, y, sign, loops):
    far = abs(y - 0.5)
    radius = min(r.uniform(0.3, 1.5) * far, 0.4 * (0.5 - far))  # within the body, whose outline is 0.5 from the line
    y += sign * radius
    ends = [(x - radius, y), (x + radius, y)]
    arcs = [("hole", "Circle", [a, (x, y), b]) for a, b in (ends, ends[::-1])]
    return [*loops, arcs], [], ((x, y), radius)


def notch(r, x, y, sign, loops):
    """In the left side of the body."""
    deep, half = r.uniform(0.05, 0.3), r.uniform(0.1, 0.6) * abs(y - 0.5)
    y += sign * half
    at = next(k for k, (name, _, _) in enumerate(loops[0]) if name == "left")
    start, end = loops[0][at][2]
    lips = sorted([(0.0, y - half), (0.0, y + half)], key=lambda lip: abs(lip[1] - start[1]))
    cut = rim(start, ("left", lips[0]), ("notch", (deep, y)), ("notch", lips[1]), ("left", end))
    return [loops[0][:at] + cut + loops[0][at + 1 :]], [(deep, y)], None


def flaw(r):
    """A flat line with a slit, a hole or a notch beside it, in either body."""
    contact = [("Line", [(0.0, 0.5), (1.0, 0.5)])]
    bodies, into = [below(0.0, 1.0, contact), above(1.0, contact)], r.randint(0, 1)
    make = r.choice((slit, slit, hole, notch))
    sign, x, far = 2 * into - 1, r.uniform(0.25, 0.75), 10 ** r.uniform(-1.8, -0.8)
    bodies[into], tips, round_hole = make(r, x, 0.5 + sign * far, sign, bodies[into])
    return Drawing(make.__name__, *bodies, tips, True, round_hole, ("lower_right", "upper_right"))


def punch(r):
    """On a wider block; its flanks stand at any angle."""
    left, right = r.uniform(0.15, 0.4), r.uniform(0.6, 0.85)
    contact, flat = [("Line", [(left, 0.5), (right, 0.5)])], [("Line", [(0.0, 0.5), (1.0, 0.5)])]
    leans = [0.4 * r.choice((0.0, r.uniform(-0.4, 0.1))) for _ in range(2)]
    return Drawing("punch", below(0.0, 1.0, flat), above(0.9, contact, leans), contact[0][1],
                   sides=("upper_top", "lower_left"))  # fmt: skip


def crown(r):
    """A crowned body on a block that is wider, or narrower: then it may press the block's corners."""
    radius, half = 10 ** r.uniform(-0.1, 1), r.uniform(0.15, 0.5)
    reach, rise = r.uniform(0.5, 1.6) * half, radius - math.sqrt(radius**2 - half**2)
    contact = [("Circle", [(-half, 0.5 + rise), (0.0, 0.5 + radius), (half, 0.5 + rise)])]
    flat = [("Line", [(-reach, 0.5), (reach, 0.5)])]
    load = {"pressure": min(0.02, max(2e-4, r.uniform(0.07, 0.4) * rise / (2 * half)))}  # of the order that closes the gap
    return Drawing("crown", below(-reach, reach, flat), above(0.9 + rise, contact), [*flat[0][1], *contact[0][1][::2]],
                   sides=("upper_top", "lower_bottom"), load=load)  # fmt: skip


def cone(r):
    return cone_of(r.uniform(0.02, 0.2), r.uniform(0.7, 1.0), r.uniform(0.1, 0.35),
                   r.choice(("axisymmetric", "axisymmetric", "strain")))  # fmt: skip


def cone_of(slope, wide, pressed, plane):
    """A cone, or half a wedge on its line of symmetry, pressed into a block: p ~ log(1 / r) at its tip."""
    contact, flat = [("Line", [(0.0, 0.7), (wide, 0.7 + slope * wide)])], [("Line", [(0.0, 0.7), (1.0, 0.7)])]
    load = {"displacement": {"y": -slope * pressed}}
    return Drawing("cone" if plane == "axisymmetric" else "wedge", below(0.0, 1.0, flat), above(1.2 + slope * wide, contact),
                   [(0.0, 0.7)], sides=("upper_left", "lower_left"), load=load, planes=(plane,))  # fmt: skip


def crack(r):
    """Within a plate or from its side, straight or an arc, under a pressure that may turn into tension: it slides, and opens
    in part."""
    left, right, side = r.uniform(0.2, 0.4), r.uniform(0.6, 0.8), r.random() < 0.4
    plane = r.choice(("strain", "stress", "axisymmetric")) if side else r.choice(("strain", "stress"))
    left = 0.0 if side else left
    ends = [(x, r.uniform(0.4, 0.6)) for x in (left, right)]
    faces, (dx, dy) = [("Line", ends)], (ends[1][0] - left, ends[1][1] - ends[0][1])
    if r.random() < 0.4 and plane != "axisymmetric":
        far = r.choice((1, -1)) * r.uniform(1, 5)  # of the centre, in lengths of the chord
        middle = (left + dx / 2 - far * dy, (ends[0][1] + ends[1][1]) / 2 + far * dx)
        faces = [("Circle", [ends[0], middle, ends[1]])]
    joints = [("Line", [ends[1], (1.0, ends[1][1])])] + ([] if side else [("Line", [(0.0, ends[0][1]), ends[0]])])
    line = [*joints[1:], *faces, joints[0]]

    def jointed(loops):
        ends = [set(points) for _, points in joints]
        return [[("joint" if set(points) in ends else name, word, points) for name, word, points in loop] for loop in loops]

    turns = r.choice((0.0, r.uniform(0, 1), r.uniform(1, 4), r.uniform(-4, -1)))
    sides = ("lower_right", "upper_right") if side else ("lower_left", "upper_left")
    return Drawing("crack", jointed(below(0.0, 1.0, line)), jointed(above(1.0, line)), ends[side:], True, sides=sides,
                   load={"pressure": f"0.001 * (1 + {turns!r} * (2 * x - 1))"}, planes=(plane,), joined=True)  # fmt: skip


FAMILIES = (one_line, one_line, flaw, flaw, punch, crown, cone, crack)


def reference_geo(drawing, coarser, borders):
    """Edges `coarser` times as long as the finest; where contact is open p has no spline, and they are shorter."""
    line, widest = LINE * coarser / (3 if borders else 1), WIDEST * coarser
    points = [(tip, 0.0, TIP * coarser) for tip in drawing.tips] + [(place, 0.0, line / 10) for place in borders]
    if drawing.hole:
        centre, radius = drawing.hole
        points.append((centre, 1.1 * radius, radius * coarser / 10))
    return geo(drawing, line, widest, points=points)


def own_mesh(r, drawing):
    order, quads, line = r.choice((1, 2, 2)), r.choice((0, 1)), 10 ** r.uniform(-2, -1)
    return "bodies.geo", geo(drawing, line, max(line, 0.06), order, quads), order == 2, f"{'TQ'[quads]}{order}"


def make_outline(seed, number):
    r = random.Random(f"{seed}:outline:{number // SHARED}")
    drawing = r.choice(FAMILIES)(r)
    scene = scene_of(r, drawing)
    if drawing.what in ("crown", "cone", "wedge"):  # along its normals or the block's: p differs by the square of the angle between
        scene["contact"][0]["multipliers_on"] = r.choice(("upper_bottom", "lower_top"))
    closed = scene | {"contact": [scene["contact"][0] | ({"initial_gap": "closed"} if drawing.one_line else {})]}
    case = held_case("outline", drawing.what, drawing.what, scene, drawing, number, seed, lambda r: own_mesh(r, drawing))
    case.reference = lambda *how: {"scene.toml": scene_text(closed, "mesh.geo"), "mesh.geo": reference_geo(drawing, *how)}
    case.places, case.smooth = drawing.tips, tuple(drawing.tips) if drawing.joined else ()
    return case
