"""The cases of the cross-check: cases.toml, expanded."""

import difflib
import itertools
import tomllib
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from pathlib import Path

TABLE = Path(__file__).with_name("cases.toml")


class CaseError(Exception):
    """Something that stops one case, or the run, with a message for people."""


@dataclass(frozen=True)
class Step:
    """One mesh, solved once by each program."""

    scene: str
    mesh: tuple  # values of the scene's first two mesh parameters
    side: str  # the contact curve that carries the multipliers
    mesh_parameters: dict  # beside the sizes: kind, order, straight
    mortise: dict  # multipliers, integration: as in the scene file
    freefem: dict  # order, multipliers, integration, gauss
    condition: str  # bilateral or unilateral
    same_nodes: bool  # whether both programs have the same unknowns at the same places

    @property
    def mesh_name(self):
        return "x".join(str(n) for n in self.mesh)


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
        raise CaseError(f"{TABLE.name}: mesh '{text}'; expected two numbers of elements such as 8x10")
    return tuple(int(n) for n in numbers)


def matches(name, globs):
    return any(fnmatchcase(name, glob) for glob in globs)


def one_discretisation_step(table, scene, mesh, side, space, integration, condition="bilateral"):
    """A step in which both programs have the same spaces and quadrature."""
    spaces = table["same_discretisation"]
    chosen = spaces["spaces"][space]
    method = {"multipliers": chosen["multipliers"], "integration": integration}
    return Step(
        scene=scene,
        mesh=mesh_size(mesh),
        side=side,
        mesh_parameters={**spaces["parameters"], "order": chosen["order"]},
        mortise=method,
        freefem={**method, "order": chosen["order"], "gauss": chosen["gauss"]},
        condition=condition,
        same_nodes=True,
    )


def same_discretisation(table):
    level = table["same_discretisation"]
    for group in level["scenes"]:
        condition = group.get("condition", "bilateral")
        product = itertools.product(
            group["names"], group["meshes"], level["spaces"], level["integrations"], group["sides"]
        )
        for scene, mesh, space, integration, side in product:
            name = f"same_discretisation/{scene}/{mesh}/{space}/{integration}/{side}"
            if condition == "unilateral":
                name += "/unilateral"
            if matches(name, level["exclude"]):
                continue
            step = one_discretisation_step(table, scene, mesh, side, space, integration, condition)
            quick = matches(name, level["quick"])
            limits = {**level["limits"], **({"active": 0} if condition == "unilateral" else {})}
            yield Case("same_discretisation", name, (step,), limits=limits, quick=quick)


def same_problem(table):
    level = table["same_problem"]
    parameters = {key: level["mortise"][key] for key in ("kind", "order")}
    method = {key: level["mortise"][key] for key in ("multipliers", "integration")}
    for group in level["scenes"]:
        for scene, side in itertools.product(group["names"], group["sides"]):
            steps = tuple(
                Step(scene, mesh_size(mesh), side, parameters, method, level["freefem"], "bilateral", same_nodes=False)
                for mesh in group["meshes"]
            )
            yield Case(
                level="same_problem",
                name=f"same_problem/{scene}/{'-'.join(group['meshes'])}/{side}",
                steps=steps,
                limits=group["limits"],
                least_rates=group["least_rates"],
                kinks=tuple(group.get("kinks", ())),
                quick=group.get("quick", False),
            )


def timing(table):
    level = table["timing"]
    for scene, mesh, side in itertools.product(level["scenes"], level["meshes"], level["sides"]):
        step = one_discretisation_step(table, scene, mesh, side, level["space"], level["integration"])
        yield Case("timing", f"timing/{scene}/{mesh}", (step,), repeats=level["repeats"])


def all_cases(path=TABLE):
    """Every case of the table, in its order."""
    with open(path, "rb") as file:
        table = tomllib.load(file)
    cases = [*same_discretisation(table), *same_problem(table), *timing(table)]
    twice = {case.name for case in cases if sum(other.name == case.name for other in cases) > 1}
    if twice:
        raise CaseError(f"{path}: two cases of the name {min(twice)}")
    return cases


def nearest_names(glob, names):
    """The names that look most like a glob that none of them matches."""
    plain = glob.replace("*", "").replace("?", "")
    return difflib.get_close_matches(plain, names, n=3, cutoff=0.3) or names[:3]


def choose(cases, globs, quick):
    """The cases of the globs, all without any; each glob must match. `quick` leaves out what is not marked so."""
    names = [case.name for case in cases]
    for glob in globs:
        if not any(fnmatchcase(name, glob) for name in names):
            near = "\n  ".join(nearest_names(glob, names))
            raise CaseError(f"no case matches '{glob}'; the nearest are\n  {near}")
    chosen = [case for case in cases if (not globs or matches(case.name, globs)) and (case.quick or not quick)]
    if not chosen:
        raise CaseError("none of these cases is a quick one; leave --quick out")
    return chosen
