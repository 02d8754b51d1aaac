#!/usr/bin/python3
"""p of a scene by FreeFEM (freefem/active_set.edp) on a mesh of mortise's, for studies and for `mortise certify`.

Usage: on_mesh.py SCENE MESH FOLDER CURVES [KEY=VALUE...]: FOLDER/freefem_contact.txt has p where the multipliers on CURVES
(in the order of the scene's entries, between commas) lie; with mortise's --set.
"""

import sys
import tomllib
from pathlib import Path

import meshio
import numpy as np

import run  # makes common/ known
import scene as scenes
from cases import Step, StudyError

METHOD = {"multipliers": "linear", "integration": "segments", "gauss": 5}


def line(scene, mesh, curves, folder):
    """Rows: pair, x, y, p, weighted gap, a fluid's part of p. Straight sides; P2 on 6-node triangles or two of each quadrilateral, P1 on
    linear cells; gaps and segments as of the cross-check. StudyError where FreeFEM has no such model."""
    entries = [entry for _, entry in scenes.contacts(scene)]
    for entry in entries:
        scenes.refuse_others(entry, {"between", "condition", "fluid", "initial_gap", "multipliers_on", "stiffness", "within"})
    sides = {entry["between"].index(on) if on in entry["between"] else None for entry, on in zip(entries, curves)}
    gaps = {entry.get("initial_gap", "curve") for entry in entries}
    conditions = {entry.get("condition", "unilateral") for entry in entries}
    if unknown := conditions - run.SCRIPTS.keys():
        raise StudyError(f'FreeFEM is not told condition = "{unknown.pop()}"')
    if len(sides) > 1 or None in sides or len(gaps) > 1 or len(conditions) > 1:
        raise StudyError("pairs of several kinds, or multipliers on other curves in each")
    order = 1 if {"triangle", "quad"} & {cells.type for cells in meshio.read(mesh, file_format="gmsh").cells} else 2
    (gap,), (condition,) = gaps, conditions
    side, gap = scenes.SIDES[sides.pop()], gap if gap == "curve" else "scene"
    springs = {"springs": 1e-6} if any(map(scenes.is_cut, scene["contact"])) else {}  # sectors may turn about the origin
    step = Step(mesh.stem, (), side, {}, {}, METHOD | {"order": order} | springs, condition, gap, same_nodes=False)
    run.convert_step(step, scene, mesh, folder)
    run.call_freefem(run.SCRIPTS[condition], folder=folder)
    return np.loadtxt(folder / "freefem_contact.txt", ndmin=2)


def main():
    scene, mesh, folder, curves, *changes = sys.argv[1:]
    values = dict(change.split("=", 1) for change in changes)
    settings = {key: tomllib.loads(f"value = {value}")["value"] for key, value in values.items()}
    try:
        run.need_programs()
        line(scenes.read_scene(Path(scene), settings), Path(mesh), curves.split(","), Path(folder))
    except (StudyError, OSError, ValueError, KeyError, TypeError) as error:
        words = f"{type(error).__name__ * (not isinstance(error, StudyError))} {error}".strip().splitlines()
        own = [line for line in words if not line.strip().startswith(("current line", "exit(", "err code"))]  # FreeFEM's last lines
        sys.exit((own or words)[-1])


if __name__ == "__main__":
    main()
