"""The case file for FreeFEM; functions of place: what is translated and what is refused."""

import numpy as np
import pytest

import convert
import launch
import run
import scene as scenes
from cases import StudyError
from expressions import Quantities, translate


@pytest.mark.parametrize("text, code", [
    ("1/2", "1.0 / 2.0"),  # of integers FreeFEM would take 0
    ("-x^2", "- (px) ^ 2.0"),
    ("1e-4*ln(r) + .5", "0.0001 * log ( (sqrt(px^2. + py^2.)) ) + 0.5"),
    ("x<=0.5 && y != 1 ? theta : pi", "(px) <= 0.5 && (py) != 1.0 ? (atan2(py, px)) : (pi)"),
    ("min(x, asinh(y))", "min ( (px) , asinh ( (py) ) )"),
])  # fmt: skip
def test_expressions_in_the_language_of_freefem(text, code):
    assert translate(text) == code


@pytest.mark.parametrize("text", ["s", "2 * s^2", "log2(x)", "x = 3", "x(2)", "sin", "x; exit(1)", "y % 2"])
def test_what_freefem_is_not_told_is_refused(text):
    with pytest.raises(StudyError):
        translate(text)


def test_values_are_numbers_or_named_expressions():
    values = Quantities()
    assert [values.word(3, 2), values.word("x"), values.word("y", 2.5), values.word("x")] == ["6.0", "f0", "f1", "f0"]
    assert "  if (k == 1) return 2.5 * ((py));" in values.script().splitlines()


def test_loads_and_supports_of_place():
    tags, values = {"top": 3, "bottom": 4}, Quantities()
    boundary = [
        {"on": "top", "traction": [0, "x"]}, {"on": "bottom", "foundation": "1 + y"},
        {"on": "bottom", "foundation": [1e9, 0]}, {"on": "bottom", "displacement": {"x": "y"}},
    ]  # fmt: skip
    assert list(scenes.boundary_lines({"boundary": boundary}, tags, values, {})) == [
        "traction 3 0.0 f0", "foundation 4 normal f1", "foundation 4 axes 1000000000.0 0.0", "displacement 4 x f2",
    ]  # fmt: skip
    with pytest.raises(StudyError, match="spring"):
        list(scenes.boundary_lines({"boundary": [{"on": "top", "spring": 1e9}]}, tags, values, {}))


def test_a_force_is_a_constant_traction_on_all_its_curves():
    """Whatever their lengths; round an axis on the whole ring. On points FreeFEM has none."""
    tags = {"left": 5, "right": 6}
    points = np.array([[1.0, 0], [1, 2], [3, 0], [3, 1]])
    body = convert.Body("block", points, np.zeros((0, 3), int), np.array([[0, 1], [2, 3]]), np.array([5, 6]))
    lines = lambda on, plane: list(scenes.boundary_lines(
        {"boundary": [{"on": on, "force": [0, -6]}]}, tags, Quantities(), scenes.areas_of_curves({"block": body}, tags, plane)
    ))  # fmt: skip
    assert lines(["left", "right"], "strain") == ["traction 5 0.0 -2.0", "traction 6 0.0 -2.0"]
    (text,) = lines("right", "axisymmetric")
    assert text.startswith("traction 6 0.0 ") and float(text.split()[-1]) == pytest.approx(-6 / (2 * np.pi * 3))
    with pytest.raises(StudyError, match="points"):
        lines("corner", "strain")


def test_gravity_is_a_body_force_and_temperature_a_strain():
    scene = {
        "model": {"gravity": [0, -10]}, "bodies": {"*": "a"}, "contact": [{"initial_gap": "x"}],
        "materials": {"a": {"young": 1, "poisson": 0, "density": 5, "thermal_expansion": 2}},
        "initial_strain": [{"body": "b", "temperature_change": "y"}],
    }  # fmt: skip
    lines = list(scenes.body_lines(scene, ["b"], Quantities()))
    assert lines == ["body 1.0 0.0", "initial_strain 0 f0 f0 f0 0.0", "body_force 0 0.0 -50.0"]
    assert scenes.gap_lines(scene, "scene", Quantities()) == ["gap f0"]


