"""The table of cases, the conversion for FreeFEM, the comparison and the report, on made-up results."""

import itertools
import json
import math
import re
from dataclasses import replace

import meshio
import numpy as np
import pytest

import cases
import compare
import convert
import judge
import launch
import results_page
import run
import scene as scenes
from cases import StudyError
from judge import Figure, Result


# ---- The table of cases: what it expands to, and that it covers what it must ----

SCENES = {
    "patch_flat", "patch_inclined", "tent_a", "tent_b", "tent_c", "circle", "parabola_1", "parabola_2", "cosine",
    "rings", "shrink_fit",
}  # fmt: skip

FUNCTIONS = {"manufactured", "heated", "founded"}  # of place


@pytest.fixture(scope="module")
def table():
    return cases.all_cases()


@pytest.mark.parametrize("quick", [False, True])
def test_same_discretisation_covers_every_combination(table, quick):
    """Every scene with both sides, every space and both integrations; matching and not, the latter in both ways."""
    found = [case for case in table if case.level == "same_discretisation" and (case.quick or not quick)]
    found = [case for case in found if case.steps[0].condition == "bilateral"]
    assert {case.scene for case in found} - SCENES == {"stack", "wall", *FUNCTIONS}
    for scene in SCENES:
        mine = [case.steps[0] for case in found if case.scene == scene]
        sides = {step.side for step in mine}
        spaces = {(step.freefem["order"], step.mortise["multipliers"]) for step in mine}
        assert len(sides) == 2 and spaces == {(1, "linear"), (2, "linear"), (2, "quadratic")}
        wanted = set(itertools.product(sides, spaces, ["segments", "elements"]))
        space = lambda step: (step.freefem["order"], step.mortise["multipliers"])
        assert {(step.side, space(step), step.mortise["integration"]) for step in mine} == wanted
        ways = {(a > b) - (a < b) for a, b in (step.mesh for step in mine)}
        assert ways >= ({0, -1} if quick else {0, -1, 1})


def test_scenes_of_many_bodies(table):
    """Bearing and rod open; all are among the quick ones."""
    of = lambda scene: [case for case in table if case.scene == scene]
    assert all(any(case.quick for case in of(scene)) for scene in ("stack", "wall", "pellets", "rollers"))
    assert {case.scene for case in table if case.name.endswith("/feti")} == {"wall", "pellets"}
    opened = {case.scene for case in table if case.steps[0].condition == "unilateral" and case.side in scenes.SIDES}
    assert opened == {"pellets", "rollers", "sector"}
    assert {case.scene for case in table if "springs" in case.steps[0].freefem} == {"rollers"}


def test_same_problem_covers_every_scene_on_both_sides_by_series_that_halve_h_twice(table):
    found = [case for case in table if case.level == "same_problem"]
    assert {case.scene for case in found} == SCENES
    assert all(len({case.side for case in found if case.scene == scene}) == 2 for scene in SCENES)
    for case in found:
        first = case.steps[0].mesh
        assert [step.mesh for step in case.steps] == [tuple(k * n for n in first) for k in (1, 2, 4)]
        assert set(case.least_rates) <= set(case.limits) == {"energy", "displacement", "pressure", "pressure_inside"}


def test_no_limit_of_the_same_discretisation_is_above_1e_8(table):
    limits = [case.limits for case in table if case.level == "same_discretisation"]
    assert all(set(entry) - {"active"} == set(LIMITS) and max(entry.values()) <= 1e-8 for entry in limits)


def test_both_programs_take_the_same_discretisation(table):
    for case in table:
        step = case.steps[0]
        if step.same_nodes:
            if case.scene not in ("wall", "pellets", "rollers", "sector"):  # straight, of triangles
                assert step.mesh_parameters == {"kind": 1, "straight": 1, "order": step.freefem["order"]}
            assert step.freefem["gauss"] == step.freefem["order"] + 1
            assert all(step.freefem[key] == step.mortise[key] for key in ("multipliers", "integration"))


