"""Stiffness contrast: the mortar method's p and residuals, and the steps of every scheme of domain decomposition."""

import matplotlib.pyplot as plt

import launch
from atlas_regions import ends, first, largest, quote, region, solved

TITLE = "Stiffness contrast"
INTRODUCTION = (
    "Young's moduli of the two bodies in ratios of 1e-6 to 1e6. Mortar method: p of rings against Lamé (multipliers "
    "on either side, linear), of the flat patch test, and the residuals. Domain decomposition on parabola_1, 20x25: "
    "steps to 1e-8 of each scheme and acceleration, at most 300; Neumann-Dirichlet also with the roles the wrong "
    "way round (the stiffer body takes the displacement)."
)
CAPTION = (
    "Above: error of p and residual of the forces (mortar method), against the ratio. Below: steps of domain "
    "decomposition; crosses at the top: not converged in 300 steps, diverged, or refused."
)
RATIOS = [10.0**k for k in range(-6, 7)]
OUTER = 70e9
MOST = 300
ACCELERATIONS = ["none", "aitken", "anderson", "krylov"]
SCHEMES = {
    "Neumann-Dirichlet, default roles": ("neumann_dirichlet", False),
    "Neumann-Dirichlet, wrong roles": ("neumann_dirichlet", True),
    "Neumann-Neumann": ("neumann_neumann", False),
    "Dirichlet-Dirichlet": ("dirichlet_dirichlet", False),
}
ENOUGH = 1e-6  # a residual or an error of p that is called a loss
SIDES = ("inner_contact", "outer_contact")
COLOURS = {"none": "C3", "aitken": "C1", "anderson": "C0", "krylov": "C2"}


def rings(ratio, side):
    """The inner ring is `ratio` times as stiff as the outer one."""
    return {
        "axes": {"part": "rings", "ratio": ratio, "side": side},
        "scene": "rings",
        "settings": {
            "materials.stiff.young": OUTER * ratio,
            "materials.soft.young": OUTER,
            "contact.multipliers_on": side,
        },
        "materials": [(OUTER * ratio, 0.3), (OUTER, 0.3)],
        "measures": ["rings"],
    }


def patch(ratio, side):
    settings = {**launch.stiffness(ratio), "contact.multipliers_on": side}
    axes = {"part": "patch", "ratio": ratio, "side": side}
    return {"axes": axes, "scene": "patch_flat", "settings": settings, "measures": ["uniform"]}


def decomposed(ratio, scheme, acceleration):
    """parabola_1 with an upper body `ratio` times as stiff as the lower one, by domain decomposition."""
    kind, wrong = SCHEMES[scheme]
    settings = {
        **launch.sizes((20, 25)),
        **launch.stiffness(ratio),
        "method.solver": "ddm",
        "method.scheme": kind,
        "method.acceleration": acceleration,
        "method.max_iterations": MOST,
    }
    if wrong:
        settings["method.dirichlet"] = "upper" if ratio >= 1 else "lower"
    return {
        "axes": {"part": "ddm", "ratio": ratio, "scheme": scheme, "acceleration": acceleration},
        "scene": "parabola_1",
        "settings": settings,
        "measures": ["pressure"],
    }


def runs(quick):
    ratios = ends(RATIOS, 4) if quick else RATIOS
    mortar = [rings(ratio, side) for side in SIDES for ratio in ratios]
    mortar += [patch(ratio, side) for side in ("upper_contact", "lower_contact") for ratio in ratios]
    accelerations = ["none", "krylov"] if quick else ACCELERATIONS
    cases = [(scheme, acceleration) for scheme in SCHEMES for acceleration in accelerations]
    return mortar + [decomposed(ratio, *case) for case in cases for ratio in ratios]


def select(rows, **axes):
    return [row for row in rows if all(row.get(key) == value for key, value in axes.items())]


def converged(row):
    return row["outcome"] in ("solved", "check")


def draw_mortar(axes, rows, part, figure, sides):
    for side, marker in zip(sides, "os"):
        line = [row for row in select(rows, part=part, side=side) if solved(row)]
        axes.plot(
            [row["ratio"] for row in line],
            [row[figure] for row in line],
            marker + "-",
            fillstyle="none",
            label=f"{part}, on {side.split('_')[0]}",
        )


def draw_steps(axes, rows, scheme):
    for acceleration in ACCELERATIONS:
        line = select(rows, part="ddm", scheme=scheme, acceleration=acceleration)
        good = [row for row in line if converged(row)]
        colour = COLOURS[acceleration]
        axes.plot(
            [r["ratio"] for r in good],
            [r["interface_steps"] for r in good],
            "o-",
            color=colour,
            markersize=4,
            label=acceleration,
        )
        bad = [row["ratio"] for row in line if not converged(row)]
        axes.plot(bad, [MOST * (1.25 + 0.35 * ACCELERATIONS.index(acceleration))] * len(bad), "x", color=colour)
    axes.set(xscale="log", yscale="log", ylim=(1, MOST * 4), xlabel="$E_{upper}/E_{lower}$")
    axes.axhline(MOST, color="0.7", linewidth=0.8)
    axes.set_title(scheme, fontsize=10)
    axes.grid(alpha=0.25)


