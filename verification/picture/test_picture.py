"""The pictures that the program makes of runs, set-ups and cases, and what it refuses."""

import argparse
import json
import shutil
import sys
from itertools import cycle, zip_longest
from pathlib import Path

import meshio
import pytest
from matplotlib.layout_engine import ConstrainedLayoutEngine

import launch  # makes src/python/pictures known
import drawn_cases
import odd_scenes
import picture
import result_tables

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "pages"))

import markdown


def png_size(path):
    """Width and height from the header of a PNG file."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    return int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")


@pytest.fixture
def picture_py(monkeypatch, capsys):
    """picture.py in this process, without the second it takes to start: its exit status and what it says."""

    def run(*words):
        monkeypatch.setattr(sys, "argv", [picture.__file__, *map(str, words)])
        try:
            picture.main()
        except SystemExit as left:
            status, said = (left.code, "") if isinstance(left.code, int) else (1, left.code)
            return status, capsys.readouterr().err + said
        return 0, capsys.readouterr().out

    return run


@pytest.fixture(autouse=True)
def no_layout(monkeypatch):
    """matplotlib's, which takes as long as all else and is not looked at here."""
    monkeypatch.setattr(ConstrainedLayoutEngine, "execute", lambda self, drawing: None)


def test_picture_is_drawn_beside_the_results(solve):
    results = solve("patch_flat")
    before = sorted(results.iterdir())
    launch.run([sys.executable, picture.__file__, results, "--dpi", "60"], expected=[0])
    width, height = png_size(results.with_name("results.png"))
    assert width == 8 * 60 and height > 200
    assert sorted(results.iterdir()) == before


@pytest.mark.parametrize("scene", ["hertz", "stack", "pellets"])
def test_zoom_shows_the_contact(picture_py, solve, scene, tmp_path):
    assert picture_py(solve(scene), tmp_path / "zoom.png", "--zoom", "--dpi", "60") == (0, f"{tmp_path / 'zoom.png'}\n")
    assert png_size(tmp_path / "zoom.png")[0] == 8 * 60


def test_a_box_may_begin_with_a_minus_and_a_picture_is_no_box():
    assert picture.with_box(["out", "--zoom", "-1,1,0,2", "--dpi", "60"]) == ["out", "--zoom=-1,1,0,2", "--dpi", "60"]
    assert picture.with_box(["out", "--zoom", "a.png"]) == ["out", "--zoom=contact", "a.png"]
    assert picture.with_box(["out", "a.png", "--zoom"]) == ["out", "a.png", "--zoom=contact"]
    assert picture.box_of("-1,1,0,2") == [-1, 1, 0, 2]
    for wrong in ("1,1,0,2", "0,1,2", "a,b,c,d", "0,1,3,2"):
        with pytest.raises(argparse.ArgumentTypeError, match="no box"):
            picture.box_of(wrong)


BOX = ["--pair", "0", "--zoom", "0.1,0.5,0.1,0.3", "--dpi", "60"]


def test_fields_are_drawn_by_the_program(call, picture_py, solve, tmp_path):
    drawn = tmp_path / "a.png"
    assert call("picture", solve("punch"), drawn, "--field", "sigma_n", *BOX) == f"{drawn}\n"
    assert png_size(drawn)[0] == 8 * 60
    assert picture_py(solve("punch"), drawn, "--field", "error", *BOX)[0] == 0


def test_the_program_refuses_what_the_script_refuses(call, picture_py, solve, tmp_path):
    for words, text in (["--pair", "7"], "numbers 0 to 0"), (["--field", "heat"], "invalid choice"), (["--zoom", "1,0,0,1"], "no box"):
        status, said = picture_py(solve("punch"), tmp_path / "a.png", *words)
        assert status == 1 and text in said and not (tmp_path / "a.png").exists()
    assert text in call("picture", solve("punch"), tmp_path / "a.png", *words, expected=1)


