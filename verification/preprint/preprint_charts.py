"""Charts of the tables and of the variants: ours against printed, size by variant, delta by mesh, sigma_n along x1."""

import numpy as np

import cause
import figure
import oscillation
import printed_tables as printed
from gallery import COLOURS
from preprint_runs import on_side

STYLES = {"straight": ("#7a7a7a", "s"), "circle": ("#2e6fab", "o"), "parabolas": ("#d1495b", "^")}
STYLES = {series: {"color": colour, "marker": mark, "linestyle": ""} for series, (colour, mark) in STYLES.items()}


def legend_above(drawing, axes, columns=4):
    """One legend of an axes' labels above all panels."""
    handles, labels = axes.get_legend_handles_labels()
    drawing.legend(handles, labels, loc="upper center", ncol=columns, frameon=False, fontsize=8.5)
    share = (0.32 if len(labels) <= columns else 0.5) / drawing.get_figheight()
    drawing.get_layout_engine().set(rect=(0, 0, 1, 1 - share))


def printed_against_ours(path, rows):
    """A point for each target row: below the diagonal ours oscillates less."""
    drawing, axes = figure.panels(1, 1, (5, 4.6))
    for series in printed.SERIES:
        here = printed.of_series(rows, series)
        axes.plot([r["printed"] for r in here], [r["better"] for r in here], label=series, alpha=0.8, **STYLES[series])
    ends = np.array([5e-5, 1])
    axes.plot(ends, ends, color="black", linewidth=0.9)
    axes.text(0.3, 0.42, "equal", rotation=45, fontsize=8, ha="center", va="center")
    legend = {"frameon": False, "loc": "upper left", "fontsize": 9}
    words = r"$\delta$ printed", r"$\delta$ ours, better side"
    figure.label(axes, *words, log="xy", xlim=ends, ylim=ends, aspect="equal", legend=legend)
    figure.save(drawing, path)


def variants(path, rows, verdicts):
    """ours/printed of every target row, a line for each variant in the reading that fits the parabolas better."""
    names = list(dict.fromkeys(row["variant"] for row in rows))
    drawing, axes = figure.panels(1, 1, (8.6, 0.42 * len(names) + 1.3))
    shift = dict(zip(printed.SERIES, (0.22, 0, -0.22)))
    for k, name in enumerate(names):
        reading = cause.nearest([v for v in verdicts if v["variant"] == name], fitting=False)["reading"]
        for series in printed.SERIES:
            ratios = [row[reading] / row["printed"] for row in cause.targets(rows, name, series)]
            style, y = STYLES[series], len(names) - 1 - k + shift[series]
            axes.plot(ratios, [y] * len(ratios), markersize=3.2, alpha=0.35, **style)
            words = f"{series}: rows, and their median" if k == 0 else None
            axes.plot(cause.middle(ratios), y, markersize=7, markeredgecolor="black", label=words, **style)
    axes.axvspan(1 / cause.FACTOR, cause.FACTOR, color="0.9", zorder=0)
    axes.axvline(1, color="black", linewidth=0.8)
    words = r"$\delta$ of the variant / $\delta$ printed (grey: within a factor of 3)"
    figure.label(axes, words, log="x", ylim=(-0.6, len(names) - 0.4))
    axes.grid(False, axis="y")
    axes.set_yticks(range(len(names)), names[::-1], fontsize=9)
    legend_above(drawing, axes)
    figure.save(drawing, path)


def by_mesh(path, rows, chosen, reading):
    """delta over the number of elements, circle and parabola 2: printed, and by some variants."""
    styles = dict(zip(chosen, ("#2e6fab", "#e0a030", "#d1495b", "#3a8a4d")))
    drawing, panels = figure.panels(1, 2, (8.6, 3.5), sharey=True)
    for axes, scene in zip(panels, ("circle", "parabola_2")):
        of = lambda name, value: mean_by_mesh(rows, name, scene, value)
        axes.plot(*of(chosen[0], "printed"), "ks--", markersize=5, label="printed")
        for name, colour in styles.items():
            axes.plot(*of(name, reading), "o-", color=colour, markersize=4, label=name)
        figure.label(axes, r"$n_{upper}$ (meshes 4 : 5)", title=scene, log="xy")
        meshes = of(chosen[0], "printed")[0]
        axes.set_xticks(meshes, [str(n) for n in meshes])
        axes.minorticks_off()
    panels[0].set_ylabel(r"$\delta$, geometric mean of the 4 rows")
    legend_above(drawing, panels[0], columns=3)
    figure.save(drawing, path)


def mean_by_mesh(rows, variant, scene, value):
    here = [r for r in rows if r["variant"] == variant and r["scene"] == scene and r["at"] == "nodes"]
    meshes = sorted({row["mesh"] for row in here})
    means = [np.exp(np.mean([np.log(r[value]) for r in here if r["mesh"] == mesh])) for mesh in meshes]
    return [mesh[0] for mesh in meshes], means


def stress_curves(path, store, chosen, side, scene, mesh):
    """sigma_n of both bodies along x1, a panel for each variant, against matching meshes."""
    drawing, panels = figure.panels(len(chosen), 1, (8.6, 2.1 * len(chosen) + 0.4), sharex=True)
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
        figure.label(axes, y=r"$\sigma_n$, MPa", xlim=(0, 0.8), ylim=(low - 7, high + 7))
        axes.set_title(name, fontsize=9.5, loc="left")
    panels[-1].set_xlabel(r"$x_1$, m")
    legend_above(drawing, panels[0])
    figure.save(drawing, path)
