"""Iterations: the active set where contact is about to change, and unilateral domain decomposition."""

import figure
import launch
import small_meshes
from failures import OF_MESHES, SPACES, failure, first, of_scene, parameters, quote, select, solved
from plates import even

PERTURBATIONS = [1e-14, 1e-12, 1e-9, 1e-6, 1e-3, 1e-1]
FORCES = [0, 0.1, 0.2, 0.3, 0.5, 1, 1.5, 2, 3, 3.9, 4, 5]
GAP = 1e-4
MESHES = [(20, 25), (39, 51), (40, 50), (80, 100)]
BAR = 10  # steps: what is called many


def geo(part, scene, settings, value, line):
    return of_scene({"part": part, "value": value, "line": line}, scene, settings, "pressure")


def lift(force, space, mesh):
    settings = {"boundary.3.traction": f"[0, {2e6 * force!r}]", "method.multipliers": space}
    settings |= parameters(n_plate=mesh, n_block=mesh * 5 // 4)
    return geo("lift_off", "lift_off", settings, force, f"{space}, {mesh} elements")


def near_gap(perturbation, space):
    """gap_close with the top moved down by the gap times 1 + perturbation."""
    settings = {"boundary.2.displacement": f"{{ y = {-GAP * (1 + perturbation)!r} }}", "method.multipliers": space}
    return geo("near", "gap_close", settings, perturbation, f"gap_close, {space}")


def sideways(share, space):
    """Two plates with 10 MPa from the right, which leaves a flat line without pressure, and `share` of that on top."""
    bodies = small_meshes.plates(lambda x: 0.3, even(7), even(11))
    boundary = [*small_meshes.SLIDING[:2], f'on = "upper_top", pressure = {10e6 * share!r}']
    boundary.append('on = ["upper_right", "lower_right"], pressure = 10e6')
    axes = {"part": "near", "value": share, "line": f"p = 0, {space}"}
    settings, contact = {"method.multipliers": space}, small_meshes.touching()
    return small_meshes.run(axes, bodies, boundary, contact, settings, ["pressure"])


def others(meshes):
    for n, mesh in enumerate(meshes):
        for space in SPACES:
            settings = {"method.multipliers": space}
            yield geo("others", "cosine", {**launch.sizes(mesh), **settings}, n, f"cosine, {space}")
            rings = parameters(n_inner=mesh[0], n_outer=mesh[1], straight=1) | OF_MESHES
            yield geo("others", "rings", {**rings, **settings}, n, f"rings, straight edges, meshes' own gap, {space}")
        yield geo("others", "hertz", {"boundary.2.pressure": 4.6e6 * 4.0**-n}, n, "hertz, loads")


def decomposed(meshes):
    """Unilateral domain decomposition, where contact opens."""
    for n, mesh in enumerate(meshes):
        for acceleration in ("aitken", "krylov"):
            for kind, elements in enumerate(("8-node quadrilaterals", "3-node triangles")):
                settings = {**launch.sizes(mesh), "method.solver": "ddm", "method.acceleration": acceleration}
                settings |= parameters(order=2 - kind, kind=kind)
                yield geo("ddm", "cosine", settings, n, f"{acceleration}, {elements}")


def runs(quick):
    forces, steps, meshes, plates = FORCES, PERTURBATIONS, MESHES, (32, 64)
    if quick:
        forces, steps, meshes, plates = FORCES[::5], PERTURBATIONS[::2], MESHES[:2], (32,)
    values = [*(-value for value in steps), 0, *steps]
    return [
        *(lift(force, space, mesh) for mesh in plates for space in SPACES for force in forces),
        *(make(value, space) for make in (near_gap, sideways) for space in SPACES for value in values),
        *others(meshes),
        *decomposed(meshes),
    ]


def count_of(row):
    return row["interface_steps"] if row["part"] == "ddm" else row["steps"]


def signed(value):
    """A place on an axis of powers of ten of either sign."""
    place = [0, *PERTURBATIONS].index(abs(value))
    return place if value >= 0 else -place


def draw_part(axes, rows, place):
    for number, name in enumerate(dict.fromkeys(row["line"] for row in rows)):
        line = [row for row in select(rows, line=name) if solved(row)]
        style = {"color": f"C{number}", "linewidth": 1.1, "label": name}
        figure.curve(axes, [(place(row["value"]), count_of(row)) for row in line], "-", **style)
        for row in line:
            marker = "x" if row["outcome"] == "not converged" else "o"
            axes.plot(place(row["value"]), count_of(row), marker, color=f"C{number}", markersize=5)


def draw(rows, path):
    drawing, panels = figure.panels(2, 2, (14, 8))
    settings = {  # of the parts' panels
        "lift_off": ("upward force / that of lift_off.toml", "lift_off", "y", {"ylim": (0.8, 200)}),
        "near": ("distance from the onset of opening", "at the onset of opening", "y", {"ylim": (0.8, 200)}),
        "others": ("mesh (hertz: load, a quarter each)", "many places of contact", "", {"ylim": (0, 12)}),
        "ddm": ("mesh", "cosine, unilateral, domain decomposition", "y", {"ylim": (8, 300)}),
    }
    for axes, (part, (x, title, log, more)) in zip(panels.flat, settings.items()):
        draw_part(axes, select(rows, part=part), signed if part == "near" else float)
        y = f"steps of {'domain decomposition' if part == 'ddm' else 'the active set'}"
        figure.label(axes, x, y, title, log, legend={"fontsize": 7}, **more)
    powers = [f"{value:.0e}".replace("e-0", "e-") for value in PERTURBATIONS]
    ticks = [*("-" + text for text in reversed(powers)), "0", *powers]
    panels[0, 1].set_xticks(range(-len(powers), len(powers) + 1), ticks, rotation=60, fontsize=8)
    for axes in panels[1]:
        axes.set_xticks(range(len(MESHES)), [f"{upper}x{lower}" for upper, lower in MESHES])
    figure.save(drawing, path)


def border_failures(rows):
    line = select(rows, part="near")
    ended = {name: select(line, outcome=name) for name in ("solved", "check", "not converged", "refused")}
    cycles, noise = (max((abs(r["value"]) for r in ended[name]), default=None) for name in ("not converged", "check"))
    yield failure(
        "p = 0 and gap = 0 at once: the active set goes round",
        cycles,
        "fixed" if cycles is None else "shown",
        found=cycles is not None,
        steps=max(row["steps"] for row in line if solved(row)),
        said=quote(ended["not converged"]),
        outside=quote(ended["refused"]),
    )
    yield failure(
        "p = 0 and gap = 0 at once: checks of rounding by rounding",
        noise,
        "fixed" if noise is None else "shown",
        found=noise is not None,
        steps=max(row["steps"] for row in ended["solved"]),
        p=max((row["p_max"] for row in ended["check"]), default=0.0),
        checks="; ".join(sorted({row["failed_checks"] for row in ended["check"]})) or "none",
    )


def lift_failure(rows):
    line = select(rows, part="lift_off")
    bad = select(line, outcome="not converged")
    bound = first(bad, "value", solved)
    most = max(row["steps"] for row in line if row["outcome"] in ("solved", "check"))
    return failure("Lift-off to the last point", bound, "shown" if bad else "fixed", most=most, said=quote(bad))


def many_failure(rows):
    line = select(rows, part="others")
    most, bad = max(row["steps"] for row in line), len(select(line, outcome="not converged"))
    state = "fixed" if not bad and most <= BAR else "shown"
    return failure("Many places of contact", float(bad) or None, state, most=most, bad=bad, count=len(line))


def ddm_failure(rows):
    krylov, aitken = ([r for r in select(rows, part="ddm") if r["line"].startswith(n)] for n in ("krylov", "aitken"))
    bad, failed = (select(line, outcome="not converged") for line in (krylov, aitken))
    return failure(
        "Unilateral domain decomposition",
        float(len(failed)),
        "shown" if bad else "default",
        bad=len(bad),
        count=len(krylov),
        most=max(map(count_of, krylov)),
        failed=len(failed),
        of_aitken=len(aitken),
        said=quote(failed),
    )


def failures(rows):
    return [*border_failures(rows), lift_failure(rows), many_failure(rows), ddm_failure(rows)]
