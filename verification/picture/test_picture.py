"""The pictures that the program makes of runs, set-ups and cases, and what it refuses."""

import argparse
import json
import shutil
import subprocess
import sys
from pathlib import Path

import meshio
import pytest

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


@pytest.mark.parametrize("scene", ["patch_flat", "rings", "stack", "wall", "pellets"])
def test_picture_is_drawn_beside_the_results(solve, scene):
    results = solve(scene)
    before = sorted(results.iterdir())
    subprocess.run([sys.executable, picture.__file__, results, "--dpi", "60"], check=True)
    width, height = png_size(results.with_name("results.png"))
    assert width == 8 * 60 and height > 200
    assert sorted(results.iterdir()) == before


@pytest.mark.parametrize("scene", ["hertz", "stack", "pellets"])
def test_zoom_shows_the_contact(solve, scene, tmp_path):
    subprocess.run([sys.executable, picture.__file__, solve(scene), tmp_path / "zoom.png", "--zoom", "--dpi", "60"], check=True)
    assert png_size(tmp_path / "zoom.png")[0] == 8 * 60


def test_a_box_may_begin_with_a_minus_and_a_picture_is_no_box():
    assert picture.with_box(["out", "--zoom", "-1,1,0,2", "--dpi", "60"]) == ["out", "--zoom=-1,1,0,2", "--dpi", "60"]
    assert picture.with_box(["out", "--zoom", "a.png"]) == ["out", "--zoom=contact", "a.png"]
    assert picture.with_box(["out", "a.png", "--zoom"]) == ["out", "a.png", "--zoom=contact"]
    assert picture.box_of("-1,1,0,2") == [-1, 1, 0, 2]
    for wrong in ("1,1,0,2", "0,1,2", "a,b,c,d", "0,1,3,2"):
        with pytest.raises(argparse.ArgumentTypeError, match="no box"):
            picture.box_of(wrong)


@pytest.mark.parametrize("field", ["sigma_n", "error"])
def test_fields_are_drawn_by_the_program(mortise, solve, field, tmp_path):
    drawn = tmp_path / "a.png"
    command = [mortise, "picture", solve("punch"), drawn, "--field", field, "--pair", "0", "--zoom", "0.1,0.5,0.1,0.3", "--dpi", "60"]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    assert png_size(drawn)[0] == 8 * 60 and run.stdout == f"{drawn}\n"


def test_the_program_refuses_what_the_script_refuses(mortise, solve, tmp_path):
    wrong = (["--pair", "7"], "numbers 0 to 0"), (["--field", "heat"], "invalid choice"), (["--zoom", "1,0,0,1"], "no box")
    for words, said in wrong:
        run = subprocess.run([mortise, "picture", solve("punch"), tmp_path / "a.png", *words], capture_output=True, text=True, check=False)
        assert run.returncode == 1 and said in run.stderr and not (tmp_path / "a.png").exists()


@pytest.mark.parametrize("scene", ["punch", "wall", "stack", "rollers"])
def test_the_set_up_is_drawn_before_it_is_solved(mortise, scene, tmp_path):
    drawn = tmp_path / "setup.png"
    command = [mortise, "check", launch.scene_file(scene), "--picture", drawn]
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
    *({"support": name} for name in odd_scenes.SUPPORTS),
    *({"load": name} for name in odd_scenes.LOADS),
    *({"gap": gap} for gap in odd_scenes.GAPS),
    *({"plane": "axisymmetric", "gap": gap} for gap in odd_scenes.GAPS[:3]),
    *({"plane": plane, "support": "foundation"} for plane in odd_scenes.PLANES),
    *({"foot": name, "track": f"t{name}", "low": f"l{name}", "up": name} for name in odd_scenes.NAMES),
    *({"title": title} for title in odd_scenes.TITLES),
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


def test_two_runs_over_each_other_and_p_alone(mortise, solve, tmp_path):
    first, second = solve("punch"), tmp_path / "second"
    shutil.copytree(first, second)
    draw = lambda *words: subprocess.run([mortise, "picture", *words], capture_output=True, text=True, check=False)
    assert draw(first, second, tmp_path / "two.pdf").returncode == 0 and (tmp_path / "two.pdf").read_bytes()[:4] == b"%PDF"
    assert draw(second, "--pressure", "--format", "svg").returncode == 0 and "<svg" in (tmp_path / "second.svg").read_text()
    refused = draw(first, solve("hertz"), tmp_path / "no.png")
    assert refused.returncode == 1 and "has no pair of block_top and foot" in refused.stderr
    refused = draw(first, tmp_path, tmp_path / "no.png")
    assert refused.returncode == 1 and "no summary.json there" in refused.stderr and not (tmp_path / "no.png").exists()


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


