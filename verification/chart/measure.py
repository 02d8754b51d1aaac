"""All runs of the chart: chart.csv from mortise_chart and FreeFEM, resumed where runs are there already."""

import datetime
import math
import os
import platform
import statistics
import subprocess
import time

import chart_runs
import exact
import freefem_chart
import launch
import reference
from chart_methods import LEVELS, PROBLEMS, TURNS, freefem_ways, label, mesh_name, mesh_of, ways


def first_line(command):
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=launch.ROOT)
    except OSError:
        return "unknown"
    return (done.stdout.strip().splitlines() or ["unknown"])[0]


def processor():
    try:
        lines = open("/proc/cpuinfo").read().splitlines()
    except OSError:
        return platform.processor() or "unknown"
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), "unknown")


def machine():
    """What the seconds belong to."""
    return {
        "date": datetime.datetime.now().isoformat(timespec="seconds"),
        "commit": first_line(["git", "describe", "--always", "--dirty"]),
        "mortise": first_line([launch.MORTISE, "--version"]),
        "tool": chart_runs.digest(chart_runs.TOOL),
        "freefem": freefem_chart.version() or "missing",
        "processor": processor(),
        "cores": os.cpu_count(),
        "load_average": os.getloadavg()[0],
        "system": platform.platform(),
        "threads": 1,
    }


def energy_by_difference(row, table):
    """sqrt(|E - E_ref| / E_ref): the energy norm of the error, relative, but for what the contact conditions add."""
    return math.sqrt(abs(row["energy"] - table["energy"]) / table["energy"])


def completed(rows, problem, mesh, table):
    """The rows with problem, mesh and, where only a reference is known, their energy error. What is below the trust in
    the reference is left empty."""
    for row in rows:
        row = {"problem": problem, "mesh": mesh_name(mesh), "n": mesh[0], **row}
        if problem == "parabola_1":
            row["e_energy"], row["e_p_l2"] = energy_by_difference(row, table), None
            for key in ("e_energy", *reference.KEYS):
                row[key] = row[key] if row[key] > table["trust"][key] else None
        yield {key: row[key] for key in chart_runs.COLUMNS}


def turns_at(level, quick):
    """Fewer on the finest meshes, whose seconds vary less."""
    return TURNS["quick"] if quick else TURNS["full"] - 2 * (level >= 4)


def say_once(refused, said, say):
    """Methods that the executable refuses, each the first time with its words."""
    for name, message in refused.items():
        if name not in said:
            message = message.removeprefix(f"{name}: ").replace(f"{launch.ROOT}/", "")
            say(f"  left out: {label(name)}: {message}")
            said[name] = message


def measure_mesh(problem, level, quick, folder, table, path, have_freefem, said, say):
    mesh, turns, rows = mesh_of(problem, level), turns_at(level, quick), []
    against = path if problem == "parabola_1" else None
    start = time.perf_counter()
    named = list(ways(problem, level, quick))
    if named:
        found, refused, old = chart_runs.runs(problem, mesh_name(mesh), named, turns, folder, against)
        rows += found
        say_once(refused, said, say)
        say(f"  {problem} {mesh_name(mesh)}: {len(found)} methods" + (", kept" if old else ""), start)
    start, by_freefem = time.perf_counter(), list(freefem_ways(problem, level, quick))
    if by_freefem and have_freefem:
        knowledge = exact.knowledge(problem, path)
        found, old = freefem_chart.runs(problem, mesh, by_freefem, min(turns, 3), folder, knowledge, against)
        rows += found
        say(f"  {problem} {mesh_name(mesh)}: FreeFEM, {len(found)} methods" + (", kept" if old else ""), start)
    return list(completed(rows, problem, mesh, table))


def progress(text, start=None):
    print(text + (f" ({time.perf_counter() - start:.1f} s)" if start else ""), flush=True)


def measure(output, quick, say=progress):
    """Writes chart.csv and chart.json into the folder; returns the rows and the table of chart.json."""
    start, folder = time.perf_counter(), output / ("runs_quick" if quick else "runs")
    have_freefem = freefem_chart.version() is not None
    if not have_freefem:
        say("FreeFem++ is not on the PATH: its curves are left out (./dev setup installs it)")
    table, path, old = reference.reference(folder, quick)
    say("reference of parabola_1" + (", kept" if old else ""), start)
    rows, said = [], {}
    for level in range(LEVELS["quick" if quick else "full"]):
        for problem in PROBLEMS:
            rows += measure_mesh(problem, level, quick, folder, table, path, have_freefem, said, say)
    order = list(PROBLEMS)
    rows.sort(key=lambda row: order.index(row["problem"]))
    launch.write_csv(output / "chart.csv", rows)
    shares = [row["s_wall"] / row["s_total"] for row in rows if row["s_wall"] and row["s_total"] > 0.01]
    waiting = statistics.median(shares) if shares else None
    about = {
        **{"machine": machine(), "wall_over_processor": waiting, "seconds": time.perf_counter() - start},
        **{"reference": table, "left_out": said, "quick": quick},
    }
    chart_runs.write_json(output / "chart.json", about)
    say(f"{len(rows)} rows in {output}/chart.csv", start)
    return rows, about
