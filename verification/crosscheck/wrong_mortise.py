#!/usr/bin/python3
"""Stands in for mortise and gives a wrong result. For test_runner.py alone.

Everything goes to the real executable (environment variable RIGHT_MORTISE); of `solve` the variable WRONG changes

  poisson   Poisson's ratio, by 1e-4
  segment   the mesh: the last edge of the opposite curve is missing, so that nothing faces the multiplier side there.
            Where this edge lies within one edge of the multiplier side, exactly one segment is dropped.
  normal    the results: replaced by those of a system in which the normal of one contact point is flipped. mortise has
            no way in for this, so the system is FreeFEM's (which has the same solution if nothing is flipped).
            summary.json stays, so the energy is the right one
  results   the results: replaced by the files in the folder WRONG_RESULTS
  handed_normal, handed_gap
            nothing of mortise: FreeFEM's file of contact points, before FreeFEM reads it. One normal flipped; all gaps
            with the other sign
"""

import csv
import os
import shutil
import subprocess
import sys
from pathlib import Path

import meshio
import numpy as np
from scipy.spatial import cKDTree

import contact_points
import run
import scene

FLIP = "{ int wrong = points / 3; nx[wrong] = -nx[wrong]; ny[wrong] = -ny[wrong]; }"


def setting(arguments, key):
    return next(word.split("=", 1)[1] for word in arguments if word.startswith(key + "="))


def drop_last_edge(mesh_file, curve, path):
    """Copies a mesh without the edge of a curve that ends farthest to the right."""
    mesh = meshio.read(mesh_file, file_format="gmsh")
    tag, blocks, data = mesh.field_data[curve][0], [], {"gmsh:physical": [], "gmsh:geometrical": []}
    for number, block in enumerate(mesh.cells):
        keep = np.ones(len(block.data), dtype=bool)
        if block.type.startswith("line") and (mesh.cell_data["gmsh:physical"][number] == tag).all():
            keep[np.argmax(mesh.points[block.data[:, :2], 0].mean(axis=1))] = False
        blocks.append((block.type, block.data[keep]))
        for key, entries in data.items():
            entries.append(mesh.cell_data[key][number][keep])
    copy = meshio.Mesh(mesh.points, blocks, cell_data=data, field_data=mesh.field_data)
    meshio.write(path, copy, file_format="gmsh22", binary=False)


def without_last_edge(arguments):
    """The arguments with another mesh file."""
    mesh_file, side = Path(setting(arguments, "mesh.file")), setting(arguments, "contact.multipliers_on")
    opposite = {"upper_contact": "lower_contact", "lower_contact": "upper_contact"}[side]
    wrong_file = mesh_file.with_name("wrong.msh")
    drop_last_edge(mesh_file, opposite, wrong_file)
    return [word.replace(str(mesh_file), str(wrong_file)) for word in arguments]


def solve_with_flipped_normal(case_folder):
    """A copy of the case, solved by FreeFEM with one normal flipped; returns its folder."""
    folder = case_folder / "flipped"
    folder.mkdir()
    for name in ("case.txt", "multiplier.mesh", "opposite.mesh"):
        shutil.copy(case_folder / name, folder)
    text, include = run.SCRIPT.read_text(), 'include "contact.idp"'
    assert text.count(include) == 1
    (folder / "flipped.edp").write_text(text.replace(include, f"{include}\n{FLIP}"))
    command = [run.find_freefem(), "-nw", "-v", "0", "flipped.edp", "-case", str(folder / "case.txt")]
    run.run_program(command, cwd=folder, env=run.freefem_environment())
    return folder


def replace_results(results, wrong):
    """Puts FreeFEM's displacements and pressures into mortise's files."""
    mesh = meshio.read(results / "result.vtu")
    u = mesh.point_data["displacement"]
    half = [np.loadtxt(wrong / f"freefem_{side}.txt") for side in ("multiplier", "opposite")]
    for block, body in zip(mesh.cells, mesh.cell_data["body"]):
        for number in np.unique(body):
            nodes = np.unique(block.data[body == number])
            far = [cKDTree(table[:, :2]).query(mesh.points[nodes, :2]) for table in half]
            chosen = int(far[1][0].max() < far[0][0].max())
            u[nodes, :2] = half[chosen][far[chosen][1], 2:]
    meshio.write(results / "result.vtu", mesh)
    with open(results / "contact.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    at, p = np.split(np.loadtxt(wrong / "freefem_contact.txt")[:, :3], [2], axis=1)
    for row in rows:
        distance, number = cKDTree(at).query([float(row["x"]), float(row["y"])])
        if distance < 1e-10:
            row["p"] = repr(float(p[number, 0]))
    with open(results / "contact.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)


def spoil_points(path, wrong):
    """Flips one normal, or all gaps, in FreeFEM's file of contact points."""
    points = np.loadtxt(path, skiprows=1)
    if wrong == "handed_normal":
        points[len(points) // 3, 3:5] *= -1
    else:
        points[:, 7] *= -1
    contact_points.save(points, path)


def main(arguments):
    wrong, solving = os.environ["WRONG"], arguments[0] == "solve"
    if solving and wrong == "poisson":
        arguments = [*arguments, "--set", "materials.steel.poisson=0.3001"]
    if solving and wrong == "segment":
        arguments = without_last_edge(arguments)
    status = subprocess.run([os.environ["RIGHT_MORTISE"], *arguments], check=False).returncode
    results = Path(arguments[arguments.index("-o") + 1])
    if solving and wrong == "normal":
        replace_results(results, solve_with_flipped_normal(Path(setting(arguments, "mesh.file")).parent))
    if solving and wrong.startswith("handed_"):
        spoil_points(Path(setting(arguments, "mesh.file")).with_name(scene.POINTS), wrong)
    if solving and wrong == "results":
        shutil.copytree(os.environ["WRONG_RESULTS"], results, dirs_exist_ok=True)
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
