"""The deformed bodies, coloured by a field, with their contact lines."""

import math

import figure
import numpy as np
from drawn_cells import areas_at_nodes, at_points, inside, joined, nearest, outlines, percentiles, polylines, shaded_triangles, size_of, touches
from drawn_forces import colour_bar, draw_arrows, forces_at_work, label_places
from matplotlib.collections import LineCollection
from result_tables import arc_length_on, sides_of
from shapes import CORNERS

FIELDS = {
    "von_mises": "von Mises stress (scene's units)",
    "sigma_n": "stress across the contact line",
    "error": "energy of the estimated error by area, $\\log_{10}$",
}
CONTACT = "contact"  # --zoom without a box
OVERLAP = 0.002  # of the diagonal of what is shown: as wide as a line
SLENDER = 3  # times as tall as wide: turned
MANY_PAIRS = 6  # more are not drawn one by one
MANY_EDGES = 2000  # more would make an .svg of megabytes: each has half a kilobyte
CLOSED = "#e8452c"  # where contact carries pressure
PAIR_COLOURS = ["#111111", "#c2188b", "#1a7f37", "#7a4fd0", "#a65d00", "#00798c"]


def round_scale(value):
    """The nearest of ..., 1, 2, 5, 10, 20, ... below."""
    power = 10 ** math.floor(math.log10(value))
    return max(step for step in (1, 2, 5) if step * power <= value * (1 + 1e-9)) * power


def choose_scale(points, displacements):
    largest = float(np.linalg.norm(displacements, axis=1).max())
    return round_scale(0.04 * size_of(points) / largest) if largest > 0 else 1.0


def scale_without_overlap(table, size):
    """The largest magnification at which no gap is drawn as an overlap of more than OVERLAP of the size: a gap is the
    undeformed one and, so many times, what the displacements add to it."""
    largest = math.inf
    for k in np.unique(table["pair"]):
        first, other = sides_of(table, k)
        known = first & np.isfinite(table["gap"])
        if known.sum() < 2 or other.sum() < 2:
            continue
        along, across = (np.stack([table["x"][rows], table["y"][rows]], axis=1) for rows in (other, known))
        s = np.arange(other.sum(), dtype=float)
        added = np.interp(arc_length_on(along, s, across), s, table["u_n"][other]) - table["u_n"][known]
        undeformed, closing = np.maximum(table["gap"][known] - added, 0), added < 0
        if closing.any():
            largest = min(largest, ((undeformed + OVERLAP * size)[closing] / -added[closing]).min())
    return max(largest, 1.0)


def loaded_box(mesh, table):
    """Lower and upper corner of a box round where contact carries pressure, with half as much again."""
    on = table["p"] > 1e-6 * np.nanmax(np.abs(table["p"]))
    if not on.any():
        raise SystemExit("picture.py: --zoom: no contact carries pressure")
    at = np.stack([table["x"], table["y"]], axis=1)[on]
    half = max(0.75 * np.ptp(at, axis=0).max(), 1e-3 * size_of(mesh.points[:, :2]))
    middle = (at.min(axis=0) + at.max(axis=0)) / 2
    points, beside = mesh.points[:, :2], 0.02 * size_of(mesh.points[:, :2])  # no more of the page than the bodies fill
    return np.array([np.maximum(middle - half, points.min(axis=0) - beside), np.minimum(middle + half, points.max(axis=0) + beside)])


def shown_box(mesh, table, zoom):
    """Lower and upper corner of what is shown: of all bodies, of the loaded contact or as told."""
    points = mesh.points[:, :2]
    if not zoom:
        return np.array([points.min(axis=0), points.max(axis=0)])
    return loaded_box(mesh, table) if zoom == CONTACT else np.array(zoom).reshape(2, 2).T


def field_of(mesh, curve, field):
    """The values of a field of FIELDS at the points of the mesh; `curve` is contact.vtu."""
    if field == "von_mises":
        return mesh.point_data["von_mises"].ravel()
    if field == "error":
        if "error_density" not in mesh.cell_data:
            raise SystemExit("picture.py: --field error: the run estimated none; solve without --no-estimate")
        blocks = [value for block, value in zip(mesh.cells, mesh.cell_data["error_density"]) if block.type in CORNERS]
        density = at_points(mesh, blocks)
        if not (density > 0).any():
            raise SystemExit("picture.py: --field error: the estimated error is nought")
        return np.log10(np.maximum(density, 1e-6 * density.max()))
    if curve is None:
        raise SystemExit("picture.py: --field sigma_n: the scene has no contact pair")
    known = np.isfinite(curve.point_data["normal"][:, :2]).all(axis=1)
    normal = curve.point_data["normal"][known][nearest(mesh.points[:, :2], curve.points[known, :2]), :2]
    s = mesh.point_data["stress"]
    return normal[:, 0] ** 2 * s[:, 0] + normal[:, 1] ** 2 * s[:, 1] + 2 * normal[:, 0] * normal[:, 1] * s[:, 3]


def stress_range(stress, areas):
    """Without the singular corners. A uniform stress gets a range around it."""
    low, high = percentiles(stress, areas, [0.5, 99.5])
    if high - low < figure.STEADY * abs(high):
        return 0.0, 1.25 * high or 1.0
    return low, high