def draw(rows, path):
    figure = plt.figure(figsize=(13, 7.2), layout="constrained")
    grid = figure.add_gridspec(2, 4)
    left, right = figure.add_subplot(grid[0, :2]), figure.add_subplot(grid[0, 2:])
    draw_mortar(left, rows, "rings", "p_error", SIDES)
    draw_mortar(left, rows, "patch", "p_error", ("upper_contact", "lower_contact"))
    draw_mortar(right, rows, "rings", "force_residual", SIDES)
    draw_mortar(right, rows, "patch", "force_residual", ("upper_contact", "lower_contact"))
    left.set(
        xscale="log",
        yscale="log",
        ylabel="largest relative error of p",
        xlabel="$E_{inner}/E_{outer}$, $E_{upper}/E_{lower}$",
    )
    right.set(
        xscale="log",
        yscale="log",
        ylabel="residual of the forces",
        xlabel="$E_{inner}/E_{outer}$, $E_{upper}/E_{lower}$",
    )
    right.axhline(1e-10, color="0.4", linestyle="--", linewidth=0.9)
    right.text(1e-6, 3e-11, "limit of the check", fontsize=8, color="0.3")
    for axes in (left, right):
        axes.grid(alpha=0.25)
        axes.legend(fontsize=8, ncol=2)
    for column, scheme in enumerate(SCHEMES):
        axes = figure.add_subplot(grid[1, column])
        draw_steps(axes, rows, scheme)
        if column == 0:
            axes.set_ylabel("steps to 1e-8")
            axes.legend(fontsize=8, loc="upper right")
    figure.savefig(path, dpi=85)
    plt.close(figure)


def mortar_region(rows):
    line = [row for row in rows if row["part"] != "ddm" and solved(row)]
    bound = first(
        [{**row, "away": max(row["ratio"], 1 / row["ratio"])} for row in line],
        "away",
        lambda row: row["p_error"] > ENOUGH * 100,
    )
    patch_worst = largest([row for row in line if row["part"] == "patch"], "p_error")
    rings_worst = largest([row for row in line if row["part"] == "rings"], "p_error")
    residual = largest(line, "force_residual")
    begins = (
        f"not found from 1e-6 to 1e6: p is off by at most {patch_worst:.0e} (patch) and {rings_worst:.0e} (rings, "
        f"12:16, the error of the mesh); residual of the forces at most {residual:.0e} (limit 1e-10)"
    )
    why = (
        "The condition of the system grows with the ratio of the moduli, and iterative or unscaled solvers lose "
        "digits with it (Benzi, Golub & Liesen 2005, section 3.5). With quadratic elements in a ratio of 3:4 each "
        "side's "
        "trace can follow the other's multipliers; where it cannot, see study 1."
    )
    mortise = "One direct solve of a dimensionless system (theory, sections 5 and 6), with either side."
    return region("Mortar method", begins, bound, "fixed" if bound is None else "shown", why, mortise)


def fails_from(rows, scheme, acceleration, above):
    """The ratio, on the way from 1 up or down, from which runs fail: None if none does."""
    line = [
        {**row, "away": row["ratio"] if above else 1 / row["ratio"]}
        for row in select(rows, part="ddm", scheme=scheme, acceleration=acceleration)
        if (row["ratio"] >= 1 if above else row["ratio"] <= 1)
    ]
    return first(line, "away", lambda row: not converged(row) or "residual of the contact" in row["failed_checks"])


def default_region(rows):
    line = [row for row in rows if row["part"] == "ddm" and "wrong" not in row["scheme"]]
    bad = [row for row in line if not converged(row)]
    default = [
        row["interface_steps"] for row in select(line, scheme="Neumann-Dirichlet, default roles", acceleration="krylov")
    ]
    worst = max(row["interface_steps"] for row in line if converged(row))
    begins = (
        f"{len(bad)} of {len(line)} runs fail; at most {worst} steps with any acceleration, {max(default)} with the "
        "default one"
    )
    why = (
        "The steps depend on the largest eigenvalue of I + C_D^-1 C_N, which grows with the stiffness of the body "
        "that takes the displacement over that of the other (Toselli & Widlund 2005, section 1.3.3; theory, eq. "
        "33). With the displacement on the softer body it stays of the size of 1; Neumann-Neumann and "
        "Dirichlet-Dirichlet weigh the two bodies by their compliances to the same end."
    )
    mortise = "By default the softer bodies take the displacement (method.dirichlet)."
    bound = min((max(row["ratio"], 1 / row["ratio"]) for row in bad), default=None)
    return region("Domain decomposition, default roles", begins, bound, "default", why, mortise)


def wrong_region(rows):
    scheme, found, bounds = "Neumann-Dirichlet, wrong roles", [], []
    for acceleration in ACCELERATIONS:
        up, down = fails_from(rows, scheme, acceleration, True), fails_from(rows, scheme, acceleration, False)
        bounds += [value for value in (up, down) if value]
        text = lambda value: f"{value:g}" if value else "none"
        if select(rows, part="ddm", scheme=scheme, acceleration=acceleration):
            found.append(f"{acceleration}: {text(up)} (upper stiffer), {text(down)} (lower stiffer)")
    why = (
        "With the displacement on the stiffer body the eigenvalues spread over 1 ... E_stiff / E_soft, and beta "
        "below 2 / mu_max makes steps of 1 - beta on the modes near 1: as many steps as the ratio (Toselli & "
        "Widlund 2005, section 1.3.3). Anderson's and Krylov's methods need as many steps as there are clusters of "
        "eigenvalues, until rounding in residuals that the large eigenvalues magnify ends it (Greenbaum 1997, "
        "chapter 4)."
    )
    mortise = "Status not_converged, with the eigenvalues and the beta that would converge: " + quote(
        rows, lambda row: row["outcome"] == "not converged"
    )
    begins = "ratio of the moduli at which 300 steps do not reach 1e-8 - " + "; ".join(found)
    return region(
        "Domain decomposition, stiffer body takes the displacement",
        begins,
        min(bounds, default=None),
        "shown",
        why,
        mortise,
    )


def regions(rows):
    return [mortar_region(rows), default_region(rows), wrong_region(rows)]
