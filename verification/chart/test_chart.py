"""The chart: its arithmetic on hand-made data, and a quick run of everything with what must hold in it."""

import csv
import math
import shutil
from pathlib import Path

import numpy as np
import pytest

import advice
import chart
import chart_methods
import chart_runs  # makes launch known
import economy
import launch
import manufactured
import measure
import pareto
import peer_runs
import reference
import timing_check


def row(method, seconds, error, n=8, problem="manufactured"):
    size = {"n": n, "mesh": f"{n}x{n}", "dofs": n}
    return {"problem": problem, "method": method, **size, "s_total": seconds, "e_p_l2": error, "status": "solved"}


@pytest.fixture(scope="module")
def quick(mortise, tmp_path_factory):
    """Measured once each: what the seconds are, no test asks."""
    output, said = tmp_path_factory.mktemp("chart"), []
    with pytest.MonkeyPatch.context() as patch:
        for repeats in (chart_methods.TURNS, economy.REPEATS):
            patch.setitem(repeats, "quick", 1)
        patch.setattr(timing_check, "REPEATS", 1)
        store = chart_runs.make_store(output, True)
        rows, about = measure.measure(store, output, True, lambda text, start=None: said.append(text))
        yield {"output": output, "store": store, "rows": rows, "about": about, "said": said}


def series(rows, problem, method):
    return [r for r in rows if (r["problem"], r["method"]) == (problem, method)]


def test_front_is_what_nothing_beats():
    pairs = {"a": (1, 0.5), "b": (2, 0.5), "c": (2, 0.1), "d": (3, 0.2), "e": (4, 0.01), "f": (0.5, None)}
    points = [row(name, *pair) for name, pair in pairs.items()]
    assert [p["method"] for p in pareto.front(points, "e_p_l2")] == ["a", "c", "e"]
    assert [p["method"] for p in pareto.front([row("x", 1, 0.3), row("y", 1, 0.3)], "e_p_l2")] == ["x"]


def test_front_against_the_definition():
    random = np.random.default_rng(1)
    points = [row(str(i), *random.integers(1, 30, 2)) for i in range(200)]
    beats = lambda a, b: a["s_total"] <= b["s_total"] and a["e_p_l2"] <= b["e_p_l2"] and a is not b
    strictly = lambda a, b: beats(a, b) and (a["s_total"], a["e_p_l2"]) != (b["s_total"], b["e_p_l2"])
    best = {(p["s_total"], p["e_p_l2"]) for p in points if not any(strictly(q, p) for q in points)}
    assert {(p["s_total"], p["e_p_l2"]) for p in pareto.front(points, "e_p_l2")} == best


def test_advice_takes_the_quickest_that_is_good_enough():
    rows = [row("q8_linear", 1, 0.04), row("t3_linear", 0.5, 0.06)]
    rows += [row("q8_linear", 3, 0.009, 16), row("t3_linear", 9, 0.008, 32)]
    found = pareto.advice(rows, "e_p_l2", (0.05, 0.01, 0.001))
    assert found[0.05] is rows[0] and found[0.01] is rows[2] and found[0.001] is None


def test_advice_trusts_no_lucky_mesh_and_no_run_that_did_not_converge():
    rows = [row("a", 1, 0.001, 8), row("a", 4, 0.02, 16), row("a", 16, 0.005, 32), row("b", 20, 0.004, 8)]
    assert pareto.advice(rows, "e_p_l2", (0.01,))[0.01] is rows[2]
    rows[2]["status"] = "not_converged"
    assert pareto.advice(rows, "e_p_l2", (0.01,))[0.01] is rows[3]
    assert [p["method"] for p in pareto.front(rows, "e_p_l2")] == ["a"]


def test_seconds_between_two_meshes_follow_a_power_law():
    series = [row("a", 1, 0.1, 8), row("a", 4, 0.025, 16), row("a", 16, 0.1 / 16, 32)]
    assert pareto.seconds_at(series, "e_p_l2", 0.05) == pytest.approx(2)
    assert pareto.seconds_at(series, "e_p_l2", 0.01) == pytest.approx(10)
    assert pareto.seconds_at(series, "e_p_l2", 0.5) == 1 and pareto.seconds_at(series, "e_p_l2", 0.001) is None


