"""The same problem said or solved in another way: its pressures must be the same.

Said: other units, moved, mirrored or turned as a whole, another kind of mesh file with other numbers. Solved: the
mortar method's direct solver against domain decomposition and MSSOR.
"""

import copy
from dataclasses import replace

import msh_file
import plates
import toml_text
from fuzz_case import Twin, solve_case
from valid_scenes import Setting

# Signed permutations of the axes: x = (0, 1) and its sign, y likewise; exact in floating point.
ISOMETRIES = {
    "mirrored left to right": ((-1, 0), (0, 1)),
    "turned by 90 degrees": ((0, -1), (1, 0)),
    "turned by 180 degrees": ((-1, 0), (0, -1)),
    "mirrored at the diagonal": ((0, 1), (1, 0)),
}


def files_of(setting, kind="4.1 ascii", tag_of=lambda node: node + 1):
    """The scene file and the mesh file."""
    mesh = msh_file.write(msh_file.sections(setting.mesh, kind, tag_of), kind)
    return toml_text.document(setting.scene).encode(), mesh


def apply(matrix, vector):
    return [matrix[0][0] * vector[0] + matrix[0][1] * vector[1], matrix[1][0] * vector[0] + matrix[1][1] * vector[1]]


def transpose(matrix):
    return tuple(zip(*matrix))


def turned_components(matrix, given):
    """Components {x, y} of a displacement, either of which may be missing, in the turned axes."""
    turned = {}
    for row, name in ((0, "x"), (1, "y")):
        source = 0 if matrix[row][0] else 1
        if "xy"[source] in given:
            turned[name] = matrix[row][source] * given["xy"[source]]
    return turned


def turned(setting, matrix):
    """The scene in other axes."""
    scene = copy.deepcopy(setting.scene)
    for entry in scene["boundary"]:
        if "displacement" in entry:
            entry["displacement"] = turned_components(matrix, entry["displacement"])
        if "traction" in entry:
            entry["traction"] = apply(matrix, entry["traction"])
    for entry in scene.get("body_force", []):
        entry["force"] = apply(matrix, entry["force"])
    return Setting(scene, plates.moved(setting.mesh, lambda x, y: tuple(apply(matrix, (x, y)))))


def in_millimetres(setting):
    """The scene in mm, N and MPa if it was in m, N and Pa."""
    scene = copy.deepcopy(setting.scene)
    for material in scene["materials"].values():
        material["young"] *= 1e-6
    for entry in scene["boundary"]:
        if "displacement" in entry:
            entry["displacement"] = {k: 1e3 * v for k, v in entry["displacement"].items()}
        if "traction" in entry:
            entry["traction"] = [1e-6 * t for t in entry["traction"]]
        if "pressure" in entry:
            entry["pressure"] *= 1e-6
    for entry in scene.get("body_force", []):
        entry["force"] = [1e-9 * f for f in entry["force"]]
    return Setting(scene, plates.moved(setting.mesh, lambda x, y: (1e3 * x, 1e3 * y)))


def carried(setting, by):
    """The same loads and supports, and everything carried along by a small displacement."""
    scene = copy.deepcopy(setting.scene)
    for entry in scene["boundary"]:
        for axis, amount in zip("xy", by):
            if axis in entry.get("displacement", {}):
                entry["displacement"][axis] += amount
    return Setting(scene, setting.mesh)


def iterates(method):
    return method.get("kind") == "ddm" or method.get("solver") == "mssor"


def limit_of(method, least):
    """How far p may be off: what an iteration is asked for, times what a slow one may still have before it."""
    return max(least, 1e3 * method.get("tolerance", 1e-8)) if iterates(method) else least


def twin_of(setting, name, other, factor=1.0, back=lambda x, y: (x, y), kind="4.1 ascii", tag_of=lambda node: node + 1):
    """`other` is `setting` in other words. Whether an iteration ends within its steps may hang on the words."""
    told = setting.scene["method"]
    return Twin(name, case_of(other, name, kind, tag_of), factor, back, limit_of(told, 1e-6), not iterates(told))


def said_otherwise(random, setting):
    """One twin of the scene that is the same problem in other words."""
    size = max(max(abs(x), abs(y)) for x, y in setting.mesh.nodes)
    choice = random.choice(("units", "isometry", "shift", "carried", "mesh file"))
    if choice == "units":
        return twin_of(setting, "in other units", in_millimetres(setting), 1e-6, lambda x, y: (x / 1e3, y / 1e3))
    if choice == "isometry":
        name, matrix = random.choice(list(ISOMETRIES.items()))
        inverse = transpose(matrix)
        return twin_of(setting, name, turned(setting, matrix), back=lambda x, y: tuple(apply(inverse, (x, y))))
    if choice == "shift":
        a, b = size * random.uniform(-3, 3), size * random.uniform(-3, 3)
        other = replace(setting, mesh=plates.moved(setting.mesh, lambda x, y: (x + a, y + b)))
        return twin_of(setting, "elsewhere", other, back=lambda x, y: (x - a, y - b))
    if choice == "carried":
        by = [1e-3 * size * random.uniform(-1, 1) for _ in "xy"]
        return twin_of(setting, "carried along", carried(setting, by))
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
        scene["method"] = {k: v for k, v in told.items() if k in ("multipliers", "integration")} | {"kind": "mortar"}
    elif random.random() < 0.5:
        scene["method"] = told | {"kind": "ddm", "acceleration": random.choice(("krylov", "anderson"))}
    else:
        scene["method"] = told | {"solver": "mssor", "acceleration": random.choice(("krylov", "minres"))}
    # Which side carries the multipliers hangs on the method where the scene does not say it.
    for pair in scene["contact"]:
        if "multipliers_on" not in pair:
            return None
    other = "by " + (scene["method"].get("solver") or scene["method"]["kind"])
    limit = max(limit_of(told, 1e-5), limit_of(scene["method"], 1e-5))
    return Twin(other, case_of(replace(setting, scene=scene), other), limit=limit, same_verdict=False)


def case_of(setting, what, kind="4.1 ascii", tag_of=lambda node: node + 1):
    accuracy = limit_of(setting.scene.get("method", {}), 1e-6)
    files = files_of(setting, kind, tag_of)
    return solve_case("valid scene", what, *files, thrust=setting.thrust, accuracy=accuracy, setting=setting)
