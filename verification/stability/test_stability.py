"""The stability studies on a few runs: rows complete, nothing repeated, no crash, known answers, stable defaults."""

import json
import math
import tomllib

import numpy as np
import pytest

import failures
import launch
import persson
import small_meshes
import stability
import stability_runs
import study_11_pin
import study_1_infsup
import study_2_ratio
import study_3_contrast
import study_5_geometry
import study_6_overconstraint
import study_7_iterations
import study_8_numbers
import template
from plates import even
from stability_runs import execute

SCENES = sorted(path.stem for path in (launch.ROOT / "geo").glob("*.toml"))
SMALL = {"n_upper": 16, "n_lower": 20, "n_plate": 24, "n_block": 30, "n_punch": 16, "n_inner": 12, "n_outer": 16}
OF_COARSE_MESHES = {stability_runs.ESTIMATED_ERROR, "estimated error of p", "p >= 0 between the multipliers"}
EXACT_RINGS = 4830258.30258  # geo/rings.toml

pytestmark = pytest.mark.usefixtures("mortise")


def parameters(scene):
    """Small meshes, for those of the scene's parameters that are counts."""
    text = tomllib.loads(launch.scene_file(scene).read_text())
    if scene == "punch":  # whose block is three times as wide
        return failures.parameters(n_punch=16, n_block=36)
    return failures.parameters(**{key: SMALL[key] for key in text["mesh"].get("parameters", {}) if key in SMALL})


def outline(bodies, join=()):
    """What tells the meshes of runs apart, as making all of them takes long."""
    return str([vars(body) | {"place": [body.place(s, t) for s in (0.3, 0.6) for t in (0, 0.7)]} for body in bodies] + [join])


@pytest.mark.parametrize("name", stability.STUDIES)
def test_every_study_has_what_the_driver_asks_for(name, monkeypatch):
    monkeypatch.setattr(small_meshes, "mesh_text", outline)
    study = stability.importlib.import_module(stability.STUDIES[name])
    assert hasattr(study, "draw") and hasattr(study, "failures") and hasattr(study, "runs") != hasattr(study, "measure")
    head, *texts = template.texts(stability.HERE / f"{stability.STUDIES[name]}.md").values()
    assert head.startswith("# ") and f"({name}.png)" in head
    assert texts and all(len(stability.paragraphs(text)) == 3 for text in texts)
    if hasattr(study, "runs"):
        full, quick = ([json.dumps(run, sort_keys=True) for run in study.runs(quick)] for quick in (False, True))
        assert len(set(full)) == len(full), "no run twice"
        assert set(quick) <= set(full) and len(quick) < len(full), "quick is a part"


def test_a_study_is_written_whole_and_is_not_repeated(tmp_path):
    (first,) = stability.run_studies(tmp_path, quick=True, names=["numbers"])
    rows = first["rows"]
    assert len(list((tmp_path / "runs").iterdir())) == len(rows) == len(study_8_numbers.runs(quick=True))
    assert all({"outcome", "seconds", "axis", "value"} <= row.keys() for row in rows) and first["wrong"] == []
    assert (tmp_path / "numbers.png").stat().st_size > 10000
    assert len(launch.columns(tmp_path / "numbers.csv")["outcome"]) == len(rows)
    found = json.loads((tmp_path / "numbers.json").read_text())
    assert found and all(failure["state"] in failures.STATES and failure["begins"] for failure in found)
    units = next(failure for failure in found if failure["name"] == "Units")
    assert units["bound"] is None and units["state"] == "fixed"
    times = {path: path.stat().st_mtime_ns for path in (tmp_path / "runs").iterdir()}
    with pytest.raises(SystemExit) as done:
        stability.main(["--quick", "--only", "numbers", "-o", str(tmp_path)])
    assert done.value.code == 0 and times == {path: path.stat().st_mtime_ns for path in (tmp_path / "runs").iterdir()}
    text, study = ((tmp_path / f"{name}.md").read_text() for name in ("stability", "numbers"))
    assert "](numbers.png)" in study and study.startswith("# 8. Units")
    assert "Quick: a subset" in text and "| [8. Units" in text and "](numbers.md) | Units |" in text


def test_crashes_hangs_and_internal_errors_are_reported(tmp_path, monkeypatch):
    words = {0: "solved", 1: "refused", 2: "check", 3: "internal error", -11: "crash (-11)", None: "hang"}
    assert {status: stability_runs.outcome(status) for status in words} == words
    run = study_2_ratio.run_of("rings", 2, "linear", 1, True)
    nothing = {"runs": lambda quick: [run], "failures": lambda rows: [], "draw": lambda rows, path: None}
    for name, function in nothing.items():
        monkeypatch.setattr(study_1_infsup, name, function)
    monkeypatch.setattr(template, "texts", lambda path: {"": "# Nothing"})
    for number, (word, count) in enumerate((("solved", 0), ("crash (-11)", 1), ("hang", 1), ("internal error", 1))):
        monkeypatch.setattr(stability_runs, "execute", lambda run: {"outcome": word})
        (result,) = stability.run_studies(tmp_path / str(number), True, ["infsup"])
        assert len(result["wrong"]) == count


def test_lame_of_the_measures_is_that_of_the_scene():
    assert stability_runs.lame(stability_runs.RINGS["materials"])[0] == pytest.approx(EXACT_RINGS, rel=1e-11)


