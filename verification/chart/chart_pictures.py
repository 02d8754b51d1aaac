"""The charts: error against seconds, a curve a method, a panel an error, and the Pareto front."""

from matplotlib.ticker import LogLocator, NullFormatter

import chart_runs  # makes common/ known
import figure
import pareto
from chart_methods import ASKED, GRADED, METHODS, PANELS, PEERS, PROBLEMS, label

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
    "asked": (BLACK, "-", "X"),
    "freefem_p1": (BLACK, ":", "o"),
    "freefem_p2": (BLACK, "--", "s"),
    "getfem_q8": (BLACK, "-.", "D"),
}
ERROR_NAMES = {
    "e_p_l2": "contact pressure p, relative $L_2$",
    "e_p_l2_inner": "p without 10 % of the line at each end, relative $L_2$",
    "e_energy": "energy norm, relative",
    "e_p_max_inner": "largest error of p over largest p,\nwithout 10 % of the line at each end",
}


def draw_panel(axes, rows, error):
    points = lambda some: [(row["s_total"], row[error]) for row in some]
    front = {"color": "0.8", "linewidth": 9, "solid_capstyle": "round", "solid_joinstyle": "round", "zorder": 1}
    figure.curve(axes, points(pareto.front(rows, error)), "-", label="Pareto front", **front)
    for name in (n for n in STYLES if any(row["method"] == n for row in rows)):
        mine = [row for row in rows if row["method"] == name and pareto.usable(row, error)]
        colour, line, marker = STYLES[name]
        style = {"color": colour, "linestyle": line, "marker": marker, "markersize": 8 if marker == "*" else 5}
        style["markerfacecolor"] = colour if line == "-" else "white"
        style["linewidth"] = 2.2 if name == "q8_linear" else 1.1
        axes.plot(*zip(*points(mine)) if mine else ([], []), zorder=3, label=label(name), **style)
    figure.label(axes, "seconds, one thread, without meshing and writing", title=ERROR_NAMES[error], log="xy")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(numticks=20))
        axis.set_minor_formatter(NullFormatter())


def draw_problem(path, rows, problem):
    """One picture: the three errors of a problem side by side."""
    drawing, panels = figure.panels(1, 3, (14, 6.3))
    for axes, error in zip(panels, PANELS[problem]):
        draw_panel(axes, rows, error)
    panels[0].set_ylabel("relative error")
    figure.legend_below(drawing, panels[0], 6, 0.12)
    drawing.suptitle(PROBLEMS[problem]["title"], fontsize=11.5)
    figure.save(drawing, path, 90)


def draw_all(folder, rows):
    """NAME.png for each problem that has rows."""
    missing = {*METHODS, *GRADED, *ASKED, *PEERS} - set(STYLES)
    assert not missing, f"no style for {missing}"
    for problem in PROBLEMS:
        if mine := [row for row in rows if row["problem"] == problem]:
            draw_problem(folder / f"{problem}.png", mine, problem)
