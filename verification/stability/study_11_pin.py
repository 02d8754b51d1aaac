"""A pin in a hole: the default on meshes of all kinds, drawn or read, against Persson's pressure."""

import math
from pathlib import Path

import numpy as np

import figure
import persson
import template
from failures import OF_MESHES, draw_line, failure, first, largest, last, of_scene, over, parameters, select, solved, told

HERE = Path(__file__).parent
COUNTS, BAR = [30, 60, 120], 60
ELEMENTS = {
    "3-node triangles": {"kind": 1, "order": 1},
    "4-node quadrilaterals": {"kind": 0, "order": 1},
    "6-node triangles, straight": {"kind": 1, "straight": 1},
    "6-node triangles": {"kind": 1},
    "8-node quadrilaterals": {"kind": 0},
}
CLEARANCES = {0: None, 1e-4: 80, 1e-3: 70}  # of the radius: degrees at which contact ends
NAMES = {"geo": ".geo", "msh": ".msh", "measured": ".geo, meshes' own gap"}
INNER = 0.8  # of the contact: where p is compared from place to place; outside it ends in a corner
E = 210e9 / (1 - 0.3**2)


def contact(clearance):
    """The angle at which contact ends, and the force."""
    if not clearance:
        return persson.widest(), 40e6 * math.pi
    angle = math.radians(CLEARANCES[clearance])
    return angle, E * clearance / persson.clearance(angle)


def pin(clearance, elements, count, source):
    """source: "geo", "msh" (the mesh alone), "measured" (the mesh as it is, as in the preprint)."""
    force = contact(clearance)[1] / math.pi
    settings = parameters(**ELEMENTS[elements], n=count, clearance=clearance)
    settings |= {"body_force.0.force": f"[0, {-force!r}]", **(OF_MESHES if source == "measured" else {})}
    axes = {"clearance": clearance, "elements": elements, "value": count, "source": source}
    scene, geometry = ((HERE / f"pin.{ending}").read_text() for ending in ("toml", "geo"))
    return of_scene(axes, scene, settings, "pressure", files={"pin.geo": geometry}, from_mesh=source == "msh")


def runs(quick):
    counts, sources = (COUNTS[:1], ["geo"]) if quick else (COUNTS, ["geo", "msh", "measured"])
    sizes = {gap: [BAR] if gap != 1e-3 else counts for gap in ([1e-3] if quick else CLEARANCES)}
    kinds = [(source, gap) for source in sources for gap in sizes if gap == 1e-3 or source != "measured"]
    return [pin(gap, name, n, source) for source, gap in kinds for name in ELEMENTS for n in sizes[gap]]


def errors(row):
    """Over the largest exact p: `p_error` of the largest p; within INNER of the contact at most, at the vertices, of
    the means over the edges, and of the means of these at the vertices; `mean_square` over all of the contact, over
    that of p."""
    angle, force = contact(row["clearance"])
    s, p = (np.array(row["profile"][name]) for name in ("s", "p"))
    step = 1 if ELEMENTS[row["elements"]].get("order") == 1 else 2  # to the next vertex
    phi, p = math.pi * s[::step] / s[-1], p[::step] / force
    exact = lambda phi: persson.pressure(phi, angle)
    fine = np.linspace(0, 1.2 * angle, 6001)
    between = phi[:-1, None] + np.diff(phi)[:, None] * (np.arange(20) + 0.5) / 20
    means = (p[:-1] + p[1:]) / 2
    most = lambda at, error: float(np.abs(error[at < INNER * angle]).max() / exact(0))
    return {
        "p_error": float(p.max() / exact(0) - 1),
        "mean_square": float(np.linalg.norm(np.interp(fine, phi, p) - exact(fine)) / np.linalg.norm(exact(fine))),
        "nodes": most(phi, p - exact(phi)),
        "edges": most(between.mean(axis=1), means - exact(between).mean(axis=1)),
        "smoothed": most(phi[1:-1], (means[:-1] + means[1:]) / 2 - exact(phi[1:-1])),
    }


