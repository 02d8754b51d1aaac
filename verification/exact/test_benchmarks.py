"""The references against each other, verdicts that fail, and every benchmark at 1 % and on four meshes (of the pins and
the layer on two)."""

import numpy as np
import pytest

import benchmark_cases
import benchmarks
import closed_forms
import computed_again
import launch
import layer
import peers
import persson

PLACES = np.linspace(0.03, 0.97, 48)


def off(found, exact):
    """Over the largest exact value, as the root of the mean square."""
    return np.sqrt(np.mean((found - exact) ** 2)) / np.abs(exact).max()


@pytest.mark.parametrize("name", [*closed_forms.PLANE, *closed_forms.AXISYMMETRIC])
def test_closed_forms_against_superposition(name):
    ring = name in closed_forms.AXISYMMETRIC
    indenter = (closed_forms.AXISYMMETRIC if ring else closed_forms.PLANE)[name]
    assert off(computed_again.superposed(indenter, PLACES, ring), indenter.pressure(PLACES)) < 1e-4
    x = np.sin(np.pi / 2 * (np.arange(4000) + 0.5) / 4000)  # fine at x = 1
    width = np.pi / 2 / 4000 * np.sqrt(1 - x**2)
    force = (width * indenter.pressure(x) * (2 * np.pi * x if ring else 2)).sum()
    assert force == pytest.approx(indenter.load, rel=1e-4)


@pytest.mark.parametrize("name", closed_forms.PLANE)
def test_closed_forms_against_boundary_elements(name):
    """The gap is that of the scene, the load its load; where contact ends is found."""
    indenter = closed_forms.PLANE[name]
    x = np.linspace(0, 1.5, 301)
    gap = np.concatenate([[0], np.cumsum((indenter.slope(x[:-1]) + indenter.slope(x[1:])) / 2 * np.diff(x))])
    found, p = computed_again.half_plane(lambda s: np.interp(np.abs(s), x, gap), indenter.load)
    assert off(np.interp(PLACES, found, p), indenter.pressure(PLACES)) < 2e-3
    assert found[p > 0].max() == pytest.approx(1, abs=0.01)


@pytest.mark.parametrize("degrees", [30, 70, 84])
def test_the_pin_against_boundary_elements(degrees):
    angle = np.radians(degrees)
    phi, p = computed_again.pin(persson.clearance(angle), 1)
    assert off(p, persson.pressure(phi, angle)) < 2e-3
    assert phi[p > 0].max() == pytest.approx(angle, abs=0.01)


def test_the_layer():
    """Filon's zero of a layer on a rigid ground, printed as 1.35; more nodes change nothing; the load is borne."""
    assert layer.bilateral_zero() == pytest.approx(1.35, abs=0.02)
    (width, p), (fewer, _) = layer.solve(1), layer.solve(1, 30)
    assert width == pytest.approx(fewer, rel=1e-9) and width == pytest.approx(1.371185316, rel=1e-8)  # frozen
    x = np.linspace(0, width, 20001)
    assert 2 * np.trapz(p(x), x) == pytest.approx(layer.LOAD, rel=1e-5) and (p(x) >= 0).all()


def test_verdicts_tell_good_from_bad():
    case = benchmark_cases.by_name("cylinder")
    row = {"failed": "", "error": 5e-3, "width": 1e-3}
    assert not benchmarks.verdict(case, [row] * 4, row) and not benchmarks.verdict(case, [row] * 2, row)
    for bad in ({"failed": "check_failed"}, {"error": 0.02}, {"error": float("nan")}, {"width": -0.01}):
        assert benchmarks.verdict(case, [row] * 3 + [row | bad], row), bad
    assert benchmarks.verdict(case, [row], row | {"error": 0.011})


def test_every_benchmark_runs(mortise, tmp_path, capsys):
    with pytest.raises(SystemExit) as ended:
        benchmarks.main(["--quick", "-o", str(tmp_path)])
    assert ended.value.code == 0, capsys.readouterr().out
    rows = launch.columns(tmp_path / "benchmarks.csv")
    assert set(rows["case"]) == {case.name for case in benchmark_cases.CASES}
    assert (tmp_path / "benchmarks.md").read_text().count("![") == len(benchmark_cases.CASES)


@pytest.mark.parametrize("by", ["FreeFEM", "GetFEM"])
def test_other_programs_find_the_same_on_the_same_mesh(mortise, monkeypatch, by):
    """A flat punch, p without a limit: 26 multipliers, the first one in the middle among them. GetFEM has no segments."""
    if not peers.found(by):
        pytest.skip(f"{by} is not installed")
    contact = benchmarks.launch.contact
    monkeypatch.setattr(benchmarks.launch, "contact", lambda folder: {**contact(folder), "p": contact(folder)["p_multiplier"]})
    ours = benchmarks.execute({"case": "flat_punch", "size": 20})
    monkeypatch.undo()
    theirs = peers.execute({"case": "flat_punch", "size": 20, "by": by})
    assert not theirs["failed"] and theirs["seconds"] > 0
    assert theirs["error"] == pytest.approx(ours["error"], rel=1e-4 if by == "FreeFEM" else 0.01)
