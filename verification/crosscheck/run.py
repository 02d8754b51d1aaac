"""Both programs on one mesh: gmsh's mesh through mortise, its conversion, the two solutions, the time of each."""

import json
import os
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import meshio

import contact_points
import convert
import scene as scenes
from cases import CaseError

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import launch

SCRIPTS = {"bilateral": launch.ROOT / "freefem/mortar.edp", "unilateral": launch.ROOT / "freefem/active_set.edp"}
SCRIPT = SCRIPTS["bilateral"]
RESULTS = ("result.vtu", "contact.csv", "summary.json")


class MissingProgram(Exception):
    """A program that is not there, with how to get it."""


@dataclass(frozen=True)
class Programs:
    mortise: Path
    freefem: str


@dataclass
class Solved:
    """What one step left in its folder."""

    folder: Path
    bodies: list  # convert.Body, first the multiplier side's
    body_numbers: list  # of these bodies in mortise's results
    status: str  # of mortise, as in summary.json
    mortise_seconds: float  # whole process
    freefem_seconds: float


def find_freefem():
    return shutil.which("FreeFem++")


def find_programs():
    """mortise (the environment variable MORTISE, or the release build) and FreeFem++ (on the PATH)."""
    try:
        mortise, freefem = launch.need(launch.MORTISE), find_freefem()
    except launch.MortiseError as error:
        raise MissingProgram(error) from error
    if freefem is None:
        raise MissingProgram("FreeFem++ is not on the PATH: ./dev setup installs it, or apt-get install freefem++")
    return Programs(mortise, freefem)


def last_lines(text, count=6):
    return "\n".join(text.strip().splitlines()[-count:])


def run_program(command, expected=(0,), **options):
    """Runs a program; returns its seconds and its output, CaseError with its last lines if it fails."""
    start, name = time.perf_counter(), Path(command[0]).name
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True, "errors": "replace"}
    try:
        done = subprocess.run(list(map(str, command)), timeout=launch.TIME_LIMIT, check=False, **pipes, **options)
    except subprocess.TimeoutExpired as late:
        raise CaseError(f"{name} did not end within {launch.TIME_LIMIT} s") from late
    seconds = time.perf_counter() - start
    if done.returncode not in expected:
        raise CaseError(f"{name}: exit status {done.returncode}\n{last_lines(done.stdout)}")
    return seconds, done.stdout


def expect_files(paths, program, output):
    for path in paths:
        if not path.is_file():
            raise CaseError(f"{program} wrote no {path.name}\n{last_lines(output)}")


def make_mesh(programs, scene_file, sizes, parameters, path):
    overrides = {f"mesh.parameters.{key}": value for key, value in {**parameters, **sizes}.items()}
    run_program([programs.mortise, "mesh", scene_file, *launch.options(overrides), "-o", path])


def contact_settings(step):
    """Gap and normals as a step says; its gap "curve" is mortise's default, with the normals of the curve."""
    return {} if step.gap == "curve" else {"contact.initial_gap": step.gap, "method.normals": "edges"}


def solve_by_mortise(programs, scene_file, mesh_file, step, folder):
    """mortise on the mesh as it lies in the file; its physics are the scene's own."""
    overrides = {
        "mesh.file": mesh_file.absolute(),
        "mesh.parameters": "{}",
        "contact.multipliers_on": step.side,
        "contact.condition": step.condition,
        "method.multipliers": step.mortise["multipliers"],
        "method.integration": step.mortise["integration"],
        **contact_settings(step),
    }
    command = [programs.mortise, "solve", scene_file, *launch.options(overrides), "-o", folder, "--quiet"]
    seconds, output = run_program(command, launch.SOLVED)
    expect_files([folder / name for name in RESULTS], "mortise", output)
    return seconds


def freefem_environment():
    """FreeFEM's own variables, where the user has not set them: its modules, and the scripts to include."""
    return {"FF_LOADPATH": "/usr/lib/freefem++", "FF_INCLUDEPATH": str(SCRIPT.parent), **os.environ}


def solve_by_freefem(programs, case_file, script=SCRIPT):
    """FreeFEM's results lie beside the case file."""
    folder = case_file.parent
    for old in folder.glob("freefem_*.txt"):
        old.unlink()
    command = [programs.freefem, "-nw", "-v", "0", script, "-case", case_file]
    seconds, output = run_program(command, cwd=folder, env=freefem_environment())
    names = ("multiplier", "opposite", "contact", "summary")
    expect_files([folder / f"freefem_{name}.txt" for name in names], "FreeFem++", output)
    return seconds


def convert_step(step, scene, mesh_file, folder):
    """The two medit files, case.txt and its points; returns the bodies and their numbers in mortise's results."""
    mesh = meshio.read(mesh_file, file_format="gmsh")  # of itself it tries another reader first, and prints
    bodies, tags = convert.read_bodies(mesh, scene["bodies"]), convert.curve_tags(mesh)
    contact_tags = [tags[step.side], tags[scenes.opposite_side(scene, step.side)]]
    names, files = [convert.body_of_curve(bodies, tag) for tag in contact_tags], ["multiplier.mesh", "opposite.mesh"]
    for name, file in zip(names, files):
        convert.write_medit(bodies[name], folder / file)
    (folder / "case.txt").write_text(scenes.case_text(scene, names, files, contact_tags, tags, step.freefem, step.gap))
    if step.gap == "curve":
        of_bodies = [bodies[name] for name in names]
        contact_points.write(of_bodies, contact_tags, step.freefem["gauss"], folder / scenes.POINTS)
    order = convert.body_order(mesh, scene["bodies"])
    return [bodies[name] for name in names], [order.index(name) for name in names]


def prepare(programs, step, folder):
    """Mesh and converted mesh of a step; returns the scene file, the mesh file, the bodies and their numbers."""
    folder.mkdir(parents=True, exist_ok=True)
    scene_file, mesh_file = launch.scene_file(step.scene), folder / "mesh.msh"
    scene = scenes.read_scene(scene_file)
    make_mesh(programs, scene_file, scenes.size_parameters(scene, step.mesh), step.mesh_parameters, mesh_file)
    return scene_file, mesh_file, *convert_step(step, scene, mesh_file, folder)


def solve_step(programs, step, folder):
    """Everything of one step: mesh, conversion, both solutions."""
    scene_file, mesh_file, bodies, numbers = prepare(programs, step, folder)
    mortise_seconds = solve_by_mortise(programs, scene_file, mesh_file, step, folder / "mortise")
    freefem_seconds = solve_by_freefem(programs, (folder / "case.txt").absolute(), SCRIPTS[step.condition])
    return Solved(folder, bodies, numbers, mortise_summary(folder)["status"], mortise_seconds, freefem_seconds)


def mortise_summary(folder):
    return json.loads((folder / "mortise/summary.json").read_text())


def freefem_summary(folder):
    """Key and value of each line of freefem_summary.txt."""
    lines = (folder / "freefem_summary.txt").read_text().split("\n")
    return {key: float(value) for key, value in (line.split() for line in lines if line.strip())}
