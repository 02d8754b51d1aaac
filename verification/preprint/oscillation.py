"""The preprint's measure of oscillation, eq. (28).

delta(x1) = |sigma_2 - s| / |s| on one body's contact line, with s of matching meshes that have this body's elements on
both sides; its mean over the nodes (or element centres) leaves out those of the first and the last element, where the
stress is singular. Beside them and beside kinks it is large still, or s near a zero: then a few places make the mean.
The share of the largest tells that.
"""

import numpy as np

from preprint_runs import AT_THE_NODES, on_side

LEFT_OUT = {"nodes": 3, "centres": 1}  # of a line of 3-node edges, at either end
SAME_PLACE = 1e-9  # m
WORST = 6  # places
KEPT = ("mesh.parameters.spacing", "mesh.parameters.straight", "method.multipliers", "method.normals", *AT_THE_NODES)


def delta(curve, reference, at="nodes"):
    """delta(x1) at the places that count. Both arguments are columns by x1, of the same places."""
    if len(curve["x"]) != len(reference["x"]) or np.abs(curve["x"] - reference["x"]).max() > SAME_PLACE:
        raise ValueError("delta: the contact line and its reference have different nodes")
    inner = slice(LEFT_OUT[at], -LEFT_OUT[at])
    s = reference["sigma_2"][inner]
    return np.abs(curve["sigma_2"][inner] - s) / np.abs(s)


def mean_delta(curve, reference, at="nodes"):
    """The mean, and the part of it that the six largest values make."""
    values = delta(curve, reference, at)
    return float(values.mean()), float(np.sort(values)[-WORST:].sum() / (values.sum() or 1))


def matching_curve(store, scene, mesh, settings, body, at="nodes"):
    """The reference of a body's line: as many elements on both sides. Matching meshes have no gap and no segments to
    cut, and either side's multipliers are the same; so these settings are left at their defaults."""
    n = mesh[0] if body == "G1" else mesh[1]
    kept = {key: value for key, value in settings.items() if key in KEPT}
    return store.curve(scene, (n, n), kept, body, at)


def delta_of(store, scene, mesh, settings, side, body, at="nodes"):
    """mean_delta on a body's line with the multipliers on `side`."""
    curve = store.curve(scene, mesh, {**settings, **on_side(side)}, body, at)
    return mean_delta(curve, matching_curve(store, scene, mesh, settings, body, at), at)
