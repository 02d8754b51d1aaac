"""The cases that are held against references: made again by their seed, references against closed forms, wrong answers."""

import sys
from pathlib import Path
from random import Random

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "exact"))

import assemblies
import assembly_oracles
import data_cases
import fuzz
import layer
import one_call
import outline_cases
import place_functions
import references
from drawings import scene_of, scene_text
from make_case import HELD, make_case


@pytest.fixture(scope="module")
def program(mortise):
    return one_call.Program(str(mortise))


def flat_blocks():
    """Two blocks of one material, 0.4 and 0.3 high, under p = 1e-3."""
    blocks = data_cases.Blocks(0.0, 0.7, 0.4, 0.0, "flat")
    return blocks, scene_of(Random(1), blocks.drawing(1.0, ("strain",)))


def pressure_of(program, blocks, scene, feature, key):
    mesh = data_cases.reference_mesh(blocks, "strain", feature, key, 1, ())
    line = references.References(program).line({"scene.toml": scene_text(scene, "mesh.msh"), "mesh.msh": mesh})
    return line.x[:, 0], line.p


def strips(count):
    """Between the rollers lies a half wave, `count` of which make the feature's: faces of the strips as of layer.py. From
    the upper one's faces the pressure of the line per pressure on top, and per gap / (2 / (E' k))."""
    k = np.pi * count
    alike, one_way = (faces for faces in layer.faces(0.3 * k))
    lower = layer.faces(0.8 * k)[0]  # the ground is a plane of symmetry
    soft = (alike + one_way) / 2 + lower
    return (one_way - alike) / 2 / soft, 1 / soft, k


def test_a_wave_of_load_arrives_as_in_strips(program):
    blocks, scene = flat_blocks()
    scene["boundary"][1]["pressure"] = f"1e-3 * (1 + 0.5 * cos({2 * np.pi!r} * x))"
    x, p = pressure_of(program, blocks, scene, place_functions.wave(Random(1), 0.25, 0.1), "pressure")
    exact = 1e-3 * (1 + 0.5 * strips(2)[0] * np.cos(2 * np.pi * x))
    assert np.abs(p - exact).max() < 1e-5 * 1e-3


def test_a_wave_of_the_gap_presses_as_in_strips(program):
    blocks, scene = flat_blocks()
    scene["contact"][0]["initial_gap"] = f"1e-5 * cos({8 * np.pi!r} * x)"
    x, p = pressure_of(program, blocks, scene, place_functions.wave(Random(1), 0.25, 0.1), "initial_gap")
    _, per_gap, k = strips(8)
    stiff = 1 / (1 - scene["materials"]["one"]["poisson"] ** 2)
    exact = 1e-3 - 1e-5 * stiff * k / 2 * per_gap * np.cos(8 * np.pi * x)
    assert np.abs(p - exact).max() < 1e-4 * 1e-3


def test_the_tip_of_a_cone_has_a_logarithm(program):
    """p = E' / 2 slope / 2 arccosh(a / r) of a flat cone, both bodies elastic (Sneddon 1965): the part in log r is that of
    the tip, whatever is far away."""
    drawing = outline_cases.cone_of(0.01, 1.0, 0.2, "axisymmetric")
    scene = scene_of(Random(1), drawing)
    files = {"scene.toml": scene_text(scene, "mesh.geo"), "mesh.geo": outline_cases.reference_geo(drawing, 1, ())}
    line = references.References(program).line(files)
    x = line.x[:, 0]
    inner = (x > 1e-3) & (x < 2e-2)
    slope = np.polyfit(np.log(x[inner]), line.p[inner], 1)[0]
    stiff = 1 / (1 - scene["materials"]["one"]["poisson"] ** 2)
    assert slope == pytest.approx(-stiff * 0.01 / 4, rel=0.01)


@pytest.mark.parametrize("kind", HELD)
def test_a_case_is_the_same_again(kind):
    first, second = ([make_case("pytest", number, (kind,)) for number in range(12)] for _ in range(2))
    assert [case.files for case in first] == [case.files for case in second]
    if first[0].reference:
        assert first[0].reference(4, ()) == first[1].reference(4, ()) != first[4].reference(4, ())


def test_a_graded_mesh_has_its_vertices():
    marks = [place_functions.jump(0.3), place_functions.Mark(0.7, 1e-3, 0.05)]
    x = data_cases.graded_grid.lines(0, 1, marks, 0.1)
    assert 0.3 in x and x[0] == 0 and x[-1] == 1 and np.diff(x).max() < 0.1001
    assert np.diff(x)[np.abs(x[1:] - 0.7) < 0.05].max() < 1.1e-3 and np.diff(x).min() > place_functions.JUMP / 2


def answer(case, program, tmp_path, change):
    """What an answer is worth whose p is changed."""
    tmp_path.mkdir(exist_ok=True)
    case.write(tmp_path)
    run = one_call.call(program, case, tmp_path)
    table = tmp_path / "results/contact.csv"
    if table.exists():  # of one that is refused there is none
        rows = [row.split(",") for row in table.read_text().splitlines()]
        at = rows[0].index("p")
        for row in rows[1:]:
            row[at] = repr(change(float(row[at])))
        table.write_text("\n".join(",".join(row) for row in rows) + "\n")
    return (case.judge or references.judge)(case, run, tmp_path, references.References(program))


