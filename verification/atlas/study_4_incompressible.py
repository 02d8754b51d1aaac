"""Near incompressibility: which elements lock, and what it does to the contact pressure (plane strain)."""

import matplotlib.pyplot as plt

from atlas_regions import ELEMENTS, checks_of, ends, first, largest, quote, region, say, solved, told

TITLE = "Near incompressibility (plane strain)"
INTRODUCTION = (
    "Poisson's ratio of both rings from 0.3 to 0.499999, five elements, two meshes (12:16 and 24:32 elements along "
    "the arcs): displacement and contact pressure against Lamé, and the mean stress at the elements' centres, which "
    "is constant in each ring. The flat patch test with the same values."
)
CAPTION = (
    "Errors against 1 - 2 nu. Full lines 12:16, dashed 24:32. The mean stress is that at the centres of the "
    "elements, root of the mean square of its error over the contact pressure."
)
POISSON = [0.3, 0.4, 0.45, 0.49, 0.499, 0.4999, 0.49999, 0.499999]
MESHES = [(12, 16), (24, 32)]
YOUNG = (210e9, 70e9)
LIMIT = 0.1
COMPARED = 0.49  # of the quick atlas too


def settings_of(element):
    return {f"mesh.parameters.{key}": value for key, value in ELEMENTS[element].items()}


def rings(element, poisson, mesh):
    return {
        "axes": {"scene": "rings", "element": element, "poisson": poisson, "mesh": mesh[0]},
        "scene": "rings",
        "settings": {
            **settings_of(element),
            "mesh.parameters.n_inner": mesh[0],
            "mesh.parameters.n_outer": mesh[1],
            "materials.stiff.poisson": poisson,
            "materials.soft.poisson": poisson,
        },
        "materials": [(young, poisson) for young in YOUNG],
        "measures": ["rings", "rings_fields"],
    }


def patch(element, poisson):
    settings = {**settings_of(element), "materials.steel.poisson": poisson}
    axes = {"scene": "patch_flat", "element": element, "poisson": poisson, "mesh": 7}
    return {"axes": axes, "scene": "patch_flat", "settings": settings, "measures": ["uniform"]}


def runs(quick):
    values = ends(POISSON, 3) if quick else POISSON
    listed = [
        rings(element, poisson, mesh)
        for mesh in (MESHES[:1] if quick else MESHES)
        for element in ELEMENTS
        for poisson in values
    ]
    return listed + [patch(element, poisson) for element in ELEMENTS for poisson in values]


def line_of(rows, scene, element, mesh):
    return [row for row in rows if (row["scene"], row["element"], row["mesh"]) == (scene, element, mesh)]


def draw(rows, path):
    figures = {
        "u_error": "largest error of u / largest u",
        "p_error": "largest relative error of p",
        "mean_stress_error": "error of the mean stress / p",
    }
    figure, panels = plt.subplots(1, 3, figsize=(13, 4.6), layout="constrained")
    for axes, (key, label) in zip(panels, figures.items()):
        for number, element in enumerate(ELEMENTS):
            for mesh, style in zip(MESHES, ("-", "--")):
                line = [row for row in line_of(rows, "rings", element, mesh[0]) if solved(row)]
                x = [1 - 2 * row["poisson"] for row in line]
                name = element if style == "-" else None
                axes.plot(x, [row[key] for row in line], "o" + style, markersize=3.5, color=f"C{number}", label=name)
        axes.axhline(LIMIT, color="0.4", linestyle=":", linewidth=0.9)
        axes.set(xscale="log", yscale="log", xlabel=r"$1 - 2\nu$", ylabel=label)
        axes.invert_xaxis()
        axes.grid(alpha=0.25)
    panels[0].legend(fontsize=8, loc="lower right")
    figure.savefig(path, dpi=85)
    plt.close(figure)


def off(rows, row, key, limit):
    """True if a figure exceeds the limit, and twice what the mesh has without any locking, at nu = 0.3."""
    line = line_of(rows, "rings", row["element"], row["mesh"])
    mesh = next(other for other in line if other["poisson"] == POISSON[0])
    return row[key] > max(limit, 2 * mesh[key])


def bound_of(rows, element, key, limit):
    """The first nu at which a figure is off on the coarse mesh, and its value there."""
    line = [row for row in line_of(rows, "rings", element, MESHES[0][0]) if solved(row)]
    bound = first(line, "poisson", lambda row: off(rows, row, key, limit))
    return bound, next((row[key] for row in line if row["poisson"] == bound), None)


def listed(rows, key, limit):
    """For each element the nu at which a figure exceeds the limit, as words, and the least."""
    bounds = {element: bound_of(rows, element, key, limit) for element in ELEMENTS}
    at = lambda bound, value: f"{bound:g} ({value:.1%})" if bound else "none"
    words = [f"{element} {at(*pair)}" for element, pair in bounds.items()]
    return "; ".join(words), min((bound for bound, _ in bounds.values() if bound), default=None)


