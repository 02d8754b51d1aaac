"""MSSOR, the preprint's solver: the region of convergence over its two parameters, and its cost against the direct one.

The stationary method (acceleration "none") should converge for every omega in (0, 2) and tau below the limit that
mortise computes from an eigenvalue problem on the contact rows (docs/theory.md, eq. 38), and for no other tau. Measured
is the outcome of runs over a grid, and at 3 % below and above the limit. As preconditioner (acceleration "krylov") it
should converge for every tau > 0.

Then steps and seconds to 1e-10 against the direct solver, from coarse to fine meshes; the stationary method with the
best parameters found. Seconds are those of the equations alone: `factorise` and `solve` of summary.json (order and
splitting of K for MSSOR), on one thread, the shortest of some runs where they are short. The pressure must be the
direct solver's to 1e-8 of the largest.
"""

import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.ticker import StrMethodFormatter

import figure
import launch
import template
from failures import failure, select
from stability_runs import ended, shortest, sweep

SCENE = "parabola_1"
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
# Of the map: mesh, fineness of the grid for each acceleration, most steps of the stationary method.
MAPS = {
    "full": [
        ((20, 25), {"none": "usual", "krylov": "full"}, 20000),
        ((40, 50), {"none": "coarse", "krylov": "full"}, 40000),
    ],
    "quick": [((8, 10), {"none": "coarse", "krylov": "coarse"}, 20000)],
}
MOST_KRYLOV_STEPS = 5000
OF_LIMIT = [0.97, 1.03]  # tau as fractions of the limit, beside the grid
NEAR_LIMIT = 0.01  # relative: no claim about runs that are nearer
ACCELERATIONS = {"none": "stationary", "krylov": "as preconditioner (symmetric QMR)"}
TOLERANCE = 1e-8
OTHERWISE = {
    "diverged": {"marker": "x", "color": figure.RED, "label": "diverges"},
    "unfinished": {"marker": ".", "color": "0.5", "label": "not done at the limit of steps"},
}

METHODS = {  # settings, name, style
    "direct": ({}, "direct (sparse Cholesky)", {"color": "black", "marker": "s"}),
    "krylov": ({"method.solver": "mssor"}, "MSSOR + symmetric QMR", {"color": "#0060b0", "marker": "o"}),
    "minres": (
        {"method.solver": "mssor", "method.acceleration": "minres"},
        "blocks of MSSOR + MINRES",
        {"color": "#d07000", "marker": "^"},
    ),
    "none": (
        {"method.solver": "mssor", "method.acceleration": "none", "method.max_iterations": 1000000},
        "MSSOR, stationary",
        {"color": "#a02060", "marker": "v"},
    ),
}
# Of the table: meshes, and of each method the finest of them.
MESHES = {"full": [(20, 25), (40, 50), (80, 100), (160, 200)], "quick": [(8, 10), (16, 20)]}
FINEST = {
    "full": {"direct": (160, 200), "krylov": (160, 200), "minres": (160, 200), "none": (40, 50)},
    "quick": {"direct": (16, 20), "krylov": (16, 20), "minres": (16, 20), "none": (8, 10)},
}
LIMIT = 1e-8  # of the pressures' difference


def judged(row, mesh, acceleration, limit, on_grid):
    """One run of the map."""
    omega, tau, outcome = row["method.omega"], row["method.tau"], ended(row)
    if acceleration == "none":
        right = abs(tau / limit - 1) < NEAR_LIMIT or (outcome == "diverged") == (tau > limit)
    else:
        right = outcome == "converged"
    own = {"part": "map", "mesh": launch.mesh_name(mesh), "acceleration": acceleration, "omega": omega, "tau": tau}
    own |= {"tau_limit": limit, "outcome": outcome, "on_grid": int(on_grid), "ok": int(right)}
    own |= {"steps": int(row["iteration.steps"]), "factor": row["iteration.convergence_rate"]}
    return own | {"seconds": row["iteration.seconds"]}


def region(store, mesh, acceleration, omegas, taus, most_steps):
    """Runs over the grid, and for the stationary method about the limit, which comes from a run of one step."""
    own, rows = {"method.solver": "mssor", **launch.sizes(mesh)}, []
    settings = {"method.acceleration": acceleration, "method.tolerance": TOLERANCE, "method.max_iterations": most_steps}
    for omega in omegas:
        one_step = {**own, "method.acceleration": "none", "method.max_iterations": 1}
        (row,) = sweep(store, SCENE, one_step, {"method.omega": [omega], "method.tau": [0.1]})
        limit = row["iteration.tau_limit"]
        others = [float(f"{limit * f:.6g}") for f in OF_LIMIT] if acceleration == "none" else []
        found = sweep(store, SCENE, {**own, **settings}, {"method.omega": [omega], "method.tau": [*taus, *others]})
        rows += [judged(row, mesh, acceleration, limit, i < len(taus)) for i, row in enumerate(found)]
    return rows


