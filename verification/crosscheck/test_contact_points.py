"""The contact points that FreeFEM gets: exact on circles to the order of the cubics, kinks kept, gaps with their sign."""

import numpy as np
import pytest

import contact_points as cp
import convert
from cases import StudyError


def arc(radius, edges, outwards):
    """A quarter circle; outwards: the body lies inside."""
    angle = np.linspace(0, np.pi / 2, edges + 1)
    x = radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return cp.chain_through(x if outwards else x[::-1])


def rings(edges, gap):
    """Points between two concentric circles; places and normals on the inner one, and the gaps."""
    inner, outer = arc(2, edges, outwards=True), arc(2 + gap, edges * 5 // 4, outwards=False)
    rows = cp.contact_points(inner, outer, 3)
    x = np.array([inner.place(int(edge), s) for edge, s in rows[:, :2]])
    return x / np.linalg.norm(x, axis=1)[:, None], rows


def rate(coarse, fine):
    return np.log2(np.abs(coarse).max() / np.abs(fine).max())


@pytest.mark.parametrize("gap", [0.1, 0.0, -0.01])
def test_gap_between_concentric_circles(gap):
    """Exact to h^4, positive where they part, however the meshes lie (the meshes' own is off by h^2 / 8 r = 1e-2)."""
    errors = [rings(edges, gap)[1][:, 7] - gap for edges in (8, 16, 32)]
    assert np.abs(errors[0]).max() < 1e-5
    assert rate(errors[0], errors[1]) > 3.7 and rate(errors[1], errors[2]) > 3.7


def test_normals_of_a_circle():
    """Out of the body; off by h^3 between the vertices and by h^4 at them."""
    between, at = [], []
    for edges in (8, 16, 32):
        exact, rows = rings(edges, 0)
        assert (np.sum(exact * rows[:, 3:5], axis=1) > 0.999).all()
        between.append(cp.cross(exact, rows[:, 3:5]))
        chain = arc(2, edges, outwards=True)
        at.append(cp.cross(chain.x[:-1] / 2, np.array([chain.normal(edge, 0) for edge in range(edges)])))
    assert np.abs(between[0]).max() < 1e-4 and np.abs(at[0]).max() < 1e-4
    assert all(rate(*pair) > 2.8 for pair in zip(between, between[1:]))
    assert all(rate(*pair) > 3.7 for pair in zip(at, at[1:]))


def test_a_kink_stays():
    """Between its straight lines the curve is the mesh, with its normals; a polygon of a circle has no kink."""
    x = np.array([[0, 0], [1, 0], [2, 0], [3, 0], [4, 1], [5, 2], [6, 3]], dtype=float)
    tent = cp.chain_through(x)
    assert cp.kinks(x).tolist() == [3]
    for edge in range(6):
        np.testing.assert_allclose(tent.curve(edge, 0.3), tent.place(edge, 0.3), atol=1e-14)
        np.testing.assert_allclose(tent.normal(edge, 0.3), [0, -1] if edge < 3 else np.sqrt([0.5, 0.5]) * [1, -1])
    assert len(cp.kinks(arc(1, 4, outwards=True).x)) == 0  # it turns by 22.5 degrees at each vertex


def test_points_only_where_the_sides_face_each_other():
    """A line of 3 edges above one that reaches farther to the left and less far to the right; cut at its vertices."""
    above = cp.chain_through(np.array([[0, 0.5], [1, 0.5], [2, 0.5], [3, 0.5]]))
    below = cp.chain_through(np.array([[2.25, 0.0], [1.5, 0.0], [0.5, 0.0], [-1.0, 0.0]]))
    rows = cp.contact_points(above, below, 2)
    assert cp.cuts(above, 1, below) == pytest.approx([0, 0.5, 1])
    assert rows[:, 2].sum() == pytest.approx(2.25)
    x = rows[:, 0] + rows[:, 1]
    there = np.array([below.place(int(edge), t) for edge, t in rows[:, 5:7]])
    np.testing.assert_allclose(there, np.stack([x, 0 * x], axis=1), atol=1e-14)
    np.testing.assert_allclose(rows[:, 3:5], np.tile([0.0, -1.0], (len(rows), 1)), atol=1e-14)
    np.testing.assert_allclose(rows[:, 7], 0.5)


def test_chain_of_a_body_and_its_file(tmp_path):
    """Two unit squares, 0.25 apart: the body on the left of each curve, one line a point behind their number."""
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    triangles, edges = np.array([[0, 1, 2], [0, 2, 3]]), np.array([[0, 1], [1, 2], [2, 3], [0, 3]])
    lower = convert.Body("lower", square, triangles, edges, np.array([1, 2, 3, 4]))
    upper = convert.Body("upper", square + [0, 1.25], triangles, edges, np.array([5, 6, 7, 8]))
    sides = cp.vertices_of(upper, 5), cp.vertices_of(lower, 3)
    assert [x.tolist() for x in sides] == [[[0, 1.25], [1, 1.25]], [[1, 1], [0, 1]]]
    cp.save(cp.points_of_pairs([sides, sides], 2), tmp_path / "points.txt")
    count, *lines = (tmp_path / "points.txt").read_text().splitlines()
    assert count == "4" and len(lines) == 4
    s = (1 - 1 / np.sqrt(3)) / 2
    for edge, line in ((0, lines[0]), (2, lines[2])):  # edges are counted over all sides
        assert list(map(float, line.split())) == pytest.approx([edge, s, 0.5, 0, -1, edge + 1, 1 - s, 0.25])


def test_a_closed_curve_comes_back_to_its_start():
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    triangles, edges = np.array([[0, 1, 2], [0, 2, 3]]), np.array([[0, 1], [1, 2], [2, 3], [0, 3]])
    body = convert.Body("body", square, triangles, edges, np.array([1, 1, 1, 1]))
    assert cp.vertices_of(body, 1).tolist() == square[[0, 1, 2, 3, 0]].tolist()


def test_a_closed_curve_has_no_end_at_its_start():
    """A circle's normals are as good there as elsewhere; a square's corners are kinks, whichever vertex is the first."""
    angle = np.linspace(0, 2 * np.pi, 33)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    circle[-1] = circle[0]
    chain = cp.chain_through(circle)
    off = [cp.cross(chain.x[edge], chain.normal(edge, 0)) for edge in range(32)]
    np.testing.assert_allclose(off, off[0], atol=1e-13)
    square = np.array([[0, 0], [1, 0], [2, 0], [2, 1], [2, 2], [1, 2], [0, 2], [0, 1]], dtype=float)
    for first in range(8):
        x = np.roll(square, -first, axis=0)
        chain = cp.chain_through(np.concatenate([x, x[:1]]))
        assert sorted((cp.kinks(chain.x) + first) % 8) == [0, 2, 4, 6]
        for edge in range(8):
            np.testing.assert_allclose(chain.curve(edge, 0.3), chain.place(edge, 0.3), atol=1e-14)


def quarter(radius, edges):
    angle = np.linspace(0, np.pi / 2, edges + 1)
    return radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)


