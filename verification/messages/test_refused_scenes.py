"""Messages of scenes: what is refused, before the solve or by it, and what is told of results."""

import dataclasses

import pytest

import msh_file
import plates
from plates_scene import PLATES, SCENE


@pytest.mark.parametrize("setting, message", [
    ("boundary.2.pressure=[1]", "expected a number or an expression"),
    ("boundary.2={ on = \"upper_top\", traction = 1 }", "expected a list of two numbers or expressions [x, y]"),
    ("boundary.2.on=[]", "expected a list of names"),
    ("contact=1", "expected entries that each start with [[contact]]"),
    ('contact.0={ between = ["upper_bottom", "lower_top"], initial_gap = "closed", clearance = 1 }',
     "is added to the gap that is drawn, but initial_gap = 'closed'; expected one of them"),
    ("novalue", "expected KEY=VALUE, for example method.kind=ddm"),
    ("a..b=1", "'a..b' is not a dotted key; expected one such as method.kind or boundary.2.pressure"),
    ("accuracy.value=0.01", "a mesh has no geometry to refine; expected mesh.file = a .geo (with a .msh every solve"),
    ("materials.wood={ young = 1, poisson = 0 }", "no body has the material 'wood'; expected it in [bodies]"),
    ("bodies={}", "is empty; expected at least one entry surface = \"material\""),
    ('bodies={ "" = "steel" }', "the name of the body is empty; expected a physical surface of the mesh"),
    ("bodies={ lower = \"steel\" }", "bodies: body 'upper' of plates.msh has no material"),
    ('initial_strain=[{ body = "lower", strain = {} }]', "is empty; expected at least one of xx, yy, zz, xy"),
    ('initial_strain=[{ body = "lower", strain = { xx = 2 } }]', "expected a strain below 1, found 2"),
    ('initial_strain=[{ body = "lower", temperature_change = 2 }]',
     "body 'lower' has the material 'steel' without thermal_expansion"),
    ("boundary.0.displacement={ x = 0, normal = 0 }", "names several directions; expected x, y or both"),
    ("boundary.0.displacement={ direction = [0, 0], value = 0 }", "has no length; expected a direction, [dx, dy]"),
    ("boundary.2={ on = \"upper_top\", pressure = 1e12 }",
     "expected a load below every Young's modulus (the largest is 2.1e+11"),
    ("boundary.2={ on = \"upper_top\", spring = [-1, 1] }", "expected a stiffness > 0, or two >= 0, [kx, ky]"),
    ("boundary.2={ on = \"upper_top\", spring = 1 }",
     "is a curve; expected a physical point for a spring (along curves: 'foundation')"),
    ("boundary.2={ on = \"upper_top\", foundation = \"0.5 - x\" }", "; expected a modulus >= 0"),
    ('contact.0.between=["upper_bottom"]', "expected a list of two names, found "),
    ('contact.0.between=["upper_bottom", "upper_bottom"]', "expected two different curves, found 'upper_bottom' twice"),
    ("contact.0.multipliers_on=upper_top", "unknown curve of this pair 'upper_top'"),
    ("contact.0.stiffness=[[1, 2], [2, 1]]",
     "contact.0.stiffness.1: expected [overlap, pressure] above [1, 2], the row before, found [2, 1]"),
    ("contact.0.stiffness=[[0, 1]]", "contact.0.stiffness.0: expected [overlap, pressure] > 0, found [0, 1]"),
    ("contact.0.stiffness=true",
     "expected a number > 0, a list of rows [overlap, pressure], or { pressure, overlap, exponent }, found true"),
    ("contact.0.stiffness={ pressure = 1, overlap = 1, exponent = 0.5 }", "expected a number from 1 to 20, found 0.5"),
    ("contact.0.initial_gap=[]", "expected a length, an expression or a word, found "),
    ("contact.0.within=1", 'goes with between = patterns, such as ["block_*", "block_*"], whose pairs are found'),
    ('copies=[{ body = "lower", name = "a\\"b", places = [[0, 1]] }]',
     "expected one line of text without quotation marks, found "),
    ("materials.steel={ young = [1, 1, 1], poisson = [0.9, 0.9, 0.9], shear = 1 }",
     "found ratios that with 'young' give some strains a negative energy; expected nu_ij^2"),
    ("materials.steel={ stiffness = [1, 2, 3, 4] }", "expected a row of four numbers"),
    ("materials.steel={ stiffness = [[1, 2, 0, 0], [2, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]] }",
     "gives some strains no positive energy; expected a positive definite matrix"),
    ("mesh.parameters={ n = 1 }", "a mesh file is meshed already and takes no parameters; expected a .geo, found"),
    ("method={ kind = \"ddm\", solver = \"direct\" }", "contradict one another; expected solver alone"),
    ("model={ plane = \"axisymmetric\", thickness = 2 }",
     'an axisymmetric model has none; expected plane = "strain" or "stress" with it'),
    ("boundary.2={ on = \"upper_top\", pressure = \"x = 1\" }", "assigns a value; expected == for a comparison"),
    ("boundary.2={ on = \"upper_top\", pressure = \"x, 1\" }", "has a comma; expected one value"),
    ("boundary.0={ on = \"lower_bottom\", displacement = { x = 0 } }",
     "; expected prescribed displacements or contact that prevent it"),
    ("boundary.1={ on = [\"lower_left\", \"upper_left\"], rigid = { x = 0 } }",
     "makes a node rigid whose displacement y another entry prescribes as 0"),
])  # fmt: skip
def test_scene_is_refused(said, setting, message):
    assert message in said(setting)


