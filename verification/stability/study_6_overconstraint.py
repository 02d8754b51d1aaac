"""Over-constraint: contact nodes that are held otherwise too, shared nodes, curves that end within each other."""

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

import figure
from failures import SPACES, checks_of, draw_line, ends, failure, largest, over, quote, select, solved, warned
from plates import Body, between, even
from small_meshes import LEFT, PRESSED, SLIDING, WIDTH, plates, run, touching

EXACT = 10e6
LIMIT = 0.01
SIDES = ["upper_bottom", "lower_top"]
BOTH_LEFT = 'on = ["upper_left", "lower_left"], displacement = { x = 0, y = 0 }'


def held(*prescribed, left=LEFT):
    """The boundary conditions with prescribed displacements y of some curves."""
    fixed = [f'on = "{curve}", displacement = {{ y = {y!r} }}' for curve, y in prescribed]
    return [left, *fixed, *PRESSED[1:]]


def both(y):
    return held(("upper_bottom", y), ("lower_top", 0))


# name: boundary conditions; what is right ("exact": p = 10 MPa, "zero": p = 0, "refusal", None: no exact answer); and
# more for the run
JOIN, DDM = {"join": [("upper", "lower")]}, {"settings": {"method.solver": "ddm"}}
CASES = {
    "nothing prescribed": (SLIDING, "exact", {}),
    "lower curve prescribed": (held(("lower_top", 0)), "exact", {}),
    "both curves prescribed, touching": (both(0), "refusal", {}),
    "both curves prescribed, apart by 1e-5 m": (both(1e-5), "zero", {}),
    "both curves prescribed, overlap 1e-5 m": (both(-1e-5), "refusal", {}),
    "left ends prescribed, upper body": (held(("upper_left", 0)), None, {}),
    "left ends prescribed, both": (held(left=BOTH_LEFT), None, {}),
    "left ends prescribed, overlap 1e-4 m": (held(("upper_left", -1e-4), ("lower_left", 0)), "refusal", {}),
    "all nodes shared (8:8)": (SLIDING, "exact", {"meshes": (8, 8), **JOIN}),
    "every second node shared (8:4)": (SLIDING, "exact", {"meshes": (8, 4), **JOIN}),
    "end nodes shared (7:11)": (SLIDING, "exact", JOIN),
    "one curve in two pairs": (SLIDING, "refusal", {"pairs": 2}),
    "lower curve prescribed, ddm": (held(("lower_top", 0)), "exact", DDM),
    "end nodes shared, ddm": (SLIDING, "exact", {**JOIN, **DDM}),
}
GROUPS = {  # of cases that fail in the same way
    "One contact curve prescribed": lambda name: name == "lower curve prescribed",
    "Both contact curves prescribed": lambda name: name.startswith("both curves"),
    "Ends prescribed so that they overlap": lambda name: name.startswith("left ends prescribed, overlap"),
    "Nodes that both bodies share": lambda name: "shared" in name and "ddm" not in name,
    "One curve in two pairs": lambda name: name == "one curve in two pairs",
    "Three bodies that meet at a point": lambda name: name.startswith("three bodies"),
    "Prescribed curve or shared nodes, domain decomposition": lambda name: "ddm" in name,
}
COVERED = [1.0, 0.5, 0.3, 0.2, 0.1, 0.05, 0.02, 0.01, 1e-3, 1e-4, 1e-6, 1e-8]
VERDICTS = {  # and their colours
    "right": "#3b9a4f",
    "right, but a check fails": "#b5d99c",
    "no exact answer": "#d9d9d9",
    "refused": "#5b8fc9",
    "wrong, and a check fails": "#f2b134",
    "wrong, and solved": "#c4262e",
}


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
        Body("lower", even(12), 4, between(0, WIDTH, 0, 0.3), split=0.5),
        Body("one", even(5), 4, between(0, WIDTH / 2, 0.3, 0.6)),
        Body("two", even(7), 5, between(WIDTH / 2, WIDTH, 0.3, 0.6)),
    ]
    boundary = [
        'on = ["lower_left", "one_left"], displacement = { x = 0 }',
        'on = "lower_bottom", displacement = { y = 0 }',
        'on = ["one_top", "two_top", "two_right", "lower_right"], pressure = 10e6',
    ]
    pairs = [("one_bottom", "lower_top"), ("two_bottom", "lower_top2"), ("one_right", "two_left")]
    text = 'between = ["{0}", "{1}"], multipliers_on = "{2}"'
    contact = [text.format(*pair, pair[SIDES.index(side)]) for pair in pairs]
    axes = {"part": "case", "case": "three bodies at a point", "space": space, "side": side, "right": "exact"}
    return run(axes, bodies, boundary, contact, {"method.multipliers": space}, ["uniform", "pressure"])


def covered(q, space):
    """The upper block ends where it covers the fraction q of an edge of the base, which has the multipliers."""
    bodies = [
        Body("lower", even(8), 3, between(0, WIDTH, 0, 0.3)),
        Body("upper", even(6), 3, between(0, WIDTH * (5 + q) / 8, 0.3, 0.6)),
    ]
    axes = {"part": "covered", "case": "covered", "space": space, "value": q}
    settings, contact = {"method.multipliers": space}, touching(multipliers="lower_top")
    edges = {"edge": WIDTH / 8, "last": WIDTH * 6 / 8}
    return run(axes, bodies, SLIDING, contact, settings, ["uniform_facing"], young=[210e15, 210e9], **edges)


