"""The pictures that the program makes of runs, set-ups and cases, and what it refuses."""

import argparse
import json
import shutil
import subprocess
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
def call(monkeypatch, capsys):
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
    subprocess.run([sys.executable, picture.__file__, results, "--dpi", "60"], check=True)
    width, height = png_size(results.with_name("results.png"))
    assert width == 8 * 60 and height > 200
    assert sorted(results.iterdir()) == before


@pytest.mark.parametrize("scene", ["hertz", "stack", "pellets"])
def test_zoom_shows_the_contact(call, solve, scene, tmp_path):
    assert call(solve(scene), tmp_path / "zoom.png", "--zoom", "--dpi", "60") == (0, f"{tmp_path / 'zoom.png'}\n")
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


def test_fields_are_drawn_by_the_program(mortise, call, solve, tmp_path):
    drawn = tmp_path / "a.png"
    command = [mortise, "picture", solve("punch"), drawn, "--field", "sigma_n", *BOX]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    assert png_size(drawn)[0] == 8 * 60 and run.stdout == f"{drawn}\n"
    assert call(solve("punch"), drawn, "--field", "error", *BOX)[0] == 0


def test_the_program_refuses_what_the_script_refuses(mortise, call, solve, tmp_path):
    for words, text in (["--pair", "7"], "numbers 0 to 0"), (["--field", "heat"], "invalid choice"), (["--zoom", "1,0,0,1"], "no box"):
        status, said = call(solve("punch"), tmp_path / "a.png", *words)
        assert status == 1 and text in said and not (tmp_path / "a.png").exists()
    run = subprocess.run([mortise, "picture", solve("punch"), tmp_path / "a.png", *words], capture_output=True, text=True, check=False)
    assert run.returncode == 1 and text in run.stderr


@pytest.mark.parametrize("scene, fine", [("punch", None), ("wall", None), ("stack", None), ("rollers", 2)])
def test_the_set_up_is_drawn_before_it_is_solved(mortise, scene, fine, tmp_path):
    drawn = tmp_path / "setup.png"
    coarse = ["--set", f"mesh.parameters.fine={fine}"] if fine else []
    command = [mortise, "check", launch.scene_file(scene), *coarse, "--picture", drawn]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    assert png_size(drawn)[0] == 8 * 130 and "contact" in run.stdout
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
def test_set_ups_of_all_kinds(mortise, case, tmp_path):
    drawn = tmp_path / "a.png"
    run = subprocess.run([mortise, "check", write_odd(tmp_path, case), "--picture", drawn], capture_output=True, text=True, check=False)
    assert run.returncode == 0 and png_size(drawn)[0] == 8 * 130, run.stderr


def test_both_sides_are_found_whatever_their_names(mortise, tmp_path):
    """contact.csv has an apostrophe before a name that a spreadsheet would take for a formula."""
    launch.solve(write_odd(tmp_path, {"foot": "=a", "track": "12"}), {}, tmp_path / "out")
    table = launch.columns(tmp_path / "out/contact.csv")
    first, other = result_tables.sides_of(table, 0)
    assert set(table["curve"]) == {"=a", "12"} and first.sum() > 1 and other.sum() > 1
    assert not (first & other).any() and (first | other).all()


def test_two_runs_over_each_other_and_p_alone(mortise, call, solve, tmp_path):
    first, second = solve("punch"), tmp_path / "second"
    shutil.copytree(first, second)
    subprocess.run([mortise, "picture", first, second, tmp_path / "two.pdf"], check=True)
    assert (tmp_path / "two.pdf").read_bytes()[:4] == b"%PDF"
    assert call(second, "--pressure", "--format", "svg")[0] == 0 and "<svg" in (tmp_path / "second.svg").read_text()
    status, said = call(first, solve("hertz"), tmp_path / "no.png")
    assert status == 1 and "has no pair of block_top and foot" in said
    status, said = call(first, tmp_path, tmp_path / "no.png")
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


