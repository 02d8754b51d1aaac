"""Over-constraint: contact nodes that are held otherwise too, shared nodes, curves that end within each other."""

import atlas_overconstraint_picture
import atlas_overconstraint_regions
from atlas_mesh import PRESSED, SLIDING, WIDTH, body, even, line, plates, run, touching
from atlas_regions import ends, solved

TITLE = "Over-constraint"
INTRODUCTION = (
    "Contact conditions that other conditions already fix, or contradict: prescribed displacements on one contact "
    "curve, on both, at the ends; nodes that both bodies share; three bodies that meet at a point; an edge that "
    "faces the other side with a part of its length only. Two plates of 8-node quadrilaterals, 7 and 11 along a "
    "flat line, pressure 10 MPa; p is exactly 10 MPa where that is said."
)
CAPTION = (
    "Left: how each case ends, for multipliers on either side and three spaces. Right: the error of the largest "
    "nodal p where the last edge of the multiplier side faces the other side with the fraction q of its length only "
    "(on a base 1e6 times as stiff, p = 10 MPa). Open symbols: a check fails."
)
EXACT = 10e6
LIMIT = 0.01
SPACES = ["linear", "quadratic", "dual"]
SIDES = ["upper_bottom", "lower_top"]
LEFT = 'on = ["upper_left", "lower_left"], displacement = { x = 0 }'
GROUND, LOAD = PRESSED[1:]
BOTH_LEFT = 'on = ["upper_left", "lower_left"], displacement = { x = 0, y = 0 }'


def held(*conditions):
    return [LEFT, *conditions, GROUND, LOAD]


def fixed(curve, y):
    return f'on = "{curve}", displacement = {{ y = {y!r} }}'


# name: boundary conditions; what is right ("exact": p = 10 MPa, "zero": p = 0, "refusal", None: no exact answer); and
# more for the run
CASES = {
    "nothing prescribed": (SLIDING, "exact", {}),
    "lower curve prescribed": (held(fixed("lower_top", 0)), "exact", {}),
    "both curves prescribed, touching": (held(fixed("upper_bottom", 0), fixed("lower_top", 0)), "refusal", {}),
    "both curves prescribed, apart by 1e-5 m": (held(fixed("upper_bottom", 1e-5), fixed("lower_top", 0)), "zero", {}),
    "both curves prescribed, overlap 1e-5 m": (
        held(fixed("upper_bottom", -1e-5), fixed("lower_top", 0)), "refusal", {}
    ),
    "left ends prescribed, upper body": ([LEFT, fixed("upper_left", 0), GROUND, LOAD], None, {}),
    "left ends prescribed, both": ([BOTH_LEFT, GROUND, LOAD], None, {}),
    "left ends prescribed, overlap 1e-4 m": (held(fixed("upper_left", -1e-4), fixed("lower_left", 0)), "refusal", {}),
    "all nodes shared (8:8)": (SLIDING, "exact", {"meshes": (8, 8), "join": [("upper", "lower")]}),
    "every second node shared (8:4)": (SLIDING, "exact", {"meshes": (8, 4), "join": [("upper", "lower")]}),
    "end nodes shared (7:11)": (SLIDING, "exact", {"join": [("upper", "lower")]}),
    "one curve in two pairs": (SLIDING, "refusal", {"pairs": 2}),
    "lower curve prescribed, ddm": (held(fixed("lower_top", 0)), "exact", {"settings": {"method.solver": "ddm"}}),
    "end nodes shared, ddm": (SLIDING, "exact", {"join": [("upper", "lower")], "settings": {"method.solver": "ddm"}}),
}
THREE = "three bodies at a point"
COVERED = [1.0, 0.5, 0.3, 0.2, 0.1, 0.05, 0.02, 0.01, 1e-3, 1e-4, 1e-6, 1e-8]
VERDICTS = [
    "right",
    "right, but a check fails",
    "no exact answer",
    "refused",
    "wrong, and a check fails",
    "wrong, and solved",
]


def case(name, space, side):
    boundary, right, options = CASES[name]
    upper, lower = options.get("meshes", (7, 11))
    bodies = plates(lambda x: 0.3, even(upper), even(lower))
    contact = touching(multipliers=side) + touching(multipliers="lower_top") * (options.get("pairs", 1) - 1)
    axes = {"part": "case", "case": name, "space": space, "side": side, "right": right}
    settings = {"method.multipliers": space, **options.get("settings", {})}
    return run(axes, bodies, boundary, contact, settings, ["uniform", "pressure"], join=options.get("join", ()))


def three_bodies(space, side):
    """Two blocks side by side on a third, all touching, 10 MPa from all sides."""
    bodies = [
        body("lower", even(12), 4, line(0, WIDTH, 0, 0.3), split=0.5),
        body("one", even(5), 4, line(0, WIDTH / 2, 0.3, 0.6)),
        body("two", even(7), 5, line(WIDTH / 2, WIDTH, 0.3, 0.6)),
    ]
    boundary = [
        'on = ["lower_left", "one_left"], displacement = { x = 0 }',
        'on = "lower_bottom", displacement = { y = 0 }',
        'on = ["one_top", "two_top", "two_right", "lower_right"], pressure = 10e6',
    ]
    pairs = [("one_bottom", "lower_top"), ("two_bottom", "lower_top2"), ("one_right", "two_left")]
    which = 0 if side == "upper_bottom" else 1
    contact = [
        f'between = ["{a}", "{b}"], initial_gap = "closed", multipliers_on = "{(a, b)[which]}"' for a, b in pairs
    ]
    axes = {"part": "case", "case": THREE, "space": space, "side": side, "right": "exact"}
    return run(axes, bodies, boundary, contact, {"method.multipliers": space}, ["uniform", "pressure"])


def covered(q, space):
    """The upper block ends where it covers the fraction q of an edge of the base, which has the multipliers."""
    columns, width = 8, WIDTH * (5 + q) / 8
    bodies = [
        body("lower", even(columns), 3, line(0, WIDTH, 0, 0.3)),
        body("upper", even(6), 3, line(0, width, 0.3, 0.6)),
    ]
    axes = {"part": "covered", "case": "covered", "space": space, "value": q}
    contact = touching("closed", multipliers="lower_top")
    return run(
        axes,
        bodies,
        SLIDING,
        contact,
        {"method.multipliers": space},
        ["uniform_facing"],
        young=[210e15, 210e9],
        edge=WIDTH / 8,
        last=WIDTH * 6 / 8,
    )


def runs(quick):
    names = list(CASES)
    spaces = SPACES[::2] if quick else SPACES
    listed = [case(name, space, side) for name in names for side in SIDES for space in spaces]
    listed += [three_bodies(space, side) for side in SIDES for space in spaces]
    return listed + [covered(q, space) for space in spaces for q in (ends(COVERED, 3) if quick else COVERED)]


def verdict(row):
    if not solved(row):
        return "refused"
    if row["right"] is None:
        return "no exact answer"
    good = {"exact": row["p_error"] <= 1e-6, "zero": abs(row["p_max"]) < 1e-6 * EXACT, "refusal": False}[row["right"]]
    if good:
        return "right" if row["outcome"] == "solved" else "right, but a check fails"
    return "wrong, and solved" if row["outcome"] == "solved" else "wrong, and a check fails"


def complete(rows):
    for row in rows:
        if row["part"] == "case":
            row["verdict"] = verdict(row)
    return rows


def draw(rows, path):
    atlas_overconstraint_picture.draw(rows, path, VERDICTS, LIMIT)


def regions(rows):
    return atlas_overconstraint_regions.regions(rows, VERDICTS, LIMIT)
