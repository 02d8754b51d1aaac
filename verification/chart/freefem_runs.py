"""FreeFEM's runs of the chart: the scripts of freefem/ on the triangles that mortise's 3-node meshes have.

Displacements P1 or P2, linear multipliers on the finer side, segments, straight sides. Seconds are those that the
script reports, of the processor: assembly, coupling (curves, segments, projections: loops of FreeFEM's interpreted
language) and solution. The errors are taken by mortise_chart, as those of mortise.
"""

import statistics
import tempfile
from pathlib import Path

import chart_runs  # makes common/ and crosscheck/ known
import launch
import run
import runs
from cases import Step
from chart_methods import PROBLEMS, size_settings

GAUSS_POINTS = {1: 2, 2: 5}  # an edge piece, by the order


def version():
    """Of FreeFEM, or None where it is missing."""
    program = run.find_freefem()
    if program is None:
        return None
    said, _ = launch.run([program, "-nw", "-?"], expected=range(256))
    words = (said.stdout + said.stderr).split()
    return words[words.index("version") + 1] if "version" in words else "unknown"


def step_of(problem, mesh, order):
    scene, side = PROBLEMS[problem]["freefem"]
    freefem = {"order": order, "multipliers": "linear", "integration": "segments", "gauss": GAUSS_POINTS[order]}
    return Step(scene, mesh, side, {"kind": 1, "order": 1}, {}, freefem, "bilateral", "closed", same_nodes=False)


def errors(problem, step, folder, against):
    """Of the results in a folder; nodes and elements too. `against`: options of mortise_chart."""
    same = {"mesh.parameters.kind": 1, "mesh.parameters.order": step.freefem["order"], "mesh.parameters.straight": 1}
    settings = {**size_settings(problem, step.mesh), **same, "contact.multipliers_on": step.side}
    rows, _ = chart_runs.tool(problem, [("freefem", settings)], 1, "--freefem", folder, *against)
    found = chart_runs.of_turns(rows)
    return {key: found[key] for key in ("nodes", "elements", *chart_runs.ERRORS)}


def measured(problem, mesh, name, order, turns, against):
    """One row of the chart."""
    step, seconds = step_of(problem, mesh, order), []
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        run.prepare(step, folder)
        for _ in range(turns):
            run.call_freefem(run.SCRIPTS["bilateral"], folder=folder)
            summary = run.freefem_summary(folder)
            seconds.append([summary[f"seconds_{key}"] for key in ("assemble", "couple", "solve")])
        found = errors(problem, step, folder, against)
    totals, (assemble, couple, solve) = [sum(s) for s in seconds], map(statistics.median, zip(*seconds))
    return {
        **{"method": name, "status": "solved", "turns": turns, "dofs": int(summary["unknowns"])},
        **{"multipliers": int(summary["multipliers"]), "interface_steps": 0, "energy": summary["energy"], **found},
        **{"s_assemble": assemble, "s_couple": couple, "s_factorise": 0.0, "s_solve": solve, "s_recover": 0.0},
        "s_wall": None,
        **{"s_total": statistics.median(totals), "s_total_min": min(totals), "s_total_max": max(totals)},
    }


def of_freefem(store, problem, mesh, ways, turns, reference=None):
    """The rows on one mesh."""
    against = ["--reference", reference] if reference else []
    make = lambda _: [measured(problem, mesh, name, order, turns, against) for name, order in ways]
    key = ["FreeFEM", version(), problem, mesh, ways, turns, reference and runs.digest(reference)]
    return store.row(key, make, f"freefem_{problem}")
