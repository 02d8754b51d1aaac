"""What the window draws of a scene: curves in colours, signs of supports and loads, names."""

from fnmatch import fnmatchcase

import gmsh
import numpy as np

import geometry
import views
from drawn_cells import size_of
from setup import hatches, shafts

HELD, LOADED, UNUSED, TOLD = (11, 79, 156), (176, 0, 32), (140, 140, 140), (255, 140, 0)
PAIRS = [(26, 127, 55), (194, 24, 139), (122, 79, 208), (166, 93, 0), (0, 121, 140), (17, 17, 17)]
SUPPORTS = {"displacement", "rigid", "spring"}
ALONG = {"x": (1, 0), "y": (0, 1)}


def drawn_bodies():
    """The surfaces of each body of the open .geo: physical groups, or each its own where there are none."""
    groups = [group for _, group in gmsh.model.getPhysicalGroups(2)]
    named = {gmsh.model.getPhysicalName(2, k): gmsh.model.getEntitiesForPhysicalGroup(2, k).tolist() for k in groups}
    return named or {f"surface_{tag}": [tag] for _, tag in gmsh.model.getEntities(2)}


def drawn_curves(bodies):
    """The curves round the bodies by tag, their names parted by commas; those within a body are hidden."""
    curves = {}
    for body, surfaces in bodies.items():
        lines = {tag: points_of(tag) for _, tag in gmsh.model.getBoundary([(2, tag) for tag in surfaces])}
        area = sum((line[:-1, 0] * line[1:, 1] - line[1:, 0] * line[:-1, 1]).sum() for line in lines.values())
        for tag, line in lines.items():
            groups = gmsh.model.getPhysicalGroupsForEntity(1, abs(tag))
            name = ", ".join(gmsh.model.getPhysicalName(1, group) for group in groups) or f"curve_{abs(tag)}"
            curves[abs(tag)] = geometry.curve_through(name, [body], [line[:: 1 if area > 0 else -1]])
    gmsh.model.setVisibility([at for at in gmsh.model.getEntities(1) if at[1] not in curves], 0)
    return curves


def points_of(tag, pieces=12):
    """Of a curve, nine a piece at the places of geometry.polynomials; backwards if its tag is negative."""
    (low,), (high,) = gmsh.model.getParametrizationBounds(1, abs(tag))
    within = (1 - np.cos(np.pi * np.arange(9) / 8)) / 2
    at = low + (high - low) * (np.arange(pieces)[:, None] + within) / pieces
    return np.reshape(gmsh.model.getValue(1, abs(tag), at.ravel()), (-1, 3))[:: 1 if tag > 0 else -1, :2]


def on_curves(curves, patterns):
    """Tags of the curves that these names or patterns of the scene mean."""
    means = lambda name: any(fnmatchcase(name, pattern) for pattern in np.atleast_1d(patterns))
    return [tag for tag, curve in curves.items() if any(map(means, curve.name.split(", ")))]


def strokes_of(curve, entry, size):
    """Lines (start, end) of an entry of the scene on a curve: hatches of a support, arrows of a load."""
    if SUPPORTS & entry.keys():
        return hatches([curve.points], size, [ALONG[key] for key in entry.get("displacement", {}) if key in ALONG])
    force = next((entry[key] for key in ("traction", "force") if key in entry), None)
    pulls = isinstance(entry.get("pressure"), (int, float)) and entry["pressure"] < 0
    numbers = force and all(isinstance(part, (int, float)) for part in force)
    arrows = shafts([curve.points], size, force if numbers else None, pulls)
    step = arrows[:, 1] - arrows[:, 0]
    across = 0.13 * np.stack([-step[:, 1], step[:, 0]], axis=1)
    heads = [np.stack([arrows[:, 1], arrows[:, 1] - 0.3 * step + side * across], axis=1) for side in (1, -1)]
    return np.concatenate([arrows, *heads])


def add_words(name, words):
    """Texts (place, text, size); places with two coordinates are pixels of the window."""
    view = gmsh.view.add(name)
    for place, text, size in words:
        style = ["Font", "Helvetica", "FontSize", str(size)] + (["Align", "BottomCenter"] if len(place) == 3 else [])
        gmsh.view.addListDataString(view, list(map(float, place)), [text], style)
    gmsh.option.setNumber(f"View[{gmsh.view.getIndex(view)}].ShowScale", 0)


def show_setup(curves, bodies, scene, told=()):
    """Curves in the colours of what the scene does there, signs and names; `told`: curves that a message is about."""
    views.clear()
    size = size_of(np.concatenate([curve.points for curve in curves.values()]))
    colours, at, lines, values = {}, {}, [], []
    for k, pair in enumerate(scene.get("contact", [])):
        for side, place in zip(pair.get("between", []), (0.35, 0.65)):
            at |= dict.fromkeys(on_curves(curves, side), place)  # names of curves that lie on each other stand apart
            colours |= dict.fromkeys(on_curves(curves, side), PAIRS[k % len(PAIRS)])
    for entry in scene.get("boundary", []):
        for tag in on_curves(curves, entry.get("on", [])):
            colours[tag] = HELD if SUPPORTS & entry.keys() else LOADED
            lines.append(strokes_of(curves[tag], entry, size))
            values += [float(colours[tag] == LOADED)] * len(lines[-1])
    for tag in curves:
        gmsh.model.setColor([(1, tag)], *(TOLD if tag in told else colours.get(tag, UNUSED)))
    if lines:
        views.add_lines("supports and loads", np.concatenate(lines), values)
    middle = lambda tag: (*curves[tag].points[int(107 * at.get(tag, 0.5))], 0)
    words = [(middle(tag), curve.name, 13) for tag, curve in curves.items()]
    for body, surfaces in bodies.items():
        boxes = np.reshape([gmsh.model.getBoundingBox(2, tag) for tag in surfaces], (-1, 2, 3))
        words.append(((boxes[:, 0].min(axis=0) + boxes[:, 1].max(axis=0)) / 2, body, 15))
    add_words("names", words)
    views.look_at(1, 0, True)
