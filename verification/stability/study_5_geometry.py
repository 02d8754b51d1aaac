"""Geometry: kinks, walls, straight edges on curves, gaps, curvature, slivers."""

import math

import figure
from failures import OF_MESHES, SPACES, checks_of, draw_line, ends, failure, first, largest, last, of_scene, over
from failures import parameters, quote, select, silent, solved, told, warned
from plates import even
from small_meshes import PRESSED, SLIDING, WIDTH, plates, run, touching

LIMIT = 0.01
EXACT = 1e-8  # an error of p that is none
HYDROSTATIC = [
    *SLIDING[:2],
    'on = ["upper_top", "upper_right", "lower_right"], pressure = 10e6',
]
KINKS = [5, 15, 30, 45, 60, 70, 75, 80, 85]
KINK_MESHES = {"vertex in both": (16, 24), "vertex in one": (17, 24), "vertex in none": (17, 23)}
WALL_ANGLES = [0, 15, 30, 45, 60, 70, 75]
WALL_COUNTS = [8, 16, 32]
WALLS = {"sliding": PRESSED[0], "clamped": PRESSED[0].replace("x = 0", "x = 0, y = 0")}
RING_COUNTS = [4, 8, 16, 32, 64]
RING_EDGES = {"linear": {"order": 1}, "straight quadratic": {"straight": 1}, "curved quadratic": {}}
CLOSED = {"contact.0.initial_gap": "closed"}
GAPS = {"default": {}, "closed": CLOSED, "meshes' own": OF_MESHES}
PERIODS = [1, 1.5, 2, 3, 4, 6, 8, 16, 32, 64]
COSINES = [("linear", "default"), ("linear", "meshes' own"), *((space, "closed") for space in SPACES)]
KINK_GAPS, RING_GAPS = ("default", "closed"), ("default", "meshes' own")
SLIVERS = [10.0**-k for k in range(1, 15)]
SIDES = ["upper_bottom", "lower_top"]


def tent(angle):
    """A rise between two kinks and a top at x = 0.3, 0.5 and 0.4."""
    slope = math.tan(math.radians(angle))
    return lambda x: 0.3 + slope * max(0.0, 0.1 - abs(x - 0.4))


def kink(angle, name, side, gap="default"):
    upper, lower = (even(count) for count in KINK_MESHES[name])
    bodies = plates(tent(angle), upper, lower, top=0.6 + 0.1 * math.tan(math.radians(angle)))
    axes = {"part": "kink", "value": angle, "line": f"{name}, {gap}", "side": side}
    return run(axes, bodies, HYDROSTATIC, touching(multipliers=side), GAPS[gap], ["uniform", "pressure"])


