"""The gallery's pictures: sigma_n, u_n or p along x1, and stress fields."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

import cause
import gallery_measures as measures

COLOURS = {"G1": "#d1495b", "G2": "#2e6fab"}
QUANTITIES = {
    "sigma_n": (r"$\sigma_n$, MPa", 1e-6),
    "u_n": (r"$u_n$, $\mu$m", 1e6),
    "p": (r"$p$, MPa", 1e-6),
}
DPI = 85
COLOURS_OF_A_PICTURE = 96
SIZE = (4.6, 2.7)


def save(figure, path):
    """A PNG of few colours, which is small."""
    figure.set_dpi(DPI)
    figure.canvas.draw()
    pixels = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB")
    pixels.quantize(COLOURS_OF_A_PICTURE).save(path, optimize=True)
    plt.close(figure)


def limits(curves, name, factor, piece):
    """Of the middle part of the curves: the ends are singular and would hide the rest."""
    values = np.concatenate([factor * c[name][(c["x"] >= piece[0]) & (c["x"] <= piece[1])] for c in curves])
    low, high = values.min(), values.max()
    return low - 0.12 * (high - low), high + 0.3 * (high - low)


def line(path, curves, name="sigma_n", piece=None, whole=False, y_limits=None):
    """`curves`: label: (style, columns). `piece`: part of x1; `whole`: the corners' peaks too."""
    label, factor = QUANTITIES[name]
    figure, axes = plt.subplots(figsize=SIZE, layout="constrained")
    for text, (style, curve) in curves.items():
        axes.plot(curve["x"], factor * curve[name], label=text, **style)
    axes.set(xlabel=r"$x_1$, m", ylabel=label, xlim=piece or (0, 0.8))
    judged = piece or ((0, 0.8) if whole else (0.03, 0.77))
    axes.set_ylim(y_limits or limits([curve for _, curve in curves.values()], name, factor, judged))
    axes.grid(alpha=0.25)
    axes.legend(fontsize=7.5, frameon=False, ncol=2, loc="upper center")
    save(figure, path)


def bodies(curves, suffix="", **style):
    """Both bodies' curves with their labels."""
    marks = {"G1": {"linewidth": 1.3}, "G2": {"linewidth": 1.1, "linestyle": (0, (4, 2))}}
    words = {"G1": "G1 (upper)", "G2": "G2 (lower)"}
    return {
        words[body] + suffix: ({"color": COLOURS[body], **marks[body], **style}, curve)
        for body, curve in zip(COLOURS, curves)
    }


def reference(curve, words="matching meshes"):
    return {words: ({"color": "black", "linewidth": 0.9}, curve)}


def variant(view, scene, mesh, active, body, at="nodes"):
    """The same by the variant that comes nearest to the preprint, pale."""
    curve = view.curve(scene, mesh, active, body, at=at, variant=view.like)
    return {f"{body}, by the variant": ({"color": COLOURS[body], "linewidth": 0.8, "alpha": 0.45}, curve)}


def fields(path, view, scene, name, active):
    """Three panels: matching meshes, ours and the variant's on 80x100."""
    cases = [
        ("80x80", view.folder_with_fields(scene, (80, 80), active)),
        ("80x100", view.folder_with_fields(scene, (80, 100), active)),
        ("80x100, by the variant", view.folder_with_fields(scene, (80, 100), active, view.like)),
    ]
    figure, panels = plt.subplots(1, 3, figsize=(9.4, 2.7), sharey=True, layout="constrained")
    found = [measures.fields(folder) for _, folder in cases]
    low, high = np.percentile(found[0][name] * 1e-6, (2, 98))
    for axes, (title, _), field in zip(panels, cases, found):
        x, y = field["points"].T
        shown = axes.tripcolor(
            x, y, field["triangles"], field[name] * 1e-6, shading="gouraud", vmin=low, vmax=high, cmap="viridis"
        )
        axes.set(aspect="equal", xlabel=r"$x_1$, m")
        axes.set_title(title, fontsize=9)
    panels[0].set_ylabel(r"$x_2$, m")
    figure.colorbar(shown, ax=panels, extend="both", pad=0.01, label=rf"$\sigma_{{{name[-2:]}}}$, MPa")
    save(figure, path)
