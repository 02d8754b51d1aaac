from functools import cache

import pytest
from matplotlib.layout_engine import ConstrainedLayoutEngine

import launch


@pytest.fixture(scope="session")
def solve(mortise, tmp_path_factory):
    """Runs a scene once and returns the folder of its results."""

    @cache
    def run(scene):
        folder = tmp_path_factory.mktemp(getattr(scene, "stem", scene)) / "results"
        launch.solve(scene, {}, folder)
        return folder

    return run


@pytest.fixture(autouse=True)
def no_layout(monkeypatch):
    """Without matplotlib's layout, which takes as long as all else and which no test here looks at."""
    monkeypatch.setattr(ConstrainedLayoutEngine, "execute", lambda self, drawing: None)
