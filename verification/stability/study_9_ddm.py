"""Domain decomposition: where a fixed relaxation converges and how fast, and the steps of every scheme to 1e-8.

The error of the pressure is multiplied by I - beta (I + C_D^-1 C_N) in every step (C: normal displacement of a body
under contact pressure; D: the body that takes the displacement, N: the one that takes the pressure). With the
eigenvalues mu of I + C_D^-1 C_N the iteration converges for beta < 2 / max mu, with the factor max |1 - beta mu|.
Measured are the factor and the outcome of runs over a grid of beta for five ratios of stiffness and both roles; the
eigenvalues are those that mortise estimates before it iterates. A body force across the upper body makes the problem
asymmetric: without it the mode of max mu, antisymmetric if the lower body takes the displacement, is not in the error.

Nothing but contact holds the upper body vertically. Where it takes the displacement, the resultant of the error shrinks
by 1 - beta: mu = 1. Where it takes the pressure, the iteration starts with the right resultant; the eigenvalues near 1
then belong to pressures that swing from node to node of the finer mesh, which the other body hardly feels and a smooth
load hardly excites: below the best beta the factor then is smaller than predicted.

A run must not converge above the limit or grow below it; a factor must be within 5 % of the predicted one where the run
has shown its asymptote (not larger by that, where the prediction is a bound); and the default method
(method.solver = "ddm" and nothing else) must need at most 14 steps everywhere.
"""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.patches import Rectangle

import figure
import history
import launch
import template
from failures import failure, select
from stability_runs import ended, sweep

SCENE = "parabola_1"
REGIONS = {  # mesh, ratios of Young's moduli, upper over lower body, and relaxations
    "full": ((40, 50), [0.01, 0.1, 1, 10, 100], np.geomspace(0.0008, 4, 38)),
    "quick": ((20, 25), [0.1, 1, 10], np.geomspace(0.02, 4, 12)),
}
ROLES = ["upper", "lower"]  # the body that takes the displacement
OF_LIMIT = [0.9, 0.97, 1.03, 1.1]  # beta as fractions of the predicted limit, beside the grid
NEAR_LIMIT = 0.01  # relative: no claim about runs that are nearer
RATIOS_OF_LINES = np.geomspace(0.01, 100, 17)
MOST_FIXED = 1000  # steps, of a fixed relaxation
FIXED = {
    "method.solver": "ddm",
    "body_force": '[{ body = "upper", force = [1e7, 0] }]',
    "method.acceleration": "none",
    "method.tolerance": 1e-9,  # of a kinematic residual that starts at 1e3: above round-off, which hides a factor
    "method.max_iterations": MOST_FIXED,
}
ENOUGH_STEPS = 25  # fewer (a factor below 0.4) do not show an asymptote where all modes decay nearly alike
LIMIT = 0.05  # of the factors' deviation
TIE = 1e-6  # relative: far above the round-off of the eigenvalues
FLOATING = "upper"

SCENES = {"parabola_1": {}, "cosine": {"contact.condition": "bilateral"}}
SCHEMES = ["neumann_dirichlet", "neumann_neumann", "dirichlet_dirichlet"]
ACCELERATIONS = ["none", "aitken", "anderson", "krylov"]
RATIOS = [0.01, 0.1, 1, 10, 100]
MESHES = {"full": [(20, 25), (40, 50), (80, 100), (160, 200)], "quick": [(20, 25)]}
HISTORY_MESH = {"full": (80, 100), "quick": (20, 25)}
MOST_STEPS = 300
BAR = 14
DEFAULT = "default"


def setting(mesh, ratio, role):
    return {**FIXED, **launch.sizes(mesh), **launch.stiffness(ratio), "method.dirichlet": role}


def eigenvalues(store, mesh, ratio, role):
    """Smallest and largest mu, from a run of one step."""
    settings = {**setting(mesh, ratio, role), "method.max_iterations": 1}
    (row,) = sweep(store, SCENE, settings, {"method.beta": [0.001]})
    return row["iteration.eigenvalue.smallest"], row["iteration.eigenvalue.largest"]


def predicted_factor(beta, smallest, largest):
    return max(abs(1 - beta * smallest), abs(1 - beta * largest))


def judged(row, ratio, role, on_grid):
    """One run with a fixed relaxation."""
    beta, steps, measured = row["method.beta"], int(row["iteration.steps"]), row["iteration.convergence_rate"]
    smallest, largest = row["iteration.eigenvalue.smallest"], row["iteration.eigenvalue.largest"]
    predicted, limit, outcome = predicted_factor(beta, smallest, largest), 2 / largest, ended(row, MOST_FIXED)
    compared = outcome != "diverged" and steps >= ENOUGH_STEPS
    # At the best beta both are equal, and the mode of max mu alone shows the factor.
    bound_only = role != FLOATING and 1 - beta * smallest > (1 + TIE) * (beta * largest - 1)
    right_side = abs(beta / limit - 1) < NEAR_LIMIT or (outcome == "diverged") == (beta > limit)
    deviation = measured / predicted - 1
    within = abs(deviation) <= LIMIT or bound_only and deviation <= LIMIT
    own = {"part": "region", "ratio": ratio, "dirichlet": role, "beta": beta, "beta_over_limit": beta / limit}
    own |= {"mu_smallest": smallest, "mu_largest": largest, "outcome": outcome, "steps": steps}
    own |= {"measured": measured, "predicted": predicted, "deviation": deviation, "on_grid": int(on_grid)}
    verdict = {"compared": compared and not bound_only, "ok": right_side and (within or not compared)}
    return own | {name: int(value) for name, value in verdict.items()}


