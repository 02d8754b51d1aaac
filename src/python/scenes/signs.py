"""What the window draws: curves in colours, signs of supports and loads, results."""

from fnmatch import fnmatchcase
from pathlib import Path

import geometry  # makes python/pictures known
import gmsh
import meshio
import numpy as np

import result_tables
from drawn_bodies import choose_scale, scale_without_overlap
from drawn_cells import outlines, polylines, shaded_triangles, size_of
from setup import places_along

HELD, LOADED, UNUSED, TOLD = (11, 79, 156), (176, 0, 32), (140, 140, 140), (255, 140, 0)
PAIRS = [(26, 127, 55), (194, 24, 139), (122, 79, 208), (166, 93, 0), (0, 121, 140), (17, 17, 17)]
SUPPORTS = ("displacement", "rigid", "spring")
MANY_NAMES = 60  # of curves; more are not written
ALONG = {"x": (1, 0), "y": (0, 1)}


def drawn_curves():
    """{tag: geometry.Curve} of the open .geo, each with its body on the left; none within a body, which are hidden."""
    curves, bodies = {}, {}
    for _, surface in gmsh.model.getEntities(2):
        sides = gmsh.model.getBoundary([(2, surface)], combined=False, oriented=True)
        lines = {tag: places(abs(tag), tag < 0) for _, tag in sides}
        area = sum((line[:-1, 0] * line[1:, 1] - line[1:, 0] * line[:-1, 1]).sum() for line in lines.values())
        for tag, line in lines.items():
            length = float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum())
            names, body = names_of(1, abs(tag)), tuple(names_of(2, surface) or [f"surface_{surface}"])
            bodies.setdefault(abs(tag), []).append(body)
            curves[abs(tag)] = geometry.Curve(", ".join(names) or f"curve_{abs(tag)}", [surface], line[:: 1 if area > 0 else -1], length, not names)
    within = [tag for tag, of in bodies.items() if len(of) > len(set(of))]
    gmsh.model.setVisibility([(1, tag) for tag in within], 0)
    return {tag: curve for tag, curve in curves.items() if tag not in within}


def names_of(dim, tag):
    return [gmsh.model.getPhysicalName(dim, group) for group in gmsh.model.getPhysicalGroupsForEntity(dim, tag)]


def places(tag, backwards, count=97):
    (low,), (high,) = gmsh.model.getParametrizationBounds(1, tag)
    points = np.array(gmsh.model.getValue(1, tag, np.linspace(low, high, count))).reshape(-1, 3)[:, :2]
    return points[::-1] if backwards else points


def strokes_of(curve, entry, size):
    """Lines (start, end) of an entry of the scene on a curve: hatches of a support, arrows of a load."""
    if any(key in entry for key in SUPPORTS):
        at, n = places_along([curve.points], 0.025 * size)
        held = [ALONG[key] for key in (entry.get("displacement") or {}) if key in ALONG]
        if len(held) == 1:
            half = 0.009 * size * np.array(held)
            return np.stack([at + 0.014 * size * n - half, at + 0.014 * size * n + half], axis=1)
        return np.stack([at, at + 0.018 * size * (n + 0.8 * np.stack([-n[:, 1], n[:, 0]], axis=1))], axis=1)
    at, n = places_along([curve.points], 0.06 * size)
    along = next((entry[key] for key in ("traction", "force") if key in entry), None)
    pulls = isinstance(entry.get("pressure"), (int, float)) and entry["pressure"] < 0
    if along and all(isinstance(part, (int, float)) for part in along) and np.linalg.norm(along) > 0:
        step = np.tile(np.array(along) / np.linalg.norm(along), (len(at), 1))
    else:
        step = n if pulls else -n
    tip = np.where(((step * n).sum(axis=1) < 0)[:, None], at, at + 0.055 * size * step)
    tail, across = tip - 0.055 * size * step, np.stack([-step[:, 1], step[:, 0]], axis=1)
    heads = [np.stack([tip, tip - size * (0.016 * step + side * 0.007 * across)], axis=1) for side in (1, -1)]
    return np.concatenate([np.stack([tail, tip], axis=1), *heads])


