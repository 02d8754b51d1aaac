"""The charts: error against seconds, a curve a method, a panel an error, and the Pareto front."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from PIL import Image  # matplotlib needs it too
from matplotlib.ticker import LogLocator, NullFormatter

import pareto
from chart_methods import FREEFEM, GRADED, METHODS, PROBLEMS, label

# Okabe and Ito's colours, which colour-blind people tell apart: one for each kind of element or program.
BLUE, SKY, GREEN, ORANGE, RED, PURPLE, BLACK, BROWN = (
    *("#0072B2", "#56B4E9", "#009E73", "#E69F00", "#D55E00", "#CC79A7", "#000000", "#7B4B1A"),
)
STYLES = {  # colour, line, marker
    "q8_linear": (BLUE, "-", "o"),
    "q8_quadratic": (BLUE, "--", "s"),
    "q8_dual": (BLUE, ":", "^"),
    "q8_elements": (BLUE, "-.", "x"),
    "q8_coarser": (BLUE, (0, (5, 2, 1, 2, 1, 2)), "v"),
    "q9_linear": (SKY, "-", "D"),
    "t6_linear": (GREEN, "-", "o"),
    "t6_quadratic": (GREEN, "--", "s"),
    "q4_linear": (ORANGE, "-", "o"),
    "t3_linear": (RED, "-", "o"),
    "q8_ddm": (PURPLE, "-", "+"),
    "q8_ddm_fixed": (PURPLE, "--", "x"),
    "t3_ddm_fixed": (RED, ":", "+"),
    "q8_mssor": (BROWN, "--", "P"),
    "q8_graded": (BROWN, "-", "*"),
    "freefem_p1": (BLACK, ":", "o"),
    "freefem_p2": (BLACK, "--", "s"),
}
PANELS = {
    "manufactured": ("e_p_l2", "e_energy", "e_p_max_inner"),
    "rings": ("e_p_l2", "e_energy", "e_p_max_inner"),
    "parabola_1": ("e_p_l2_inner", "e_energy", "e_p_max_inner"),
}
ERROR_NAMES = {
    "e_p_l2": "contact pressure p, relative $L_2$",
    "e_p_l2_inner": "p without 10 % of the line at each end, relative $L_2$",
    "e_energy": "energy norm, relative",
    "e_p_max_inner": "largest error of p over largest p,\nwithout 10 % of the line at each end",
}


def draw_panel(axes, rows, error):
    front = pareto.front(rows, error)
    axes.plot(
        [row["s_total"] for row in front],
        [row[error] for row in front],
        *("-",),
        color="0.8",
        linewidth=9,
        solid_capstyle="round",
        solid_joinstyle="round",
        zorder=1,
        label="Pareto front",
    )
    for name in (n for n in STYLES if any(row["method"] == n for row in rows)):
        mine = [row for row in rows if row["method"] == name and pareto.usable(row, error)]
        colour, line, marker = STYLES[name]
        axes.plot(
            [row["s_total"] for row in mine],
            [row[error] for row in mine],
            color=colour,
            linestyle=line,
            marker=marker,
            linewidth=2.2 if name == "q8_linear" else 1.1,
            markersize=8 if marker == "*" else 5,
            markerfacecolor=colour if line == "-" else "white",
            zorder=3,
            label=label(name),
        )
    axes.set(xscale="log", yscale="log")
    axes.set_xlabel("seconds, one thread, without meshing and writing", fontsize=9)
    axes.set_title(ERROR_NAMES[error], fontsize=9.5)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(numticks=20))
        axis.set_minor_formatter(NullFormatter())
    axes.grid(True, which="major", color="0.92", linewidth=0.8)
    axes.tick_params(labelsize=8.5)


def draw_problem(path, rows, problem):
    """One picture: the three errors of a problem side by side."""
    figure, panels = plt.subplots(1, 3, figsize=(14, 6.3), layout="constrained")
    for axes, error in zip(panels, PANELS[problem]):
        draw_panel(axes, rows, error)
    panels[0].set_ylabel("relative error", fontsize=9)
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=6, frameon=False, fontsize=9, handlelength=3.6)
    figure.get_layout_engine().set(rect=(0, 0.12, 1, 0.88), w_pad=0.08)
    figure.suptitle(PROBLEMS[problem]["title"], fontsize=11.5)
    figure.savefig(path, dpi=90)
    plt.close(figure)
    with Image.open(path) as picture:
        few_colours = picture.convert("RGB").quantize(64, dither=Image.Dither.NONE)
    few_colours.save(path, optimize=True)


def draw_all(folder, rows):
    """NAME.png for each problem that has rows; returns the names."""
    missing = {*METHODS, *GRADED, *FREEFEM} - set(STYLES)
    assert not missing, f"no style for {missing}"
    drawn = [problem for problem in PROBLEMS if any(row["problem"] == problem for row in rows)]
    for problem in drawn:
        draw_problem(folder / f"{problem}.png", [row for row in rows if row["problem"] == problem], problem)
    return drawn
