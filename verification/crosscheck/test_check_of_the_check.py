"""Wrong results of mortise do not pass: the comparison sees them, the case fails, the runner ends with 1.

wrong_mortise.py says how each of them is made.
"""

import shutil
from pathlib import Path

import pytest

CASE = "same_discretisation/parabola_1/8x10/P2-P1/segments/upper_contact"
LIMIT = 1e-8
WRONG = str(Path(__file__).with_name("wrong_mortise.py"))


def values(report):
    (result,) = report["results"]
    return result["status"], {figure["name"]: figure["value"] for figure in result["figures"]}


def test_the_right_result_passes(programs, verify):
    done, report = verify("--case", CASE)
    status, figures = values(report)
    assert done.returncode == 0 and status == "ok", done.stdout
    assert max(figures.values()) <= LIMIT


def assert_caught(done, report, least):
    """The case failed, by differences above the limit and of the size that the wrong input makes."""
    assert done.returncode == 1 and "failed: " + CASE in done.stdout, done.stdout + done.stderr
    status, figures = values(report)
    assert status == "failed"
    assert figures["displacement"] > LIMIT and figures["pressure"] > LIMIT
    assert max(figures["displacement"], figures["pressure"]) > least
    assert report["not_ok"] == 1


@pytest.mark.parametrize("wrong, least", [("poisson", 1e-5), ("normal", 1e-3), ("segment", 1e-3)])
def test_a_wrong_result_is_caught(programs, verify, wrong, least):
    done, report = verify("--case", CASE, MORTISE=WRONG, WRONG=wrong, RIGHT_MORTISE=str(programs.mortise))
    assert_caught(done, report, least)


def test_the_stand_in_itself_changes_nothing(programs, verify):
    """With nothing made wrong it passes, so what the other tests see is the error and not the stand-in."""
    done, _ = verify("--case", CASE, MORTISE=WRONG, WRONG="nothing", RIGHT_MORTISE=str(programs.mortise))
    assert done.returncode == 0, done.stdout + done.stderr


def test_results_of_another_mesh_are_refused(programs, verify, tmp_path):
    """Nodes that have no partner are an error, not a comparison of the nearest."""
    other = CASE.replace("8x10", "10x8")
    verify("--case", other)
    results = tmp_path / "other"
    shutil.copytree(tmp_path / "report" / other / "mortise", results)
    settings = {"WRONG": "results", "WRONG_RESULTS": str(results), "RIGHT_MORTISE": str(programs.mortise)}
    done, report = verify("--case", CASE, MORTISE=WRONG, **settings)
    assert done.returncode == 1 and report["results"][0]["status"] == "error"
    assert "nodes in mortise" in done.stdout