def test_the_history_of_cases(mortise, call, tmp_path):
    scene = tmp_path / "scene.toml"
    geo = launch.ROOT / "geo"
    scene.write_text((geo / "gap_close.toml").read_text().replace("gap_close.geo", str(geo / "gap_close.geo")) + CASES)
    folder = tmp_path / "cases"
    subprocess.run([mortise, "solve", scene, "-o", folder, "--quiet"], check=True)
    subprocess.run([mortise, "picture", folder, "--history", "--dpi", "60"], check=True)
    width, height = png_size(folder.with_name("cases.png"))
    assert width == 8 * 60 and height > 500
    assert call(folder, tmp_path / "along.svg", "--history", "--along", "energy")[0] == 0
    assert "energy" in (tmp_path / "along.svg").read_text()
    assert call(folder / "cases/part_1", tmp_path / "one.png")[0] == 0
    with_contact = tmp_path / "contact_only"
    subprocess.run([mortise, "solve", scene, "--set", "cases.write=contact", "-o", with_contact, "--quiet"], check=True)
    half, whole = (with_contact / "cases" / name for name in ("part_0.5", "part_1"))
    for words in ((half,), (half, "--pressure"), (half, whole), (folder / "cases/part_1", half)):
        drawn = tmp_path / "p.svg"
        assert call(*words, drawn) == (0, f"{drawn}\n") and "contact pressure" in drawn.read_text()
        drawn.unlink()
    for words in (["--bodies"], ["--zoom"], ["--scale", "5"], ["--field", "error"]):
        status, said = call(half, *words)
        assert status == 1 and 'no result.vtu there, and so no bodies to draw; expected a scene with [cases] write = "all"' in said
    assert subprocess.run([mortise, "report", half], capture_output=True, check=False).returncode == 0
    reader = meshio.vtu.read(folder / "cases/part_0.5/result.vtu")
    assert f'file="cases/part_0.5/result.vtu"' in (folder / "cases.pvd").read_text() and len(reader.points) > 0
    for words, text in [((folder,), "the cases of a scene; expected --history, or the folder cases/NAME"),
                        ((folder / "cases/part_1", "--history"), "no cases.csv there; expected the folder of a scene with [[case]]"),
                        ((folder, "--history", "--along", "q"), "--along q: no such column; expected one of cases.csv: case, scale"),
                        ((folder, "--history", "--pair", "1"), "cases.csv has no contact pair 1")]:  # fmt: skip
        status, said = call(*words)
        assert status and text in said
    refused = subprocess.run([mortise, "report", folder], capture_output=True, text=True, check=False)
    assert refused.returncode == 1 and "expected one of the folders cases/NAME" in refused.stderr
    assert subprocess.run([mortise, "report", folder / "cases/part_1"], capture_output=True, check=False).returncode == 0
    refused = subprocess.run([mortise, "certify", scene, "-o", tmp_path / "certificate"], capture_output=True, text=True, check=False)
    assert refused.returncode == 1 and "one load is certified; expected --set case=[]" in refused.stderr


@pytest.mark.parametrize("option", [["--bodies"], ["--scale", "5"], ["--pair", "0"], ["--zoom"], ["--zoom", "0.1,0.5,0.1,0.3"], ["--pressure"]])
def test_the_picture_s_name_stands_anywhere(call, solve, option, tmp_path):
    drawn = tmp_path / "a.png"
    for words in ([solve("punch"), *option, drawn], [*option, solve("punch"), drawn], [solve("punch"), drawn, *option]):
        assert call(*words, "--dpi", "40") == (0, f"{drawn}\n")
        drawn.unlink()


def test_each_of_two_pairs_is_drawn_alone(call, solve, tmp_path):
    for pair in ("0", "1"):
        assert call(solve("stack"), tmp_path / "a.png", "--pair", pair, "--dpi", "40")[0] == 0


