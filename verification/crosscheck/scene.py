"""The physics of a scene, read from its file and not from mortise, and the case file that FreeFEM reads."""

import itertools
import tomllib
from dataclasses import dataclass
from fnmatch import fnmatchcase

import numpy as np

import contact_points
import convert
from cases import StudyError

POINTS = "contact_points.txt"  # beside the case file, where the gap is that of the curves
MESH = "bodies.msh"  # beside it
EXPRESSIONS = "expressions.idp"  # beside it, where the scene has functions of place
ORDER_OF_MULTIPLIERS = {"linear": 1, "quadratic": 2}
SIDES = ("first", "second")  # of `between`


def set_entry(table, key, value):
    """KEY=VALUE as mortise's --set takes it."""
    *path, last = key.split(".")
    for part in path:
        table = table[int(part)] if isinstance(table, list) else table.setdefault(part, {})
    table[last] = value


def read_scene(path, settings):
    """The scene's tables, with some values replaced."""
    scene = tomllib.loads(path.read_text())
    for key, value in settings.items():
        set_entry(scene, key, value)
    return scene


def size_parameters(scene, sizes):
    """Values of the first two mesh parameters, in the order of the scene file."""
    return dict(zip(scene["mesh"]["parameters"], sizes))


def named(patterns, names):
    """The names that a pattern or a list of patterns takes."""
    patterns = [patterns] if isinstance(patterns, str) else patterns
    return [name for name in names if any(fnmatchcase(name, pattern) for pattern in patterns)]


# ---- Contact ----


def is_cut(entry):
    """Whether a [[contact]] entry ties the cuts of a sector."""
    return entry.get("condition") == "cyclic"


def contacts(scene):
    """The [[contact]] entries that are contact, each with its number among all."""
    return [(k, entry) for k, entry in enumerate(scene["contact"]) if not is_cut(entry)]


@dataclass
class Side:
    """One curve of a contact pair."""

    name: str
    body: str
    tag: int
    x: np.ndarray  # vertices x 2, with the body on the left


def multipliers_on(entry, side):
    """The curve, or the pattern of the curves, that carries the multipliers in a [[contact]] entry. `side`: a curve, or
    which of `between`."""
    between = entry["between"]
    if side not in (*between, *SIDES):
        raise StudyError(f"multipliers on '{side}'; the scene's contact is between {' and '.join(between)}")
    return between[SIDES.index(side)] if side in SIDES else side


def mean_edge(x):
    return np.linalg.norm(np.diff(x, axis=0), axis=1).mean()


def meets(x, others, within):
    """Whether a normal in the middle of an edge meets an edge of the others within a distance."""
    for a, b in itertools.pairwise(x):
        n = np.array([b[1] - a[1], a[0] - b[0]]) / np.linalg.norm(b - a)
        hit = contact_points.facing(others, (a + b) / 2, n)
        if hit and abs(hit[2]) <= within:
            return True
    return False


def face(a, b):
    """Whether two curves face each other: half an edge apart at most."""
    within = min(mean_edge(a.x), mean_edge(b.x)) / 2
    return meets(a.x, b.x, within) or meets(b.x, a.x, within)


def contact_pairs(scene, side, bodies, tags):
    """The pairs: their multiplier sides and their opposite sides. Of patterns, those that face each other; if both sides
    have the same pattern, the multipliers are on the later curve."""

    def of_one_body(pattern):
        for name in named(pattern, sorted(tags, key=tags.get)):
            owners = convert.bodies_of_curve(bodies, tags[name])
            if len(owners) == 1:
                vertices = contact_points.vertices_of(bodies[owners[0]], tags[name])
                yield Side(name, owners[0], tags[name], vertices)

    for _, entry in contacts(scene):
        on = multipliers_on(entry, side)
        other = entry["between"][on == entry["between"][0]]
        ours, theirs = list(of_one_body(on)), list(of_one_body(other))
        for a, b in itertools.product(ours, theirs):
            is_pair = (a.name, b.name) == (on, other) or a.body != b.body and face(a, b)
            if is_pair and (on != other or a.tag > b.tag):
                yield a, b


# ---- The case file ----


def refuse_others(entry, known):
    """StudyError for keys of an entry that FreeFEM is not told."""
    for key in entry.keys() - known:
        raise StudyError(f"FreeFEM is not told '{key}' of {entry}; known: {', '.join(sorted(known))}")


def strain_of(entry, material, values):
    """Initial strain 11, 22, 33, 12, as words of the case file."""
    if "temperature_change" in entry:
        strain = values.word(entry["temperature_change"], material["thermal_expansion"])
        return [strain, strain, strain, "0.0"]
    return [values.word(entry["strain"].get(key, 0)) for key in ("xx", "yy", "zz", "xy")]


def material_of(scene, body):
    """A body's own name counts before a pattern."""
    (pattern, *_) = [body] if body in scene["bodies"] else [p for p in scene["bodies"] if fnmatchcase(body, p)]
    return scene["materials"][scene["bodies"][pattern]]


def areas_of_curves(bodies, tags, plane, thickness=1.0):
    """By tag, of straight edges: a plane model has a thickness, a ring goes all round."""
    areas = dict.fromkeys(tags.values(), 0.0)
    for body in bodies.values():
        x = body.points[body.edges]
        depth = 2 * np.pi * x[:, :, 0].mean(axis=1) if plane == "axisymmetric" else thickness
        for tag, area in zip(body.labels, np.linalg.norm(x[:, 1] - x[:, 0], axis=1) * depth):
            areas[tag] = areas.get(tag, 0.0) + area
    return areas