def test_case_file_holds_the_physics_of_the_scene():
    """shrink_fit: two materials, a temperature change, symmetry planes."""
    scene = scenes.read_scene(launch.ROOT / "geo/shrink_fit.toml", {})
    tags = {"inner_cut_x": 2, "inner_contact": 3, "inner_cut_y": 4}
    tags |= {"outer_cut_x": 7, "outer_cut_y": 9, "outer_contact": 10}
    freefem = {"order": 2, "multipliers": "quadratic", "integration": "elements", "gauss": 3}
    lines = scenes.case_text(scene, ["outer", "inner"], [[10, 3]], tags, freefem, "closed", Quantities(), {}).splitlines()
    strain = repr(12e-6 * -100)
    assert lines[:2] == ["plane strain", f"mesh {scenes.MESH}"]
    assert lines[2:4] == ["body 70000000000.0 0.3", "body 210000000000.0 0.3"]
    assert lines[-1] == "end"
    assert set(lines[4:-1]) == {
        "contact 10 3", "order 2", "multipliers 2", "integration elements", "gauss 3", "gap closed",
        "displacement 2 y 0.0", "displacement 7 y 0.0", "displacement 4 x 0.0", "displacement 9 x 0.0",
        f"initial_strain 0 {strain} {strain} {strain} 0.0",
    }  # fmt: skip
    scene["model"]["thickness"] = 0.2
    thick = scenes.case_text(scene, ["outer", "inner"], [[10, 3]], tags, freefem, "closed", Quantities(), {}).splitlines()
    assert set(thick) - set(lines) == {"thickness 0.2"}
    of_curves = scenes.case_text(scene, ["outer", "inner"], [[10, 3]], tags, freefem, "curve", Quantities(), {}).splitlines()
    assert set(of_curves) ^ set(thick) == {"gap closed", "gap given", f"points {scenes.POINTS}"}


def test_a_fluid_has_a_line_for_each_place_it_comes_from():
    """By the number of its pair; beside laws and cuts FreeFEM has none."""
    tags = {"foot": 3, "top": 7, "low": 8, "high": 9}
    fluid = {"between": ["foot", "top"], "fluid": {"pressure": 2, "from": [[1, 0], [-1, 0]]}}
    lines = lambda *entries: list(scenes.fluid_lines({"contact": [*entries]}, [[8, 9], [7, 3]], tags))
    assert lines({"between": ["low", "high"]}, fluid) == ["fluid 1 2.0 1.0 0.0", "fluid 1 2.0 -1.0 0.0"]
    one_place = fluid | {"fluid": {"pressure": 2, "from": [1, 0]}}
    assert lines(one_place) == ["fluid 1 2.0 1.0 0.0"]
    with pytest.raises(StudyError, match="FreeFEM is not told contact.0.fluid beside contact.0.stiffness"):
        lines(fluid | {"stiffness": 1e9})
    with pytest.raises(StudyError, match='FreeFEM is not told contact.1.fluid beside condition = "cyclic"'):
        lines({"between": ["low", "high"], "condition": "cyclic"}, fluid)


def test_the_cuts_of_a_sector_are_no_contact():
    """The curve that follows is first, by the side; gap and condition are the other entries'."""
    cuts = {"between": ["low", "high"], "condition": "cyclic"}
    scene, tags = {"contact": [cuts, {"between": ["foot", "top"]}]}, {"low": 8, "high": 9}
    lines = lambda side: list(scenes.cut_lines(scene, side, tags))
    assert lines("first") == ["cyclic 8 9"] and lines("second") == ["cyclic 9 8"]
    settings = {"contact.condition": "unilateral", "method.normals": "edges"}
    assert run.of_each_contact(scene, settings) == {"contact.1.condition": "unilateral", "method.normals": "edges"}
    scene["contact"][0] = cuts | {"pretension": 5}
    with pytest.raises(StudyError, match="FreeFEM is not told 'pretension'"):
        lines("first")


def test_patterns_and_values_of_a_case():
    """A body's own name counts before a pattern, and a case's value before the scene's."""
    settings = {"materials.stone.young": 5, "bodies.brick_1_1": "stone", "boundary.0.displacement": {"y": 0}}
    scene = scenes.read_scene(launch.ROOT / "geo/wall.toml", settings)
    assert scenes.material_of(scene, "brick_1_1") == {"young": 5}
    assert scenes.material_of(scene, "brick_1_2") == scene["materials"]["brick"]
    assert scene["boundary"][0] == {"on": ["bottom"], "displacement": {"y": 0}}
    assert run.inline(settings["boundary.0.displacement"]) == "{ y = 0 }"
    bodies = ["brick_0_0", "brick_1_1"]
    scene["materials"] = {name: {"young": young, "poisson": 0} for name, young in (("brick", 1), ("stone", 5))}
    lines = list(scenes.body_lines(scene, bodies, Quantities()))
    assert lines == ["body 1.0 0.0", "body 5.0 0.0", "body_force 0 0.0 -20000.0", "body_force 1 0.0 -20000.0"]