@pytest.mark.parametrize("scene, fine", [("punch", None), ("wall", None), ("stack", None), ("rollers", 2)])
def test_the_set_up_is_drawn_before_it_is_solved(call, scene, fine, tmp_path):
    drawn = tmp_path / "setup.png"
    coarse = ["--set", f"mesh.parameters.fine={fine}"] if fine else []
    assert "contact" in call("check", launch.scene_file(scene), *coarse, "--picture", drawn)
    assert png_size(drawn)[0] == 8 * 130
    assert list(tmp_path.iterdir()) == [drawn]


OPTIONS = {"zoom": None, "field": "von_mises", "pair": None, "scale": None, "dpi": 40}


def draw(results, drawn):
    """As `mortise picture` does, in this process."""
    picture.draw(results, drawn, argparse.Namespace(**OPTIONS, bodies=False))
    assert png_size(drawn)[0] == 8 * 40


RECIPES = markdown.files((launch.ROOT / "docs/recipes.md").read_text())
RECIPE_SCENES = sorted(name for name in RECIPES if name.endswith(".toml"))
SCENES = sorted([*(launch.ROOT / "geo").glob("*.toml"), *(launch.ROOT / "tests/parts").glob("*.toml")])


@pytest.mark.parametrize("name", RECIPE_SCENES)
def test_every_recipe_is_drawn(mortise, name, tmp_path):
    for file, text in RECIPES.items():
        (tmp_path / file).write_text(text)
    launch.solve(tmp_path / name, {}, tmp_path / "out")
    if "[[case]]" in RECIPES[name]:
        drawn_cases.draw_history(tmp_path / "out", tmp_path / "a.png", argparse.Namespace(along=None, pair=None, dpi=40))
        return
    draw(tmp_path / "out", tmp_path / "a.png")


@pytest.mark.parametrize("scene", SCENES, ids=lambda path: path.stem)
def test_every_scene_is_drawn(solve, scene, tmp_path):
    draw(solve(scene), tmp_path / "a.png")


ODD = [
    *({"support": name, "title": title} for name, title in zip_longest(odd_scenes.SUPPORTS, odd_scenes.TITLES, fillvalue="clamp")),
    *({"plane": "axisymmetric", "gap": gap} for gap in odd_scenes.GAPS[:3]),
    *({"plane": plane, "support": "foundation"} for plane in odd_scenes.PLANES),
    *(
        {"foot": name, "track": f"t{name}", "low": f"l{name}", "up": name, "load": load, "gap": gap}
        for name, load, gap in zip(odd_scenes.NAMES, cycle(odd_scenes.LOADS), cycle(odd_scenes.GAPS))
    ),
]


def write_odd(folder, case):
    """The scene of a case of ODD."""
    names = {key: case[key] for key in case.keys() & {"foot", "track", "low", "up"}}
    (folder / "blocks.geo").write_text(odd_scenes.geometry(**names))
    (folder / "blocks.toml").write_text(odd_scenes.scene(**case))
    return folder / "blocks.toml"


@pytest.mark.parametrize("case", ODD, ids=range(len(ODD)))
def test_supports_loads_gaps_names_and_titles_of_all_kinds(mortise, case, tmp_path):
    launch.solve(write_odd(tmp_path, case), {}, tmp_path / "out")
    draw(tmp_path / "out", tmp_path / "a.png")


@pytest.mark.parametrize("case", ODD[::6], ids=range(len(ODD[::6])))
def test_set_ups_of_all_kinds(call, case, tmp_path):
    drawn = tmp_path / "a.png"
    call("check", write_odd(tmp_path, case), "--picture", drawn)
    assert png_size(drawn)[0] == 8 * 130


def test_both_sides_are_found_whatever_their_names(mortise, tmp_path):
    """contact.csv has an apostrophe before a name that a spreadsheet would take for a formula."""
    launch.solve(write_odd(tmp_path, {"foot": "=a", "track": "12"}), {}, tmp_path / "out")
    table = launch.columns(tmp_path / "out/contact.csv")
    first, other = result_tables.sides_of(table, 0)
    assert set(table["curve"]) == {"=a", "12"} and first.sum() > 1 and other.sum() > 1
    assert not (first & other).any() and (first | other).all()


