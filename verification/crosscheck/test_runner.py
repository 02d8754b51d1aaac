"""The runner: what it says and its exit status, a case of each level from end to end, and that wrong results of mortise
(wrong_mortise.py says how each is made) do not pass: the comparison sees them, the case fails, the runner ends with 1.
"""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import meshio
import numpy as np
import pytest

import run

HERE = Path(__file__).parent
CASES = {
    "same_discretisation/shrink_fit/8x10/P2-P2/segments/outer_contact": "triangle6",
    "same_discretisation/patch_inclined/8x10/P1-P1/elements/lower_contact": "triangle",
    "same_problem/rings/12x15-24x30-48x60/inner_contact": "triangle",
}


@pytest.fixture(scope="session")
def programs():
    try:
        return run.find_programs()
    except run.MissingProgram as missing:
        pytest.skip(str(missing))


@pytest.fixture
def crosscheck(tmp_path):
    """Runs crosscheck.py; returns the process and the table of report.json, None if there is none."""

    def run_crosscheck(*arguments, **environment):
        command = [sys.executable, HERE / "crosscheck.py", "-o", tmp_path / "report", *arguments]
        done = subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, **environment})
        report = tmp_path / "report/report.json"
        return done, json.loads(report.read_text()) if report.is_file() else None

    return run_crosscheck


@pytest.mark.parametrize("case", CASES)
def test_a_case_from_end_to_end(programs, crosscheck, tmp_path, case):
    done, report = crosscheck("--case", case)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "[  1/1] ok" in done.stdout and "1 of 1 cases hold" in done.stdout
    (result,) = report["results"]
    assert result["name"] == case and result["status"] == "ok" and all(figure["ok"] for figure in result["figures"])
    mesh = meshio.read(tmp_path / "report" / result["folder"] / "difference.vtu")
    assert mesh.cells[0].type == CASES[case]
    largest = np.linalg.norm(mesh.point_data["u_mortise"], axis=1).max()
    assert 0 < np.linalg.norm(mesh.point_data["difference"], axis=1).max() < 0.05 * largest
    assert (tmp_path / "report/report.html").is_file() and (tmp_path / "report/report.md").is_file()


def test_an_unknown_case_is_an_error_that_names_the_nearest(crosscheck):
    done, report = crosscheck("--case", "same_discretisation/parabola_9/8x10/P2-P1/segments/upper_contact")
    assert done.returncode == 1 and report is None
    assert "no case matches" in done.stderr and "same_discretisation/parabola_1/8x10" in done.stderr


def test_list(crosscheck):
    done, _ = crosscheck("--list", "--quick", "--case", "*/rings/*")
    assert done.returncode == 0 and "same_problem/rings/12x15-24x30-48x60/inner_contact" in done.stdout.splitlines()


def test_a_missing_mortise_is_an_error(crosscheck, tmp_path):
    done, _ = crosscheck(MORTISE=str(tmp_path / "nothing"))
    assert done.returncode == 1 and "./dev build" in done.stderr


def test_a_missing_freefem_is_an_error_or_a_skip(crosscheck, tmp_path):
    """An empty PATH, and any file as mortise: it is not run."""
    there = {"PATH": str(tmp_path), "MORTISE": __file__}
    done, _ = crosscheck(**there)
    assert done.returncode == 1 and "apt-get install freefem++" in done.stderr
    done, _ = crosscheck("--skip-without-freefem", **there)
    assert done.returncode == 77 and done.stdout.startswith("skipped")


def test_a_program_that_fails_is_told_with_its_last_lines(crosscheck, tmp_path):
    broken = tmp_path / "mortise"
    broken.write_text("#!/bin/sh\necho bad news >&2\nexit 3\n")
    broken.chmod(0o755)
    if run.find_freefem() is None:
        pytest.skip("FreeFem++ is not on the PATH: ./dev setup installs it")
    case = "same_discretisation/circle/8x8/P1-P1/segments/upper_contact"
    done, report = crosscheck("--case", case, MORTISE=str(broken))
    assert done.returncode == 1 and report["results"][0]["status"] == "error"
    assert "exit status 3" in done.stdout and "bad news" in done.stdout


CASE = "same_discretisation/parabola_1/8x10/P2-P1/segments/upper_contact"
OF_CURVES = CASE + "/curve"
LIMIT = 1e-8
WRONG = str(HERE / "wrong_mortise.py")


def values(report):
    (result,) = report["results"]
    return result["status"], {figure["name"]: figure["value"] for figure in result["figures"]}


@pytest.mark.parametrize("case", [CASE, OF_CURVES])
def test_the_right_result_passes(programs, crosscheck, case):
    done, report = crosscheck("--case", case)
    status, figures = values(report)
    assert done.returncode == 0 and status == "ok", done.stdout
    assert max(figures.values()) <= LIMIT


def assert_caught(done, report, least, case=CASE):
    """The case failed, by differences above the limit and of the size that the wrong input makes."""
    assert done.returncode == 1 and f"failed: {case}\n" in done.stdout, done.stdout + done.stderr
    status, figures = values(report)
    assert status == "failed"
    assert figures["displacement"] > LIMIT and figures["pressure"] > LIMIT
    assert max(figures["displacement"], figures["pressure"]) > least
    assert report["not_ok"] == 1


@pytest.mark.parametrize("wrong, least", [("poisson", 1e-5), ("normal", 1e-3), ("segment", 1e-3)])
def test_a_wrong_result_is_caught(programs, crosscheck, wrong, least):
    done, report = crosscheck("--case", CASE, MORTISE=WRONG, WRONG=wrong, RIGHT_MORTISE=str(programs.mortise))
    assert_caught(done, report, least)


@pytest.mark.parametrize("wrong, least", [("handed_normal", 1e-3), ("handed_gap", 1e-3)])
def test_a_wrong_file_of_points_is_caught(programs, crosscheck, wrong, least):
    done, report = crosscheck("--case", OF_CURVES, MORTISE=WRONG, WRONG=wrong, RIGHT_MORTISE=str(programs.mortise))
    assert_caught(done, report, least, OF_CURVES)


def test_the_stand_in_itself_changes_nothing(programs, crosscheck):
    """With nothing made wrong it passes, so what the other tests see is the error and not the stand-in."""
    done, _ = crosscheck("--case", CASE, MORTISE=WRONG, WRONG="nothing", RIGHT_MORTISE=str(programs.mortise))
    assert done.returncode == 0, done.stdout + done.stderr


def test_results_of_another_mesh_are_refused(programs, crosscheck, tmp_path):
    """Nodes that have no partner are an error, not a comparison of the nearest."""
    other = CASE.replace("8x10", "10x8")
    crosscheck("--case", other)
    results = tmp_path / "other"
    shutil.copytree(tmp_path / "report" / other / "mortise", results)
    settings = {"WRONG": "results", "WRONG_RESULTS": str(results), "RIGHT_MORTISE": str(programs.mortise)}
    done, report = crosscheck("--case", CASE, MORTISE=WRONG, **settings)
    assert done.returncode == 1 and report["results"][0]["status"] == "error"
    assert "nodes in mortise" in done.stdout
