#!/usr/bin/python3
"""The set-up of a scene before it is solved: bodies with their materials, supports, loads and contact pairs by name.

Usage: setup.py SETUP.json PICTURE
(mortise check SCENE.toml --picture PICTURE does both)

SETUP.json is what mortise writes for it (src/results/setup_json.hpp).
"""

import json
import pathlib

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.patheffects import withStroke

import figure
from drawn_bodies import MANY_EDGES, MANY_PAIRS, PAIR_COLOURS, SLENDER
from drawn_cells import joined, size_of
from drawn_curves import lines_of
from drawn_forces import LOAD, REACTION, label_places
from script import Parser, run

FILLS = ["#dbe7f3", "#f4e6d4", "#dff0dc", "#eee0f0", "#f3f0cf", "#e4e4e4"]  # a material each
MANY_NAMES = 40  # more are not written on the picture
UNUSED = "0.55"
MANY_CELLS = 20000  # more are not drawn one by one


def draw_bodies(axes, setup, nodes, room):
    """Fills and outlines; names, with their materials where there is room for two lines; for the legend the materials,
    where a scene says them."""
    materials = list(dict.fromkeys(body.get("material") for body in setup["bodies"]))
    cells = sum(len(body["cells"]) for body in setup["bodies"])
    for k, body in enumerate(setup["bodies"]):
        fill = FILLS[materials.index(body.get("material")) % len(FILLS)]
        if "material" not in body and (loops := loops_of(setup, k, room)):  # as drawn: whatever its mesh is, it is not used yet
            axes.add_patch(PathPatch(Path.make_compound_path(*map(Path, loops)), facecolor=fill, linewidth=0))
            continue
        lines = {"edgecolors": "0.75", "linewidths": 0.3} if cells <= MANY_CELLS else {"edgecolors": fill, "linewidths": 0.3}
        axes.add_collection(PolyCollection([nodes[cell] for cell in body["cells"]], facecolors=fill, rasterized=True, **lines))
        sides = {}
        for cell in body["cells"]:
            for side in zip(cell, [*cell[1:], cell[0]]):
                sides[frozenset(side)] = None if frozenset(side) in sides else side
        outline = [nodes[list(side)] for side in sides.values() if side is not None]
        dots = {"rasterized": len(outline) > MANY_EDGES}
        axes.add_collection(LineCollection(joined(outline), colors="0.35", linewidths=0.7, **dots))
    if len(setup["bodies"]) <= MANY_NAMES:
        for body, at in zip(setup["bodies"], name_places(setup["bodies"], nodes)):
            material = f"\n({figure.short(body['material'])})" if room and "material" in body else ""
            name(axes, at, f"{figure.short(body['name'])}{material}", "0.25", ha="center", va="center").rank = 1
    return [Line2D([], [], marker="s", linestyle="", markersize=8, color=FILLS[k % len(FILLS)], label=f"material {figure.short(m)}")
            for k, m in enumerate(materials) if m is not None]


def loops_of(setup, body, upright):
    """The outline of a body by the curves on it, if they close."""
    nodes = np.array(setup["nodes"])
    edges = [edge for curve in setup["curves"].values() for edge in curve if edge[3] == body]
    loops = joined(lines_of(nodes, edges)) if edges else []
    size = size_of(nodes)
    return [loop[:, :: 1 if upright else -1] for loop in loops] if all(np.linalg.norm(loop[0] - loop[-1]) < 1e-6 * size for loop in loops) else []


def name_places(bodies, nodes):
    """Where each body's name stands: on the cell nearest to its middle; of a ring, which has none there, farthest from the others'."""
    cells = [np.array([nodes[cell].mean(axis=0) for cell in body["cells"]]) for body in bodies]
    off = [np.linalg.norm(middles - middles.mean(axis=0), axis=1) for middles in cells]
    ring = [from_middle.min() > 0.2 * from_middle.max() for from_middle in off]
    places = [middles[from_middle.argmin()] for middles, from_middle in zip(cells, off)]
    for k in np.flatnonzero(ring):
        others = np.array([place for j, place in enumerate(places) if j != k and (not ring[j] or j < k)]).reshape(-1, 1, 2)
        places[k] = cells[k][np.linalg.norm(cells[k] - others, axis=2).min(axis=0).argmax()] if len(others) else places[k]
    return places


def name(axes, place, text, colour, **options):
    written = axes.annotate(text, place, color=colour, fontsize=7.5, zorder=8, **options)
    written.set_path_effects([withStroke(linewidth=2, foreground="white")])
    written.rank = 2  # of those that lie on one another, lower ones stay
    return written