def test_the_history_of_cases(mortise, tmp_path):
    scene = tmp_path / "scene.toml"
    geo = launch.ROOT / "geo"
    scene.write_text((geo / "gap_close.toml").read_text().replace("gap_close.geo", str(geo / "gap_close.geo")) + CASES)
    folder = tmp_path / "cases"
    subprocess.run([mortise, "solve", scene, "-o", folder, "--quiet"], check=True)
    draw = lambda *words: subprocess.run([mortise, "picture", *words], capture_output=True, text=True, check=False)
    ended = draw(folder, "--history", "--dpi", "60")
    assert ended.returncode == 0, ended.stderr
    width, height = png_size(folder.with_name("cases.png"))
    assert width == 8 * 60 and height > 500
    assert draw(folder, tmp_path / "along.svg", "--history", "--along", "energy").returncode == 0
    assert "energy" in (tmp_path / "along.svg").read_text()
    assert draw(folder / "cases/part_1", tmp_path / "one.png").returncode == 0
    reader = meshio.vtu.read(folder / "cases/part_0.5/result.vtu")
    assert f'file="cases/part_0.5/result.vtu"' in (folder / "cases.pvd").read_text() and len(reader.points) > 0
    for words, said in [((folder,), "the cases of a scene; expected --history, or the folder cases/NAME"),
                        ((folder / "cases/part_1", "--history"), "no cases.csv there; expected the folder of a scene with [[case]]"),
                        ((folder, "--history", "--along", "q"), "--along q: no such column; expected one of cases.csv: case, scale"),
                        ((folder, "--history", "--pair", "1"), "cases.csv has no contact pair 1")]:  # fmt: skip
        refused = draw(*words)
        assert refused.returncode == 1 and said in refused.stderr, refused.stderr
    refused = subprocess.run([mortise, "report", folder], capture_output=True, text=True, check=False)
    assert refused.returncode != 0 and "expected one of the folders cases/NAME" in refused.stderr
    assert subprocess.run([mortise, "report", folder / "cases/part_1"], capture_output=True, check=False).returncode == 0
    refused = subprocess.run([mortise, "certify", scene, "-o", tmp_path / "certificate"], capture_output=True, text=True, check=False)
    assert refused.returncode == 1 and "one load is certified; expected --set case=[]" in refused.stderr


def test_a_folder_without_results_is_refused(tmp_path):
    run = subprocess.run([sys.executable, picture.__file__, tmp_path], capture_output=True, text=True, check=False)
    assert run.returncode == 2 and "summary.json" in run.stderr


def test_a_folder_of_an_older_mortise_is_refused(tmp_path):
    model = {"loads": [{"on": ["top"], "pressure": 1.0}, {"sum": [0, -1]}], "supports": []}
    (tmp_path / "summary.json").write_text(json.dumps({"model": model}))
    run = subprocess.run([sys.executable, picture.__file__, tmp_path], capture_output=True, text=True, check=False)
    assert run.returncode == 1 and "older mortise" in run.stderr and "Traceback" not in run.stderr


def test_a_picture_of_no_known_kind_is_refused(solve):
    run = subprocess.run([sys.executable, picture.__file__, solve("patch_flat"), "a.txt"], capture_output=True, text=True, check=False)
    assert run.returncode == 2 and "a.txt: expected a name that ends in .png, .pdf, .svg" in run.stderr


DAMAGES = {"cut": lambda data: data[:300], "noise": lambda data: data[:200] + bytes([0xF9]) * 40 + data[240:], "gone": None}


@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.parametrize("file", ["summary.json", "result.vtu", "contact.csv"])
def test_damaged_results_are_told_in_one_line(solve, file, damage, tmp_path):
    folder = tmp_path / "results"
    shutil.copytree(solve("patch_flat"), folder)
    whole = (folder / file).read_bytes()
    (folder / file).unlink()
    if DAMAGES[damage]:
        (folder / file).write_bytes(DAMAGES[damage](whole))
    run = subprocess.run([sys.executable, picture.__file__, folder], capture_output=True, text=True, check=False)
    assert run.returncode in (1, 2) and "Traceback" not in run.stderr
    assert run.stderr.splitlines()[-1].startswith("picture.py: ")
    assert not (tmp_path / "results.png").exists()
