#!/usr/bin/python3
"""Residuals of domain decomposition step by step, of one or several runs.

Usage: history.py RESULTS [RESULTS ...] PICTURE

RESULTS are folders that `mortise solve` wrote with method.solver = "ddm"; read are iteration.csv and summary.json.
PICTURE is a .png, .pdf or .svg.
"""

import json
from pathlib import Path

from matplotlib.ticker import MaxNLocator

import figure
import result_tables
from script import Parser, run


def read(folder):
    """Columns of iteration.csv."""
    return result_tables.columns(folder / "iteration.csv")


def describe(folder):
    """The method of a run, and how it ended."""
    summary = json.loads((folder / "summary.json").read_text())
    run = summary["iteration"]
    beta = f", $\\beta$ {run['beta']:.3g}" if run.get("beta", 0) > 0 else ""
    roles = f", displacement on {', '.join(summary['method']['dirichlet'])}"
    roles = roles if run["method"] == "neumann_dirichlet" else ""
    ended = "" if summary["status"] != "not_converged" else ", not converged"
    return f"{run['method']}, {run['acceleration']}{beta}{roles}{ended}"


def draw(lines, path, dpi=130):
    """`lines`: label and columns of each run."""
    drawing, axes = figure.panels(1, 1, (8, 4.6 + 0.22 * len(lines)))
    for k, (label, columns) in enumerate(lines):
        force, kinematic = ([*zip(columns["step"], columns[name])] for name in ("force", "kinematic"))
        style = "o-" if len(force) <= 60 else "-"
        figure.curve(axes, force, style, color=f"C{k}", markersize=3, label=label)
        figure.curve(axes, kinematic, "--", color=f"C{k}", linewidth=1)
    axes.plot([], [], color="0.3", label="solid: force condition")
    axes.plot([], [], "--", color="0.3", linewidth=1, label="dashed: kinematic condition")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    legend = {"loc": "lower left", "bbox_to_anchor": (0, 1), "frameon": False}
    figure.label(axes, "step", "relative residual", log="y", legend=legend)
    figure.save(drawing, path, dpi)


def main():
    parser = Parser(__doc__)
    parser.add_argument("folders", type=Path, nargs="+", metavar="RESULTS")
    parser.add_argument("picture", type=Path, metavar="PICTURE")
    options = parser.parse_args()
    for folder in options.folders:
        if not (folder / "iteration.csv").is_file():
            parser.error(f"{folder}: no iteration.csv there; expected the folder of a run with method.solver = \"ddm\"")
    draw([(f"{f.resolve().name}: {describe(f)}", read(f)) for f in options.folders], options.picture)
    print(options.picture)


if __name__ == "__main__":
    run(main)
