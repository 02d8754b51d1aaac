"""Tables 1 to 3 and 5 to 8 of the preprint beside our figures.

Ours is the preprint's discretisation (8-node quadrilaterals, quadratic multipliers) with segments and a closed gap, and
the same with linear multipliers, the program's default; each with the multipliers on either body. "better" is the
smaller of the two quadratic ones, "best" the smallest of all four, "default" what the program does unasked: linear
multipliers on the finer side.
"""

import numpy as np

import oscillation
import preprint
from paper_runs import METHOD

SPACES = {"quadratic": METHOD, "linear": {}}
CLOSED = {"contact.initial_gap": "closed"}


def finer(mesh):
    return "G1" if mesh[0] > mesh[1] else "G2"


def measure(store, row, say=lambda text: None):
    """Our figures for a printed row."""
    say(f"table {row['table']}: {row['scene']} {row['mesh'][0]}x{row['mesh'][1]} {row['at']}, {row['body']}")
    found = {}
    for space, settings in SPACES.items():
        for side in preprint.OTHER:
            arguments = (store, row["scene"], row["mesh"], {**settings, **CLOSED}, side, row["body"], row["at"])
            found[f"{space}_on_{side}"] = oscillation.delta_of(*arguments)
            found[f"worst_{space}_on_{side}"] = oscillation.delta_of(*arguments, measure=oscillation.share_of_worst)
    return found


def judged(row, found):
    both = {name: found[name] for name in (f"quadratic_on_{side}" for side in preprint.OTHER)}
    better = min(both.values())
    best = min(better, *(found[f"linear_on_{side}"] for side in preprint.OTHER))
    mapped = {
        f"quadratic, {name}": found[f"quadratic_on_{side(row['active'])}"] for name, side in preprint.MAPPINGS.items()
    }
    return {
        **row,
        "mesh": f"{row['mesh'][0]}x{row['mesh'][1]}",
        **mapped,
        "better": better,
        "best": best,
        "default": found[f"linear_on_{finer(row['mesh'])}"],
        "better_share_of_worst": found["worst_" + min(both, key=both.get)],
        "printed_over_better": row["printed"] / better,
        "printed_over_best": row["printed"] / best,
        "better_ok": better <= row["printed"],
        "best_ok": best <= row["printed"],
    }


def compute(store, rows, say):
    cache, done = {}, []
    for row in rows:
        key = tuple(row[name] for name in ("scene", "mesh", "at", "body"))
        if key not in cache:
            cache[key] = measure(store, row, say)
        done.append(judged(row, cache[key]))
    return done


def of_series(rows, series):
    return [row for row in rows if row["target"] and preprint.series_of(row["scene"]) == series]


def fits(rows, variants=preprint.MAPPINGS):
    """Fit of each reading of "active", a row for each series and mapping."""
    for series in preprint.SERIES:
        here = of_series(rows, series)
        for name in variants if here else []:
            figures = preprint.fit([row[f"quadratic, {name}"] for row in here], [row["printed"] for row in here])
            yield {"series": series, "reading": name, **figures}


def ratios(rows):
    """Median of printed over ours, by series."""
    for series in preprint.SERIES:
        here = of_series(rows, series)
        if here:
            middle = lambda name: float(np.median([row["printed"] / row[name] for row in here]))
            yield {"series": series, "rows": len(here)} | {name: middle(name) for name in ("better", "best", "default")}


def exceptions(rows, name="better"):
    return [row for row in rows if row["target"] and row[name] > row["printed"]]


def short(value):
    return f"{value:.3g}" if isinstance(value, float) else str(value)


COLUMNS = {
    "table": "table",
    "scene": "scene",
    "mesh": "mesh",
    "at": "at",
    "active": "active",
    "body": "body",
    "printed": "printed",
    "quadratic, active carries the multipliers": "ours, active carries multipliers",
    "quadratic, active is the opposite side": "ours, active is opposite",
    "better": "ours, better side",
    "best": "ours, best space too",
    "default": "our default",
    "printed_over_better": "printed / better",
}


def lines(rows):
    """The table's cells as texts; a printed copy is in brackets."""
    for row in rows:
        cells = [short(row[name]) for name in COLUMNS]
        if not row["target"]:
            cells[list(COLUMNS).index("printed")] += " (copy)"
        yield cells


def markdown_table(heading, rows):
    yield "| " + " | ".join(heading) + " |"
    yield "|" + "---|" * len(heading)
    yield from ("| " + " | ".join(row) + " |" for row in rows)
    yield ""


def as_table(rows):
    """Dictionaries as heading and cells."""
    return list(rows[0]), [[short(value) for value in row.values()] for row in rows]