def clear():
    for tag in gmsh.view.getTags():
        gmsh.view.remove(tag)


def options(view, **values):
    for name, value in values.items():
        (gmsh.option.setString if isinstance(value, str) else gmsh.option.setNumber)(f"View[{gmsh.view.getIndex(view)}].{name}", value)


def add_lines(name, lines, values, **more):
    """A view of straight lines n x 2 x 2 in colours by values between 0 (blue) and 1 (red)."""
    view = gmsh.view.add(name)
    lines = np.asarray(lines, dtype=float).reshape(-1, 2, 2)
    above = np.full((len(lines), 2), 1e-3 * np.abs(lines).max())  # the bodies
    data = np.column_stack([lines[:, :, 0], lines[:, :, 1], above, np.broadcast_to(values, len(lines)), np.broadcast_to(values, len(lines))])
    gmsh.view.addListData(view, "SL", len(lines), data.ravel())
    options(view, **{"ShowScale": 0, "RangeType": 2, "CustomMin": 0, "CustomMax": 1, "LineWidth": 2, "IntervalsType": 2, "Light": 0} | more)


def add_words(name, words):
    """A view of texts (place, text, size)."""
    view = gmsh.view.add(name)
    for place, text, size in words:
        style = ["Font", "Helvetica", "FontSize", str(size)] + (["Align", "BottomCenter"] if len(place) == 3 else [])
        gmsh.view.addListDataString(view, list(map(float, place)), [text], style)
    options(view, ShowScale=0)


def on_curves(curves, patterns):
    of = lambda curve: any(fnmatchcase(name, pattern) for name in curve.name.split(", ") for pattern in np.atleast_1d(patterns))
    return [tag for tag, curve in curves.items() if of(curve)]


def show_setup(curves, scene, told=()):
    """Curves in the colours of what the scene does there, signs and names; `told`: curves that a message is about."""
    clear()
    size = size_of(np.concatenate([curve.points for curve in curves.values()]))
    colours, lines, values, at = {}, [], [], {}
    for k, pair in enumerate(scene.get("contact", [])):
        for side, place in zip(pair.get("between", []), (0.35, 0.65)):
            at.update((tag, place) for tag in on_curves(curves, side))
            colours.update((tag, PAIRS[k % len(PAIRS)]) for tag in on_curves(curves, side))
    for entry in scene.get("boundary", []):
        held = any(key in entry for key in SUPPORTS)
        for tag in on_curves(curves, entry.get("on", [])):
            colours[tag] = HELD if held else LOADED
            lines.append(strokes_of(curves[tag], entry, size))
            values += [0.0 if held else 1.0] * len(lines[-1])
    for tag in curves:
        gmsh.model.setColor([(1, tag)], *(TOLD if tag in told else colours.get(tag, UNUSED)))
    if lines:
        add_lines("supports and loads", np.concatenate(lines), values)
    middle = lambda tag: (*curves[tag].points[int(at.get(tag, 0.5) * (len(curves[tag].points) - 1))], 0)
    longest = {curve.name: tag for tag, curve in sorted(curves.items(), key=lambda item: item[1].length)}
    bodies = {", ".join(names_of(2, tag)) or f"surface_{tag}": np.reshape(gmsh.model.getBoundingBox(2, tag), (2, 3)).mean(axis=0) for _, tag in gmsh.model.getEntities(2)}
    add_words("names", [(middle(tag), name, 13) for name, tag in longest.items() if len(longest) <= MANY_NAMES] + [(place, name, 15) for name, place in bodies.items()])
    look_at(1, 0, True)


def look_at(scale, down, curves):
    """Shrinks the drawing and moves it down, in lengths, to make room for the graph; with the undeformed curves or without."""
    for axis in "XYZ":
        gmsh.option.setNumber(f"General.Scale{axis}", scale)
    gmsh.option.setNumber("General.TranslationY", -down)
    gmsh.option.setNumber("Geometry.Curves", curves)