def test_gap_and_normals_of_each_case(table):
    """As [gaps] has them, or of the curves, which each kind of scene has on both sides, some of them quick."""
    gaps = {}
    for case in table:
        for step in case.steps:
            curve, scene = case.name.endswith("/curve"), case.name.endswith("/scene")
            assert (step.gap == "curve", step.gap == "scene") == (curve, scene)
            assert curve or scene or step.gap in ("closed", "measured")
            settings = {} if scene else {"contact.initial_gap": step.gap}
            assert run.contact_settings(step) == ({} if curve else {**settings, "method.normals": "edges"})
            if not curve:
                assert gaps.setdefault(case.scene, step.gap) == step.gap
    assert {scene for scene, gap in gaps.items() if gap == "measured"} == {
        "gap_close", "hertz", "hertz_sphere", "lid", "pellets", "punch", "rollers", "rough", "wetted",
    }
    curves = [case for case in table if case.name.endswith("/curve")]
    scenes_of = lambda cases: {(case.scene, case.steps[0].condition) for case in cases}
    assert scenes_of(curves) == scenes_of(case for case in curves if case.quick)
    assert scenes_of(curves) >= {("parabola_1", "bilateral"), ("cosine", "bilateral"), ("cosine", "unilateral")}
    assert all(case.steps[0].mortise["integration"] == "segments" for case in curves)


def test_a_scene_without_a_gap_is_refused():
    with pytest.raises(cases.StudyError, match="'new' 0 times"):
        cases.gap_of({"gaps": {"closed": ["old"]}}, "new")


def test_globs_choose_cases(table):
    name = "same_discretisation/parabola_1/8x10/P2-P1/segments/lower_contact"
    assert [case.name for case in cases.choose(table, [name], quick=False)] == [name]
    assert {case.scene for case in cases.choose(table, ["*/rings/*", "*/circle/*"], quick=True)} == {"rings", "circle"}
    assert all(case.quick for case in cases.choose(table, [], quick=True))
    assert not any(case.level == "timing" for case in cases.choose(table, [], quick=True))


def test_an_unknown_case_is_refused_with_the_nearest(table):
    with pytest.raises(cases.StudyError, match="no case matches(.|\n)*same_problem/parabola_1/"):
        cases.choose(table, ["same_problem/parabola_3/20x25-40x50-80x100/upper_contact"], quick=False)
    with pytest.raises(cases.StudyError, match="quick"):
        cases.choose(table, ["timing/*"], quick=True)


def test_ctest_runs_every_quick_case(table):
    tests = launch.MORTISE.parent / "tests/CTestTestfile.cmake"
    if not tests.exists():
        pytest.skip("a build without tests")
    globs = re.findall(r'crosscheck\.py" "--quick" "--case" "([^"]+)"', tests.read_text())
    assert [case.name for case in table if case.quick and not cases.matches(case.name, globs)] == []


@pytest.mark.parametrize("text", ["8", "8x", "8x10x12", "axb", "0x8"])
def test_a_mesh_that_is_none_is_refused(text):
    with pytest.raises(cases.StudyError, match="expected two numbers"):
        cases.mesh_size(text)


# ---- The conversion: triangles, labels, digits, and the case file ----

def two_squares(kind):
    """Two unit squares of one cell or two, the upper shifted to x = 1/3 by 0.7; curves low (tag 5) and high (tag 7)."""
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    middles = (corners + np.roll(corners, -1, axis=0)) / 2
    square = np.concatenate([corners, middles, [[0.5, 0.5]]])
    points = np.concatenate([square, square + [1 / 3, 1.7]])
    cells = {"quad8": [[0, 1, 2, 3, 4, 5, 6, 7]], "triangle6": [[0, 1, 2, 4, 5, 8], [0, 3, 2, 7, 6, 8]]}[kind]
    both = np.array(cells), np.array(cells) + 9
    lines = np.array([[2, 3, 6]]), np.array([[9, 10, 13]])
    blocks = [("line3", lines[0]), ("line3", lines[1]), (kind, both[0]), (kind, both[1])]
    names = {"low": [5, 1], "high": [7, 1], "lower": [9, 2], "upper": [2, 2]}
    empty = np.array([], dtype=int)
    sets = {n: [np.arange(len(blocks[i][1])) if i == k else empty for i in range(4)] for k, n in enumerate(names)}
    field = {name: np.array(value) for name, value in names.items()}
    return meshio.Mesh(np.pad(points, ((0, 0), (0, 1))), blocks, cell_sets=sets, field_data=field)


