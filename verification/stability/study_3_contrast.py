"""Stiffness contrast: the mortar method's p and residuals, and the steps of every scheme of domain decomposition."""

import figure
import launch
from failures import away, draw_line, ends, failure, first, largest, of_scene, quote, select, solved

RATIOS = [10.0**k for k in range(-6, 7)]
OUTER = 70e9
MOST = 300
ACCELERATIONS = {"none": "C3", "aitken": "C1", "anderson": "C0", "krylov": "C2"}
SCHEMES = {  # the scheme, and whether the stiffer body takes the displacement
    "Neumann-Dirichlet, default roles": ("neumann_dirichlet", False),
    "Neumann-Dirichlet, wrong roles": ("neumann_dirichlet", True),
    "Neumann-Neumann": ("neumann_neumann", False),
    "Dirichlet-Dirichlet": ("dirichlet_dirichlet", False),
}
LOST = 1e-4  # an error of p that is called a loss
SIDES = {"rings": ("inner_contact", "outer_contact"), "patch": ("upper_contact", "lower_contact")}


def rings(ratio, side):
    """The inner ring is `ratio` times as stiff as the outer one."""
    settings = {"materials.stiff.young": OUTER * ratio, "materials.soft.young": OUTER, "contact.multipliers_on": side}
    materials = [(OUTER * ratio, 0.3), (OUTER, 0.3)]
    return of_scene({"part": "rings", "ratio": ratio, "side": side}, "rings", settings, "rings", materials=materials)


def patch(ratio, side):
    settings = {**launch.stiffness(ratio), "contact.multipliers_on": side}
    return of_scene({"part": "patch", "ratio": ratio, "side": side}, "patch_flat", settings, "uniform")


def decomposed(ratio, scheme, acceleration):
    """parabola_1 with an upper body `ratio` times as stiff as the lower one, by domain decomposition."""
    kind, wrong = SCHEMES[scheme]
    method = {"solver": "ddm", "scheme": kind, "acceleration": acceleration, "max_iterations": MOST}
    settings = launch.sizes((20, 25)) | launch.stiffness(ratio) | {f"method.{key}": value for key, value in method.items()}
    if wrong:
        settings["method.dirichlet"] = "upper" if ratio >= 1 else "lower"
    axes = {"part": "ddm", "ratio": ratio, "scheme": scheme, "acceleration": acceleration}
    return of_scene(axes, "parabola_1", settings, "pressure")


def runs(quick):
    ratios = ends(RATIOS, 4) if quick else RATIOS
    mortar = [make(ratio, side) for make in (rings, patch) for side in SIDES[make.__name__] for ratio in ratios]
    cases = [(scheme, name) for scheme in SCHEMES for name in (["none", "krylov"] if quick else ACCELERATIONS)]
    return mortar + [decomposed(ratio, *case) for case in cases for ratio in ratios]


def converged(row):
    return row["outcome"] in ("solved", "check")


def draw_mortar(axes, rows, key):
    for part, sides in SIDES.items():
        for side, marker in zip(sides, "os"):
            style = {"fillstyle": "none", "label": f"{part}, on {side.split('_')[0]}"}
            draw_line(axes, select(rows, part=part, side=side), "ratio", key, marker + "-", **style)


def draw_steps(axes, rows, scheme):
    for number, (acceleration, colour) in enumerate(ACCELERATIONS.items()):
        line = select(rows, part="ddm", scheme=scheme, acceleration=acceleration)
        draw_line(axes, filter(converged, line), "ratio", "interface_steps", color=colour, label=acceleration)
        bad = [row["ratio"] for row in line if not converged(row)]
        axes.plot(bad, [MOST * (1.25 + 0.35 * number)] * len(bad), "x", color=colour)
    axes.axhline(MOST, color="0.7", linewidth=0.8)
    figure.label(axes, "$E_{upper}/E_{lower}$", title=scheme, log="xy", ylim=(1, MOST * 4))


def draw(rows, path):
    drawing, panels = figure.mosaic(["AABB", "CDEF"], (13, 7.2))
    figures = {"p_error": "largest relative error of p", "force_residual": "residual of the forces"}
    for name, (key, label) in zip("AB", figures.items()):
        draw_mortar(panels[name], rows, key)
        ratio = "$E_{inner}/E_{outer}$, $E_{upper}/E_{lower}$"
        figure.label(panels[name], ratio, label, log="xy", legend={"ncol": 2})
    panels["B"].axhline(1e-10, color="0.4", linestyle="--", linewidth=0.9)
    panels["B"].text(1e-6, 3e-11, "limit of the check", fontsize=8, color="0.3")
    for name, scheme in zip("CDEF", SCHEMES):
        draw_steps(panels[name], rows, scheme)
    panels["C"].set_ylabel("steps to 1e-8")
    panels["C"].legend(loc="upper right")
    figure.save(drawing, path)


def mortar_failure(rows):
    line = [{**row, "away": away(row)} for row in rows if row["part"] != "ddm" and solved(row)]
    bound = first(line, "away", lambda row: row["p_error"] > LOST)
    errors = {part: largest(select(line, part=part), "p_error") for part in SIDES}
    residual = largest(line, "force_residual")
    return failure("Mortar method", bound, "fixed" if bound is None else "shown", residual=residual, **errors)


def default_failure(rows):
    line = [row for row in rows if row["part"] == "ddm" and "wrong" not in row["scheme"]]
    bad = [row for row in line if not converged(row)]
    default = select(line, scheme="Neumann-Dirichlet, default roles", acceleration="krylov")
    return failure(
        "Domain decomposition, default roles",
        min(map(away, bad), default=None),
        "default",
        bad=len(bad),
        count=len(line),
        worst=max(row["interface_steps"] for row in line if converged(row)),
        default=max(row["interface_steps"] for row in default),
    )


def fails_from(line, above):
    """The ratio, on the way from 1 up or down, from which runs fail: None if none does."""
    side = [row for row in line if (row["ratio"] >= 1 if above else row["ratio"] <= 1)]
    bad = [away(row) for row in side if not converged(row) or "residual of the contact" in row["failed_checks"]]
    return min(bad, default=None)


def wrong_failure(rows):
    words, bounds = [], []
    for acceleration in ACCELERATIONS:
        line = select(rows, part="ddm", scheme="Neumann-Dirichlet, wrong roles", acceleration=acceleration)
        up, down = (fails_from(line, above) for above in (True, False))
        bounds += [value for value in (up, down) if value]
        if line:
            up, down = (f"{value:g}" if value else "none" for value in (up, down))
            words.append(f"{acceleration}: {up} (upper stiffer), {down} (lower stiffer)")
    return failure(
        "Domain decomposition, stiffer body takes the displacement",
        min(bounds, default=None),
        "shown",
        most=MOST,
        ratios="; ".join(words),
        said=quote(rows, lambda row: row["outcome"] == "not converged"),
    )


def failures(rows):
    return [mortar_failure(rows), default_failure(rows), wrong_failure(rows)]