@pytest.mark.parametrize("more, message", [
    ("[[contact]]\nbetween = ['upper_bottom', 'lower_top']", "stands twice, in contact.0 (line 14) too; expected once"),
    ("[[boundary]]\non = 'upper_right'\nrigid = {}\n[[boundary]]\non = 'upper_right'\n"
     "displacement = { direction = [1, 1], value = 0 }", "holds a node of a rigid curve; expected no other support there"),
    ("[[boundary]]\non = 'upper_right'\ndisplacement = { direction = [1, 1], value = 0 }\n[[boundary]]\n"
     "on = 'upper_right'\nrigid = {}",
     "makes a node rigid that is held along another direction or rigid already; expected no such support"),
    ("[[contact]]\nbetween = ['upper_right', 'lower_left']\ncondition = 'tied'",
     "do not face each other anywhere; expected curves that coincide"),
    ("[oops", "not valid TOML: "),
])  # fmt: skip
def test_scene_with_more_is_refused(said, more, message):
    assert message in said(more=more)


def twice_named():
    """The plates with a second name for the right side of the lower one, and for the top."""
    mesh = dataclasses.replace(PLATES, edges=list(PLATES.edges), curves=list(PLATES.curves))
    for name in ("lower_right", "upper_top"):
        number = PLATES.curves.index(name)
        mesh.edges += [(len(mesh.curves), kind, nodes) for curve, kind, nodes in PLATES.edges if curve == number]
        mesh.curves.append("again_" + name)
    return msh_file.write(msh_file.sections(mesh, "2.2 ascii"), "2.2 ascii")


@pytest.mark.parametrize("more, message", [
    ("[[boundary]]\non = 'again_upper_top'\npressure = 1",
     "load the same edges, near (0.5, 2)"),
    ("[[boundary]]\non = 'lower_right'\ndisplacement = { direction = [1, 1], value = 1 }\n[[boundary]]\n"
     "on = 'again_lower_right'\ndisplacement = { direction = [1, -1], value = 3 }",
     "prescribes a displacement of 3 along (0.707107, -0.707107), where another entry makes it 1; expected one value a node"),
])  # fmt: skip
def test_edges_of_two_names(said, more, message):
    assert message in said(more=more, files={"plates.msh": twice_named()})


def test_loads_of_two_names_are_told_with_their_length(said):
    found = said(more="[[boundary]]\non = 'again_upper_top'\npressure = 1", files={"plates.msh": twice_named()})
    assert "and over a length of 1 in all: they would add up; expected at most one load on each edge" in found


