"""Random scenes that are right: plates on one another with documented settings, each with a tiny mesh of its own."""

import math
from dataclasses import dataclass

import plates


@dataclass
class Setting:
    """A scene as dictionaries, its mesh, and the contact force that equilibrium asks for (None where it does not)."""

    scene: dict
    mesh: plates.Mesh
    thrust: float | None = None  # F2 of every pair on the body above, per unit of thickness


def contact_line(random, length):
    """A line of one of four shapes, as a function of x; nearly flat, as parts in contact are."""
    shape = random.choice(("flat", "flat", "inclined", "parabola", "sine"))
    height = length * random.uniform(-0.15, 0.15)
    return {
        "flat": flat,
        "inclined": lambda x: height * x / length,
        "parabola": lambda x: 4 * height * x * (length - x) / length**2,
        "sine": lambda x: height / 4 * math.sin(2 * math.pi * x / length),
    }[shape]


def flat(_):
    return 0.0


def make_plates(random, length):
    """One to three plates, from below; each line of contact is one line, or a gap or an overlap of 1e-3 apart. The gap
    and the width of the uppermost too, and which of the lines are straight."""
    count = random.choice((1, 2, 2, 2, 2, 2, 2, 3))
    names = ("lower", "upper", "third")[:count]
    lines = [flat] + [contact_line(random, length) for _ in names[1:]] + [flat]
    gap = length * random.choice((0, 0, 0, 1e-3, -1e-3, 1e-5)) if count > 1 else 0
    narrow = count > 1 and random.random() < 0.15  # a punch
    cell = random.choice(plates.CELL_TYPES)
    mixed, straight = random.random() < 0.2, random.random() < 0.2
    made, floor = [], 0.0
    for k, name in enumerate(names):
        thickness = length * random.uniform(0.3, 0.8)
        below = lambda x, line=lines[k], height=floor + (gap if k else 0): line(x) + height
        above = lambda x, line=lines[k + 1], height=floor + thickness: line(x) + height
        left, right = (0.2 * length, 0.8 * length) if narrow and k == count - 1 else (0.0, length)
        kind = random.choice(plates.CELL_TYPES) if mixed else cell
        columns, rows = plates.even(random.randint(1, 6)), random.randint(1, 3)
        made.append(plates.Body(name, columns, rows, plates.between(left, right, below, above), kind, straight))
        floor += thickness
    return made, gap, right - left, [line is flat for line in lines[1:-1]]


def materials(random, young, heated):
    """One or two materials; with a thermal expansion where a temperature needs it."""
    made = {}
    for name in random.choice((("steel",), ("steel", "rubber"))):
        factor = 1.0 if name == "steel" else 10 ** random.uniform(-2, 2)
        made[name] = {"young": young * factor, "poisson": random.choice((0.0, 0.2, 0.3, 0.45, -0.2))}
        if heated:
            made[name]["thermal_expansion"] = 1.2e-5
    return made


def boundary(random, made, load):
    """Supports of every plate against moving sideways, of the lowest also down; the load on top."""
    entries = [{"on": "lower_bottom", "displacement": {"y": 0}}]
    sides = random.choice(("left", "right", "both", "tops"))
    along = random.choice(("x", "x", "x", "normal")) if sides != "tops" else "x"
    for plate in made:
        curves = [f"{plate.name}_{side}" for side in (("left", "right") if sides == "both" else (sides,))]
        if sides == "tops":
            curves = ["lower_bottom" if plate is made[0] else f"{plate.name}_top"]
            if plate is not made[0] and plate is not made[-1]:
                curves = [f"{plate.name}_left"]
        entries.append({"on": curves if len(curves) > 1 else curves[0], "displacement": {along: 0}})
    entries.append({"on": f"{made[-1].name}_top", **load})
    return entries


def top_load(random, young, length, width):
    """A load on the uppermost edge and how much it presses: a pressure, a traction, a force on a rigid edge, or a
    displacement downwards."""
    strain = 10 ** random.uniform(-6, -3)
    kind = random.choice(("pressure", "pressure", "pressure", "traction", "traction", "displacement", "displacement",
                          "rigid"))  # fmt: skip
    if kind == "rigid":
        return {"rigid": {"x": 0, "rotation": 0, "force": [0.0, -young * strain * width]}}, young * strain
    if kind == "displacement":
        return {"displacement": {"y": -strain * length}}, None
    return {kind: young * strain if kind == "pressure" else [0.0, -young * strain]}, young * strain


