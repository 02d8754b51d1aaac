"""Runs of the iterative solver, kept: a run whose rows are already in the output folder is not repeated."""

import hashlib
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import launch

SCENE = "parabola_1"


def executable():
    """A hash of the executable: another one makes all runs again."""
    if not launch.MORTISE.is_file():
        raise launch.MortiseError(f"{launch.MORTISE} is missing: ./dev build makes it, or MORTISE names another")
    return hashlib.sha256(launch.MORTISE.read_bytes()).hexdigest()[:16]


def kept(folder, key, make):
    """What make() gives, or gave for the same key and executable; both are JSON. Kept in folder/runs."""
    key = {"executable": executable(), **key}
    name = hashlib.sha256(json.dumps(key, sort_keys=True).encode()).hexdigest()[:20]
    path = folder / "runs" / f"{name}.json"
    if path.is_file():
        return json.loads(path.read_text())["rows"]
    rows = make()
    path.parent.mkdir(parents=True, exist_ok=True)
    staged = path.with_suffix(".part")
    staged.write_text(json.dumps({"key": key, "rows": rows}))
    staged.rename(path)
    return rows


def sweep(folder, settings, vary):
    """launch.sweep by the iterative solver, kept."""
    settings = {"method.solver": "mssor", **settings}
    key = {"scene": SCENE, "settings": settings, "vary": {k: list(map(str, v)) for k, v in vary.items()}}
    return kept(folder, key, lambda: launch.sweep(SCENE, settings, vary))


def name_of(mesh):
    return f"{mesh[0]}x{mesh[1]}"


def outcome(row):
    """converged, diverged or unfinished; a check that fails on a coarse mesh is none of these matters."""
    if row["status"] != "not_converged":
        return "converged"
    return "diverged" if row["iteration.convergence_rate"] > 1 else "unfinished"