def test_temperature_is_too_high(said):
    scene = SCENE.replace("poisson = 0.3 }", "poisson = 0.3, thermal_expansion = 1e-5 }")
    found = said('initial_strain=[{ body = "lower", temperature_change = 1e6 }]', scene=scene)
    assert "expected a thermal strain below 1, found " in found


def test_rings(said):
    rings = "model.plane=axisymmetric"
    rigid = "[[boundary]]\non = 'upper_right'\nrigid = { x = 0 }"
    assert "rings that are rigid move along the axis alone; expected y or force" in said(rings, more=rigid)
    on_axis = "boundary.2={ on = 'lower_left', force = [0, 1] }"
    assert ").force: its curves have no length; expected some to put the force on" in said(rings, on_axis)


def test_sides_whose_displacements_are_prescribed(said):
    both = ["boundary.0={ on = 'lower_top', displacement = { y = 0.1 } }",
            "boundary.2={ on = 'upper_bottom', displacement = { y = 0 } }"]  # fmt: skip
    found = said(*both, command="solve")
    assert "the prescribed displacements of the two sides overlap by 0.1 " in found


def test_ties_of_a_rigid_curve(said):
    tied = ["contact.0.condition=tied", "contact.0.multipliers_on=upper_bottom",
            "boundary.2={ on = 'upper_bottom', rigid = { force = [0, -1] } }"]  # fmt: skip
    tied += ["boundary.1={ on = 'lower_left', displacement = { x = 0 } }"]
    assert "ties a node of a rigid curve; expected multipliers_on the other curve" in said(*tied)


def upper_from(y):
    """The mesh of both plates with the upper one from y on."""
    moved = plates.mesh_of([
        plates.Body("lower", plates.even(2), 1, plates.between(0, 1, 0, 1), plates.QUAD4),
        plates.Body("upper", plates.even(3), 1, plates.between(0, 1, y, 2), plates.QUAD4),
    ])  # fmt: skip
    return {"plates.msh": msh_file.write(msh_file.sections(moved, "4.1 ascii"), "4.1 ascii")}


def test_overlap_without_a_pair_is_told(said):
    scene = SCENE[: SCENE.index("[[contact]]")] + "[[boundary]]\non = 'upper_right'\ndisplacement = { x = 0, y = 0 }"
    found = said(scene=scene, files=upper_from(0.99))
    assert "are drawn into one another by 0.01 near (" in found
    assert "), and no contact pair presses them apart there: " in found


def test_closed_curves_that_are_apart(said):
    found = said("contact.0.initial_gap=closed", files=upper_from(1.1))
    assert "are 0.1 apart near (" in found and 'where two meshes of one curve differ by at most ' in found


def test_motions_that_no_load_drives_are_told(said):
    free = "boundary.1={ on = 'lower_left', displacement = { x = 0 } }"
    found = said(free)
    assert "nothing holds body 'upper': translation (1, 0), but no load drives it either: held" in found
    many = "[[copies]]\nbody = 'upper'\nname = 'u_*'\ngrid = { count = [9, 1], step = [3, 0] }"
    loose = said('bodies={ lower = "steel", "u_*" = "steel" }', "contact=[]", "boundary.2.pressure=0", more=many,
                 scene=SCENE.replace('"upper_top"', '"u_0_0_top"').replace(', "upper_left"', ""))  # fmt: skip
    assert "motions of " in loose and ", but no load drives them either: held" in loose, loose


def test_load_that_lifts_off(said):
    found = said("boundary.2.pressure=-1e6", command="solve")
    assert "the load moves it away from the contact; expected a load that presses it on, or prescribed " in found


def test_probe_of_a_free_motion_is_told(said):
    found = said("boundary.1={ on = 'lower_left', displacement = { x = 0 } }",
                 'probe=[{ at = [0.5, 1.5] }]', command="solve")  # fmt: skip
    assert "the displacement along x near (0.5, 1.5) is undetermined and has no bar: nothing holds body 'upper'" in found


