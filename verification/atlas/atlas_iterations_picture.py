"""The picture of the study of iterations."""

import matplotlib.pyplot as plt

from atlas_regions import solved


def of_part(rows, part):
    return [row for row in rows if row["part"] == part]


def count_of(row):
    return row["interface_steps"] if row["part"] == "ddm" else row["steps"]


def draw_part(axes, rows, part, place=lambda value: value):
    for number, name in enumerate(dict.fromkeys(row["line"] for row in of_part(rows, part))):
        line = sorted(
            (row for row in of_part(rows, part) if row["line"] == name and solved(row)), key=lambda row: row["value"]
        )
        x = [place(row["value"]) for row in line]
        axes.plot(x, [count_of(row) for row in line], "-", color=f"C{number}", linewidth=1.1, label=name)
        for at, row in zip(x, line):
            axes.plot(
                at, count_of(row), "x" if row["outcome"] == "not converged" else "o", color=f"C{number}", markersize=5
            )
    axes.legend(fontsize=7)
    axes.grid(alpha=0.25)


def draw_region(axes, rows):
    found = [row for row in of_part(rows, "region") if row["dirichlet"] == "upper"]
    for outcome, marker, colour in (("converged", "o", "C0"), ("unfinished", ".", "0.5"), ("diverged", "x", "#c00000")):
        some = [row for row in found if row["outcome"] == outcome]
        axes.plot(
            [row["ratio"] for row in some],
            [row["beta"] for row in some],
            marker,
            color=colour,
            markersize=3,
            label=outcome,
        )
    limit = sorted({(row["ratio"], 2 / row["mu_largest"]) for row in found})
    axes.plot(*zip(*limit), "k-", linewidth=1.2, label=r"$2/\mu_{max}$")
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="$E_{upper}/E_{lower}$, upper body takes the displacement",
        ylabel=r"relaxation $\beta$",
    )
    axes.legend(fontsize=7, loc="lower left")
    axes.grid(alpha=0.25)


def signed(value, perturbations):
    """A place on an axis of powers of ten of either sign."""
    powers = [0, *perturbations]
    place = powers.index(abs(value))
    return place if value >= 0 else -place


def draw(rows, path, perturbations, meshes):
    figure = plt.figure(figsize=(14, 8), layout="constrained")
    grid = figure.add_gridspec(2, 6)
    lift_axes, near_axes, other_axes = (figure.add_subplot(grid[0, 2 * k : 2 * k + 2]) for k in range(3))
    ddm_axes, region_axes = (figure.add_subplot(grid[1, 3 * k : 3 * k + 3]) for k in range(2))
    draw_part(lift_axes, rows, "lift_off")
    lift_axes.set(xlabel="upward force / that of lift_off.toml", title="lift_off", yscale="log", ylim=(0.8, 200))
    draw_part(near_axes, rows, "near", lambda value: signed(value, perturbations))
    ticks = range(-len(perturbations), len(perturbations) + 1)
    powers = [f"{v:.0e}".replace("e-0", "e-") for v in perturbations]
    near_axes.set_xticks(ticks, [*("-" + text for text in reversed(powers)), "0", *powers], rotation=60, fontsize=8)
    near_axes.set(
        xlabel="distance from the onset of opening", title="at the onset of opening", yscale="log", ylim=(0.8, 200)
    )
    draw_part(other_axes, rows, "others")
    other_axes.set(xlabel="mesh (hertz: load, a quarter each)", title="many places of contact", ylim=(0, 12))
    draw_part(ddm_axes, rows, "ddm")
    ddm_axes.set(xlabel="mesh", title="cosine, unilateral, domain decomposition", yscale="log", ylim=(8, 300))
    for axes in (other_axes, ddm_axes):
        axes.set_xticks(range(len(meshes)), [f"{upper}x{lower}" for upper, lower in meshes])
    for axes in (lift_axes, near_axes, other_axes):
        axes.set_ylabel("steps of the active set")
    ddm_axes.set_ylabel("steps of domain decomposition")
    draw_region(region_axes, rows)
    region_axes.set_title("relaxation with a fixed beta, parabola_1")
    figure.savefig(path, dpi=80)
    plt.close(figure)
