"""The case of a seed and a number: always the same one."""

import random

import assemblies
import assembly_oracles
import broken_meshes
import broken_scenes
import command_cases
import data_cases
import deck_files
import geo_cases
import msh_file
import outline_cases
import references
import toml_text
import twins
import valid_scenes
from fuzz_case import ANY, solve_case

STRANGE_NAMES = ("=1+1", "@SUM(A1)", "-2+3", "\x1b[31mred", "bell\x07", "a,b;c", "ü" * 100, "n" * 3000, "tab\there",
                 " ", "a'b")  # fmt: skip


def make_valid(r):
    setting = valid_scenes.valid_setting(r)
    kind = r.choice(msh_file.KINDS)
    made = twins.case_of(setting, ", ".join(f"{k} = {v}" for k, v in setting.scene["method"].items()), kind)
    if r.random() < 0.6:
        twin = twins.said_otherwise(r, setting) if r.random() < 0.6 else twins.solved_otherwise(r, setting)
        made.twins = [twin] if twin else []
    return made


def make_broken_scene(r):
    setting, choice = valid_scenes.valid_setting(r), r.random()
    if choice < 0.1:
        text, what, expect = renamed(r, setting), "a strange name throughout", ANY
    elif choice < 0.65:
        what, expect = broken_scenes.change(r, setting.scene)
        text = toml_text.document(setting.scene).encode("utf-8", "surrogateescape")
    else:
        text, what, expect = broken_scenes.change_text(r, toml_text.document(setting.scene).encode())
    mesh = msh_file.write(msh_file.sections(setting.mesh, "4.1 ascii"), "4.1 ascii")
    made = solve_case("broken scene", what, text, mesh, expect=expect)
    if r.random() < 0.2:
        made.words, made.output, made.results = ["check", "scene.toml"], (), None
    return made


def renamed(r, setting):
    """Gives a curve or a body of the scene and of its mesh a strange name; returns the scene's text."""
    mesh = setting.mesh
    old, new = r.choice(mesh.curves + mesh.bodies), r.choice(STRANGE_NAMES)
    mesh.curves, mesh.bodies = ([new if n == old else n for n in names] for names in (mesh.curves, mesh.bodies))
    text = toml_text.document(setting.scene).replace(toml_text.text(old), toml_text.text(new))
    return text.replace(f"{old} =", f"{toml_text.key(new)} =").encode()  # a body is a key of [bodies]


def make_deck(r, setting):
    """A deck of another program with some characters, a piece or a line that are not as they were."""
    ending, what = r.choice(list(deck_files.WRITERS)), r.choice(("characters", "piece", "end", "line"))
    setting.scene["mesh"]["file"] = "mesh" + ending
    scene, data = twins.files_of(setting, ending)
    at, data = r.randrange(len(data)), bytearray(data)
    if what == "characters":
        for _ in range(r.choice((1, 3, 20))):
            data[r.randrange(len(data))] = r.choice(b" 0123456789-+.,*\nDEax\xff\x00\x1b")
    elif what == "line":
        lines = data.splitlines(keepends=True)
        data = b"".join(lines[:at // 20] + [r.choice(lines)] + lines[at // 20:])
    else:
        del data[at : at + r.randint(1, 60) if what == "piece" else len(data)]
    return solve_case("mesh file", f"{ending}: {what}", scene, bytes(data), mesh_file="mesh" + ending)


def make_mesh_file(r):
    setting = command_cases.simple_setting(r)
    if r.random() < 0.25 and twins.fits_decks(setting):
        return make_deck(r, setting)
    kind, data, what, expect, same = broken_meshes.broken_file(r, setting.mesh)
    scene = toml_text.document(setting.scene).encode()
    thrust = setting.thrust if same else None
    return solve_case("mesh file", f"{kind}: {what}", scene, data, expect=expect, thrust=thrust)


MAKERS = {  # how many of a hundred cases are of each kind, and what makes one
    "valid scene": (30, make_valid),
    "broken scene": (20, make_broken_scene),
    "mesh file": (20, make_mesh_file),
    "geometry": (12, geo_cases.make_geo_case),
    "command line": (18, command_cases.make_command_case),
}


# Held against what is known otherwise, a second or more each: only where asked for. What makes the case of a seed and a
# number, and what judges its answer.
HELD = {
    "data": (data_cases.make_data, references.judge),
    "outline": (outline_cases.make_outline, references.judge),
    "assembly": (assemblies.make_assembly, assembly_oracles.judge),
}


def make_case(seed, number, kinds=tuple(MAKERS)):
    """Case `number` of the `seed`; `kinds`: those to choose from."""
    r = random.Random(f"{seed}:{number}")
    kind = r.choices(kinds, [MAKERS[kind][0] if kind in MAKERS else 20 for kind in kinds])[0]
    if kind in MAKERS:
        return MAKERS[kind][1](r)
    make, judge = HELD[kind]
    made = make(seed, number)
    made.judge = judge
    return made
