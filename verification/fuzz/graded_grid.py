"""Two blocks on one another as a structured mesh of 8-node quadrilaterals, graded by hand around known places."""

import numpy as np

import plates

GROWTH = 0.2  # of sizes away from a mark: a jump in data then costs some 30 vertices


def lines(start, end, marks, widest):
    """Vertices from start to end, as far apart as the marks ask, `widest` elsewhere, some of them at the marks."""
    ends = [start, *sorted(m.at for m in marks if m.vertex and start < m.at < end), end]
    return np.concatenate([[start], *(part(a, b, marks, widest) for a, b in zip(ends, ends[1:]))])


def part(start, end, marks, widest):
    """The vertices after `start`: equal parts of the integral of 1 / size."""
    x = start + (end - start) * (1 - np.cos(np.linspace(0, np.pi, 2001))) / 2
    wanted = [m.size + GROWTH * np.maximum(np.abs(x - m.at) - m.reach, 0) for m in marks]
    density = 1 / np.min([np.full(len(x), widest), *wanted], axis=0)
    total = np.concatenate([[0], np.cumsum((density[1:] + density[:-1]) / 2 * np.diff(x))])
    count = max(1, int(np.ceil(total[-1] - 1e-9)))
    return np.interp(np.linspace(0, total[-1], count + 1)[1:], total, x)


def with_middles(vertices):
    return np.interp(np.arange(2 * len(vertices) - 1) / 2, np.arange(len(vertices)), vertices)


def block(columns, rows, below, above, first):
    """Nodes (x, y), cells, and the sides bottom, right, top, left of one body; `rows` from 0 to 1 between the curves
    y(x). Nodes are numbered from `first`."""
    x, t = with_middles(columns), with_middles(rows)
    number = np.full((len(x), len(t)), -1)
    kept = (np.arange(len(x))[:, None] % 2 == 0) | (np.arange(len(t)) % 2 == 0)
    number[kept] = first + np.arange(kept.sum())
    xx, tt = (values[kept] for values in np.meshgrid(x, t, indexing="ij"))
    nodes = np.column_stack([xx, below(xx) * (1 - tt) + above(xx) * tt])
    at = lambda i, j: number[i : len(x) - 2 + i : 2, j : len(t) - 2 + j : 2].ravel()
    cells = np.column_stack([at(i, j) for i, j in plates.CELLS[plates.QUAD8][0]])
    edges = lambda side: np.column_stack([side[:-2:2], side[2::2], side[1::2]])
    sides = {"bottom": number[:, 0], "right": number[-1], "top": number[::-1, -1], "left": number[0, ::-1]}
    return nodes, cells, {name: edges(side) for name, side in sides.items()}


def msh(bodies):
    """The bytes of a .msh (2.2) of {name: block}: the sides are curves NAME_bottom and so on."""
    curves = {f"{name}_{side}": edges for name, made in bodies.items() for side, edges in made[2].items()}
    groups = [(1, plates.LINE3, name, edges) for name, edges in curves.items()]
    groups += [(2, plates.QUAD8, name, made[1]) for name, made in bodies.items()]
    nodes, elements = np.concatenate([made[0] for made in bodies.values()]), []
    for tag, (_, kind, _, members) in enumerate(groups, 1):
        elements += [f"{kind} 2 {tag} {tag} {' '.join(map(str, row))}" for row in (members + 1).tolist()]
    lines_of = lambda rows: "\n".join(f"{k} {row}" for k, row in enumerate(rows, 1))
    parts = {"MeshFormat": "2.2 0 8", "PhysicalNames": "\n".join([str(len(groups)), *(
        f'{dimension} {tag} "{name}"' for tag, (dimension, _, name, _) in enumerate(groups, 1))]),
        "Nodes": f"{len(nodes)}\n" + lines_of(f"{x!r} {y!r} 0" for x, y in nodes.tolist()),
        "Elements": f"{len(elements)}\n" + lines_of(elements)}  # fmt: skip
    return "".join(f"${name}\n{text}\n$End{name}\n" for name, text in parts.items()).encode()
