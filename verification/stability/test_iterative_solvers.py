"""Domain decomposition and MSSOR on small meshes: regions of convergence, steps, FreeFEM's iterates, the pictures."""

import json
import subprocess
import sys

import pytest

import iterates  # makes crosscheck's modules known
import launch
import runs
import study_9_ddm as ddm
import study_10_mssor as mssor

sys.path.append(str(launch.ROOT / "verification/picture"))
import history  # noqa: E402

pytestmark = pytest.mark.usefixtures("mortise")


@pytest.fixture
def store(tmp_path):
    return runs.Store(tmp_path / "runs")


@pytest.mark.parametrize("role", ddm.ROLES)
def test_convergence_ends_at_the_predicted_border_with_the_predicted_factor(store, role):
    rows = ddm.region(store, (12, 15), 1, role, [0.04, 0.1, 0.2, 2])
    assert [row for row in rows if not row["ok"]] == []
    assert {row["outcome"] for row in rows} == {"converged", "diverged"}
    assert sum(row["compared"] for row in rows) >= 2
    below = [row["outcome"] for row in rows if row["beta_over_limit"] < 1]
    assert 3 <= len(below) < len(rows) and set(below) == {"converged"}


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
def test_steps_of_domain_decomposition(store, scene):
    ratios, accelerations = [0.1, 1], ["anderson", "krylov"]
    rows = ddm.steps(store, scene, (16, 20), ratios, ddm.SCHEMES, accelerations)
    assert len(rows) == len(ratios) * (1 + len(ddm.SCHEMES) * len(accelerations))
    assert {row["outcome"] for row in rows} == {"converged"} and ddm.over_the_bar(rows) == []
    chosen = lambda *method: [r["steps"] for r in rows if (r["scheme"], r["acceleration"]) == method]
    assert chosen("default", "default") == chosen("neumann_dirichlet", "krylov")
    assert ddm.steps_table(rows).count(f"\n| {scene} |") == 1 + len(ddm.SCHEMES) * len(accelerations)
    rows[0]["steps"] = ddm.BAR + 1
    assert ddm.over_the_bar(rows) == [rows[0]] and len(ddm.wrong(rows)) == 1


def test_the_table_of_steps_has_a_cell_a_ratio_and_a_number_a_mesh():
    row = {"scene": "cosine", "scheme": "default", "acceleration": "default"}
    rows = [{**row, "ratio": r, "mesh": m, "steps": n, "outcome": o} for r, m, n, o in
            [(1, "20x25", 7, "converged"), (10, "20x25", 300, "unfinished"), (1, "40x50", 8, "converged")]]  # fmt: skip
    assert ddm.steps_table(rows).endswith("| cosine | default | default | 7, 8 | > 300 |")


@pytest.mark.parametrize("space, beta", [("P1-P1", 0.3), ("P2-P1", 0.9)])
def test_iterates_are_freefems(freefem, space, beta):
    rows = iterates.run_case(iterates.Case("8x10", space, 1, beta))
    assert len(rows) == iterates.STEPS and all(row["ok"] for row in rows)
    assert rows[-1]["force_residual"] > 1e-3, "still on the way"


def test_history(tmp_path):
    folders = [tmp_path / name for name in ("none", "krylov")]
    for folder in folders:
        settings = {**launch.sizes((8, 10)), "method.solver": "ddm", "method.acceleration": folder.name}
        launch.solve("parabola_1", settings, folder)
    command = [sys.executable, history.__file__, *folders]
    subprocess.run([*command, tmp_path / "both.png"], check=True)
    subprocess.run([*command, tmp_path / "both.svg"], check=True)
    assert (tmp_path / "both.png").stat().st_size > 10000
    assert "<svg" in (tmp_path / "both.svg").read_text()[:1000]
    refused = subprocess.run([*command, tmp_path, "a.png"], capture_output=True, text=True, check=False)
    assert refused.returncode == 2 and "iteration.csv" in refused.stderr


def test_mssor_stationary_converges_below_the_border_and_not_above(store):
    rows = mssor.region(store, (6, 8), "none", [0.6, 1.3, 1.8], [0.2, 4], 20000)
    assert mssor.wrong(rows) == []
    for omega in (0.6, 1.3, 1.8):
        here = {row["tau"]: row["outcome"] for row in rows if row["omega"] == omega}
        assert [here[tau] for tau in sorted(here)] == ["converged", "converged", "diverged", "diverged"]


def test_mssor_as_preconditioner_converges_on_both_sides_of_the_border(store):
    rows = mssor.region(store, (6, 8), "krylov", [0.6, 1.3, 1.8], [0.02, 0.6, 9], 1000)
    assert {row["outcome"] for row in rows} == {"converged"} and all(row["ok"] for row in rows)
    assert min(rows, key=lambda row: row["steps"])["omega"] == 1.3


def test_a_wrong_border_of_mssor_is_found():
    row = {"method.omega": 1.0, "method.tau": 1.0, "status": "solved", "iteration.seconds": 1.0}
    row |= {"iteration.steps": 9.0, "iteration.convergence_rate": 0.5}
    judged = lambda limit, **changes: mssor.judged({**row, **changes}, (6, 8), "none", limit, True)["ok"]
    assert judged(1.5) and not judged(0.5)
    diverging = {"status": "not_converged", "iteration.convergence_rate": 1.2}
    assert judged(0.5, **diverging) and not judged(1.5, **diverging)


def test_steps_of_mssor_against_the_direct_solver(store):
    rows = mssor.steps(store, mssor.MESHES["quick"], mssor.FINEST["quick"], {})
    assert len(rows) == 7 and mssor.wrong(rows) == []
    steps = {(row["mesh"], row["method"]): row["steps"] for row in rows}
    assert steps["8x10", "krylov"] < steps["8x10", "minres"] < steps["8x10", "none"]
    assert steps["16x20", "krylov"] < 3 * steps["8x10", "krylov"]
    assert len(mssor.wrong([{**rows[0], "p_difference": 1e-6}, {**rows[1], "outcome": "unfinished"}])) == 2


def test_both_are_written_as_studies(tmp_path, monkeypatch):
    import stability

    monkeypatch.setitem(ddm.REGIONS, "quick", ((8, 10), [1, 10], [0.1, 0.3, 0.9]))
    monkeypatch.setattr(ddm, "RATIOS_OF_LINES", [1, 10])
    monkeypatch.setattr(ddm, "SCENES", {"cosine": ddm.SCENES["cosine"]})
    monkeypatch.setattr(ddm, "SCHEMES", ["neumann_dirichlet"])
    monkeypatch.setitem(ddm.MESHES, "quick", [(8, 10)])
    monkeypatch.setitem(ddm.HISTORY_MESH, "quick", (8, 10))
    monkeypatch.setitem(mssor.OMEGAS, "coarse", [0.8, 1.3])
    monkeypatch.setitem(mssor.TAUS, "coarse", [0.5, 4])
    with pytest.raises(SystemExit) as done:
        stability.main(["--quick", "--only", "ddm", "mssor", "-o", str(tmp_path)])
    assert done.value.code == 0
    text = (tmp_path / "section.html").read_text()
    for name in ("ddm.png", "ddm_history.png", "mssor.png", "mssor_steps.png"):
        assert f'src="{name}"' in text and (tmp_path / name).stat().st_size > 10000
    assert {failure["state"] for failure in json.loads((tmp_path / "ddm.json").read_text())} == {"default", "fixed"}
