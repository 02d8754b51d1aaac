"""`mortise window` under Xvfb: what is picked stands in the files, and p is the command line's."""

import importlib.util
import os
import re
import shutil
import signal
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest

import launch
from result_tables import sides_of
from test_scenes import PUNCH, filled

sys.path[:0] = [str(launch.ROOT / "src/python/scenes"), str(launch.ROOT / "verification/pages")]

import edits
import markdown
import tutorial
from tutorial import drive

CASES = '\n[[case]]\nname = "half"\nscale = 0.5\n\n[[case]]\nname = "full"\n'


@pytest.fixture
def screen():
    """The number of a display that nobody sees."""
    missing = [program for program in ("Xvfb", "xdotool") if shutil.which(program) is None]
    if missing or importlib.util.find_spec("gmsh") is None:
        pytest.skip(f"the window cannot be driven without {', '.join(missing) or 'python3-gmsh'}: ./dev setup installs it")
    with tutorial.screen() as display:
        yield display


def test_a_scene_by_mouse_is_the_scene_of_the_command_line(mortise, call, screen, tmp_path):
    (tmp_path / "punch.geo").write_text(PUNCH)
    call("new", "punch.geo")
    text = filled((tmp_path / "punch.toml").read_text())
    (tmp_path / "punch.toml").write_text(re.sub(r"\n  \{ between.*", "", text) + CASES)
    told = drive(mortise, screen, tmp_path, "punch", "punch.toml")
    assert "head" in told["named"] and "curve_7" not in told["named"]
    assert 'Physical Curve("head") = {7};' in (tmp_path / "punch.geo").read_text()
    scene = tomllib.loads((tmp_path / "punch.toml").read_text().replace('["curve_2", "nowhere"]', '"curve_1"'))
    wanted = tomllib.loads(text.replace("10e6", "20e6").replace("curve_7", "head")) | {"contact": [{"between": ["curve_3", "curve_5"]}]} | {"case": scene["case"]}
    assert scene == wanted
    (tmp_path / "by_hand.toml").write_text((tmp_path / "punch.toml").read_text().replace('["curve_2", "nowhere"]', '"curve_1"'))
    call("solve", "by_hand.toml", "--accuracy", "1%", "--set", "cases.write=contact", "-o", "hand", "--quiet")
    for number, name in ((1, "half"), (2, "full")):
        table = launch.contact(tmp_path / "hand/cases" / name)
        shown = told[f"case {number}"]
        np.testing.assert_allclose(shown["p"], np.interp(shown["s"], table["s"], table["p"]), rtol=1e-9)
        assert shown["lines"][:2] == [name, "solved"]
    assert told["steps while it solved"] > 1  # the window lived on: one that waits takes one step
    assert any("nowhere" in line for line in told["error"]["lines"])
    assert told["highlighted"] == ["curve_2"]


def test_stop_ends_a_solve(mortise, call, screen, tmp_path):
    """While gmsh meshes, in a process of its own: nothing goes on, nothing is written, and the window lives."""
    (tmp_path / "punch.geo").write_text(PUNCH)
    call("new", "punch.geo")
    (tmp_path / "punch.toml").write_text(filled((tmp_path / "punch.toml").read_text()))
    (tmp_path / "punch.geo").write_text(PUNCH + "Mesh.MeshSizeMax = 0.0004;\n")  # 1.7 million triangles
    told = drive(mortise, screen, tmp_path, "stop", "punch.toml")
    assert told["ran"] and told["status"] == -signal.SIGINT and told["stopped"] == ["stopped"]
    assert told["checked"] == ["fine"]
    assert not [*tmp_path.glob("out/**/*.*")]
    left = [path for path in Path("/proc").glob("[0-9]*/cwd") if points_to(path, tmp_path)]
    assert not left, "a process goes on"


def points_to(link, folder):
    try:
        return link.resolve() == folder.resolve()
    except OSError:  # it has ended, or is another's
        return False


FEET = """SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 0.6, 0.2};
Rectangle(2) = {0.05, 0.2, 0, 0.1, 0.1};
Rectangle(3) = {0.35, 0.2, 0, 0.2, 0.1};
"""


def test_p_of_the_chosen_pair_is_shown(mortise, call, screen, tmp_path):
    (tmp_path / "feet.geo").write_text(FEET)
    call("new", "feet.geo")
    (tmp_path / "feet.toml").write_text(filled((tmp_path / "feet.toml").read_text()))
    told = drive(mortise, screen, tmp_path, "feet", "feet.toml")
    table = launch.columns(tmp_path / "out/feet/contact.csv")
    curves = []
    for pair in (0, 1):
        on = sides_of(table, pair)[0]
        shown = told[str(pair)]
        np.testing.assert_allclose(shown["p"], np.interp(shown["s"], table["s"][on], table["p"][on]), rtol=1e-9)
        curves.append(shown["p"])
    assert not np.allclose(*curves)


@pytest.mark.parametrize("written", [
    'contact = []', 'contact = [{ between = ["a", "b"] }]', 'contact = [\n  { between = ["a", "b"] },\n]', 'contact = [  # none\n]',
    'contact = [\n  { between = ["a", "b"] }  # no comma: ]\n]', '[[contact]]\nbetween = ["a", "b"]', '',
])  # fmt: skip
def test_an_entry_goes_where_the_others_are(written):
    before, entry = tomllib.loads(written), {"between": ["c", "d#]"], "gap": 0.5}
    after = edits.with_entry(written + "\n", "contact", entry)
    assert tomllib.loads(after) == {"contact": [*before.get("contact", []), entry]}


