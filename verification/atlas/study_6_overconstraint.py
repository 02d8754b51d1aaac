"""Over-constraint: contact nodes that are held otherwise too, shared nodes, curves that end within each other."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap

from atlas_mesh import PRESSED, SLIDING, WIDTH, body, even, line, plates, run, touching
from atlas_regions import checks_of, first, largest, quote, region, solved

TITLE = "Over-constraint"
INTRODUCTION = (
    "Contact conditions that other conditions already fix, or contradict: prescribed displacements on one contact curve, on both, at "
    "the ends; nodes that both bodies share; three bodies that meet at a point; an edge that faces the other side with a part of its length only. Two plates of "
    "8-node quadrilaterals, 7 and 11 along a flat line, pressure 10 MPa; p is exactly 10 MPa where that is said."
)
CAPTION = (
    "Left: how each case ends, for multipliers on either side and three spaces. Right: the error of the largest nodal p where the last "
    "edge of the multiplier side faces the other side with the fraction q of its length only (on a base 1e6 times as stiff, p = 10 MPa). "
    "Open symbols: a check fails."
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


# name: boundary conditions, what is right ("exact": p = 10 MPa; "zero": p = 0; "refusal"; None: no exact answer), and more for the run
CASES = {
    "nothing prescribed": (SLIDING, "exact", {}),
    "lower curve prescribed": (held(fixed("lower_top", 0)), "exact", {}),
    "both curves prescribed, touching": (held(fixed("upper_bottom", 0), fixed("lower_top", 0)), "refusal", {}),
    "both curves prescribed, apart by 1e-5 m": (held(fixed("upper_bottom", 1e-5), fixed("lower_top", 0)), "zero", {}),
    "both curves prescribed, overlap 1e-5 m": (held(fixed("upper_bottom", -1e-5), fixed("lower_top", 0)), "refusal", {}),
    "left ends prescribed, upper body": ([LEFT, fixed("upper_left", 0), GROUND, LOAD], None, {}),
    "left ends prescribed, both": ([BOTH_LEFT, GROUND, LOAD], None, {}),
    "left ends prescribed, overlap 1e-4 m": (held(fixed("upper_left", -1e-4), fixed("lower_left", 0)), "refusal", {}),
    "all nodes shared (8:8)": (SLIDING, "exact", {"meshes": (8, 8), "join": [("upper", "lower")]}),
    "every second node shared (8:4)": (SLIDING, "exact", {"meshes": (8, 4), "join": [("upper", "lower")]}),
    "end nodes shared (7:11)": (SLIDING, "exact", {"join": [("upper", "lower")]}),
    "one curve in two pairs": (SLIDING, "refusal", {"pairs": 2}),
    "lower curve prescribed, ddm": (held(fixed("lower_top", 0)), "exact", {"settings": {"method.kind": "ddm"}}),
    "end nodes shared, ddm": (SLIDING, "exact", {"join": [("upper", "lower")], "settings": {"method.kind": "ddm"}}),
}
THREE = "three bodies at a point"
COVERED = [1.0, 0.5, 0.3, 0.2, 0.1, 0.05, 0.02, 0.01, 1e-3, 1e-4, 1e-6, 1e-8]
VERDICTS = ["right", "right, but a check fails", "no exact answer", "refused", "wrong, and a check fails", "wrong, and nothing tells"]
COLOURS = ["#3b9a4f", "#b5d99c", "#d9d9d9", "#5b8fc9", "#f2b134", "#c4262e"]


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
    contact = [f'between = ["{a}", "{b}"], initial_gap = "closed", multipliers_on = "{(a, b)[which]}"' for a, b in pairs]
    axes = {"part": "case", "case": THREE, "space": space, "side": side, "right": "exact"}
    return run(axes, bodies, boundary, contact, {"method.multipliers": space}, ["uniform", "pressure"])


def covered(q, space):
    """The upper block ends where the last edge it meets is covered to the fraction q; the base below has the multipliers."""
    columns, width = 8, WIDTH * (5 + q) / 8
    bodies = [body("lower", even(columns), 3, line(0, WIDTH, 0, 0.3)), body("upper", even(6), 3, line(0, width, 0.3, 0.6))]
    axes = {"part": "covered", "case": "covered", "space": space, "value": q}
    contact = touching("closed", multipliers="lower_top")
    return run(axes, bodies, SLIDING, contact, {"method.multipliers": space}, ["uniform_facing"], young=[210e15, 210e9], edge=WIDTH / 8, last=WIDTH * 6 / 8)


def runs(quick):
    names = list(CASES)
    spaces = SPACES[::2] if quick else SPACES
    listed = [case(name, space, side) for name in names for side in SIDES for space in spaces]
    listed += [three_bodies(space, side) for side in SIDES for space in spaces]
    return listed + [covered(q, space) for space in spaces for q in (COVERED[::3] if quick else COVERED)]


def verdict(row):
    if not solved(row):
        return "refused"
    if row["right"] is None:
        return "no exact answer"
    good = {"exact": row["p_error"] <= 1e-6, "zero": abs(row["p_max"]) < 1e-6 * EXACT, "refusal": False}[row["right"]]
    if good:
        return "right" if row["outcome"] == "solved" else "right, but a check fails"
    return "wrong, and nothing tells" if row["outcome"] == "solved" else "wrong, and a check fails"


def complete(rows):
    for row in rows:
        if row["part"] == "case":
            row["verdict"] = verdict(row)
    return rows


def draw_cases(axes, rows):
    names = [*CASES, THREE]
    columns = list(dict.fromkeys((row["side"], row["space"]) for row in rows if row["part"] == "case"))
    table = np.full((len(names), len(columns)), 2)
    for row in rows:
        if row["part"] == "case":
            at = names.index(row["case"]), columns.index((row["side"], row["space"]))
            table[at] = VERDICTS.index(row["verdict"])
    axes.imshow(table, cmap=ListedColormap(COLOURS), vmin=-0.5, vmax=len(COLOURS) - 0.5, aspect="auto")
    axes.set_yticks(range(len(names)), names, fontsize=8.5)
    axes.set_xticks(range(len(columns)), [f"{space}\n{'upper' if side == 'upper_bottom' else 'lower'}" for side, space in columns], fontsize=8)
    axes.set_xticks(np.arange(len(columns) + 1) - 0.5, minor=True)
    axes.set_yticks(np.arange(len(names) + 1) - 0.5, minor=True)
    axes.grid(which="minor", color="white", linewidth=2)
    axes.tick_params(which="both", length=0)
    axes.set_xlabel("multipliers: space, and the body whose curve carries them", fontsize=9)
    handles = [plt.Rectangle((0, 0), 1, 1, color=colour) for colour in COLOURS]
    axes.legend(handles, VERDICTS, loc="lower center", bbox_to_anchor=(0.3, 1.01), ncol=3, fontsize=8, frameon=False)


def draw_covered(axes, rows):
    for number, space in enumerate(SPACES):
        part = [row for row in rows if row["part"] == "covered" and row["space"] == space and solved(row)]
        axes.plot([r["value"] for r in part], [max(r["p_error"], 1e-16) for r in part], "-", color=f"C{number}", label=f"{space}, all nodes")
        axes.plot([r["value"] for r in part], [max(r["p_error_facing"], 1e-16) for r in part], "--", color=f"C{number}", label=f"{space}, where it faces")
        for row in part:
            fill = "none" if row["failed_checks"] else f"C{number}"
            axes.plot(row["value"], max(row["p_error"], 1e-16), "o", color=f"C{number}", markerfacecolor=fill, markersize=4.5)
    axes.axhline(LIMIT, color="0.4", linestyle=":", linewidth=0.9)
    axes.set(xscale="log", yscale="log", xlabel="fraction q of the last edge that faces the other side", ylabel="largest relative error of p")
    axes.grid(alpha=0.25)
    axes.legend(fontsize=8)


def draw(rows, path):
    figure, (left, right) = plt.subplots(1, 2, figsize=(13.5, 5.6), width_ratios=(1.25, 1), layout="constrained")
    draw_cases(left, rows)
    draw_covered(right, rows)
    figure.savefig(path, dpi=85)
    plt.close(figure)


def of_case(rows, *names):
    return [row for row in rows if row["case"] in names]


def counts(rows):
    found = [row["verdict"] for row in rows]
    return ", ".join(f"{found.count(name)} {name}" for name in VERDICTS if name in found)


def state_of(rows):
    """What can be said of a group of cases as a whole: the worst of its runs."""
    found = {row["verdict"] for row in rows}
    if "wrong, and nothing tells" in found:
        return "open"
    if found <= {"right"}:
        return "fixed"
    return "guarded" if not any(name.startswith("wrong") for name in found) else "shown"


DEPENDENT = (
    "A row of the coupling whose displacements are all prescribed says nothing of the unknowns, and rows that others imply make the saddle-point matrix singular "
    "(Brezzi & Fortin 1991, section II.1: B must have full rank)."
)
GROUPS = [
    ("One contact curve prescribed", ["lower curve prescribed"], DEPENDENT + " Here the finer side's multipliers have more rows than the other side has nodes."),
    ("Both contact curves prescribed", [name for name in CASES if name.startswith("both curves")], DEPENDENT + " Whether the bodies touch, overlap or are apart is then decided by the prescribed values, and a pressure is not determined."),
    ("Ends prescribed so that they overlap", ["left ends prescribed, overlap 1e-4 m"], "The condition at the end contradicts the prescribed values; the multiplier takes the neighbour's row, whose weighted gap contains the overlap (Wohlmuth 2000 ties end multipliers for homogeneous conditions only)."),
    ("Nodes that both bodies share", [name for name in CASES if "shared" in name and "ddm" not in name], DEPENDENT + " At a shared node the gap is zero whatever the displacement."),
    ("One curve in two pairs", ["one curve in two pairs"], "Two pairs on one curve demand the same gap twice, or that two bodies are at one place; only pieces of the curve that do not overlap are independent."),
    ("Three bodies that meet at a point", [THREE], "At the common point three conditions meet, of which each body feels two (a cross point; Bernardi, Maday & Patera 1994). With a node for each body the three are independent."),
    ("Prescribed curve or shared nodes, domain decomposition", [name for name in CASES if "ddm" in name], "The body that takes the displacement must be able to answer with a pressure: C_D is singular where its curve is prescribed (theory, eq. 32)."),
]


def case_region(rows, name, cases, why):
    group = of_case(rows, *cases)
    wrong = [row for row in group if row["verdict"].startswith("wrong")]
    refused = quote(group, lambda row: row["outcome"] == "refused")
    said = f"{refused}. " if refused != "nothing" else ""
    checks = checks_of(group)
    checks = f"Failing checks: {checks}. " if checks != "none" else ""
    worst = largest([row for row in wrong if row["right"] == "exact"], "p_error")
    begins = counts(group) + (f"; p off by up to {worst:.0e} times" if worst else "")
    return region(name, begins, float(len(wrong)), state_of(group), why, (said + checks).strip() or "No refusal, no check that fails." if wrong else (said + checks).strip() or "Solved as it should be.")


def covered_region(rows):
    line = [row for row in rows if row["part"] == "covered" and solved(row)]
    bounds = {space: first([{**row, "q": -row["value"]} for row in line if row["space"] == space], "q", lambda row: row["p_error"] > LIMIT) for space in SPACES}
    words = "; ".join(f"{space} {-bound:g}" if bound else f"{space}: not found" for space, bound in bounds.items() if any(r["space"] == space for r in line))
    at = lambda q: [row["p_error"] / row["p_error_facing"] for row in line if row["space"] == "linear" and row["value"] == q]
    factor = f"at q = 0.01 the nodes' own error is magnified {at(0.01)[0]:.0f} times; " if at(0.01) else ""
    facing = largest(line, "p_error_facing")
    untold = [row for row in line if row["p_error"] > LIMIT and row["outcome"] == "solved"]
    why = (
        "Over the fraction q of its edge the shape function of the far node is at most q, so its value is an extrapolation over 1 / q from an integral of the size of q^2: "
        "errors are magnified by 1 / q^2 (Cichosz & Bischoff 2011)."
    )
    mortise = (
        f"Multipliers whose weighted gap has no sign, or without support, are tied or left out with a note (theory, section 4). p where the sides face each other is off by {facing:.0e} at most. "
        f"{len(untold)} runs with a value off by more than {LIMIT:.0%} end as solved."
    )
    begins = f"{factor}p at the node past the end is off by more than {LIMIT:.0%} from q = {words} (with an error of {facing:.0e} at the nodes that face)"
    found = [-bound for bound in bounds.values() if bound]
    return region("An edge that hardly faces the other side", begins, max(found, default=None), "open" if untold else "fixed", why, mortise)


def regions(rows):
    return [*(case_region(rows, *group) for group in GROUPS), covered_region(rows)]
