"""The same problem said or solved in another way: its pressures must be the same.

Said: other units, moved, mirrored or turned as a whole, another kind of mesh file with other numbers. Solved: the
mortar method's direct solver against domain decomposition and MSSOR.
"""

import copy
from dataclasses import replace

import deck_files
import msh_file
import plates
import toml_text
from fuzz_case import Twin, solve_case

# Signed permutations of the axes: x = (0, 1) and its sign, y likewise; exact in floating point.
ISOMETRIES = {
    "mirrored left to right": ((-1, 0), (0, 1)),
    "turned by 90 degrees": ((0, -1), (1, 0)),
    "turned by 180 degrees": ((-1, 0), (0, -1)),
    "mirrored at the diagonal": ((0, 1), (1, 0)),
}


def same(value):
    return value


def next_tag(node):
    return node + 1


def files_of(setting, kind="4.1 ascii", tag_of=next_tag):
    """The scene file and the mesh file: of a kind of .msh, or a deck by its ending."""
    if kind in deck_files.WRITERS:
        mesh = deck_files.WRITERS[kind](setting.mesh, tag_of).encode()
    else:
        mesh = msh_file.write(msh_file.sections(setting.mesh, kind, tag_of), kind)
    return toml_text.document(setting.scene).encode(), mesh


def case_of(setting, what, kind="4.1 ascii", tag_of=next_tag):
    accuracy = limit_of(setting.scene.get("method", {}), 1e-6)
    files = files_of(setting, kind, tag_of)
    return solve_case("valid scene", what, *files, mesh_file=setting.scene["mesh"]["file"], thrust=setting.thrust,
                      accuracy=accuracy, setting=setting)  # fmt: skip


def apply(matrix, vector):
    return [row[0] * vector[0] + row[1] * vector[1] for row in matrix]


def turned_components(matrix, given):
    """Components {x, y} of a displacement, either of which may be missing, in the turned axes; its normal one stays."""
    if "normal" in given:
        return given
    sources = {name: 0 if row[0] else 1 for row, name in zip(matrix, "xy")}
    return {name: row[source] * given["xy"[source]] for row, (name, source) in zip(matrix, sources.items())
            if "xy"[source] in given}


def changed(setting, place=None, displacement=same, traction=same, pressure=same, force=same, young=same,
            gap=same, rigid=same, foundation=same, density=same, gravity=same):
    """The scene with its loads, supports, stiffnesses and clearances changed by functions, its nodes put to place(x, y)."""
    scene = copy.deepcopy(setting.scene)
    by = {"displacement": displacement, "traction": traction, "pressure": pressure, "force": force, "young": young,
          "rigid": rigid, "foundation": foundation, "density": density, "gravity": gravity}  # fmt: skip
    for entry in (*scene["boundary"], *scene.get("body_force", []), *scene["materials"].values(), scene["model"]):
        entry |= {key: by[key](value) for key, value in entry.items() if key in by}
    for entry in scene.get("contact", []):
        if not isinstance(entry.get("initial_gap", ""), str):
            entry["initial_gap"] = gap(entry["initial_gap"])
        if "overlap" in entry and not isinstance(gap(1.0), str):  # it is no function
            entry["overlap"] = gap(entry["overlap"])
    mesh = plates.moved(setting.mesh, place) if place else setting.mesh
    return replace(setting, scene=scene, mesh=mesh, thrust=None)


def turned(setting, matrix):
    """The scene in other axes."""
    vector = lambda v: apply(matrix, v)
    displacement = lambda u: turned_components(matrix, u)
    rigid = lambda given: displacement(given) | {"rotation": 0, "force": vector(given["force"])}
    return changed(setting, lambda x, y: tuple(apply(matrix, (x, y))), displacement, traction=vector, force=vector,
                   rigid=rigid, gravity=vector)  # fmt: skip


def in_millimetres(setting):
    """The scene in mm, N and MPa if it was in m, N and Pa."""
    mega = lambda v: 1e-6 * v
    return changed(setting, lambda x, y: (1e3 * x, 1e3 * y), lambda u: {k: 1e3 * v for k, v in u.items()},
                   lambda t: [mega(v) for v in t], mega, lambda f: [1e-9 * v for v in f], mega, lambda g: 1e3 * g,
                   lambda given: given | {"x": 1e3 * given["x"], "force": [1e-3 * v for v in given["force"]]},
                   lambda k: 1e-9 * k, lambda d: 1e-9 * d)  # fmt: skip


def carried(setting, by):
    """The same loads and supports, and everything carried along by a small displacement."""
    by = dict(zip("xy", by))
    return changed(setting, displacement=lambda u: {axis: value + by[axis] for axis, value in u.items()})