@pytest.mark.parametrize("gap, closed", [(0.0, True), (0.1, False)])
def test_two_meshes_of_one_line_have_no_gap(gap, closed):
    rows = cp.points_of_pairs([(quarter(2, 8), quarter(2 + gap, 10)[::-1])], 3)
    assert len(rows) > 20 and (rows[:, 7] == 0).all() == closed


def test_of_several_feet_the_nearest_counts():
    """A fillet of two edges, as long as those before are short, whose cubic has two normals through a place of its edge."""
    x = np.array([[0, 0], [0.7, 0], [1.6, 0], [3, 0], [4.9, 0], [7.1, 0.8], [8.4, 3.5]])
    chain = cp.chain_through(x)
    twice = 0
    for edge in range(len(x) - 1):
        for s in np.linspace(0.02, 0.98, 25):
            place, near = chain.place(edge, s), np.linspace(-cp.BEYOND, 1 + cp.BEYOND, 20001)
            away = np.linalg.norm(place - chain.curve(edge, near), axis=1)
            here = cp.foot(chain, edge, place)
            assert abs(here - near[np.argmin(away)]) < 1e-4
            assert abs((place - chain.curve(edge, here)) @ chain.tangent(edge, here)) < 1e-12
            turns = np.diff(np.sign(np.diff(away)))
            twice += np.count_nonzero(turns) > 1
    assert twice > 0


def test_an_edge_without_a_foot_is_named():
    """Its curve lies beyond what is near the edge."""
    line = cp.chain_through(np.array([[0, 0], [1, 0], [2, 0.0]]))
    line.cubics[1] += [[5, 0], [0, 0], [0, 0], [0, 0]]
    with pytest.raises(StudyError, match=r"no normal of the contact curve passes through its edge near \(1\..*, 0\); expected shorter edges there"):
        cp.contact_points(line, cp.chain_through(np.array([[2, -1], [0, -1.0]])), 2)