def test_two_runs_over_each_other_and_p_alone(call, picture_py, solve, tmp_path):
    first, second = solve("punch"), tmp_path / "second"
    shutil.copytree(first, second)
    call("picture", first, second, tmp_path / "two.pdf")
    assert (tmp_path / "two.pdf").read_bytes()[:4] == b"%PDF"
    assert picture_py(second, "--pressure", "--format", "svg")[0] == 0 and "<svg" in (tmp_path / "second.svg").read_text()
    status, said = picture_py(first, solve("hertz"), tmp_path / "no.png")
    assert status == 1 and "has no pair of block_top and foot" in said
    status, said = picture_py(first, tmp_path, tmp_path / "no.png")
    assert status == 1 and "no summary.json there" in said and not (tmp_path / "no.png").exists()


CASES = """
[[case]]
name = "part"
scale = [0.5, 0.75, 1]
[[case]]
name = "pulled"
boundary.2.displacement.y = 1e-4
[cases]
write = "all"
"""


def test_the_history_of_cases(call, picture_py, tmp_path):
    scene = tmp_path / "scene.toml"
    geo = launch.ROOT / "geo"
    scene.write_text((geo / "gap_close.toml").read_text().replace("gap_close.geo", str(geo / "gap_close.geo")) + CASES)
    folder = tmp_path / "cases"
    call("solve", scene, "-o", folder, "--quiet")
    call("picture", folder, "--history", "--dpi", "60")
    width, height = png_size(folder.with_name("cases.png"))
    assert width == 8 * 60 and height > 500
    assert picture_py(folder, tmp_path / "along.svg", "--history", "--along", "energy")[0] == 0
    assert "energy" in (tmp_path / "along.svg").read_text()
    assert picture_py(folder / "cases/part_1", tmp_path / "one.png")[0] == 0
    with_contact = tmp_path / "contact_only"
    call("solve", scene, "--set", "cases.write=contact", "-o", with_contact, "--quiet")
    half, whole = (with_contact / "cases" / name for name in ("part_0.5", "part_1"))
    for words in ((half,), (half, "--pressure"), (half, whole), (folder / "cases/part_1", half)):
        drawn = tmp_path / "p.svg"
        assert picture_py(*words, drawn) == (0, f"{drawn}\n") and "contact pressure" in drawn.read_text()
        drawn.unlink()
    for words in (["--bodies"], ["--zoom"], ["--scale", "5"], ["--field", "error"]):
        status, said = picture_py(half, *words)
        assert status == 1 and 'no result.vtu there, and so no bodies to draw; expected a scene with [cases] write = "all"' in said
    call("report", half)
    reader = meshio.vtu.read(folder / "cases/part_0.5/result.vtu")
    assert f'file="cases/part_0.5/result.vtu"' in (folder / "cases.pvd").read_text() and len(reader.points) > 0
    for words, text in [((folder,), "the cases of a scene; expected --history, or the folder cases/NAME"),
                        ((folder / "cases/part_1", "--history"), "no cases.csv there; expected the folder of a scene with [[case]]"),
                        ((folder, "--history", "--along", "q"), "--along q: no such column; expected one of cases.csv: case, scale"),
                        ((folder, "--history", "--pair", "1"), "cases.csv has no contact pair 1")]:  # fmt: skip
        status, said = picture_py(*words)
        assert status and text in said
    assert "expected one of the folders cases/NAME" in call("report", folder, expected=1)
    call("report", folder / "cases/part_1")
    assert "one load is certified; expected --set case=[]" in call("certify", scene, "-o", tmp_path / "certificate", expected=1)


@pytest.mark.parametrize("option", [["--bodies"], ["--scale", "5"], ["--pair", "0"], ["--zoom"], ["--zoom", "0.1,0.5,0.1,0.3"], ["--pressure"]])
def test_the_picture_s_name_stands_anywhere(picture_py, solve, option, tmp_path):
    drawn = tmp_path / "a.png"
    for words in ([solve("punch"), *option, drawn], [*option, solve("punch"), drawn], [solve("punch"), drawn, *option]):
        assert picture_py(*words, "--dpi", "40") == (0, f"{drawn}\n")
        drawn.unlink()