def displacement_region(rows):
    words, bound = listed(rows, "u_error", LIMIT)
    bad = [row for row in rows if row["scene"] == "rings" and solved(row) and off(rows, row, "u_error", LIMIT)]
    silent = [row for row in bad if row["outcome"] == "solved" and not row["warning_count"]]
    why = (
        "With nu near 0.5 each quadrature point demands a constant area; where these demands are more than the "
        "displacements can follow, the element stiffens (volumetric locking; Hughes, The Finite Element Method, "
        "chapter 4). 6-node triangles have the most freedom for each demand (3 points); 8- and 9-node "
        "quadrilaterals with 3 x 3 points and both linear elements do not have enough."
    )
    warned = quote([row for row in rows if row.get("warning_count")])
    mortise = (
        f"mortise integrates the stiffness fully and has no mixed elements. It says {warned}; {len(silent)} of these "
        f"runs end as solved with an error above {LIMIT:.0%}."
    )
    begins = f"nu at which u is off by more than {LIMIT:.0%} and twice what it is at 0.3 (12:16) - {words}"
    return region("Locking: displacements too small", begins, bound, told(bad), why, mortise)


def pressure_region(rows):
    words, bound = listed(rows, "p_error", 0.01)
    why = (
        "The contact pressure is a multiplier, in balance with the load; of what the bodies do it feels only how "
        "the load is shared. That is wrong where the bodies lock to a different degree, and where the stiffened "
        "mesh follows the line badly."
    )
    fails = [row for row in rows if row["scene"] == "rings" and "sigma_n" in row["failed_checks"]]
    mortise = f"The warning of p against sigma_n comes in {len(fails)} of the runs on rings."
    bad = [row for row in rows if row["scene"] == "rings" and solved(row) and off(rows, row, "p_error", 0.01)]
    begins = f"nu at which p is off by more than 1 % and twice what it is at 0.3 (12:16) - {words}"
    return region("Contact pressure", begins, bound, told(bad), why, mortise)


def at_nodes_of(rows, element, poisson):
    """Errors of the mean stress on the coarse mesh, at the centres and at the nodes."""
    line = [row for row in line_of(rows, "rings", element, MESHES[0][0]) if row["poisson"] == poisson]
    return line[0]["mean_stress_error"], line[0]["nodal_mean_stress_error"]


def stress_region(rows):
    words, bound = listed(rows, "mean_stress_error", LIMIT)
    why = (
        "The mean stress is E / (3 (1 - 2 nu)) times the change of volume, so an error of that change is magnified "
        "by 1 / (1 - 2 nu) (Hughes, chapter 4): stress_centre swings from element to element long before u is off."
    )
    rings = [row for row in rows if row["scene"] == "rings" and solved(row)]
    bad = [row for row in rings if off(rows, row, "mean_stress_error", LIMIT)]
    unsaid = [row for row in bad if row["outcome"] == "solved" and not row["warning_count"]]
    mortise = (
        f"{len(unsaid)} of the {len(bad)} runs beyond that end as solved without a warning: p and sigma_n at the "
        "contact agree to 10 % still."
    )
    at_centre, at_nodes = at_nodes_of(rows, "8-node quadrilaterals", COMPARED)
    mortise += (
        f" The nodal stresses of 8-node quadrilaterals are sampled where the error is small (theory, eq. 20): at nu = "
        f"{COMPARED} (12:16) their mean is off by {at_nodes:.2g} p, that of stress_centre by {at_centre:.2g} p."
    )
    begins = f"nu at which it is off by {LIMIT:.0%} of p and twice what it is at 0.3 (12:16) - {words}"
    return region("Mean stress in the bodies", begins, bound, told(bad), why, mortise)


def patch_region(rows):
    line = [row for row in rows if row["scene"] == "patch_flat" and solved(row)]
    bound = first(line, "poisson", lambda row: "residual" in row["failed_checks"])
    worst = largest(line, "p_error")
    why = (
        "A uniform stress is in the space of every element, so locking does not touch it; what remains is rounding, "
        "magnified by the condition of K, which grows as 1 / (1 - 2 nu) (Golub & Van Loan, section 2.7)."
    )
    mortise = f"Checks that fail: {checks_of(line)}."
    begins = (
        f"p off by {worst:.0e} at most; the residual's limit of 1e-10 is passed from nu = {say(bound)}"
        if bound
        else f"p off by {worst:.0e} at most"
    )
    return region("Rounding", begins, bound, "shown", why, mortise)


def regions(rows):
    return [displacement_region(rows), pressure_region(rows), stress_region(rows), patch_region(rows)]
