"""The two pictures of docs/accuracy.md."""

import numpy as np

import figure
from accuracy_runs import ASKED
from judge_answers import zones

MEGA = 1e6


def band(axes, row, colour, label):
    """p of a row along its line, with its bars."""
    s, p, bar = (np.array(row["line"][key]) for key in ("s", "p", "p_error"))
    s, p, bar = s[::2], p[::2] / MEGA, bar[::2] / MEGA
    axes.fill_between(s, p - bar, p + bar, color=colour, alpha=0.25, linewidth=0)
    axes.plot(s, p, ".-", color=colour, linewidth=1, markersize=4, label=label)


def draw_band(asked, even, path):
    """p with its band: asked for 1 %, and on even meshes of about as many unknowns."""
    drawing, (whole, near) = figure.panels(1, 2, (11, 4.2))
    length, excluded = asked["line"]["s"][-1], zones(asked)[1]
    for axes, limits in ((whole, (0, length)), (near, (0, 0.4 * length))):
        band(axes, even, "C1", f"even meshes, {even['mesh']['dofs']} unknowns")
        unknowns = asked["accuracy"]["solves"][asked["accuracy"]["answer"] - 1]["unknowns"]
        band(axes, asked, "C0", f"--accuracy 1%, {unknowns} unknowns")
        for at in (0, length - excluded):
            axes.axvspan(at, at + excluded, color="0.5", alpha=0.15, linewidth=0)
        axes.set_xlim(*limits)
    place, unit = "along the contact line, m", "p, MPa"
    figure.label(whole, place, unit, "p and its bars; grey: left out", ylim=(0, 25), legend=True)
    figure.label(near, place, unit, "the left part, enlarged", ylim=(7.5, 10.5))
    figure.save(drawing, path)


def draw_answers(rows, path):
    """Asked against got and against estimated; every point is an answer, those of one accuracy side by side."""
    drawing, panels = figure.panels(1, 2, (11, 4.8), sharey=True)
    for axes, key, title in zip(panels, ("got", "estimated"), ("true error, at the nodes", "estimated error")):
        for number, scene in enumerate(name for name in ASKED if any(row["scene"] == name for row in rows)):
            some = [row for row in rows if row["scene"] == scene and not row["failed"]]
            aside = 1.09 ** (number - 4.5)
            asked = [row["asked"] * aside for row in some]
            axes.plot(asked, [row[key] for row in some], ".", color=f"C{number}", markersize=6, label=scene)
        for asked in {row["asked"] for row in rows}:
            axes.plot([asked / 1.6, asked * 1.6], [asked, asked], "k-", linewidth=1)
        figure.label(axes, "asked", "relative rms of p" if key == "got" else None, title, "xy")
    panels[0].plot([], [], "k-", linewidth=1, label="as asked")
    figure.legend_below(drawing, panels[0], 6, 0.13)
    figure.save(drawing, path)