def complete(rows):
    return [row | errors(row) if solved(row) else row for row in rows]


def profile(axes, row, label, **options):
    angle, force = contact(row["clearance"])
    s, p = (np.array(row["profile"][name]) for name in ("s", "p"))
    axes.plot(180 * s / s[-1], p / force / persson.pressure(0, angle), label=label, **options)


def draw(rows, path):
    drawing, (left, middle, right) = figure.panels(1, 3, (14, 4.6))
    angle, _ = contact(1e-3)
    phi = np.linspace(0, angle, 500)
    exact = persson.pressure(phi, angle) / persson.pressure(0, angle)
    coarse = select(rows, clearance=1e-3, value=COUNTS[0])
    sides = (left, "measured", "the meshes' own gap, as in the preprint"), (middle, "geo", "default")
    for axes, source, title in sides:
        for number, elements in enumerate(ELEMENTS):
            for row in select(coarse, source=source, elements=elements):
                profile(axes, row, elements, color=f"C{number}", linewidth=1)
        axes.plot(np.degrees(phi), exact, "k--", linewidth=1, label="Persson")
        limits = {"xlim": (0, 80), "ylim": (0, 1.3)}
        title, y = f"n = {COUNTS[0]}: {title}", "p over the largest exact p"
        figure.label(axes, "degrees", y, title, legend={"fontsize": 7}, **limits)
    for number, elements in enumerate(ELEMENTS):
        for source, style in (("geo", "o-"), ("msh", "x--"), ("measured", "^:")):
            line, label = select(rows, clearance=1e-3, elements=elements, source=source), elements if source == "geo" else None
            draw_line(right, line, "value", "nodes", style, color=f"C{number}", label=label, linewidth=1.1)
    title = "from .geo; dashed: .msh; dotted: meshes' own gap"
    y = f"largest error of p at a vertex, {INNER} of the contact"
    figure.label(right, "n, elements on the quarter circle", y, title, "xy", 0.01, {"fontsize": 7}, ylim=(5e-4, 9))
    right.set_xticks(COUNTS, map(str, COUNTS))
    right.minorticks_off()
    figure.save(drawing, path)


def values(rows):
    """The table: errors in % with n elements, by clearance, of those from .geo and from .msh."""
    count = BAR if select(rows, value=BAR) else COUNTS[0]
    clearances = sorted({row["clearance"] for row in rows})
    keys, lines = ("p_error", "edges", "nodes", "mean_square"), []
    for source in dict.fromkeys(row["source"] for row in rows):
        for elements in ELEMENTS:
            found = [select(rows, source=source, elements=elements, value=count, clearance=gap) for gap in clearances]
            cells = [" / ".join(f"{100 * row[key]:.2f}" for row in some for key in keys) for some in found]
            lines.append([elements, NAMES[source], *cells])
    heading = ["elements", "from", *(f"clearance {gap:g} R" for gap in clearances)]
    return {"count": count, "table": template.table(heading, lines)}


def failures(rows):
    drawn, read, measured = (select(rows, source=name) for name in ("geo", "msh", "measured"))
    bad = [row for row in [*drawn, *read] if abs(row["p_error"]) > 0.03]
    yield failure(
        "The largest p of a pin in a hole",
        first(bad, "value", solved),
        told(bad),
        most=largest([row | {"size": abs(row["p_error"])} for row in [*drawn, *read] if row not in bad], "size"),
        worst=largest(bad, "p_error"),
        where="; ".join(dict.fromkeys(f"{row['elements']} from {NAMES[row['source']]}" for row in bad)),
        measured=largest(select(measured, value=COUNTS[0]), "p_error"),
    )
    triangles = select(drawn, elements="3-node triangles")
    yield failure(
        "p of 3-node triangles swings from node to node",
        last(triangles, "value", over(0.01, "nodes")),
        told([row for row in triangles if over(0.01, "nodes")(row)]),
        nodes=largest(triangles, "nodes"),
        edges=largest(triangles, "edges"),
        smoothed=largest(triangles, "smoothed"),
    )
