"""Both programs on one mesh: gmsh's mesh through mortise, its conversion, the two solutions, the time of each."""

import os
import shutil
from dataclasses import dataclass
from pathlib import Path

import meshio

import cases  # makes common/ known
import contact_points
import convert
import launch
import scene as scenes
from expressions import Quantities
from launch import StudyError

SCRIPTS = {"bilateral": launch.ROOT / "freefem/mortar.edp", "unilateral": launch.ROOT / "freefem/active_set.edp"}


@dataclass
class Solved:
    """What one step left in its folder."""

    folder: Path
    bodies: list  # convert.Body, in mortise's order
    pairs: list  # scene.Side of the multiplier side and of the opposite side of each
    status: str  # of mortise, as in summary.json
    mortise_seconds: float  # whole process
    freefem_seconds: float


def find_freefem():
    return shutil.which("FreeFem++")


def need_programs():
    """StudyError where mortise or FreeFem++ is not there."""
    launch.need(launch.MORTISE)
    if find_freefem() is None:
        raise StudyError("FreeFem++ is not on the PATH: ./dev setup installs it, or apt-get install freefem++")


def make_mesh(scene_file, sizes, parameters, path):
    overrides = {f"mesh.parameters.{key}": value for key, value in {**parameters, **sizes}.items()}
    launch.call("mesh", scene_file, *launch.options(overrides), "-o", path)


def contact_settings(step):
    """Gap and normals as a step says; its gap "curve" is mortise's default, with the normals of the curve."""
    gap = {} if step.gap in ("curve", "scene") else {"contact.initial_gap": step.gap}
    return gap if step.gap == "curve" else {**gap, "method.normals": "edges"}


def of_each_contact(scene, settings):
    """Settings of all contact, entry by entry: the cuts of a sector have none of them."""
    numbers = [k for k, _ in scenes.contacts(scene)]
    return {key.replace("contact.", f"contact.{k}."): value for key, value in settings.items() for k in numbers}


def inline(value):
    """A value as TOML, in a line."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {inline(entry)}" for key, entry in value.items()) + " }"
    return value


def settings_of(step, mesh_file):
    """mortise's, on the mesh as it lies in the file; its physics are the scene's and the step's."""
    scene = scenes.read_scene(launch.scene_file(step.scene), {})
    return {
        **{key: inline(value) for key, value in step.settings.items()},
        "mesh.file": mesh_file.absolute(),
        "mesh.parameters": "{}",
        **{f"contact.{k}.multipliers_on": scenes.multipliers_on(entry, step.side) for k, entry in enumerate(scene["contact"])},
        "method.multipliers": step.mortise["multipliers"],
        "method.integration": step.mortise["integration"],
        **of_each_contact(scene, {"contact.condition": step.condition, **contact_settings(step)}),
    }


def solve_by_mortise(scene_file, mesh_file, step, folder):
    """Returns its seconds."""
    options = launch.options(settings_of(step, mesh_file))
    return launch.call("solve", scene_file, *options, "-o", folder, "--quiet")


def call_freefem(script, *arguments, folder, expected=(0,)):
    """A script of freefem/ on the case in a folder, where its results will lie; returns its seconds."""
    for old in folder.glob("freefem_*.txt"):
        old.unlink()
    if (folder / scenes.EXPRESSIONS).exists():
        own_script = folder.absolute() / "case.edp"
        own_script.write_text(f'include "{scenes.EXPRESSIONS}"\ninclude "{script}"\n')
        script = own_script
    own = {"FF_LOADPATH": "/usr/lib/freefem++", "FF_INCLUDEPATH": launch.ROOT / "freefem"}  # unless the user says else
    words = ["-nw", "-v", "0", script, "-case", folder.absolute() / "case.txt", *arguments]
    return launch.run([find_freefem(), *words], expected, cwd=folder, env={**own, **os.environ})[1]


def convert_step(step, scene, mesh_file, folder):
    """The mesh, case.txt and its points; returns the bodies in mortise's order, and the contact pairs."""
    mesh = meshio.read(mesh_file, file_format="gmsh")  # of itself it tries another reader first, and prints
    bodies, tags = convert.read_bodies(mesh, scene["bodies"]), convert.curve_tags(mesh)
    pairs = list(scenes.contact_pairs(scene, step.side, bodies, tags))
    convert.write_mesh(list(bodies.values()), folder / scenes.MESH)
    of_pairs = [[side.tag for side in pair] for pair in pairs]
    values = Quantities()
    model = scene.get("model", {})
    areas = scenes.areas_of_curves(bodies, tags, model.get("plane"), float(model.get("thickness", 1)))
    text = scenes.case_text(scene, list(bodies), of_pairs, tags, step.freefem, step.gap, values, areas, step.side)
    (folder / "case.txt").write_text(text)
    (folder / scenes.EXPRESSIONS).unlink(missing_ok=True)
    if values.code:
        (folder / scenes.EXPRESSIONS).write_text(values.script())
    if step.gap == "curve":
        vertices = [[side.x for side in pair] for pair in pairs]
        contact_points.save(contact_points.points_of_pairs(vertices, step.freefem["gauss"]), folder / scenes.POINTS)
    return list(bodies.values()), pairs


def prepare(step, folder, change=lambda scene: scene):
    """Mesh and converted mesh of a step; returns the scene file, the mesh file, the bodies and the contact pairs.
    `change`: of the scene for FreeFEM."""
    folder.mkdir(parents=True, exist_ok=True)
    scene_file, mesh_file = launch.scene_file(step.scene), folder / "mesh.msh"
    scene = change(scenes.read_scene(scene_file, step.settings))
    make_mesh(scene_file, scenes.size_parameters(scene, step.mesh), step.mesh_parameters, mesh_file)
    return scene_file, mesh_file, *convert_step(step, scene, mesh_file, folder)


def solve_step(step, folder):
    """Everything of one step: mesh, conversion, both solutions."""
    scene_file, mesh_file, bodies, pairs = prepare(step, folder)
    mortise_seconds = solve_by_mortise(scene_file, mesh_file, step, folder / "mortise")
    freefem_seconds = call_freefem(SCRIPTS[step.condition], folder=folder)
    return Solved(folder, bodies, pairs, mortise_summary(folder)["status"], mortise_seconds, freefem_seconds)


def mortise_summary(folder):
    return launch.summary(folder / "mortise")


def freefem_summary(folder):
    """Key and value of each line of freefem_summary.txt."""
    lines = (folder / "freefem_summary.txt").read_text().split("\n")
    return {key: float(value) for key, value in (line.split() for line in lines if line.strip())}
