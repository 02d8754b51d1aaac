"""The pictures that the program makes of runs, set-ups and cases, and what it refuses."""

import argparse
import json
import shutil
import sys

import meshio
import pytest

import launch  # makes src/python/pictures known
import picture
from png_files import png_size


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
                        ((folder, "--history", "--along", "q"), "--along q: no such column; expected one of cases.csv: scale"),
                        ((folder, "--history", "--along", "status"), "--along status: has no numbers; expected one of cases.csv: scale"),
                        ((folder, "--history", "--pair", "1"), "cases.csv has no contact pair 1")]:  # fmt: skip
        status, said = picture_py(*words)
        assert status and text in said
    assert "expected one of the folders cases/NAME" in call("report", folder, expected=1)
    call("report", folder / "cases/pulled")
    page = (folder / "cases/pulled.html").read_text()
    assert ", case pulled</h1>" in page and "u_y = 0.0001" in page.replace("\u2009", " ")
    assert "one load is certified; expected --set case=[]" in call("certify", scene, "-o", tmp_path / "certificate", expected=1)


@pytest.mark.parametrize("option", [["--bodies"], ["--zoom"], ["--zoom", "0.1,0.5,0.1,0.3"]])
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
