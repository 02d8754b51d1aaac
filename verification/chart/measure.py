"""All runs of the chart: chart.csv from mortise_chart, FreeFEM and GetFEM, resumed where runs are there already."""

import datetime
import math
import os
import platform
import statistics
import time

import chart_runs
import launch
import peer_runs
import reference
from chart_methods import LEVELS, PROBLEMS, TURNS, label, mesh_of, peer_ways, row_name, ways


def first_line(command):
    """Of what a program says."""
    try:
        return launch.run(command, cwd=launch.ROOT)[0].stdout.split("\n")[0]
    except (OSError, launch.StudyError):
        return "unknown"


def machine(_):
    """What the seconds belong to."""
    models = [line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")]
    return {
        **{"date": datetime.date.today().isoformat(), "commit": first_line(["git", "describe", "--always", "--dirty"])},
        "mortise": first_line([launch.MORTISE, "--version"]),
        **{by.lower(): peer_runs.version(by) or "missing" for by in peer_runs.PROGRAMS},
        **{"processor": (models or ["unknown"])[0], "cores": os.cpu_count(), "load_average": os.getloadavg()[0]},
        **{"system": platform.platform(), "threads": 1},
    }


def completed(rows, problem, mesh, table):
    """The rows with problem, mesh and, where only a reference is known, their energy error: sqrt(|E - E_ref| / E_ref),
    the energy norm but for what the contact conditions add. What is below the trust in the reference is left empty."""
    for row in rows:
        row = {"problem": problem, "mesh": row_name(problem, row["method"], mesh), "n": mesh[0], **row}
        if problem == "parabola_1":
            row["e_energy"] = math.sqrt(abs(row["energy"] - table["energy"]) / table["energy"])
            row["e_p_l2"] = None
            for key in ("e_energy", *reference.KEYS):
                row[key] = row[key] if row[key] > table["trust"][key] else None
        yield {key: row[key] for key in chart_runs.COLUMNS}


def progress(text, start=None):
    print(text + (f" ({time.perf_counter() - start:.1f} s)" if start else ""), flush=True)


def measure_mesh(store, problem, level, quick, table, path, said, say):
    """The rows of one mesh; fewer turns on the finest, whose seconds vary less."""
    mesh, turns = mesh_of(problem, level), TURNS["quick"] if quick else TURNS["full"] - 2 * (level >= 4)
    against, name = path if problem == "parabola_1" else None, f"{problem} {launch.mesh_name(mesh)}"

    def told(measured, by=""):
        start, fresh = time.perf_counter(), store.fresh
        rows = measured()
        say(f"  {name}: {by}{len(rows)} methods" + (", kept" if store.fresh == fresh else ""), start)
        return rows

    def of_mortise():
        rows, refused = chart_runs.of_mortise(store, problem, launch.mesh_name(mesh), named, turns, against)
        for way in refused.keys() - said.keys():  # each the first time
            said[way] = refused[way].removeprefix(f"{way}: ").replace(f"{launch.ROOT}/", "")
            say(f"  left out: {label(way)}: {said[way]}")
        return rows

    named = list(ways(problem, level, quick))
    rows = told(of_mortise) if named else []
    for program in peer_runs.PROGRAMS:
        theirs = [way for way in peer_ways(level, quick) if way[1] == program]
        if theirs and peer_runs.version(program) is not None:
            of_peer = lambda: peer_runs.of_peer(store, problem, mesh, theirs, min(turns, 3), against)
            rows = rows + told(of_peer, f"{program}, ")
    return list(completed(rows, problem, mesh, table))


def measure(store, output, quick, say=progress):
    """Writes chart.csv into the folder; returns the rows and what belongs to them."""
    start = time.perf_counter()
    for program, package in peer_runs.PROGRAMS.items():
        if peer_runs.version(program) is None:
            say(f"{program} is missing: its curves are left out (Debian: {package})")
    table, path = reference.reference(store, quick)
    say("reference of parabola_1", start)
    rows, said = [], {}
    for level in range(LEVELS["quick" if quick else "full"]):
        for problem in PROBLEMS:
            rows += measure_mesh(store, problem, level, quick, table, path, said, say)
    order = list(PROBLEMS)
    rows.sort(key=lambda row: order.index(row["problem"]))
    launch.write_csv(output / "chart.csv", rows)
    shares = [row["s_wall"] / row["s_total"] for row in rows if row["s_wall"] and row["s_total"] > 0.01]
    say(f"{len(rows)} rows in {output}/chart.csv", start)
    wall = statistics.median(shares) if shares else 1
    return rows, {"machine": store.row("machine", machine), "wall": wall, "reference": table, "left_out": said}