def test_a_number_is_changed_where_it_stands_and_nothing_else():
    text = 'a = 3\nmaterials.steel = { young = 3, poisson = 0.3 }  # 3\nboundary = [{ on = "x3", pressure = 3 }, { on = "b", pressure = 3 }]\n'
    assert edits.with_value(text, "boundary.1.pressure", 4.5) == text[::-1].replace("3", "5.4", 1)[::-1]
    assert edits.with_value(text, "materials.steel.young", 7) == text.replace("young = 3", "young = 7")
    with pytest.raises(ValueError, match="not found"):
        edits.with_value('boundary = [{ pressure = 3_0 }]'.replace("3_0", "0x1e"), "boundary.0.pressure", 4)


def test_the_tutorial_by_files(mortise, tmp_path):
    said, begun = tutorial.by_files(mortise, tmp_path)
    quoted = re.findall(r"`([^`\n]+)`\)", tutorial.TEXT[tutorial.CURVES])
    assert len(quoted) == 2 and all(words in said[tutorial.CURVES] for words in quoted)
    begun, full = (tomllib.loads(text) for text in (begun, (tmp_path / "lug.toml").read_text()))
    assert begun["contact"] == full["contact"] and begun["bodies"] == full["bodies"]
    assert "pulled: pressure -50, in sum (-3000, 0)" in said[tutorial.SCENE]
    for heading in (tutorial.SOLVE, tutorial.TRY, tutorial.GROW):
        assert not markdown.wrong_figures(tutorial.TEXT[heading], tmp_path, said[heading])
    pages = [*tutorial.BY_FILES.values(), "out/lug.html"]
    assert all((tmp_path / name).stat().st_size > 10000 for name in pages)


def test_every_picture_of_the_tutorial_is_made():
    shown = re.findall(r"\(tutorial/(\w+)\.png\)", tutorial.PAGE.read_text())
    assert sorted(shown) == sorted([*tutorial.BY_FILES, *tutorial.BY_MOUSE])
    files = [tutorial.PAGE.with_suffix("") / f"{name}.png" for name in shown]
    assert sum(file.stat().st_size for file in files) < 1.2e6


def test_the_tutorial_by_mouse(mortise, screen, tmp_path):
    told = tutorial.by_mouse(mortise, screen, tmp_path)
    assert all((tmp_path / f"{name}.png").is_file() for name in tutorial.BY_MOUSE)
    scene = tomllib.loads((tmp_path / "lug.toml").read_text())
    assert scene["boundary"] == [{"on": ["bore"], "displacement": {"x": 0, "y": 0}}, {"on": ["curve_2"], "displacement": {"y": 0}}, {"on": ["curve_2"], "pressure": -50}]
    assert scene["materials"] == {"steel": {"young": 210e3, "poisson": 0.3}} and scene["contact"] == [{"between": ["curve_5", "curve_6"]}]
    assert told["lines"][0] == "solved" and max(told["p"]) == pytest.approx(129.6, rel=0.05)  # plane strain, which differs little


ONELAB = """
import gmsh, sys
gmsh.initialize(["gmsh"], False)
gmsh.open("punch.geo")
for action in ("check", "compute", "compute"):
    gmsh.onelab.setString("Mortise/Action", [action])
    gmsh.onelab.run("Mortise", sys.argv[1])
    print(action, gmsh.view.getTags(), flush=True)
    text = open("punch.toml").read() if action == "compute" else ""
    if "# young" in text:
        open("punch.toml", "w").write(sys.argv[2])
kind, largest = (gmsh.option.getNumber(f"View[1].{name}") for name in ("Type", "Max"))
print("graph", kind, largest)
"""


def test_no_display_is_an_error(call, tmp_path):
    if importlib.util.find_spec("gmsh") is None:
        pytest.skip("no Python's gmsh: ./dev setup installs it")
    (tmp_path / "punch.geo").write_text(PUNCH)
    said = call("window", "punch.geo", expected=1, DISPLAY=":none")
    assert "Traceback" not in said and said.splitlines()[-1].startswith("mortise: error: the window cannot be opened: Can't open display: :none")


def test_gmsh_s_own_menu_runs_it(mortise, call, tmp_path):
    if importlib.util.find_spec("gmsh") is None:
        pytest.skip("no Python's gmsh: ./dev setup installs it")
    (tmp_path / "punch.geo").write_text(PUNCH)
    call("new", "punch.geo", "-o", "full.toml")
    full = filled((tmp_path / "full.toml").read_text())
    said = call("-c", ONELAB, launch.ROOT / "src/python/scenes/onelab.py", full, program=sys.executable, MORTISE_PROGRAM=str(mortise))
    assert re.findall(r"^(?:check|compute) .*", said, re.MULTILINE) == ["check []", "compute []", "compute [0 1]"], said
    assert (tmp_path / "punch.toml").read_text() == full
    shown = [float(word) for word in re.search(r"^graph (.*)", said, re.MULTILINE)[1].split()]
    table = launch.contact(tmp_path / "out/punch")
    assert shown == [2, pytest.approx(table["p"].max())]


@pytest.mark.parametrize("name", ["nothing.toml", "nothing.geo"])
def test_a_file_that_is_not_there_is_named(call, name):
    assert call("window", name, expected=1) == f"mortise: error: {name}: no such file\n"
