"""The study on one scene, and its verdicts on answers that are known."""

import json
import subprocess

import numpy as np
import pytest

import accuracy
import judge_answers
import launch

GOOD = {
    "scene": "hertz", "asked": 0.01, "first_edges": 20, "failed": "", "reached": True, "got": 0.004, "got_line": 0.003,
    "ratio": 2, "ratio_line": 3, "inside": 1.0, "work": 2.5, "meshing": 0.9, "energy_ratio": 1.1, "trusted": True,
    "unknowns": 8000,
}  # fmt: skip


def broken(row, seconds=0.1):
    """How many verdicts a row makes false."""
    return sum(not holds for _, _, holds in judge_answers.verdicts([row], seconds))


def test_verdicts_tell_good_from_bad():
    assert broken(GOOD) == 0 and broken(GOOD, seconds=0.4) == 1
    changes = [
        {"got": 0.011}, {"got_line": 0.011}, {"reached": False}, {"inside": 0.94}, {"ratio": 0.7}, {"ratio": 5},
        {"work": 3.1}, {"work": 2.5, "scene": "punch"}, {"meshing": 1.1}, {"energy_ratio": 3}, {"trusted": False},
        {"asked": 0.002, "unknowns": 13001, "got": 0.001, "got_line": 0.001},
    ]  # fmt: skip
    for wrong in changes:
        assert broken(GOOD | wrong) == 1, wrong


def test_the_study_of_one_scene(mortise, tmp_path, capsys):
    with pytest.raises(SystemExit) as ended:
        accuracy.main(["--quick", "--only", "rings", "-o", str(tmp_path)])
    assert ended.value.code == 0, capsys.readouterr().out
    rows = launch.columns(tmp_path / "answers.csv")
    assert rows["asked"].tolist() == [0.05, 0.05, 0.01, 0.01] and max(rows["got"]) < 1e-3 and min(rows["inside"]) > 0.95
    assert "holds" in (tmp_path / "accuracy.md").read_text()


@pytest.mark.parametrize("rollers", [7, 8])
def test_rollers_between_the_nodes_of_a_first_mesh_carry_load(mortise, tmp_path, rollers):
    """Coarse first edges pass through the rollers at the sides; a mesh of one's own, fine at all of them, does not."""

    def forces(name, fine, *more):
        changes = f"mesh.parameters={{rollers={rollers}, fine={fine}}}"
        scene = str(launch.ROOT / "geo/rollers.toml")
        subprocess.run([str(mortise), "solve", scene, "-o", name, "--set", changes, *more], cwd=tmp_path, capture_output=True)
        pairs = json.loads((tmp_path / name / "summary.json").read_text())["contact"]
        return np.array([np.hypot(*pair["force"]) for pair in sorted(pairs, key=lambda pair: sorted(pair["between"]))])

    found, expected = forces("found", 0.2, "--accuracy", "5%"), forces("expected", 0.1)
    assert (expected > 0.1 * expected.max()).sum() >= 6 and np.abs(found - expected).max() < 0.015 * expected.max()
