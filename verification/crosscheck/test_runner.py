"""The runner: what it says and its exit status, a case of each level from end to end, and that the comparison sees it
where one of the two programs has something wrong."""

import json

import meshio
import numpy as np
import pytest

import cases
import contact_points
import crosscheck
import launch
import run
import scene as scenes
from judge import judge

CASES = {
    "same_discretisation/shrink_fit/8x10/P2-P2/segments/outer_contact": "triangle6",
    "same_discretisation/patch_inclined/8x10/P1-P1/elements/lower_contact": "triangle",
    "same_problem/rings/12x15-24x30-48x60/inner_contact": "triangle",
}
CASE = "same_discretisation/parabola_1/8x10/P2-P1/segments/upper_contact"
OF_CURVES = CASE + "/curve"
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


@pytest.mark.parametrize("name", [CASE, OF_CURVES])
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


def normal(replace, folder):
    """The normal of one contact point is flipped in FreeFEM's system."""
    text, include, script = run.SCRIPTS["bilateral"].read_text(), 'include "contact.idp"', folder / "flipped.edp"
    assert text.count(include) == 1
    flip = "{ int wrong = points / 3; nx[wrong] = -nx[wrong]; ny[wrong] = -ny[wrong]; }"
    script.write_text(text.replace(include, f"{include}\n{flip}"))
    replace(run, "call_freefem", lambda old, _, **options: old(script, **options))


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
         (OF_CURVES, handed_gap, 1e-3)]  # fmt: skip


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
