from functools import cache

import pytest

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