def draw_contact_lines(axes, curve, scale, pairs):
    """Both curves of each pair, in its colour."""
    at = curve.points[:, :2] + scale * curve.point_data["displacement"][:, :2]
    lines = [(*row[:2], row[2] if len(row) > 2 else -1) for block in curve.cells for row in block.data]
    colour_of = lambda line: PAIR_COLOURS[int(curve.point_data["pair"][line[0]])]
    colours = {"black": lines}
    if 1 < pairs <= MANY_PAIRS:
        colours = {colour: [line for line in lines if colour_of(line) == colour] for colour in PAIR_COLOURS[:pairs]}
    dots = {"rasterized": len(lines) > MANY_EDGES}
    axes.add_collection(LineCollection(joined(polylines(at, lines)), colors="white", linewidths=2.6, **dots))
    for colour, some in colours.items():
        axes.add_collection(LineCollection(joined(polylines(at, some)), colors=colour, linewidths=1.3, **dots))
    p = np.nan_to_num(curve.point_data["p"].ravel())
    solid = p - np.ravel(curve.point_data.get("p_fluid", np.zeros_like(p)))  # what is not the fluid's
    closed = [line for line in lines if min(solid[line[0]], solid[line[1]]) > 1e-6 * p.max()]
    axes.add_collection(LineCollection(joined(polylines(at, closed)), colors=CLOSED, linewidths=2.2, **dots))


def turn(mesh, curve, table):
    """Exchanges both coordinates, so that a tall scene fills the width of a page."""
    for part in filter(None, (mesh, curve)):
        part.points[:, :2] = part.points[:, 1::-1]
        for name in part.point_data.keys() & {"displacement", "normal", "stress"}:
            part.point_data[name][:, :2] = part.point_data[name][:, 1::-1]
    table |= {name: table[other] for name, other in (("x", "y"), ("y", "x")) if table}


def refuse_box(points, box, turned):
    """Ends the program where nothing of the bodies, magnified as they are, is in a box."""
    words = lambda numbers: ",".join(f"{number:.4g}" for number in (numbers[2:] + numbers[:2] if turned else numbers))
    there = np.stack([points.min(axis=0), points.max(axis=0)], axis=1).ravel().tolist()
    raise SystemExit(f"picture.py: --zoom {words(box)}: no body is there; expected a box within {words(there)}, or another --scale")


def draw_bodies(axes, mesh, curve, summary, table, options, turned):
    """The deformed bodies; returns the magnification and, in words, why it is no larger. `curve`: contact.vtu, if any."""
    points, u = mesh.points[:, :2], mesh.point_data["displacement"][:, :2]
    if not np.isfinite(u).all():
        raise SystemExit("picture.py: the displacements are not finite (see the summary's warnings): nothing to draw")
    box = shown_box(mesh, table, options.zoom)
    seen = inside(points, box)
    seen = seen if seen.any() else np.full(len(points), True)
    scale, why = options.scale, ""
    if scale is None:
        wanted = scale = choose_scale(box, u[seen])
        if summary["contact"] and scale_without_overlap(table, size_of(box)) < scale:
            scale = round_scale(scale_without_overlap(table, size_of(box)))
        why = " (more would draw bodies over each other)" if scale < wanted else ""
    moved, values = points + scale * u, field_of(mesh, curve, options.field)
    low, high = stress_range(values[seen], areas_at_nodes(mesh)[seen])
    xy, colours, triangles = shaded_triangles(mesh, moved, values)
    if options.zoom not in (None, CONTACT) and not touches(xy[triangles], box):
        refuse_box(xy, options.zoom, turned)
    shading = axes.tripcolor(*xy.T, triangles, colours, shading="gouraud", cmap="viridis", vmin=low, vmax=high, rasterized=True)
    edges = outlines(mesh)
    dots = {"rasterized": len(edges) > MANY_EDGES}
    axes.add_collection(LineCollection(joined(polylines(points, edges)), colors="0.6", linewidths=0.6, linestyles=(0, (5, 4)), **dots))
    axes.add_collection(LineCollection(joined(polylines(moved, edges)), colors="black", linewidths=0.8, **dots))
    if summary["contact"]:
        draw_contact_lines(axes, curve, scale, len(summary["contact"]))
    if options.zoom:
        shift = scale * u[seen].mean(axis=0) if options.zoom == CONTACT else np.zeros(2)
        axes.set_xlim(*(box[:, 0] + shift[0]))
        axes.set_ylim(*(box[:, 1] + shift[1]))
    else:
        draw_arrows(axes, points, summary["model"], forces_at_work(summary["contact"]), turned)
        axes.autoscale_view()
        axes.margins(0.03)
    axes.set_aspect("equal")
    label_places(axes, turned)
    extend = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}
    far = 1e-9 * max(abs(low), abs(high))
    clipped = (int(values[seen].min() < low - far), int(values[seen].max() > high + far))
    colour_bar(axes, shading, FIELDS[options.field], turned, extend[clipped])
    return scale, why
