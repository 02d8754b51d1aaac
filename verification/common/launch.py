"""Runs of mortise: many of one scene at once, or one with its results."""

import argparse
import csv
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "src/python/pictures"))  # what mortise itself draws with: figure, result_tables

from result_tables import columns, contact, read_csv  # noqa: F401
MORTISE = Path(os.environ.get("MORTISE", ROOT / "build/release/mortise")).absolute()
YOUNG = 210e9  # of the lower body, in the scenes' units
SOLVED = (0, 2)  # exit status: 2 is a check that fails, or no convergence, with the results written
TIME_LIMIT = 1800  # seconds for one call
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}  # environment of runs that are timed


class StudyError(Exception):
    """What stops a study, or one case of it: a program that is not there or fails, with what it said; bad input."""


def command_line(description, name, arguments=None, names=None, jobs=True, docs=False):
    """The command line of a study: -o (default: out/NAME), --quick; --jobs, unless seconds are measured; --only, for
    studies that have parts called `names`; --docs, for those that write a page there."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, default=Path("out") / name, help=f"folder (default: out/{name})")
    parser.add_argument("--quick", action="store_true", help="a part of it, in a minute or two")
    if jobs:
        parser.add_argument("--jobs", type=int, default=1, metavar="N", help="runs at once (default: 1)")
    if names:
        parser.add_argument("--only", nargs="+", choices=names, default=[], metavar="NAME", help=", ".join(names))
    if docs:
        parser.add_argument("--docs", action="store_true", help=f"also write docs/{name}.md and its pictures")
    options = parser.parse_args(arguments)
    if docs and options.docs and (options.quick or names and options.only):
        parser.error("--docs needs the study in full")
    return options


def need(program):
    """The program, or StudyError if it is not there."""
    if not program.is_file():
        raise StudyError(f"{program} is missing: ./dev build makes it, or MORTISE names another")
    return program


def run(command, expected=SOLVED, **options):
    """Runs a program: what subprocess.run gives of it, and its seconds. StudyError with its last lines where its exit
    status is not expected."""
    command, start = [str(word) for word in command], time.perf_counter()
    pipes = {"capture_output": True, "text": True, "errors": "replace", "timeout": TIME_LIMIT, "check": False}
    try:
        done = subprocess.run(command, **pipes, **options)
    except subprocess.TimeoutExpired as late:
        raise StudyError(f"{' '.join(command)}: not ended within {TIME_LIMIT} s") from late
    seconds = time.perf_counter() - start
    if done.returncode not in expected:
        said = "\n".join((done.stdout + done.stderr).strip().splitlines()[-6:])
        raise StudyError(f"{' '.join(command)}: exit status {done.returncode}\n{said}")
    return done, seconds


def processor_seconds():
    """Of all programs that were called so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def call(*arguments, expected=SOLVED):
    """Runs mortise, or says why it did not run; returns its seconds."""
    return run([need(MORTISE), *arguments], expected)[1]


def scene_file(name):
    """Of a scene of geo/, or of the cross-check's own; a path is one already."""
    if isinstance(name, Path):
        return name
    own = ROOT / f"verification/crosscheck/scenes/{name}.toml"
    return own if own.exists() else ROOT / f"geo/{name}.toml"


def options(settings):
    """--set KEY=VALUE for each setting."""
    return [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]


def sizes(mesh):
    """Elements along the contact line of the upper and of the lower body."""
    return {"mesh.parameters.n_upper": mesh[0], "mesh.parameters.n_lower": mesh[1]}


def mesh_name(mesh):
    return "x".join(map(str, mesh))


def stiffness(ratio):
    """An upper body `ratio` times as stiff as the lower one."""
    return {"materials.other": f"{{ young = {YOUNG * ratio!r}, poisson = 0.3 }}", "bodies.upper": "other"}


def solve(scene, settings, folder, *words, expected=SOLVED):
    """Solves geo/SCENE.toml, or the scene file at a path, into a folder; returns the table of summary.json. `words`: more
    of the command line."""
    call("solve", scene_file(scene), *options(settings), "-o", folder, "--quiet", *words, expected=expected)
    return summary(folder)


def summary(folder):
    """The table of summary.json of a folder of results."""
    return json.loads((Path(folder) / "summary.json").read_text())


def measured(text, measure, settings=None):
    """Of the scene with this text: `failed`, why it is not solved or "", and what measure(folder, summary) finds in its
    results, if there are any."""
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder) / "scene.toml"
        scene.write_text(text)
        try:
            table = solve(scene, settings or {}, scene.with_name("out"))
        except StudyError as error:
            return {"failed": str(error)}
        failed = "" if table["status"] == "solved" else table["status"]
        return {"failed": failed} | measure(scene.with_name("out"), table)


def sweep(scene, settings, vary):
    """The rows of `mortise sweep`: one dictionary a run. `vary`: key and its values."""
    words = [w for key, values in vary.items() for w in ("--vary", f"{key}={','.join(str(v) for v in values)}")]
    with tempfile.TemporaryDirectory() as folder:
        table = Path(folder) / "sweep.csv"
        call("sweep", scene_file(scene), *options(settings), *words, "-o", table, "--quiet")
        return read_csv(table)


def write_csv(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)
