"""Figures in one style: panels, labelled axes, a legend below, and small PNG files."""

import logging
import math
import textwrap
import warnings

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, ScalarFormatter
from PIL import Image

RED = "#c00000"  # what fails
COLOURS = 64  # of a drawing in docs/
STEADY = 1e-3  # of a value: what differs by less is drawn as constant
LONGEST = 24  # letters of a name on a picture: two of them in a legend of four entries fill its width
# A letter that the font lacks is drawn as a box, and needs no words.
warnings.filterwarnings("ignore", message="Glyph .* missing")
logging.getLogger("matplotlib.mathtext").setLevel(logging.ERROR)
plt.rcParams.update({"axes.titlesize": 10, "legend.fontsize": 8, "lines.markersize": 4.5, "grid.alpha": 0.25})


def panels(rows, columns, size, **options):
    """A figure and its panels, as plt.subplots gives them; size in inches."""
    return plt.subplots(rows, columns, figsize=size, layout="constrained", **options)


def mosaic(layout, size):
    """As panels, of unequal sizes: {letter: axes} of rows like "AAB"."""
    return plt.subplot_mosaic("\n".join(layout), figsize=size, layout="constrained")


def label(axes, x=None, y=None, title=None, log="", limit=None, legend=False, **settings):
    """Labels, grid and scales; `log` names logarithmic axes ("xy"), `limit` draws a dashed level, others: set()."""
    for name, text in (("xlabel", x), ("ylabel", y), ("title", title)):
        settings |= {name: text} if text is not None else {}
    axes.set(**{f"{axis}scale": "log" for axis in log}, **settings)
    axes.grid(True)
    axes.set_axisbelow(True)
    if limit is not None:
        axes.axhline(limit, color="0.4", linestyle="--", linewidth=0.9)
    if legend:
        axes.legend(**(legend if isinstance(legend, dict) else {}))


def plain(text):
    """A user's text as it is written: matplotlib would set what stands between dollars as a formula, and stops at one
    that it cannot read. A letter that cannot be printed becomes a question mark."""
    return "".join(c if c.isprintable() else "?" for c in text).replace("$", "\\$")


def short(name):
    """A user's name as it is written, of a long one its beginning and its end."""
    half = (LONGEST - 3) // 2
    return plain(name if len(name) <= LONGEST else f"{name[:half]}...{name[-half:]}")


def wrapped(text, width=95, lines=3):
    """A user's text in so many lines of so many letters at most."""
    cut = textwrap.wrap(" ".join(text.split()), width, max_lines=lines, placeholder=" ...")
    return "\n".join(plain(line) for line in cut)


def scientific(axis, label):
    """Ticks of large and small numbers, their power of ten in the label, where it lies over nothing. Of an axis whose limits
    are set; those that would magnify round-off are widened to nought."""
    low, high = axis.get_view_interval()
    largest = max(abs(low), abs(high))
    if high - low < STEADY * largest:
        getattr(axis.axes, f"set_{axis.axis_name}lim")(min(1.25 * low, 0), max(1.25 * high, 0))
    power = math.floor(math.log10(largest)) if largest > 0 else 0
    if -3 <= power < 4:
        axis.set_major_formatter(ScalarFormatter(useOffset=False))
        return axis.set_label_text(label)
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value / 10.0**power:.6g}"))
    return axis.set_label_text(", ".join(filter(None, [label, f"$10^{{{power}}}$"])))


def grouped(value):
    """A magnification as it is read: 20 000, not 2e+04."""
    return f"{value:,.0f}".replace(",", "\u2009") if 1 <= value < 1e9 else f"{value:g}"


def curve(axes, points, style="o-", hollow=None, **options):
    """A line through points (x, y), in order of x; `hollow(x, y)` says which markers are open."""
    points = sorted(points)
    (line,) = axes.plot(*zip(*points) if points else ([], []), style, **options)
    if hollow:
        line.set_markevery([not hollow(*point) for point in points] or None)
        some = [point for point in points if hollow(*point)]
        axes.plot(*zip(*some) if some else ([], []), line.get_marker(), color=line.get_color(), fillstyle="none")
    return line


def legend_below(figure, axes, columns, height=0.08):
    """One legend for all panels, with the lines of `axes`; height as a part of the figure."""
    figure.legend(*axes.get_legend_handles_labels(), loc="lower center", ncol=columns, frameon=False)
    figure.get_layout_engine().set(rect=(0, height, 1, 1 - height))


def leave_out_overlaps(figure, texts):
    """Hides of these texts those that would lie on one before them; how many."""
    figure.canvas.draw()  # the layout
    kept = []
    for text in texts:
        box = text.get_window_extent()
        text.set_visible(not any(box.overlaps(other) for other in kept))
        kept += [box] if text.get_visible() else []
    return len(texts) - len(kept)


def save(figure, path, dpi=85):
    """Writes the figure (format by the name's ending) and closes it."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, dpi=dpi, **({"pil_kwargs": {"optimize": True}} if path.suffix == ".png" else {}))
    except OSError as error:
        raise SystemExit(f"mortise: error: {path}: cannot be written: {error.strerror or error}") from None
    plt.close(figure)


def copy_small(source, target):
    """Copies a PNG with few colours, which suits drawings."""
    target.parent.mkdir(parents=True, exist_ok=True)
    with Image.open(source) as picture:
        picture.convert("RGB").quantize(COLOURS).save(target, optimize=True)
