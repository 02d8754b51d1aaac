"""Projection and norms of the study, without the program."""

import numpy as np
import pytest

import line


def straight(count, p):
    """Along x, 0 to 1, uneven edges."""
    x = np.linspace(0, 1, 2 * count + 1) ** 1.5
    x[1::2] = (x[:-1:2] + x[2::2]) / 2
    vertices = p(x)
    vertices[1::2] = (vertices[:-1:2] + vertices[2::2]) / 2
    return line.Line(np.column_stack([x, 0 * x]), vertices, np.full(len(x), 0.1))


def test_samples_measure_a_curved_line():
    phi = np.linspace(0, np.pi / 2, 41)
    arc = line.Line(np.column_stack([np.cos(phi), np.sin(phi)]), phi, phi)
    x, p, ds = line.samples(arc)
    assert ds.sum() == pytest.approx(np.pi / 2, rel=1e-6)
    assert np.arctan2(x[:, 1], x[:, 0]) == pytest.approx(p, abs=1e-4)
    assert np.linalg.norm(x, axis=1) == pytest.approx(1, abs=1e-5)


def test_projection_finds_the_nearest_point_of_the_polyline():
    corner = line.Line(np.array([[0, 0], [1, 0], [3, 0], [3, 1], [3, 4]], float), np.arange(5.0), np.zeros(5))
    places = np.array([[0.25, 0.1], [2, -1], [2.9, 0.5], [3.5, 2.5], [-1, 0], [9, 9]])
    assert line.pressure_of(corner)(places) == pytest.approx([0.25, 1.5, 2.5, 3.5, 0, 4])


def test_the_error_of_a_constant_and_what_is_left_out():
    one = lambda x: np.ones(len(x))
    assert line.rms_error(straight(7, lambda x: 1.5 + 0 * x), one) == pytest.approx(0.5)
    step = straight(400, lambda x: np.where(x < 0.1, 4.0, 1.0))
    assert line.rms_error(step, one) == pytest.approx(3 * np.sqrt(0.1), rel=0.02)
    assert line.rms_error(step, one, [[0, 0]], 0.11) == pytest.approx(0, abs=1e-12)


def test_the_error_between_the_nodes_counts():
    nodal, square = straight(10, lambda x: x**2), lambda x: x[:, 0] ** 2
    assert line.rms_error(nodal, square) == pytest.approx(0, abs=1e-12)
    assert line.rms_error(nodal, square, places=line.samples) > 1e-3


def test_a_fit_finds_the_end_of_contact():
    exact = lambda x: 5e8 * np.sqrt(np.maximum(1 - (x / 0.7) ** 2, 0)) * (1 + 0.1 * x**2)
    contact = straight(200, exact)
    contact.p[contact.x[:, 0] > 0.68] *= 1.2
    p, end = line.fitted(contact, lambda x: x[:, 0] ** 2, 1)
    assert np.sqrt(end) == pytest.approx(0.7, rel=2e-4)
    assert p(np.array([[0.3, 0], [0.69, 0], [0.8, 0]])) == pytest.approx(exact(np.array([0.3, 0.69, 0.8])), rel=5e-3)


def test_bars_are_counted_by_zone():
    p = lambda x: np.where(x < 0.3, 1.2, np.where(x > 0.9, 1.05, 1.0))
    exact = lambda x: np.ones(len(x))
    outer, inner, worst = line.inside_bars(straight(20, p), exact)
    assert 0 < outer < 1 and inner is None and worst[0] < 0.3 and worst[2] == pytest.approx(2)
    outer, inner, worst = line.inside_bars(straight(20, p), exact, [[0, 0]], 0.3)
    assert outer == 1 and inner == 0 and worst[2] == pytest.approx(0.5)
    unloaded = straight(20, lambda x: 0 * x)
    unloaded.bar[:] = 0
    outer, _, worst = line.inside_bars(unloaded, lambda x: 1.0 * (x[:, 0] > 0.5))
    assert outer == 0 and worst[2] == np.inf
