"""The store of runs, the templates and the pages, without any study."""

import time
from concurrent.futures import ThreadPoolExecutor

import pytest

import figure
import launch
import page
import runs
import template


def test_a_run_is_kept_until_something_changes(tmp_path, monkeypatch):
    for name in ("program", "script.py"):
        (tmp_path / name).write_text(name)
    calls = []
    store = lambda: runs.Store(tmp_path / "out", [tmp_path / "script.py"], [tmp_path / "program"], jobs=2)
    make = lambda run: calls.append(run) or {"twice": 2 * run["x"]}
    some = [{"x": 1}, {"x": 2}]
    assert store().rows(some, make, "test") == store().rows(some, make, "test") == [{"twice": 2}, {"twice": 4}]
    again, fresh = store(), []
    assert len(calls) == 2 and again.row({"x": 1}, make) == {"twice": 2} and again.fresh == 0
    folder = again.results({"x": 3}, lambda run, path: fresh.append((path / "file").write_text(str(run["x"]))), "three")
    assert (folder / "file").read_text() == "3" and folder.name.startswith("three-") and again.fresh == 1
    assert again.results({"x": 3}, None, "three") == folder
    (tmp_path / "script.py").write_text("changed")
    runs.fingerprint.cache_clear()
    assert store().rows(some, make, "test") and len(calls) == 4


def test_a_stopped_run_is_made_again(tmp_path):
    (tmp_path / "program").write_text("")
    store = runs.Store(tmp_path / "out", programs=[tmp_path / "program"])
    with pytest.raises(ZeroDivisionError):
        store.results(1, lambda run, folder: 1 / 0)
    assert store.results(1, lambda run, folder: (folder / "file").touch()).is_dir() and store.fresh == 1
    with pytest.raises(launch.StudyError, match="is missing: ./dev build makes it"):
        runs.Store(tmp_path, programs=[tmp_path / "other"])


def test_a_folder_that_several_ask_for_is_made_once(tmp_path):
    (tmp_path / "program").write_text("")
    store, made = runs.Store(tmp_path / "out", programs=[tmp_path / "program"]), []

    def make(run, folder):
        made.append(run)
        time.sleep(0.05)
        (folder / "file").write_text("whole")

    with ThreadPoolExecutor(4) as pool:
        folders = list(pool.map(lambda run: store.results(run, make), ["a", "a", "b", "a"]))
    assert sorted(made) == ["a", "b"] and store.fresh == 2
    assert all((folder / "file").read_text() == "whole" for folder in folders)


def test_templates_are_strict():
    text = "p is off by {p:.1e}{worse:?, at worst {at:g}|}; {{x}}"
    assert template.fill(text, p=0.0123, worse=True, at=3.0) == "p is off by 1.2e-02, at worst 3; {x}"
    assert template.fill(text, p=None, worse=None, at=None) == "p is off by none; {x}"
    for values in ({"p": 1}, {"p": 1, "worse": 0, "at": 1, "more": 2}, {"p": "text", "worse": 0, "at": 1}):
        with pytest.raises(template.TemplateError):
            template.fill(text, **values)


def test_texts_of_a_template(tmp_path):
    (tmp_path / "a.md").write_text("head\n\n<!-- one -->\nfirst\n<!-- two -->\nsecond\nline\n")
    assert template.texts(tmp_path / "a.md") == {"": "head", "one": "first", "two": "second\nline"}
    assert template.table(["a", "b"], [[1, "x|y"]]) == "| a | b |\n|---|---|\n| 1 | x\\|y |"


def test_a_page_and_its_picture_in_docs(tmp_path, monkeypatch):
    monkeypatch.setattr(page, "DOCS", tmp_path / "docs")
    drawing, axes = figure.panels(1, 1, (4, 3))
    figure.save(drawing, tmp_path / "line.png")
    (tmp_path / "docs").mkdir()
    page.write(tmp_path, "study", "# Study\n\n![a](study/line.png)\n\n[b](theory.md)\n\n", docs=True)
    assert (tmp_path / "study.md").read_text() == f"# Study\n\n![a](line.png)\n\n[b]({tmp_path}/docs/theory.md)\n"
    assert (tmp_path / "docs/study.md").read_text() == "# Study\n\n![a](study/line.png)\n\n[b](theory.md)\n"
    assert (tmp_path / "docs/study/line.png").is_file()


def test_figures_are_drawn_and_made_small(tmp_path):
    drawing, axes = figure.panels(1, 1, (4, 3))
    line = figure.curve(axes, [(2, 4), (1, 1)], hollow=lambda x, y: y > 3, label="line")
    figure.label(axes, "x", "y", "title", log="xy", limit=2, legend=True)
    assert list(line.get_xdata()) == [1, 2] and axes.get_xscale() == "log" and axes.get_xlabel() == "x"
    assert [len(other.get_xdata()) for other in axes.lines] == [2, 1, 2]
    figure.save(drawing, tmp_path / "new/large.png")
    figure.copy_small(tmp_path / "new/large.png", tmp_path / "small.png")
    assert 0 < (tmp_path / "small.png").stat().st_size < (tmp_path / "new/large.png").stat().st_size