def test_what_shows_nothing_is_refused(call, solve, tmp_path):
    for scene, words, text in [
        ("punch", ["--zoom", "5,6,5,6"], "--zoom 5,6,5,6: no body is there; expected a box within -0.0"),
        ("pellets", ["--zoom", "50,60,5,6"], "--zoom 50,60,5,6: no body is there"),
        ("punch", ["--scale", "nan"], "expected a number, found 'nan'"),
        ("punch", ["--scale", "inf"], "expected a number, found 'inf'"),
    ]:
        status, said = call(solve(scene), tmp_path / "a.png", *words)
        assert status and text in said and not (tmp_path / "a.png").exists()
    assert call(solve("punch"), tmp_path / "a.png", "--zoom", "0.3001,0.3002,0.1001,0.1002", "--scale", "1", "--dpi", "40")[0] == 0  # within a cell


ALONE = """
mesh.file = "alone.geo"
materials.m = { young = 1, poisson = 0.3 }
bodies = { block = "m" }
boundary = [{ on = "low", displacement = { x = 0, y = 0 } }, { on = "high", pressure = 1e-3 }]
"""


def test_p_of_a_scene_without_contact_is_refused(call, tmp_path):
    (tmp_path / "alone.geo").write_text('''SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 1, 1};
        Physical Surface("block") = {1}; Physical Curve("low") = {1}; Physical Curve("high") = {3};''')
    (tmp_path / "alone.toml").write_text(ALONE)
    launch.solve(tmp_path / "alone.toml", {}, tmp_path / "out")
    for words, text in (["--pressure"], "p"), (["--pair", "0"], "--pair"), (["--zoom"], "--zoom"):
        assert call(tmp_path / "out", tmp_path / "a.png", *words) == (1, f"picture.py: {text}: the scene has no contact pair")
    assert call(tmp_path / "out", tmp_path / "a.png")[0] == 0


def test_pictures_that_cannot_be_written_are_told_in_one_line(mortise, solve, tmp_path):
    (tmp_path / "file").write_text("")
    geo, drawn = launch.ROOT / "geo/punch", tmp_path / "file/a.png"
    for words in (["picture", solve("punch"), drawn], ["check", geo.with_suffix(".toml"), "--picture", drawn], ["check", geo.with_suffix(".geo"), "--picture", drawn]):
        ended = subprocess.run([mortise, *words], capture_output=True, text=True, check=False)
        assert ended.returncode == 1 and ended.stderr == f"mortise: error: {drawn}: cannot be written: File exists\n"


def test_what_cannot_be_drawn_is_refused(call, solve, tmp_path):
    """No results, a picture of no known kind, results of an older mortise."""
    known = "a.txt: expected a name that ends in .png, .pdf, .svg"
    for words, text in ([tmp_path], "no summary.json there"), ([solve("patch_flat"), "a.txt"], known):
        status, said = call(*words)
        assert status == 1 and text in said
    model = {"loads": [{"on": ["top"], "pressure": 1.0}, {"sum": [0, -1]}], "supports": []}
    (tmp_path / "summary.json").write_text(json.dumps({"model": model}))
    status, said = call(tmp_path)
    assert status == 1 and "older mortise" in said


DAMAGES = {"cut": lambda data: data[:300], "noise": lambda data: data[:200] + bytes([0xF9]) * 40 + data[240:], "gone": None}


@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.parametrize("file", ["summary.json", "result.vtu", "contact.csv"])
def test_damaged_results_are_told_in_one_line(call, solve, file, damage, tmp_path):
    folder = tmp_path / "results"
    shutil.copytree(solve("patch_flat"), folder)
    whole = (folder / file).read_bytes()
    (folder / file).unlink()
    if DAMAGES[damage]:
        (folder / file).write_bytes(DAMAGES[damage](whole))
    status, said = call(folder)
    assert status == 1 and said.splitlines()[-1].startswith("picture.py: ")
    assert not (tmp_path / "results.png").exists()
