"""Mesh ratio and multiplier side: the error and the swing of p against the ratio of the two meshes, 1:20 to 20:1."""

import matplotlib.pyplot as plt
import numpy as np

from atlas_measures import END
from atlas_regions import checks_of, region, solved, told

TITLE = "Mesh ratio and multiplier side"
INTRODUCTION = (
    "Two meshes whose elements differ in length by a ratio of up to 20, multipliers on either, three multiplier "
    "spaces, linear and 8-node quadrilaterals. Rings: p against the exact constant pressure (Lamé). parabola_1: p "
    "against that of matching meshes, 96x96, without a tenth of the length at either end. The coarser mesh always "
    "has 6 elements along the line in the rings and 8 in parabola_1, so that the error at 1:1 is that of the coarse "
    "mesh itself."
)
CAPTION = (
    "Left of 1 the multipliers are on the coarser mesh, right of 1 on the finer one; the colours are the multiplier "
    "spaces. The dashed lines are 1 % and 10 %. Open symbols: mortise warns that p and the bodies' stress differ "
    "by more than 10 %. Whole edges instead of segments do no harm where the finer side has the multipliers and none of its "
    "edges crosses a vertex."
)
RATIOS = [1, 1.5, 2, 3, 5, 10, 20]
COARSE = {"rings": 6, "parabola_1": 8}
CURVES = {
    "rings": ("mesh.parameters.n_inner", "mesh.parameters.n_outer", "inner_contact"),
    "parabola_1": ("mesh.parameters.n_upper", "mesh.parameters.n_lower", "upper_contact"),
}
NO_SEGMENTS = "linear, whole edges"
SPACES = {1: ["linear", "dual", NO_SEGMENTS], 2: ["linear", "quadratic", "dual", NO_SEGMENTS]}
MEASURES = {"rings": ["rings", "swing"], "parabola_1": ["pressure", "swing"]}
LIMITS = {"rings": 0.01, "parabola_1": 0.1}
LIMIT = LIMITS["rings"]
REFERENCE = 96  # elements along the line of both bodies of the matching meshes that parabola_1 is held against
COLOURS = {"linear": "C0", "quadratic": "C1", "dual": "C2", NO_SEGMENTS: "C3"}


def run_of(scene, order, space, ratio, on_fine):
    """The first curve carries the multipliers; it has `ratio` times as many elements as the other, or as few."""
    coarse, fine = COARSE[scene], round(COARSE[scene] * ratio)
    multiplier_count, opposite_count = (fine, coarse) if on_fine else (coarse, fine)
    first, second, curve = CURVES[scene]
    return {
        "axes": {"scene": scene, "order": order, "space": space, "ratio": ratio if on_fine else 1 / ratio},
        "scene": scene,
        "settings": {
            first: multiplier_count,
            second: opposite_count,
            "mesh.parameters.order": order,
            "contact.multipliers_on": curve,
            "method.multipliers": space.split(",")[0],
            "method.integration": "elements" if space == NO_SEGMENTS else "segments",
        },
        "measures": MEASURES[scene],
    }


def runs(quick):
    ratios = [1, 10] if quick else RATIOS
    cases = [(scene, order, space) for scene in CURVES for order in SPACES for space in SPACES[order]]
    sides = [(ratio, on_fine) for ratio in ratios for on_fine in (True, False) if ratio > 1 or on_fine]
    reference = run_of("parabola_1", 2, "linear", 1, True)
    reference["axes"]["space"] = "reference"
    for key in CURVES["parabola_1"][:2]:
        reference["settings"][key] = REFERENCE
    return [*(run_of(*case, *side) for case in cases for side in sides), reference]


def select(rows, **axes):
    return sorted((row for row in rows if all(row[k] == v for k, v in axes.items())), key=lambda row: row["ratio"])


def figure_of(row):
    return row.get("p_error")


def draw_panel(axes, rows, scene, order):
    for space in SPACES[order]:
        line = [row for row in select(rows, scene=scene, order=order, space=space) if solved(row)]
        ratios, values = [row["ratio"] for row in line], [figure_of(row) for row in line]
        axes.plot(ratios, values, "-", color=COLOURS[space], label=space)
        for row in line:
            fill = "none" if "sigma_n" in row["failed_checks"] else COLOURS[space]
            axes.plot(row["ratio"], figure_of(row), "o", color=COLOURS[space], markerfacecolor=fill, markersize=5)
    axes.axhline(LIMITS[scene], color="0.4", linestyle="--", linewidth=0.9)
    axes.axvline(1, color="0.8", linewidth=0.8, zorder=0)
    axes.set(xscale="log", yscale="log")
    axes.set_title(f"{scene}, {'linear' if order == 1 else 'quadratic'} quadrilaterals", fontsize=10)
    axes.set_xticks([0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20], ["1:20", "1:10", "1:5", "1:2", "1", "2", "5", "10", "20"])
    axes.minorticks_off()
    axes.grid(alpha=0.25)


def draw(rows, path):
    figure, panels = plt.subplots(2, 2, figsize=(10.5, 7), sharex=True, layout="constrained")
    for line, scene in zip(panels, CURVES):
        for axes, order in zip(line, SPACES):
            draw_panel(axes, rows, scene, order)
        name = "largest relative error of p" if scene == "rings" else "largest |p - p matching| / mean p"
        line[0].set_ylabel(name)
    for axes in panels[1]:
        axes.set_xlabel("elements on the multiplier side : on the opposite side")
    figure.legend(*panels[0, 1].get_legend_handles_labels(), loc="lower center", ncol=4, frameon=False, fontsize=9)
    figure.get_layout_engine().set(rect=(0, 0.05, 1, 0.95))
    figure.savefig(path, dpi=85)
    plt.close(figure)