def test_large_displacements_are_told(said):
    found = said("boundary.2.pressure=4e10", command="solve")
    assert "large displacements: " in found
    turned = said("boundary.2.pressure=4e10", 'boundary.1={ on = ["lower_left"], displacement = { x = 0 } }',
                  command="solve")  # fmt: skip
    assert "; contact is written on the undeformed bodies, so p may be off by " in found + turned


def test_forces_have_their_moment(said):
    found = said(command="solve")
    assert "about (0, 0)" in found and ", moment -500000 about (0, 0)" in found


def test_what_is_left_out_is_said(said):
    assert "left out friction, large displacements, plasticity, time" in said()


WEDGE = """
Point(1) = {-1, -1, 0, 1}; Point(2) = {1, -1, 0, 1}; Point(3) = {1, 0, 0, 1}; Point(4) = {-1, 0, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1, 2, 3, 4};
Point(5) = {0, 0, 0, 1}; Point(6) = {1, 0.1, 0, 1}; Point(7) = {1, 1, 0, 1}; Point(8) = {-1, 1, 0, 1};
Point(9) = {-1, 0.1, 0, 1};
Line(5) = {9, 5}; Line(6) = {5, 6}; Line(7) = {6, 7}; Line(8) = {7, 8}; Line(9) = {8, 9};
Curve Loop(2) = {5, 6, 7, 8, 9}; Plane Surface(1) = {1}; Plane Surface(2) = {2};
Physical Surface("lower") = {1}; Physical Surface("upper") = {2};
Physical Curve("lower_bottom") = {1}; Physical Curve("lower_top") = {3}; Physical Curve("upper_top") = {8};
Physical Curve("upper_bottom") = {5, 6}; Physical Curve("lower_left") = {4}; Physical Curve("upper_left") = {9};
"""


def test_peak_under_a_wedge_is_refused(said):
    found = said("accuracy={ value = 0.1, of = 'peak' }", "boundary.1.on=upper_top", "boundary.2.pressure=3e9", scene=SCENE.replace("plates.msh", "w.geo"),
                 files={"w.geo": WEDGE.encode()}, command="solve")  # fmt: skip
    assert "p has no largest value near (0, 0), where it grows as the logarithm of 1/r" in found
    assert '; expected of = "pressure", which leaves out what is near, or a rounded corner' in found


def test_curves_drawn_far_apart_are_told_where_they_touch(said):
    apart = plates.mesh_of([
        plates.Body("lower", plates.even(2), 1, plates.between(0, 1, 0, 1), plates.QUAD4),
        plates.Body("upper", plates.even(3), 1, plates.between(0, 1, 501, 502), plates.QUAD4),
    ])  # fmt: skip
    more = "\n[[boundary]]\non = 'upper_top'\nfoundation = 1e3\n"
    found = said("boundary.2.pressure=1e9", more=more, command="solve",
                 files={"plates.msh": msh_file.write(msh_file.sections(apart, "4.1 ascii"), "4.1 ascii")})  # fmt: skip
    assert "'upper_bottom' and 'lower_top' touch, but are drawn 500 apart, 500 times their length; expected " in found


def test_a_gap_that_stands_for_another_shape_than_the_drawn_one_is_told(said):
    def of(lift, *overrides):
        tilted = plates.mesh_of([
            plates.Body("lower", plates.even(2), 1, plates.between(0, 1, 0, 1), plates.QUAD4),
            plates.Body("upper", plates.even(3), 1, plates.between(0, 1, lambda x: 1 + lift * x, 2), plates.QUAD4),
        ])  # fmt: skip
        return said("boundary.2.pressure=1e6", *overrides, command="solve",
                    files={"plates.msh": msh_file.write(msh_file.sections(tilted, "4.1 ascii"), "4.1 ascii")})  # fmt: skip

    words = "initial_gap stands for the drawn gap, which is up to 0."
    assert words in of(0.3, "contact.0.initial_gap=0") and words in of(0.3, "contact.0.initial_gap='-1e-4 * x'")
    for given in "0", "'0.3 * x - 1e-4'":
        assert words not in of(0.3 if "x" in given else 1e-5, f"contact.0.initial_gap={given}")
    assert words not in of(0.3)