def region(store, mesh, ratio, role, betas):
    """Runs over the grid of beta, at the best beta, and about the limit."""
    smallest, largest = eigenvalues(store, mesh, ratio, role)
    others = [2 / (smallest + largest), *(2 / largest * f for f in OF_LIMIT)]
    rows = sweep(store, SCENE, setting(mesh, ratio, role), {"method.beta": [*map(float, betas), *others]})
    return [judged(row, ratio, role, on_grid=i < len(betas)) for i, row in enumerate(rows)]


def border(store, mesh, ratio, role):
    """The predicted limit between the ratios of the grid."""
    smallest, largest = eigenvalues(store, mesh, float(ratio), role)
    own = {"part": "border", "mesh": launch.mesh_name(mesh), "ratio": float(ratio), "dirichlet": role, "outcome": "one step"}
    return {**own, "mu_smallest": smallest, "mu_largest": largest}


def shortened(row, scene, mesh, scheme):
    """One run to 1e-8; the default's must not need more steps than the bar."""
    outcome, count = ended(row, MOST_STEPS), int(row["iteration.steps"])
    return {
        "part": "steps",
        "scene": scene,
        "mesh": launch.mesh_name(mesh),
        "ratio": float(f"{row['materials.other.young'] / launch.YOUNG:.6g}"),
        "scheme": scheme,
        "acceleration": row.get("method.acceleration", DEFAULT),
        "outcome": outcome,
        "steps": count,
        "ok": int(scheme != DEFAULT or (outcome == "converged" and count <= BAR)),
        "factor": row["iteration.convergence_rate"],
        "mu_smallest": row["iteration.eigenvalue.smallest"],
        "mu_largest": row["iteration.eigenvalue.largest"],
        "seconds": row["seconds.solve"],
    }


def steps(store, scene, mesh, ratios, schemes, accelerations):
    """The default method, then all schemes and accelerations, on one mesh. Roles and beta are the program's choice."""
    settings = {"method.solver": "ddm", **SCENES[scene], **launch.sizes(mesh), **launch.stiffness(1)}
    young = {"materials.other.young": [launch.YOUNG * ratio for ratio in ratios]}
    rows = [shortened(row, scene, mesh, DEFAULT) for row in sweep(store, scene, settings, young)]
    settings["method.max_iterations"] = MOST_STEPS
    for scheme in schemes:
        choice = {**settings, "method.scheme": scheme}
        found = sweep(store, scene, choice, {**young, "method.acceleration": accelerations})
        rows += [shortened(row, scene, mesh, scheme) for row in found]
    return rows


def residuals(store, mesh, acceleration):
    """The history of one run."""
    settings = {"method.solver": "ddm", "method.acceleration": acceleration, **launch.sizes(mesh)}
    folder = store.results({"history": settings}, lambda _, out: launch.solve(SCENE, settings, out), acceleration)
    label = f"{acceleration}: {history.describe(folder)}"
    return {"part": "history", "outcome": "history", "label": label, "columns": history.read(folder)}


def measure(store, quick):
    size = "quick" if quick else "full"
    mesh, ratios, betas = REGIONS[size]
    rows = [row for role in ROLES for ratio in ratios for row in region(store, mesh, ratio, role, betas)]
    rows += [border(store, mesh, ratio, role) for role in ROLES for ratio in RATIOS_OF_LINES]
    cases = [(scene, mesh) for scene in SCENES for mesh in MESHES[size]]
    rows += [row for case in cases for row in steps(store, *case, RATIOS, SCHEMES, ACCELERATIONS)]
    return rows + [residuals(store, HISTORY_MESH[size], acceleration) for acceleration in ACCELERATIONS]


def draw_runs(axes, rows, colours):
    """A column of cells for each ratio; runs that diverge are crosses."""
    betas = sorted({row["beta"] for row in rows})
    half = (betas[1] / betas[0]) ** 0.5
    for row in rows:
        x, width, y = row["ratio"] / 10**0.3, row["ratio"] * (10**0.3 - 10**-0.3), row["beta"] / half
        if row["outcome"] == "diverged":
            axes.plot(row["ratio"], row["beta"], "x", color=figure.RED, markersize=4, zorder=3)
            continue
        height, colour = row["beta"] * (half - 1 / half), colours.to_rgba(row["measured"])
        axes.add_patch(Rectangle((x, y), width, height, facecolor=colour, edgecolor="none"))
        if row["outcome"] == "unfinished":
            axes.plot(row["ratio"], row["beta"], ".", color="white", markersize=3, zorder=3)
    axes.set(ylim=(betas[0] / 1.15, betas[-1] * 1.15))


