#!/usr/bin/python3
"""One picture of a run: the deformed bodies with von Mises stress, loads and reactions, and the pressure along each
contact line; of many contact pairs the forces between the bodies instead.

Usage: picture.py RESULTS [PICTURE] [--zoom [X0,X1,Y0,Y1]] [--field FIELD] [--pair K] [--scale FACTOR] [--dpi DPI]
(mortise picture does the same)

RESULTS is the folder that `mortise solve` wrote; read are result.vtu, contact.vtu, summary.json
(docs/files.md) and contact.csv, or with 3-node triangles contact_centres.csv: p zigzags at their nodes. PICTURE is a
.png, .pdf or .svg, by default RESULTS.png beside the folder. --scale magnifies the
displacements; by default the largest is drawn as about 4 % of the size of what is shown, less where bodies whose gap
closes would be drawn over each other. --zoom shows the bodies where contact carries pressure, or in a box, without loads
and reactions; --pair K takes the Kth contact pair alone, from 0. --field: von_mises; sigma_n, the normal stress across
the direction of the nearest place of the contact line; error, where the energy of the estimated error lies. An arrow is the sum of a load, or the reaction of a curve of a
support, at the middle of what it acts on; of a clamp its moment about that is told too, and a rigid curve's force,
reaction and their moments at the point that they are about.
"""

import argparse
import json
import math
import sys
from pathlib import Path

try:
    import meshio
    import numpy as np
    from matplotlib.collections import LineCollection
    from matplotlib.patheffects import withStroke
except ImportError as missing:
    raise SystemExit(f"picture.py: {missing}: apt-get install python3-matplotlib python3-meshio") from missing

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import figure
import launch
from shapes import CORNERS, shape_functions, subdivision

FIELDS = {
    "von_mises": "von Mises stress (scene's units)",
    "sigma_n": "stress across the contact line",
    "error": "energy of the estimated error by area, $\\log_{10}$",
}
CONTACT = "contact"  # --zoom without a box
OVERLAP = 0.002  # of the diagonal of what is shown: as wide as a line
ROUND_OFF = 1e-9  # of a force: the program's checks of balance have 1e-10

MANY_PAIRS = 6  # more are not drawn one by one
COLOURS = ["#e8452c", "#4aa3e8"]  # multiplier side, opposite side
PAIR_COLOURS = ["#111111", "#c2188b", "#1a7f37", "#7a4fd0", "#a65d00", "#00798c"]
LOAD, REACTION = "#b00020", "#0b4f9c"


def shaded_triangles(mesh, points, values):
    """Points, values and triangles of all cells, fine enough for curved sides."""
    cells = [block for block in mesh.cells if block.type in CORNERS]
    total = sum(len(block.data) for block in cells)
    positions, colours, triangles, first = [], [], [], 0
    for block in cells:
        linear = block.type in ("triangle", "quad")
        n = 1 if block.type == "triangle" else int(np.clip(math.sqrt(40000 / total), 1 if linear else 2, 8))
        x, y, local = subdivision(block.type, n)
        N = shape_functions(block.type, x, y)
        positions.append(np.einsum("qa,eac->eqc", N, points[block.data]).reshape(-1, 2))
        colours.append(np.einsum("qa,ea->eq", N, values[block.data]).ravel())
        offsets = first + len(x) * np.arange(len(block.data))
        triangles.append((offsets[:, None, None] + local[None]).reshape(-1, 3))
        first += len(x) * len(block.data)
    return np.concatenate(positions), np.concatenate(colours), np.concatenate(triangles)


def outlines(mesh):
    """Sides that one cell has alone, a row of nodes each (start, end, and middle or start again)."""
    sides = {}
    for block in mesh.cells:
        corners = CORNERS.get(block.type, 0)
        for cell in block.data:
            for i in range(corners):
                start, end = cell[i], cell[(i + 1) % corners]
                middle = cell[corners + i] if len(cell) > corners else -1
                sides.setdefault((min(start, end), max(start, end)), []).append((start, end, middle))
    return [found[0] for found in sides.values() if len(found) == 1]


def polylines(points, edges):
    """Edges (start, end, middle; middle < 0 if straight) as lists of points."""
    xi = np.linspace(-1, 1, 7)[:, None]
    lines = []
    for start, end, middle in edges:
        a, b = points[start], points[end]
        c = points[middle] if middle >= 0 else (a + b) / 2
        lines.append(xi * (xi - 1) / 2 * a + xi * (xi + 1) / 2 * b + (1 - xi * xi) * c)
    return lines


