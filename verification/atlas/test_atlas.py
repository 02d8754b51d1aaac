"""The atlas on a few runs: rows complete, nothing repeated, no crash, known answers, the defaults in stable regions."""

import json
import tomllib

import pytest

import atlas
import atlas_measures
import atlas_mesh
import atlas_regions
import atlas_runs  # makes launch known
import launch
import study_2_ratio
import study_3_contrast
import study_5_geometry
import study_6_overconstraint
import study_7_iterations
import study_8_numbers

SCENES = sorted(path.stem for path in (launch.ROOT / "geo").glob("*.toml"))
SMALL = {"n_upper": 16, "n_lower": 20, "n_plate": 24, "n_block": 30, "n_punch": 16, "n_inner": 12, "n_outer": 16}
OF_COARSE_MESHES = {atlas_measures.AGAINST_SIGMA_N, "p >= 0 between the multipliers"}
EXACT_RINGS = 4830258.30258  # geo/rings.toml


@pytest.fixture(autouse=True)
def mortise():
    if not launch.MORTISE.is_file():
        pytest.skip(f"{launch.MORTISE} is missing: ./dev build makes it")


def parameters(scene):
    """Small meshes, for those of the scene's parameters that are counts."""
    text = tomllib.loads(launch.scene_file(scene).read_text())
    if scene == "punch":  # whose block is three times as wide
        return {"mesh.parameters.n_punch": 16, "mesh.parameters.n_block": 36}
    return {f"mesh.parameters.{key}": SMALL[key] for key in text["mesh"].get("parameters", {}) if key in SMALL}


def test_every_study_has_what_the_driver_asks_for():
    for number, _, module in atlas.STUDIES:
        study = atlas.find(number, module)
        if study is None:
            assert number == 1, "only the first study may be missing"
            continue
        assert all(hasattr(study, name) for name in ("TITLE", "INTRODUCTION", "CAPTION", "draw", "regions"))
        keys = [atlas_runs.key_of(run) for run in study.runs(quick=False)]
        quick = [atlas_runs.key_of(run) for run in study.runs(quick=True)]
        assert len(set(keys)) == len(keys), "no run twice"
        assert set(quick) <= set(keys) and len(quick) < len(keys), "quick is a part"


def test_a_study_is_written_whole_and_is_not_repeated(tmp_path):
    (first,) = atlas.run_studies(tmp_path, quick=True, only=["numbers"])
    rows = first["rows"]
    assert first["fresh"] == len(rows) == len(study_8_numbers.runs(quick=True))
    assert all({"outcome", "seconds", "axis", "value"} <= row.keys() for row in rows)
    assert list(atlas.ended_badly([first])) == []
    assert (tmp_path / "numbers/picture.png").stat().st_size > 10000
    table = launch.columns(tmp_path / "numbers/rows.csv")
    assert len(table["outcome"]) == len(rows)
    regions = json.loads((tmp_path / "numbers/regions.json").read_text())
    assert regions and all(region["state"] in atlas_regions.STATES and region["begins"] for region in regions)
    units = next(region for region in regions if region["name"] == "Units")
    assert units["bound"] is None and units["state"] == "fixed"
    with open(tmp_path / "numbers/rows.jsonl", "a") as file:
        file.write('{"key": "cut short by a stop')
    (second,) = atlas.run_studies(tmp_path, quick=True, only=["numbers"])
    assert second["fresh"] == 0 and [row["outcome"] for row in second["rows"]] == [row["outcome"] for row in rows]
    atlas.atlas_page.write_html(tmp_path, [second], quick=True)
    assert "numbers/picture.png" in (tmp_path / "section.html").read_text()


def test_a_change_of_the_run_is_a_new_key():
    run = study_2_ratio.run_of("rings", 2, "linear", 3, True)
    other = study_2_ratio.run_of("rings", 2, "linear", 3, False)
    assert atlas_runs.key_of(run) == atlas_runs.key_of(json.loads(json.dumps(run))) != atlas_runs.key_of(other)


def test_crashes_hangs_and_internal_errors_are_reported():
    rows = [{"outcome": text} for text in ("solved", "refused", "check", "hang", "crash (-11)", "internal error")]
    assert len(list(atlas.ended_badly([{"number": 0, "rows": rows}]))) == 3
    assert [atlas_runs.outcome(status, 1.0) for status in (0, 1, 2, 3, -11)] == [
        "solved", "refused", "check", "internal error", "crash (-11)"
    ]  # fmt: skip
    assert atlas_runs.outcome(None, None) == "hang"


