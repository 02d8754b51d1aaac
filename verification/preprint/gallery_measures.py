"""What the gallery says in figures of curves and fields: how rough, how far apart, how far from matching meshes.

Stresses are taken relative to the mean of |sigma_n| along the line. Parts nearer than 0.04 m to a corner of the contact
line (its ends, the tents' kink) are left out: the stress is singular there.
"""

import numpy as np

import nodal_stress
import printed_tables as printed

NEAR_A_CORNER = 0.04  # m along x1
NEAR_THE_LINE = 0.02  # m, of the fields
BODIES = ("G1", "G2")  # in the order of result.vtu: upper, lower
QUADRILATERAL = [(0, 4, 7), (4, 1, 5), (5, 2, 6), (6, 3, 7), (4, 5, 7), (5, 6, 7)]  # an 8-node cell as triangles
OUTLINE = [0, 4, 1, 5, 2, 6, 3, 7, 0]


def corners(scene):
    return (0, 0.4, 0.8) if printed.series_of(scene) == "straight" else (0, 0.8)


def inner(scene, x):
    return np.all([np.abs(x - corner) > NEAR_A_CORNER for corner in corners(scene)], axis=0)


def size(scene, curve, name):
    return np.abs(curve[name][inner(scene, curve["x"])]).mean()


def roughness(scene, curve, name="sigma_n"):
    """Mean distance of a node's value from the mean of its neighbours', relative to the mean value."""
    x, v = curve["x"], curve[name]
    here = inner(scene, x[1:-1])
    return float(np.abs(v[1:-1] - (v[:-2] + v[2:]) / 2)[here].mean() / size(scene, curve, name))


def apart(scene, a, b, name="sigma_n", share=1):
    """Largest distance of two curves over the mean value of the first; or what a share of the nodes stays below."""
    here = inner(scene, a["x"])
    difference = a[name] - np.interp(a["x"], b["x"], b[name])
    return float(np.quantile(np.abs(difference[here]), share) / size(scene, a, name))


def away(scene, curve, reference, name="sigma_n"):
    """Mean distance between a curve and that of matching meshes, relative to the mean value."""
    here = inner(scene, curve["x"])
    difference = curve[name] - np.interp(curve["x"], reference["x"], reference[name])
    return float(np.abs(difference[here]).mean() / size(scene, reference, name))


def fields(folder):
    """Points, triangles between the nodes, outlines of the elements, body of each point, sigma_11, sigma_22."""
    run = nodal_stress.Run(folder)
    stresses = {f"sigma_{11 * k}": run.mesh.point_data["stress"][:, k - 1] for k in (1, 2)}
    cells = {"triangles": run.cells[:, QUADRILATERAL].reshape(-1, 3), "outlines": run.cells[:, OUTLINE]}
    return {"points": run.points, "body": run.body, **cells, **stresses}


def fields_apart(field, matching, curve, name, body):
    """Mean distance of a stress in a body from that of matching meshes, near the contact line and away from its ends,
    over the mean size of that stress there. The body's mesh is the same in both; `curve` is its contact line."""
    of_body = lambda f: np.flatnonzero(f["body"] == BODIES.index(body))
    ordered = lambda f: of_body(f)[np.lexsort(f["points"][of_body(f)].T.round(7))]
    a, b = ordered(field), ordered(matching)
    if len(a) != len(b) or np.abs(field["points"][a] - matching["points"][b]).max() > 1e-6:
        raise ValueError(f"{body} has different nodes in the two runs")
    x, y = field["points"][a].T
    off_the_line = np.abs(y - np.interp(x, curve["x"], curve["y"]))
    here = (off_the_line < NEAR_THE_LINE) & (x > NEAR_A_CORNER) & (x < 0.8 - NEAR_A_CORNER)
    return float(np.abs(field[name][a] - matching[name][b])[here].mean() / np.abs(matching[name][b])[here].mean())