def bound_of(all_rows, side, **axes):
    """The row of the ratio nearest 1 at which p is off by more than the limit and more than twice as much as at 1:1."""
    (at_one,) = [figure_of(row) for row in select(all_rows, **axes) if row["ratio"] == 1]
    limit = max(LIMITS[axes["scene"]], 2 * at_one)
    over = [row for row in select(side, **axes) if figure_of(row) > limit]
    over.sort(key=lambda row: max(row["ratio"], 1 / row["ratio"]))
    return over[0] if over else None


def as_ratio(value):
    return f"{value:g}:1" if value >= 1 else f"1:{1 / value:g}"


def side_rows(rows, fine):
    return [row for row in rows if (row["ratio"] > 1 if fine else row["ratio"] < 1) and row["space"] != NO_SEGMENTS]


def side_region(rows, fine):
    words, bounds, bad = [], [], []
    for scene in CURVES:
        for order in SPACES:
            for space in SPACES[order]:
                if space == NO_SEGMENTS:
                    continue
                row = bound_of(rows, side_rows(rows, fine), scene=scene, order=order, space=space)
                if row:
                    words.append(
                        f"{scene}, {['linear', 'quadratic'][order - 1]} elements, {space}: {as_ratio(row['ratio'])} "
                        f"({figure_of(row):.1%})"
                    )
                    bad.append(row)
                    bounds.append(max(row["ratio"], 1 / row["ratio"]))
    limits = f"{LIMITS['rings']:.0%} (rings) or {LIMITS['parabola_1']:.0%} (parabola_1)"
    begins = f"p off by more than {limits}, and twice as much as at 1:1: " + ("; ".join(words) or "nowhere")
    return begins, min(bounds, default=None), told(bad) if bad else "fixed"


def worst_at(rows, scene, order, ratio):
    values = [figure_of(row) for row in select(rows, scene=scene, order=order, ratio=ratio, space="linear")]
    return values[0] if values else None


def fine_region(rows):
    begins, bound, state = side_region(rows, True)
    ratio = max(row["ratio"] for row in rows)
    fine, coarse = worst_at(rows, "rings", 2, ratio), worst_at(rows, "rings", 2, 1 / ratio)
    why = (
        "The multipliers of a finer side follow the facets of the coarser one: p takes the shape of the coarse "
        "mesh's error of the curve, though it stays stable (the inf-sup constant of mortar spaces does not depend "
        "on the ratio: Wohlmuth 2000; Belgacem 1999)."
    )
    parabola = [worst_at(rows, "parabola_1", 2, value) for value in (ratio, 1 / ratio)]
    mortise = (
        "The default is the side with the shorter edges, for scenes that are not smooth (theory, section 9), but of "
        "linear "
        "elements the side with the longer ones beyond a ratio of 1.5. With 8-node "
        f"quadrilaterals and linear multipliers at {ratio:g}:1 p is off by {fine:.1e} in rings ({coarse:.1e} with the "
        f"multipliers on the coarser side), by {parabola[0]:.1e} in parabola_1 ({parabola[1]:.1e}). Checks that fail: "
        f"{checks_of(side_rows(rows, True))}."
    )
    avoided = state == "open" and "quadratic elements" not in begins and (bound is None or bound > 1.5)
    return region("Multipliers on the finer side", begins, bound, "default" if avoided else state, why, mortise)


def coarse_region(rows):
    begins, bound, state = side_region(rows, False)
    why = (
        "Few multipliers see a mean of what happens between them: p cannot vary within an edge of the coarse side "
        "(best approximation, Bernardi, Maday & Patera 1994), but the finer mesh does not disturb it."
    )
    mortise = f"contact.multipliers_on chooses the side. Checks that fail: {checks_of(side_rows(rows, False))}."
    return region("Multipliers on the coarser side", begins, bound, state, why, mortise)


def segments_region(rows):
    line = [row for row in rows if row["space"] == NO_SEGMENTS and row["scene"] == "rings"]
    over = sorted((row for row in line if figure_of(row) > LIMIT), key=lambda row: max(row["ratio"], 1 / row["ratio"]))
    worst = max(figure_of(row) for row in line)
    bound = max(over[0]["ratio"], 1 / over[0]["ratio"]) if over else None
    begins = (
        f"rings: {as_ratio(over[0]['ratio'])} ({figure_of(over[0]):.1%}); at worst {worst:.1%}"
        if over
        else f"rings: p off by {worst:.1%} at most"
    )
    why = (
        "Gauss points on whole edges integrate across the vertices of the other side, where its shape functions "
        "have kinks: the weights of the two sides do not match and the patch test is lost (Farah, Popp & Wall 2015; "
        "Puso & Laursen 2004)."
    )
    mortise = (
        "method.integration = \"segments\" is the default: edges are cut at the vertices of both meshes. With "
        "\"elements\" nothing is said."
    )
    return region("Whole edges instead of segments", begins, bound, "default", why, mortise)


def regions(rows):
    return [fine_region(rows), coarse_region(rows), segments_region(rows)]


def complete(rows):
    """p_error of parabola_1: the largest |p - p of matching meshes| over the mean p, without END at either end."""
    (reference,) = (row["profile"] for row in rows if row["space"] == "reference")
    s_all, p_all = np.array(reference["s"]) / reference["s"][-1], np.array(reference["p"])
    for row in rows:
        if row["scene"] == "parabola_1" and "profile" in row:
            s, p = np.array(row["profile"]["s"]) / row["profile"]["s"][-1], np.array(row["profile"]["p"])
            inside = (s > END) & (s < 1 - END)
            row["p_error"] = float(np.abs(p - np.interp(s, s_all, p_all))[inside].max() / p_all.mean())
    return [row for row in rows if row["space"] != "reference"]
