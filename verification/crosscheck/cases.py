"""The cases of the cross-check: cases.toml, expanded."""

import difflib
import itertools
import sys
import tomllib
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

from launch import StudyError

TABLE = Path(__file__).with_name("cases.toml")


@dataclass(frozen=True)
class Step:
    """One mesh, solved once by each program."""

    scene: str
    mesh: tuple  # values of the scene's first two mesh parameters
    side: str  # the contact curve that carries the multipliers
    mesh_parameters: dict  # beside the sizes: kind, order, straight
    mortise: dict  # multipliers, integration: as in the scene file
    freefem: dict  # order, multipliers, integration, gauss, and springs where bodies may move freely
    condition: str  # bilateral or unilateral
    gap: str  # closed, measured or scene (its own), with the edges' normals; curve: gap and normals of the curves
    same_nodes: bool  # whether both programs have the same unknowns at the same places
    settings: dict = field(default_factory=dict)  # values that stand in the place of the scene's


@dataclass(frozen=True)
class Case:
    """A row of the report: one step, or a series of them on finer and finer meshes."""

    level: str  # same_discretisation, same_problem or timing
    name: str
    steps: tuple
    limits: dict = field(default_factory=dict)
    least_rates: dict = field(default_factory=dict)
    kinks: tuple = ()
    quick: bool = False
    repeats: int = 1

    @property
    def scene(self):
        return self.steps[0].scene

    @property
    def side(self):
        return self.steps[0].side


def mesh_size(text):
    """The numbers of elements in AxB."""
    numbers = text.split("x")
    if len(numbers) != 2 or not all(n.isdigit() and int(n) > 0 for n in numbers):
        raise StudyError(f"{TABLE.name}: mesh '{text}'; expected two numbers of elements such as 8x10")
    return tuple(map(int, numbers))


def matches(name, globs):
    return any(fnmatchcase(name, glob) for glob in globs)


def gap_of(table, scene):
    """What the gap of a scene's meshes is taken for where the edges' normals are."""
    found = [gap for gap, scenes in table["gaps"].items() if scene in scenes]
    if len(found) != 1:
        raise StudyError(f"{TABLE.name}: [gaps] has '{scene}' {len(found)} times; expected once")
    return found[0]


def one_discretisation_step(table, scene, mesh, side, space, integration, group=None):
    """A step in which both programs have the same spaces and quadrature. `group`: what it says beside these."""
    group = group or {}
    spaces = table["same_discretisation"]
    chosen = spaces["spaces"][space]
    method = {"multipliers": chosen["multipliers"], "integration": integration}
    parameters = {**group.get("parameters", spaces["parameters"]), "order": chosen["order"]}
    springs = {"springs": group["springs"]} if "springs" in group else {}
    freefem = {**method, "order": chosen["order"], "gauss": chosen["gauss"], **springs}
    condition, gap = group.get("condition", "bilateral"), group.get("gap") or gap_of(table, scene)
    how = parameters, method, freefem, condition, gap
    return Step(scene, mesh_size(mesh), side, *how, same_nodes=True, settings=group.get("settings", {}))


def same_discretisation(table):
    level = table["same_discretisation"]
    for group in level["scenes"]:
        loaded = {"active": 0} if group.get("condition") == "unilateral" else {}
        integrations = group.get("integrations", level["integrations"])
        choices = group["names"], group["meshes"], level["spaces"], integrations, group["sides"]
        for scene, mesh, space, integration, side, solver in itertools.product(*choices, group.get("solvers", [None])):
            settings = group.get("settings", {}) | ({"method.solver": solver} if solver else {})
            parts = [scene, mesh, space, integration, side, group.get("condition"), group.get("gap"), solver]
            name = "/".join(["same_discretisation", *filter(None, parts)])
            if not matches(name, level["exclude"]):
                step = one_discretisation_step(table, scene, mesh, side, space, integration, group | {"settings": settings})
                limits, quick = level["limits"] | loaded, matches(name, level["quick"])
                yield Case("same_discretisation", name, (step,), limits=limits, quick=quick)


def same_problem(table):
    level = table["same_problem"]
    parameters, method = ({key: level["mortise"][key] for key in keys}
                          for keys in (("kind", "order"), ("multipliers", "integration")))
    for group in level["scenes"]:
        rest = {"limits": group["limits"], "least_rates": group["least_rates"], "kinks": tuple(group.get("kinks", ()))}
        for scene, side in itertools.product(group["names"], group["sides"]):
            how = side, parameters, method, level["freefem"], "bilateral", gap_of(table, scene)
            steps = [Step(scene, mesh_size(mesh), *how, same_nodes=False) for mesh in group["meshes"]]
            name = f"same_problem/{scene}/{'-'.join(group['meshes'])}/{side}"
            yield Case("same_problem", name, tuple(steps), **rest, quick=group.get("quick", False))


def timing(table):
    level = table["timing"]
    for scene, mesh, side in itertools.product(level["scenes"], level["meshes"], level["sides"]):
        step = one_discretisation_step(table, scene, mesh, side, level["space"], level["integration"])
        yield Case("timing", f"timing/{scene}/{mesh}", (step,), repeats=level["repeats"])


def all_cases(path=TABLE):
    """Every case of the table, in its order."""
    table = tomllib.loads(path.read_text())
    cases = [*same_discretisation(table), *same_problem(table), *timing(table)]
    names = [case.name for case in cases]
    if len(set(names)) < len(names):
        raise StudyError(f"{path}: two cases of the name {min(name for name in names if names.count(name) > 1)}")
    return cases


def choose(cases, globs, quick):
    """The cases of the globs, all without any; each glob must match. `quick` leaves out what is not marked so."""
    names = [case.name for case in cases]
    for glob in globs:
        if not any(fnmatchcase(name, glob) for name in names):
            plain = glob.replace("*", "").replace("?", "")
            near = "\n  ".join(difflib.get_close_matches(plain, names, n=3, cutoff=0.3) or names[:3])
            raise StudyError(f"no case matches '{glob}'; the nearest are\n  {near}")
    chosen = [case for case in cases if (not globs or matches(case.name, globs)) and (case.quick or not quick)]
    if not chosen:
        raise StudyError("none of these cases is a quick one; leave --quick out")
    return chosen
