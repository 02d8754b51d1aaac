"""The report from made-up sections, and that the pictures of the committed pages are there."""

import re
import shutil
import subprocess
import sys

import pytest
from PIL import Image

import assemble
from assemble import ROOT, figure, page

PAGES = sorted((ROOT / "docs").glob("**/*.html"))


@pytest.fixture
def studies(tmp_path):
    """Two studies with a picture each."""
    for name in ("one", "two"):
        folder = tmp_path / "out" / name
        drawing, axes = figure.panels(1, 1, (4, 3))
        axes.plot([0, 1], [0, 1])
        figure.save(drawing, folder / "pictures/line.png")
        parts = [page.table(["a", "b"], [["ok", 1.5]]), page.picture("pictures/line.png", "a < b")]
        page.write_section(folder, name, f"Study {name}", parts)
    return tmp_path / "out"


def run(monkeypatch, studies, output, *names):
    """The exit status."""
    monkeypatch.setattr(sys, "argv", ["assemble.py", "-i", str(studies), "-o", str(output), "--only", *names])
    return assemble.main()


def pictures(path):
    """Of a page: the files that it names. A picture that cannot be read is an error."""
    found = [path.parent / name for name in re.findall(r'<img [^>]*src="([^"]+)"', path.read_text())]
    for picture in found:
        with Image.open(picture) as opened:
            opened.verify()
    return found


def test_sections_are_put_together(monkeypatch, studies, tmp_path):
    assert run(monkeypatch, studies, tmp_path / "report", "one", "two") == 0
    index = tmp_path / "report/index.html"
    assert index.read_text().count("<section") == 2 and '<a href="#two">Study two</a>' in index.read_text()
    assert pictures(index) == [tmp_path / f"report/{name}/pictures/line.png" for name in ("one", "two")]
    small, large = tmp_path / "report/one/pictures/line.png", studies / "one/pictures/line.png"
    assert small.stat().st_size < large.stat().st_size


def test_a_study_that_is_not_there_is_kept(monkeypatch, studies, tmp_path):
    """Its pictures as they were, and the contents name each of its parts once."""
    section = studies / "two/section.html"
    section.write_text(section.read_text().replace("<table>", '<h3>A part</h3><a href="runs/1">a run</a><table>', 1))
    assert run(monkeypatch, studies, tmp_path / "report", "one", "two") == 0
    before = (tmp_path / "report/two/pictures/line.png").read_bytes()
    shutil.rmtree(studies / "two")
    assert run(monkeypatch, studies, tmp_path / "report", "two", "one") == 0
    text = (tmp_path / "report/index.html").read_text()
    assert (tmp_path / "report/two/pictures/line.png").read_bytes() == before and "runs/1" not in text
    assert text.count('href="#two-1"') == text.count('id="two-1"') == 1 and text.index('id="two"') < text.index('id="one"')


def test_a_missing_study_or_picture_is_an_error(monkeypatch, capsys, studies, tmp_path):
    assert run(monkeypatch, studies, tmp_path / "report", "one", "three") == 1
    assert "./dev three writes it" in capsys.readouterr().err
    (studies / "one/pictures/line.png").unlink()
    assert run(monkeypatch, studies, tmp_path / "report", "one") == 1
    assert "pictures/line.png is missing" in capsys.readouterr().err


def test_the_committed_report():
    """Every study is on it, every link within it and to other pages of the docs leads somewhere."""
    index = ROOT / "docs/report/index.html"
    text = index.read_text()
    assert re.findall(r'<section id="([^"]+)"', text) == assemble.STUDIES
    assert text.index("What to use") < text.index("What accuracy to expect") < text.index("<section")
    for link in re.findall(r'href="([^"]+)"', text):
        path, _, anchor = link.partition("#")
        assert "://" in link or not path or (index.parent / path).exists(), link
        assert path or f'id="{anchor}"' in text, link


# What a browser puts into the title: the page's width, the width that it takes, and each table, picture or listing that is
# wider than its place.
MEASURE = """<script>addEventListener("load", () => {
  const wide = [...document.querySelectorAll("main table, main img, main pre")].filter(
    (one) => one.scrollWidth > one.clientWidth + 1 || one.getBoundingClientRect().right > innerWidth + 1);
  const names = wide.map((one) => one.closest("section")?.id + ": " + one.outerHTML.slice(0, 80).replace(/[<>\\n]/g, " "));
  document.title = [innerWidth, document.documentElement.scrollWidth, ...names].join("|");
})</script>"""


@pytest.mark.parametrize("width", [600, 1000, 1400])
def test_the_report_in_a_browser(tmp_path, width):
    browser = shutil.which("chromium") or pytest.skip("chromium is not installed: no browser to look at the report with")
    shutil.copytree(ROOT / "docs/report", tmp_path / "report")
    index = tmp_path / "report/index.html"
    index.write_text(index.read_text().replace("</body>", MEASURE + "</body>"))
    command = [browser, "--headless", "--no-sandbox", f"--user-data-dir={tmp_path}", f"--window-size={width},900", "--dump-dom"]
    said = subprocess.run([*command, index.as_uri()], capture_output=True, text=True, timeout=120, check=True).stdout
    inner, taken, *wide = re.search(r"<title>(.*?)</title>", said)[1].split("|")
    assert int(inner) == width and int(taken) <= width
    assert width < 1000 or not wide  # a narrow page's tables scroll


@pytest.mark.parametrize("path", PAGES, ids=[path.parent.name for path in PAGES])
def test_committed_pages(path):
    assert pictures(path) and "<script" not in path.read_text()


def test_the_committed_report_is_small():
    files = [path for path in (ROOT / "docs").rglob("*") if path.suffix in (".png", ".svg", ".html")]
    assert sum(path.stat().st_size for path in files) < assemble.MOST_BYTES
