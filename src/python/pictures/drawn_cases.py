"""The history of a scene's cases: what cases.csv says over the load, and p along the first contact line of some."""

import json

import figure
import numpy as np
import result_tables
from drawn_forces import ROUND_OFF
from drawn_pressure import loaded_part

MOST_LINES = 6  # of p along the contact line
MANY_NAMES = 12  # more are not written on the picture


def varies(column):
    """Whether a column holds numbers that differ."""
    return column.dtype.kind == "f" and np.isfinite(column).sum() > 1 and np.nanmax(column) > np.nanmin(column)


def changed(table):
    """The columns of what cases change, besides the scale."""
    names = list(table)
    return [name for name in names[1 : names.index("status")] if name != "scale"]


def load_axis(table, asked):
    """Name and values of what the cases are drawn over: a column that is asked for, else the scale, else the only number that
    cases change, if each has one, else their numbers."""
    if asked is not None:
        numbers = [name for name in table if table[name].dtype.kind == "f"]
        if asked not in numbers:
            found = "has no numbers" if asked in table else "no such column"
            raise SystemExit(f"picture.py: --along {asked}: {found}; expected one of cases.csv: {', '.join(numbers)}")
        return asked, table[asked]
    if "scale" in table and varies(table["scale"]):
        return "scale", table["scale"]
    names = changed(table)
    if len(names) == 1 and varies(table[names[0]]) and np.isfinite(table[names[0]]).all():
        return names[0], table[names[0]]
    return "case", np.arange(len(table["case"]), dtype=float)


def histories(table):
    """Names and row numbers of cases that differ in their scale alone; where none are scaled, of all."""
    rows = np.arange(len(table["case"]))
    if "scale" not in table or not varies(table["scale"]):
        return [("", rows)]
    found = {}
    for k in rows:
        found.setdefault(tuple(str(table[name][k]) for name in changed(table)), []).append(k)
    names = [name_of(case) for case in table["case"]]
    return [(history_name([names[k] for k in of]), np.array(of)) for of in found.values()]


def history_name(names):
    """What a list of scales was named, pull of pull_0.5 and pull_1; else the first and the last name."""
    heads = {name.rpartition("_")[0] for name in names}
    if len(heads) == 1 < len(names) and "" not in heads:
        return heads.pop()
    return " ... ".join(dict.fromkeys([names[0], names[-1]]))


def approach(table):
    """How a rigid curve moves or turns, the force or moment at work on it, and the name of the first: of that motion by which
    most work is done; nothing where all that is done is round-off of the bodies' energy."""
    motions = {"displacement.x": "acting.x", "displacement.y": "acting.y", "turned": "acting.turn"}
    most, best = ROUND_OFF * np.abs(np.nan_to_num(table.get("energy", np.zeros(1)))).max(), None
    for name in table:
        support, motion = ".".join(name.split(".")[:2]), ".".join(name.split(".")[2:])
        if motion not in motions or not support.startswith("support.") or not varies(table[name]):
            continue
        force = table[f"{support}.{motions[motion]}"]
        work = np.ptp(table[name][np.isfinite(table[name])]) * np.nanmax(np.abs(force))
        if work > most:
            most, best = work, (name, table[name], force)
    return best


def most_pressed(table, numbers):
    """Of the pairs with these numbers that with the largest p of any case."""
    largest = lambda k: np.nan_to_num(table[f"contact.{k}.pressure.max"], nan=-np.inf).max()
    return max(numbers, key=largest, default=0)


def contact_panels(table, number, numbers):
    """Of each panel its label, its values and their bars. The pair is named where cases.csv has several."""
    at = f"contact.{number}."
    of = f", contact.{number}" if len(numbers) > 1 else ""
    column = lambda name: table.get(at + name, np.full(len(table["case"]), np.nan))
    force = np.hypot(column("force.x"), column("force.y"))
    return [
        ("largest p" + of, column("pressure.max"), column("pressure.max_error")),
        ("length in contact" + of, column("length_in_contact"), column("length_in_contact_error")),
        ("contact force" + of, force, np.hypot(column("force_error.x"), column("force_error.y"))),
    ]


def in_order(groups, x, values):
    """The rows of each history that have both, in the order of x."""
    known = np.isfinite(x) & np.isfinite(values)
    return [(name, rows[known[rows]][np.argsort(x[rows[known[rows]]], kind="stable")]) for name, rows in groups]


