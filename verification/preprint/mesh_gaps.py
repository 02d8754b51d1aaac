"""The gap between two meshes of one curve, as it is and as it should be.

A quadratic edge with its three nodes evenly on a curve of arc length s misses it by X'''(s) h^3 / 48 (xi^3 - xi), whose
part along the normal is kappa'(s) h^3 (xi^3 - xi) / 48, kappa the curvature: at most |kappa'| h^3 / (72 sqrt 3). On a
circle kappa' = 0, and the gap is of order h^4. Enforced, a gap g_0 on edges of length h makes the pressure swing by
about E g_0 / h: as h^2 on a parabola, four times less on half the mesh.
"""

import itertools

import numpy as np

from gallery_measures import inner
from oscillation import matching_curve
from cause import ENFORCED
from preprint_runs import on_side
import launch

CURVATURE = {"parabola_1": (-1.25, 1.0), "parabola_2": (-1.875, 1.5)}  # a, b of x2 = a x1^2 + b x1 + c
WIDTH = 0.8  # m
RADIUS, CENTRE = 0.5, 0.4  # of the circle, m


def curvature_slope(scene, x):
    """|d kappa / ds| at x1."""
    if scene == "circle":
        return np.zeros_like(x)
    a, b = CURVATURE[scene]
    slope = 2 * a * x + b
    return np.abs(12 * a * a * slope) / (1 + slope**2) ** 3


def length(scene):
    if scene == "circle":
        return 2 * RADIUS * np.arcsin(CENTRE / RADIUS)
    a, b = CURVATURE[scene]
    x = np.linspace(0, WIDTH, 100001)
    return float(np.trapz(np.hypot(1, 2 * a * x + b), x))


def predicted(scene, mesh):
    """Largest gap to third order in h: both meshes miss the curve by their own amount, and may do so to either side."""
    x = np.linspace(0, WIDTH, 100001)
    h = np.array([length(scene) / n for n in mesh])
    return float(curvature_slope(scene, x).max() * (h**3).sum() / (72 * np.sqrt(3)))


def swing(store, scene, mesh, side):
    """Largest distance of sigma_n from matching meshes on the multiplier side, the gap enforced, corners left out."""
    enforced = {**ENFORCED, **on_side(side)}
    curve, reference = store.curve(scene, mesh, enforced, side), matching_curve(store, scene, mesh, enforced, side)
    return float(np.abs(curve["sigma_n"] - reference["sigma_n"])[inner(scene, curve["x"])].max())


def rows(store, scenes, meshes, side="G2"):
    for scene, mesh in itertools.product(scenes, meshes):
        gap = store.summary(scene, mesh, {**ENFORCED, **on_side(side)})["contact"][0]["initial_gap"]
        largest = max(abs(gap["min"]), abs(gap["max"]))
        yield {
            **{"scene": scene, "mesh": launch.mesh_name(mesh), "largest gap, m": largest},
            "predicted, m": predicted(scene, mesh),
            "E g0 / h, MPa": launch.YOUNG * largest / (length(scene) / max(mesh)) / 1e6,
            "swing of sigma_n, MPa": swing(store, scene, mesh, side) / 1e6,
        }
