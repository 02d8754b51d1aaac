#!/usr/bin/python3
"""Residuals of domain decomposition step by step, of one or several runs.

Usage: history.py RESULTS [RESULTS ...] [PICTURE] [--dpi DPI]

RESULTS are folders that `mortise solve` wrote with method.solver = "ddm"; read are iteration.csv and summary.json.
PICTURE is a .png, .pdf or .svg, by default RESULTS-history.png beside the first folder.
"""

import argparse
import csv
import json
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import MaxNLocator

PICTURES = (".png", ".pdf", ".svg")
COLOURS = plt.get_cmap("tab10").colors


def read_history(folder):
    """Columns of iteration.csv."""
    with open(folder / "iteration.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def describe(folder):
    """Name of the folder and the method of its run."""
    summary = json.loads((folder / "summary.json").read_text())
    run = summary["iteration"]
    beta = f", $\\beta$ {run['beta']:.3g}" if run.get("beta", 0) > 0 else ""
    roles = f", displacement on {', '.join(summary['method']['dirichlet'])}" if run["method"] == "neumann_dirichlet" else ""
    ended = "" if summary["status"] != "not_converged" else ", not converged"
    return f"{folder.resolve().name}: {run['method']}, {run['acceleration']}{beta}{roles}{ended}"


def draw(folders, picture, dpi=130):
    figure, axes = plt.subplots(figsize=(8, 4.6 + 0.22 * len(folders)), layout="constrained")
    for k, folder in enumerate(folders):
        history, colour = read_history(folder), COLOURS[k % len(COLOURS)]
        marker = "o" if len(history["step"]) <= 60 else None
        axes.plot(history["step"], history["force"], color=colour, marker=marker, markersize=3, label=describe(folder))
        axes.plot(history["step"], history["kinematic"], "--", color=colour, linewidth=1)
    axes.plot([], [], color="0.3", label="solid: force condition")
    axes.plot([], [], "--", color="0.3", linewidth=1, label="dashed: kinematic condition")
    axes.set_yscale("log")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_xlabel("step")
    axes.set_ylabel("relative residual")
    axes.grid(color="0.9", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.legend(loc="lower left", bbox_to_anchor=(0, 1), frameon=False, fontsize=8)
    figure.savefig(picture, dpi=dpi)
    plt.close(figure)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("paths", type=Path, nargs="+", metavar="RESULTS", help="folders, and at last the picture")
    parser.add_argument("--dpi", type=int, default=130)
    options = parser.parse_args(arguments)
    *folders, last = options.paths
    picture = last if last.suffix.lower() in PICTURES else None
    folders = folders if picture else options.paths
    if not folders:
        parser.error("no folder of results given")
    for folder in folders:
        if not (folder / "iteration.csv").is_file():
            parser.error(f"{folder}: no iteration.csv there; expected the folder of a run with method.solver = \"ddm\"")
    picture = picture or folders[0].with_name(folders[0].resolve().name + "-history.png")
    draw(folders, picture, options.dpi)
    print(picture)


if __name__ == "__main__":
    main()
