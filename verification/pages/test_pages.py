"""Every recipe, snippet and command of README.md and docs/ is run, or known to the program that it calls."""

import os
import re
import subprocess
from functools import cache

import meshio
import numpy as np
import pytest

import launch
import markdown

PAGES = [launch.ROOT / "README.md", *sorted((launch.ROOT / "docs").rglob("*.md"))]
TEXTS = {page.name: page.read_text() for page in PAGES}
RECIPES = markdown.sections(TEXTS["recipes.md"])
WITH_COMMANDS = [name for name, text in RECIPES.items() if markdown.commands(text)]
SNIPPETS = [body for language, body in markdown.FENCE.findall(TEXTS["files.md"]) if language == "toml"]
STUDY_OPTIONS = ("--docs", "--quick", "--only", "--jobs", "--output", "-o", "--help")  # launch.command_line
MODULE = launch.MORTISE.with_name("python")

# For snippets of a scene: bodies and curves of the names that they use.
BASE_GEO = """
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 1}; Rectangle(2) = {0, 1, 0, 1, 1};
Physical Surface("tube") = {1}; Physical Surface("upper") = {2};
Physical Curve("ground") = {1}; Physical Curve("low") = {3}; Physical Curve("high") = {5};
Physical Curve("rim") = {6}; Physical Curve("top") = {7};
"""
BASE_TOML = """
mesh.file = "base.geo"
materials.steel = { young = 210e9, poisson = 0.3, thermal_expansion = 1e-5 }
bodies = { tube = "steel", upper = "steel" }
[[contact]]
between = ["low", "high"]
[[boundary]]
on = "ground"
displacement = { x = 0, y = 0 }
"""


@pytest.fixture
def desk(mortise, tmp_path):
    """A folder in which the commands run as they are printed."""
    (tmp_path / "build/release").mkdir(parents=True)
    (tmp_path / "build/release/mortise").symlink_to(mortise)
    for name in ("verification", "geo"):
        (tmp_path / name).symlink_to(launch.ROOT / name)
    return tmp_path


def run(desk, command):
    """What a command prints; it must succeed."""
    path = f"{desk / 'build/release'}:/usr/bin:{os.environ['PATH']}"
    environment = os.environ | launch.ONE_THREAD | {"PATH": path, "MPLBACKEND": "Agg", "PYTHONPATH": str(MODULE)}
    return launch.run(["bash", "-c", command], expected=(0,), cwd=desk, env=environment)[0].stdout


def write(desk, files):
    for name, text in files.items():
        (desk / name).write_text(text)


@pytest.mark.parametrize("name", WITH_COMMANDS)
def test_recipe(desk, name):
    if "import mortise" in RECIPES[name] and not list(MODULE.glob("mortise/_mortise*.so")):
        pytest.skip(f"{MODULE} has no module: ./dev build makes it")
    write(desk, markdown.files(TEXTS["recipes.md"]))
    said = "".join(run(desk, command) for command in markdown.commands(RECIPES[name]))
    assert not markdown.wrong_figures(RECIPES[name], desk, said)


def test_recipes_are_all_there():
    assert [title for title, _ in re.findall(r"^- \[(.*?)\]\(#(.*?)\)", TEXTS["recipes.md"], re.M)] == list(RECIPES)
    assert len(WITH_COMMANDS) == len(RECIPES) - 1  # ParaView's clicks
    assert all(re.search(r"`[^`]*\d`", markdown.FENCE.sub("", RECIPES[name])) for name in WITH_COMMANDS)


def test_wrong_figures_are_found(tmp_path):
    (tmp_path / "out/a").mkdir(parents=True)
    (tmp_path / "out/a/summary.json").write_text('{"contact": [{"force": [0, -2.0]}]}')
    text = "```sh\nmortise solve a.toml  # now\n```\n`contact.0.force.1 = {}` and `{}`\n"
    assert not markdown.wrong_figures(text.format("-2", "3.14"), tmp_path, "says 3.141")
    assert len(markdown.wrong_figures(text.format("2", "3.2"), tmp_path, "says 3.141")) == 2


def test_the_readme_s_scene(desk):
    section = markdown.sections(TEXTS["README.md"])["A scene of your own"]
    files, commands = markdown.files(section), markdown.commands(section)
    assert set(files) == {"punch.geo", "punch.toml"} and len(commands) == 4
    write(desk, files)
    assert "solved" in "".join(run(desk, command) for command in commands)
    assert list((desk / "out").rglob("punch*.png"))


def write_values(desk):
    """Of the snippet with values from files, over the bodies of BASE_GEO."""
    places = np.array([[0.0, 0, 0], [1, 0, 0], [1, 2, 0], [0, 2, 0]])
    cells = [("triangle", np.array([[0, 1, 2], [0, 2, 3]]))]
    meshio.Mesh(places, cells, {"temperature": np.full(4, 300.0)}).write(desk / "thermal.vtu")
    (desk / "measured.csv").write_text("x,y,q\n0,2,1\n1,2,2\n0,0,1\n1,0,1\n")


@pytest.mark.parametrize("number", range(len(SNIPPETS)))
def test_snippets_of_a_scene(desk, number):
    snippet = SNIPPETS[number]
    write(desk, {"base.geo": BASE_GEO})
    write_values(desk)
    write(desk, {"scene.toml": BASE_TOML + snippet})
    assert "unknown" not in run(desk, "mortise check scene.toml")


def test_links_between_pages():
    for page in PAGES:
        for link in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", markdown.FENCE.sub("", page.read_text())):
            assert "://" in link or (page.parent / link).exists(), f"{page.name}: {link}"


@cache
def help_of(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=True)
    return done.stdout


def calls(pattern):
    """Matches in the commands, in fences and between backquotes, of all pages, with the page."""
    for name, text in TEXTS.items():
        inline = re.findall(r"`([^`\n]+)`", markdown.FENCE.sub("", text))
        for command in [*markdown.commands(text), *inline]:
            for found in re.finditer(pattern, command):
                yield name, found


def test_options_of_mortise(mortise):
    found = list(calls(r"\bmortise (solve|check|new|mesh|sweep|picture|certify|report|window)\b(.*)"))
    assert len(found) > 15
    for page, call in found:
        known = help_of(mortise, call[1], "--help")
        for option in re.findall(r"(?<![\w-])--?[a-z][\w-]*", call[2]):
            assert re.search(rf"(?<![\w-]){option}\b", known), f"{page}: {call[0]}"


def test_commands_of_dev():
    known, found = help_of(launch.ROOT / "dev", "help"), list(calls(r"\./dev (\w+)(.*)"))
    assert len(found) > 15
    names = set(re.findall(r"^  (\w+)", known, re.M))
    for page, call in found:
        assert call[1] in names | {"NAME"}, f"{page}: {call[0]}"
        for option in re.findall(r"(?<![\w-])--[a-z][\w-]*", call[2]):
            assert option in known or option in STUDY_OPTIONS, f"{page}: {call[0]}"


@pytest.mark.parametrize(
    "template, page",
    [
        ("accuracy/accuracy", "accuracy"),
        ("chart/performance", "performance"),
        ("exact/benchmarks", "benchmarks"),
        ("exact/exact", "exact"),
        ("exact/public_cases", "cases"),
    ],
)
def test_a_page_has_its_template_s_prose(template, page):
    """A page is made anew from its template: what is written in one of them alone is lost, or not shown."""
    lines = (launch.ROOT / "verification" / f"{template}.md").read_text().splitlines()
    prose = [line for line in lines if "{" not in line]
    assert len(prose) > 10
    assert [line for line in prose if line not in TEXTS[f"{page}.md"]] == []
