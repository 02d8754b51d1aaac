"""What the stability studies share: runs of scenes, lines of rows, and the failures they find in them."""

import figure

# Parameters of the geometries in geo/.
ELEMENTS = {
    "3-node triangles": {"order": 1, "kind": 1},
    "4-node quadrilaterals": {"order": 1, "kind": 0},
    "6-node triangles": {"order": 2, "kind": 1},
    "8-node quadrilaterals": {"order": 2, "kind": 0},
    "9-node quadrilaterals": {"order": 2, "kind": 0, "nine_node": 1},
}
# Gap and normals as in the preprint: those of the meshes.
OF_MESHES = {"contact.0.initial_gap": "measured", "method.normals": "edges"}
SPACES = ["linear", "quadratic", "dual"]
STATES = ("fixed", "default", "guarded", "shown", "open")  # stability.md says what they mean


def failure(name, bound, state, **values):
    """`bound`: where it begins, a number from the runs (None where the runs do not reach it). It and `values`
    fill the study's text of that name: where it begins, why, what mortise does about it."""
    assert state in STATES
    return {"name": name, "bound": bound, "state": state, "values": values}


def parameters(**values):
    """Settings of a geometry's parameters."""
    return {f"mesh.parameters.{key}": value for key, value in values.items()}


def of_scene(axes, scene, settings, *measures, **others):
    """A run (stability_runs) of a scene of geo/."""
    return {"axes": axes, "scene": scene, "settings": settings, "measures": list(measures), **others}


def draw_line(axes, rows, x, y, style="o-", hollow=None, least=1e-17, **options):
    """A curve through the rows that have the figure y, but no less than `least`; open where `hollow` holds of the row."""
    rows = [row for row in rows if solved(row) and row.get(y) is not None]
    some = {row[x] for row in rows if hollow and hollow(row)}
    of = hollow and (lambda at, _: at in some)
    return figure.curve(axes, [(row[x], max(row[y], least)) for row in rows], style, hollow=of, **options)


def warned(row):
    """Whether a check fails or p is warned of."""
    return row["failed_checks"]


def select(rows, **axes):
    return [row for row in rows if all(row.get(key) == value for key, value in axes.items())]


def solved(row):
    """With results, whatever the checks say."""
    return row["outcome"] in ("solved", "check", "not converged")


def over(limit, key="p_error"):
    """Whether a row's figure is above a limit."""
    return lambda row: row.get(key) is not None and row[key] > limit


def silent(rows, holds=lambda row: True):
    """Runs that fulfil a condition, and of which neither status, checks nor warnings tell."""
    return [row for row in rows if holds(row) and row["outcome"] == "solved" and not row["warning_count"]]


def told(bad):
    """How mortise tells of runs that are off: not at all of some (open), by a refusal or a warning, or by checks."""
    if silent(bad):
        return "open"
    if not bad:
        return "fixed"
    return "guarded" if all(row["outcome"] == "refused" or row["warning_count"] for row in bad) else "shown"


def first(rows, key, holds):
    """The least value of `key` in rows that fulfil a condition; None if none does."""
    return min((row[key] for row in rows if holds(row)), default=None)


def last(rows, key, holds):
    return max((row[key] for row in rows if holds(row)), default=None)


def largest(rows, key):
    return max((row[key] for row in rows if row.get(key) is not None), default=None)


def away(row):
    """How far the row's ratio is from 1, up or down."""
    return max(row["ratio"], 1 / row["ratio"])


def ends(values, step):
    """Every `step`-th of a list, and its last: what the quick studies take."""
    return [*values[:-1:step], values[-1]]


def quote(rows, holds=lambda row: True, most=330, warning=""):
    """What mortise said in the first of the rows that fulfils the condition: an error, or its first warning that
    contains `warning`."""
    for row in rows:
        warnings = (text for text in row.get("warnings", "").split(" | ") if warning in text)
        text = row["message"] if row["outcome"] == "refused" else next(warnings, "")
        if text and holds(row):
            text = text.removeprefix("error: ")
            return f'"{text[:most]}{"..." if len(text) > most else ""}"'
    return "nothing"


def checks_of(rows):
    """Names of the checks that fail in any of the rows, and the warning of p."""
    names = {name for row in rows for name in row.get("failed_checks", "").split("; ") if name}
    return ", ".join(sorted(names)) or "none"
