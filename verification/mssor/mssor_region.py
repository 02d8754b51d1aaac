"""The region of convergence of MSSOR over its two parameters, and the steps to 1e-8 in it.

The stationary method (acceleration "none") should converge for every omega in (0, 2) and tau below the limit that
mortise computes from an eigenvalue problem on the contact rows (docs/theory.md, eq. 38), and for no other tau. Measured
is the outcome of runs over a grid, and at 3 % below and above the limit. As preconditioner (acceleration "krylov") it
should converge for every tau > 0.
"""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.ticker import StrMethodFormatter

import mssor_runs
import launch

OMEGAS = {
    "full": [0.3, 0.5, 0.7, 0.9, 1.1, 1.3, 1.5, 1.7, 1.9],
    "usual": [0.5, 0.9, 1.3, 1.6, 1.8],
    "coarse": [0.8, 1.3, 1.7],
}
TAUS = {
    "full": [float(f"{t:.3g}") for t in np.geomspace(0.02, 8, 11)],
    "usual": [0.05, 0.3, 0.9, 1.5, 2.5, 5],
    "coarse": [0.3, 1.5, 5],
}
OF_LIMIT = [0.97, 1.03]  # tau as fractions of the limit, beside the grid
NEAR_LIMIT = 0.01  # relative: no claim about runs that are nearer
ACCELERATIONS = {"none": "stationary", "krylov": "as preconditioner (symmetric QMR)"}
TOLERANCE = 1e-8
OTHERWISE = {"diverged": {"marker": "x", "color": "#c00000"}, "unfinished": {"marker": ".", "color": "0.5"}}


def judged(row, mesh, acceleration, limit, on_grid):
    """One run of a sweep as a row of map.csv."""
    omega, tau, outcome = row["method.omega"], row["method.tau"], mssor_runs.outcome(row)
    if acceleration == "none":
        right = abs(tau / limit - 1) < NEAR_LIMIT or (outcome == "diverged") == (tau > limit)
    else:
        right = outcome == "converged"
    return {
        "mesh": mssor_runs.name_of(mesh),
        "acceleration": acceleration,
        "omega": omega,
        "tau": tau,
        "tau_limit": limit,
        "outcome": outcome,
        "steps": int(row["iteration.steps"]),
        "factor": row["iteration.convergence_rate"],
        "seconds": row["iteration.seconds"],
        "on_grid": int(on_grid),
        "ok": int(right),
    }


def limit_of(folder, mesh, omega):
    """The limit of tau, from a run of one step."""
    settings = {**launch.sizes(mesh), "method.acceleration": "none", "method.max_iterations": 1}
    (row,) = mssor_runs.sweep(folder, settings, {"method.omega": [omega], "method.tau": [0.1]})
    return row["iteration.tau_limit"]


def measure(folder, mesh, acceleration, omegas, taus, most_steps, report=print):
    """Runs over the grid, and for the stationary method about the limit."""
    settings = {
        **launch.sizes(mesh),
        "method.acceleration": acceleration,
        "method.tolerance": TOLERANCE,
        "method.max_iterations": most_steps,
    }
    rows = []
    for omega in omegas:
        limit = limit_of(folder, mesh, omega)
        others = [float(f"{limit * f:.6g}") for f in OF_LIMIT] if acceleration == "none" else []
        found = mssor_runs.sweep(folder, settings, {"method.omega": [omega], "method.tau": [*taus, *others]})
        rows += [judged(row, mesh, acceleration, limit, i < len(taus)) for i, row in enumerate(found)]
        steps = [row["steps"] for row in rows if row["omega"] == omega and row["outcome"] == "converged"]
        words = f"{min(steps)} steps at best" if steps else "none converges"
        report(f"{mssor_runs.name_of(mesh)} {acceleration} omega {omega}: limit of tau {limit:.4g}, {words}")
    return rows


def best(rows, mesh, acceleration):
    """The row of a mesh with the fewest steps; None where none converged."""
    here = [r for r in rows if (r["mesh"], r["acceleration"], r["outcome"]) == (mesh, acceleration, "converged")]
    return min(here, key=lambda r: r["steps"], default=None)