def best(rows, mesh, acceleration):
    """The row of a mesh with the fewest steps; None where none converged."""
    here = select(rows, mesh=mesh, acceleration=acceleration, outcome="converged")
    return min(here, key=lambda row: row["steps"], default=None)


def steps(store, meshes, finest, parameters):
    """Each method up to its finest mesh. `parameters`: settings of a method's omega and tau."""
    rows = []
    for mesh in meshes:
        for method in (method for method, most in finest.items() if mesh[0] <= most[0]):
            chosen = parameters.get(method, {})
            settings = {**launch.sizes(mesh), **METHODS[method][0], **chosen}
            found = store.row({"scene": SCENE, "settings": settings}, shortest, "timed")
            p = np.array(found.pop("p"))
            direct, p_direct = (found, p) if method == "direct" else (direct, p_direct)
            row = {"part": "steps", "mesh": launch.mesh_name(mesh), "method": method, **found}
            row |= {"omega": chosen.get("method.omega", ""), "tau": chosen.get("method.tau", "")}
            row["over_direct"] = found["seconds"] / direct["seconds"]
            row["p_difference"] = float(np.abs(p - p_direct).max() / np.abs(p_direct).max())
            rows.append(row | {"ok": int(row["outcome"] == "converged" and row["p_difference"] <= LIMIT)})
    return rows


def measure(store, quick):
    size, rows = "quick" if quick else "full", []
    for mesh, grids, most_steps in MAPS[size]:
        for acceleration, grid in grids.items():
            most = most_steps if acceleration == "none" else MOST_KRYLOV_STEPS
            rows += region(store, mesh, acceleration, OMEGAS[grid], TAUS[grid], most)
    least = best(rows, rows[0]["mesh"], "none")
    parameters = {"none": {"method.omega": least["omega"], "method.tau": least["tau"]}} if least else {}
    return rows + steps(store, MESHES[size], FINEST[size], parameters)


def edges(values):
    """Borders of the cells about the points of a grid."""
    middles = (values[1:] + values[:-1]) / 2
    return np.concatenate([[2 * values[0] - middles[0]], middles, [2 * values[-1] - middles[-1]]])