def draw_region(rows, path):
    drawing, panels = figure.panels(1, 2, (10, 5.6), sharey=True)
    colours = ScalarMappable(Normalize(0, 1), "viridis")
    for axes, role in zip(panels, ROLES):
        draw_runs(axes, select(rows, part="region", dirichlet=role, on_grid=1), colours)
        lines = select(rows, part="border", dirichlet=role)
        for style, name, beta in (
            ("-", r"limit $\beta = 2/\mu_{max}$", lambda row: 2 / row["mu_largest"]),
            ("--", r"best $\beta = 2/(\mu_{min}+\mu_{max})$", lambda row: 2 / (row["mu_smallest"] + row["mu_largest"])),
        ):
            points = [(row["ratio"], beta(row)) for row in lines]
            figure.curve(axes, points, style, color="black", linewidth=1.3, label=name)
        axes.plot([], [], "x", color=figure.RED, markersize=4, label="diverged")
        axes.plot([], [], ".", color="0.6", markersize=4, label=f"not done after {MOST_FIXED} steps")
        title = f"{role} body takes the displacement"
        figure.label(axes, "$E_{upper}/E_{lower}$", title=title, log="xy", xlim=(0.004, 250))
    panels[0].set_ylabel(r"relaxation $\beta$")
    drawing.colorbar(colours, ax=panels, pad=0.02, aspect=30, label="measured factor of a step")
    figure.legend_below(drawing, panels[0], 4, 0.06)
    mesh = select(rows, part="border")[0]["mesh"]
    drawing.suptitle(f"Neumann-Dirichlet iteration with a fixed relaxation, {SCENE}, {mesh} elements", fontsize=11)
    figure.save(drawing, path)


def draw(rows, path):
    draw_region(rows, path)
    lines = [(row["label"], row["columns"]) for row in select(rows, part="history")]
    history.draw(lines, path.with_name(f"{path.stem}_history.png"), dpi=85)


def steps_table(rows):
    """A row a scene, scheme and acceleration, a column a ratio; in a cell the steps on all meshes."""
    ratios, words = sorted({row["ratio"] for row in rows}), {"converged": "{steps}", "unfinished": "> {steps}"}
    lines = []
    for case in dict.fromkeys((row["scene"], row["scheme"], row["acceleration"]) for row in rows):
        mine = select(rows, **dict(zip(("scene", "scheme", "acceleration"), case)))
        text = lambda row: words.get(row["outcome"], row["outcome"]).format(**row)
        lines.append([*case, *(", ".join(map(text, select(mine, ratio=ratio))) for ratio in ratios)])
    return template.table(["scene", "scheme", "acceleration", *(f"E ratio {ratio:g}" for ratio in ratios)], lines)


def values(rows):
    found = select(rows, part="steps")
    return {"steps": steps_table(found), "meshes": ", ".join(dict.fromkeys(row["mesh"] for row in found))}


def relaxation_failure(rows):
    found = select(rows, part="region")
    limits = {role: {row["ratio"]: 2 / row["mu_largest"] for row in select(found, dirichlet=role)} for role in ROLES}
    text = lambda limit: ", ".join(f"{limit[ratio]:.3g} at {ratio:g}" for ratio in sorted(limit))
    compared = [abs(row["deviation"]) for row in found if row["compared"]]
    return failure(
        "Fixed relaxation",
        min(limits["upper"].values()),
        "default",
        **{role: text(limit) for role, limit in limits.items()},
        agree=sum(row["ok"] for row in found),
        count=len(found),
        compared=len(compared),
        deviation=max(compared, default=0),
    )


def steps_failure(rows):
    found = select(rows, part="steps")
    default, other = ([row for row in found if (row["scheme"] == DEFAULT) == which] for which in (True, False))
    bad = [row for row in other if row["outcome"] != "converged"]
    by_scheme = ((s, [r["steps"] for r in select(other, scheme=s, acceleration="krylov")]) for s in SCHEMES)
    return failure(
        "Steps to 1e-8",
        None,
        "shown" if select(found, ok=0) else "fixed",
        most=max(row["steps"] for row in default),
        bar=BAR,
        schemes=", ".join(f"{scheme} {min(steps)} to {max(steps)}" for scheme, steps in by_scheme),
        bad=len(bad),
        count=len(other),
        accelerations=", ".join(dict.fromkeys(row["acceleration"] for row in bad)) or "none",
        limit=MOST_STEPS,
    )


def failures(rows):
    return [relaxation_failure(rows), steps_failure(rows)]
