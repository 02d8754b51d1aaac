"""The runner: its exit status and what it says; one case of each level from end to end."""

import meshio
import numpy as np
import pytest

import run

CASES = {
    "same_discretisation/shrink_fit/8x10/P2-P2/segments/outer_contact": "triangle6",
    "same_discretisation/patch_inclined/8x10/P1-P1/elements/lower_contact": "triangle",
    "same_problem/rings/12x15-24x30-48x60/inner_contact": "triangle",
}


@pytest.mark.parametrize("case", CASES)
def test_a_case_from_end_to_end(programs, verify, tmp_path, case):
    done, report = verify("--case", case)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "[  1/1] ok" in done.stdout and "1 of 1 cases hold" in done.stdout
    (result,) = report["results"]
    assert result["name"] == case and result["status"] == "ok" and all(figure["ok"] for figure in result["figures"])
    mesh = meshio.read(tmp_path / "report" / result["folder"] / "difference.vtu")
    assert mesh.cells[0].type == CASES[case]
    largest = np.linalg.norm(mesh.point_data["u_mortise"], axis=1).max()
    assert 0 < np.linalg.norm(mesh.point_data["difference"], axis=1).max() < 0.05 * largest
    assert (tmp_path / "report/report.html").is_file() and (tmp_path / "report/report.md").is_file()


def test_jobs_give_the_same_report(programs, verify):
    glob = "same_discretisation/tent_b/8x10/P?-P1/segments/*"
    done, report = verify("--case", glob, "--jobs", "2")
    assert done.returncode == 0, done.stdout + done.stderr
    _, again = verify("--case", glob)
    strip = lambda table: [(r["name"], r["figures"]) for r in table["results"]]
    assert strip(report) == strip(again) and len(strip(report)) == 4


def test_an_unknown_case_is_an_error_that_names_the_nearest(verify):
    done, report = verify("--case", "same_discretisation/parabola_9/8x10/P2-P1/segments/upper_contact")
    assert done.returncode == 1 and report is None
    assert "no case matches" in done.stderr and "same_discretisation/parabola_1/8x10" in done.stderr


def test_list(verify):
    done, _ = verify("--list", "--quick", "--case", "*/rings/*")
    assert done.returncode == 0 and "same_problem/rings/12x15-24x30-48x60/inner_contact" in done.stdout.splitlines()


def test_a_missing_mortise_is_an_error(verify, tmp_path):
    done, _ = verify(MORTISE=str(tmp_path / "nothing"))
    assert done.returncode == 1 and "./dev build" in done.stderr


def test_a_missing_freefem_is_an_error_or_a_skip(verify, tmp_path):
    """An empty PATH, and any file as mortise: it is not run."""
    there = {"PATH": str(tmp_path), "MORTISE": __file__}
    done, _ = verify(**there)
    assert done.returncode == 1 and "apt-get install freefem++" in done.stderr
    done, _ = verify("--skip-without-freefem", **there)
    assert done.returncode == 77 and done.stdout.startswith("skipped")


def test_a_program_that_fails_is_told_with_its_last_lines(verify, tmp_path):
    broken = tmp_path / "mortise"
    broken.write_text("#!/bin/sh\necho bad news >&2\nexit 3\n")
    broken.chmod(0o755)
    if run.find_freefem() is None:
        pytest.skip("FreeFem++ is not on the PATH: ./dev setup installs it")
    done, report = verify("--case", "same_discretisation/circle/8x8/P1-P1/segments/upper_contact", MORTISE=str(broken))
    assert done.returncode == 1 and report["results"][0]["status"] == "error"
    assert "exit status 3" in done.stdout and "bad news" in done.stdout
