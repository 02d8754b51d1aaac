"""Many contact pairs: p along a curve over all its pairs, a small panel for each of the most loaded, and p of several runs."""

import figure
import numpy as np
from drawn_bodies import PAIR_COLOURS
from drawn_pressure import loaded_part
from result_tables import line_of, nearest_on, sides_of

SMALL, COLUMNS = 12, 4  # panels of pairs


def shared_curve(pairs):
    """The curve that most pairs have, with their numbers, if several have one."""
    found = {}
    for k, pair in enumerate(pairs):
        for curve in pair["between"]:
            found.setdefault(curve, []).append(k)
    curve, numbers = max(found.items(), key=lambda entry: len(entry[1]))
    return (curve, numbers) if len(numbers) > 1 else None


def draw_along(axes, table, curve, numbers):
    """p along one curve, of all its pairs in turn."""
    of_curve = (table["curve"] == curve) & np.isin(table["pair"], numbers)
    for k in numbers:
        rows = np.flatnonzero(of_curve & (table["pair"] == k) & np.isfinite(table["gap"]))  # those that face the other
        rows = rows[np.argsort(table["s"][rows])]
        s, p = table["s"][rows], table["p"][rows]
        apart = np.flatnonzero(np.diff(s) > 10 * np.median(np.diff(s))) + 1 if len(s) > 2 else []  # the seam of a closed curve
        axes.plot(np.insert(s, apart, np.nan), np.insert(p, apart, np.nan), color=PAIR_COLOURS[k % len(PAIR_COLOURS)], linewidth=1)
    figure.scientific(axes.yaxis, "contact pressure")
    axes.grid(color="0.9", linewidth=0.6)
    axes.set_title(f"p along {figure.short(curve)}, of its {len(numbers)} pairs", fontsize=9)
    axes.set_xlabel(f"arc length $s$ along {figure.short(curve)}")


def most_loaded(pairs):
    """Numbers of the pairs with the largest forces, in their order."""
    sizes = [np.linalg.norm(pair["force"]) for pair in pairs]
    return sorted(sorted(range(len(pairs)), key=lambda k: -sizes[k])[:SMALL])


def draw_small(panels, table, pairs, numbers):
    """p of the pairs with its bar, on one scale."""
    top = 1.05 * max((np.nan_to_num(table["p"][sides_of(table, k)[0]]).max() for k in numbers), default=0)
    for k, axes in zip(numbers, panels):
        on, s = line_of(table, sides_of(table, k)[0])
        p = table["p"][on]
        left, right = loaded_part(s, p)
        if "p_error" in table:
            bar = table["p_error"][on]
            axes.fill_between(s, p - bar, p + bar, color="0.82", linewidth=0)
        axes.plot(s, p, color=PAIR_COLOURS[0], linewidth=1.2)
        axes.set(xlim=(left, right) if right > left else None, ylim=(0, top) if top > 0 else None)
        axes.set_title(" \u2013\n".join(figure.short(name) for name in pairs[k]["between"]), fontsize=6.5)
        axes.tick_params(labelsize=6)
        axes.grid(color="0.9", linewidth=0.5)
        figure.scientific(axes.yaxis, "")
        axes.yaxis.get_label().set_fontsize(6)
    for axes in panels[len(numbers) :]:
        axes.set_visible(False)


def draw_runs(panels, runs, numbers, summary):
    """p of several runs, (name, summary, table), over each other along the lines of the first one's pairs; of a run that lies farther
    from there than its edges are long, as one of another geometry, over its own arc length."""
    for k, axes in zip(numbers, panels):
        between = set(summary["contact"][k]["between"])
        parts = []
        for number, (name, other, table) in enumerate(runs):
            same = [j for j, pair in enumerate(other["contact"]) if set(pair["between"]) == between]
            if not same:
                raise SystemExit(f"picture.py: {name} has no pair of {' and '.join(sorted(between))}")
            sides = {table["curve"][side][0]: side for side in sides_of(table, same[0])}
            curve = next(iter(sides)) if number == 0 else curve
            on, s = line_of(table, sides.get(curve, sides_of(table, same[0])[0]))
            xy, p = np.stack([table["x"][on], table["y"][on]], axis=1), table["p"][on]
            if number == 0:
                line, length = xy, s
            along, away = nearest_on(line, length, xy)
            if away.max() <= np.diff(s).max():
                s = along
            else:
                name += ", its own s"
            parts.append(loaded_part(s, p))
            order, colour = np.argsort(s), PAIR_COLOURS[number % len(PAIR_COLOURS)]
            if "p_error" in table:
                bar = table["p_error"][on]
                axes.fill_between(s[order], (p - bar)[order], (p + bar)[order], color=colour, alpha=0.18, linewidth=0)
            axes.plot(s[order], p[order], color=colour, linewidth=1.3, dashes=(None, None) if number == 0 else (5, 2), label=figure.short(name))
        axes.set_xlim(min(part[0] for part in parts), max(part[1] for part in parts))
        figure.scientific(axes.yaxis, "contact pressure")
        axes.set_xlabel("arc length $s$, " + " \u2013 ".join(map(figure.short, summary["contact"][k]["between"])))
        axes.grid(color="0.9", linewidth=0.6)
    panels[0].legend(frameon=False)