def area(body):
    a, b = (body.points[body.triangles[:, i]] - body.points[body.triangles[:, 0]] for i in (1, 2))
    return (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2


@pytest.mark.parametrize("kind", ["triangle6", "quad8"])
def test_bodies_of_a_mesh(kind):
    mesh = two_squares(kind)
    bodies = convert.read_bodies(mesh, ["lower", "upper"])
    for name, tag, y in (("lower", 5, 1), ("upper", 7, 1.7)):
        body = bodies[name]
        assert len(body.points) == 4 and len(body.triangles) == 2 and len(body.edges) == 4
        assert (area(body) > 0).all() and area(body).sum() == pytest.approx(1)
        (named,) = body.edges[body.labels == tag]
        np.testing.assert_array_equal(body.points[named, 1], y)
        assert sorted(body.labels) == [convert.UNNAMED] * 3 + [tag]
        assert convert.bodies_of_curve(bodies, tag) == [name]
    assert list(bodies) == list(convert.read_bodies(mesh, ["*er"])) == ["upper", "lower"]  # by their tags
    with pytest.raises(StudyError, match="no physical surface 'middle'"):
        convert.read_bodies(mesh, ["middle"])


def test_the_mesh_keeps_every_digit(tmp_path):
    """Of two bodies: vertices, triangles and edges, numbered from 1, each with its reference."""
    upper, lower = bodies = list(convert.read_bodies(two_squares("triangle6"), ["*"]).values())
    convert.write_mesh(bodies, tmp_path / "bodies.msh")
    counts, *lines = (tmp_path / "bodies.msh").read_text().splitlines()
    assert counts == "8 4 8" and len(lines) == 20
    rows = lambda first, last: np.array([list(map(float, line.split())) for line in lines[first:last]])
    np.testing.assert_array_equal(rows(0, 8)[:, :2], np.concatenate([upper.points, lower.points]))
    np.testing.assert_array_equal(rows(8, 12)[:, :3] - 1, np.concatenate([upper.triangles, lower.triangles + 4]))
    np.testing.assert_array_equal(rows(8, 12)[:, 3], [0, 0, 1, 1])
    np.testing.assert_array_equal(rows(12, 20)[:, :2] - 1, np.concatenate([upper.edges, lower.edges + 4]))
    np.testing.assert_array_equal(rows(12, 20)[:, 2], np.concatenate([upper.labels, lower.labels]))


def test_quadrilaterals_are_split_by_the_shorter_diagonal():
    points = np.array([[0, 0], [2, 0], [3, 1], [1, 1], [0, 2], [-1, 1]], dtype=float)
    leaning, other_way = [0, 1, 2, 3], [0, 3, 4, 5]
    triangles = convert.split_quadrilaterals(points, np.array([leaning, other_way]))
    assert triangles.tolist() == [[0, 1, 3], [1, 2, 3], [0, 3, 4], [0, 4, 5]]


def test_round_off_does_not_choose_the_diagonal():
    square = np.array([[0, 0], [1 + 1e-14, 0], [1 + 1e-14, 1], [1e-14, 1]])
    turned = np.array([[0, 0], [1 - 1e-14, 0], [1, 1], [-1e-14, 1]])
    for points in (square, turned):
        assert convert.split_quadrilaterals(points, np.array([[0, 1, 2, 3]])).tolist() == [[0, 1, 2], [0, 2, 3]]


def test_middles_of_the_sides_as_vtk_numbers_them():
    body = convert.read_bodies(two_squares("triangle6"), ["lower"])["lower"]
    points, cells = body.nodes(2)
    assert points.shape == (9, 2) and cells.shape == (2, 6)
    for cell in cells:
        for middle, (start, end) in zip(cell[3:], [(0, 1), (1, 2), (2, 0)]):
            np.testing.assert_array_equal(points[middle], (points[cell[start]] + points[cell[end]]) / 2)


def test_pairs_that_find_themselves():
    """Of the upper square, above the lower one and shifted by a third: its lower edge, and none of the others."""
    mesh = two_squares("triangle6")
    mesh.points[9:, 1] -= 0.6  # which leaves a gap of 0.1
    bodies, tags = convert.read_bodies(mesh, ["*"]), convert.curve_tags(mesh)
    names = lambda scene, side: [(a.name, b.name) for a, b in scenes.contact_pairs(scene, side, bodies, tags)]
    of = lambda first, second: {"contact": [{"between": [first, second]}]}
    assert names(of("low", "high"), "high") == names(of("l*", "h*"), "second") == [("high", "low")]
    assert names(of("*", "*"), "first") == [("high", "low")]  # the later one has the multipliers
    mesh.points[9:, 1] += 0.5
    bodies = convert.read_bodies(mesh, ["*"])
    assert names(of("*", "*"), "first") == [] and names(of("low", "high"), "low") == [("low", "high")]
    with pytest.raises(StudyError, match="between low and high"):
        names(of("low", "high"), "other")


# ---- The comparison: what each figure means, and that NaN and strange nodes do not pass ----

POINTS = np.array([[0, 0], [2, 0], [2, 1], [0, 1]], dtype=float)
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]])


