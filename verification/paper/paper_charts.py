"""Charts of the tables and of the variants: ours against printed, size by variant, delta by mesh, sigma_n along x1."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import cause
import oscillation
import preprint
from gallery_draw import COLOURS, save
from paper_runs import on_side

SERIES_COLOURS = {"straight": "#7a7a7a", "circle": "#2e6fab", "parabolas": "#d1495b"}
MARKS = {"straight": "s", "circle": "o", "parabolas": "^"}


def legend_above(figure, axes, columns=4):
    """One legend of an axes' labels above all panels."""
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncol=columns, frameon=False, fontsize=8.5)
    share = (0.32 if len(labels) <= columns else 0.5) / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - share))


def printed_against_ours(path, rows):
    """A point for each target row: below the diagonal ours oscillates less."""
    figure, axes = plt.subplots(figsize=(5, 4.6), layout="constrained")
    for series, scenes in preprint.SERIES.items():
        here = [row for row in rows if row["target"] and row["scene"] in scenes]
        style = {"color": SERIES_COLOURS[series], "marker": MARKS[series], "linestyle": "", "markersize": 4.5}
        axes.plot([r["printed"] for r in here], [r["better"] for r in here], label=series, alpha=0.8, **style)
    ends = np.array([5e-5, 1])
    axes.plot(ends, ends, color="black", linewidth=0.9)
    axes.text(0.3, 0.42, "equal", rotation=45, fontsize=8, ha="center", va="center")
    axes.set(xscale="log", yscale="log", xlim=ends, ylim=ends, aspect="equal")
    axes.set(xlabel=r"$\delta$ printed", ylabel=r"$\delta$ ours: segments, closed, better side")
    axes.grid(alpha=0.25)
    axes.legend(frameon=False, loc="upper left", fontsize=9)
    save(figure, path)


def variants(path, rows, verdicts):
    """ours/printed of every target row, a line for each variant in the reading that fits the parabolas better."""
    names = list(dict.fromkeys(row["variant"] for row in rows))
    figure, axes = plt.subplots(figsize=(8.6, 0.42 * len(names) + 1.3), layout="constrained")
    shift = dict(zip(preprint.SERIES, (0.22, 0, -0.22)))
    for k, name in enumerate(names):
        reading = cause.nearest([v for v in verdicts if v["variant"] == name], fitting=False)["reading"]
        for series in preprint.SERIES:
            ratios = [row[reading] / row["printed"] for row in cause.targets(rows, name, series)]
            style = {"color": SERIES_COLOURS[series], "marker": MARKS[series], "linestyle": ""}
            y = len(names) - 1 - k + shift[series]
            axes.plot(ratios, [y] * len(ratios), markersize=3.2, alpha=0.35, **style)
            words = f"{series}: rows, and their median" if k == 0 else None
            axes.plot(cause.middle(ratios), y, markersize=7, markeredgecolor="black", label=words, **style)
    axes.axvspan(1 / cause.FACTOR, cause.FACTOR, color="0.9", zorder=0)
    axes.axvline(1, color="black", linewidth=0.8)
    axes.set(xscale="log", xlabel=r"$\delta$ of the variant / $\delta$ printed (grey: within a factor of 3)")
    axes.set_yticks(range(len(names)), names[::-1], fontsize=9)
    axes.set_ylim(-0.6, len(names) - 0.4)
    axes.grid(axis="x", alpha=0.25)
    legend_above(figure, axes)
    save(figure, path)


def by_mesh(path, rows, chosen, reading):
    """delta over the number of elements, circle and parabola 2: printed, and by some variants."""
    styles = dict(zip(chosen, ("#2e6fab", "#e0a030", "#d1495b", "#3a8a4d")))
    figure, panels = plt.subplots(1, 2, figsize=(8.6, 3.5), sharey=True, layout="constrained")
    for axes, scene in zip(panels, ("circle", "parabola_2")):
        of = lambda name, value: mean_by_mesh(rows, name, scene, value)
        axes.plot(*of(chosen[0], "printed"), "ks--", markersize=5, label="printed")
        for name, colour in styles.items():
            axes.plot(*of(name, reading), "o-", color=colour, markersize=4, label=name)
        axes.set(xscale="log", yscale="log", xlabel=r"$n_{upper}$ (meshes 4 : 5)", title=scene)
        meshes = of(chosen[0], "printed")[0]
        axes.set_xticks(meshes, [str(n) for n in meshes])
        axes.minorticks_off()
        axes.grid(alpha=0.25)
    panels[0].set_ylabel(r"$\delta$, geometric mean of the 4 rows")
    legend_above(figure, panels[0], columns=3)
    save(figure, path)


def mean_by_mesh(rows, variant, scene, value):
    here = [r for r in rows if r["variant"] == variant and r["scene"] == scene and r["at"] == "nodes"]
    meshes = sorted({row["mesh"] for row in here})
    means = [np.exp(np.mean([np.log(r[value]) for r in here if r["mesh"] == mesh])) for mesh in meshes]
    return [mesh[0] for mesh in meshes], means


def stress_curves(path, store, chosen, side, scene, mesh):
    """sigma_n of both bodies along x1, a panel for each variant, against matching meshes."""
    size = (8.6, 2.1 * len(chosen) + 0.4)
    figure, panels = plt.subplots(len(chosen), 1, figsize=size, sharex=True, layout="constrained")
    for axes, name in zip(panels, chosen):
        settings = cause.settings_of(name, scene)
        for body in ("G2", "G1"):
            curve = store.curve(scene, mesh, {**settings, **on_side(side)}, body)
            words = f"{body} ({'upper' if body == 'G1' else 'lower'} body)"
            axes.plot(curve["x"], curve["sigma_n"] / 1e6, color=COLOURS[body], linewidth=0.9, label=words)
        reference = oscillation.matching_curve(store, scene, mesh, settings, "G1")
        axes.plot(reference["x"], reference["sigma_n"] / 1e6, color="black", linewidth=0.8, label="matching meshes")
        here = (reference["x"] > 0.03) & (reference["x"] < 0.77)
        low, high = (f(reference["sigma_n"][here]) / 1e6 for f in (np.min, np.max))
        axes.set(xlim=(0, 0.8), ylim=(low - 7, high + 7), ylabel=r"$\sigma_n$, MPa")
        axes.set_title(name, fontsize=9.5, loc="left")
        axes.grid(alpha=0.25)
    panels[-1].set_xlabel(r"$x_1$, m")
    legend_above(figure, panels[0])
    save(figure, path)
