"""Contact that gives way against what is exact: rough surfaces in Hertz's contact."""

import csv
import json
import subprocess

import numpy as np
import pytest

from launch import ROOT

LOAD, RADIUS, MODULUS = 9.2e6, 1.0, 210e9 / 0.91 / 2  # geo/hertz.toml


def rough_hertz(stiffness, count=1000):
    """Places x >= 0, p there and half the width of contact: half planes (Johnson 1985, section 2.8) whose surfaces give way by
    p / k besides (Goryacheva, Contact Mechanics in Tribology, 1998, chapter 2), p constant in each of the cells:

        p / k + 2 / (pi E*) int p(t) ln |1 / (x - t)| dt = d - x^2 / 2 R, the integral of p the load, p >= 0."""
    end = 1.15 * np.hypot(np.sqrt(4 * LOAD * RADIUS / (np.pi * MODULUS)), (1.5 * LOAD * RADIUS / stiffness) ** (1 / 3))
    edge = np.linspace(0, end, count + 1)
    x, h = (edge[1:] + edge[:-1]) / 2, edge[1]
    integral = lambda v: v * np.log(np.abs(v)) - v
    far, near = (integral(x[:, None] + sign * edge[None]) for sign in (1, -1))
    compliance = np.eye(count) / stiffness - 2 / (np.pi * MODULUS) * (np.diff(far) - np.diff(near))
    closed = x < 0.9 * end
    while True:
        i = np.flatnonzero(closed)
        system = np.block([[compliance[np.ix_(i, i)], -np.ones((len(i), 1))], [2 * h * np.ones((1, len(i))), 0]])
        *on, approach = np.linalg.solve(system, np.append(-(x[i] ** 2) / (2 * RADIUS), LOAD))
        p = np.zeros(count)
        p[i] = on
        presses = np.where(closed, p > 0, compliance @ p < approach - x**2 / (2 * RADIUS))
        if (presses == closed).all():
            return x, p, x[i[-1]] + h * p[i[-1]] / (p[i[-2]] - p[i[-1]])
        closed = presses


@pytest.mark.parametrize("stiffness", [1e13, 2e12])
def test_rough_hertz(mortise, tmp_path, stiffness):
    """p from the line of symmetry on, within its bar; the largest within 0.1 %."""
    command = [mortise, "solve", ROOT / "geo/hertz.toml", "--set", f"contact.0.stiffness={stiffness:g}", "--accuracy", "0.3%"]
    subprocess.run([*command, "-o", tmp_path, "--quiet"], check=True)
    x, p, half_width = rough_hertz(stiffness)
    pair = json.loads((tmp_path / "summary.json").read_text())["contact"][0]
    with open(tmp_path / "contact.csv", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["p_error"]]
    at, found, bar = (np.array([float(row[name]) for row in rows]) for name in ("x", "p", "p_error"))
    assert pair["stiffness"] == stiffness
    assert pair["pressure"]["max"] == pytest.approx(p[0], rel=1e-3)
    assert pair["length_in_contact"] == pytest.approx(half_width, abs=pair["length_in_contact_error"])
    assert (np.abs(found - np.interp(at, x, p)) <= bar + 1e-5 * p[0]).all()
