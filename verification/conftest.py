"""For the tests of all studies: the path to common/, and tests that need a program are skipped where it is missing."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).with_name("common")))

import launch


@pytest.fixture
def mortise():
    """The executable of mortise."""
    if not launch.MORTISE.is_file():
        pytest.skip(f"{launch.MORTISE} is missing: ./dev build makes it")
    return launch.MORTISE
