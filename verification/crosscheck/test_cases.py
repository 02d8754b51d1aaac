"""The table of cases: what it expands to, and that it covers what it must."""

import itertools

import pytest

import cases

SCENES = {
    "patch_flat", "patch_inclined", "tent_a", "tent_b", "tent_c", "circle", "parabola_1", "parabola_2", "cosine",
    "rings", "shrink_fit",
}  # fmt: skip


@pytest.fixture(scope="module")
def table():
    return cases.all_cases()


@pytest.mark.parametrize("quick", [False, True])
def test_same_discretisation_covers_every_combination(table, quick):
    """Every scene with both sides, every space and both integrations; matching and not, the latter in both ways."""
    found = [case for case in table if case.level == "same_discretisation" and (case.quick or not quick)]
    found = [case for case in found if case.steps[0].condition == "bilateral"]
    assert {case.scene for case in found} == SCENES
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


def test_same_problem_covers_every_scene_on_both_sides(table):
    found = [case for case in table if case.level == "same_problem"]
    assert {case.scene for case in found} == SCENES
    assert all(len({case.side for case in found if case.scene == scene}) == 2 for scene in SCENES)


def test_each_series_halves_h_twice(table):
    for case in table:
        if case.level == "same_problem":
            first = case.steps[0].mesh
            assert [step.mesh for step in case.steps] == [tuple(k * n for n in first) for k in (1, 2, 4)]
            assert set(case.limits) == {"energy", "displacement", "pressure", "pressure_inside"}
            assert set(case.least_rates) <= set(case.limits)


def test_no_limit_of_the_same_discretisation_is_above_1e_8(table):
    limits = [case.limits for case in table if case.level == "same_discretisation"]
    assert all(set(entry) - {"active"} == {"displacement", "pressure", "energy"} and max(entry.values()) <= 1e-8 for entry in limits)


def test_both_programs_take_the_same_discretisation(table):
    for case in table:
        step = case.steps[0]
        if step.same_nodes:
            assert step.mesh_parameters == {"kind": 1, "straight": 1, "order": step.freefem["order"]}
            assert step.freefem["gauss"] == step.freefem["order"] + 1
            assert all(step.freefem[key] == step.mortise[key] for key in ("multipliers", "integration"))


def test_globs_choose_cases(table):
    name = "same_discretisation/parabola_1/8x10/P2-P1/segments/lower_contact"
    assert [case.name for case in cases.choose(table, [name], quick=False)] == [name]
    assert {case.scene for case in cases.choose(table, ["*/rings/*", "*/circle/*"], quick=True)} == {"rings", "circle"}
    assert all(case.quick for case in cases.choose(table, [], quick=True))
    assert not any(case.level == "timing" for case in cases.choose(table, [], quick=True))


def test_an_unknown_case_is_refused_with_the_nearest(table):
    with pytest.raises(cases.CaseError, match="no case matches(.|\n)*same_problem/parabola_1/"):
        cases.choose(table, ["same_problem/parabola_3/20x25-40x50-80x100/upper_contact"], quick=False)
    with pytest.raises(cases.CaseError, match="quick"):
        cases.choose(table, ["timing/*"], quick=True)


@pytest.mark.parametrize("text", ["8", "8x", "8x10x12", "axb", "0x8"])
def test_a_mesh_that_is_none_is_refused(text):
    with pytest.raises(cases.CaseError, match="expected two numbers"):
        cases.mesh_size(text)