def test_each_of_two_pairs_is_drawn_alone(picture_py, solve, tmp_path):
    for pair in ("0", "1"):
        assert picture_py(solve("stack"), tmp_path / "a.png", "--pair", pair, "--dpi", "40")[0] == 0


def test_what_shows_nothing_is_refused(picture_py, solve, tmp_path):
    for scene, words, text in [
        ("punch", ["--zoom", "5,6,5,6"], "--zoom 5,6,5,6: no body is there; expected a box within -0.0"),
        ("pellets", ["--zoom", "50,60,5,6"], "--zoom 50,60,5,6: no body is there"),
        ("punch", ["--scale", "nan"], "expected a number, found 'nan'"),
        ("punch", ["--scale", "inf"], "expected a number, found 'inf'"),
    ]:
        status, said = picture_py(solve(scene), tmp_path / "a.png", *words)
        assert status and text in said and not (tmp_path / "a.png").exists()
    assert picture_py(solve("punch"), tmp_path / "a.png", "--zoom", "0.3001,0.3002,0.1001,0.1002", "--scale", "1", "--dpi", "40")[0] == 0  # within a cell


ALONE = """
mesh.file = "alone.geo"
materials.m = { young = 1, poisson = 0.3 }
bodies = { block = "m" }
boundary = [{ on = "low", displacement = { x = 0, y = 0 } }, { on = "high", pressure = 1e-3 }]
"""


def test_p_of_a_scene_without_contact_is_refused(picture_py, tmp_path):
    (tmp_path / "alone.geo").write_text('''SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 1, 1};
        Physical Surface("block") = {1}; Physical Curve("low") = {1}; Physical Curve("high") = {3};''')
    (tmp_path / "alone.toml").write_text(ALONE)
    launch.solve(tmp_path / "alone.toml", {}, tmp_path / "out")
    for words, text in (["--pressure"], "p"), (["--pair", "0"], "--pair"), (["--zoom"], "--zoom"):
        assert picture_py(tmp_path / "out", tmp_path / "a.png", *words) == (1, f"picture.py: {text}: the scene has no contact pair")
    assert picture_py(tmp_path / "out", tmp_path / "a.png")[0] == 0


def test_pictures_that_cannot_be_written_are_told_in_one_line(mortise, solve, tmp_path):
    (tmp_path / "file").write_text("")
    geo, drawn = launch.ROOT / "geo/punch", tmp_path / "file/a.png"
    for words in (["picture", solve("punch"), drawn], ["check", geo.with_suffix(".toml"), "--picture", drawn], ["check", geo.with_suffix(".geo"), "--picture", drawn]):
        ended, _ = launch.run([mortise, *words], expected=[1])
        assert ended.stderr == f"mortise: error: {drawn}: cannot be written: File exists\n"


def test_what_cannot_be_drawn_is_refused(picture_py, solve, tmp_path):
    """No results, a picture of no known kind, results of an older mortise."""
    known = "a.txt: expected a name that ends in .png, .pdf, .svg"
    for words, text in ([tmp_path], "no summary.json there"), ([solve("patch_flat"), "a.txt"], known):
        status, said = picture_py(*words)
        assert status == 1 and text in said
    model = {"loads": [{"on": ["top"], "pressure": 1.0}, {"sum": [0, -1]}], "supports": []}
    (tmp_path / "summary.json").write_text(json.dumps({"model": model}))
    status, said = picture_py(tmp_path)
    assert status == 1 and "older mortise" in said


DAMAGES = {"cut": lambda data: data[:300], "noise": lambda data: data[:200] + bytes([0xF9]) * 40 + data[240:], "gone": None}


@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.parametrize("file", ["summary.json", "result.vtu", "contact.csv"])
def test_damaged_results_are_told_in_one_line(picture_py, solve, file, damage, tmp_path):
    folder = tmp_path / "results"
    shutil.copytree(solve("patch_flat"), folder)
    whole = (folder / file).read_bytes()
    (folder / file).unlink()
    if DAMAGES[damage]:
        (folder / file).write_bytes(DAMAGES[damage](whole))
    status, said = picture_py(folder)
    assert status == 1 and said.splitlines()[-1].startswith("picture.py: ")
    assert not (tmp_path / "results.png").exists()
