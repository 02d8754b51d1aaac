"""Other programs' runs of the chart, on mortise's meshes; the errors are taken by errors.py, as those of mortise.

FreeFEM: the scripts of freefem/ on the triangles that mortise's 3-node meshes have, displacements P1 or P2, linear
multipliers on the finer side, segments, straight sides. Seconds are those that the script reports, of the processor:
assembly, coupling (curves, segments, projections: loops of FreeFEM's interpreted language) and solution.

GetFEM: getfem_contact.py on mortise's 8-node meshes, linear multipliers on the finer side; its seconds of the
processor from the mesh in memory to p, of which its system's assembly is a part.
"""

import os
import statistics
import tempfile
from pathlib import Path

from chart_methods import ERRORS, PROBLEMS, size_settings  # makes common/ and crosscheck/ known

import by_getfem
import chart_runs
import errors
import known
import launch
import run
import runs
from cases import Step

PROGRAMS = {"FreeFEM": "freefem++", "GetFEM": "python3-getfem"}  # and Debian's packages
GAUSS_POINTS = {1: 2, 2: 5}  # an edge piece, by the order
GETFEM_SCENE = {"contact.0.condition": "bilateral", "contact.0.initial_gap": "closed"}


def freefem_version():
    program = run.find_freefem()
    if program is None:
        return None
    said, _ = launch.run([program, "-nw", "-?"], expected=range(256))
    words = (said.stdout + said.stderr).split()
    return words[words.index("version") + 1] if "version" in words else "unknown"


def version(program):
    """Or None where it is missing."""
    return freefem_version() if program == "FreeFEM" else by_getfem.version()


def step_of(problem, mesh, order):
    freefem = {"order": order, "multipliers": "linear", "integration": "segments", "gauss": GAUSS_POINTS[order]}
    scene, finer = PROBLEMS[problem]["scene"], PROBLEMS[problem]["finer"]
    same = {"kind": 1, "order": 1}
    return Step(scene, mesh, finer, same, {}, freefem, "bilateral", "closed", same_nodes=False)


def by_freefem(problem, mesh, order, folder, turns):
    """Seconds a turn of assembly, coupling and solution; the summary; mortise's settings of the same nodes; the files."""
    step, seconds = step_of(problem, mesh, order), []
    run.prepare(step, folder)
    for _ in range(turns):
        run.call_freefem(run.SCRIPTS["bilateral"], folder=folder)
        summary = run.freefem_summary(folder)
        seconds.append([summary[f"seconds_{key}"] for key in ("assemble", "couple", "solve")])
    same = {"mesh.parameters.kind": 1, "mesh.parameters.order": order, "mesh.parameters.straight": 1}
    return seconds, summary, same, folder / "freefem"


def by_getfem_too(problem, mesh, _, folder, turns):
    """As by_freefem; the coupling is a part of the assembly."""
    scene, seconds = launch.scene_file(PROBLEMS[problem]["scene"]), []
    launch.call("mesh", scene, *launch.options(size_settings(problem, mesh)), "-o", folder / "mesh.msh")
    for _ in range(turns):
        by_getfem.contact(scene, folder / "mesh.msh", PROBLEMS[problem]["finer"], folder, GETFEM_SCENE)
        summary = by_getfem.summary(folder)
        seconds.append([summary["seconds_set_up"], 0.0, summary["seconds_solve"]])
    return seconds, summary, {}, folder / "getfem"


def measured(problem, mesh, name, program, order, turns, reference):
    """One row of the chart."""
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        make = by_freefem if program == "FreeFEM" else by_getfem_too
        seconds, summary, same, files = make(problem, mesh, order, folder, turns)
        settings = {**size_settings(problem, mesh), **same, "contact.multipliers_on": PROBLEMS[problem]["finer"]}
        (folder / "same").mkdir()
        nodes = chart_runs.solve(problem, settings, folder / "same")
        found = errors.of_run(folder / "same", known.known(problem, reference), files)
    totals, (assemble, couple, solve) = [sum(s) for s in seconds], map(statistics.median, zip(*seconds))
    return {
        **{"method": name, "status": "solved", "turns": turns, "dofs": int(summary["unknowns"])},
        **{"multipliers": int(summary["multipliers"]), "interface_steps": 0, "energy": summary["energy"]},
        **{key: nodes[key] for key in ("nodes", "elements")},
        **{key: found[key] for key in ERRORS},
        **{"s_assemble": assemble, "s_couple": couple, "s_factorise": 0.0, "s_solve": solve, "s_recover": 0.0},
        "s_wall": None,
        **{"s_total": statistics.median(totals), "s_total_min": min(totals), "s_total_max": max(totals)},
    }


def of_peer(store, problem, mesh, ways, turns, reference=None):
    """The rows on one mesh of a program; `ways`: name, program, order of the displacements."""
    os.environ.update(launch.ONE_THREAD)
    make = lambda _: [measured(problem, mesh, *way, turns, reference) for way in ways]
    key = [version(ways[0][1]), problem, mesh, ways, turns, reference and runs.digest(reference)]
    return store.row(key, make, f"{ways[0][1]}_{problem}")
