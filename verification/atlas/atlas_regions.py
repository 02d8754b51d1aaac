"""What studies share: elements, and how they name the failures they find."""

# Parameters of the geometries in geo/.
ELEMENTS = {
    "3-node triangles": {"order": 1, "kind": 1},
    "4-node quadrilaterals": {"order": 1, "kind": 0},
    "6-node triangles": {"order": 2, "kind": 1},
    "8-node quadrilaterals": {"order": 2, "kind": 0},
    "9-node quadrilaterals": {"order": 2, "kind": 0, "nine_node": 1},
}

STATES = ("fixed", "default", "guarded", "shown", "open")


def region(name, begins, bound, state, why, mortise):
    """A failure: `bound` is where it begins, a number from the runs (None where the runs do not reach it)."""
    assert state in STATES
    return {"name": name, "begins": begins, "bound": bound, "state": state, "why": why, "mortise": mortise}


def sorted_by(rows, key):
    return sorted(rows, key=lambda row: row[key])


def say(value, form="g"):
    """A number as words; "none" if there is none."""
    return "none" if value is None else format(value, form)


def ends(values, step):
    """Every `step`-th of a list, and its last: what the quick atlas takes."""
    return [*values[:-1:step], values[-1]]


def told(bad):
    """How mortise tells of runs that are off: not at all of some (open), by a refusal or a warning, or by checks."""
    if any(row["outcome"] == "solved" and not row["warning_count"] for row in bad):
        return "open"
    return "guarded" if all(row["outcome"] == "refused" or row["warning_count"] for row in bad) else "shown"


def first(rows, key, holds):
    """The value of `key` in the first row, ascending in it, that fulfils a condition; None if none does."""
    return next((row[key] for row in sorted_by(rows, key) if holds(row)), None)


def last(rows, key, holds):
    return next((row[key] for row in reversed(sorted_by(rows, key)) if holds(row)), None)


def solved(row):
    """With results, whatever the checks say."""
    return row["outcome"] in ("solved", "check", "not converged")


def quote(rows, holds=lambda row: True, most=330):
    """What mortise said in the first of the rows that fulfils the condition: an error, or a warning."""
    for row in rows:
        text = row["message"] if row["outcome"] == "refused" else row.get("warnings", "").split(" | ")[0]
        if text and holds(row):
            text = text.removeprefix("error: ")
            return f'"{text[:most]}{"..." if len(text) > most else ""}"'
    return "nothing"


def checks_of(rows):
    """Names of the checks that fail in any of the rows, and the warning of p against sigma_n."""
    names = {name for row in rows for name in row.get("failed_checks", "").split("; ") if name}
    return ", ".join(sorted(names)) or "none"


def largest(rows, key):
    return max((row[key] for row in rows if row.get(key) is not None), default=None)
