"""The comparison on made-up results: what each figure means, and that NaN and strange nodes do not pass."""

import math

import meshio
import numpy as np
import pytest

import compare
import judge
from cases import CaseError

POINTS = np.array([[0, 0], [2, 0], [2, 1], [0, 1]], dtype=float)
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]])


def made_up(shift=0.0, pressure_shift=0.0):
    """One body twice with u = (x, 1), p = 2 + s / 4 on 41 nodes; FreeFEM's are off at one node, one pressure."""
    u = np.stack([POINTS[:, 0], np.ones(4)], axis=1)
    off = u.copy()
    off[2, 1] += shift
    s = np.linspace(0, 4, 41)
    p = 2 + s / 4
    wrong = p.copy()
    wrong[20] += pressure_shift
    second = compare.Field("b", POINTS + [0, 1], TRIANGLES, u, u.copy())
    fields = [compare.Field("a", POINTS, TRIANGLES, u, off), second]
    return compare.Comparison(fields, compare.Curve("curve", s, p, wrong), (100.0, 101.0))


def test_largest_differences():
    found = compare.largest_differences(made_up(shift=1e-3, pressure_shift=-3e-2))
    assert found["displacement"] == pytest.approx(1e-3 / math.hypot(2, 1.001))
    assert found["pressure"] == pytest.approx(1e-2)
    assert found["energy"] == pytest.approx(1e-2)
    assert compare.largest_differences(made_up())["displacement"] == 0


def test_mean_differences():
    found = compare.mean_differences(made_up(shift=0.3, pressure_shift=0.6), kinks=())
    areas = np.array([2 / 3, 1 / 3, 2 / 3, 1 / 3])
    np.testing.assert_allclose(compare.nodal_areas(POINTS, TRIANGLES), areas)
    size = 2 * (areas @ (POINTS[:, 0] ** 2 + 1))
    assert found["displacement"] == pytest.approx(0.3 * math.sqrt((2 / 3) / size))
    squares = np.trapz((2 + made_up().curve.s / 4) ** 2, dx=0.1)
    assert found["pressure"] == pytest.approx(0.6 * math.sqrt(0.1 / squares))
    assert found["pressure_inside"] == pytest.approx(0.6 / 2.5)


def test_inside_leaves_ends_and_kinks_out():
    s = np.linspace(3, 5, 101)
    kept = (s[compare.inside(s, [0.5])] - 3) / 2
    assert kept.min() > 0.10 and kept.max() < 0.90
    assert len(kept) == 101 - 2 * 11 - 21
    assert compare.mean_differences(made_up(pressure_shift=0.6), kinks=(0.5,))["pressure_inside"] == 0


def test_nan_holds_no_limit():
    broken = made_up()
    broken.curve.mortise[3] = math.nan
    value = compare.largest_differences(broken)["pressure"]
    assert math.isnan(value)
    assert not judge.Figure("pressure", value, 1e-8).ok
    assert not judge.Figure("rate of pressure", value, 1.0, is_rate=True).ok


def test_match_finds_the_partner_of_every_node():
    shuffled = POINTS[[2, 0, 3, 1]] + 1e-12
    np.testing.assert_array_equal(compare.match(POINTS, shuffled, 2.0, "body"), [1, 3, 0, 2])
    with pytest.raises(CaseError, match=r"body, mortise: nothing within 1e-10 .* \(2, 1\)"):
        compare.match(POINTS, POINTS + [[0, 0], [0, 0], [0, 1e-9], [0, 0]], 2.0, "body, mortise")
    with pytest.raises(CaseError, match="same partner"):
        compare.match(POINTS[[0, 0]], POINTS, 2.0, "body")


def test_rates():
    assert judge.rates([8.0, 2.0, 0.5]) == [2.0, 2.0]
    assert judge.mean_rate([8.0, 4.0, 0.5]) == 2.0
    assert math.isnan(judge.mean_rate([1.0, 0.0, 1.0]))


@pytest.mark.parametrize("order, kind", [(1, "triangle"), (2, "triangle6")])
def test_difference_is_read_back_by_meshio(tmp_path, order, kind):
    comparison = made_up(shift=0.25)
    if order == 2:
        for field in comparison.fields:
            field.cells = np.array([[0, 1, 2, 3, 0, 1], [0, 2, 3, 1, 2, 3]])  # any six will do here
    compare.write_difference(comparison, tmp_path / "difference.vtu")
    mesh = meshio.read(tmp_path / "difference.vtu")
    assert [block.type for block in mesh.cells] == [kind] and len(mesh.cells[0].data) == 4
    assert mesh.points.shape == (8, 3) and mesh.cell_data["body"][0].tolist() == [0, 0, 1, 1]
    data = mesh.point_data
    np.testing.assert_array_equal(data["difference"], data["u_mortise"] - data["u_freefem"])
    assert data["difference"][2].tolist() == [0, -0.25, 0] and np.count_nonzero(data["difference"]) == 1
