"""The runner: what it says and its exit status, a case of each level from end to end, and that the comparison sees it
where one of the two programs has something wrong."""

import dataclasses
import json

import meshio
import numpy as np
import pytest

import cases
import contact_points
import crosscheck
import launch
import on_mesh
import run
import scene as scenes
from cases import StudyError
from judge import judge

CASES = {
    "same_discretisation/shrink_fit/8x10/P2-P2/segments/outer_contact": "triangle6",
    "same_discretisation/patch_inclined/8x10/P1-P1/elements/lower_contact": "triangle",
    "same_problem/rings/12x15-24x30-48x60/inner_contact": "triangle",
}
CASE = "same_discretisation/parabola_1/8x10/P2-P1/segments/upper_contact"
OF_CURVES = CASE + "/curve"
WETTED = "same_discretisation/wetted/8x10/P1-P1/segments/block_top/unilateral"
SECTOR = "same_discretisation/sector/6x8/P2-P1/segments/second/unilateral"
MANUFACTURED = "same_discretisation/manufactured/8x10/P1-P1/segments/upper_contact"
FOUNDED = "same_discretisation/founded/8x10/P2-P1/segments/lower_contact/scene"
PIN = "same_discretisation/pin/20x28/P1-P1/segments/hole/unilateral/curve"
LIMIT = 1e-8


@pytest.mark.parametrize("name", CASES)
def test_a_case_from_end_to_end(freefem, capsys, tmp_path, name):
    assert crosscheck.main(["--case", name, "-o", str(tmp_path)]) == 0
    said = capsys.readouterr().out
    assert "[  1/1] ok" in said and "1 of 1 cases hold" in said
    (result,) = json.loads((tmp_path / "report.json").read_text())["results"]
    assert result["name"] == name and result["status"] == "ok" and all(figure["ok"] for figure in result["figures"])
    mesh = meshio.read(tmp_path / result["folder"] / "difference.vtu")
    assert mesh.cells[0].type == CASES[name]
    largest = np.linalg.norm(mesh.point_data["u_mortise"], axis=1).max()
    assert 0 < np.linalg.norm(mesh.point_data["difference"], axis=1).max() < 0.05 * largest


def test_list(capsys):
    assert crosscheck.main(["--list", "--quick", "--case", "*/rings/*"]) == 0
    assert "same_problem/rings/12x15-24x30-48x60/inner_contact" in capsys.readouterr().out.splitlines()


