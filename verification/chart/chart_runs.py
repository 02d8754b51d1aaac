"""The runs of the chart: mortise_chart by problem and mesh, kept in the store of runs, and their medians."""

import csv
import io
import os
import statistics
import sys
from pathlib import Path

for folder in ("common", "crosscheck", "getfem"):
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / folder))

import launch
import runs

ERRORS = ("e_energy", "e_p_l2", "e_p_l2_inner", "e_p_max_inner")
STAGES = ("s_assemble", "s_couple", "s_factorise", "s_solve", "s_recover", "s_total", "s_wall")
SIZES = ("nodes", "elements", "dofs", "multipliers", "interface_steps")
COLUMNS = (
    *("problem", "method", "mesh", "n", "status", "turns", *SIZES, "energy", *ERRORS, *STAGES),
    *("s_total_min", "s_total_max"),
)
# What measures, beside the programs and the scenes.
MEASURES = ("chart_runs", "economy", "peer_runs", "reference", "timing_check")
FREEFEM = ("mortar.edp", "elasticity.idp", "contact.idp", "system.idp")
CROSSCHECK = ("convert", "run", "scene")


def make_store(output, quick):
    here = Path(__file__).parent
    files = [*(here / f"{name}.py" for name in MEASURES), *(launch.ROOT / "freefem" / name for name in FREEFEM)]
    files += [here.with_name("crosscheck") / f"{name}.py" for name in CROSSCHECK]
    files += [*sorted(here.with_name("getfem").glob("*.py")), here / "manufactured.toml"]
    return runs.Store(output / ("runs_quick" if quick else "runs"), files, [launch.CHART, launch.MORTISE])


def tool(problem, named_ways, turns, *options):
    """Rows of mortise_chart, texts as printed, and what it said of ways that it refuses."""
    ways = [";".join([name, *(f"{key}={value}" for key, value in way.items())]) for name, way in named_ways]
    words = [word for way in ways for word in ("--run", way)]
    command = [launch.need(launch.CHART), problem, *words, "--turns", turns, "--threads", 1, *options]
    done, _ = launch.run(command, expected=(0,), env={**os.environ, **launch.ONE_THREAD})
    return list(csv.DictReader(io.StringIO(done.stdout))), done.stderr.strip()


def number(text):
    return None if text in ("", None) else float(text)


def of_turns(rows):
    """One row of the turns of a method: medians of the seconds, and the range of the whole."""
    first, totals = rows[0], [float(row["s_total"]) for row in rows]
    return {
        **{"method": first["name"], "status": first["status"], "turns": len(rows)},
        **{key: int(first[key]) for key in SIZES},
        **{key: number(first[key]) for key in ("energy", *ERRORS)},
        **{key: statistics.median(float(row[key]) for row in rows) for key in STAGES},
        **{"s_total_min": min(totals), "s_total_max": max(totals)},
    }


def of_mortise(store, problem, mesh_text, named_ways, turns, reference=None):
    """The methods' rows on one mesh, which is run by turns, and what was said of the refused ones."""
    options = ["--reference", reference] if reference else []

    def make(_):
        rows, said = tool(problem, named_ways, turns, *options)
        by_name = {name: [row for row in rows if row["name"] == name] for name, _ in named_ways}
        refused = {name for name, mine in by_name.items() if mine[0]["status"] == "refused"}
        line_of = lambda name: next((line for line in said.splitlines() if line.startswith(name + ":")), name)
        words = {name: line_of(name) for name in refused}
        return {"rows": [of_turns(mine) for name, mine in by_name.items() if name not in refused], "refused": words}

    found = store.row([problem, mesh_text, named_ways, turns, reference and runs.digest(reference)], make, problem)
    return found["rows"], found["refused"]
