"""The runs of the chart: mortise by problem and mesh, kept in the store of runs, and their medians."""

import os
import statistics
import tempfile
from pathlib import Path

from chart_methods import ERRORS, PROBLEMS  # makes common/ known

import errors
import known
import launch
import parabola_mesh
import runs

STAGES = ("s_assemble", "s_couple", "s_factorise", "s_solve", "s_recover", "s_total", "s_wall")
SIZES = ("nodes", "elements", "dofs", "multipliers", "interface_steps")
COLUMNS = (
    *("problem", "method", "mesh", "n", "status", "turns", *SIZES, "energy", *ERRORS, *STAGES),
    *("s_total_min", "s_total_max"),
)
# What measures, beside the programs and the scenes.
MEASURES = ("chart_runs", "economy", "errors", "getfem_contact", "known", "manufactured", "parabola_mesh", "peer_runs",
            "reference", "timing_check")  # fmt: skip
FREEFEM = ("mortar.edp", "elasticity.idp", "contact.idp", "system.idp")
CROSSCHECK = ("convert", "run", "scene")


def make_store(output, quick):
    here = Path(__file__).parent
    files = [*(here / f"{name}.py" for name in MEASURES), *(launch.ROOT / "freefem" / name for name in FREEFEM)]
    files += [here.with_name("crosscheck") / f"{name}.py" for name in CROSSCHECK]
    files += [here.with_name("common") / "elements.py", here / "manufactured.toml"]
    return runs.Store(output / ("runs_quick" if quick else "runs"), files)


def arguments_of(problem, settings, folder):
    """Scene and settings of a run; with chart.grading, on the graded mesh of parabola_mesh."""
    settings = dict(settings)
    if (grading := settings.pop("chart.grading", None)) is not None:
        sizes = [settings.pop(f"mesh.parameters.{key}") for key in ("n_upper", "n_lower")]
        parabola_mesh.write_gmsh(folder / "graded.msh", sizes, grading)
        settings |= {"mesh.file": folder / "graded.msh", "mesh.parameters": "{}"}
    return [launch.scene_file(PROBLEMS[problem]["scene"]), *launch.options(settings)]


def solve(problem, settings, folder):
    """One run: sizes, energy, and seconds without meshing and writing. The stages are by the clock, as summary.json has
    them; s_total is s_wall times the processor's share of the whole process, which other work hardly changes. With
    accuracy.value both hold the whole loop with its meshes, none of them kept from before."""
    asked, before = "accuracy.value" in settings, launch.processor_seconds()
    words = ["--no-cache"] if asked else ["--no-estimate"]
    _, whole = launch.run([launch.need(launch.MORTISE), "solve", *arguments_of(problem, settings, folder), "-o", folder,
                           "--quiet", "--threads", 1, *words], env={**os.environ, **launch.ONE_THREAD})  # fmt: skip
    processor = launch.processor_seconds() - before
    summary = launch.summary(folder)
    own, size = summary["seconds"], summary["mesh"]
    wall = own["total"] - own["write"] - (0 if asked else own["mesh"])
    return {
        "status": summary["status"],
        **{key: size[key] for key in ("nodes", "elements", "dofs", "multipliers")},
        **{"interface_steps": summary["iterations"]["solver"], "energy": summary["energy"]},
        **{f"s_{stage}": own[stage] for stage in ("assemble", "couple", "factorise", "solve", "recover")},
        **{"s_total": wall * min(1, processor / whole), "s_wall": wall},
    }


def by_turns(problem, named_ways, turns, reference=None):
    """The rows of each way, its errors in the first, and the words of those that are refused, by name."""
    rows, refused = {name: [] for name, _ in named_ways}, {}
    with tempfile.TemporaryDirectory() as base:
        for turn in range(turns):
            for name, settings in named_ways:
                folder = Path(base) / name
                folder.mkdir(exist_ok=True)
                try:
                    if name not in refused:
                        rows[name].append(solve(problem, settings, folder))
                except launch.StudyError as error:
                    if "exit status 1\n" not in str(error):
                        raise
                    refused[name] = str(error).splitlines()[-1].removeprefix("mortise: error: ")
                if turn == 0 and name not in refused:
                    rows[name][0] |= errors.of_run(folder, known.known(problem, reference))
    return rows, refused


def of_turns(name, rows):
    """One row of the turns of a method: medians of the seconds, and the range of the whole."""
    totals = [row["s_total"] for row in rows]
    medians = {key: statistics.median(row[key] for row in rows) for key in STAGES}
    return {"method": name, **rows[0], "turns": len(rows), **medians, "s_total_min": min(totals), "s_total_max": max(totals)}


def of_mortise(store, problem, mesh_text, named_ways, turns, reference=None):
    """The methods' rows on one mesh, which is run by turns, and what was said of the refused ones."""

    def make(_):
        rows, refused = by_turns(problem, named_ways, turns, reference)
        return {"rows": [of_turns(name, mine) for name, mine in rows.items() if mine], "refused": refused}

    found = store.row([problem, mesh_text, named_ways, turns, reference and runs.digest(reference)], make, problem)
    return found["rows"], found["refused"]
