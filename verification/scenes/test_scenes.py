"""From a geometry without names to a scene: what `mortise check PART.geo` lists and draws, and what `mortise new` writes."""

import re

import meshio
import numpy as np
import pytest

import launch  # makes src/python/pictures known

PUNCH = """SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 0.6, 0.2};
Rectangle(2) = {0.2, 0.2, 0, 0.2, 0.1};
"""
PIN = """SetFactory("OpenCASCADE");
Rectangle(1) = {-60, -40, 0, 160, 80};
Disk(2) = {0, 0, 0, 20};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Disk(4) = {0, 0, 0, 19.9};
"""
SCENE = """mesh.file = "punch.geo"
materials.steel = { young = 210e9, poisson = 0.3 }
bodies = { "*" = "steel" }
boundary = [
  { on = "BOTTOM", displacement = { x = 0, y = 0 } },
  { on = "TOP", displacement = { x = 0 } },
  { on = "TOP", pressure = 10e6 },
]
"""
GREY = "#8c8c8c"  # of curves that a scene does not use


def lines_behind(said, heading):
    """The lines to paste that stand behind a heading."""
    return said[said.index(heading) :].split("\n\n")[0].split("\n", 1)[1]


def filled(text):
    """A new scene with what it proposes taken for said."""
    return re.sub(r"^( *)# (?=\{ |young|poisson|\[\[body|body|force)", r"\1", text, flags=re.MULTILINE)


def test_an_unnamed_geometry_is_listed_and_its_numbers_are_names(call, tmp_path):
    (tmp_path / "punch.geo").write_text(PUNCH)
    said = call("check", "punch.geo")
    assert "curve_7 of surface_2: length 0.2, straight, (0.4, 0.3) to (0.2, 0.3)" in said
    assert "meet      curve_3 - curve_5: along 0.2, touching" in said
    numbers = SCENE.replace("BOTTOM", "curve_1").replace("TOP", "curve_7")
    (tmp_path / "scene.toml").write_text(numbers + lines_behind(said, "for the scene's file"))
    assert "gap as drawn" in call("check", "scene.toml")


def test_the_lines_to_paste_name_all_curves(call, tmp_path):
    (tmp_path / "punch.geo").write_text(PUNCH)
    names = lines_behind(call("check", "punch.geo"), "for punch.geo, names instead")
    (tmp_path / "punch.geo").write_text(PUNCH + names)
    said = call("check", "punch.geo")
    assert "for punch.geo" not in said and "curve_" not in said
    scene = SCENE.replace("BOTTOM", "body_1_bottom").replace("TOP", "body_2_top")
    (tmp_path / "scene.toml").write_text(scene + lines_behind(said, "for the scene's file"))
    assert "body_1_top - body_2_bottom" in call("check", "scene.toml")


def test_a_gap_between_arcs_is_found_whatever_the_mesh(call, tmp_path):
    (tmp_path / "pin.geo").write_text(PIN)
    assert re.search(r"curve_5 - curve_6: along \S+, gap 0\.1$", call("check", "pin.geo"), re.MULTILINE)  # 20 - 19.9
    (tmp_path / "pin.geo").write_text(PIN.replace("Disk(4) = {0, 0, 0, 19.9}", "Disk(4) = {0.3, 0.4, 0, 19.513}"))
    said = call("check", "pin.geo")  # 20 - 19.513 less half a unit: a little into the plate
    assert re.search(r"curve_5 - curve_6: along \S+, overlap 0\.013$", said, re.MULTILINE)
    (tmp_path / "pin.geo").write_text(PIN)
    assert "closed, radius 19.9 round (0, 0)" in call("check", "pin.geo")


def test_the_gap_of_curves_that_stick_out_past_each_other(call, tmp_path):
    """The least is at the end of one: where the upper block's foot comes down to the lower one's last corner, at x = 2."""
    (tmp_path / "steps.geo").write_text(
        "Point(1) = {1, 0.05, 0}; Point(2) = {3, 0.01, 0}; Point(3) = {3, 1, 0}; Point(4) = {1, 1, 0};\n"
        "Point(5) = {0, -1, 0}; Point(6) = {2, -1, 0}; Point(7) = {2, 0, 0}; Point(8) = {0, 0, 0};\n"
        "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
        "Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};\n"
        "Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1}; Curve Loop(2) = {5 : 8}; Plane Surface(2) = {2};\n"
        "Mesh.MeshSizeMax = 0.5;\n"
    )
    assert re.search(r"curve_1 - curve_7: along \S+, gap 0\.03$", call("check", "steps.geo"), re.MULTILINE)


def test_curves_of_corners_and_of_one_body_do_not_meet(call, tmp_path):
    (tmp_path / "punch.geo").write_text(PUNCH)
    assert call("check", "punch.geo").count("\n  meet") == 1  # not the punch's sides, which end on the block
    assert len(re.findall(r"\n  (?:meet|near)", call("check", launch.ROOT / "geo/parabola_1.geo"))) == 1  # not over a corner


