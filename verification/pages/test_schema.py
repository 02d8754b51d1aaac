"""docs/scene.schema.json judges as the program does. Its keys and limits are those that the program reads by."""

import json
import re
import tomllib

import jsonschema
import pytest

import launch
import markdown

SCHEMA = json.loads((launch.ROOT / "docs/scene.schema.json").read_text())
JUDGE = jsonschema.Draft7Validator(SCHEMA)
# Every table that a scene can have.
WHOLE = """
title = "all"
mesh = { file = "block.geo", parameters = {} }
fields.T = { file = "values.csv" }
model.plane = "strain"
materials.steel = { young = 210e9, poisson = 0.3 }
materials.wood = { young = [2e9, 1e9, 1e9], poisson = [0.3, 0.3, 0.3], shear = 1e9, thermal_expansion = 1e-5 }
materials.foam = { stiffness = [[2, 1, 1, 0], [1, 2, 1, 0], [1, 1, 2, 0], [0, 0, 0, 1]] }
bodies = { upper = "steel", lower = "wood", middle = "foam" }
copies = [
  { body = "block", name = "b_*", grid = { count = [2, 1], step = [1, 1] } },
  { body = "block", name = "c_*", places = [[0, 1], [2, 0, 90]] },
]
boundary = [{ on = "top", displacement = { x = 0, y = "x" } }, { on = "b", rigid = { y = 0 } }, { on = "c", pressure = "T" }]
body_force = [{ body = "upper", force = [0, 1] }]
initial_strain = [{ body = "upper", strain = { xx = 0 } }, { body = "lower", temperature_change = 1 }]
contact = [{ between = ["a", "b"], initial_gap = "closed" }]
probe = [{ at = [0, 0] }, { from = [0, 0], to = [1, 0], points = 3 }]
expect = [{ figure = "energy", value = 1, tolerance = "1%" }, { pressure = "x", pair = 0, tolerance = 0.1, source = "a book" }]
method.solver = "ddm"
[accuracy]
value = "1%"
"""
WRONG = [
    "mesh.file=block.step", "mesh.time_limit=0", "mesh.programs=1", "mesh.parameters.n=many",
    "copies.0.grid.count=2", "copies.0.ring=3", "copies.1.places=[]", "copies.0.name=2",
    "fields.T.component=-1", "fields.T.file=values.txt",
    "model.plane=flat", "model.thickness=-1", "model.gravity=9.81",
    "materials.steel.poisson=0.5", "materials.steel.young=0", "materials.steel.density=0",
    "materials.steel.stiffness=1", "materials.wood.young=[1, 2]", "materials.foam.stiffness=[1]",
    "bodies.upper=1",
    "boundary.0.pressure=1", "boundary.0.on=[]", "boundary.0.displacement.normal=true",
    "boundary.0.displacement.direction=[1, 0]", "boundary.1.rigid.force=1", "boundary.2.pressure=[1, 2]",
    "body_force.0.force=1", "initial_strain.0.temperature_change=1", "initial_strain.0.strain=1",
    "contact.0.between=a", "contact.0.within=0", "contact.0.clearance=true", "contact.0.condition=glued",
    "probe.0.at=1", "probe.1.points=1", "probe.1.at=[0, 0]", "probe.0.body=1",
    "expect.0.figure=1", "expect.0.value=energy", "expect.0.tolerance=2", "expect.1.pair=-1", "expect.1.source=1",
    "method.beta=fast", "method.tolerance=0", "method.max_iterations=0", "method.dirichlet=[]", "method.omega=2",
    "accuracy.value=1", "accuracy.value=5", "accuracy.unknowns_max=1", "accuracy.first_edges=1",
    "accuracy.recombine=1", "accuracy.pair=-1",
]  # fmt: skip


@pytest.fixture
def read(mortise, tmp_path):
    """What the program says of WHOLE with these settings."""
    (tmp_path / "block.geo").write_text("")
    (tmp_path / "values.csv").write_text("x,y,T\n0,0,1\n")
    (tmp_path / "scene.toml").write_text(WHOLE)

    def say(*settings):
        words = [word for setting in settings for word in ("--set", setting)]
        done, _ = launch.run([mortise, "check", *words, tmp_path / "scene.toml"], expected=(1,))
        return done.stderr

    return say


def test_whole_is_right_but_for_its_empty_geometry(read):
    assert JUDGE.is_valid(tomllib.loads(WHOLE))
    assert "accuracy" in read() or "block.geo" in read()


def changed(scene, setting):
    path, text = setting.split("=", 1)
    *way, last = [int(part) if part.isdigit() else part for part in path.split(".")]
    for part in way:
        scene = scene[part]
    try:
        scene[last] = tomllib.loads("value = " + text)["value"]
    except tomllib.TOMLDecodeError:
        scene[last] = text


@pytest.mark.parametrize("setting", WRONG)
def test_what_the_schema_refuses_the_program_refuses(read, setting):
    scene = tomllib.loads(WHOLE)
    changed(scene, setting)
    assert not JUDGE.is_valid(scene)
    assert re.search(rf"\b{re.escape(setting.split('=')[0].rsplit('.', 1)[0])}\b", read(setting))


def scenes():
    yield from ((path.name, path.read_text()) for path in sorted((launch.ROOT / "geo").glob("*.toml")))
    for page in ("README.md", "docs/recipes.md"):
        found = markdown.files((launch.ROOT / page).read_text())
        yield from ((name, text) for name, text in found.items() if name.endswith(".toml"))


@pytest.mark.parametrize("name, text", scenes(), ids=lambda value: value[:20])
def test_scenes_are_right(name, text):
    assert not [error.message for error in JUDGE.iter_errors(tomllib.loads(text))]