def test_lame_of_the_measures_is_that_of_the_scene():
    assert atlas_measures.lame([(210e9, 0.3), (70e9, 0.3)])[0] == pytest.approx(EXACT_RINGS, rel=1e-11)


def test_a_hang_and_a_refusal_are_rows(monkeypatch):
    run = study_2_ratio.run_of("rings", 2, "linear", 1, True)
    refused = atlas_runs.execute({**run, "settings": {"materials.stiff.poisson": 0.5}})
    assert refused["outcome"] == "refused" and "poisson" in refused["message"] and "/geo" not in refused["message"]
    monkeypatch.setattr(atlas_runs, "TIME_LIMIT", 1e-3)
    assert atlas_runs.execute(run)["outcome"] == "hang"


def test_exact_lines_stay_exact():
    """Kinks with vertices, vertices that nearly coincide, three bodies at a point, moduli 1e6 apart: p = 10 MPa."""
    runs = [
        study_5_geometry.kink(80, "vertex in both", "lower_top"),
        study_5_geometry.sliver(1e-9, "dual"),
        study_6_overconstraint.three_bodies("quadratic", "lower_top"),
        study_3_contrast.patch(1e6, "upper_contact"),
        study_3_contrast.patch(1e-6, "lower_contact"),
    ]
    for run in runs:
        row = atlas_runs.execute(run)
        assert row["outcome"] == "solved" and row["p_error"] < 1e-11, row


def test_shared_edges_and_a_curve_in_two_pairs_are_refused():
    for name in ("all nodes shared (8:8)", "one curve in two pairs"):
        assert atlas_runs.execute(study_6_overconstraint.case(name, "linear", "lower_top"))["outcome"] == "refused"


def test_a_load_that_pulls_away_is_refused_and_names_the_motion():
    row = atlas_runs.execute(study_7_iterations.sideways(-1e-3, "linear"))
    assert row["outcome"] == "refused" and "nothing holds body 'upper'" in row["message"]


@pytest.mark.parametrize("scene", SCENES)
def test_defaults_lie_inside_the_stable_regions(scene):
    """The scenes as they stand: no run fails but by the coarse mesh's checks, and none is told to close its gap."""
    run = {"axes": {}, "scene": scene, "settings": parameters(scene), "measures": []}
    row = atlas_runs.execute(run)
    assert row["outcome"] in ("solved", "check") and row["steps"] <= study_7_iterations.BAR, row
    assert set(filter(None, row["failed_checks"].split("; "))) <= OF_COARSE_MESHES
    assert "set initial_gap" not in row["warnings"]
    nu = [material["poisson"] for material in tomllib.loads(launch.scene_file(scene).read_text())["materials"].values()]
    assert max(nu) < 0.45
    if scene != "stack":  # whose bodies are a chain of three
        row = atlas_runs.execute({**run, "settings": {**run["settings"], "method.solver": "ddm"}})
        assert row["outcome"] in ("solved", "check"), row


def test_the_finer_side_is_the_default_and_is_cut_into_segments():
    row = atlas_runs.execute({"axes": {}, "scene": "patch_flat", "settings": {}, "measures": ["uniform"]})
    assert row["multipliers"] == 12 and row["p_error"] < 1e-11
    whole = {"axes": {}, "scene": "patch_flat", "settings": {"method.integration": "elements"}, "measures": ["uniform"]}
    assert atlas_runs.execute(whole)["p_error"] > 1e-4, "whole edges fail the patch test"


def test_mesh_of_the_atlas_is_the_area_it_should_be():
    text = atlas_mesh.mesh_text(atlas_mesh.plates(lambda x: 0.3, atlas_mesh.even(3), atlas_mesh.even(2)))
    assert text.count('"upper_bottom"') == 1 and "$EndElements" in text
    joined = atlas_mesh.mesh_text(
        atlas_mesh.plates(lambda x: 0.3, atlas_mesh.even(3), atlas_mesh.even(3)), join=[("upper", "lower")]
    )
    apart = atlas_mesh.mesh_text(atlas_mesh.plates(lambda x: 0.3, atlas_mesh.even(3), atlas_mesh.even(3)))
    count = lambda mesh: int(mesh.split("$Nodes\n")[1].split("\n")[0])
    assert count(apart) - count(joined) == 7, "the nodes of three quadratic edges are one"