def test_pictures_show_every_curve(call, tmp_path):
    (tmp_path / "punch.geo").write_text(PUNCH)
    assert call("check", "punch.geo", "--picture", "all.svg", "--quiet") == "all.svg\n"
    assert GREY in (tmp_path / "all.svg").read_text()
    contact = 'contact = [{ between = ["curve_3", "curve_5"] }]\n'
    scene = SCENE.replace("BOTTOM", "curve_1").replace("TOP", "curve_7") + contact
    (tmp_path / "scene.toml").write_text(scene)
    call("check", "scene.toml", "--picture", "a.svg")
    assert GREY in (tmp_path / "a.svg").read_text()
    rest = '  { on = ["curve_2", "curve_4", "curve_6", "curve_8"], pressure = 1 },\n]'
    (tmp_path / "scene.toml").write_text(scene.replace("\n]", f"\n{rest}", 1))
    call("check", "scene.toml", "--picture", "a.svg")
    assert GREY not in (tmp_path / "a.svg").read_text()


@pytest.mark.parametrize("name", sorted(path.stem for path in (launch.ROOT / "geo").glob("*.geo")))
def test_a_new_scene_is_complete_when_it_is_filled_in(call, tmp_path, name):
    call("new", launch.ROOT / f"geo/{name}.geo", "-o", "new.toml")
    said = call("check", "new.toml", expected=1)
    assert "materials.steel" in said and "young" in said
    (tmp_path / "new.toml").write_text(filled((tmp_path / "new.toml").read_text()))
    assert "  contact   " in call("check", "new.toml")


def test_a_new_scene_of_an_unnamed_geometry_solves(call, tmp_path):
    (tmp_path / "punch.geo").write_text(PUNCH)
    assert call("new", "punch.geo") == "punch.toml\n"
    (tmp_path / "punch.toml").write_text(filled((tmp_path / "punch.toml").read_text()))
    said = call("solve", "punch.toml", "--accuracy", "2%", "-o", "out")
    force = re.search(r"force \((\S+), (\S+)\) on curve_5", said)
    np.testing.assert_allclose([float(part) for part in force.groups()], [0, 2e6], atol=1)  # 10 MPa on 0.2 m


def test_bodies_that_share_a_curve_are_told_to_be_one_piece(call, tmp_path):
    joined = PUNCH + "f() = BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Delete; };\n"
    (tmp_path / "punch.geo").write_text(PUNCH)
    assert "one piece" not in call("check", "punch.geo")
    (tmp_path / "joined.geo").write_text(joined)
    call("new", "joined.geo")
    for text in (call("check", "joined.geo"), (tmp_path / "joined.toml").read_text()):
        assert len(re.findall(r"share \d+ nodes near \(.*, 0.2\), one piece; contact between them needs a curve for each", text)) == 1


def test_a_new_scene_of_a_mesh_and_what_is_refused(call, tmp_path):
    (tmp_path / "punch.geo").write_text(PUNCH)
    (tmp_path / "scene.toml").write_text(SCENE.replace("BOTTOM", "curve_1").replace("TOP", "curve_7") + 'contact = [{ between = ["curve_3", "curve_5"] }]')
    call("mesh", "scene.toml", "-o", "punch.msh")
    call("new", "punch.msh")
    assert 'between = ["curve_3", "curve_5"]' in (tmp_path / "punch.toml").read_text()
    before = (tmp_path / "punch.toml").read_text()
    assert "punch.toml: is there already" in call("new", "punch.msh", expected=1)
    assert (tmp_path / "punch.toml").read_text() == before
    assert "is no scene" in call("check", "punch.geo", "--set", "model.plane=stress", expected=1)
    (tmp_path / "bad.geo").write_text('SystemCall "touch ran";\n' + PUNCH)
    assert "bad.geo" in call("check", "bad.geo", "--no-programs", expected=1)
    assert "bad.geo" in call("new", "bad.geo", "--no-programs", expected=1)
    assert not (tmp_path / "ran").exists() and not (tmp_path / "bad.toml").exists()


@pytest.mark.parametrize(("order", "quads"), [(1, 0), (1, 1), (2, 0), (2, 1)])
def test_decks_that_meshio_writes_are_the_mesh_that_it_read(call, tmp_path, order, quads):
    names = 'Physical Surface("low") = {1}; Physical Surface("high") = {2}; Physical Curve("foot") = {1};\n'
    (tmp_path / "punch.geo").write_text(f"{PUNCH}{names}Mesh.ElementOrder = {order}; Mesh.SecondOrderIncomplete = 1; Mesh.RecombineAll = {quads};\n"
                                        'Physical Curve("seat") = {3}; Physical Curve("face") = {5}; Physical Curve("head") = {7};\n')  # fmt: skip
    scene = SCENE.replace("BOTTOM", "foot").replace("TOP", "head") + 'contact = [{ between = ["face", "seat"] }]'
    (tmp_path / "scene.toml").write_text(scene.replace("punch.geo", "punch.msh"))
    (tmp_path / "deck.toml").write_text(scene.replace("punch.geo", "punch.inp"))
    (tmp_path / "geo.toml").write_text(scene)
    call("mesh", "geo.toml", "-o", "punch.msh")
    meshio.read(tmp_path / "punch.msh").write(tmp_path / "punch.inp")
    p = {}
    for name in ("scene", "deck"):
        call("solve", f"{name}.toml", "-o", name)
        p[name] = launch.columns(tmp_path / name / "contact.csv")["p"]
    np.testing.assert_allclose(p["deck"], p["scene"], rtol=1e-9)