def test_advice_prefers_the_simpler_method_where_seconds_are_as_good_as_equal():
    rows = [row("q8_ddm", 1.0, 0.01), row("q8_linear", 1.05, 0.01), row("q4_linear", 1.3, 0.01)]
    assert pareto.advice(rows, "e_p_l2", (0.01,), prefer=["q8_linear", "q8_ddm"])[0.01] is rows[1]
    rows[1]["s_total"] = 1.0 * pareto.AS_GOOD * 1.01
    assert pareto.advice(rows, "e_p_l2", (0.01,), prefer=["q8_linear", "q8_ddm"])[0.01] is rows[0]


def test_general_advice_weighs_all_problems_and_drops_who_fails_one():
    one = [row("a", 1, 0.01), row("b", 2, 0.01), row("c", 0.1, 0.2)]
    two = [row("a", 8, 0.01), row("b", 1, 0.01), row("c", 0.1, 0.01)]  # c is quickest, but fails in the first
    order = pareto.general([one, two], lambda rows: "e_p_l2", (0.05,))
    assert [method for method, _ in order] == ["b", "a"]
    assert order[0][1] == pytest.approx(math.sqrt(2 * 10)) and order[1][1] == pytest.approx(math.sqrt(1 * 80))


def test_rate_is_of_the_last_halving():
    rows = [row("a", 1, 1.0, 8), row("a", 2, 0.5, 16), row("a", 3, 0.125, 32)]
    assert pareto.rate(rows, "e_p_l2") == pytest.approx(2)
    assert pareto.rate(rows[:1], "e_p_l2") is None and pareto.rate(rows[::2], "e_p_l2") is None


def test_table_and_recommendation_of_made_up_data():
    rows = [row("q8_linear", 1, 0.04), row("q8_linear", 3, 0.0009, 16), row("freefem_p1", 0.1, 0.0001)]
    table = list(advice.table(rows))
    assert table[0][2:4] == ["Q8, linear (default)", "8x8"] and table[1][3] == table[2][3] == "16x16"
    assert any("For p: Q8, linear (default), 1 times the least" in text for text in advice.recommendation(rows))


def test_several_turns_are_one_row(mortise):
    named = [("q8_linear", chart_methods.size_settings("rings", (6, 8))), ("refused", {"method.solver": "none"})]
    rows, refused = chart_runs.by_turns("rings", named, 2)
    one = chart_runs.of_turns("q8_linear", rows["q8_linear"])
    assert one["turns"] == 2 and 0 < one["s_total_min"] <= one["s_total"] <= one["s_total_max"] and one["e_p_l2"] < 0.1
    assert rows["refused"] == [] and "method.solver" in refused["refused"]


def test_quick_run_has_every_row(quick):
    rows, levels = quick["rows"], chart_methods.LEVELS["quick"]
    refused = set(quick["about"]["left_out"])
    assert refused <= {"q8_mssor"}
    assert all(any(chart_methods.label(name) in text for text in quick["said"]) for name in refused)
    expected = {
        (problem, name, chart_methods.row_name(problem, name, chart_methods.mesh_of(problem, level)))
        for problem in chart_methods.PROBLEMS
        for level in range(levels)
        for name, *_ in [
            *chart_methods.ways(problem, level, True),
            *(way for way in chart_methods.peer_ways(level, True) if peer_runs.version(way[1])),
        ]
        if name not in refused
    }
    assert {(r["problem"], r["method"], r["mesh"]) for r in rows} == expected
    with open(quick["output"] / "chart.csv", newline="") as file:
        table = list(csv.DictReader(file))
    assert len(table) == len(rows) == len(expected) and tuple(table[0]) == chart_runs.COLUMNS
    assert all(float(r[key]) > 0 for r in table for key in ("s_total", "energy", "dofs", "multipliers"))


def test_quick_run_converges(quick):
    for problem, method, error in (
        ("manufactured", "q8_linear", "e_energy"),
        ("manufactured", "q8_linear", "e_p_l2"),
        ("manufactured", "t3_linear", "e_p_l2"),
        ("rings", "t3_linear", "e_energy"),
        ("rings", "q8_quadratic", "e_p_l2"),
        ("parabola_1", "q8_linear", "e_p_l2_inner"),
        ("parabola_1", "q8_graded", "e_energy"),
    ):
        least = 1.6 if method.startswith("q8") and problem == "manufactured" else 0.5
        assert pareto.rate(series(quick["rows"], problem, method), error) > least, (problem, method, error)


def test_domain_decomposition_has_the_mortar_methods_errors(quick):
    for problem in chart_methods.PROBLEMS:
        for ours, theirs in zip(*(series(quick["rows"], problem, m) for m in ("q8_linear", "q8_ddm"))):
            assert theirs["e_energy"] == pytest.approx(ours["e_energy"], rel=1e-5)