def round_scale(value):
    """The nearest of ..., 1, 2, 5, 10, 20, ... below."""
    power = 10 ** math.floor(math.log10(value))
    return max(step for step in (1, 2, 5) if step * power <= value * (1 + 1e-9)) * power


def size_of(points):
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def choose_scale(points, displacements):
    largest = float(np.linalg.norm(displacements, axis=1).max())
    return round_scale(0.04 * size_of(points) / largest) if largest > 0 else 1.0


def percentiles(values, weights, at):
    """Values that these percents of the weight lie below: of a line or an area, however its nodes are spaced."""
    order = np.argsort(values)
    part = np.cumsum(weights[order]) - weights[order] / 2
    return np.interp(np.array(at) / 100, part / weights.sum(), values[order])


def cell_areas(mesh):
    """Blocks of cells with the areas of their cells, by their corners."""
    for block in mesh.cells:
        if block.type in CORNERS:
            x, y = np.moveaxis(mesh.points[block.data[:, : CORNERS[block.type]], :2], 2, 0)
            yield block, np.abs((x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum(axis=1) / 2)


def areas_at_nodes(mesh):
    """Of each node the area of the cells that meet there."""
    areas = np.zeros(len(mesh.points))
    for block, of_cells in cell_areas(mesh):
        np.add.at(areas, block.data, of_cells[:, None])
    return areas


def body_areas(mesh):
    numbers = [number for block, number in zip(mesh.cells, mesh.cell_data["body"]) if block.type in CORNERS]
    return np.bincount(np.concatenate(numbers).astype(int).ravel(), np.concatenate([areas for _, areas in cell_areas(mesh)]))


def inside(points, box):
    return ((points >= box[0]) & (points <= box[1])).all(axis=1)


def loaded_box(mesh, table):
    """Lower and upper corner of a box round where contact carries pressure, with half as much again."""
    on = table["p"] > 1e-6 * np.nanmax(np.abs(table["p"]))
    if not on.any():
        raise SystemExit("picture.py: --zoom: no contact carries pressure")
    at = np.stack([table["x"], table["y"]], axis=1)[on]
    half = max(0.75 * np.ptp(at, axis=0).max(), 1e-3 * size_of(mesh.points[:, :2]))
    middle = (at.min(axis=0) + at.max(axis=0)) / 2
    return np.array([middle - half, middle + half])


def shown_box(mesh, table, zoom):
    """Lower and upper corner of what is shown: of all bodies, of the loaded contact or as told."""
    points = mesh.points[:, :2]
    if not zoom:
        return np.array([points.min(axis=0), points.max(axis=0)])
    return loaded_box(mesh, table) if zoom == CONTACT else np.array(zoom).reshape(2, 2).T


def refuse_older(results, model):
    """Ends the program where summary.json does not say where forces act."""
    acting = [load for load in model.get("loads", []) if "sum" in load]
    acting += [curve for support in model.get("supports", []) for curve in support.get("curves", [{}])]
    if not all("centre" in entry for entry in acting):
        raise SystemExit(f"picture.py: {results}: of an older mortise, without the places of forces; solve it again")


def is_clamp(support):
    """Whether both displacements are prescribed along the whole curve: it bears a moment."""
    return {"x", "y"} <= support.get("displacement", {}).keys()


def rigid_forces(support):
    """As acting_forces, of rigid curves: one body, whose forces and moments are about one point."""
    rigid, reaction = support["rigid"], np.array(support["reaction"])
    about = np.array(rigid["about"])
    yield LOAD, np.array(rigid["force"]), about, rigid["moment"]
    yield REACTION, reaction, about, support["moment"] - (about[0] * reaction[1] - about[1] * reaction[0])


def acting_forces(model):
    """(colour, force, place, moment about it) of every load and of every curve of every support; moments of clamps and
    rigid curves only, 0 of others."""
    for load in model["loads"]:
        if "sum" in load:
            yield LOAD, np.array(load["sum"]), np.array(load["centre"]), 0
    for support in model["supports"]:
        if "rigid" in support:
            yield from rigid_forces(support)
            continue
        for curve in support["curves"]:
            moment = curve["moment_about_centre"] if is_clamp(support) else 0
            yield REACTION, np.array(curve["reaction"]), np.array(curve["centre"]), moment


def draw_arrows(axes, points, model, at_work):
    """Forces as arrows whose length goes with them, the shortest still to be seen: onto what they push, away from what
    they pull. None where all are round-off of the forces `at_work` in contact."""
    forces = list(acting_forces(model))
    largest = max((np.linalg.norm(force) for _, force, _, _ in forces), default=0)
    if largest <= ROUND_OFF * at_work:
        return
    shown = [f for f in forces if np.linalg.norm(f[1]) > 1e-6 * largest > 0]
    size, middle = size_of(points), (points.min(axis=0) + points.max(axis=0)) / 2
    for colour, force, place, moment in shown:
        norm = np.linalg.norm(force)
        step = size * (0.05 + 0.09 * norm / largest) * force / norm
        pushes = np.dot(middle - place, force) > 1e-3 * size * norm
        start, end = (place - step, place) if pushes else (place, place + step)
        style = {"arrowstyle": "-|>", "color": colour, "linewidth": 1.8, "mutation_scale": 11, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", xy=end, xytext=start, arrowprops=style, zorder=6)
        axes.update_datalim([start, end])
        if len(shown) <= 12:
            label = f"{norm:.3g}" + (f"\nmoment {moment:.3g}" if abs(moment) > 1e-3 * largest * size else "")
            free = start if pushes else end
            left = (free - place)[0] < -0.3 * np.linalg.norm(free - place)
            options = {"textcoords": "offset points", "ha": "right" if left else "left", "va": "bottom", "fontsize": 7}
            text = axes.annotate(label, free, (0 if left else 3, 2), color=colour, zorder=7, **options)
            text.set_path_effects([withStroke(linewidth=2, foreground="white")])


def draw_contact_lines(axes, curve, table, scale, pairs):
    """Both curves of each pair, in its colour."""
    at = curve.points[:, :2] + scale * curve.point_data["displacement"][:, :2]
    lines = [(*row[:2], row[2] if len(row) > 2 else -1) for block in curve.cells for row in block.data]
    colours = ["black"] * len(lines)
    if 1 < pairs <= MANY_PAIRS:  # points stand in the order of contact.csv
        colours = [PAIR_COLOURS[int(table["pair"][line[0]])] for line in lines]
    axes.add_collection(LineCollection(polylines(at, lines), colors="white", linewidths=2.6))
    axes.add_collection(LineCollection(polylines(at, lines), colors=colours, linewidths=1.3))


def sides_of(table, pair):
    """Which rows of contact.csv are the multiplier side of a pair, which stands first there, and which its opposite."""
    on = table["pair"] == pair
    first = on & (table["curve"] == table["curve"][on][0])
    return first, on & ~first


def nearest(points, places):
    """Index of the place nearest to each point."""
    parts = np.array_split(points, 1 + len(points) * len(places) // 10**7)
    square = (places**2).sum(axis=1)
    return np.concatenate([(square - 2 * part @ places.T).argmin(axis=1) for part in parts])


def at_points(mesh, values):
    """Of values of the cells, the mean at each point, by area."""
    total = np.zeros(len(mesh.points))
    for (block, areas), value in zip(cell_areas(mesh), values):
        np.add.at(total, block.data, (areas * np.ravel(value))[:, None])
    return total / areas_at_nodes(mesh)


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


def stress_range(stress, areas):
    """Without the singular corners. A uniform stress gets a range around it."""
    low, high = percentiles(stress, areas, [0.5, 99.5])
    if high - low < 1e-3 * abs(high):
        return 0.0, 1.25 * high or 1.0
    return low, high


def forces_at_work(pairs):
    """The size of what contact carries, also where its sum vanishes, as round a shaft."""
    return max((pair["pressure"]["max"] * pair["length_in_contact"] for pair in pairs), default=0)


def draw_bodies(axes, results, summary, table, options):
    """The deformed bodies; returns the magnification and, in words, why it is no larger."""
    mesh = meshio.read(results / "result.vtu")
    curve = meshio.read(results / "contact.vtu") if summary["contact"] else None
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
    shading = axes.tripcolor(*xy.T, triangles, colours, shading="gouraud", cmap="viridis", vmin=low, vmax=high)
    edges = outlines(mesh)
    axes.add_collection(LineCollection(polylines(points, edges), colors="0.6", linewidths=0.6, linestyles=(0, (5, 4))))
    axes.add_collection(LineCollection(polylines(moved, edges), colors="black", linewidths=0.8))
    if summary["contact"]:
        draw_contact_lines(axes, curve, table, scale, len(summary["contact"]))
    if options.zoom:
        shift = scale * u[seen].mean(axis=0) if options.zoom == CONTACT else np.zeros(2)
        axes.set_xlim(*(box[:, 0] + shift[0]))
        axes.set_ylim(*(box[:, 1] + shift[1]))
    else:
        draw_arrows(axes, points, summary["model"], forces_at_work(summary["contact"]))
        axes.autoscale_view()
        axes.margins(0.03)
    axes.set_aspect("equal")
    extend = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}
    far = 1e-9 * max(abs(low), abs(high))
    clipped = (int(values[seen].min() < low - far), int(values[seen].max() > high + far))
    bar = axes.figure.colorbar(shading, ax=axes, extend=extend[clipped], pad=0.02, aspect=25)
    bar.set_label(FIELDS[options.field])
    figure.scientific(bar.ax.yaxis)
    axes.set(xlabel="$x_1$", ylabel="$x_2$")
    return scale, why


def arc_length_on(along, s, points):
    """Arc length at the place of the polyline `along` nearest to each point."""
    start, step = along[:-1], np.diff(along, axis=0)
    from_start = points[:, None, :] - start[None]
    t = np.clip((from_start * step).sum(axis=2) / (step**2).sum(axis=1), 0, 1)
    distance = np.linalg.norm(from_start - t[..., None] * step, axis=2)
    nearest, row = distance.argmin(axis=1), np.arange(len(points))
    return s[nearest] + t[row, nearest] * np.diff(s)[nearest]


def loaded_part(s, p):
    """Limits of x: where p acts and a fifth as much again, or all of the line where it acts on most of it."""
    loaded = s[p > 1e-9 * np.abs(p).max()]
    if len(loaded) == 0 or np.ptp(loaded) > 0.8 * np.ptp(s):
        return s.min(), s.max()
    margin = max(np.ptp(loaded), 1e-6 * np.ptp(s)) / 10
    return max(s.min(), loaded.min() - margin), min(s.max(), loaded.max() + margin)


def pressure_range(curves):
    """Limits of y that show nearly all of the curves (places, values): what is at singular corners may leave the panel."""
    lengths = np.concatenate([np.abs(np.gradient(s)) if len(s) > 1 else np.ones(len(s)) for s, _ in curves])
    values = np.concatenate([value for _, value in curves])
    kept = np.isfinite(values)
    values = values[kept]
    first, last = percentiles(values, lengths[kept], [2, 98])
    middle, half = (first + last) / 2, max((last - first) / 2, 0.02 * abs(first + last) / 2)
    low = min(max(middle - 1.6 * half, values.min() - 0.25 * half), middle - 1.1 * half)
    high = max(min(middle + 1.6 * half, values.max() + 0.25 * half), middle + 1.1 * half)
    if 0 < first < 0.3 * last:
        low = min(low, 0.0)
    return (low, high) if high > low else (low - 1, high + 1)


def has_limit(summary, pair):
    """Whether p is known to be bounded on the whole line: where the errors were estimated."""
    told = (summary.get("estimate") or {}).get("pressure")
    return told is not None and all(at["pair"] != pair or at["pressure_exponent"] >= 1 for at in told["singular"])


def draw_pair(axes, table, pair, bounded, label="$p$ (multipliers)", colour=PAIR_COLOURS[0]):
    """p along the contact line of a pair with its bar as a band, and -sigma_n of both bodies, over the arc length of the
    multiplier side. All of a bounded p is shown."""
    xy = np.stack([table["x"], table["y"]], axis=1)
    on, other = sides_of(table, pair)
    multiplier_side, opposite = (figure.short(table["curve"][rows][0]) for rows in (on, other))
    other &= np.isfinite(table.get("gap", table["s"]))
    s, p = table["s"][on], table["p"][on]
    s_other = arc_length_on(xy[on], s, xy[other])
    mine, theirs = -table["sigma_n"][on], -table["sigma_n"][other]
    if "p_error" in table:
        bar = table["p_error"][on]
        axes.fill_between(s, p - bar, p + bar, color="0.82", linewidth=0, label="bar of $p$", zorder=1)
    axes.plot(s, p, color=colour, linewidth=1.7, label=label, zorder=2)
    axes.plot(s, mine, color=COLOURS[0], linewidth=0.9, label=f"$-\\sigma_n$ of {multiplier_side}", zorder=3)
    label = f"$-\\sigma_n$ of {opposite}"
    axes.plot(s_other, theirs, color=COLOURS[1], linewidth=0.9, dashes=(5, 2), label=label, zorder=4)
    left, right = loaded_part(s, p)
    shown, shown_other = (s >= left) & (s <= right), (s_other >= left) & (s_other <= right)
    low, high = pressure_range([(s[shown], p[shown]), (s[shown], mine[shown]), (s_other[shown_other], theirs[shown_other])])
    if bounded:
        low, high = min(low, 1.05 * p.min()), max(high, 1.05 * p.max())
    axes.set_ylim(low, high)
    axes.set_xlim(left, right)
    everything = np.concatenate([p, mine, theirs])
    off = everything[(everything > high) | (everything < low)]
    label = f"arc length $s$ along {multiplier_side}"
    if len(off) > 0:
        farthest = off[np.argmax(np.abs(off - (low + high) / 2))]
        count = f"{len(off)} of {np.isfinite(everything).sum()}"
        label += f"    ({count} values off the scale, the farthest {farthest:.3g})"
    axes.set_xlabel(label)
    figure.scientific(axes.yaxis)
    axes.grid(color="0.9", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.set_ylabel("contact pressure")
    axes.legend(loc="upper center", ncol=4, frameon=False, fontsize=8, bbox_to_anchor=(0.5, 1.17))


def place_of_force(table, rows):
    """Where a pair's pressure acts on the whole: rows of one side, in the order of their arc length."""
    s, p = table["s"][rows], table["p"][rows]
    weights = np.maximum(p, 0) * np.abs(np.gradient(s)) if len(s) > 1 else np.ones(1)
    weights = weights if weights.sum() > 0 else np.ones(len(s))
    return np.average(np.stack([table["x"][rows], table["y"][rows]], axis=1), axis=0, weights=weights)


def draw_forces(axes, mesh, table, pairs):
    """A stroke a contact pair, where its force acts and along it, as wide and dark as it is large."""
    axes.add_collection(LineCollection(polylines(mesh.points[:, :2], outlines(mesh)), colors="0.75", linewidths=0.6))
    forces = np.array([pair["force"] for pair in pairs])
    sizes = np.linalg.norm(forces, axis=1)
    largest = sizes.max()
    acting = np.flatnonzero(sizes > 1e-3 * largest) if largest > 0 else []
    rows = {k: sides_of(table, k)[0] for k in acting}
    places = np.array([place_of_force(table, rows[k]) for k in acting]).reshape(-1, 2)
    reach = 0.35 * math.sqrt(np.median(body_areas(mesh)))
    along = reach * forces[acting] / sizes[acting, None] if len(acting) else places
    part = sizes[acting] / largest if len(acting) else sizes
    strokes = LineCollection(
        np.stack([places - along, places + along], axis=1),
        linewidths=0.5 + 4.5 * part,
        array=sizes[acting],
        cmap="magma_r",
        clim=(0, largest),
        capstyle="round",
    )
    axes.add_collection(strokes)
    axes.set(aspect="equal", xlabel="$x_1$", ylabel="$x_2$")
    axes.autoscale_view()
    axes.margins(0.03)
    bar = axes.figure.colorbar(strokes, ax=axes, pad=0.02, aspect=25)
    bar.set_label("contact force of a pair (scene's units)")
    figure.scientific(bar.ax.yaxis)
    axes.set_title(f"forces between bodies:\n{len(acting)} of {len(pairs)} pairs carry some", fontsize=9)


def is_given(gaps):
    """Whether a pair's gap is a length or an expression, or has a clearance, rather than what is drawn."""
    return any(gap not in ("curve", "measured", "closed") for gap in gaps)


def draw(results, picture, options):
    """One picture of the results: `options` as of the command line."""
    summary = json.loads((results / "summary.json").read_text())
    refuse_older(results, summary["model"])
    pairs = summary["contact"]
    shown = list(range(len(pairs)))
    if options.pair is not None:
        if not 0 <= options.pair < len(pairs):
            raise SystemExit(f"picture.py: --pair {options.pair}: the scene's pairs have the numbers 0 to {len(pairs) - 1}")
        shown = [options.pair]
    mesh = meshio.read(results / "result.vtu")
    table = launch.columns(results / "contact.csv") if pairs else {}
    if options.zoom == CONTACT and not pairs:
        raise SystemExit("picture.py: --zoom: the scene has no contact pair")
    of_shown = {name: column[np.isin(table["pair"], shown)] for name, column in table.items()}
    extent = np.ptp(shown_box(mesh, of_shown, options.zoom), axis=0)
    above = float(np.clip(6.6 * extent[1] / extent[0], 2.5, 6.5))
    below = 2.5
    many = len(shown) > MANY_PAIRS
    if many and extent[1] > 3 * extent[0]:  # a tall scene
        drawing, panels = figure.panels(1, 2, (8, above + 0.6), squeeze=False)
        panels = panels.T
    else:
        heights = [above] + ([above] if many else [below] * len(shown))
        drawing, panels = figure.panels(len(heights), 1, (8, sum(heights) + 0.6), height_ratios=heights, squeeze=False)
    used, why = draw_bodies(panels[0, 0], results, summary, table if options.pair is None else of_shown, options)
    given = " (a gap that is given, not drawn, is not to be seen)" if is_given(summary["method"]["initial_gap"]) else ""
    panels[0, 0].set_title(f"displacements \u00d7 {used:g}{why},\nundeformed outline dashed{given}", fontsize=9)
    title = figure.wrapped(summary["title"] or summary["scene"])
    if summary["status"] == "solved":
        drawing.suptitle(title, fontsize=11)
    else:
        drawing.suptitle(f"{title}\n{summary['status'].replace('_', ' ')}", fontsize=11, color=figure.RED)
    if pairs:
        zigzags = any(block.type == "triangle" for block in mesh.cells)
        if zigzags:
            table = launch.columns(results / "contact_centres.csv")
        label = ("$p$ (means over edges)",) if zigzags else ()
        if many:
            draw_forces(panels[1, 0], mesh, table, pairs)
            shown = []
        for panel, k in zip(panels[1:, 0], shown):
            colour = PAIR_COLOURS[k] if len(pairs) <= MANY_PAIRS else PAIR_COLOURS[0]
            draw_pair(panel, table, k, has_limit(summary, k), *label, colour=colour)
    figure.save(drawing, picture, options.dpi)


def box_of(text):
    """X0,X1,Y0,Y1 as numbers, or CONTACT."""
    if text == CONTACT:
        return text
    try:
        x0, x1, y0, y1 = (float(number) for number in text.split(","))
        if x0 < x1 and y0 < y1:
            return [x0, x1, y0, y1]
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"'{text}' is no box; expected X0,X1,Y0,Y1 with X0 < X1 and Y0 < Y1")


def with_box(arguments):
    """The arguments with "--zoom=X0,..." for "--zoom X0,...", as a box may begin with a minus, and "--zoom=contact" where
    none follows."""
    words = list(arguments)
    if "--zoom" in words:
        k = words.index("--zoom")
        box = [word for word in words[k + 1 : k + 2] if "," in word]
        words[k : k + 1 + len(box)] = [f"--zoom={box[0] if box else CONTACT}"]
    return words


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("results", type=Path, help="folder that mortise solve wrote")
    parser.add_argument("picture", type=Path, nargs="?", help=".png, .pdf or .svg (default: RESULTS.png)")
    zoom_help = "this box only; without numbers, where contact carries pressure"
    parser.add_argument("--zoom", type=box_of, metavar="[X0,X1,Y0,Y1]", help=zoom_help)
    parser.add_argument("--field", choices=FIELDS, default="von_mises", help="what colours the bodies (default: von_mises)")
    parser.add_argument("--pair", type=int, metavar="K", help="the Kth contact pair only, from 0")
    parser.add_argument("--scale", type=float, help="magnification of the displacements")
    parser.add_argument("--dpi", type=int, default=130)
    options = parser.parse_args(with_box(sys.argv[1:]))
    if not (options.results / "summary.json").is_file():
        parser.error(f"{options.results}: no summary.json there; expected the folder of a run of mortise solve")
    picture = options.picture or options.results.with_name(options.results.resolve().name + ".png")
    draw(options.results, picture, options)
    print(picture)


if __name__ == "__main__":
    main()