def draw_curve(axes, lines, colour, width=2.0, style="-"):
    axes.add_collection(LineCollection(joined(lines), colors=colour, linewidths=width, linestyles=style, zorder=4, capstyle="round"))


def places_along(lines, spacing):
    """Places and outward normals at about this spacing along polylines with the body on their left, one at least."""
    starts, ends = (np.concatenate([line[part] for line in lines]) for part in (slice(None, -1), slice(1, None)))
    lengths = np.linalg.norm(ends - starts, axis=1)
    behind, total = np.cumsum(lengths), lengths.sum()
    wanted = (np.arange(max(1, round(total / spacing))) + 0.5) * total / max(1, round(total / spacing))
    k = np.minimum(np.searchsorted(behind, wanted), len(lengths) - 1)
    along = (ends - starts)[k] / lengths[k, None]
    return ends[k] - (behind[k] - wanted)[:, None] * along, np.stack([along[:, 1], -along[:, 0]], axis=1)


def held_along(words):
    """Directions in which a support holds, of those along x and y."""
    return np.array([along for name, along in (("u_x", (1, 0)), ("u_y", (0, 1))) if f"{name} =" in words]).reshape(-1, 2)


def hatches(lines, size, held):
    """Strokes (start, end) on the outside of a support: along x or y where only that displacement is held, else slanted."""
    at, normal = places_along(lines, 0.025 * size)
    if len(held) == 1:
        middle, half = at + 0.014 * size * normal, 0.009 * size * np.array(held)
        return np.stack([middle - half, middle + half], axis=1)
    slanted = normal + 0.8 * np.stack([-normal[:, 1], normal[:, 0]], axis=1)
    return np.stack([at, at + 0.018 * size * slanted], axis=1)


def shafts(lines, size, force, pulls=False):
    """Arrows (start, end) of a load along a force, or along the normal if that is None: onto what they push, away from what they pull."""
    at, normal = places_along(lines, 0.06 * size)
    along = np.broadcast_to(force / np.linalg.norm(force), at.shape) if force is not None else normal if pulls else -normal
    step = 0.055 * size * along
    start = np.where(((step * normal).sum(axis=1) < 0)[:, None], at - step, at)
    return np.stack([start, start + step], axis=1)


def draw_load(axes, lines, force, words, size):
    pressure = words.startswith("pressure")
    if not np.linalg.norm(force) > 0 and not pressure:
        return
    draw_curve(axes, lines, LOAD)
    for start, end in shafts(lines, size, None if pressure else force, words.startswith("pressure -")):
        arrow(axes, start, end)


def draw_arrows_at(axes, places, force, size):
    """Arrows along a force that end at these places."""
    step = 0.07 * size * force / (np.linalg.norm(force) or 1)
    for place in places:
        arrow(axes, place - step, place)