def test_what_is_missing_is_an_error_or_a_skip(monkeypatch, capsys, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(launch, "MORTISE", cases.TABLE)  # any file: it is not run
    assert crosscheck.main([]) == 1 and "apt-get install freefem++" in capsys.readouterr().err
    assert crosscheck.main(["--test"]) == 77 and capsys.readouterr().out.startswith("skipped")
    monkeypatch.setattr(launch, "MORTISE", tmp_path / "nothing")
    assert crosscheck.main([]) == 1 and "./dev build" in capsys.readouterr().err


def judged(name, folder):
    (case,) = cases.choose(cases.all_cases(), [name], quick=False)
    return judge(case, folder)


def test_a_program_that_fails_is_told_with_its_last_lines(freefem, monkeypatch, capsys, tmp_path):
    broken = tmp_path / "mortise"
    broken.write_text("#!/bin/sh\necho bad news >&2\nexit 3\n")
    broken.chmod(0o755)
    monkeypatch.setattr(launch, "MORTISE", broken)
    assert crosscheck.main(["--case", CASE, "-o", str(tmp_path)]) == 1
    said = capsys.readouterr().out
    assert "exit status 3" in said and "bad news" in said and f"error: {CASE}\n" in said


@pytest.mark.parametrize("name", [CASE, OF_CURVES, WETTED, SECTOR, MANUFACTURED, FOUNDED, PIN])
def test_the_right_result_passes(freefem, tmp_path, name):
    result = judged(name, tmp_path)
    assert result.status == "ok" and max(figure.value for figure in result.figures) <= LIMIT


# ---- Something wrong, in mortise or in FreeFEM: functions of the fixture that replaces, and a folder ----


def poisson(replace, folder):
    """Poisson's ratio off by 1e-4."""
    replace(run, "contact_settings", lambda old, step: {**old(step), "materials.steel.poisson": 0.3001})


def segment(replace, folder):
    """The last edge of the opposite curve is missing in mortise's mesh, so that nothing faces the multiplier side there.
    It lies within one edge of that: exactly one segment is dropped."""

    def without_last_edge(old, scene_file, mesh_file, step, results):
        mesh, wrong = meshio.read(mesh_file, file_format="gmsh"), folder / "wrong.msh"
        tag, data = mesh.field_data["lower_contact"][0], {"gmsh:physical": [], "gmsh:geometrical": []}
        for number, block in enumerate(mesh.cells):
            keep = np.ones(len(block.data), dtype=bool)
            if block.type.startswith("line") and (mesh.cell_data["gmsh:physical"][number] == tag).all():
                keep[np.argmax(mesh.points[block.data[:, :2], 0].mean(axis=1))] = False
            block.data = block.data[keep]
            for key, entries in data.items():
                entries.append(mesh.cell_data[key][number][keep])
        copy = meshio.Mesh(mesh.points, mesh.cells, cell_data=data, field_data=mesh.field_data)
        meshio.write(wrong, copy, file_format="gmsh22", binary=False)
        return old(scene_file, wrong, step, results)

    replace(run, "solve_by_mortise", without_last_edge)


def spoil(replace, folder, condition, part, line):
    """A line more behind a part of FreeFEM's script."""
    text, include, script = run.SCRIPTS[condition].read_text(), f'include "{part}"', folder / "spoilt.edp"
    assert text.count(include) == 1
    script.write_text(text.replace(include, f"{include}\n{line}"))
    replace(run, "call_freefem", lambda old, _, **options: old(script, **options))


def normal(replace, folder):
    """The normal of one contact point is flipped in FreeFEM's system."""
    flip = "{ int wrong = points / 3; nx[wrong] = -nx[wrong]; ny[wrong] = -ny[wrong]; }"
    spoil(replace, folder, "bilateral", "contact.idp", flip)


def fluid_on_one_side(replace, folder):
    """The fluid does not press on the opposite side."""
    spoil(replace, folder, "unilateral", "contact.idp", "wFluid = 0;")


def fluid_along_other_normals(replace, folder):
    """The fluid presses on the opposite side along the other one's normals."""
    spoil(replace, folder, "unilateral", "fluid.idp", "{ matrix sizes = [rowScale]; push = sizes * B; }")


def turn(replace, folder):
    """The displacement of a sector's cut is turned to the other side."""
    spoil(replace, folder, "unilateral", "contact.idp", "turn = -turn;")


def handed_normal(replace, folder):
    """One normal is flipped in FreeFEM's file of contact points."""

    def flipped(old, points, path):
        points[len(points) // 3, 3:5] *= -1
        old(points, path)

    replace(contact_points, "save", flipped)


def handed_gap(replace, folder):
    """Gaps of that file open by a micrometre along each edge."""
    replace(contact_points, "save", lambda old, points, path: old(points + np.outer(points[:, 1], 7 * [0] + [1e-6]), path))


WRONG = [(CASE, poisson, 1e-5), (CASE, segment, 1e-3), (CASE, normal, 1e-3), (OF_CURVES, handed_normal, 1e-3),
         (OF_CURVES, handed_gap, 1e-3), (WETTED, fluid_on_one_side, 1e-3), (WETTED, fluid_along_other_normals, 1e-3),
         (SECTOR, turn, 1e-3)]  # fmt: skip


@pytest.fixture
def replace(freefem, monkeypatch):
    """Replaces a module's function by new(old, ...)."""

    def put(module, name, new):
        old = getattr(module, name)
        monkeypatch.setattr(module, name, lambda *arguments, **options: new(old, *arguments, **options))

    return put


@pytest.mark.parametrize("name, wrong, least", WRONG)
def test_what_is_wrong_is_caught(replace, tmp_path, name, wrong, least):
    """By differences above the limit and of the size that the wrong input makes."""
    wrong(replace, tmp_path)
    result = judged(name, tmp_path)
    figures = {figure.name: figure.value for figure in result.figures}
    assert result.status == "failed", result.message
    assert min(figures["displacement"], figures["pressure"]) > LIMIT
    assert max(figures["displacement"], figures["pressure"]) > least


def test_a_sector_that_may_turn(freefem, tmp_path):
    """Nothing holds it from that, for `mortise certify`: p is even, that of whole rings that turn (Lame)."""
    (case,) = cases.choose(cases.all_cases(), [SECTOR], quick=False)
    run.prepare(case.steps[0], tmp_path)
    even = {"boundary.0.foundation": 1e10, "boundary.1.pressure": 2e7}
    p = on_mesh.line(scenes.read_scene(launch.scene_file("sector"), even), tmp_path / "mesh.msh", ["bore"], tmp_path)[:, 3]
    assert p == pytest.approx(5.714677e6, rel=0.01)


def test_what_freefem_has_no_rows_for_is_refused(replace, tmp_path):
    """A displacement on a cut that follows, a fluid whose line has two parts, and tied curves."""
    (case,) = cases.choose(cases.all_cases(), [SECTOR], quick=False)
    held = {"boundary.0.on": ["shaft_high"], "boundary.0.displacement": {"x": 0}}
    run.prepare(dataclasses.replace(case.steps[0], settings=held), tmp_path)
    with pytest.raises(StudyError, match="a displacement is prescribed on a cut that follows another"):
        run.call_freefem(run.SCRIPTS["unilateral"], folder=tmp_path)
    scene = scenes.read_scene(launch.scene_file("sector"), {"contact.1.condition": "tied"})
    with pytest.raises(StudyError, match='FreeFEM is not told condition = "tied"'):
        on_mesh.line(scene, tmp_path / "mesh.msh", ["seat"], tmp_path)
    parts = "{ int[int] two = [supported[0], supported[2]]; supported.resize(2); supported = two; }"
    spoil(replace, tmp_path, "unilateral", "system.idp", parts)
    assert "fluid: multipliers that face nothing lie between those that do" in judged(WETTED, tmp_path).message


def test_a_pair_that_one_program_does_not_know_is_told(replace, tmp_path):
    replace(scenes, "contact_pairs", lambda old, *arguments: list(old(*arguments))[1:])
    result = judged("same_discretisation/wall/3x3/P1-P1/segments/first/feti", tmp_path)
    assert result.status == "error" and "[('brick_0_1_left', 'brick_0_0_right')] is known to one program only" in result.message


def test_results_of_another_mesh_are_refused(replace, tmp_path):
    """Nodes that have no partner are an error, not a comparison of the nearest."""

    def on_another_mesh(old, scene_file, mesh_file, step, results):
        run.make_mesh(scene_file, {"n_upper": 10, "n_lower": 8}, step.mesh_parameters, mesh_file)
        return old(scene_file, mesh_file, step, results)

    replace(run, "solve_by_mortise", on_another_mesh)
    result = judged(CASE, tmp_path)
    assert result.status == "error" and "nodes in mortise" in result.message
