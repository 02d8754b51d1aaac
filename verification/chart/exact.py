"""What is known of the charted problems, for FreeFEM's results: Lame's solution of the rings, and the reference."""

import tomllib

import numpy as np

import chart_runs  # makes launch known
import launch
import reference

RADII = (1.0, 2.0, 3.0)


def lame_constants(material):
    young, poisson = material["young"], material["poisson"]
    return young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))


def load_on(scene, curve):
    return sum(b["pressure"] for b in scene["boundary"] if "pressure" in b and curve in b["on"])


def ring_stress(law, a, b):
    """Stresses 11, 22, 12 at places, of u_r = a r + b / r."""
    lam, mu = law

    def stress(place):
        x, y = place[:, 0], place[:, 1]
        r2 = x**2 + y**2
        mean, half = 2 * (lam + mu) * a, 2 * mu * b / r2
        cosine, sine = (x**2 - y**2) / r2, 2 * x * y / r2
        return np.stack([mean - half * cosine, mean + half * cosine, -half * sine], 1)

    return stress


def rings():
    """Lame's solution with the materials and pressures of geo/rings.toml."""
    with open(launch.scene_file("rings"), "rb") as file:
        scene = tomllib.load(file)
    laws = {body: lame_constants(scene["materials"][name]) for body, name in scene["bodies"].items()}
    r0, r1, r2 = RADII
    scale = laws["inner"][1]
    on_a = {body: 2 * (lam + mu) / scale for body, (lam, mu) in laws.items()}
    on_b = {body: -2 * mu / scale for body, (_, mu) in laws.items()}
    inner, outer = "inner", "outer"
    matrix = [
        [on_a[inner], on_b[inner] / r0**2, 0, 0],
        [on_a[inner], on_b[inner] / r1**2, -on_a[outer], -on_b[outer] / r1**2],
        [r1, 1 / r1, -r1, -1 / r1],
        [0, 0, on_a[outer], on_b[outer] / r2**2],
    ]
    right = [-load_on(scene, "inner_bore") / scale, 0, 0, -load_on(scene, "outer_rim") / scale]
    a0, b0, a1, b1 = np.linalg.solve(matrix, right)
    pressure = -scale * (on_a[inner] * a0 + on_b[inner] / r1**2 * b0)
    return {
        "pressure": lambda x, y: np.full(np.shape(x), pressure),
        "laws": laws,
        "stress": {inner: ring_stress(laws[inner], a0, b0), outer: ring_stress(laws[outer], a1, b1)},
    }


def knowledge(problem, reference_file):
    if problem == "rings":
        return rings()
    return {"pressure": reference.pressure_function(reference_file)}
