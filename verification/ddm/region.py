#!/usr/bin/python3
"""Where the Neumann-Dirichlet iteration with a fixed relaxation beta converges, and how fast.

The error of the pressure is multiplied by I - beta (I + C_D^-1 C_N) in every step (C: normal displacement of a body
under contact pressure; D: the body that takes the displacement, N: the one that takes the pressure). With the
eigenvalues mu of I + C_D^-1 C_N the iteration converges for beta < 2 / max mu, with the factor max |1 - beta mu|.
Measured here on parabola_1 are the factor and the outcome of runs over a grid of beta for five ratios of stiffness and
both roles; the eigenvalues are those that mortise estimates before it iterates. A body force across the upper body
makes the problem asymmetric: without it the mode of max mu, antisymmetric if the lower body takes the displacement,
is not in the error.

Nothing but contact holds the upper body vertically. Where it takes the displacement, the resultant of the error shrinks
by 1 - beta: mu = 1. Where it takes the pressure, the iteration starts with the right resultant; the eigenvalues near 1
then belong to pressures that swing from node to node of the finer mesh, which the other body hardly feels and a smooth
load hardly excites: below the best beta the factor then is smaller than predicted.

Written are region.csv and region.png. Exit status 1 if a factor differs by more than 5 % from the predicted one where
the run has shown its asymptote (is larger by that, where the prediction is a bound), or if a run converges above the
limit, or grows below it.
"""

import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Rectangle

import ddm_runs  # makes launch known
import launch

SCENE = "parabola_1"
MESHES = {"full": (40, 50), "quick": (20, 25)}
RATIOS = {"full": [0.01, 0.1, 1, 10, 100], "quick": [0.1, 1, 10]}
ROLES = ["upper", "lower"]  # the body that takes the displacement
BETAS = {"full": np.geomspace(0.0008, 4, 38), "quick": np.geomspace(0.02, 4, 12)}
OF_LIMIT = [0.9, 0.97, 1.03, 1.1]  # beta as fractions of the predicted limit, beside the grid
NEAR_LIMIT = 0.01  # relative: no claim about runs that are nearer
RATIOS_OF_LINES = np.geomspace(0.01, 100, 17)
ACROSS = '[{ body = "upper", force = [1e7, 0] }]'
RUN = {
    "body_force": ACROSS,
    "method.acceleration": "none",
    "method.tolerance": 1e-10,
    "method.max_iterations": 1000,
}
MOST_STEPS = RUN["method.max_iterations"]
ENOUGH_STEPS = 20  # fewer do not show an asymptote
LIMIT = 0.05
TIE = 1e-6  # relative: far above the round-off of the eigenvalues
FLOATING = "upper"


def setting(mesh, ratio, role):
    return {**RUN, **launch.sizes(mesh), **launch.stiffness(ratio), "method.dirichlet": role}


def eigenvalues(mesh, ratio, role):
    """Smallest and largest mu, from a run of one step."""
    (row,) = ddm_runs.sweep(SCENE, {**setting(mesh, ratio, role), "method.max_iterations": 1}, {"method.beta": [0.001]})
    return row["iteration.eigenvalue.smallest"], row["iteration.eigenvalue.largest"]


def predicted_factor(beta, smallest, largest):
    return max(abs(1 - beta * smallest), abs(1 - beta * largest))


def judged(row, ratio, role, on_grid):
    """One run of a sweep as a row of region.csv."""
    beta, steps, measured = row["method.beta"], int(row["iteration.steps"]), row["iteration.convergence_rate"]
    smallest, largest = row["iteration.eigenvalue.smallest"], row["iteration.eigenvalue.largest"]
    predicted, limit = predicted_factor(beta, smallest, largest), 2 / largest
    outcome = ddm_runs.outcome(row, MOST_STEPS)
    compared = outcome != "diverged" and steps >= ENOUGH_STEPS
    # At the best beta both are equal, and the mode of max mu alone shows the factor.
    bound_only = role != FLOATING and 1 - beta * smallest > (1 + TIE) * (beta * largest - 1)
    right_side = abs(beta / limit - 1) < NEAR_LIMIT or (outcome == "diverged") == (beta > limit)
    deviation = measured / predicted - 1
    within = abs(deviation) <= LIMIT or bound_only and deviation <= LIMIT
    return {
        "ratio": ratio,
        "dirichlet": role,
        "beta": beta,
        "beta_over_limit": beta / limit,
        "mu_smallest": smallest,
        "mu_largest": largest,
        "outcome": outcome,
        "steps": steps,
        "measured": measured,
        "predicted": predicted,
        "deviation": deviation,
        "compared": int(compared and not bound_only),
        "on_grid": int(on_grid),
        "ok": int(right_side and (within or not compared)),
    }


def measure(mesh, ratio, role, betas):
    """Runs over the grid of beta, at the best beta, and about the limit."""
    smallest, largest = eigenvalues(mesh, ratio, role)
    others = [2 / (smallest + largest), *(2 / largest * f for f in OF_LIMIT)]
    rows = ddm_runs.sweep(SCENE, setting(mesh, ratio, role), {"method.beta": [*map(float, betas), *others]})
    return [judged(row, ratio, role, on_grid=i < len(betas)) for i, row in enumerate(rows)]


