"""Tables 1 to 3 and 5 to 8 of the preprint beside our figures.

Ours is the preprint's discretisation (8-node quadrilaterals, quadratic multipliers), else the program's defaults:
segments, gap and normals of the curve; and the same with linear multipliers, a default too; each with the multipliers
on either body. "better" is the smaller of the two quadratic ones, "best" the smallest of all four, "default" what the
program does unasked: linear multipliers on the finer side.
"""

import numpy as np

import launch
import printed_tables as printed
from preprint_runs import METHOD

SPACES = {"quadratic": METHOD, "linear": {}}
COLUMNS = {
    **{name: name for name in ("table", "scene", "mesh", "at", "active", "body", "printed")},
    "quadratic, active carries the multipliers": "ours, active carries multipliers",
    "quadratic, active is the opposite side": "ours, active is opposite",
    "better": "ours, better side",
    "best": "ours, best space too",
    "default": "our default",
    "printed_over_better": "printed / better",
}


def judged(row, quadratic, linear):
    """A row with our figures."""
    (better, share), (best, _) = min(quadratic.values()), min([*quadratic.values(), *linear.values()])
    finer = "G1" if row["mesh"][0] > row["mesh"][1] else "G2"
    mapped = {name: quadratic[side(row["active"])][0] for name, side in printed.MAPPINGS.items()}
    return {
        **row,
        **{"mesh": launch.mesh_name(row["mesh"])},
        **{f"quadratic, {name}": value for name, value in mapped.items()},
        **{"better": better, "best": best, "default": linear[finer][0], "better_share_of_worst": share},
        **{"printed_over_better": row["printed"] / better, "printed_over_best": row["printed"] / best},
        **{"better_ok": better <= row["printed"], "best_ok": best <= row["printed"]},
    }


def compute(store, rows, say):
    spaces = [printed.deltas(store, rows, lambda _, own=own: own, f"tables, {name}", say) for name, own in SPACES.items()]
    return [judged(row, quadratic, linear) for (row, quadratic), (_, linear) in zip(*spaces)]


def ratios(rows):
    """Median of printed over ours, by series."""
    for series in printed.SERIES:
        if here := printed.of_series(rows, series):
            middle = lambda name: float(np.median([row["printed"] / row[name] for row in here]))
            yield {"series": series, "rows": len(here)} | {name: middle(name) for name in ("better", "best", "default")}


def exceptions(rows, name="better"):
    return [row for row in rows if row["target"] and row[name] > row["printed"]]


def short(value):
    return ("none" if value != value else f"{value:.3g}") if isinstance(value, float) else str(value)


def lines(rows):
    """The table's cells as texts; a printed copy is in brackets."""
    for row in rows:
        yield [short(row[name]) + (" (copy)" if name == "printed" and not row["target"] else "") for name in COLUMNS]
