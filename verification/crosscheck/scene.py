"""The physics of a scene, read from its file and not from mortise, and the case file that FreeFEM reads."""

import tomllib

from cases import StudyError

POINTS = "contact_points.txt"  # beside the case file, where the gap is that of the curves
ORDER_OF_MULTIPLIERS = {"linear": 1, "quadratic": 2}


def read_scene(path):
    """The scene's tables; scenes with other than one contact pair are refused."""
    scene = tomllib.loads(path.read_text())
    if len(scene.get("contact", [])) != 1:
        raise StudyError(f"{path}: {len(scene.get('contact', []))} contact pairs; the FreeFEM scripts take exactly 1")
    return scene


def size_parameters(scene, sizes):
    """Values of the first two mesh parameters, in the order of the scene file."""
    return dict(zip(scene["mesh"]["parameters"], sizes))


def opposite_side(scene, side):
    between = scene["contact"][0]["between"]
    if side not in between:
        raise StudyError(f"multipliers on '{side}'; the scene's contact is between {' and '.join(between)}")
    return between[1] if side == between[0] else between[0]


def strain_of(entry, material):
    """Initial strain 11, 22, 33, 12."""
    if "temperature_change" in entry:
        strain = material["thermal_expansion"] * entry["temperature_change"]
        return [strain, strain, strain, 0.0]
    return [entry["strain"].get(key, 0.0) for key in ("xx", "yy", "zz", "xy")]


def material_of(scene, body):
    return scene["materials"][scene["bodies"][body]]


def boundary_lines(scene, tags):
    """Prescribed displacements and loads, one line of the case file each."""
    for entry in scene.get("boundary", []):
        curves = [entry["on"]] if isinstance(entry["on"], str) else entry["on"]
        for label in (tags[curve] for curve in curves):
            for component, value in entry.get("displacement", {}).items():
                yield f"displacement {label} {component} {float(value)!r}"
            if "pressure" in entry:
                yield f"pressure {label} {float(entry['pressure'])!r}"
            if "traction" in entry:
                yield "traction {} {!r} {!r}".format(label, *map(float, entry["traction"]))


def body_lines(scene, bodies):
    """Initial strains and body forces; a body's index is its place in `bodies`."""
    for entry in scene.get("initial_strain", []):
        strain = " ".join(repr(float(e)) for e in strain_of(entry, material_of(scene, entry["body"])))
        yield f"initial_strain {bodies.index(entry['body'])} {strain}"
    for entry in scene.get("body_force", []):
        yield "body_force {} {!r} {!r}".format(bodies.index(entry["body"]), *map(float, entry["force"]))


def gap_lines(gap):
    """FreeFEM has the gap and the normals of curves from a file of points."""
    return ["gap given", f"points {POINTS}"] if gap == "curve" else [f"gap {gap}"]


def case_text(scene, bodies, files, contact_tags, tags, freefem, gap):
    """The case file; `bodies`, `files` and `contact_tags`: first of the multiplier side, then of the opposite side."""
    materials = [material_of(scene, body) for body in bodies]
    lines = [
        f"plane {scene.get('model', {}).get('plane', 'strain')}",
        *(f"body {file} {float(m['young'])!r} {float(m['poisson'])!r}" for file, m in zip(files, materials)),
        "contact {} {}".format(*contact_tags),
        f"order {freefem['order']}",
        f"multipliers {ORDER_OF_MULTIPLIERS[freefem['multipliers']]}",
        *(f"{key} {freefem[key]}" for key in ("integration", "gauss")),
        *gap_lines(gap),
        *boundary_lines(scene, tags),
        *body_lines(scene, bodies),
        "end",
    ]
    return "\n".join(lines) + "\n"
