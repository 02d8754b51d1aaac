"""The inf-sup constant: which multiplier spaces, elements, sides and stiffnesses the displacements control."""

import matplotlib.pyplot as plt

from atlas_regions import ELEMENTS, quote, region, solved

TITLE = "Inf-sup constant"
INTRODUCTION = (
    "How well the displacements control the pressure (theory, section 13): the inf-sup constant of parabola_1 for "
    "every multiplier space, five elements, multipliers on the coarser or the finer mesh, on sequences of meshes and "
    "for "
    "ratios of the elements up to 10; and for stiffnesses in ratios up to 1e6, with the multipliers on the finer "
    "mesh of "
    "the stiffer body, and where the program puts them."
)
CAPTION = (
    "Left: against the number of elements, 4:5. Middle: against the ratio of the meshes (20 elements on the "
    "coarser); right of "
    "1 the multipliers lie on the finer one. Right: against the ratio of the stiffnesses, 4-node and 8-node "
    "quadrilaterals 60:20. "
    "Dashed: the limit below which `mortise solve --diagnose` warns."
)
SPACES = {"linear": "-", "quadratic": "--", "dual": ":"}
SIZES = [10, 20, 40, 80, 160]
RATIOS = [1 / 10, 1 / 5, 1 / 2, 1, 2, 5, 10]  # of the multiplier side's elements to the other's
CONTRASTS = [1, 10, 100, 1e4, 1e6]  # upper body over lower
LIMIT = 0.1
YOUNG = 210e9


def constant(part, element, space, upper, lower, side, contrast=1.0, **axes):
    """A run; the upper body is `contrast` times as stiff as the lower one. `side` None: the program's choice."""
    settings = {f"mesh.parameters.{key}": value for key, value in ELEMENTS[element].items()}
    settings |= {"mesh.parameters.n_upper": upper, "mesh.parameters.n_lower": lower, "method.multipliers": space}
    settings |= {"materials.other": f"{{ young = {YOUNG * contrast!r}, poisson = 0.3 }}", "bodies.upper": "other"}
    if side:
        settings["contact.multipliers_on"] = f"{side}_contact"
    own = {"part": part, "element": element, "space": space, "upper": upper, "lower": lower, "side": side or "default"}
    return {
        "axes": {**own, "contrast": contrast, **axes},
        "scene": "parabola_1",
        "settings": settings,
        "arguments": ["--diagnose"],
        "measures": ["inf_sup"],
    }


def pairs():
    """Elements and the spaces that differ on them (quadratic multipliers on 2-node edges are linear)."""
    for element, parameters in ELEMENTS.items():
        for space in SPACES:
            if parameters["order"] == 2 or space != "quadratic":
                yield element, space