def runs(quick):
    spaces = SPACES[::2] if quick else SPACES
    listed = [case(name, space, side) for name in CASES for side in SIDES for space in spaces]
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
    return [{**row, "verdict": verdict(row)} if row["part"] == "case" else row for row in rows]


def draw_cases(axes, rows):
    names = list(dict.fromkeys(row["case"] for row in rows))
    columns = list(dict.fromkeys((row["side"], row["space"]) for row in rows))
    colours, table = list(VERDICTS), np.full((len(names), len(columns)), 2)
    for row in rows:
        table[names.index(row["case"]), columns.index((row["side"], row["space"]))] = colours.index(row["verdict"])
    axes.imshow(table, cmap=ListedColormap(VERDICTS.values()), vmin=-0.5, vmax=len(VERDICTS) - 0.5, aspect="auto")
    texts = [f"{space}\n{'upper' if side == 'upper_bottom' else 'lower'}" for side, space in columns]
    axes.set_yticks(range(len(names)), names, fontsize=8.5)
    axes.set_xticks(range(len(columns)), texts, fontsize=8)
    axes.set_xticks(np.arange(len(columns) + 1) - 0.5, minor=True)
    axes.set_yticks(np.arange(len(names) + 1) - 0.5, minor=True)
    axes.grid(which="minor", color="white", linewidth=2, alpha=1)
    axes.tick_params(which="both", length=0)
    axes.set_xlabel("multipliers: space, and the body whose curve carries them", fontsize=9)
    handles = [Patch(color=colour) for colour in VERDICTS.values()]
    axes.legend(handles, VERDICTS, loc="lower center", bbox_to_anchor=(0.3, 1.01), ncol=3, frameon=False)


def draw_covered(axes, rows):
    for number, space in enumerate(dict.fromkeys(row["space"] for row in rows)):
        line, style = select(rows, space=space), {"color": f"C{number}", "least": 1e-16}
        draw_line(axes, line, "value", "p_error", hollow=warned, label=f"{space}, all nodes", **style)
        draw_line(axes, line, "value", "p_error_facing", "--", label=f"{space}, where it faces", **style)
    q = "fraction q of the last edge that faces the other side"
    figure.label(axes, q, "largest relative error of p", log="xy", limit=LIMIT, legend=True)


def draw(rows, path):
    drawing, (left, right) = figure.panels(1, 2, (13.5, 5.6), width_ratios=(1.25, 1))
    draw_cases(left, select(rows, part="case"))
    draw_covered(right, select(rows, part="covered"))
    figure.save(drawing, path)


def state_of(verdicts):
    """What can be said of a group of cases as a whole: the worst of its runs."""
    if "wrong, and solved" in verdicts:
        return "open"
    if set(verdicts) <= {"right"}:
        return "fixed"
    return "shown" if any(name.startswith("wrong") for name in verdicts) else "guarded"


def group_failure(rows, name):
    group = [row for row in select(rows, part="case") if GROUPS[name](row["case"])]
    wrong = [row for row in group if row["verdict"].startswith("wrong")]
    found = [row["verdict"] for row in group]
    refusal, warning, checks = quote(group, lambda row: row["outcome"] == "refused"), quote(wrong), checks_of(group)
    said = f"The only word is the warning {warning}." if warning != "nothing" else ""
    said = f"{refusal}." if refusal != "nothing" else said
    said += f" Failing checks: {checks}." if checks != "none" else ""
    worst = largest(select(wrong, right="exact"), "p_error")
    return failure(
        name,
        float(len(wrong)),
        state_of(found),
        begins=", ".join(f"{found.count(verdict)} {verdict}" for verdict in VERDICTS if verdict in found)
        + (f"; p off by up to {worst:.0e} times" if worst else ""),
        said=said.strip() or ("Nothing is said." if wrong else "Solved as it should be."),
    )


def covered_failure(rows):
    line = [row for row in select(rows, part="covered") if solved(row)]
    bounds = {space: None for space in (row["space"] for row in line)}
    for space in bounds:
        bounds[space] = max((row["value"] for row in select(line, space=space) if over(LIMIT)(row)), default=None)
    untold = [row for row in line if over(LIMIT)(row) and row["outcome"] == "solved"]
    at = [row["p_error"] / row["p_error_facing"] for row in select(line, space="linear", value=0.01)]
    return failure(
        "An edge that hardly faces the other side",
        max(filter(None, bounds.values()), default=None),
        "open" if untold else "fixed",
        factor=at[0] if at else None,
        limit=LIMIT,
        bounds="; ".join(f"{space} {bound:g}" if bound else f"{space}: not found" for space, bound in bounds.items()),
        facing=largest(line, "p_error_facing"),
        untold=len(untold),
    )


def failures(rows):
    return [*(group_failure(rows, name) for name in GROUPS), covered_failure(rows)]
