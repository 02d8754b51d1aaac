"""Pictures of the report: both pressures and their difference, the difference of the displacements, the rates."""

import csv

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import meshio
import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.ticker import ScalarFormatter
from matplotlib.tri import Triangulation

COLOURS = {"mortise": "#f39b8a", "freefem": "#123c66"}
NEXT_LEVEL = [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]]  # four triangles of a triangle6


def scientific():
    formatter = ScalarFormatter(useMathText=True)
    formatter.set_powerlimits((-3, 4))
    return formatter


def read_pressures(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def pressure_limits(values):
    """Limits of y that show the curves; the few values at singular corners may leave the panel."""
    first, last = np.percentile(values, [3, 97])
    half = max((last - first) / 2, 0.02 * abs(first + last) / 2)
    low, high = max(values.min(), first - 1.5 * half), min(values.max(), last + 1.5 * half)
    margin = max(0.06 * (high - low), 0.02 * abs(high))
    return low - margin, high + margin


def draw_pressures(above, below, table, side):
    """Both curves over each other, and the difference in units of the mean |p|."""
    s, ours, theirs = table["s"], table["p_mortise"], table["p_freefem"]
    above.plot(s, ours, color=COLOURS["mortise"], linewidth=3.2, label="mortise")
    above.plot(s, theirs, color=COLOURS["freefem"], linewidth=1, dashes=(5, 3), label="FreeFEM")
    both = np.concatenate([ours, theirs])
    low, high = pressure_limits(both)
    above.set_ylim(low, high)
    off = int(((both < low) | (both > high)).sum())
    if off:
        above.set_title(f"{off} of {len(both)} values off the scale", fontsize=8, loc="right", color="0.4")
    above.set_ylabel("pressure $p$")
    above.yaxis.set_major_formatter(scientific())
    above.legend(loc="best", frameon=False, fontsize=8)
    mean = np.trapz(np.abs(ours), s) / np.ptp(s)
    below.plot(s, (ours - theirs) / mean, color="0.2", linewidth=1, marker=".", markersize=3)
    below.axhline(0, color="0.7", linewidth=0.6)
    below.set_ylabel("difference / mean $|p|$")
    below.set_xlabel(f"arc length along {side}")
    below.yaxis.set_major_formatter(scientific())
    for axes in (above, below):
        axes.set_xlim(s.min(), s.max())
        axes.grid(color="0.92", linewidth=0.6)
        axes.set_axisbelow(True)


def corner_triangles(mesh):
    """Straight triangles that pass through all nodes."""
    block = mesh.cells[0]
    return block.data if block.type == "triangle" else block.data[:, NEXT_LEVEL].reshape(-1, 3)


def draw_difference(axes, mesh):
    """|u_mortise - u_freefem| over the largest |u|, on the mesh, in a logarithmic scale."""
    size = np.linalg.norm(mesh.point_data["u_freefem"], axis=1).max()
    value = np.linalg.norm(mesh.point_data["difference"], axis=1) / (size or 1)
    positive = value[value > 0]
    high = float(positive.max()) if len(positive) else 1e-16
    low = max(high * 1e-4, 1e-17)
    triangles = Triangulation(*mesh.points[:, :2].T, corner_triangles(mesh))
    norm = LogNorm(low, high)
    field = axes.tripcolor(triangles, np.maximum(value, low), shading="gouraud", norm=norm, cmap="viridis")
    outline = Triangulation(*mesh.points[:, :2].T, mesh.cells[0].data[:, :3])
    axes.triplot(outline, color="white", linewidth=0.25, alpha=0.6)
    axes.set_aspect("equal")
    axes.margins(0.02)
    axes.figure.colorbar(field, ax=axes, pad=0.02, aspect=25, extend="min").set_label("$|\\Delta u|\\ /\\ \\max |u|$")
    axes.set_xlabel("$x_1$")
    axes.set_ylabel("$x_2$")


def draw_case(folder, title, side, picture):
    """The picture of a case out of pressure.csv and difference.vtu in its folder."""
    figure = plt.figure(figsize=(11, 4.6), layout="constrained")
    panels = figure.subplot_mosaic([["p", "u"], ["d", "u"]], height_ratios=[2, 1.2], width_ratios=[1.1, 1])
    draw_pressures(panels["p"], panels["d"], read_pressures(folder / "pressure.csv"), side)
    draw_difference(panels["u"], meshio.read(folder / "difference.vtu"))
    figure.suptitle(title, fontsize=10)
    figure.savefig(picture, dpi=100)
    plt.close(figure)


def draw_rates(results, picture):
    """Differences over the meshes of each series, one panel a quantity; slopes 1 and 2 to compare with."""
    names = list(results[0].steps[0]["differences"])
    figure, panels = plt.subplots(1, len(names), figsize=(12, 4.4))
    scenes = list(dict.fromkeys(result.scene for result in results))
    colours = dict(zip(scenes, plt.get_cmap("tab20").colors))
    for axes, name in zip(panels, names):
        for result in results:
            first = result.steps[0]["mesh"].split("x")[0]
            sizes = [int(step["mesh"].split("x")[0]) / int(first) for step in result.steps]
            values = [step["differences"][name] for step in result.steps]
            side = result.side.split("_")[0]
            style = "-" if side in ("upper", "inner") else "--"
            label = f"{result.scene}, {side}"
            axes.loglog(sizes, values, style, color=colours[result.scene], marker=".", linewidth=1, label=label)
        top = axes.get_ylim()[1]
        for slope in (1, 2):
            axes.loglog([1, 4], [top, top / 4**slope], color="0.75", linewidth=3, zorder=0)
            axes.annotate(f"$h^{slope}$", (3.3, top / 3.3**slope), ha="right", va="top", color="0.45", fontsize=9)
        axes.set_title(name.replace("_", ", "), fontsize=9)
        axes.set_xticks([1, 2, 4], ["1", "2", "4"])
        axes.set_xticks([], minor=True)
        axes.set_xlabel("refinement")
        axes.grid(color="0.92", linewidth=0.6)
    figure.subplots_adjust(left=0.06, right=0.98, top=0.93, bottom=0.27, wspace=0.3)
    figure.legend(*panels[0].get_legend_handles_labels(), loc="lower center", ncol=6, fontsize=7, frameon=False)
    figure.savefig(picture, dpi=100)
    plt.close(figure)
