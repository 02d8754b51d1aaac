"""Pictures of every scene, every recipe, and of supports, loads, gaps and names of all kinds, before and after solving."""

import argparse
import sys
from itertools import cycle, zip_longest
from pathlib import Path

import pytest

import launch  # makes src/python/pictures known
import drawn_cases
import odd_scenes
import picture
import result_tables
from png_files import png_size

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "pages"))

import markdown


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


@pytest.mark.parametrize("scene, fine", [("punch", None), ("wall", None), ("stack", None), ("rollers", 2)])
def test_the_set_up_is_drawn_before_it_is_solved(call, scene, fine, tmp_path):
    drawn = tmp_path / "setup.png"
    coarse = ["--set", f"mesh.parameters.fine={fine}"] if fine else []
    assert "contact" in call("check", launch.scene_file(scene), *coarse, "--picture", drawn)
    assert png_size(drawn)[0] == 8 * 130
    assert list(tmp_path.iterdir()) == [drawn]


def test_both_sides_are_found_whatever_their_names(mortise, tmp_path):
    """contact.csv has an apostrophe before a name that a spreadsheet would take for a formula."""
    launch.solve(write_odd(tmp_path, {"foot": "=a", "track": "12"}), {}, tmp_path / "out")
    table = launch.columns(tmp_path / "out/contact.csv")
    first, other = result_tables.sides_of(table, 0)
    assert set(table["curve"]) == {"=a", "12"} and first.sum() > 1 and other.sum() > 1
    assert not (first & other).any() and (first | other).all()