def can_be_carried(setting):
    """Whether its supports go along."""
    return all("foundation" not in entry and "rigid" not in entry and "normal" not in entry.get("displacement", {})
               for entry in setting.scene["boundary"])  # fmt: skip


def fits_decks(setting):
    return all(kind != plates.QUAD9 for _, kind, _ in setting.mesh.cells)


def as_expressions(random, setting):
    """The same numbers as functions of place."""
    word = lambda v: random.choice((f"{v!r} + 0 * x", f"{v!r} * cos(theta - theta)", f"x < 1e300 ? {v!r} : y"))
    words = lambda values: [word(v) for v in values]
    made = changed(setting, displacement=lambda u: {axis: word(v) for axis, v in u.items()}, traction=words,
                   pressure=word, force=words, gap=word, foundation=word)  # fmt: skip
    for entry in made.scene.get("initial_strain", []):
        entry["temperature_change"] = word(entry["temperature_change"])
    return made


def iterates(method):
    return method.get("kind") == "ddm" or method.get("solver") == "mssor"


def limit_of(method, least):
    """How far p may be off: what an iteration is asked for, times what a slow one may still have before it."""
    return max(least, 1e3 * method.get("tolerance", 1e-8)) if iterates(method) else least


def twin_of(setting, name, other, factor=1.0, back=lambda x, y: (x, y), kind="4.1 ascii", tag_of=next_tag):
    """`other` is `setting` in other words. Whether an iteration ends within its steps may hang on the words."""
    told = setting.scene["method"]
    return Twin(name, case_of(other, name, kind, tag_of), factor, back, limit_of(told, 1e-6), not iterates(told))


def said_otherwise(random, setting):
    """One twin of the scene that is the same problem in other words."""
    size = max(max(abs(x), abs(y)) for x, y in setting.mesh.nodes)
    choice = random.choice(("units", "isometry", "shift", "carried", "mesh file", "expressions", "deck"))
    if choice == "expressions":
        return twin_of(setting, "as expressions", as_expressions(random, setting))
    if choice == "deck" and fits_decks(setting):
        kind, other = random.choice(list(deck_files.WRITERS)), copy.deepcopy(setting.scene)
        other["mesh"]["file"] = "mesh" + kind
        return twin_of(setting, f"a mesh file {kind}", replace(setting, scene=other), kind=kind,
                       tag_of=lambda node: 3 * node + 7)  # fmt: skip
    if choice == "units":
        return twin_of(setting, "in other units", in_millimetres(setting), 1e-6, lambda x, y: (x / 1e3, y / 1e3))
    if choice == "isometry":
        name, matrix = random.choice(list(ISOMETRIES.items()))
        inverse = tuple(zip(*matrix))
        return twin_of(setting, name, turned(setting, matrix), back=lambda x, y: tuple(apply(inverse, (x, y))))
    if choice == "shift":
        a, b = size * random.uniform(-3, 3), size * random.uniform(-3, 3)
        other = replace(setting, mesh=plates.moved(setting.mesh, lambda x, y: (x + a, y + b)))
        return twin_of(setting, "elsewhere", other, back=lambda x, y: (x - a, y - b))
    if choice == "carried" and can_be_carried(setting):
        return twin_of(setting, "carried along", carried(setting, [1e-3 * size * random.uniform(-1, 1) for _ in "xy"]))
    other = replace(setting, mesh=plates.shuffled(setting.mesh, random))
    kind, stride = random.choice(msh_file.KINDS), random.choice((1, 3, 1000))
    return twin_of(setting, f"mesh file {kind}", other, kind=kind, tag_of=lambda node: stride * node + 7)


def solved_otherwise(random, setting):
    """The mortar method's answer, or that of another method if this is it; None where there is no other."""
    scene = copy.deepcopy(setting.scene)
    if "contact" not in scene:
        return None
    told = scene["method"]
    if iterates(told):
        method = {k: v for k, v in told.items() if k in ("multipliers", "integration")} | {"kind": "mortar"}
    else:
        by_ddm = random.random() < 0.5
        method = told | {"kind": "ddm"} if by_ddm else told | {"solver": "mssor"}
        method["acceleration"] = random.choice(("krylov", "anderson" if by_ddm else "minres"))
    # Which side carries the multipliers hangs on the method where the scene does not say it.
    if any("multipliers_on" not in pair for pair in scene["contact"]):
        return None
    other = "by " + (method.get("solver") or method["kind"])
    limit = max(limit_of(told, 1e-5), limit_of(method, 1e-5))
    twin = case_of(replace(setting, scene=scene | {"method": method}), other)
    return Twin(other, twin, limit=limit, same_verdict=False)
