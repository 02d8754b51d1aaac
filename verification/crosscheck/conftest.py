"""What the tests need: both programs, or a skip that says which is missing; and the runner as a process."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

import run

CROSSCHECK = Path(__file__).with_name("crosscheck.py")


@pytest.fixture(scope="session")
def programs():
    try:
        return run.find_programs()
    except run.MissingProgram as missing:
        pytest.skip(str(missing))


@pytest.fixture
def crosscheck(tmp_path):
    """Runs crosscheck.py; returns the process and the table of report.json, None if there is none."""

    def run_crosscheck(*arguments, **environment):
        command = [sys.executable, CROSSCHECK, "-o", tmp_path / "report", *arguments]
        done = subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, **environment})
        report = tmp_path / "report/report.json"
        return done, json.loads(report.read_text()) if report.is_file() else None

    return run_crosscheck
