"""Forces as arrows: loads and reactions at their places, and of many contact pairs a stroke each."""

import math

import figure
import numpy as np
from drawn_cells import body_areas, joined, outlines, polylines, size_of
from matplotlib.collections import LineCollection
from matplotlib.patheffects import withStroke
from result_tables import sides_of

ROUND_OFF = 1e-9  # of a force: the program's checks of balance have 1e-10
LOAD, REACTION = "#b00020", "#0b4f9c"


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


def forces_at_work(pairs):
    """The size of what contact carries, also where its sum vanishes, as round a shaft."""
    return max((pair["pressure"]["max"] * pair["length_in_contact"] for pair in pairs), default=0)


def label_places(axes, turned):
    """The coordinates' names; a turned picture is a rotated one, not a mirrored one."""
    axes.set(xlabel="$x_2$" if turned else "$x_1$", ylabel="$x_1$" if turned else "$x_2$")
    if turned:
        axes.invert_yaxis()


def colour_bar(axes, drawn, label, turned, extend="neither"):
    """Beside the panel, which stays in the middle of the page; of a turned scene's low one below it."""
    wide, high = np.ptp(axes.get_xlim()), np.ptp(axes.get_ylim())
    place = {"ax": axes, "location": "bottom", "aspect": 60} if turned else {"cax": axes.inset_axes([1.03, 0, high / wide / 25, 1])}
    bar = axes.figure.colorbar(drawn, extend=extend, **place)
    figure.scientific(bar.ax.xaxis if turned else bar.ax.yaxis, label)


def stroke(force, place, middle, size, largest):
    """Start and end of a force's arrow, onto what it pushes, away from what it pulls; of none its place twice."""
    norm = np.linalg.norm(force)
    if norm == 0:
        return place, place
    step = size * (0.05 + 0.09 * norm / largest) * force / norm
    return (place - step, place) if np.dot(middle - place, force) > 1e-3 * size * norm else (place, place + step)


def label_of(force, moment, counts):
    """What stands at an arrow: the force, and the moment about its place where it `counts`."""
    words = [f"{np.linalg.norm(force):.3g}"] * bool(np.any(force)) + [f"moment {moment:.3g}"] * bool(counts)
    return "\n".join(words)


def beside(label, start, end, place, point, turned):
    """Where a label begins, whether it goes on to the left, and the corner that it reaches, `point` being one of its units."""
    free = end if np.array_equal(start, place) else start
    left = (free - place)[0] < -0.3 * np.linalg.norm(free - place)
    long, high = 5.2 * max(map(len, label.split("\n"))) * point, 9 * (1 + label.count("\n")) * point
    return free, left, free + [-long if left else long, -high if turned else high]


def draw_arrows(axes, points, model, at_work, turned=False):
    """Forces as arrows whose length goes with them, the shortest still to be seen: onto what they push, away from what
    they pull; moments as words. None that are round-off of the forces `at_work` in contact. `turned`: the points are
    (drawn_bodies.turn)."""
    order = slice(None, None, -1 if turned else 1)
    forces = [(colour, force[order], place[order], moment) for colour, force, place, moment in acting_forces(model)]
    largest = max((np.linalg.norm(force) for _, force, _, _ in forces), default=0)
    size, middle = size_of(points) * (0.3 if turned else 1), (points.min(axis=0) + points.max(axis=0)) / 2
    least, turns = max(1e-6 * largest, ROUND_OFF * at_work), max((abs(moment) for *_, moment in forces), default=0)
    shown = []
    for colour, force, place, moment in forces:
        force = force if np.linalg.norm(force) > least else np.zeros(2)
        label = label_of(force, moment, abs(moment) > max(1e-3 * largest * size, 1e-6 * turns, ROUND_OFF * at_work * size))
        if label:
            shown.append((colour, label, place, *stroke(force, place, middle, size, largest)))
    drawn_on = axes.get_figure()
    width, height = drawn_on.bbox.size * 72 / drawn_on.dpi * 0.75  # of the panel, points, about
    labelled = len(shown) <= 12
    drawn = corners = np.array([*points[[0]], points.min(axis=0), points.max(axis=0), *(end for row in shown for end in row[3:])])
    for _ in range(3):  # the labels beside the ticks, not over them: what they reach makes the panel wider
        point = max(np.ptp(corners[:, 0]) / width, np.ptp(corners[:, 1]) / height)
        reach = [beside(label, start, end, place, point, turned) for _, label, place, start, end in shown if labelled]
        corners = np.array([*drawn, *(corner for *_, corner in reach)])
    axes.update_datalim(corners)
    for colour, _, _, start, end in shown:
        style = {"arrowstyle": "-|>", "color": colour, "linewidth": 1.8, "mutation_scale": 11, "shrinkA": 0, "shrinkB": 0}
        if not np.array_equal(start, end):
            axes.annotate("", xy=end, xytext=start, arrowprops=style, zorder=6)
    for (colour, label, *_), (free, left, _) in zip(shown, reach):
        options = {"textcoords": "offset points", "ha": "right" if left else "left", "va": "bottom", "fontsize": 7}
        text = axes.annotate(label, free, (0 if left else 3, 2), color=colour, zorder=7, **options)
        text.set_path_effects([withStroke(linewidth=2, foreground="white")])


def place_of_force(table, rows):
    """Where a pair's pressure acts on the whole: rows of one side, in the order of their arc length."""
    s, p = table["s"][rows], np.nan_to_num(table["p"][rows])
    weights = np.maximum(p, 0) * np.abs(np.gradient(s)) if len(s) > 1 else np.ones(1)
    weights = weights if weights.sum() > 0 else np.ones(len(s))
    return np.average(np.stack([table["x"][rows], table["y"][rows]], axis=1), axis=0, weights=weights)


def draw_forces(axes, mesh, table, pairs, turned):
    """A stroke a contact pair, where its force acts and along it, as wide and dark as it is large."""
    axes.add_collection(LineCollection(joined(polylines(mesh.points[:, :2], outlines(mesh))), colors="0.75", linewidths=0.6))
    forces = np.array([pair["force"] for pair in pairs])[:, :: -1 if turned else 1]
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
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.margins(0.03)
    label_places(axes, turned)
    colour_bar(axes, strokes, "contact force of a pair (scene's units)", turned)
    axes.set_title(f"forces between bodies:\n{len(acting)} of {len(pairs)} pairs carry some", fontsize=9)
