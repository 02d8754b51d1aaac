"""For the tests of all studies: the path to common/, and tests that need a program are skipped where it is missing."""

import os
import shutil
import sys
import tempfile
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).with_name("common")))

import launch

_cache = tempfile.TemporaryDirectory(prefix="mortise_cache_")
# Of meshes: that of the whole run of all tests (./dev test), or one of this process; never the user's.
os.environ["XDG_CACHE_HOME"] = os.environ.get("MORTISE_TESTS_CACHE", _cache.name)


@pytest.fixture(scope="session")
def mortise():
    """The executable of mortise."""
    if not launch.MORTISE.is_file():
        pytest.skip(f"{launch.MORTISE} is missing: ./dev build makes it")
    return launch.MORTISE


@pytest.fixture
def call(mortise, tmp_path):
    """Runs mortise, or another program, in the test's folder, and returns what it says; its exit status must be `expected`."""

    def run(*words, expected=0, program=mortise, **environment):
        done, _ = launch.run([program, *words], range(-64, 256), cwd=tmp_path, env={**os.environ, **environment})
        said = done.stdout + done.stderr
        assert done.returncode == expected, said
        return said

    return run


@pytest.fixture(scope="session")
def freefem(mortise):
    if shutil.which("FreeFem++") is None:
        pytest.skip("FreeFem++ is not on the PATH: ./dev setup installs it")


def pytest_collection_modifyitems(items):
    """The files that take longest first, so that processes that take a file at a time (--dist loadfile) end together."""
    items.sort(key=lambda item: item.path.parent.name not in ("picture", "scenes", "chart", "preprint"))