def wall(angle, kind, count):
    slope = math.tan(math.radians(angle))
    bottom = 0.3 + WIDTH / 2 * slope
    bodies = plates(lambda x: bottom + slope * (x - WIDTH / 2), even(count), even(count * 5 // 4), top=2 * bottom)
    axes = {"part": "wall", "value": angle, "line": kind, "count": count}
    return run(axes, bodies, [WALLS[kind], *PRESSED[1:]], touching(condition="bilateral"), measures=["pressure"])


def rings(count, edges, gap):
    axes = {"part": "rings", "value": count, "line": f"{edges}, {gap}"}
    settings = parameters(**RING_EDGES[edges], n_inner=count, n_outer=count * 5 // 4) | GAPS[gap]
    return of_scene(axes, "rings", settings, "rings")


def cosine(count, space, gap, side):
    """`count` elements of the upper body a period, 5 / 4 of that of the lower one; two periods, amplitude 0.1 m."""
    curve = lambda x: 0.3 + 0.1 * math.cos(math.pi * (x + 0.4) / 0.2)
    bodies = plates(curve, even(round(2 * count)), even(round(2.5 * count)))
    axes = {"part": "cosine", "value": count, "line": f"{space}, {gap}", "side": side}
    settings = {"method.multipliers": space, **GAPS[gap]}
    return run(axes, bodies, HYDROSTATIC, touching(multipliers=side), settings, ["uniform", "pressure"])


def sliver(eps, space):
    """The inner vertices of the upper body miss those of the lower one by `eps` of an element."""
    count = 8
    columns = [i / count if i in (0, count) else (i + eps) / count for i in range(count + 1)]
    bodies = plates(lambda x: 0.3, columns, even(count))
    axes = {"part": "sliver", "value": eps, "line": f"vertices missed, {space}"}
    return run(axes, bodies, HYDROSTATIC, touching(), {"method.multipliers": space}, ["uniform"])


def sticking_out(eps, space):
    """The upper body stands `eps` of an element to the right: it sticks out there, the lower one on the left."""
    lower, upper = plates(lambda x: 0.3, even(8), even(8))
    bodies = [lower, upper.put(lambda x, y: (x + eps * WIDTH / 8, y))]
    axes = {"part": "sliver", "value": eps, "line": f"sticking out, {space}"}
    return run(axes, bodies, HYDROSTATIC, touching(), {"method.multipliers": space}, ["uniform"])


def runs(quick):
    some = (lambda values: ends(values, 4)) if quick else (lambda values: values)
    walls, counts = (WALL_COUNTS[:2], RING_COUNTS[:2]) if quick else (WALL_COUNTS, RING_COUNTS)
    return [
        *(kink(a, name, side, gap) for name in KINK_MESHES for gap in KINK_GAPS for side in SIDES for a in some(KINKS)),
        *(wall(angle, kind, count) for kind in WALLS for count in walls for angle in some(WALL_ANGLES)),
        *(rings(n, edges, gap) for edges in RING_EDGES for gap in RING_GAPS for n in counts),
        *(cosine(count, *kind, side) for kind in COSINES for side in SIDES for count in some(PERIODS)),
        *(sliver(eps, space) for space in SPACES for eps in some(SLIVERS)),
        *(sticking_out(eps, space) for space in SPACES for eps in some(SLIVERS)),
    ]


def complete(rows):
    """growth: of the largest p from one mesh to the next finer one (part wall)."""
    walls = [row for row in select(rows, part="wall") if solved(row)]
    p_max = {(row["line"], row["value"], row["count"]): row["p_max"] for row in walls}
    for row in walls:
        if (coarser := (row["line"], row["value"], row["count"] // 2)) in p_max:
            row["growth"] = row["p_max"] / p_max[coarser]
    return rows


def draw_part(axes, rows, label, key="p_error", **options):
    """One curve over `value`; open where a check fails or p is warned of, crosses where the run is refused."""
    line = draw_line(axes, rows, "value", key, hollow=warned, least=1e-16, label=label, linewidth=1.2, **options)
    refused = [row["value"] for row in rows if not solved(row)]
    axes.plot(refused, [30.0] * len(refused), "x", color=line.get_color())


def worse_side(rows):
    """Of the runs with the multipliers on either side, the one whose p is off by more."""
    worst = {}
    for row in sorted(rows, key=lambda row: row.get("p_error") or 0):
        worst[row["line"], row["value"]] = row
    return list(worst.values())


def draw(rows, path):
    drawing, panels = figure.panels(2, 3, (13, 7.4))
    (kinks, walls, ring_axes), (cosines, slivers, out) = panels
    part = lambda name: select(rows, part=name)
    for number, name in enumerate(KINK_MESHES):
        for gap, style in zip(KINK_GAPS, ("o-", "o--")):
            line = worse_side(select(part("kink"), line=f"{name}, {gap}"))
            draw_part(kinks, line, f"{name}, {gap}", style=style, color=f"C{number}")
    for number, kind in enumerate(WALLS):
        counts = sorted({row["count"] for row in part("wall")})[1:]
        for count, style in zip(counts, ("o--", "o-")):
            label = f"{kind}, {count // 2} to {count} elements"
            line = select(part("wall"), line=kind, count=count)
            draw_part(walls, line, label, "growth", style=style, color=f"C{number}")
    walls.axhline(1, color="0.6", linewidth=0.8)
    for number, edges in enumerate(RING_EDGES):
        for gap, style in zip(RING_GAPS, ("o-", "o--")):
            name = f"{edges}, {gap}"
            draw_part(ring_axes, select(part("rings"), line=name), name, style=style, color=f"C{number}")
    for space, gap in COSINES:
        style = "o--" if gap == "closed" else "o-"
        draw_part(cosines, worse_side(select(part("cosine"), line=f"{space}, {gap}")), f"{space}, {gap}", style=style)
    for axes, name in ((slivers, "vertices missed"), (out, "sticking out")):
        for space in SPACES:
            draw_part(axes, select(part("sliver"), line=f"{name}, {space}"), space)
    slope, fraction = "slope at the kinks, degrees", "fraction of an element"
    settings = [
        (kinks, slope, "kinks, of which only the meshes are known", "y", {"ylim": (1e-15, 5e3)}),
        (walls, "slope of the line at the walls, degrees", "fixed walls", "", {"ylim": (0.6, 3)}),
        (ring_axes, "elements on the quarter circle", "rings: edges and gap", "xy", {"ylim": (1e-12, 10)}),
        (cosines, "elements a period", "cosine, of which only the meshes are known", "xy", {}),
        (slivers, fraction, "vertices that miss each other", "xy", {"ylim": (1e-15, 2)}),
        (out, fraction, "one line sticks out past the other", "xy", {"ylim": (1e-15, 2)}),
    ]
    for axes, x, title, log, more in settings:
        y = "largest p, over that on the coarser mesh" if axes is walls else "largest relative error of p"
        limit = None if axes is walls else LIMIT
        figure.label(axes, x, y, title, log, limit, {"fontsize": 7.5}, **more)
    for axes, ticks in ((ring_axes, RING_COUNTS), (cosines, [1, 2, 4, 8, 16, 32, 64])):
        axes.set_xticks(ticks, map(str, ticks))
        axes.minorticks_off()
    figure.save(drawing, path)


def kink_failures(rows):
    of = {gap: [row for row in select(rows, part="kink") if row["line"].endswith(gap)] for gap in KINK_GAPS}
    both = {gap: [row for row in line if "in both" in row["line"]] for gap, line in of.items()}
    bad = [row for row in both["default"] if over(EXACT)(row)]
    yield failure(
        "Kinks with a vertex in both meshes",
        last(bad, "value", solved),
        told(bad),
        steepest=max(row["value"] for row in both["default"]),
        worst=largest(both["default"], "p_error"),
        least=largest([row for row in both["default"] if row not in bad], "p_error"),
        closed=largest(both["closed"], "p_error"),
    )
    default, closed = ([row for row in of[gap] if row not in both[gap]] for gap in KINK_GAPS)
    bad = [row for row in default if over(LIMIT)(row)]
    yield failure(
        "Kinks that a mesh cuts short",
        first(default, "value", over(LIMIT)),
        told(bad),
        limit=LIMIT,
        worst=largest(default, "p_error"),
        closed=first(closed, "value", over(LIMIT)),
        closed_worst=largest(closed, "p_error"),
        silent=len(silent(bad)),
        said=quote(default),
    )


def wall_failure(rows):
    line = select(rows, part="wall", count=max(row["count"] for row in select(rows, part="wall")))
    line = [row for row in line if solved(row)]
    bounds, values = [], {}
    for kind in WALLS:
        values[kind] = first(select(line, line=kind), "value", over(1.1, "growth"))
        values[f"{kind}_most"] = last(select(line, line=kind), "growth", solved)
        bounds += [values[kind]] if values[kind] else []
    grown = [row for row in line if over(1.1, "growth")(row)]
    named = [row for row in grown if (row["pressure_exponent"] or 1) < 1]
    state = "shown" if len(named) == len(grown) else "open"
    values |= {"grown": len(grown), "named": len(named)}
    return failure("Fixed walls at an angle", min(bounds, default=None), state, **values)


def ring_failures(rows):
    line = lambda edges, gap: select(rows, part="rings", line=f"{edges}, {gap}")
    finest = max(row["value"] for row in line("linear", "default"))
    at_finest = {edges: select(line(edges, "default"), value=finest)[0]["p_error"] for edges in RING_EDGES}
    bad = [row for edges in RING_EDGES for row in line(edges, "meshes' own") if over(LIMIT)(row)]
    bounds = {edges: last(line(edges, "meshes' own"), "value", over(LIMIT)) for edges in RING_EDGES}
    words = [f"{edges} edges{f' up to {n:g} elements' if n else ': not found'}" for edges, n in bounds.items()]
    default = [row for edges in RING_EDGES for row in line(edges, "default")]
    yield failure(
        "Straight edges on a curve",
        last(default, "value", over(LIMIT)),
        told([row for row in default if over(LIMIT)(row)]) if any(map(over(LIMIT), default)) else "default",
        limit=LIMIT,
        finest=finest,
        most=largest(default, "p_error"),
        linear=at_finest["linear"],
        straight=at_finest["straight quadratic"],
        curved=at_finest["curved quadratic"],
        edges="; ".join(words),
        silent=len(silent(bad)),
        count=len(bad),
    )


def cosine_failure(rows):
    rows = [row for row in select(rows, part="cosine") if row["value"] > 1]
    of = {gap: select(rows, line=f"linear, {gap}") for gap in GAPS}
    bad = [row for row in of["default"] if over(LIMIT)(row)]
    spaces = {space: last(select(rows, line=f"{space}, closed"), "value", over(LIMIT)) for space in SPACES}
    return failure(
        "Few elements on a curve of which only the meshes are known",
        last(bad, "value", solved),
        told(bad),
        limit=LIMIT,
        finest=max(PERIODS),
        at_finest=largest(select(of["default"], value=max(PERIODS)), "p_error"),
        own=last(of["meshes' own"], "value", over(LIMIT)),
        own_at_finest=largest(select(of["meshes' own"], value=max(PERIODS)), "p_error"),
        spaces=", ".join(f"{space} {f'{bound:g}' if bound else 'none'}" for space, bound in spaces.items()),
        said=quote(sorted(bad, key=lambda row: -row["value"])),
        silent=", ".join(sorted({f"{row['value']:g}" for row in silent(bad)}, key=float)) or None,
    )


def sliver_failures(rows):
    line = select(rows, part="sliver")
    missed, out = ([row for row in line if row["line"].startswith(name)] for name in ("vertices", "sticking"))
    worst = largest(missed, "p_error")
    yield failure("Vertices that nearly coincide", first(missed, "value", over(EXACT)), "fixed", worst=worst)
    yield failure(
        "One line sticks out past the other",
        first(out, "value", over(LIMIT)),
        "fixed",
        limit=LIMIT,
        ratio=max(row["p_error"] / row["value"] for row in out if 1e-8 <= row["value"] <= 1e-3),
        worst=largest([row for row in out if row["value"] <= 1e-6], "p_error"),
        checks=checks_of(out),
    )


def failures(rows):
    found = [*kink_failures(rows), wall_failure(rows), *ring_failures(rows)]
    return [*found, cosine_failure(rows), *sliver_failures(rows)]