def measure_all(mesh, ratios, betas):
    return [row for role in ROLES for ratio in ratios for row in measure(mesh, ratio, role, betas)]


def lines(mesh, role):
    """Border and best beta over the ratio."""
    pairs = np.array([eigenvalues(mesh, ratio, role) for ratio in RATIOS_OF_LINES])
    return 2 / pairs[:, 1], 2 / pairs.sum(axis=1)


def draw_runs(axes, rows, betas, colours):
    """A column of cells for each ratio; runs that diverge are crosses."""
    half = (betas[1] / betas[0]) ** 0.5
    for row in (r for r in rows if r["on_grid"]):
        x, width, y = row["ratio"] / 10**0.3, row["ratio"] * (10**0.3 - 10**-0.3), row["beta"] / half
        if row["outcome"] == "diverged":
            axes.plot(row["ratio"], row["beta"], "x", color="#c00000", markersize=4, zorder=3)
            continue
        colour = colours.to_rgba(row["measured"])
        axes.add_patch(Rectangle((x, y), width, row["beta"] * (half - 1 / half), facecolor=colour, edgecolor="none"))
        if row["outcome"] == "unfinished":
            axes.plot(row["ratio"], row["beta"], ".", color="white", markersize=3, zorder=3)


def draw_panel(axes, rows, betas, role, limit_and_best, colours):
    limit, best = limit_and_best
    draw_runs(axes, [row for row in rows if row["dirichlet"] == role], betas, colours)
    axes.plot(RATIOS_OF_LINES, limit, color="black", linewidth=1.4, label=r"limit $\beta = 2/\mu_{max}$")
    of_best = r"best $\beta = 2/(\mu_{min}+\mu_{max})$"
    axes.plot(RATIOS_OF_LINES, best, "--", color="black", linewidth=1.2, label=of_best)
    axes.plot([], [], "x", color="#c00000", markersize=4, label="diverged")
    axes.plot([], [], ".", color="0.6", markersize=4, label=f"not done after {MOST_STEPS} steps")
    axes.set(xscale="log", yscale="log", xlim=(0.004, 250), ylim=(betas[0] / 1.15, betas[-1] * 1.15))
    axes.set_xlabel("$E_{upper}/E_{lower}$")
    axes.set_title(f"{role} body takes the displacement", fontsize=10)


def draw(path, rows, mesh, betas):
    figure, panels = plt.subplots(1, 2, figsize=(10, 5.6), sharey=True, layout="constrained")
    colours = plt.cm.ScalarMappable(plt.Normalize(0, 1), "viridis")
    for axes, role in zip(panels, ROLES):
        draw_panel(axes, rows, betas, role, lines(mesh, role), colours)
    panels[0].set_ylabel(r"relaxation $\beta$")
    figure.colorbar(colours, ax=panels, pad=0.02, aspect=30, label="measured factor of a step")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="lower center", ncol=4, frameon=False, fontsize=9)
    figure.get_layout_engine().set(rect=(0, 0.06, 1, 0.94))
    title = f"Neumann-Dirichlet iteration with a fixed relaxation, {SCENE}, {mesh[0]} x {mesh[1]} elements on the line"
    figure.suptitle(title, fontsize=11)
    figure.savefig(path, dpi=130, pil_kwargs={"optimize": True})
    plt.close(figure)


def summary(rows):
    """Figures of each role and ratio in a line, the runs that do not hold, and how many hold."""
    for role, ratio in dict.fromkeys((row["dirichlet"], row["ratio"]) for row in rows):
        here = [row for row in rows if row["dirichlet"] == role and row["ratio"] == ratio]
        compared = [abs(row["deviation"]) for row in here if row["compared"]]
        diverged = sum(row["outcome"] == "diverged" for row in here)
        smallest, largest = here[0]["mu_smallest"], here[0]["mu_largest"]
        yield (
            f"displacement on {role}, ratio {ratio:g}: mu {smallest:.6g} ... {largest:.6g}, limit {2 / largest:.4g}; "
            f"{diverged} of {len(here)} diverge; {len(compared)} factors compared, off by at most "
            f"{max(compared, default=0):.2%}"
        )
    for row in (r for r in rows if not r["ok"]):
        number = lambda value: f"{value:.4g}" if isinstance(value, float) else str(value)
        yield "NOT ok: " + ", ".join(f"{key} {number(value)}" for key, value in row.items())
    yield f"{sum(row['ok'] for row in rows)} of {len(rows)} runs agree with the prediction"


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, default=Path("out/ddm"), help="folder (default: out/ddm)")
    parser.add_argument("--quick", action="store_true", help="a coarse mesh, fewer ratios and fewer values of beta")
    options = parser.parse_args(arguments)
    size = "quick" if options.quick else "full"
    options.output.mkdir(parents=True, exist_ok=True)
    try:
        rows = measure_all(MESHES[size], RATIOS[size], BETAS[size])
        launch.write_csv(options.output / "region.csv", rows)
        draw(options.output / "region.png", rows, MESHES[size], BETAS[size])
    except launch.MortiseError as error:
        sys.exit(f"region.py: {error}")
    print(*summary(rows), f"{options.output}/region.csv, region.png", sep="\n")
    sys.exit(0 if all(row["ok"] for row in rows) else 1)


if __name__ == "__main__":
    main()
