#!/usr/bin/python3
"""mortise beside FreeFEM and GetFEM: whole processes on the same meshes of parabola_1, in turns.

Seconds are of the processor, one thread, and hold everything but the making of the mesh file; memory is the process's
peak. The error is that of p in L2 without a tenth of the line at each end, against mortise's own p on a graded mesh of
its own; programs that are missing are left out, aloud. Written are OUT/performance.csv (a row a program and mesh) and
performance.md; the runs are kept in OUT/runs. --docs writes docs/performance.md.
"""

import math
import os
import statistics
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.with_name("common")))

import launch  # makes src/python/pictures known
import figure
import numpy as np
import page
import parabola_mesh
import programs
import runs
import template

NAMES = ("mortise", "FreeFEM", "GetFEM")
EVEN = (8, 20, 40, 80, 160, 320, 416, 832)  # elements on the upper plate; 5/4 of it on the lower one
GRADED = (8, 16, 32, 64, 128, 256)
LARGEST = {"mortise": 832, "FreeFEM": 320, "GetFEM": 320}
GRADES = ("mortise", "FreeFEM")  # GetFEM finds no points across the line in elements 100 times as wide as high
REFERENCE = 384  # columns of both plates
ASKED = ("5%", "1%", "0.3%", "0.1%", "0.03%", "0.01%", "0.003%")
ERRORS = (4e-3, 8e-4, 2e-4, 5e-5)
GRADING = 3
INNER = np.linspace(0.08, 0.72, 20001)


def turns_of(size):
    return 5 if size <= 80 else 3 if size <= 160 else 1


def solve_in_turns(run, folder):
    """Rows of the programs on one mesh, medians of some turns."""
    sizes, grading, names = run["sizes"], run["grading"], run["names"]
    programs.prepare(folder, sizes, grading, names)
    rows = {name: [] for name in names}
    for _ in range(run["turns"]):
        for name in names:
            rows[name].append(programs.measured(programs.command(name, folder, sizes)))
    return {name: row_of(found, programs.unknowns(name, sizes), name, folder) for name, found in rows.items()}


def row_of(found, unknowns, name, folder):
    """Medians of what the meter has found in some turns, and what they solved."""
    medians = {key: statistics.median(turn[key] for turn in found) for key in found[0]}
    return {**medians, "unknowns": unknowns, "pressure": of_inner(*programs.pressure(name, folder))}


def of_inner(x, p):
    return np.interp(INNER, x, p).tolist()


def in_a_folder(work):
    def done(run):
        with tempfile.TemporaryDirectory() as folder:
            return work(run, Path(folder) / "run")

    return done


def solve_asked(run, folder):
    """One run of mortise by --accuracy from the .geo, the loop over meshes and all."""
    words = [launch.need(launch.MORTISE), "solve", launch.scene_file("parabola_1"), "--accuracy", run["asked"]]
    found = [programs.measured([*words, "-o", folder / "out", "--quiet", "--threads", 1]) for _ in range(5)]
    unknowns = launch.summary(folder / "out")["mesh"]["dofs"]
    return row_of(found, unknowns, "mortise", folder)


def solve_by_threads(run, folder):
    """Wall seconds on one thread and on two, in turns."""
    programs.prepare(folder, run["sizes"], 1, ())
    walls = {1: [], 2: []}
    for _ in range(3):
        for threads, of in walls.items():
            of.append(programs.measured(programs.command("mortise", folder, run["sizes"], threads))["wall"])
    return {str(threads): statistics.median(of) for threads, of in walls.items()}


def error_of(p, reference):
    p, reference = np.array(p), np.array(reference)
    return float(np.sqrt(np.sum((p - reference) ** 2) / np.sum(reference**2)))


def seconds_at(error, points):
    """Of the quickest way to an error: a power law between two meshes, beyond the coarsest its own seconds."""
    points, best = sorted(points, reverse=True), math.inf
    if points and error >= points[0][0]:
        return points[0][1]
    for (e0, s0), (e1, s1) in zip(points, points[1:]):
        if e1 <= error <= e0:
            best = min(best, math.exp(np.interp(-math.log(error), [-math.log(e0), -math.log(e1)], np.log([s0, s1]))))
    return best


def measure(store, quick, names):
    """Rows {program, mesh, grading, ...}."""
    both = lambda n: (n, round(1.25 * n))
    wanted = [(both(n), 1) for n in EVEN[: 3 if quick else None]]
    wanted += [(both(n), GRADING) for n in GRADED[: 3 if quick else None]]
    columns = REFERENCE // (4 if quick else 1)
    on = lambda sizes, grading, by: {"sizes": sizes, "grading": grading, "turns": turns_of(sizes[0]), "names": by}
    finest = store.row(on((columns, columns), GRADING, ["mortise"]), in_a_folder(solve_in_turns), "reference")
    reference, rows = finest["mortise"]["pressure"], []

    def add(program, mesh, way, found):
        error = error_of(found.pop("pressure"), reference)
        rows.append({"program": program, "way": way, "mesh": mesh, "error": error, **found})

    for sizes, grading in wanted:
        by = [name for name in names if sizes[0] <= LARGEST[name] and (grading == 1 or name in GRADES)]
        found = store.row(on(sizes, grading, by), in_a_folder(solve_in_turns), "mesh")
        for name in by:
            add(name, launch.mesh_name(sizes), "even" if grading == 1 else "graded", found[name])
        print(f"  {launch.mesh_name(sizes)}, grading {grading}", flush=True)
    for asked in ASKED[: 2 if quick else None]:
        add("mortise", f"asked {asked}", "asked", store.row({"asked": asked}, in_a_folder(solve_asked), "asked"))
    return rows


