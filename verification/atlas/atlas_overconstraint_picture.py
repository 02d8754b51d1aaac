"""The picture of the study of over-constraint: how each case ends, and the error at an edge that is hardly covered."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap

from atlas_regions import solved

COLOURS = ["#3b9a4f", "#b5d99c", "#d9d9d9", "#5b8fc9", "#f2b134", "#c4262e"]  # of the verdicts


def draw_cases(axes, rows, verdicts):
    names = list(dict.fromkeys(row["case"] for row in rows if row["part"] == "case"))
    columns = list(dict.fromkeys((row["side"], row["space"]) for row in rows if row["part"] == "case"))
    table = np.full((len(names), len(columns)), 2)
    for row in rows:
        if row["part"] == "case":
            at = names.index(row["case"]), columns.index((row["side"], row["space"]))
            table[at] = verdicts.index(row["verdict"])
    axes.imshow(table, cmap=ListedColormap(COLOURS), vmin=-0.5, vmax=len(COLOURS) - 0.5, aspect="auto")
    axes.set_yticks(range(len(names)), names, fontsize=8.5)
    axes.set_xticks(
        range(len(columns)),
        [f"{space}\n{'upper' if side == 'upper_bottom' else 'lower'}" for side, space in columns],
        fontsize=8,
    )
    axes.set_xticks(np.arange(len(columns) + 1) - 0.5, minor=True)
    axes.set_yticks(np.arange(len(names) + 1) - 0.5, minor=True)
    axes.grid(which="minor", color="white", linewidth=2)
    axes.tick_params(which="both", length=0)
    axes.set_xlabel("multipliers: space, and the body whose curve carries them", fontsize=9)
    handles = [plt.Rectangle((0, 0), 1, 1, color=colour) for colour in COLOURS]
    axes.legend(handles, verdicts, loc="lower center", bbox_to_anchor=(0.3, 1.01), ncol=3, fontsize=8, frameon=False)


def draw_covered(axes, rows, limit):
    for number, space in enumerate(dict.fromkeys(row["space"] for row in rows)):
        part = [row for row in rows if row["part"] == "covered" and row["space"] == space and solved(row)]
        axes.plot(
            [r["value"] for r in part],
            [max(r["p_error"], 1e-16) for r in part],
            "-",
            color=f"C{number}",
            label=f"{space}, all nodes",
        )
        axes.plot(
            [r["value"] for r in part],
            [max(r["p_error_facing"], 1e-16) for r in part],
            "--",
            color=f"C{number}",
            label=f"{space}, where it faces",
        )
        for row in part:
            fill = "none" if row["failed_checks"] else f"C{number}"
            axes.plot(
                row["value"], max(row["p_error"], 1e-16), "o", color=f"C{number}", markerfacecolor=fill, markersize=4.5
            )
    axes.axhline(limit, color="0.4", linestyle=":", linewidth=0.9)
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="fraction q of the last edge that faces the other side",
        ylabel="largest relative error of p",
    )
    axes.grid(alpha=0.25)
    axes.legend(fontsize=8)


def draw(rows, path, verdicts, limit):
    figure, (left, right) = plt.subplots(1, 2, figsize=(13.5, 5.6), width_ratios=(1.25, 1), layout="constrained")
    draw_cases(left, rows, verdicts)
    draw_covered(right, rows, limit)
    figure.savefig(path, dpi=85)
    plt.close(figure)
