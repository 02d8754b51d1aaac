"""Views of gmsh: results of a run in its window, for `mortise window` and for a gmsh that is open already."""

import sys
from pathlib import Path

import gmsh
import meshio
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.with_name("pictures")))

import result_tables
from drawn_bodies import choose_scale, scale_without_overlap
from drawn_cells import outlines, polylines, shaded_triangles, size_of
from drawn_pressure import loaded_part


def clear():
    for tag in gmsh.view.getTags():
        gmsh.view.remove(tag)


def add_view(name, kind, data, **options):
    """A view of data, a row each, as gmsh lists them: coordinates, then values."""
    view = gmsh.view.add(name)
    gmsh.view.addListData(view, kind, len(data), np.ravel(data))
    for option, value in options.items():
        gmsh.option.setNumber(f"View[{gmsh.view.getIndex(view)}].{option}", value)


def add_lines(name, lines, values, **more):
    """Straight lines n x 2 x 2 in colours by values between 0 (blue) and 1 (red)."""
    lines = np.reshape(lines, (-1, 2, 2))
    above = np.full((len(lines), 2), 1e-3 * np.abs(lines).max())  # the bodies
    values = np.broadcast_to(np.reshape(values, (-1, 1)), (len(lines), 2))
    options = {"ShowScale": 0, "RangeType": 2, "CustomMin": 0, "CustomMax": 1, "LineWidth": 2, "IntervalsType": 2}
    add_view(name, "SL", np.hstack([lines[:, :, 0], lines[:, :, 1], above, values]), **options | {"Light": 0} | more)


def look_at(scale, down, curves):
    """Makes room for the graph: a smaller drawing, moved down by a length; with the undeformed curves or without."""
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
    x, y = np.moveaxis(at[triangles], 2, 0)
    title = f"von Mises stress (displacements x {scale:.3g})"
    add_view(title, "ST", np.hstack([x, y, 0 * x, values[triangles]]), IntervalsType=2, Light=0)
    sides = [line[k : k + 2] for line in polylines(points + scale * u, outlines(mesh)) for k in range(6)]
    add_lines("outlines", sides, 0.0, ColormapNumber=0, LineWidth=1)
    show_contact(meshio.read(folder / "contact.vtu"), scale)
    show_pressure(table, pair)
    look_at(0.72, 0.17 * size_of(points), False)


def show_contact(curves, scale):
    """The multiplier sides, moved with the bodies: red where p > 0, blue where contact is open."""
    at, p = curves.points[:, :2] + scale * curves.point_data["displacement"][:, :2], np.ravel(curves.point_data["p"])
    p = p - np.ravel(curves.point_data.get("p_fluid", np.zeros_like(p)))
    lines = np.concatenate([block.data[:, :2] for block in curves.cells])
    lines = lines[np.isfinite(p[lines]).all(axis=1)]
    add_lines("contact: red closed, blue open", at[lines], p[lines].sum(axis=1) > 1e-9 * np.nanmax(p), LineWidth=5)


def show_pressure(table, pair, places=400):
    """A graph of p over s, where contact carries it and some more on either side, upon its bar as a band."""
    rows, s = result_tables.line_of(table, result_tables.sides_of(table, pair)[0])
    left, right = loaded_part(s, table["p"][rows])
    at = np.linspace(left, right, places)
    p, bar = (np.interp(at, s, np.nan_to_num(table[name][rows])) for name in ("p", "p_error"))
    width = gmsh.option.getNumber("General.GraphicsWidth") - gmsh.option.getNumber("General.MenuWidth") - 200
    place = {"Type": 2, "AutoPosition": 0, "PositionX": 110, "PositionY": 50, "Width": width, "Height": 170}
    scale = {"RangeType": 2, "CustomMin": min(0, (p - bar).min()), "CustomMax": 1.05 * max((p + bar).max(), 1e-300)}
    graph = place | scale | {"IntervalsType": 2, "PointSize": 1, "LineWidth": 2}
    band = np.stack([p - bar, p + bar, p + bar, p - bar], axis=1).reshape(-1, 4)[:, :2]
    band[1::2] = band[1::2, ::-1]  # up and down in turn
    for name, where, values, more in (
        ("bar of p", np.repeat(at, 2), band.ravel(), {"ColormapNumber": 9, "Axes": 0, "ShowScale": 0}),
        (f"p along {table['curve'][rows][0]} over s", at, p, {"ColormapNumber": 0, "Axes": 2}),
    ):
        add_view(name, "SP", np.column_stack([where, 0 * where, 0 * where, values]), **graph | more)
