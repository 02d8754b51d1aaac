"""The three programs on one small mesh, and what the tables are made of."""

import math

import pytest

import performance
import programs
import stages


def solved(name, folder, grading=1):
    if not programs.version(name):
        pytest.skip(f"{name} is not installed")
    sizes = (32, 40)
    programs.prepare(folder, sizes, grading, [name])
    of = programs.measured(programs.command(name, folder, sizes))
    assert of["seconds"] > 0 and of["wall"] > 0 and of["megabytes"] > 1
    return performance.of_inner(*programs.pressure(name, folder))


@pytest.mark.parametrize("name", ["FreeFEM", "GetFEM"])
def test_programs_find_the_same_pressure(mortise, tmp_path, name):
    other = solved(name, tmp_path / "other")
    assert performance.error_of(solved("mortise", tmp_path / "mortise"), other) < 0.01


def test_programs_find_the_same_pressure_on_graded_meshes(mortise, tmp_path):
    graded = [solved(name, tmp_path / name, performance.GRADING) for name in ("mortise", "FreeFEM")]
    assert performance.error_of(*graded) < 0.005


def test_stages_beside_cholmod_and_of_a_wall(mortise):
    if not stages.CHOLMOD.is_file():
        pytest.skip(f"{stages.CHOLMOD} is missing: ./dev build makes it")
    mesh, unknowns, least, whole, ratio, *_ = stages.against_limit(40, 1, 1)
    assert mesh == "40x50" and unknowns == 9460 and whole / least == pytest.approx(ratio) and 0.1 < ratio < 10
    assert stages.wall(2, 1)[:3] == ["2x2", 7, 33]


def test_seconds_between_meshes_follow_a_power_law():
    points = [(1e-2, 1.0), (1e-4, 100.0)]
    assert performance.seconds_at(1e-3, points) == pytest.approx(10)
    assert performance.seconds_at(1e-1, points) == 1
    assert performance.seconds_at(1e-5, points) == math.inf
    assert performance.seconds_at(1e-3, []) == math.inf
