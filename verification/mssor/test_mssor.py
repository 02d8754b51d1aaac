"""MSSOR on small meshes: the region of convergence, the steps against the direct solver, and the pictures."""

import importlib.util
import json
from pathlib import Path

import pytest

import mssor_region
import mssor_runs  # makes launch known
import mssor_steps
import launch


@pytest.fixture(autouse=True)
def mortise():
    if not launch.MORTISE.is_file():
        pytest.skip(f"{launch.MORTISE} is missing: ./dev build makes it")


@pytest.fixture(scope="module")
def whole():
    """map.py as a module: its own name is that of a builtin."""
    spec = importlib.util.spec_from_file_location("mssor_map", Path(__file__).with_name("map.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_stationary_method_converges_below_the_border_and_not_above(tmp_path):
    rows = mssor_region.measure(tmp_path, (6, 8), "none", [0.6, 1.3, 1.8], [0.2, 4], 20000)
    assert [row for row in rows if not row["ok"]] == []
    for omega in (0.6, 1.3, 1.8):
        here = {row["tau"]: row["outcome"] for row in rows if row["omega"] == omega}
        assert [here[tau] for tau in sorted(here)] == ["converged", "converged", "diverged", "diverged"]


def test_as_preconditioner_it_converges_on_both_sides_of_the_border(tmp_path):
    rows = mssor_region.measure(tmp_path, (6, 8), "krylov", [0.6, 1.3, 1.8], [0.02, 0.6, 9], 1000)
    assert {row["outcome"] for row in rows} == {"converged"} and all(row["ok"] for row in rows)
    assert min(rows, key=lambda row: row["steps"])["omega"] == 1.3


def test_a_wrong_border_is_found():
    row = {"method.omega": 1.0, "method.tau": 1.0, "status": "solved", "iteration.steps": 9.0, "iteration.convergence_rate": 0.5,
           "iteration.seconds": 1.0}  # fmt: skip
    judged = lambda limit, **changes: mssor_region.judged({**row, **changes}, (6, 8), "none", limit, True)["ok"]
    assert judged(1.5) and not judged(0.5)
    diverging = {"status": "not_converged", "iteration.convergence_rate": 1.2}
    assert judged(0.5, **diverging) and not judged(1.5, **diverging)


def test_runs_are_kept(tmp_path):
    calls = []
    make = lambda: calls.append(1) or [{"a": 1}]
    assert mssor_runs.kept(tmp_path, {"x": 1}, make) == mssor_runs.kept(tmp_path, {"x": 1}, make) == [{"a": 1}]
    assert len(calls) == 1
    mssor_runs.kept(tmp_path, {"x": 2}, make)
    assert len(calls) == 2 and len(list((tmp_path / "runs").iterdir())) == 2
    assert json.loads(next((tmp_path / "runs").iterdir()).read_text())["key"]["executable"] == mssor_runs.executable()


def test_steps_against_the_direct_solver(tmp_path):
    meshes, finest = [(8, 10), (16, 20)], {"direct": (16, 20), "krylov": (16, 20), "minres": (16, 20), "none": (8, 10)}
    rows = mssor_steps.measure(tmp_path, meshes, finest, {})
    assert len(rows) == 7 and all(row["converged"] and row["p_difference"] < 1e-8 for row in rows)
    steps = {(row["mesh"], row["method"]): row["steps"] for row in rows}
    assert steps["8x10", "krylov"] < steps["8x10", "minres"] < steps["8x10", "none"]
    assert steps["16x20", "krylov"] < 3 * steps["8x10", "krylov"]
    mssor_steps.draw(tmp_path / "steps.png", rows)
    assert (tmp_path / "steps.png").stat().st_size > 10000


def test_the_whole_writes_a_section(tmp_path, whole, monkeypatch):
    monkeypatch.setitem(mssor_region.OMEGAS, "coarse", [0.8, 1.3])
    monkeypatch.setitem(mssor_region.TAUS, "coarse", [0.5, 4])
    with pytest.raises(SystemExit) as done:
        whole.main(["--quick", "-o", str(tmp_path)])
    assert done.value.code == 0
    text = (tmp_path / "section.html").read_text()
    assert 'id="mssor"' in text and "map.png" in text and "steps.png" in text
    assert all((tmp_path / name).is_file() for name in ("map.csv", "map.png", "steps.csv", "steps.png"))