def traction_of_force(entry, tags, areas):
    """The constant traction on all curves of an entry that has its force; StudyError where it acts on points."""
    curves = named(entry["on"], tags)
    if not curves:
        raise StudyError(f"FreeFEM is not told the force on points of {entry}; expected curves")
    whole = sum(areas[tags[curve]] for curve in curves)
    return [float(component) / whole for component in entry["force"]]


def boundary_lines(scene, tags, values, areas):
    """Prescribed displacements, loads and foundations, one line of the case file each. `areas`: of curves, by tag."""
    for entry in scene.get("boundary", []):
        refuse_others(entry, {"on", "displacement", "pressure", "traction", "force", "foundation"})
        if "force" in entry:
            entry = entry | {"traction": traction_of_force(entry, tags, areas)}
        for label in (tags[curve] for curve in named(entry["on"], tags)):
            refuse_others(entry.get("displacement", {}), {"x", "y"})
            for component, value in entry.get("displacement", {}).items():
                yield f"displacement {label} {component} {values.word(value)}"
            if "pressure" in entry:
                yield f"pressure {label} {values.word(entry['pressure'])}"
            if "traction" in entry:
                yield f"traction {label} {' '.join(map(values.word, entry['traction']))}"
            if isinstance(modulus := entry.get("foundation"), list):
                yield f"foundation {label} axes {' '.join(map(values.word, modulus))}"
            elif modulus is not None:
                yield f"foundation {label} normal {values.word(modulus)}"


def body_lines(scene, bodies, values):
    """Materials, initial strains and body forces; a body's number is its place in `bodies`."""
    gravity = scene.get("model", {}).get("gravity")
    for body in bodies:
        material = material_of(scene, body)
        refuse_others(material, {"young", "poisson", "thermal_expansion", "density"})
        yield f"body {float(material['young'])!r} {float(material['poisson'])!r}"
    for entry in scene.get("initial_strain", []):
        for body in named(entry["body"], bodies):
            strain = " ".join(strain_of(entry, material_of(scene, body), values))
            yield f"initial_strain {bodies.index(body)} {strain}"
    for entry in scene.get("body_force", []):
        for body in named(entry["body"], bodies):
            yield f"body_force {bodies.index(body)} {' '.join(map(values.word, entry['force']))}"
    for k, body in enumerate(bodies if gravity else []):
        yield "body_force {} {!r} {!r}".format(k, *(material_of(scene, body)["density"] * float(g) for g in gravity))


def gap_lines(scene, gap, values):
    """FreeFEM has the gap and the normals of curves from a file of points; the scene's own gap is a value."""
    if gap == "scene":
        (own,) = {entry["initial_gap"] for _, entry in contacts(scene)}
        return [f"gap {values.word(own)}"]
    return ["gap given", f"points {POINTS}"] if gap == "curve" else [f"gap {gap}"]


def stiffness_lines(scene):
    """StudyError where pairs give way by several laws, or by one that is not linear."""
    first, *others = [entry.get("stiffness") for _, entry in contacts(scene)]
    if any(other != first for other in others) or not isinstance(first, (int, float, type(None))):
        raise StudyError(f"FreeFEM is not told the stiffness {first}; expected one number for all pairs")
    return [f"stiffness {float(first)!r}"] if first is not None else []


def fluid_lines(scene, pairs, tags):
    """A line for each place from which a fluid comes. StudyError beside what FreeFEM has no fluid with."""
    for k, entry in contacts(scene):
        if "fluid" not in entry:
            continue
        others = [f"contact.{k}.stiffness"] * ("stiffness" in entry) + ['condition = "cyclic"'] * any(map(is_cut, scene["contact"]))
        if others:
            raise StudyError(f"FreeFEM is not told contact.{k}.fluid beside {others[0]}")
        pair = [set(pair) for pair in pairs].index({tags[name] for name in entry["between"]})
        places = entry["fluid"]["from"]
        for x, y in places if isinstance(places[0], list) else [places]:
            yield f"fluid {pair} {float(entry['fluid']['pressure'])!r} {float(x)!r} {float(y)!r}"


def cut_lines(scene, side, tags):
    """The cuts of sectors, first the one that follows: as of a contact's multipliers, by `side`."""
    for entry in filter(is_cut, scene["contact"]):
        refuse_others(entry, {"between", "condition", "multipliers_on"})
        follows = multipliers_on(entry, side)
        leads = entry["between"][follows == entry["between"][0]]
        yield f"cyclic {tags[follows]} {tags[leads]}"


def case_text(scene, bodies, pairs, tags, freefem, gap, values, areas, side="first"):
    """The case file; `bodies`: their names, `pairs`: the tags of the multiplier and the opposite side of each. `values`:
    Quantities, to which the scene's expressions are added; `areas`: of the curves, by tag; `side`: as of multipliers_on."""
    model = scene.get("model", {})
    refuse_others(model, {"plane", "gravity", "thickness"})
    lines = [
        f"plane {model.get('plane', 'strain')}",
        *([f"thickness {float(model['thickness'])!r}"] if "thickness" in model else []),
        f"mesh {MESH}",
        *body_lines(scene, bodies, values),
        *("contact {} {}".format(*pair) for pair in pairs),
        f"order {freefem['order']}",
        f"multipliers {ORDER_OF_MULTIPLIERS[freefem['multipliers']]}",
        *(f"{key} {freefem[key]}" for key in ("integration", "gauss", "springs") if key in freefem),
        *gap_lines(scene, gap, values),
        *stiffness_lines(scene),
        *fluid_lines(scene, pairs, tags),
        *cut_lines(scene, side, tags),
        *boundary_lines(scene, tags, values, areas),
        "end",
    ]
    return "\n".join(lines) + "\n"
