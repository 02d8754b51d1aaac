"""Steps and seconds of MSSOR against the direct solver, from coarse to fine meshes.

Seconds are those of the equations alone: `factorise` and `solve` of summary.json (order and splitting of K for MSSOR),
on one thread, the shortest of some runs where they are short. All are solved to 1e-10; the pressure is compared with
the direct solver's.
"""

import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import mssor_runs
import launch

METHODS = {
    "direct": {},
    "krylov": {"method.solver": "mssor"},
    "minres": {"method.solver": "mssor", "method.acceleration": "minres"},
    "none": {"method.solver": "mssor", "method.acceleration": "none", "method.max_iterations": 1000000},
}
WORDS = {
    "direct": "direct (sparse Cholesky)",
    "krylov": "MSSOR + symmetric QMR",
    "minres": "blocks of MSSOR + MINRES",
    "none": "MSSOR, stationary",
}
STYLES = {
    "direct": {"color": "black", "marker": "s"},
    "krylov": {"color": "#0060b0", "marker": "o"},
    "minres": {"color": "#d07000", "marker": "^"},
    "none": {"color": "#a02060", "marker": "v"},
}
SHORT = 2.0  # seconds: runs that are shorter are repeated
REPEATS = 3


def one(mesh, settings):
    """Seconds, steps, residuals and pressures of a run."""
    with tempfile.TemporaryDirectory() as folder:
        summary = launch.solve(mssor_runs.SCENE, {**launch.sizes(mesh), **settings}, folder)
        contact = launch.columns(Path(folder) / "contact.csv")
    seconds = summary["seconds"]["factorise"] + summary["seconds"]["solve"]
    checks = {check["name"]: check["value"] for check in summary["checks"]}
    return {
        "seconds": seconds,
        "steps": summary["iterations"]["solver"],
        "unknowns": summary["mesh"]["dofs"],
        "multipliers": summary["mesh"]["multipliers"],
        "converged": int(summary["status"] != "not_converged"),
        "force": checks["residual of the forces"],
        "kinematic": checks["residual of the contact condition"],
        "p": contact["p"],
    }


def repeated(mesh, settings):
    runs = [one(mesh, settings)]
    while len(runs) < REPEATS and runs[0]["seconds"] < SHORT:
        runs.append(one(mesh, settings))
    return min(runs, key=lambda run: run["seconds"])


def run(folder, mesh, method, parameters):
    """A method on a mesh, kept; `parameters`: omega and tau of an iteration."""
    settings = {**METHODS[method], **({} if method == "direct" else parameters)}
    key = {"scene": mssor_runs.SCENE, "mesh": mesh, "settings": settings, "repeats": REPEATS}
    return mssor_runs.kept(folder, key, lambda: repeated(mesh, settings))


def measure(folder, meshes, methods, parameters, report=print):
    """Rows of steps.csv. `methods`: of each its finest mesh; `parameters`: of each its omega and tau."""
    rows = []
    for mesh in meshes:
        direct = None
        for method, finest in methods.items():
            if mesh[0] > finest[0]:
                continue
            chosen = parameters.get(method, {})
            found = run(folder, mesh, method, chosen)
            p = found.pop("p")
            direct = direct or (found["seconds"], p)
            difference = max(abs(a - b) for a, b in zip(p, direct[1])) / max(map(abs, direct[1]))
            row = {
                "mesh": mssor_runs.name_of(mesh),
                "method": method,
                "omega": chosen.get("method.omega", ""),
                "tau": chosen.get("method.tau", ""),
                **found,
                "over_direct": found["seconds"] / direct[0],
                "p_difference": difference,
            }
            rows.append(row)
            report("{mesh} {method}: {steps} steps, {seconds:.3f} s, p off by {p_difference:.1e}".format(**row))
    return rows


def draw(path, rows):
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.6, 3.9), layout="constrained")
    for method in dict.fromkeys(row["method"] for row in rows):
        here = [row for row in rows if row["method"] == method]
        unknowns = [row["unknowns"] for row in here]
        right.plot(unknowns, [row["seconds"] for row in here], **STYLES[method])
        steps = [row["steps"] for row in here]
        left.plot(unknowns if any(steps) else [], steps if any(steps) else [], label=WORDS[method], **STYLES[method])
    for axes, label in ((left, "steps to 1e-10"), (right, "seconds (factorisation and solution)")):
        axes.set(xscale="log", yscale="log", xlabel="unknowns", ylabel=label)
        axes.grid(True, which="major", color="0.9")
    finest = [row for row in rows if row["method"] == "direct"]
    for row in finest:
        right.annotate(row["mesh"], (row["unknowns"], row["seconds"]), (0, -14), textcoords="offset points",
                       ha="center", fontsize=8)  # fmt: skip
    right.margins(y=0.12)
    figure.legend(*left.get_legend_handles_labels(), loc="lower center", ncol=4, frameon=False, fontsize=9)
    figure.get_layout_engine().set(rect=(0, 0.09, 1, 0.91))
    figure.savefig(path, dpi=90, pil_kwargs={"optimize": True})
    plt.close(figure)
