"""The report of made-up results: complete, failed cases first, and every file that it names is there."""

import json
import math
import re

import pytest

import compare
import report
from judge import Figure, Result
from test_compare import made_up

LIMITS = {"displacement": 1e-8, "pressure": 1e-8, "energy": 1e-8}


def with_files(result, output):
    folder = output / result.folder
    folder.mkdir(parents=True)
    comparison = made_up(shift=1e-3, pressure_shift=1e-2)
    compare.write_difference(comparison, folder / "difference.vtu")
    compare.write_pressures(comparison.curve, folder / "pressure.csv")
    return result


def one_mesh(scene, value, status, message=""):
    name = f"same_discretisation/{scene}/8x10/P2-P1/segments/upper_contact"
    figures = [Figure(key, value, limit) for key, limit in LIMITS.items()] if status != "error" else []
    steps = [{"mesh": "8x10", "differences": dict.fromkeys(LIMITS, value)}] if status != "error" else []
    return Result(name, "same_discretisation", scene, "upper_contact", name, status, message, figures, steps)


def series(scene):
    name = f"same_problem/{scene}/8x10-16x20-32x40/upper_contact"
    keys = ("energy", "displacement", "pressure", "pressure_inside")
    steps = [{"mesh": f"{8 * k}x{10 * k}", "differences": dict.fromkeys(keys, 1e-2 / k**2)} for k in (1, 2, 4)]
    figures = [Figure(key, 1e-2 / 16, 1e-2) for key in keys] + [Figure("rate of energy", 2.0, 1.9, is_rate=True)]
    return Result(name, "same_problem", scene, "upper_contact", f"{name}/32x40", "ok", "", figures, steps)


@pytest.fixture(scope="module")
def output(tmp_path_factory):
    folder = tmp_path_factory.mktemp("report")
    timing = dict.fromkeys(("mortise", "freefem", "ratio", "mortise_solve", "freefem_solve", "ratio_solve"), 1.5)
    timed = Result("timing/circle/8x10", "timing", "circle", "upper_contact", "timing/circle/8x10")
    timed.timing = {"mesh": "8x10", "unknowns": 600, "multipliers": 11, "repeats": 3, **timing}
    drawn = [one_mesh("circle", 1e-12, "ok"), one_mesh("rings", 1e-5, "failed"), series("circle")]
    broken = one_mesh("cosine", math.nan, "error", "FreeFem++: exit status 1\nno <edge> of the mesh")
    results = [with_files(result, folder) for result in drawn] + [broken, timed]
    (folder / broken.folder).mkdir(parents=True)
    (folder / timed.folder).mkdir(parents=True)
    report.write(results, folder, 12.0)
    return folder


def test_every_file_that_the_page_names_is_there(output):
    page = (output / "report.html").read_text()
    names = re.findall(r'(?:src|href)="([^"]+)"', page)
    pictures = [name for name in names if name.endswith(".png")]
    assert sorted(pictures) == sorted(str(path.relative_to(output)) for path in output.glob("pictures/*.png"))
    wanted = {"same_discretisation_rings.png", "same_problem_circle.png", "rates.png"}
    assert {f"pictures/{name}" for name in wanted} <= set(pictures)
    assert all((output / name).exists() for name in names)
    assert not any(name.startswith(("/", "http", "file")) for name in names) and "<script" not in page
    for name in re.findall(r"\]\(([^)]+)\)", (output / "report.md").read_text()):
        assert (output / name).exists()


def test_pictures_are_png(output):
    for path in output.glob("pictures/*.png"):
        data = path.read_bytes()
        assert data[:8] == b"\x89PNG\r\n\x1a\n" and len(data) > 5000


def test_failed_cases_come_first_and_errors_are_told(output):
    page, text = (output / "report.html").read_text(), (output / "report.md").read_text()
    for content in (page, text):
        cases = content[content.index("All cases") :]
        assert cases.index("rings/8x10") < cases.index("circle/8x10")
        assert "5 cases in 12 s. 2 do not hold." in content and "exit status 1" in content
    assert "no &lt;edge&gt; of the mesh" in page
    assert page.index("Same discretisation</h2>") < page.index("Same problem</h2>") < page.index("Time</h2>")


def test_json_holds_every_figure(output):
    table = json.loads((output / "report.json").read_text())
    assert table["cases"] == 5 and table["not_ok"] == 2
    rings = next(result for result in table["results"] if result["scene"] == "rings")
    figures = [(f["name"], f["value"], f["limit"], f["ok"]) for f in rings["figures"]]
    assert figures == [(name, 1e-5, 1e-8, False) for name in LIMITS]


def test_not_a_number_is_null():
    assert report.without_nan({"a": [math.nan, 1.0, math.inf]}) == {"a": [None, 1.0, None]}
    assert report.number(math.nan) == "–"