def draw_over(axes, groups, x, values, bars, label, name):
    """Values with their bars over x, a line a history."""
    bars = np.where(np.isfinite(bars), bars, 0)
    for of, rows in in_order(groups, x, values):
        axes.fill_between(x[rows], (values - bars)[rows], (values + bars)[rows], color="0.82", linewidth=0)
        axes.plot(x[rows], values[rows], "o-", markersize=3, linewidth=1.2, label=figure.short(of))
    figure.label(axes, figure.short(name), "")
    figure.scientific(axes.yaxis, label)


def draw_stiffness(axes, groups, name, moved, reaction):
    """Force over displacement, or moment over turn, and its slope on an axis of its own, a line a history."""
    slopes = []
    for _, rows in in_order(groups, moved, reaction):
        u, force = moved[rows], reaction[rows]
        (line,) = axes.plot(u, force, "o-", markersize=3, linewidth=1.2)
        if len(np.unique(u)) == len(u) > 2:
            slopes.append((u, np.gradient(force, u), "0.4" if len(groups) == 1 else line.get_color()))
    figure.label(axes, figure.short(name), "")
    turns = name.endswith(".turned")
    figure.scientific(axes.yaxis, "moment" if turns else "force")
    if slopes:
        slope = axes.twinx()
        for u, stiffness, colour in slopes:
            slope.plot(u, stiffness, "--", color=colour, linewidth=1)
        figure.scientific(slope.yaxis, f"stiffness {'dM/da' if turns else 'dF/du'} (dashed)")


def pressures(folder, table, number):
    """Case, s, p and curve of the pair with that number, of some of the cases that have a contact.csv: of the multiplier side of the
    first, whichever side that is in the others."""
    curve = None
    names = [name for name in map(name_of, table["case"]) if (folder / "cases" / name / "contact.csv").is_file()]
    if len(names) > MOST_LINES:
        names = [names[round(k)] for k in np.linspace(0, len(names) - 1, MOST_LINES)]
    for name in names:
        pairs = json.loads((folder / "cases" / name / "summary.json").read_text())["contact"]
        pair = next((k for k, contact in enumerate(pairs) if contact["number"] == number), None)
        if pair is None:  # tied in this case
            continue
        found = result_tables.contact_table(folder / "cases" / name)
        sides = {found["curve"][side][0]: side for side in result_tables.sides_of(found, pair)}
        curve = curve or next(iter(sides))
        if curve not in sides:  # of a pattern that finds other curves
            continue
        on, s = result_tables.line_of(found, sides[curve])
        yield name, s, found["p"][on], curve


def name_of(case):
    """The name of a case whose names are all numbers, as it was."""
    return f"{case:g}" if isinstance(case, float) else str(case)


def draw_history(folder, picture, options):
    """One picture of the cases in a folder."""
    summary = json.loads((folder / "summary.json").read_text())
    table = result_tables.columns(folder / "cases.csv")
    (name, x), groups = load_axis(table, options.along), histories(table)
    numbers = [int(name.split(".")[1]) for name in table if name.startswith("contact.") and name.endswith(".pressure.max")]
    number = most_pressed(table, numbers) if options.pair is None else options.pair
    if number not in numbers:
        raise SystemExit(f"picture.py: {folder}: cases.csv has no contact pair {number}")
    lines = list(pressures(folder, table, number))
    moves = approach(table)
    count = 3 + bool(moves) + bool(lines)
    drawing, panels = figure.panels(count, 1, (8, 2.4 * count + 0.6), squeeze=False)
    rest = iter(panels[:, 0])
    for label, values, bars in contact_panels(table, number, numbers):
        draw_over(axes := next(rest), groups, x, values, bars, label, name)
        if name == "case" and len(x) <= MANY_NAMES:
            axes.set_xticks(x, [figure.short(name_of(case)) for case in table["case"]], rotation=20)
    if 1 < len(groups) <= MANY_NAMES:
        panels[0, 0].legend(frameon=False)
    if moves:
        draw_stiffness(next(rest), groups, *moves)
    if lines:
        axes = next(rest)
        for case, s, p, curve in lines:
            axes.plot(s, p, linewidth=1.2, label=figure.short(case))
        parts = [loaded_part(s, p) for _, s, p, _ in lines]
        axes.set_xlim(min(part[0] for part in parts), max(part[1] for part in parts))
        figure.label(axes, f"arc length $s$ along {figure.short(lines[0][3])}", "", legend={"frameon": False})
        figure.scientific(axes.yaxis, "contact pressure")
    title = figure.wrapped(summary["title"] or summary["scene"])
    bad = int(np.sum(table["status"] != "solved"))
    drawing.suptitle(f"{title}\n{bad} of {len(x)} cases are not solved" if bad else title, fontsize=11, color=figure.RED if bad else "black")
    figure.save(drawing, picture, options.dpi)
