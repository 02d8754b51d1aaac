"""What counts as off in print, and the cases of which the theory is exact."""

import pytest

import public_cases


def test_what_is_off():
    row = {"failed": "", "value": 2.27299e8, "bar": 1e5}
    for value, off in (("2.27e8", False), ("2.35e8", True), ("2.276e8", True), ("2.274e8", False), ("-2.27e8", True)):
        assert public_cases.printed_off({"value": value}, row) == off, value
    assert not public_cases.printed_off({"value": "2.35e8", "within": 0.04}, row)
    figure = {"printed": [{"value": "2.27e8", "by": "one", "off": True}, {"value": "2.35e8", "by": "other"}]}
    assert public_cases.wrong_of(figure, row) == ["2.27e8 by one is not off", "2.35e8 by other is off"]
    assert public_cases.wrong_of({"printed": []}, row | {"bar": 1e6}) == ["bar 0.44%"]
    assert public_cases.wrong_of({"printed": []}, row | {"bar": float("nan")}) == ["bar nan%"]


def test_cases_hold(mortise, tmp_path, capsys):
    """By far not all, but of every kind of figure."""
    some = ["tnsb_shrink_fit", "vm64", "ssnp121", "ssnp173", "frontistr_cylinder", "solids4foam_punch"]
    with pytest.raises(SystemExit) as ended:
        public_cases.main(["--quick", "-o", str(tmp_path), "--only", *some])
    assert ended.value.code == 0, capsys.readouterr().out
    assert "a = 10.267 mm" in (tmp_path / "cases.md").read_text()