def edges(values):
    """Borders of the cells about the points of a grid."""
    middles = (values[1:] + values[:-1]) / 2
    return np.concatenate([[2 * values[0] - middles[0]], middles, [2 * values[-1] - middles[-1]]])


def draw_panel(axes, rows, mesh, acceleration, colours):
    here = [r for r in rows if r["mesh"] == mesh and r["acceleration"] == acceleration and r["on_grid"]]
    omegas, taus = (np.array(sorted({r[key] for r in here})) for key in ("omega", "tau"))
    steps = np.full((len(taus), len(omegas)), np.nan)
    for r in here:
        if r["outcome"] == "converged":
            steps[np.searchsorted(taus, r["tau"]), np.searchsorted(omegas, r["omega"])] = r["steps"]
    x, y = edges(omegas), np.exp(edges(np.log(taus)))
    drawn = axes.pcolormesh(x, y, steps, cmap="viridis_r", norm=colours)
    for outcome, style in OTHERWISE.items():
        some = [r for r in here if r["outcome"] == outcome]
        axes.plot([r["omega"] for r in some], [r["tau"] for r in some], linestyle="", markersize=5, **style)
    least = best(rows, mesh, acceleration)
    if least:
        axes.plot(least["omega"], least["tau"], "*", color="white", markeredgecolor="black", markersize=12)
        words = {"ha": "center", "fontsize": 9, "textcoords": "offset points"}
        white = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1}
        axes.annotate(f"{least['steps']} steps", (least["omega"], least["tau"]), (0, 9), bbox=white, **words)
    axes.set(yscale="log", xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
    axes.set_title(f"{mesh}, {ACCELERATIONS[acceleration]}", fontsize=10)
    return drawn


def draw(path, rows):
    """A row a mesh, a column an acceleration."""
    meshes = list(dict.fromkeys(r["mesh"] for r in rows))
    size = (9.6, 0.9 + 3.5 * len(meshes))
    figure, panels = plt.subplots(len(meshes), 2, figsize=size, squeeze=False, layout="constrained")
    for column, acceleration in enumerate(ACCELERATIONS):
        steps = [r["steps"] for r in rows if r["acceleration"] == acceleration and r["outcome"] == "converged"]
        colours = LogNorm(min(steps), max(steps))
        for line, mesh in enumerate(meshes):
            axes = panels[line, column]
            drawn = draw_panel(axes, rows, mesh, acceleration, colours)
            if acceleration == "none":
                limit = sorted({(r["omega"], r["tau_limit"]) for r in rows if r["mesh"] == mesh})
                of_limit = {"color": "black", "linewidth": 1.8, "label": r"limit $\tau_{limit}(\omega)$, eq. (38)"}
                axes.plot(*zip(*limit), **of_limit)
            axes.set_xlabel(r"$\omega$")
        bar = figure.colorbar(drawn, ax=panels[:, column], pad=0.02, aspect=40, label=f"steps to {TOLERANCE:g}")
        for axis_ticks in (bar.ax.yaxis.set_major_formatter, bar.ax.yaxis.set_minor_formatter):
            axis_ticks(StrMethodFormatter("{x:g}"))
        bar.ax.tick_params(which="both", labelsize=8)
    for axes in panels[:, 0]:
        axes.set_ylabel(r"$\tau$")
    first = panels[0, 0]
    first.plot([], [], "x", color="#c00000", markersize=5, label="diverges")
    first.plot([], [], ".", color="0.5", markersize=5, label="not done at the limit of steps")
    first.plot([], [], "*", color="white", markeredgecolor="black", markersize=11, linestyle="", label="fewest steps")
    figure.legend(*first.get_legend_handles_labels(), loc="lower center", ncol=4, frameon=False, fontsize=9)
    figure.get_layout_engine().set(rect=(0, 0.12 / len(meshes), 1, 1 - 0.12 / len(meshes)))
    figure.savefig(path, dpi=90, pil_kwargs={"optimize": True})
    plt.close(figure)