def draw_panel(axes, rows, colours):
    """The steps of one mesh and acceleration over omega and tau."""
    grid = select(rows, on_grid=1)
    omegas, taus = (np.array(sorted({row[key] for row in grid})) for key in ("omega", "tau"))
    count = np.full((len(taus), len(omegas)), np.nan)
    for row in select(grid, outcome="converged"):
        count[np.searchsorted(taus, row["tau"]), np.searchsorted(omegas, row["omega"])] = row["steps"]
    x, y = edges(omegas), np.exp(edges(np.log(taus)))
    drawn = axes.pcolormesh(x, y, count, cmap="viridis_r", norm=colours)
    for outcome, style in OTHERWISE.items():
        some = select(grid, outcome=outcome)
        axes.plot([r["omega"] for r in some], [r["tau"] for r in some], linestyle="", markersize=5, **style)
    mesh, acceleration = rows[0]["mesh"], rows[0]["acceleration"]
    star = {"color": "white", "markeredgecolor": "black", "markersize": 12, "linestyle": "", "label": "fewest steps"}
    if least := best(rows, mesh, acceleration):
        axes.plot(least["omega"], least["tau"], "*", **star)
        words = {"ha": "center", "fontsize": 9, "textcoords": "offset points"}
        white = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1}
        axes.annotate(f"{least['steps']} steps", (least["omega"], least["tau"]), (0, 9), bbox=white, **words)
    if acceleration == "none":
        limit = sorted({(row["omega"], row["tau_limit"]) for row in rows})
        figure.curve(axes, limit, "-", color="black", linewidth=1.8, label=r"limit $\tau_{limit}(\omega)$, eq. (38)")
    title = f"{mesh}, {ACCELERATIONS[acceleration]}"
    figure.label(axes, r"$\omega$", title=title, log="y", xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
    return drawn


def draw_map(rows, path):
    """A row a mesh, a column an acceleration."""
    meshes = list(dict.fromkeys(row["mesh"] for row in rows))
    drawing, panels = figure.panels(len(meshes), 2, (9.6, 0.9 + 3.5 * len(meshes)), squeeze=False)
    for column, acceleration in enumerate(ACCELERATIONS):
        count = [row["steps"] for row in select(rows, acceleration=acceleration, outcome="converged")]
        colours = LogNorm(min(count), max(count))
        for axes, mesh in zip(panels[:, column], meshes):
            drawn = draw_panel(axes, select(rows, mesh=mesh, acceleration=acceleration), colours)
        bar = drawing.colorbar(drawn, ax=panels[:, column], pad=0.02, aspect=40, label=f"steps to {TOLERANCE:g}")
        for formatter in (bar.ax.yaxis.set_major_formatter, bar.ax.yaxis.set_minor_formatter):
            formatter(StrMethodFormatter("{x:g}"))
        bar.ax.tick_params(which="both", labelsize=8)
    for axes in panels[:, 0]:
        axes.set_ylabel(r"$\tau$")
    figure.legend_below(drawing, panels[0, 0], 4, 0.12 / len(meshes))
    figure.save(drawing, path, 90)


def draw_steps(rows, path):
    drawing, (left, right) = figure.panels(1, 2, (9.6, 3.9))
    for method, (_, name, style) in METHODS.items():
        here = select(rows, method=method)
        count = [(row["unknowns"], row["steps"]) for row in here if row["steps"]]
        figure.curve(left, count, "-", label=name, **style)
        figure.curve(right, [(row["unknowns"], row["seconds"]) for row in here], "-", **style)
    figure.label(left, "unknowns", "steps to 1e-10", log="xy")
    figure.label(right, "unknowns", "seconds (factorisation and solution)", log="xy")
    for row in select(rows, method="direct"):
        where = {"textcoords": "offset points", "ha": "center", "fontsize": 8}
        right.annotate(row["mesh"], (row["unknowns"], row["seconds"]), (0, -14), **where)
    right.margins(y=0.12)
    figure.legend_below(drawing, left, 4, 0.09)
    figure.save(drawing, path, 90)


def draw(rows, path):
    draw_map(select(rows, part="map"), path)
    draw_steps(select(rows, part="steps"), path.with_name(f"{path.stem}_steps.png"))


def map_table(rows):
    lines = []
    for mesh in dict.fromkeys(row["mesh"] for row in rows):
        for acceleration, words in ACCELERATIONS.items():
            here, least = select(rows, mesh=mesh, acceleration=acceleration), best(rows, mesh, acceleration)
            counts = [len(select(here, outcome=outcome)) for outcome in ("converged", "diverged", "unfinished")]
            fewest = f"{least['steps']} at omega = {least['omega']:g}, tau = {least['tau']:g}" if least else "none"
            lines.append([mesh, words, *counts, fewest, f"{sum(row['ok'] for row in here)} of {len(here)}"])
    heading = ["mesh", "MSSOR", "converge", "diverge", "not done at the limit"]
    return template.table([*heading, "fewest steps to 1e-8", "as eq. (38) says"], lines)


def steps_table(rows):
    heading = ["mesh", "unknowns", "multipliers", "method", "omega", "tau", "steps", "seconds", "times direct"]
    heading += ["force residual", "kinematic residual", "p against direct"]
    lines = []
    for row in rows:
        figures = [f"{row[key]:.3g}" for key in ("seconds", "over_direct")]
        figures += [f"{row[key]:.1e}" for key in ("force", "kinematic", "p_difference")]
        sizes = [row[key] for key in ("mesh", "unknowns", "multipliers")]
        lines.append([*sizes, METHODS[row["method"]][1], row["omega"], row["tau"], row["steps"] or "–", *figures])
    return template.table(heading, lines)


def growth(rows, method):
    """By what the steps grow from mesh to mesh."""
    count = [row["steps"] for row in select(rows, method=method)]
    return ", ".join(f"{b / a:.2f}" for a, b in zip(count, count[1:])) or "none"


def values(rows):
    found = select(rows, part="steps")
    return {
        "map": map_table(select(rows, part="map")),
        "steps": steps_table(found),
        **{method: growth(found, method) for method in METHODS if method != "direct"},
    }


def map_failure(rows, acceleration, name, state):
    found = select(rows, part="map", acceleration=acceleration)
    limits = {row["omega"]: row["tau_limit"] for row in select(found, mesh=found[0]["mesh"])}
    words = ", ".join(f"{limit:.3g} at omega = {omega:g}" for omega, limit in sorted(limits.items()))
    bad, ok = (sum(map(holds, found)) for holds in (lambda r: r["outcome"] != "converged", lambda r: r["ok"]))
    own = {"limits": words, "ok": ok} if acceleration == "none" else {"bad": bad}
    return failure(name, min(limits.values()) if acceleration == "none" else None, state, count=len(found), **own)


def cost_failure(rows):
    found = [row for row in select(rows, part="steps") if row["method"] != "direct"]
    values = {"p": max(row["p_difference"] for row in found)}
    for name, own in (("stationary", True), ("accelerated", False)):
        ratios = [row["over_direct"] for row in found if (row["method"] == "none") == own]
        values |= {f"{name}_least": min(ratios), f"{name}_most": max(ratios)}
    return failure("Cost", values["accelerated_least"], "default", **values)


def failures(rows):
    state = "fixed" if all(row["ok"] for row in select(rows, part="map", acceleration="krylov")) else "shown"
    return [
        map_failure(rows, "none", "The stationary method beyond its limit of tau", "shown"),
        map_failure(rows, "krylov", "MSSOR as preconditioner", state),
        cost_failure(rows),
    ]
