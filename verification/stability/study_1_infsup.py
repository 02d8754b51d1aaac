"""The inf-sup constant: which multiplier spaces, elements, sides and stiffnesses the displacements control."""

import figure
import launch
from failures import ELEMENTS, SPACES, draw_line, failure, of_scene, parameters, quote, select, solved

STYLES = dict(zip(SPACES, ("-", "--", ":")))
SIZES = [10, 20, 40, 80, 160]
RATIOS = [1 / 10, 1 / 5, 1 / 2, 1, 2, 5, 10]  # of the multiplier side's elements to the other's
CONTRASTS = [1, 10, 100, 1e4, 1e6]  # upper body over lower
LIMIT = 0.1
# Quadratic multipliers on 2-node edges are linear.
PAIRS = [(e, space) for e in ELEMENTS for space in SPACES if ELEMENTS[e]["order"] == 2 or space != "quadratic"]


def constant(part, element, space, upper, lower, side, contrast=1.0, **axes):
    """A run; the upper body is `contrast` times as stiff as the lower one. `side` None: the program's choice."""
    settings = {**parameters(**ELEMENTS[element]), **launch.sizes((upper, lower)), "method.multipliers": space}
    settings |= launch.stiffness(contrast)
    if side:
        settings["contact.multipliers_on"] = f"{side}_contact"
    own = {"part": part, "element": element, "space": space, "upper": upper, "lower": lower, "side": side or "default"}
    own |= {"contrast": contrast, **axes}
    return of_scene(own, "parabola_1", settings, "inf_sup", arguments=["--diagnose"])


def runs(quick):
    sizes, ratios = (SIZES[:2], [1 / 5, 5]) if quick else (SIZES, RATIOS)
    listed = []
    for element, space in PAIRS:
        for side in ("upper", "lower"):
            listed += [constant("sizes", element, space, n, n * 5 // 4, side) for n in sizes]
        for ratio in ratios:
            mine, other = (round(20 * ratio), 20) if ratio >= 1 else (20, round(20 / ratio))
            listed.append(constant("ratios", element, space, mine, other, "upper", ratio=ratio))
    for element, space in PAIRS:
        if element in ("4-node quadrilaterals", "8-node quadrilaterals"):
            for contrast in [1, 1e4] if quick else CONTRASTS:
                listed += [constant("contrasts", element, space, 60, 20, side, contrast) for side in ("upper", None)]
    return listed


def draw(rows, path):
    drawing, panels = figure.panels(1, 3, (14, 4.8), sharey=True)
    lines = [  # along which axis, and of which rows
        ("lower", {"part": "sizes", "side": "lower"}),
        ("ratio", {"part": "ratios"}),
        ("contrast", {"part": "contrasts", "side": "upper"}),
    ]
    for element, space in PAIRS:
        for axes, (x, axes_of) in zip(panels, lines):
            style = {"color": f"C{list(ELEMENTS).index(element)}", "markersize": 3, "label": f"{element}, {space}"}
            if line := select(rows, element=element, space=space, **axes_of):
                draw_line(axes, line, x, "inf_sup", "o" + STYLES[space], **style)
        for row in select(rows, part="contrasts", side="default", element=element, space=space):
            panels[2].plot(row["contrast"], row["inf_sup"], "s", markersize=6, color=style["color"], fillstyle="none")
    labels = ("elements along the line", "elements: multiplier side / other side", "E upper / E lower")
    for axes, label in zip(panels, labels):
        figure.label(axes, label, log="xy", limit=LIMIT)
    panels[0].set_ylabel(r"inf-sup constant $\beta_h$")
    panels[2].set_title("squares: the default side", fontsize=9)
    figure.legend_below(drawing, panels[0], 5, 0.12)
    figure.save(drawing, path)


def mesh_failure(rows):
    values = [row["inf_sup"] for row in rows if row["part"] != "contrasts"]
    falls = []
    for element, space in PAIRS:
        for side in ("upper", "lower"):
            found = select(rows, part="sizes", element=element, space=space, side=side)
            falls.append(found[-1]["inf_sup"] / found[0]["inf_sup"])
    limits = {"least": min(values), "most": max(values), "fall": min(falls), "rise": max(falls)}
    return failure("Meshes, spaces and sides, bodies of one stiffness", None, "fixed", **limits)


def contrast_failure(rows):
    stiff = select(rows, part="contrasts", side="upper")
    low = [row for row in stiff if row["inf_sup"] < LIMIT]
    worst = max(stiff, key=lambda row: row["p_max_summary"])
    return failure(
        "Multipliers on the finer mesh of a much stiffer body",
        min((row["contrast"] for row in low), default=None),
        "default" if all("inf-sup" in row["warnings"] for row in low) else "open",
        limit=LIMIT,
        default=min(row["inf_sup"] for row in select(rows, part="contrasts", side="default")),
        said=quote(low, warning="inf-sup"),
        estimated=worst["p_estimated"],
        p=worst["p_max_summary"],
        element=worst["element"],
        ratio=worst["contrast"],
    )


def failures(rows):
    rows = [row for row in rows if solved(row)]
    return [mesh_failure(rows), contrast_failure(rows)]
