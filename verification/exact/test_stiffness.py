"""Contact that gives way against what is exact: rough surfaces in Hertz's contact."""

import tomllib

import numpy as np
import pytest

import launch

LOAD, RADIUS, MODULUS = 9.2e6, 1.0, 210e9 / 0.91 / 2  # geo/hertz.toml


def rough_hertz(pressure, slope, count=1000):
    """Places x >= 0, p there and half the width of contact: half planes (Johnson 1985, section 2.8) whose rough surfaces overlap by
    d under p(d) besides (Goryacheva, Contact Mechanics in Tribology, 1998, chapter 2), p constant in each of the cells:

        d - 2 / (pi E*) int p(t) ln |x - t| dt = approach - x^2 / 2 R, the integral of p the load, p = 0 where d < 0.

    By Newton's method in d and the approach, whose steps shorten until the residual falls."""
    end = 0.03  # beyond all contact of the test
    edge = np.linspace(0, end, count + 1)
    x, h = (edge[1:] + edge[:-1]) / 2, edge[1]
    integral = lambda v: v * np.log(np.abs(v)) - v
    far, near = (integral(x[:, None] + sign * edge[None]) for sign in (1, -1))
    bodies = -2 / (np.pi * MODULUS) * (np.diff(far) - np.diff(near))
    load = lambda p: 2 * h * p.sum() / LOAD
    miss = lambda v: np.append((v[:-1] + bodies @ pressure(v[:-1]) - v[-1] + x**2 / (2 * RADIUS)) / x[-1] ** 2, load(pressure(v[:-1])) - 1)
    v = np.append((0.02**2 - x**2) / (2 * RADIUS), 0)
    while np.abs(miss(v)).max() > 1e-12:
        k = slope(v[:-1])
        system = np.block([[(np.eye(count) + bodies * k) / x[-1] ** 2, -np.ones((count, 1)) / x[-1] ** 2], [2 * h * k / LOAD, 0]])
        step = -np.linalg.solve(system, miss(v))
        part = 1.0
        while np.abs(miss(v + part * step)).max() > (1 - part / 4) * np.abs(miss(v)).max() and part > 1e-3:
            part /= 2
        v += part * step
    d, i = v[:-1], np.flatnonzero(v[:-1] > 0)[-1]
    return x, pressure(d), x[i] + h * d[i] / (d[i] - d[i + 1])


# A stiffness; powers; a table, its last piece going on.
TABLE = np.array([[0, 0], [2e-5, 5e6], [5e-5, 1e8], [8e-5, 3e8]])
SLOPES = np.diff(TABLE[:, 1]) / np.diff(TABLE[:, 0])
LAWS = {
    "1e13": (lambda d: 1e13 * d, lambda d: np.full_like(d, 1e13)),
    "2e12": (lambda d: 2e12 * d, lambda d: np.full_like(d, 2e12)),
    "{ pressure = 5e8, overlap = 1e-4, exponent = 2 }": (lambda d: 5e16 * d**2, lambda d: 1e17 * d),
    "{ pressure = 5e8, overlap = 1e-4, exponent = 6.804 }": (  # of the height of asperities: Greenwood & Tripp 1970
        lambda d: 5e8 * (d / 1e-4) ** 6.804, lambda d: 6.804 * 5e12 * (d / 1e-4) ** 5.804),
    str(TABLE[1:].tolist()): (
        lambda d: np.interp(d, *TABLE.T) + SLOPES[-1] * np.maximum(d - TABLE[-1, 0], 0),
        lambda d: SLOPES[np.minimum(np.searchsorted(TABLE[:, 0], d, side="right") - 1, 2)]),
}  # fmt: skip


@pytest.mark.parametrize("law", LAWS)
def test_rough_hertz(mortise, tmp_path, law):
    """p from the line of symmetry on, within its bar at 95 % of the nodes, as bars promise; the largest within 0.1 %."""
    settings = {"contact.0.stiffness": law}
    (pair,) = launch.solve("hertz", settings, tmp_path, "--accuracy", "0.3%", expected=[0])["contact"]
    pressure, slope = (lambda d, of=of: np.where(d > 0, of(np.maximum(d, 0)), 0) for of in LAWS[law])
    x, p, half_width = rough_hertz(pressure, slope)
    line = launch.columns(tmp_path / "contact.csv")
    at, found, bar = (line[name][np.isfinite(line["p_error"])] for name in ("x", "p", "p_error"))
    assert pair["stiffness"] == tomllib.loads(f"law = {law}")["law"]
    assert pair["pressure"]["max"] == pytest.approx(p[0], rel=1e-3)
    assert pair["length_in_contact"] == pytest.approx(half_width, abs=pair["length_in_contact_error"])
    assert (np.abs(found - np.interp(at, x, p)) <= bar + 1e-5 * p[0]).mean() >= 0.95
