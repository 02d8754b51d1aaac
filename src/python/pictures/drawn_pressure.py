"""The pressure along a contact line, with its bar and the stresses of both bodies."""

import figure
import numpy as np
from drawn_bodies import PAIR_COLOURS
from drawn_cells import percentiles
from result_tables import arc_length_on, closing_of, line_of, sides_of

COLOURS = ["#e8452c", "#4aa3e8"]  # multiplier side, opposite side


def loaded_part(s, p, half=0.0):
    """Limits of x: where p acts and a fifth as much again, or all of the line where it acts on most of it. `half`: of the
    lengths of edges, where s are their middles."""
    left, right, p = s - half, s + half, np.nan_to_num(p)
    loaded = p > 1e-9 * np.abs(p).max()
    whole = left.min(), right.max()
    if not loaded.any() or np.ptp(s[loaded]) > 0.8 * np.ptp(s):
        return whole
    margin = max(np.ptp(s[loaded]), 1e-6 * np.ptp(s)) / 10
    return max(whole[0], left[loaded].min() - margin), min(whole[1], right[loaded].max() + margin)


def pressure_range(curves):
    """Limits of y that show nearly all of the curves (places, values): what is at singular corners may leave the panel."""
    lengths = np.concatenate([np.abs(np.gradient(s)) if len(s) > 1 else np.ones(len(s)) for s, _ in curves])
    values = np.concatenate([value for _, value in curves])
    kept = np.isfinite(values)
    values = values[kept]
    if len(values) == 0:
        return -1.0, 1.0
    first, last = percentiles(values, lengths[kept], [2, 98])
    middle, half = (first + last) / 2, max((last - first) / 2, 0.02 * abs(first + last) / 2)
    low = min(max(middle - 1.6 * half, values.min() - 0.25 * half), middle - 1.1 * half)
    high = max(min(middle + 1.6 * half, values.max() + 0.25 * half), middle + 1.1 * half)
    if 0 < first < 0.3 * last:
        low = min(low, 0.0)
    return (low, high) if high > low else (low - 1, high + 1)


def has_limit(summary, pair):
    """Whether p is known to be bounded on the whole line: where the errors were estimated."""
    told = (summary.get("estimate") or {}).get("pressure")
    return told is not None and all(at["pair"] != pair or at["pressure_exponent"] >= 1 for at in told["singular"])


def draw_pair(axes, table, pair, bounded, label="$p$", colour=PAIR_COLOURS[0]):
    """p along the contact line of a pair with its bar as a band, and -sigma_n of both bodies, over the arc length of the
    multiplier side. All of a bounded p is shown."""
    xy = np.stack([table["x"], table["y"]], axis=1)
    first, other = sides_of(table, pair)
    multiplier_side, opposite = (figure.short(table["curve"][side][0]) for side in (first, other))
    on, s = line_of(table, first)
    p, s_other = table["p"][on], arc_length_on(xy[on], s, xy[other])
    mine, theirs = -table["sigma_n"][on], -table["sigma_n"][other]
    if "p_error" in table:
        bar = table["p_error"][on]
        axes.fill_between(s, p - bar, p + bar, color="0.82", linewidth=0, label="bar of $p$", zorder=1)
    axes.plot(s, p, color=colour, linewidth=1.7, label=label, zorder=2)
    axes.plot(s, mine, color=COLOURS[0], linewidth=0.9, label=f"$-\\sigma_n$ of {multiplier_side}", zorder=3)
    label = f"$-\\sigma_n$ of {opposite}"
    seam = np.flatnonzero(np.abs(np.diff(s_other)) > np.ptp(s) / 2) + 1 if closing_of(table, first) else []  # no line across the whole graph
    axes.plot(np.insert(s_other, seam, np.nan), np.insert(theirs, seam, np.nan), color=COLOURS[1], linewidth=0.9, dashes=(5, 2), label=label, zorder=4)
    left, right = loaded_part(s, p, table["half"][on] if "half" in table else 0)
    shown, shown_other = (s >= left) & (s <= right), (s_other >= left) & (s_other <= right)
    low, high = pressure_range([(s[shown], p[shown]), (s[shown], mine[shown]), (s_other[shown_other], theirs[shown_other])])
    if bounded:
        low, high = min(low, 1.05 * np.nan_to_num(p).min()), max(high, 1.05 * np.nan_to_num(p).max())
    axes.set_ylim(low, high)
    axes.set_xlim(left, right)
    everything = np.concatenate([p[shown], mine[shown], theirs[shown_other]])
    off = everything[(everything > high) | (everything < low)]
    label = f"arc length $s$ along {multiplier_side}"
    if len(off) > 0:
        farthest = off[np.argmax(np.abs(off - (low + high) / 2))]
        count = f"{len(off)} of {np.isfinite(everything).sum()}"
        label += f"    ({count} values off the scale, the farthest {farthest:.3g})"
    axes.set_xlabel(label)
    figure.scientific(axes.yaxis, "contact pressure")
    axes.grid(color="0.9", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.legend(loc="upper center", ncol=4, frameon=False, fontsize=8, bbox_to_anchor=(0.5, 1.17))