def show_results(folder, pair):
    """Von Mises stress on the bodies, displacements magnified; where contact is closed; p of a pair with its bar."""
    clear()
    table, mesh = result_tables.columns(folder / "contact.csv"), meshio.read(folder / "result.vtu")
    points, u = mesh.points[:, :2], mesh.point_data["displacement"][:, :2]
    scale = float(min(choose_scale(points, u), scale_without_overlap(table, size_of(points))))
    at, values, triangles = shaded_triangles(mesh, points + scale * u, np.ravel(mesh.point_data["von_mises"]))
    view = gmsh.view.add(f"von Mises stress (displacements x {scale:.3g})")
    corners = at[triangles]
    data = np.hstack([corners[:, :, 0], corners[:, :, 1], np.zeros(triangles.shape), values[triangles]])
    gmsh.view.addListData(view, "ST", len(triangles), data.ravel())
    options(view, IntervalsType=2, Light=0, SmoothNormals=0)
    add_lines("outlines", [line[k : k + 2] for line in polylines(points + scale * u, outlines(mesh)) for k in range(0, 6)], 0.0, ColormapNumber=0, LineWidth=1)
    show_contact(table, points, u, scale)
    show_pressure(table, pair)
    look_at(0.72, 0.17 * size_of(points), False)


def show_contact(table, points, u, scale):
    """The multiplier sides, moved with the bodies: red where p > 0, blue where contact is open."""
    lines, closed = [], []
    xy = np.stack([table["x"], table["y"]], axis=1)
    for pair in np.unique(table["pair"]):
        rows = np.flatnonzero(result_tables.sides_of(table, pair)[0])
        nearest = np.array([np.abs(points - at).sum(axis=1).argmin() for at in xy[rows]])
        moved = xy[rows] + scale * u[nearest]
        lines.append(np.stack([moved[:-1], moved[1:]], axis=1))
        closed.append((table["p"][rows][:-1] + table["p"][rows][1:] > 1e-9 * np.abs(table["p"]).max()).astype(float))
    add_lines("contact: red closed, blue open", np.concatenate(lines), np.concatenate(closed), LineWidth=5)


def show_pressure(table, pair, places=400):
    """A graph of p over s, where contact carries it and a fifth more on either side, upon its bar as a band."""
    rows = result_tables.sides_of(table, pair)[0]
    s, p = table["s"][rows], table["p"][rows]
    bar = np.nan_to_num(table["p_error"][rows]) if "p_error" in table else 0 * p
    loaded = s[p > 1e-6 * max(p.max(), 1e-300)]
    low, high = (loaded[0], loaded[-1]) if len(loaded) else (s[0], s[-1])
    at = np.linspace(max(s[0], low - 0.2 * (high - low)), min(s[-1], high + 0.2 * (high - low)), places)
    p, bar = np.interp(at, s, p), np.interp(at, s, bar)
    title = f"p along {table['curve'][rows][0]} over s"
    graph = {"Type": 2, "AutoPosition": 0, "PositionX": 110, "PositionY": 50, "Width": gmsh.option.getNumber("General.GraphicsWidth") - gmsh.option.getNumber("General.MenuWidth") - 200,
             "Height": 170, "RangeType": 2, "IntervalsType": 2,
             "CustomMin": min(0, (p - bar).min()), "CustomMax": 1.05 * max((p + bar).max(), 1e-300), "AxesFormatX": "%.3g", "AxesFormatY": "%.3g",
             "PointSize": 1}  # fmt: skip
    band = np.stack([np.where(np.arange(places) % 2, p - bar, p + bar), np.where(np.arange(places) % 2, p + bar, p - bar)], axis=1)
    for name, where, values, more in (("bar of p", np.repeat(at, 2), band.ravel(), {"ColormapNumber": 9, "LineWidth": 2, "Axes": 0, "ShowScale": 0}),
                                      (title, at, p, {"ColormapNumber": 0, "LineWidth": 2, "Axes": 2})):  # fmt: skip
        view = gmsh.view.add(name)
        gmsh.view.addListData(view, "SP", len(where), np.column_stack([where, 0 * where, 0 * where, values]).ravel())
        options(view, **graph, **more)