def runs(quick):
    sizes, ratios = (SIZES[:2], [1 / 5, 5]) if quick else (SIZES, RATIOS)
    contrasts = [1, 1e4] if quick else CONTRASTS
    listed = []
    for element, space in pairs():
        for side in ("upper", "lower"):
            listed += [constant("sizes", element, space, n, n * 5 // 4, side) for n in sizes]
        for ratio in ratios:
            mine, other = (round(20 * ratio), 20) if ratio >= 1 else (20, round(20 / ratio))
            listed.append(constant("ratios", element, space, mine, other, "upper", ratio=ratio))
    for element in ("4-node quadrilaterals", "8-node quadrilaterals"):
        for space in SPACES if element.startswith("8") else ("linear", "dual"):
            for contrast in contrasts:
                listed += [constant("contrasts", element, space, 60, 20, side, contrast) for side in ("upper", None)]
    return listed


def of(rows, **axes):
    return [row for row in rows if solved(row) and all(row.get(key) == value for key, value in axes.items())]


def line(axes, rows, x, colour, style, label):
    if rows:
        values = [row["inf_sup"] for row in rows]
        axes.plot([row[x] for row in rows], values, "o" + style, markersize=3, color=colour, label=label)


def draw(rows, path):
    figure, panels = plt.subplots(1, 3, figsize=(14, 4.8), layout="constrained", sharey=True)
    for number, element in enumerate(ELEMENTS):
        for space, style in SPACES.items():
            name = f"{element}, {space}"
            of_sizes = of(rows, part="sizes", element=element, space=space, side="lower")
            line(panels[0], of_sizes, "lower", f"C{number}", style, name)
            line(panels[1], of(rows, part="ratios", element=element, space=space), "ratio", f"C{number}", style, None)
            of_contrast = {"part": "contrasts", "element": element, "space": space}
            line(panels[2], of(rows, **of_contrast, side="upper"), "contrast", f"C{number}", style, None)
            for row in of(rows, **of_contrast, side="default"):
                panels[2].plot(row["contrast"], row["inf_sup"], "s", markersize=6, color=f"C{number}", fillstyle="none")
    labels = ("elements along the line", "elements: multiplier side / other side", "E upper / E lower")
    for axes, label in zip(panels, labels):
        axes.axhline(LIMIT, color="0.4", linestyle="--", linewidth=0.9)
        axes.set(xscale="log", yscale="log", xlabel=label)
        axes.grid(alpha=0.25)
    panels[0].set_ylabel(r"inf-sup constant $\beta_h$")
    panels[2].set_title("squares: the default side", fontsize=9)
    figure.legend(*panels[0].get_legend_handles_labels(), loc="lower center", ncol=5, fontsize=8, frameon=False)
    figure.get_layout_engine().set(rect=(0, 0.12, 1, 0.88))
    figure.savefig(path, dpi=85)
    plt.close(figure)


def mesh_region(rows):
    values = [row["inf_sup"] for row in of(rows, part="sizes") + of(rows, part="ratios")]
    falls = []
    for element, space in pairs():
        for side in ("upper", "lower"):
            found = of(rows, part="sizes", element=element, space=space, side=side)
            falls.append(found[-1]["inf_sup"] / found[0]["inf_sup"])
    why = (
        "Multipliers on the trace mesh of one body, of its own order or less, are controlled by that body alone, "
        "whatever the "
        "other's mesh (Wohlmuth 2000; Belgacem 1999). Quadratic and dual spaces have constants near a third of the "
        "linear "
        "one's on quadratic elements: their finest pressures swing from node to node, where the element feels least."
    )
    begins = (
        f"not found: between {min(values):.2f} and {max(values):.2f} on all meshes and ratios; from the coarsest to "
        f"the finest mesh "
        f"times {min(falls):.2f} to {max(falls):.2f}"
    )
    name = "Meshes, spaces and sides, bodies of one stiffness"
    return region(name, begins, None, "fixed", why, "Linear multipliers are the default.")


def contrast_region(rows):
    stiff = of(rows, part="contrasts", side="upper")
    low = [row for row in stiff if row["inf_sup"] < LIMIT]
    bound = min((row["contrast"] for row in low), default=None)
    default = min(row["inf_sup"] for row in of(rows, part="contrasts", side="default"))
    worst = max(stiff, key=lambda row: row["p_max_summary"])
    silent = [row for row in low if "inf-sup" not in row.get("warnings", "")]
    why = (
        "On the finer mesh of the stiffer body the finest pressures hardly move that body, and the coarser body "
        "cannot follow "
        "them: the constant falls as the root of the ratio of the stiffnesses (theory, eq. 41). The multipliers then "
        "force the "
        "soft body's coarse trace onto every fine node, and what no displacement resists is noise."
    )
    mortise = (
        f"The default puts the multipliers on the softer body beyond a ratio of 10 (smallest constant "
        f"{default:.2f}). Where the scene asks "
        f"for the other side, --diagnose says {quote(low)}. The warning of p against sigma_n comes there: the largest "
        f"p is "
        f"{worst['p_max_summary']:.1e} Pa where its mean is 1e7 ({worst['element']}, ratio {worst['contrast']:g})."
    )
    begins = f"below {LIMIT} from a ratio of {bound:g} of the stiffnesses (60:20)" if bound else "not reached"
    name = "Multipliers on the finer mesh of a much stiffer body"
    return region(name, begins, bound, "open" if silent else "default", why, mortise)


def regions(rows):
    return [mesh_region(rows), contrast_region(rows)]