def draw(rows, folder):
    drawing, (by_size, by_error) = figure.panels(1, 2, (10, 4.6))
    marks = {"even": "o-", "graded": "s--", "asked": "^:"}
    for colour, name in zip(("#1f5fa8", "#c0392b", "#2e8b57"), NAMES):
        of = [row for row in rows if row["program"] == name]
        if not of:
            continue
        even = [(row["unknowns"], row["seconds"]) for row in of if row["way"] == "even"]
        figure.curve(by_size, even, color=colour, label=name)
        for way, style in marks.items():
            points = [(row["seconds"], row["error"]) for row in of if row["way"] == way]
            if points:
                label = f"{name}, " + {"asked": "--accuracy"}.get(way, f"{way} meshes")
                figure.curve(by_error, points, style, color=colour, label=label)
    figure.label(by_size, "unknowns", "processor seconds, whole process", log="xy", legend=True)
    figure.label(by_error, "processor seconds, whole process", "error in p", log="xy", legend=True)
    figure.save(drawing, folder / "performance.png")


def texts(rows, threads):
    """What the page's template asks for."""
    number = lambda row: f"{row['unknowns']}: {row['seconds']:.2g} s, {row['megabytes']:.0f} MB, {row['error']:.1e}"
    at = {(row["program"], row["way"], row["mesh"]): row for row in rows}
    present = [name for name in NAMES if any(row["program"] == name for row in rows)]
    lines = {way: [] for way in ("even", "graded")}
    for way, table in lines.items():
        for mesh in dict.fromkeys(row["mesh"] for row in rows if row["way"] == way):
            by = [at.get((name, way, mesh)) for name in present]
            table.append([mesh, *(number(row) if row else "–" for row in by)])
    equal = []
    for error in ERRORS:
        best = {}
        for name in present:
            ways = {row["way"] for row in rows if row["program"] == name}
            points = lambda way: [(row["error"], row["seconds"]) for row in rows
                                  if row["program"] == name and row["way"] == way]  # fmt: skip
            best[name] = {way: seconds_at(error, points(way)) for way in sorted(ways)}
        show = lambda ways: "; ".join(f"{way} {s:.2g}" for way, s in ways.items() if math.isfinite(s)) or "not reached"
        peers = [min(best[name].values()) for name in present[1:]]
        ratio = min(peers, default=math.inf) / min(best["mortise"].values())
        equal.append([f"{error:.0e}", *(show(best[name]) for name in present),
                      f"{ratio:.1f}" if math.isfinite(ratio) else "–"])  # fmt: skip
    asked = [[row["mesh"].removeprefix("asked "), f"{row['error']:.1e}", row["unknowns"], f"{row['seconds']:.2g}"]
             for row in rows if row["way"] == "asked"]  # fmt: skip
    return {
        "even": template.table(["mesh", *present], lines["even"]),
        "graded": template.table(["mesh", *present], lines["graded"]),
        "equal": template.table(["error in p", *present, "quickest other / mortise"], equal),
        "asked": template.table(["asked", "error in p", "unknowns", "seconds"], asked),
        "threads": template.table(["mesh", "one thread, s", "two", "ratio"], threads),
    }


def main(arguments=None):
    options = launch.command_line(__doc__, "performance", arguments, jobs=False, docs=True)
    versions = {name: programs.version(name) for name in NAMES}
    names = [name for name in NAMES if versions[name]]
    for name in set(NAMES) - set(names):
        print(f"{name} is not installed: left out")
    depends = [__file__, programs.__file__, parabola_mesh.__file__, HERE / "getfem_plates.py", launch.need(launch.MORTISE)]
    store = runs.Store(options.output / "runs", depends)
    rows = measure(store, options.quick, names)
    threads = []
    for n in (80,) if options.quick else (80, 160, 416):
        sizes = (n, round(1.25 * n))
        of = store.row({"sizes": sizes}, in_a_folder(solve_by_threads), "threads")
        threads.append([launch.mesh_name(sizes), *(f"{of[key]:.2g}" for key in "12"), f"{of['1'] / of['2']:.2f}"])
    launch.write_csv(options.output / "performance.csv", rows)
    draw(rows, options.output)
    said = "; ".join(f"{name} {version}" if name != "mortise" else version for name, version in versions.items() if version)
    load = f"{os.getloadavg()[0]:.1f}"
    text = template.fill((HERE / "performance.md").read_text(), versions=said, cores=os.cpu_count(), load=load,
                         **texts(rows, threads))  # fmt: skip
    page.write(options.output, "performance", text, options.docs)
    print(f"{options.output}/performance.md")


if __name__ == "__main__":
    main()
