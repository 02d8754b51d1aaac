"""The picture of the study of geometry: a panel for each part."""

import matplotlib.pyplot as plt

from atlas_regions import solved


def of_part(rows, part, **axes):
    return [row for row in rows if row["part"] == part and all(row.get(key) == value for key, value in axes.items())]


def draw_line(axes, line, label, figure, marker="o", style="-", colour=None):
    """One curve over `value`; open where a check fails, crosses where the run is refused."""
    line = sorted(line, key=lambda row: row["value"])
    good = [row for row in line if solved(row) and row.get(figure) is not None]
    values = [max(row[figure], 1e-16) for row in good]
    (drawn,) = axes.plot([row["value"] for row in good], values, style, color=colour, label=label, linewidth=1.2)
    for row, value in zip(good, values):
        fill = "none" if row["failed_checks"] else drawn.get_color()
        axes.plot(row["value"], value, marker, color=drawn.get_color(), markerfacecolor=fill, markersize=4.5)
    refused = [row["value"] for row in line if not solved(row)]
    axes.plot(refused, [30.0] * len(refused), "x", color=drawn.get_color())


def draw_kinks(axes, rows):
    for number, name in enumerate(dict.fromkeys(row["line"] for row in of_part(rows, "kink"))):
        for side, style in (("upper_bottom", "-"), ("lower_top", "--")):
            label = name if style == "-" else None
            draw_line(
                axes, of_part(rows, "kink", line=name, side=side), label, "p_error", style=style, colour=f"C{number}"
            )
    axes.set(xlabel="slope at the kinks, degrees (dashed: multipliers below)", yscale="log", title="kinks")


def draw_walls(axes, rows):
    for number, kind in enumerate(("sliding", "clamped")):
        counts = sorted({row["count"] for row in of_part(rows, "wall", line=kind)})[1:]
        for count, style in zip(counts, ("--", "-")):
            label = f"{kind}, {count // 2} to {count} elements"
            draw_line(
                axes, of_part(rows, "wall", line=kind, count=count), label, "growth", style=style, colour=f"C{number}"
            )
    axes.axhline(1, color="0.6", linewidth=0.8)
    axes.set(
        xlabel="slope of the line at the walls, degrees",
        ylabel="largest p, over that on the coarser mesh",
        title="fixed walls",
    )
    axes.set_ylim(0.6, 3)


def draw_rings(axes, rows):
    for number, edges in enumerate(("linear", "straight quadratic", "curved quadratic")):
        for gap, style in (("closed", "-"), ("measured", "--")):
            line = of_part(rows, "rings", line=f"{edges}, {gap}")
            draw_line(axes, line, f"{edges}, {gap}", "p_error", style=style, colour=f"C{number}")
    axes.set(
        xlabel="elements on the quarter circle",
        xscale="log",
        yscale="log",
        ylim=(1e-12, 10),
        title="rings: edges and gap",
    )
    axes.set_xticks([4, 8, 16, 32, 64], ["4", "8", "16", "32", "64"])
    axes.minorticks_off()


def draw_cosine(axes, rows):
    for number, space in enumerate(("linear", "quadratic", "dual")):
        for side, style in (("upper_bottom", "-"), ("lower_top", "--")):
            label = space if style == "-" else None
            draw_line(
                axes, of_part(rows, "cosine", line=space, side=side), label, "p_error", style=style, colour=f"C{number}"
            )
    axes.set(
        xlabel="elements a period (dashed: multipliers below)", xscale="log", yscale="log", title="curvature: cosine"
    )
    axes.set_xticks([1, 2, 4, 8, 16], ["1", "2", "4", "8", "16"])
    axes.minorticks_off()


def draw_slivers(axes, rows, name, title):
    for space in ("linear", "quadratic", "dual"):
        draw_line(axes, of_part(rows, "sliver", line=f"{name}, {space}"), space, "p_error")
    axes.set(xlabel="fraction of an element", xscale="log", yscale="log", ylim=(1e-15, 2), title=title)


def draw(rows, path, limit):
    figure, panels = plt.subplots(2, 3, figsize=(13, 7.4), layout="constrained")
    (kinks, walls, rings), (cosine, slivers, out) = panels
    draw_kinks(kinks, rows)
    draw_walls(walls, rows)
    draw_rings(rings, rows)
    draw_cosine(cosine, rows)
    draw_slivers(slivers, rows, "vertices missed", "vertices that miss each other")
    draw_slivers(out, rows, "sticking out", "one line sticks out past the other")
    for axes in panels.flat:
        axes.grid(alpha=0.25)
        axes.title.set_fontsize(10)
        axes.legend(fontsize=7.5)
        if axes is not walls:
            axes.axhline(limit, color="0.4", linestyle="--", linewidth=0.9)
            axes.set_ylabel("largest relative error of p")
    figure.savefig(path, dpi=85)
    plt.close(figure)