def arrow(axes, start, end):
    style = {"arrowstyle": "-|>", "color": LOAD, "linewidth": 1.0, "mutation_scale": 8, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", xy=end, xytext=start, arrowprops=style, zorder=6)
    axes.update_datalim([start, end])


def draw(setup, picture):
    nodes = np.array(setup["nodes"])
    curves = {key: lines_of(nodes, edges) for key, edges in setup["curves"].items()}
    turned = bool(np.ptp(nodes[:, 1]) > SLENDER * np.ptp(nodes[:, 0]))
    order = slice(None, None, -1 if turned else 1)  # of coordinates; and of a curve, which keeps its body on the left so
    nodes, curves = nodes[:, order], {key: [line[order, order] for line in lines][order] for key, lines in curves.items()}
    size = size_of(nodes)
    named = len(curves) <= MANY_NAMES
    extent = np.ptp(nodes, axis=0)
    height = float(np.clip(7 * extent[1] / extent[0], 1.6 if turned else 2.5, 9))
    drawing, axes = figure.panels(1, 1, (8, height + 0.8))
    legend = draw_bodies(axes, setup, nodes, not turned)
    written = set()

    def tell(colour, label, on, side=1, rank=2):
        """A line of the legend, and the names of its curves outside (1) or inside (-1) of their bodies."""
        legend.append(Line2D([], [], color=colour, linewidth=2, label=label))
        write(colour, on, side, rank)

    def write(colour, on, side, rank=2):
        for curve in on:
            if named and curve in curves and curve not in written:
                written.add(curve)
                at, n = (row[0] for row in places_along(curves[curve], np.inf))
                n = side * n * [1, -1 if turned else 1]  # on the page
                words = {"ha": "left" if n[0] > 0.5 else "right" if n[0] < -0.5 else "center",
                         "va": "bottom" if n[1] > 0.5 else "top" if n[1] < -0.5 else "center"}
                words["rotation"] = 90 if abs(n[0]) > 0.9 else 0
                name(axes, at, figure.short(curve), colour, textcoords="offset points", xytext=tuple((14 if side > 0 else 6) * n), **words).rank = rank

    for support in setup["supports"]:
        for curve in support["on"]:
            if curve in curves:
                draw_curve(axes, curves[curve], REACTION)
                draw_curve(axes, hatches(curves[curve], size, held_along(support["words"])[:, order]), REACTION, 0.9)
            else:
                axes.plot(*nodes[setup["points"].get(curve, [])].T, "^", color=REACTION, zorder=6)
        tell(REACTION, f"support {listed(support['on'])}: {figure.plain(support['words'])}", support["on"], rank=0)
    for load in setup["loads"]:
        force = np.array(load["sum"])
        force[np.abs(force) < 1e-9 * np.abs(force).max()] = 0
        for curve in load["on"]:
            if curve in curves:
                draw_load(axes, curves[curve], force[order], load["words"], size)
            else:
                draw_arrows_at(axes, nodes[setup["points"].get(curve, [])], force[order], size)
        tell(LOAD, f"load {listed(load['on'])}: {figure.plain(load['words'])}, in sum ({force[0]:.4g}, {force[1]:.4g})", load["on"], rank=0)
    for k, pair in enumerate(setup["contact"]):
        colour = PAIR_COLOURS[k % len(PAIR_COLOURS)]
        for curve, style in zip(pair["between"], ["-", (0, (3, 2))]):
            draw_curve(axes, curves[curve], colour, 2.4, style)
        if len(setup["contact"]) > MANY_PAIRS:
            write(colour, pair["between"], -1)
        else:
            tell(colour, f"contact {listed(pair['between'], ' - ')}: {figure.plain(pair['words'])}", pair["between"], -1)
    if len(setup["contact"]) > MANY_PAIRS:
        tell(PAIR_COLOURS[0], f"{len(setup['contact'])} contact pairs", [])
    for tie in setup["ties"]:
        for curve in tie:
            draw_curve(axes, curves[curve], "0.45", 2.0)
        tell("0.45", f"tied: {listed(tie, ' - ')}", tie, -1)
    used = {curve for key in ("supports", "loads") for entry in setup[key] for curve in entry["on"]}
    used.update(curve for pair in [*setup["ties"], *(pair["between"] for pair in setup["contact"])] for curve in pair)
    for curve in curves.keys() - used:
        draw_curve(axes, curves[curve], UNUSED, 1.4)
    if unused := [curve for curve in curves if curve not in used]:
        tell(UNUSED, f"unused: {listed(unused)}", unused)
    legend += [Line2D([], [], linestyle="", label=f"besides: {what}") for what in setup["rest"]]
    axes.autoscale_view()
    axes.margins(0.1)
    axes.set_aspect("equal")
    label_places(axes, turned)
    drawing.suptitle(figure.wrapped(setup["title"]), fontsize=11)
    below = 0.1 + 0.165 * len([*legend, "names"][:20])  # inches
    drawing.set_size_inches(8, height + 0.8 + below)
    part = below / (height + 0.8 + below)
    drawing.get_layout_engine().set(rect=(0, part, 1, 1 - part))
    names = sorted((text for text in axes.texts if hasattr(text, "rank")), key=lambda text: text.rank)
    if left_out := figure.leave_out_overlaps(drawing, names):
        legend.append(Line2D([], [], linestyle="", label=f"{left_out} names have no room"))
    drawing.legend(handles=legend[:20], frameon=False, fontsize=7.5, loc="lower left", bbox_to_anchor=(0.07, 0))
    figure.save(drawing, picture, 130)


def listed(names, between=", "):
    """The names, of many the first ones."""
    shown = between.join(figure.short(name) for name in names[:4])
    return shown + (f" and {len(names) - 4} more" if len(names) > 4 else "")


def main():
    parser = Parser(__doc__)
    parser.add_argument("setup", type=pathlib.Path, help=".json")
    parser.add_argument("picture", type=pathlib.Path, help=".png, .pdf or .svg")
    options = parser.parse_args()
    if options.picture.suffix not in (".png", ".pdf", ".svg"):
        parser.error(f"{options.picture}: expected a .png, .pdf or .svg to write")
    setup = json.loads(options.setup.read_text())
    draw(setup | {"title": f"{setup['title'] or 'set-up'} (before it is solved)"}, options.picture)
    print(options.picture)


if __name__ == "__main__":
    run(main)
