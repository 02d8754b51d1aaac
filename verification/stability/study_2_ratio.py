"""Mesh ratio and multiplier side: the error of p against the ratio of the two meshes, 1:20 to 20:1."""

import numpy as np

import figure
from failures import away, checks_of, draw_line, failure, of_scene, parameters, select, silent, told
from stability_runs import ESTIMATED_ERROR

RATIOS = [1, 1.5, 2, 3, 5, 10, 20]
END = 0.1  # of the length of a curve, left out at either end where a scene has corners there
COARSE = {"rings": 6, "parabola_1": 8}
CURVES = {"rings": ("n_inner", "n_outer", "inner_contact"), "parabola_1": ("n_upper", "n_lower", "upper_contact")}
NO_SEGMENTS = "linear, whole edges"
SPACES = {1: ["linear", "dual", NO_SEGMENTS], 2: ["linear", "quadratic", "dual", NO_SEGMENTS]}  # by order
CASES = [(scene, order, space) for scene in CURVES for order in SPACES for space in SPACES[order]]
MEASURES = {"rings": "rings", "parabola_1": "pressure"}
LIMITS = {"rings": 0.01, "parabola_1": 0.1}
REFERENCE = 96  # elements along the line of both bodies of the matching meshes that parabola_1 is held against
COLOURS = {"linear": "C0", "quadratic": "C1", "dual": "C2", NO_SEGMENTS: "C3"}


def run_of(scene, order, space, ratio, on_fine):
    """The first curve carries the multipliers; it has `ratio` times as many elements as the other, or as few."""
    coarse, fine = COARSE[scene], round(COARSE[scene] * ratio)
    first_name, second_name, curve = CURVES[scene]
    counts = dict(zip((first_name, second_name), (fine, coarse) if on_fine else (coarse, fine)))
    settings = {"contact.multipliers_on": curve, "method.multipliers": space.split(",")[0]}
    settings["method.integration"] = "elements" if space == NO_SEGMENTS else "segments"
    axes = {"scene": scene, "order": order, "space": space, "ratio": ratio if on_fine else 1 / ratio}
    return of_scene(axes, scene, settings | parameters(**counts, order=order), MEASURES[scene])


def runs(quick):
    sides = [(ratio, fine) for ratio in ([1, 10] if quick else RATIOS) for fine in (True, False) if ratio > 1 or fine]
    reference = run_of("parabola_1", 2, "linear", 1, True)
    reference["axes"]["space"] = "reference"
    reference["settings"] |= parameters(n_upper=REFERENCE, n_lower=REFERENCE)
    return [*(run_of(*case, *side) for case in CASES for side in sides), reference]


def complete(rows):
    """p_error of parabola_1: the largest |p - p of matching meshes| over the mean p, without END at either end."""
    (reference,) = (row["profile"] for row in rows if row["space"] == "reference")
    s_all, p_all = np.array(reference["s"]) / reference["s"][-1], np.array(reference["p"])
    for row in select(rows, scene="parabola_1"):
        if "profile" in row:
            s, p = np.array(row["profile"]["s"]) / row["profile"]["s"][-1], np.array(row["profile"]["p"])
            inside = (s > END) & (s < 1 - END)
            row["p_error"] = float(np.abs(p - np.interp(s, s_all, p_all))[inside].max() / p_all.mean())
    return [row for row in rows if row["space"] != "reference"]


def draw_panel(axes, rows, scene, order):
    for space in SPACES[order]:
        line, estimated = select(rows, scene=scene, order=order, space=space), lambda row: ESTIMATED_ERROR in row["failed_checks"]
        draw_line(axes, line, "ratio", "p_error", hollow=estimated, color=COLOURS[space], label=space)
    axes.axvline(1, color="0.8", linewidth=0.8, zorder=0)
    title = f"{scene}, {'linear' if order == 1 else 'quadratic'} quadrilaterals"
    figure.label(axes, title=title, log="xy", limit=LIMITS[scene])
    axes.set_xticks([0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20], ["1:20", "1:10", "1:5", "1:2", "1", "2", "5", "10", "20"])
    axes.minorticks_off()


def draw(rows, path):
    drawing, panels = figure.panels(2, 2, (10.5, 7), sharex=True)
    for line, scene in zip(panels, CURVES):
        for axes, order in zip(line, SPACES):
            draw_panel(axes, rows, scene, order)
        line[0].set_ylabel("largest relative error of p" if scene == "rings" else "largest |p - p matching| / mean p")
    for axes in panels[1]:
        axes.set_xlabel("elements on the multiplier side : on the opposite side")
    figure.legend_below(drawing, panels[0, 1], 4, 0.05)
    figure.save(drawing, path)


def bound_of(all_rows, side, **axes):
    """The row of the ratio nearest 1 at which p is off by more than the limit and more than twice as much as at 1:1."""
    (at_one,) = select(all_rows, **axes, ratio=1)
    limit = max(LIMITS[axes["scene"]], 2 * at_one["p_error"])
    return min((row for row in select(side, **axes) if row["p_error"] > limit), key=away, default=None)


def as_ratio(value):
    return f"{value:g}:1" if value >= 1 else f"1:{1 / value:g}"


def side_failure(rows, fine):
    side = [row for row in rows if (row["ratio"] > 1 if fine else row["ratio"] < 1) and row["space"] != NO_SEGMENTS]
    cases = [case for case in CASES if case[2] != NO_SEGMENTS]
    found = [bound_of(rows, side, scene=scene, order=order, space=space) for scene, order, space in cases]
    bad = [row for row in found if row]
    words = [
        f"{row['scene']}, {['linear', 'quadratic'][row['order'] - 1]} elements, {row['space']}: "
        f"{as_ratio(row['ratio'])} ({row['p_error']:.1%})"
        for row in bad
    ]
    begins = "; ".join(words) or "nowhere"
    bound, state, values = min(map(away, bad), default=None), told(bad), {"begins": begins, "checks": checks_of(side)}
    if fine:
        avoided = state == "open" and "quadratic elements" not in begins and (bound is None or bound > 1.5)
        state = "default" if avoided else state
        values["ratio"] = ratio = max(row["ratio"] for row in rows)
        for scene in CURVES:
            for name, value in (("fine", ratio), ("coarse", 1 / ratio)):
                (row,) = select(rows, scene=scene, order=2, ratio=value, space="linear")
                values[f"{scene}_{name}"] = row["p_error"]
    limits = {f"limit_{scene}": limit for scene, limit in LIMITS.items()}
    return failure(f"Multipliers on the {'finer' if fine else 'coarser'} side", bound, state, **limits, **values)


def segments_failure(rows):
    line = select(rows, space=NO_SEGMENTS, scene="rings")
    bad = [row for row in line if row["p_error"] > LIMITS["rings"]]
    nearest = min(bad, key=away, default=None)
    return failure(
        "Whole edges instead of segments",
        nearest and away(nearest),
        "default",
        ratio=nearest and as_ratio(nearest["ratio"]),
        error=nearest and nearest["p_error"],
        worst=max(row["p_error"] for row in line),
        limit=LIMITS["rings"],
        bad=len(bad),
        silent=len(silent(bad)),
    )


def failures(rows):
    return [side_failure(rows, True), side_failure(rows, False), segments_failure(rows)]