def method(random, pairs, bodies):
    """Settings of the method; about half of them the mortar method with a direct solver."""
    chosen = {"kind": random.choice(("mortar", "mortar", "ddm"))}
    if random.random() < 0.5:
        chosen["multipliers"] = random.choice(("linear", "quadratic", "dual"))
    if random.random() < 0.2:
        chosen["integration"] = random.choice(("segments", "elements"))
    if chosen["kind"] == "ddm":
        iteration(random, chosen, bodies)
    elif pairs and random.random() < 0.3:
        chosen |= {"solver": "mssor", "acceleration": random.choice(("none", "krylov", "minres"))}
        if random.random() < 0.5:
            chosen |= {"omega": random.uniform(0.3, 1.8), "tau": 10 ** random.uniform(-1.5, 0.3)}
    if random.random() < 0.3 and (chosen["kind"] == "ddm" or "solver" in chosen):
        chosen |= {"tolerance": 10 ** random.uniform(-11, -4), "max_iterations": random.choice((1, 10, 300, 300))}
    return chosen


def iteration(random, chosen, bodies):
    """Settings of domain decomposition."""
    chosen["scheme"] = random.choice(("neumann_dirichlet", "neumann_neumann", "dirichlet_dirichlet"))
    if random.random() < 0.3 and chosen["scheme"] == "neumann_dirichlet":
        chosen["dirichlet"] = random.choice(bodies)
    if random.random() < 0.6:
        chosen["acceleration"] = random.choice(("none", "aitken", "anderson", "krylov"))
    if random.random() < 0.3:
        chosen["beta"] = random.choice(("auto", 0.1, 0.5, 1))


def contacts(random, made, gap, level):
    for below, above, is_level in zip(made, made[1:], level):
        curves = [f"{above.name}_bottom", f"{below.name}_top"]
        random.shuffle(curves)
        entry = {"between": curves}
        if random.random() < 0.6:
            entry["condition"] = random.choice(("unilateral", "bilateral") * 4 + ("tied",))
        tied = entry.get("condition") == "tied"
        if tied and is_level and random.random() < 0.5:
            entry["overlap"] = random.choice((-1e-5, 1e-5, 1e-3))
        if random.random() < 0.5 and not tied:
            known = ["measured", "curve", random.choice((-1e-5, 1e-5, 1e-3))]
            if not gap or random.random() < 0.1:
                known.append("closed")
            entry["initial_gap"] = random.choice(known)
        if random.random() < 0.5:
            entry["multipliers_on"] = random.choice(curves)
        yield entry


def valid_setting(random):
    """A random scene; whether contact opens, an iteration converges or a check fails is mortise's to say."""
    length, young = random.choice((1.0, 1.0, 1e-3, 1e3)), random.choice((1.0, 2.1e11, 7e4))
    made, gap, width, level = make_plates(random, length)
    names = [plate.name for plate in made]
    heated = random.random() < 0.15
    load, pressed = top_load(random, young, length, width)
    known = materials(random, young, heated)
    bodies = {name: random.choice(list(known)) for name in names}
    scene = {
        "title": random.choice(("plates", "", "Größe: 3 µm ½")),
        "mesh": {"file": "mesh.msh"},
        "model": {"plane": random.choice(("strain", "stress"))},
        "materials": {name: known[name] for name in known if name in bodies.values()},
        "bodies": bodies,
        "boundary": boundary(random, made, load),
        "contact": list(contacts(random, made, gap, level)),
        "method": method(random, len(made) - 1, names),
    }
    if heated:
        scene["initial_strain"] = [{"body": random.choice(names), "temperature_change": random.uniform(-100, 100)}]
    if random.random() < 0.1:
        scene["body_force"] = [{"body": names[0], "force": [0.0, -1e-4 * young / length]}]
    if random.random() < 0.1:
        scene["boundary"][0] = {"on": "lower_bottom", "foundation": young / length * 10 ** random.uniform(-1, 2)}
    if random.random() < 0.1:
        scene["model"]["gravity"] = [0.0, -9.81]
        for material in scene["materials"].values():
            material["density"] = 1e-6 * young / length
        pressed = None
    # Only where nothing but contact holds the bodies above the lowest up: then each pair carries the whole load.
    thrust = pressed * width if pressed and scene["contact"] else None
    return Setting({k: v for k, v in scene.items() if v != []}, plates.mesh_of(made), thrust)
