"""The study on two meshes a case, and verdicts that fail."""

import pytest

import exact
import exact_cases
import launch


def test_verdicts_tell_good_from_bad():
    smooth, uniform = exact_cases.by_name("tubes"), exact_cases.by_name("gravity")
    assert exact.verdict(smooth, [1e-2, 1e-3, 1e-4]) and exact.verdict(uniform, [1e-12, 1e-11])
    for errors in ([1e-2, 8e-3, 6e-3], [1e-4, 1e-4, 1e-4], [1e-2, None, 1e-4], [1e-2, 1e-3, float("nan")]):
        assert not exact.verdict(smooth, errors), errors
    assert not exact.verdict(uniform, [1e-12, 1e-7]) and not exact.verdict(uniform, [1e-12, float("nan")])


def test_every_case_holds(mortise, tmp_path, capsys):
    with pytest.raises(SystemExit) as ended:
        exact.main(["--quick", "-o", str(tmp_path)])
    assert ended.value.code == 0, capsys.readouterr().out
    rows = launch.columns(tmp_path / "exact.csv")
    assert set(rows["case"]) == {case.name for case in exact_cases.CASES}
    assert "holds" in (tmp_path / "exact.md").read_text()
