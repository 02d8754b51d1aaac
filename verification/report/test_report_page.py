"""The report from made-up sections, and the committed one, in a real browser."""

import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import pytest

import assemble
import browser

ROOT = Path(__file__).resolve().parents[2]
PAGES = sorted((ROOT / "docs").glob("**/*.html"))


@pytest.fixture
def studies(tmp_path):
    """Two studies with a picture each."""
    for name in ("one", "two"):
        folder = tmp_path / "out" / name
        (folder / "pictures").mkdir(parents=True)
        figure, axes = plt.subplots()
        axes.plot([0, 1], [0, 1])
        figure.savefig(folder / "pictures/line.png")
        plt.close(figure)
        parts = [assemble.page.table(["a", "b"], [["ok", 1.5]]), assemble.page.picture("pictures/line.png", "a < b")]
        assemble.page.write_section(folder, name, f"Study {name}", parts)
    return tmp_path / "out"


def run(studies, output, *names):
    command = [sys.executable, assemble.__file__, "-i", studies, "-o", output, "--only", *names]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def need_browser():
    if not browser.find():
        pytest.skip("no chromium: ./dev setup installs it")


def test_sections_are_put_together(studies, tmp_path):
    done = run(studies, tmp_path / "report", "one", "two")
    assert done.returncode == 0, done.stderr
    text = (tmp_path / "report/index.html").read_text()
    assert text.count("<section") == 2 and '<a href="#two">Study two</a>' in text
    small, large = tmp_path / "report/one/pictures/line.png", studies / "one/pictures/line.png"
    assert 0 < small.stat().st_size < large.stat().st_size


def test_a_missing_study_or_picture_is_an_error(studies, tmp_path):
    done = run(studies, tmp_path / "report", "one", "three")
    assert done.returncode == 1 and "./dev three writes it" in done.stderr
    (studies / "one/pictures/line.png").unlink()
    done = run(studies, tmp_path / "report", "one")
    assert done.returncode == 1 and "pictures/line.png is missing" in done.stderr


def test_the_browser_sees_what_is_wrong(studies, tmp_path):
    need_browser()
    assert run(studies, tmp_path / "report", "one", "two").returncode == 0
    found = browser.look(tmp_path / "report/index.html")
    assert found["missing"] == [] and found["complaints"] == [] and found["pictures"] == 2
    (tmp_path / "report/two/pictures/line.png").unlink()
    index = tmp_path / "report/index.html"
    index.write_text(index.read_text().replace("</body>", "<script>nothing()</script></body>"))
    found = browser.look(index)
    assert found["missing"] == ["two/pictures/line.png"]
    assert any("nothing is not defined" in complaint for complaint in found["complaints"])


@pytest.mark.parametrize("path", PAGES, ids=[path.parent.name for path in PAGES])
def test_committed_pages(path):
    need_browser()
    found = browser.look(path)
    assert found["missing"] == [] and found["complaints"] == []
    assert found["pictures"] > 0 and found["text"] > 1000


def test_the_committed_report_is_small():
    files = [path for path in (ROOT / "docs").rglob("*") if path.suffix in (".png", ".svg", ".html")]
    assert sum(path.stat().st_size for path in files) < assemble.MOST_BYTES
