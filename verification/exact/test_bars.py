"""Bars on a sample of fields that slide, the fields themselves, and verdicts that fail."""

import numpy as np
import pytest

import bars


@pytest.mark.parametrize("seed", range(8))
def test_fields_close_the_gap_with_equal_normal_stresses(seed):
    run = bars.draw(seed)
    fields = bars.fields_of(run)
    x = run["x0"] + np.linspace(0.05, 0.95, 10)
    y, slope = fields.line(x, 0 * x), fields.slope(x, 0 * x)
    gap = sum((fields.u[1][i](x, y) - fields.u[0][i](x, y)) * n for i, n in ((0, -slope), (1, 1)))
    slip = sum((fields.u[1][i](x, y) - fields.u[0][i](x, y)) * t for i, t in ((0, 1), (1, slope)))
    normal = [s[0](x, y) * slope**2 - 2 * s[3](x, y) * slope + s[1](x, y) for s in fields.stress]
    assert np.abs(gap).max() < 1e-12 * np.abs(slip).max()
    assert np.abs(normal[1] - normal[0]).max() < 1e-9 * np.abs(normal).max()


def test_verdicts_tell_good_from_bad():
    run = {"element": "T6", "plane": "strain", "nu_lower": 0.3, "nu_upper": 0.3}
    good = [run | {"inside": 1, "ratio": 2} for _ in range(20)]
    assert bars.verdict(good)
    assert not bars.verdict(good[2:] + [run | {"inside": 0.9, "ratio": 2}] * 2)
    assert not bars.verdict(good[1:] + [run | {"inside": 1, "ratio": 0.5}])
    assert not bars.verdict([row | {"ratio": 5} for row in good])
    locking = run | {"element": "T3", "nu_lower": 0.4999, "inside": 0, "ratio": 0.1}
    assert bars.locks(locking) and bars.verdict(good + [locking] * 5)


def test_bars_hold_on_a_sample(mortise):
    rows = [bars.draw(seed) for seed in range(1, 300, 12)]
    rows = [run | bars.execute(run) for run in rows]
    assert not [row["failed"] for row in rows if row["failed"]]
    found = bars.told([row for row in rows if not bars.locks(row)])
    assert found["hold"] >= 0.9 and found["least"] >= 0.7 and found["median"] <= 4, found