def test_a_hang_and_a_refusal_are_rows(monkeypatch):
    run = study_2_ratio.run_of("rings", 2, "linear", 1, True)
    refused = execute({**run, "settings": {"materials.stiff.poisson": 0.5}})
    assert refused["outcome"] == "refused" and "poisson" in refused["message"] and "/geo" not in refused["message"]
    monkeypatch.setattr(stability_runs, "TIME_LIMIT", 1e-3)
    assert execute(run)["outcome"] == "hang"


def test_exact_lines_stay_exact():
    """Kinks with vertices, vertices that nearly coincide, three bodies at a point, moduli 1e6 apart: p = 10 MPa."""
    for run in (
        study_5_geometry.kink(80, "vertex in both", "lower_top"),
        study_5_geometry.sliver(1e-9, "dual"),
        study_6_overconstraint.three_bodies("quadratic", "lower_top"),
        study_3_contrast.patch(1e6, "upper_contact"),
        study_3_contrast.patch(1e-6, "lower_contact"),
    ):
        row = execute(run)
        # A body of a millionth of the stiffness moves by more than small displacements are.
        moves = row.get("failed_checks") == "turn and slide of contact lines"
        assert (row["outcome"] == "solved" or moves) and row["p_error"] < 1e-10, row


@pytest.mark.parametrize("name", ["all nodes shared (8:8)", "one curve in two pairs"])
def test_shared_edges_and_a_curve_in_two_pairs_are_refused(name):
    assert execute(study_6_overconstraint.case(name, "linear", "lower_top"))["outcome"] == "refused"


def test_a_load_that_pulls_away_is_refused_and_names_the_motion():
    row = execute(study_7_iterations.sideways(-1e-3, "linear"))
    assert row["outcome"] == "refused" and "nothing holds body 'upper'" in row["message"]


@pytest.mark.parametrize("scene", SCENES)
def test_defaults_lie_inside_the_stable_regions(scene):
    """The scenes as they stand: no run fails but by the coarse mesh's checks, and none gets a word about its gap."""
    run = {"axes": {}, "scene": scene, "settings": parameters(scene), "measures": []}
    row = execute(run)
    # The rollers take all twenty steps of the active set alone, then those from the interior point's partition.
    steps = 20 + study_7_iterations.BAR if scene == "rollers" else study_7_iterations.BAR
    assert row["outcome"] in ("solved", "check") and row["steps"] <= steps, row
    assert set(filter(None, row["failed_checks"].split("; "))) <= OF_COARSE_MESHES
    assert "initial_gap" not in row["warnings"]
    nu = [material["poisson"] for material in tomllib.loads(launch.scene_file(scene).read_text())["materials"].values()]
    assert max(nu) < 0.45
    if scene in ("wall", "pellets", "rod"):  # whose bodies touch in cycles: no two groups
        row = execute({**run, "settings": {**run["settings"], "method.solver": "ddm"}})
        assert row["outcome"] == "refused" and "opposite role" in row["message"], row
    elif scene != "stack":  # whose bodies are a chain of three
        row = execute({**run, "settings": {**run["settings"], "method.solver": "ddm"}})
        assert row["outcome"] in ("solved", "check"), row


def test_the_finer_side_is_the_default_and_is_cut_into_segments():
    run = {"axes": {}, "scene": "patch_flat", "settings": {}, "measures": ["uniform"]}
    row = execute(run)
    assert row["multipliers"] == 12 and row["p_error"] < 1e-11
    row = execute({**run, "settings": {"method.integration": "elements"}})
    assert row["p_error"] > 1e-4, "whole edges fail the patch test"


def test_persson_is_in_equilibrium_and_hertz_for_small_angles():
    for degrees in (1, 30, 60, 84):
        angle = math.radians(degrees)
        phi = angle * np.sin(np.linspace(-np.pi / 2, np.pi / 2, 4001))
        assert np.trapz(persson.pressure(phi, angle) * np.cos(phi), phi) == pytest.approx(1, rel=1e-6)
    small = math.radians(0.1)
    assert persson.pressure(0, small) == pytest.approx(2 / (math.pi * small), rel=1e-5)
    assert persson.clearance(small) == pytest.approx(8 / (math.pi * small**2), rel=1e-5)
    assert persson.clearance(persson.widest()) == pytest.approx(0, abs=1e-12)


def test_a_pin_on_straight_edges_has_the_right_pressure_without_a_word_about_the_gap():
    run = study_11_pin.pin(1e-3, "6-node triangles, straight", 30, "msh")
    read, measured = (execute(run | {"settings": {**run["settings"], **more}}) for more in ({}, failures.OF_MESHES))
    assert abs(study_11_pin.errors(read)["p_error"]) < 0.01 and study_11_pin.errors(read)["edges"] < 0.01
    assert study_11_pin.errors(measured)["p_error"] > 0.1


def test_nodes_of_a_small_mesh_are_shared_where_bodies_are_joined():
    bodies = small_meshes.plates(lambda x: 0.3, even(3), even(3))
    apart, joined = small_meshes.mesh_text(bodies), small_meshes.mesh_text(bodies, join=[("upper", "lower")])
    assert apart.count('"upper_bottom"') == 1 and "$EndElements" in apart
    count = lambda mesh: int(mesh.split("$Nodes\n")[1].split("\n")[0])
    assert count(apart) - count(joined) == 7, "the nodes of three quadratic edges are one"