@pytest.mark.parametrize("factor,label", [(1, "kept"), (1.07, "short"), (1.2, "worse")])
def test_an_answer_is_worth_what_it_is_off_by(program, tmp_path, factor, label):
    """5 % are asked for of blocks under an even load but for a wave that fades."""
    blocks, scene = flat_blocks()
    case = data_cases.held_case("data", "", "", scene, blocks.drawing(1.0, ("strain",)), 1, 1, None)
    feature, case.asked, text = place_functions.wave(Random(1), 0.25, 0.1), 0.05, scene_text(scene, "mesh.msh")
    mesh = lambda *how: data_cases.reference_mesh(blocks, "strain", feature, "pressure", *how)
    case.reference = lambda *how: {"scene.toml": text, "mesh.msh": mesh(*how)}
    assert answer(case, program, tmp_path, lambda p: factor * p)[0] == label


def test_beyond_the_end_of_a_line_there_is_no_pressure():
    """A punch's line on a wider block: p(x) = 1 + x from 0 to 1."""
    x = np.linspace(0, 1, 5)
    pressure = references.within(references.Line(np.column_stack([x, 0 * x]), 1 + x, 0 * x))
    assert pressure(np.array([[-0.1, 0], [0, 0], [0.3, 0.01], [1, 0], [1.01, 0]])) == pytest.approx([0, 1, 1.3, 2, 0])


def test_words_with_the_place_are_told_from_others():
    case = make_case("pytest", 0, ("data",))
    case.named, case.places = ["boundary.1", "pressure"], [(0.4, None)]
    says = lambda text: references.names_place([text], case)
    assert says("boundary.1 (line 3): the pressure varies") and says("something near (0.41, 0.9)")
    assert not says("the contact pressure is off") and not says("something near (0.9, 0.4)")


def logs(force, walls=True):
    """A log between two walls, on a floor."""
    parts = [assemblies.block("floor", -3.0, -1.0, 3.0, 0.0, held=assemblies.GROUND),
             assemblies.block("west", -3.0, 0.1, -1.0, 2.0, held={"left": "xy"}),
             assemblies.disc("log", 0.0, 1.0, 1.0, force)]  # fmt: skip
    pairs = [("log_rim", "floor_top"), ("log_rim", "west_right")]
    return assemblies.Assembly("log", parts, pairs if walls else pairs[:1], 0.3)


@pytest.mark.parametrize("force,walls,carried", [
    ((0.0, -1.0), True, True), ((-1.0, -1.0), True, True), ((0.0, -1.0), False, True), ((0.0, 1.0), False, False),
    # Places of the floor or the wall that face the log from afar bear the load a little, if they count: not decided.
    ((1.0, -0.1), True, None), ((-0.1, -1.0), False, None),
])  # fmt: skip
def test_what_carries_a_log(force, walls, carried):
    assert assembly_oracles.feasible(logs(force, walls)) == carried


def test_a_keystone_stands_and_longer_arches_do_not():
    """Without friction: of three voussoirs the middle one is a wedge; of five and more those beside it slide out."""
    made = [assemblies.arch(Random(random_seed), 1e-5) for random_seed in range(40)]
    assert {assembly_oracles.feasible(arch) for arch in made if len(arch.parts) == 3} == {True}
    assert {assembly_oracles.feasible(arch) for arch in made if len(arch.parts) >= 5} == {False}


def test_a_wrong_answer_to_an_assembly_is_found(program, tmp_path):
    case = next(made for made in (make_case("pytest", k, ("assembly",)) for k in range(99))
                if made.setting.what == "pin" and assembly_oracles.feasible(made.setting))  # fmt: skip
    case.variant, case.other = "feti", case.files
    assert answer(case, program, tmp_path / "right", lambda p: p) == ("kept", None)
    assert "p down to" in answer(case, program, tmp_path / "wrong", lambda p: -p)[1]


@pytest.mark.parametrize("numbered", ["1127:36", "1127:10", "1127:184", "911:155", "1127:88", "911:78"])
def test_bars_that_were_too_small(program, tmp_path, numbered):
    """A force in a cell beside the line, foundations that an edge does not follow, waves shorter than windows on linear
    triangles, ends of layers between rollers and between free faces that lean."""
    seed, number = numbered.split(":")
    assert answer(make_case(seed, int(number), ("data",)), program, tmp_path, lambda p: p) == ("kept", None)


@pytest.mark.parametrize("numbered", ["61:35", "61:52", "71:248", "71:310", "71:628", "81:665", "91:279", "101:649", "201:71", "71:333", "111:1686", "1001:151", "1001:1556", "1003:2150", "1004:845"])
def test_assemblies_that_went_round(program, tmp_path, numbered):
    """Far gaps, motions that rows hold by their normals' errors alone, several such at once, a wall far from the origin,
    loads along motions that nothing holds, sets that come again by round-off, a load that finer meshes carry, forces of 1e-166."""
    seed, number = numbered.split(":")
    label, wrong = answer(make_case(seed, int(number), ("assembly",)), program, tmp_path, lambda p: p)
    assert wrong is None and label in ("kept", "refused")


def test_a_fluid_presses_once_beside_motions_that_are_held(program):
    """Discs between two plane sides may all slide: they are solved a second time, with the slide by which they move least. From both
    ends of the first gap a fluid drives no slide, but for what the meshes of twins make of that; from one it does."""
    case = make_case(778001, 84, ("assembly",))
    outcome, _ = fuzz.examine(program, case, references.References(program))
    assert outcome.status == 1 and "the fluid in the gaps pushes it" in outcome.said
    case.files["scene.toml"] = case.files["scene.toml"].replace(b"from = [-1.0, -1.5]", b"from = [[-1.0, -1.5], [-1.0, 1.5]]")
    outcome, wrong = fuzz.examine(program, case, references.References(program))
    assert outcome.status in (0, 2) and not [said for _, said in wrong if "nothing holds" not in said]