def made_up(shift=0.0, pressure_shift=0.0):
    """One body twice with u = (x, 1), p = 2 + s / 4 on 41 nodes; FreeFEM's are off at one node, one pressure."""
    u = np.stack([POINTS[:, 0], np.ones(4)], axis=1)
    off = u.copy()
    off[2, 1] += shift
    s = np.linspace(0, 4, 41)
    p = 2 + s / 4
    wrong = p.copy()
    wrong[20] += pressure_shift
    second = compare.Field("b", POINTS + [0, 1], TRIANGLES, u, u.copy())
    fields = [compare.Field("a", POINTS, TRIANGLES, u, off), second]
    return compare.Comparison(fields, compare.Curve("curve", s, p, wrong), (100.0, 101.0))


def test_largest_differences():
    found = compare.largest_differences(made_up(shift=1e-3, pressure_shift=-3e-2))
    assert found["displacement"] == pytest.approx(1e-3 / math.hypot(2, 1.001))
    assert found["pressure"] == pytest.approx(1e-2)
    assert found["energy"] == pytest.approx(1e-2)
    assert compare.largest_differences(made_up())["displacement"] == 0


def test_free_bodies_are_compared_up_to_a_rigid_motion():
    """A translation and a rotation go, a strain stays."""
    moved, strained = (replace(made_up().fields[0]) for _ in range(2))
    moved.freefem = moved.mortise + [0.1, -0.2] + 0.3 * np.stack([-POINTS[:, 1], POINTS[:, 0]], axis=1)
    strained.freefem = moved.freefem + [0.01, 0] * POINTS
    assert np.abs(compare.without_rigid_difference(moved).freefem - moved.mortise).max() < 1e-15
    assert np.abs(compare.without_rigid_difference(strained).freefem - moved.mortise).max() > 5e-3


def test_a_tie_is_no_pressure():
    found = made_up()
    found.curve.mortise[3], found.curve.freefem[3] = 0, 4e-9
    assert compare.largest_differences(found)["active"] == 0
    found.curve.freefem[3] = 8e-9
    assert compare.largest_differences(found)["active"] == 1


def test_wet_is_a_state_too():
    """A row under a fluid's pressure alone is open; one that only one program has wet differs."""
    found = made_up()
    fluid = np.zeros(41)
    fluid[:7] = found.curve.mortise[:7]
    found.curve.fluid = fluid, fluid.copy()
    assert compare.largest_differences(found)["active"] == 0
    fluid[7] = 1.0
    assert compare.largest_differences(found)["active"] == 1


def test_mean_differences():
    found = compare.mean_differences(made_up(shift=0.3, pressure_shift=0.6), kinks=())
    areas = np.array([2 / 3, 1 / 3, 2 / 3, 1 / 3])
    np.testing.assert_allclose(compare.nodal_areas(POINTS, TRIANGLES), areas)
    size = 2 * (areas @ (POINTS[:, 0] ** 2 + 1))
    assert found["displacement"] == pytest.approx(0.3 * math.sqrt((2 / 3) / size))
    squares = np.trapz((2 + made_up().curve.s / 4) ** 2, dx=0.1)
    assert found["pressure"] == pytest.approx(0.6 * math.sqrt(0.1 / squares))
    assert found["pressure_inside"] == pytest.approx(0.6 / 2.5)


def test_inside_leaves_ends_and_kinks_out():
    s = np.linspace(3, 5, 101)
    kept = (s[compare.inside(s, [0.5])] - 3) / 2
    assert kept.min() > 0.10 and kept.max() < 0.90
    assert len(kept) == 101 - 2 * 11 - 21
    assert compare.mean_differences(made_up(pressure_shift=0.6), kinks=(0.5,))["pressure_inside"] == 0


def test_nan_holds_no_limit():
    broken = made_up()
    broken.curve.mortise[3] = math.nan
    value = compare.largest_differences(broken)["pressure"]
    assert math.isnan(value)
    assert not judge.Figure("pressure", value, 1e-8).ok
    assert not judge.Figure("rate of pressure", value, 1.0, is_rate=True).ok


def test_match_finds_the_partner_of_every_node():
    shuffled = POINTS[[2, 0, 3, 1]] + 1e-12
    np.testing.assert_array_equal(compare.match(POINTS, shuffled, 2.0, "body"), [1, 3, 0, 2])
    with pytest.raises(StudyError, match=r"body, mortise: nothing within 1e-10 .* \(2, 1\)"):
        compare.match(POINTS, POINTS + [[0, 0], [0, 0], [0, 1e-9], [0, 0]], 2.0, "body, mortise")
    with pytest.raises(StudyError, match="same partner"):
        compare.match(POINTS[[0, 0]], POINTS, 2.0, "body")


