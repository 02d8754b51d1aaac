"""Small meshes and scenes of the studies' own, where geo/ has no parameter for what a study varies.

A body is a structured mesh of quadrilaterals: `columns` are the coordinates s of its vertices across, from 0 to 1,
`rows` how many elements high, `place(s, t)` where a point of the unit square lies. Its curves are NAME_bottom, _right,
_top and _left. Written is gmsh's format 2.2, with 17 digits.
"""

import numpy as np

CELL, EDGE = {1: 3, 2: 16}, {1: 1, 2: 8}  # gmsh's numbers of quadrilaterals with straight and middle nodes, and edges
SIDES = {"bottom": 0, "right": 1, "top": 2, "left": 3, "top2": 2}  # from which corner to the next, past which middle


def even(count):
    return [i / count for i in range(count + 1)]


def body(name, columns, rows, place, order=2, split=None):
    """`split`: the top from there on (in s) is a curve of its own, NAME_top2."""
    return {"name": name, "columns": list(columns), "rows": rows, "place": place, "order": order, "split": split}


def line(x_a, x_b, y_bottom, y_top):
    """Place of a body between two curves y(x): numbers or functions."""
    y = lambda curve, x: curve(x) if callable(curve) else curve

    def place(s, t):
        x = x_a + (x_b - x_a) * s
        return x, y(y_bottom, x) * (1 - t) + y(y_top, x) * t

    return place


def cells_of(one):
    """Nodes (by key (body, 2 i, 2 j)) and cells of a body, and the edges of its sides. Middles lie between the vertices
    in (s, t), so that they are on the curve."""
    s_of = np.interp(np.arange(2 * len(one["columns"]) - 1) / 2, np.arange(len(one["columns"])), one["columns"])
    t_of = np.linspace(0, 1, 2 * one["rows"] + 1)
    points, cells, sides = {}, [], {side: [] for side in SIDES}
    node = lambda i, j: points.setdefault((i, j), (len(points), one["place"](s_of[i], t_of[j])))[0]
    last_i, last_j = 2 * len(one["columns"]) - 4, 2 * one["rows"] - 2
    for j in range(0, last_j + 1, 2):
        for i in range(0, last_i + 1, 2):
            corners = [node(i, j), node(i + 2, j), node(i + 2, j + 2), node(i, j + 2)]
            middles = [node(i + 1, j), node(i + 2, j + 1), node(i + 1, j + 2), node(i, j + 1)]
            middles = middles if one["order"] == 2 else []
            cells.append(corners + middles)
            second = one["split"] is not None and s_of[i + 1] > one["split"]
            tops = (("top2", j == last_j and second), ("top", j == last_j and not second))
            for side, on in (("bottom", j == 0), ("right", i == last_i), ("left", i == 0), *tops):
                if on:
                    k = SIDES[side]
                    sides[side].append([corners[k], corners[(k + 1) % 4], *middles[k : k + 1]])
    return [position for _, position in points.values()], cells, sides


def mesh_text(bodies, move=None, join=()):
    """The mesh of the bodies. `move(name, x, y)`: moves every node in the end. `join`: pairs of bodies whose nodes are
    one where they coincide."""
    nodes, elements, names, number_of = [], [], [], {}
    for tag, one in enumerate(bodies, 1):
        points, cells, sides = cells_of(one)
        numbers = []
        for x, y in points:
            x, y = move(one["name"], x, y) if move else (x, y)
            partners = [pair for pair in join if one["name"] in pair]
            place = (round(x, 12), round(y, 12))
            known = [number_of[p, place] for pair in partners for p in pair if (p, place) in number_of]
            if not known:
                nodes.append((float(x), float(y)))
            numbers.append(known[0] if known else len(nodes))
            number_of[one["name"], place] = numbers[-1]
        names.append((2, tag, one["name"]))
        elements += [(CELL[one["order"]], tag, [numbers[k] for k in cell]) for cell in cells]
        for k, side in enumerate(name for name in SIDES if sides[name]):
            names.append((1, 10 * tag + k, f"{one['name']}_{side}"))
            elements += [(EDGE[one["order"]], 10 * tag + k, [numbers[n] for n in edge]) for edge in sides[side]]
    text = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names))]
    text += [f'{dimension} {tag} "{name}"' for dimension, tag, name in names]
    text += ["$EndPhysicalNames", "$Nodes", str(len(nodes))]
    text += [f"{i} {x!r} {y!r} 0" for i, (x, y) in enumerate(nodes, 1)]
    text += ["$EndNodes", "$Elements", str(len(elements))]
    text += [f"{i} {kind} 2 {tag} {tag} " + " ".join(map(str, of)) for i, (kind, tag, of) in enumerate(elements, 1)]
    return "\n".join(text + ["$EndElements"]) + "\n"


def scene_text(bodies, boundary, contact, young=210e9, poisson=0.3):
    """A scene file; `boundary` and `contact` are lists of the insides of inline tables. `young`: one, or one a body."""
    young = young if isinstance(young, (list, tuple)) else [young] * len(bodies)
    lines = ['title = "stability"', 'mesh.file = "mesh.msh"']
    lines += [f"materials.m{i} = {{ young = {E!r}, poisson = {poisson!r} }}" for i, E in enumerate(young)]
    lines.append("bodies = { " + ", ".join(f'{one["name"]} = "m{i}"' for i, one in enumerate(bodies)) + " }")
    lines.append("boundary = [" + ", ".join("{ " + text + " }" for text in boundary) + "]")
    lines.append("contact = [" + ", ".join("{ " + text + " }" for text in contact) + "]")
    return "\n".join(lines) + "\n"


def run(axes, bodies, boundary, contact, settings=None, measures=(), move=None, join=(), **others):
    """A run (stability_runs) on a mesh of its own."""
    physical = {key: others.pop(key) for key in ("young", "poisson") if key in others}
    return {
        "axes": axes,
        "scene": scene_text(bodies, boundary, contact, **physical),
        "files": {"mesh.msh": mesh_text(bodies, move, join)},
        "settings": settings or {},
        "measures": list(measures),
        **others,
    }


WIDTH = 0.8
LOAD = 'on = "upper_top", pressure = 10e6'
PRESSED = [
    'on = ["upper_left", "upper_right", "lower_left", "lower_right"], displacement = { x = 0 }',
    'on = "lower_bottom", displacement = { x = 0, y = 0 }',
    LOAD,
]
LEFT = 'on = ["upper_left", "lower_left"], displacement = { x = 0 }'
SLIDING = [LEFT, 'on = "lower_bottom", displacement = { y = 0 }', LOAD]


def touching(condition="unilateral", multipliers=None, gap=None):
    """The pair of two plates; `gap`: initial_gap, where it is not the default."""
    side = f', multipliers_on = "{multipliers}"' if multipliers else ""
    side += f', initial_gap = "{gap}"' if gap else ""
    return [f'between = ["upper_bottom", "lower_top"], condition = "{condition}"{side}']


def plates(curve, upper, lower, order=2, top=0.6, rows=6):
    """Two plates of width 0.8 m that meet along y = curve(x); `upper`, `lower`: their columns."""
    return [
        body("lower", lower, rows, line(0, WIDTH, 0, curve), order),
        body("upper", upper, rows, line(0, WIDTH, curve, top), order),
    ]
