"""Domain decomposition on small meshes: region of convergence, steps, FreeFEM's iterates, and the pictures."""

import subprocess
import sys

import pytest

import history
import iterates
import ddm_runs  # makes launch known
import ddm_study
import launch
import region
import run
import steps


@pytest.fixture(autouse=True)
def mortise():
    if not launch.MORTISE.is_file():
        pytest.skip(f"{launch.MORTISE} is missing: ./dev build makes it")


@pytest.fixture(scope="module")
def programs():
    try:
        return run.find_programs()
    except run.MissingProgram as missing:
        pytest.skip(str(missing))


@pytest.mark.parametrize("role", region.ROLES)
def test_convergence_ends_at_the_predicted_border_with_the_predicted_factor(role):
    rows = region.measure((12, 15), 1, role, [0.04, 0.1, 0.2, 2])
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
    judged = lambda **changes: region.judged({**run_of_sweep, **changes}, 1, "upper", on_grid=True)["ok"]
    assert judged()
    assert not judged(**{"iteration.convergence_rate": 0.53}) and not judged(**{"iteration.convergence_rate": 0.47})
    assert not judged(**{"status": "not_converged"})
    assert not judged(**{"method.beta": 1.1, "iteration.convergence_rate": 1.2})


def test_region_draws_and_writes(tmp_path):
    rows = region.measure((8, 10), 1, "upper", [0.1, 0.3, 0.9])
    launch.write_csv(tmp_path / "region.csv", rows)
    region.draw(tmp_path / "region.png", rows, (8, 10), [0.1, 0.3, 0.9])
    assert (tmp_path / "region.png").stat().st_size > 10000
    assert len((tmp_path / "region.csv").read_text().splitlines()) == 1 + len(rows)


@pytest.mark.parametrize("scene", steps.SCENES)
def test_steps(scene):
    ratios, schemes = [0.1, 1], steps.SCHEMES
    rows = steps.measure(scene, (16, 20), ratios, schemes, ["anderson", "krylov"])
    assert len(rows) == len(ratios) * (1 + len(schemes) * 2)
    assert {row["outcome"] for row in rows} == {"converged"} and steps.over_the_bar(rows) == []
    chosen = lambda *method: [r["steps"] for r in rows if (r["scheme"], r["acceleration"]) == method]
    assert chosen("default", "default") == chosen("neumann_dirichlet", "krylov")
    text = "\n".join(steps.markdown(rows))
    assert f"## {scene}, bilateral" in text and text.count("\n| ") == 1 + 1 + len(schemes) * 2
    rows[0]["steps"] = steps.BAR + 1
    assert steps.over_the_bar(rows) == [rows[0]]


@pytest.mark.parametrize("space, beta", [("P1-P1", 0.3), ("P2-P1", 0.9)])
def test_iterates_are_freefems(programs, space, beta):
    rows = iterates.run_case(programs, iterates.Case("8x10", space, 1, beta))
    assert len(rows) == iterates.STEPS and all(row["ok"] for row in rows)
    assert rows[-1]["force_residual"] > 1e-3, "still on the way"


def test_history(tmp_path):
    folders = [tmp_path / name for name in ("none", "krylov")]
    for folder in folders:
        settings = {**launch.sizes((8, 10)), "method.solver": "ddm", "method.acceleration": folder.name}
        launch.solve("parabola_1", settings, folder)
    command = [sys.executable, history.__file__, *folders]
    subprocess.run(command, check=True)
    subprocess.run([*command, tmp_path / "both.svg"], check=True)
    assert (tmp_path / "none-history.png").stat().st_size > 10000
    assert "<svg" in (tmp_path / "both.svg").read_text()[:1000]
    refused = subprocess.run([*command, tmp_path], capture_output=True, text=True, check=False)
    assert refused.returncode == 2 and "iteration.csv" in refused.stderr


def test_the_table_of_steps_has_a_cell_a_ratio_and_a_number_a_mesh(tmp_path):
    row = {"scene": "cosine", "scheme": "default", "acceleration": "default"}
    rows = [{**row, "ratio": r, "mesh": m, "steps": n, "outcome": o} for r, m, n, o in
            [(1, "20x25", 7, "converged"), (10, "20x25", 300, "unfinished"), (1, "40x50", 8, "converged")]]
    launch.write_csv(tmp_path / "steps.csv", rows)
    table = ddm_study.steps_table(tmp_path / "steps.csv")
    assert ">7, 8</td>" in table and ">unfinished</td>" in table and ">cosine</td>" in table
