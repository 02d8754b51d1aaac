"""Domain decomposition and MSSOR: small studies of both, that they find what is wrong, FreeFEM's iterates, the picture."""

import subprocess
import sys

import pytest

import launch  # makes src/python/pictures known
import history
import iterates
import stability
import study_9_ddm as ddm
import study_10_mssor as mssor
from failures import select


@pytest.fixture(scope="module")
def studies(mortise, tmp_path_factory):
    """The rows of both studies, made small, by their names, and the folder."""
    folder = tmp_path_factory.mktemp("studies")
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(ddm.REGIONS, "quick", ((12, 15), [1], [0.04, 0.1, 0.2, 2]))
        patch.setattr(ddm, "RATIOS_OF_LINES", [1, 10])
        patch.setattr(ddm, "RATIOS", [0.1, 1])
        patch.setattr(ddm, "ACCELERATIONS", ["anderson", "krylov"])
        patch.setitem(ddm.MESHES, "quick", [(16, 20)])
        patch.setitem(ddm.HISTORY_MESH, "quick", (8, 10))
        patch.setitem(mssor.MAPS, "quick", [((6, 8), {"none": "coarse", "krylov": "coarse"}, 20000)])
        patch.setitem(mssor.OMEGAS, "coarse", [0.6, 1.3, 1.8])
        patch.setitem(mssor.TAUS, "coarse", [0.2, 4])
        results = stability.run_studies(folder, True, ["ddm", "mssor"])
    assert [line for result in results for line in result["wrong"]] == []
    assert {failure["state"] for result in results for failure in result["failures"]} == {"default", "fixed", "shown"}
    return {result["name"]: result["rows"] for result in results}, folder


def test_pictures_are_drawn(studies):
    for name in ("ddm.png", "ddm_history.png", "mssor.png", "mssor_steps.png"):
        assert (studies[1] / name).stat().st_size > 10000


@pytest.mark.parametrize("role", ddm.ROLES)
def test_a_fixed_relaxation_converges_up_to_the_predicted_border(studies, role):
    rows = select(studies[0]["ddm"], part="region", dirichlet=role, ratio=1)
    below = [row["outcome"] for row in rows if row["beta_over_limit"] < 1]
    assert 3 <= len(below) < len(rows) and set(below) == {"converged"}
    assert sum(row["compared"] for row in rows) >= 2
    assert {row["outcome"] for row in rows} == {"converged", "diverged"}


def test_a_wrong_factor_and_a_wrong_border_are_found():
    run_of_sweep = {
        "method.beta": 0.5,
        "status": "solved",
        "iteration.steps": 50.0,
        "iteration.convergence_rate": 0.5,
        "iteration.eigenvalue.smallest": 1.0,
        "iteration.eigenvalue.largest": 2.0,
    }
    judged = lambda **changes: ddm.judged({**run_of_sweep, **changes}, 1, "upper", on_grid=True)["ok"]
    assert judged()
    assert not judged(**{"iteration.convergence_rate": 0.53}) and not judged(**{"iteration.convergence_rate": 0.47})
    assert not judged(**{"status": "not_converged"})
    assert not judged(**{"method.beta": 1.1, "iteration.convergence_rate": 1.2})


@pytest.mark.parametrize("scene", ddm.SCENES)
def test_steps_of_domain_decomposition(studies, scene):
    rows = select(studies[0]["ddm"], part="steps", scene=scene)
    assert len(rows) == 2 * (1 + len(ddm.SCHEMES) * 2) and {row["outcome"] for row in rows} == {"converged"}
    chosen = lambda *method: [r["steps"] for r in rows if (r["scheme"], r["acceleration"]) == method]
    assert chosen("default", "default") == chosen("neumann_dirichlet", "krylov")


def test_too_many_steps_of_the_default_are_found():
    row = {"status": "solved", "materials.other.young": launch.YOUNG, "seconds.solve": 0, "iteration.convergence_rate": 0.5}
    row |= {"iteration.eigenvalue.smallest": 1, "iteration.eigenvalue.largest": 2}
    judged = lambda steps, scheme: ddm.shortened({**row, "iteration.steps": steps}, "cosine", (8, 10), scheme)["ok"]
    assert judged(ddm.BAR, ddm.DEFAULT) and not judged(ddm.BAR + 1, ddm.DEFAULT) and judged(99, "neumann_neumann")


def test_the_table_of_steps_has_a_cell_a_ratio_and_a_number_a_mesh():
    row = {"scene": "cosine", "scheme": "default", "acceleration": "default"}
    rows = [{**row, "ratio": r, "mesh": m, "steps": n, "outcome": o} for r, m, n, o in
            [(1, "20x25", 7, "converged"), (10, "20x25", 300, "unfinished"), (1, "40x50", 8, "converged")]]  # fmt: skip
    assert ddm.steps_table(rows).endswith("| cosine | default | default | 7, 8 | > 300 |")


@pytest.mark.parametrize("space, beta", [("P1-P1", 0.3), ("P2-P1", 0.9)])
def test_iterates_are_freefems(freefem, space, beta):
    rows = iterates.run_case({"mesh": "8x10", "space": space, "ratio": 1, "beta": beta})
    assert len(rows) == iterates.STEPS and all(row["ok"] for row in rows)
    assert rows[-1]["force_residual"] > 1e-3, "still on the way"


def test_history(mortise, tmp_path):
    settings = {**launch.sizes((8, 10)), "method.solver": "ddm"}
    launch.solve("parabola_1", settings, tmp_path / "run")
    command = [sys.executable, history.__file__, tmp_path / "run"]
    subprocess.run([*command, tmp_path / "run", tmp_path / "both.svg"], check=True)
    assert "<svg" in (tmp_path / "both.svg").read_text()[:1000]
    refused = subprocess.run([*command, tmp_path, "a.png"], capture_output=True, text=True, check=False)
    assert refused.returncode == 1 and "iteration.csv" in refused.stderr


def test_mssor_converges_below_the_border_alone_and_as_preconditioner_on_both_sides(studies):
    rows = select(studies[0]["mssor"], part="map")
    for omega in (0.6, 1.3, 1.8):
        here = {row["tau"]: row["outcome"] for row in select(rows, acceleration="none", omega=omega)}
        assert [here[tau] for tau in sorted(here)] == ["converged", "converged", "diverged", "diverged"]
    krylov = select(rows, acceleration="krylov")
    assert {row["outcome"] for row in krylov} == {"converged"}
    assert min(krylov, key=lambda row: row["steps"])["omega"] == 1.3


def test_a_wrong_border_of_mssor_is_found():
    row = {"method.omega": 1.0, "method.tau": 1.0, "status": "solved", "iteration.seconds": 1.0}
    row |= {"iteration.steps": 9.0, "iteration.convergence_rate": 0.5}
    judged = lambda limit, **changes: mssor.judged({**row, **changes}, (6, 8), "none", limit, True)["ok"]
    assert judged(1.5) and not judged(0.5)
    diverging = {"status": "not_converged", "iteration.convergence_rate": 1.2}
    assert judged(0.5, **diverging) and not judged(1.5, **diverging)


def test_steps_of_mssor_against_the_direct_solver(studies):
    rows = select(studies[0]["mssor"], part="steps")
    steps = {(row["mesh"], row["method"]): row["steps"] for row in rows}
    assert len(rows) == 7 and steps["8x10", "krylov"] < steps["8x10", "minres"] < steps["8x10", "none"]
    assert steps["16x20", "krylov"] < 3 * steps["8x10", "krylov"]
    assert max(row["p_difference"] for row in rows) < mssor.LIMIT