def test_the_manufactured_scene_is_as_its_script_writes_it():
    assert manufactured.scene_text() == Path(manufactured.__file__).with_suffix(".toml").read_text()


def test_getfem_on_the_same_elements_has_nearly_the_same_errors(quick):
    """It integrates without segments."""
    if not peer_runs.version("GetFEM"):
        pytest.skip("GetFEM is not installed (Debian: python3-getfem)")
    for problem in chart_methods.PROBLEMS:
        for ours, theirs in zip(*(series(quick["rows"], problem, m) for m in ("q8_linear", "getfem_q8"))):
            assert theirs["e_energy"] == pytest.approx(ours["e_energy"], rel=0.2), problem


def test_freefem_on_the_same_triangles_has_the_same_errors(freefem, quick):
    """With the normals of the edges, as FreeFEM's script takes them."""
    table, path = reference.reference(quick["store"], True)
    own = {"method.normals": "edges", "contact.initial_gap": "closed"}
    for problem in chart_methods.PROBLEMS:
        pairs = list(zip(*(series(quick["rows"], problem, m) for m in ("t3_linear", "freefem_p1"))))
        assert len(pairs) == chart_methods.LEVELS["quick"]
        for level, (_, theirs) in enumerate(pairs):
            mesh, against = chart_methods.mesh_of(problem, level), path if problem == "parabola_1" else None
            same = [("t3_edges", {**dict(chart_methods.ways(problem, level, True))["t3_linear"], **own})]
            rows, _ = chart_runs.of_mortise(quick["store"], problem, launch.mesh_name(mesh), same, 1, against)
            (edges,) = measure.completed(rows, problem, mesh, table)
            for error in ("e_energy", "e_p_l2_inner", "e_p_max_inner"):
                assert theirs[error] == pytest.approx(edges[error], rel=1e-6), (problem, mesh, error)


def test_without_other_programs_their_curves_are_missing_and_that_is_said(quick, tmp_path, monkeypatch):
    shutil.copytree(quick["output"], tmp_path / "chart")
    monkeypatch.setattr(peer_runs, "version", lambda program: None)
    said = []
    store = chart_runs.make_store(tmp_path / "chart", True)
    rows, _ = measure.measure(store, tmp_path / "chart", True, lambda text, start=None: said.append(text))
    for program in peer_runs.PROGRAMS:
        assert any(text.startswith(f"{program} is missing") for text in said)
        assert measure.machine(None)[program.lower()] == "missing"
    ours = [r for r in quick["rows"] if r["method"] not in chart_methods.PEERS]
    assert rows == ours


def test_a_second_run_repeats_nothing_and_all_is_drawn(quick, capsys):
    with pytest.raises(SystemExit) as left:
        chart.main(["--quick", "-o", str(quick["output"])])
    said = capsys.readouterr().out
    assert left.value.code == 0, said
    meshes = [line for line in said.splitlines() if "methods" in line]
    assert meshes and all(", kept" in line for line in meshes)
    page = (quick["output"] / "chart.md").read_text()
    for problem in chart_methods.PROBLEMS:
        assert f"{problem}.png" in page and (quick["output"] / f"{problem}.png").stat().st_size > 10000
    for text in ("What to use", "Are the seconds right?", "Model no more than a scene needs"):
        assert text in page


def test_half_models_have_the_same_pressure(quick):
    rows = economy.measure(quick["store"], True)
    assert {(r["study"], r["scene"]) for r in rows} == {
        *(("half", scene) for scene in economy.HALVES),
        *(("condition", scene) for scene in economy.CONDITIONS),
    }
    assert max(r["difference_of_p"] for r in rows) <= economy.SAME
    halves = [r for r in rows if r["study"] == "half"]
    assert all(2 * b["unknowns"] == pytest.approx(a["unknowns"], rel=0.05) for a, b in zip(halves[::2], halves[1::2]))


def test_a_half_model_of_another_line_is_found_out():
    first = np.array([[0.0, 1.0], [0.1, 2.0], [0.2, 3.0]])
    assert economy.largest_difference(first, first[:2]) == 0
    assert economy.largest_difference(first, first[:2] + [0, 0.5]) == 0.5
    assert economy.largest_difference(first, first[:2] + [0.01, 0]) == np.inf


def test_bad_calls_are_refused(tmp_path):
    with pytest.raises(SystemExit) as left:
        chart.main(["--quick", "--docs", "-o", str(tmp_path)])
    assert left.value.code not in (0, None)