def test_rates():
    assert judge.rates([8.0, 2.0, 0.5]) == [2.0, 2.0]
    assert judge.mean_rate([8.0, 4.0, 0.5]) == 2.0
    assert math.isnan(judge.mean_rate([1.0, 0.0, 1.0]))


# ---- The report: complete, failed cases first, and every file that it names is there ----

LIMITS = {"displacement": 1e-8, "pressure": 1e-8, "energy": 1e-8}


def with_files(result, output):
    folder = output / result.folder
    folder.mkdir(parents=True)
    comparison = made_up(shift=1e-3, pressure_shift=1e-2)
    compare.write_difference(comparison, folder / "difference.vtu")
    compare.write_pressures(comparison.curve, folder / "pressure.csv")
    return result


def one_mesh(scene, value, status, message=""):
    name = f"same_discretisation/{scene}/8x10/P2-P1/segments/upper_contact"
    figures = [Figure(key, value, limit) for key, limit in LIMITS.items()] if status != "error" else []
    steps = [{"mesh": "8x10", "differences": dict.fromkeys(LIMITS, value)}] if status != "error" else []
    return Result(name, "same_discretisation", scene, "upper_contact", name, status, message, figures, steps)


def series(scene):
    name = f"same_problem/{scene}/8x10-16x20-32x40/upper_contact"
    keys = ("energy", "displacement", "pressure", "pressure_inside")
    steps = [{"mesh": f"{8 * k}x{10 * k}", "differences": dict.fromkeys(keys, 1e-2 / k**2)} for k in (1, 2, 4)]
    figures = [Figure(key, 1e-2 / 16, 1e-2) for key in keys] + [Figure("rate of energy", 2.0, 1.9, is_rate=True)]
    return Result(name, "same_problem", scene, "upper_contact", f"{name}/32x40", "ok", "", figures, steps)


@pytest.fixture(scope="module")
def output(tmp_path_factory):
    folder = tmp_path_factory.mktemp("report")
    timing = dict.fromkeys(("mortise", "freefem", "ratio", "mortise_solve", "freefem_solve", "ratio_solve"), 1.5)
    timed = Result("timing/circle/8x10", "timing", "circle", "upper_contact", "timing/circle/8x10")
    timed.timing = {"mesh": "8x10", "unknowns": 600, "multipliers": 11, "repeats": 3, **timing}
    drawn = [one_mesh("circle", 1e-12, "ok"), one_mesh("rings", 1e-5, "failed"), series("circle")]
    broken = one_mesh("cosine", math.nan, "error", "FreeFem++: exit status 1\nno <edge> of the mesh")
    results = [with_files(result, folder) for result in drawn] + [broken, timed]
    (folder / broken.folder).mkdir(parents=True)
    (folder / timed.folder).mkdir(parents=True)
    results_page.write(results, folder, 12.0)
    return folder


def test_every_file_that_the_page_names_is_there(output):
    names = re.findall(r"\]\(([^)]+)\)", (output / "crosscheck.md").read_text())
    shown = [name for name in names if name.endswith(".png")]
    assert sorted(shown) == sorted(str(path.relative_to(output)) for path in output.glob("pictures/*.png"))
    assert all(path.stat().st_size > 5000 for path in output.glob("pictures/*.png"))
    wanted = {"same_discretisation_rings.png", "same_problem_circle.png", "rates.png"}
    assert {f"pictures/{name}" for name in wanted} <= set(shown)
    assert all((output / name).exists() for name in names)


def test_failed_cases_come_first_and_errors_are_reported(output):
    text = (output / "crosscheck.md").read_text()
    cases = text[text.index("All cases") :]
    assert cases.index("rings/8x10") < cases.index("circle/8x10")
    assert "5 cases in 12 s. 2 do not hold." in text and "exit status 1" in text and "no <edge> of the mesh" in text
    assert text.index("## Same discretisation") < text.index("## Same problem") < text.index("## Time")


def test_json_holds_every_figure(output):
    table = json.loads((output / "report.json").read_text())
    assert table["cases"] == 5 and table["not_ok"] == 2
    rings = next(result for result in table["results"] if result["scene"] == "rings")
    figures = [(f["name"], f["value"], f["limit"], f["ok"]) for f in rings["figures"]]
    assert figures == [(name, 1e-5, 1e-8, False) for name in LIMITS]
    assert results_page.without_nan({"a": [math.nan, 1.0, math.inf]}) == {"a": [None, 1.0, None]}
