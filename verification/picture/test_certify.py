"""The verdict of `mortise certify`: scenes that agree, and scenes with something wrong in one of the runs."""

import json
import re
import subprocess
import sys

import pytest

from launch import ROOT

sys.path.append(str(ROOT / "src/python/reports"))

import certify

PUNCH, HERTZ, RINGS = (ROOT / f"geo/{name}.toml" for name in ("punch", "hertz", "rings"))


@pytest.fixture
def wrong(mortise, tmp_path):
    """Kinds of figures that do not agree, each with the run that says so, and the certificate."""

    def find(scene, changes=(), spoil=None):
        found = certify.certify(mortise, scene, tmp_path / "runs", changes, spoil=spoil)
        return {row["kind"]: row["run"] for row in found["figures"] if not row["agrees"]}, found

    return find


def test_certificate_of_hertz(mortise, tmp_path):
    command = [mortise, "certify", HERTZ, "-o", tmp_path / "runs"]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    found = json.loads((tmp_path / "runs/certificate.json").read_text())
    assert found["agrees"] and found["troubles"] == found["skipped"] == []
    assert {row["kind"] for row in found["figures"]} == {
        "p along the lines", "contact forces", "lengths in contact", "largest p", "displacements", "stresses"
    }  # fmt: skip
    assert [run["name"] for run in found["runs"]] == ["own", "quadrilaterals", "finer_4", "finer_16", "other_side", "feti"]
    assert "agrees: 10 figures by 5 other runs" in said
    page = (tmp_path / "runs.html").read_text()
    assert page.count("<svg") == 3 and "not drawn" not in page and "does not" not in page
    assert all(words in page for words in ("A cylinder pressed on a block: Hertz", "all 14 checks hold", "agree within the bars"))
    assert not re.search(r'(src|href)="(?!#|data:)', page)
    largest = next(row for row in found["figures"] if row["kind"] == "largest p")
    assert largest["value"] == pytest.approx(5.8184e8, abs=2 * largest["bar"])  # Hertz: docs/benchmarks.md
    unknowns = [row["unknowns"] for row in found["study"]]
    assert unknowns == sorted(unknowns) and found["study"][0]["off"] > found["study"][1]["off"]


@pytest.mark.parametrize(
    "scene, run, change, kinds",
    [
        (PUNCH, "feti", "materials.steel.poisson=0.35", {"p along the lines"}),
        (HERTZ, "quadrilaterals", "materials.steel.young=200e9", {"largest p", "lengths in contact", "displacements"}),
        (RINGS, "other_side", "boundary.2.pressure=9.9e6", {"p along the lines", "contact forces"}),
        (PUNCH, "quadrilaterals", 'boundary.2.pressure="10e6 + 4e9 * exp(-((x - 0.3137) / 2e-4)^2)"', {"contact forces"}),
    ],
)
def test_what_one_run_has_wrong_is_named(wrong, scene, run, change, kinds):
    named, found = wrong(scene, spoil={run: [change]})
    assert not found["agrees"] and kinds <= named.keys() and set(named.values()) == {run}


def test_too_coarse_a_mesh_of_its_own(mortise, wrong, tmp_path):
    mesh, scene = tmp_path / "coarse.msh", tmp_path / "coarse.toml"
    sizes = ["--set", "mesh.parameters.n_punch=6", "--set", "mesh.parameters.n_block=15"]
    subprocess.run([mortise, "mesh", PUNCH, *sizes, "-o", mesh, "--quiet"], check=True)
    text = PUNCH.read_text().replace("punch.geo", str(mesh))
    scene.write_text("\n".join(line for line in text.splitlines() if not line.startswith("parameters")))
    _, found = wrong(scene)
    assert not found["agrees"] and "only on the scene's own mesh, 1 % are asked" in found["troubles"][0]
    assert found["skipped"] == ["other meshes: the scene has a mesh of its own, and no geometry to mesh anew"]


def test_an_accuracy_that_is_not_reached(wrong):
    _, found = wrong(PUNCH, ["accuracy.unknowns_max=600"])
    assert not found["agrees"] and "accuracy_not_reached" in found["troubles"][0] and len(found["runs"]) == 1


def test_bad_input_is_refused_as_by_solve(mortise, tmp_path):
    ended = subprocess.run([mortise, "certify", tmp_path / "no.toml"], capture_output=True, text=True)
    assert ended.returncode == 1 and "no.toml" in ended.stderr and "Traceback" not in ended.stderr
