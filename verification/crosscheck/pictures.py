"""Pictures of the report: both pressures and their difference, the difference of the displacements, the rates."""

import meshio
import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.tri import Triangulation

import run  # makes common/ known
import figure
import launch
from scene import SIDES

COLOURS = {"mortise": "#f39b8a", "freefem": "#123c66"}
NEXT_LEVEL = [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]]  # four triangles of a triangle6


def pressure_limits(values):
    """Limits of y that show the curves; the few values at singular corners may leave the panel."""
    first, last = np.percentile(values, [3, 97])
    half = max((last - first) / 2, 0.02 * abs(first + last) / 2) or np.inf
    low, high = max(values.min(), first - 1.5 * half), min(values.max(), last + 1.5 * half)
    margin = max(0.06 * (high - low), 0.02 * abs(high))
    return low - margin, high + margin


def draw_pressures(above, below, table, side):
    """Both curves over each other, and the difference in units of the mean |p|."""
    s, ours, theirs = (table[name] for name in ("s", "p_mortise", "p_freefem"))
    above.plot(s, ours, color=COLOURS["mortise"], linewidth=3.2, label="mortise")
    above.plot(s, theirs, color=COLOURS["freefem"], linewidth=1, dashes=(5, 3), label="FreeFEM")
    both = np.concatenate([ours, theirs])
    low, high = pressure_limits(both)
    if off := int(((both < low) | (both > high)).sum()):
        above.set_title(f"{off} of {len(both)} values off the scale", fontsize=8, loc="right", color="0.4")
    legend = {"loc": "best", "frameon": False}
    figure.label(above, y="pressure $p$", ylim=(low, high), xlim=(s.min(), s.max()), legend=legend)
    mean = np.trapz(np.abs(ours), s) / np.ptp(s)
    below.plot(s, (ours - theirs) / mean, color="0.2", linewidth=1, marker=".", markersize=3)
    below.axhline(0, color="0.7", linewidth=0.6)
    figure.label(below, "arc length" if side in SIDES else f"arc length along {side}", "difference / mean $|p|$", xlim=(s.min(), s.max()))
    for axes in (above, below):
        figure.scientific(axes.yaxis, axes.get_ylabel())


def draw_difference(axes, mesh):
    """|u_mortise - u_freefem| over the largest |u|, on the mesh, in a logarithmic scale."""
    block, (x, y) = mesh.cells[0], mesh.points[:, :2].T
    size = np.linalg.norm(mesh.point_data["u_freefem"], axis=1).max()
    value = np.linalg.norm(mesh.point_data["difference"], axis=1) / (size or 1)
    high = float(value.max()) or 1e-16
    low = max(high * 1e-4, 1e-17)
    straight = block.data if block.type == "triangle" else block.data[:, NEXT_LEVEL].reshape(-1, 3)
    field = axes.tripcolor(Triangulation(x, y, straight), np.maximum(value, low), shading="gouraud",
                           norm=LogNorm(low, high), cmap="viridis")  # fmt: skip
    axes.triplot(Triangulation(x, y, block.data[:, :3]), color="white", linewidth=0.25, alpha=0.6)
    axes.set(aspect="equal", xlabel="$x_1$", ylabel="$x_2$")
    axes.margins(0.02)
    axes.figure.colorbar(field, ax=axes, pad=0.02, aspect=25, extend="min").set_label("$|\\Delta u|\\ /\\ \\max |u|$")


def draw_case(folder, title, side, picture):
    """The picture of a case out of pressure.csv and difference.vtu in its folder."""
    drawing = figure.plt.figure(figsize=(11, 4.6), layout="constrained")
    panels = drawing.subplot_mosaic([["p", "u"], ["d", "u"]], height_ratios=[2, 1.2], width_ratios=[1.1, 1])
    draw_pressures(panels["p"], panels["d"], launch.columns(folder / "pressure.csv"), side)
    draw_difference(panels["u"], meshio.read(folder / "difference.vtu"))
    drawing.suptitle(title, fontsize=10)
    figure.save(drawing, picture, 100)


def draw_rates(results, picture):
    """Differences over the meshes of each series, one panel a quantity; slopes 1 and 2 to compare with."""
    names = list(results[0].steps[0]["differences"])
    drawing, panels = figure.panels(1, len(names), (12, 4.4))
    scenes = list(dict.fromkeys(result.scene for result in results))
    colours = dict(zip(scenes, figure.plt.get_cmap("tab20").colors))
    for axes, name in zip(panels, names):
        for result in results:
            counts = [int(step["mesh"].split("x")[0]) for step in result.steps]
            points = [(n / counts[0], step["differences"][name]) for n, step in zip(counts, result.steps)]
            side = result.side.split("_")[0]
            style = {"style": ".-" if side in ("upper", "inner") else ".--", "color": colours[result.scene]}
            figure.curve(axes, points, **style, linewidth=1, label=f"{result.scene}, {side}")
        figure.label(axes, "refinement", title=name.replace("_", ", "), log="xy")
        top = axes.get_ylim()[1]
        for slope in (1, 2):
            axes.plot([1, 4], [top, top / 4**slope], color="0.75", linewidth=3, zorder=0)
            axes.annotate(f"$h^{slope}$", (3.3, top / 3.3**slope), ha="right", va="top", color="0.45", fontsize=9)
        axes.set_xticks([1, 2, 4], ["1", "2", "4"])
        axes.set_xticks([], minor=True)
    figure.legend_below(drawing, panels[0], 6, 0.2)
    figure.save(drawing, picture, 100)
