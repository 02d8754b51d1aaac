"""Runs getfem_contact.py, with the Python that Debian's python3-getfem belongs to."""

import subprocess
import sys
from pathlib import Path

import launch
import numpy as np

SCRIPT = Path(__file__).resolve().with_name("getfem_contact.py")


def version():
    """Of GetFEM, or None where it is missing."""
    ask = [sys.executable, "-c", "import getfem; print(getfem.getfem_env('version'))"]
    asked = subprocess.run(ask, capture_output=True, text=True, check=False)
    return asked.stdout.strip() if asked.returncode == 0 else None


def contact(scene, mesh, side, folder, settings=None):
    """Solves with multipliers on the curve `side` and some of the scene's values replaced; returns a row a multiplier:
    0, x, y, p, 0. StudyError if it fails."""
    words = [f"{key}={value}" for key, value in (settings or {}).items()]
    launch.run([sys.executable, SCRIPT, scene, mesh, side, folder, *words], expected=(0,))
    return np.loadtxt(folder / "getfem_contact.txt")


def summary(folder):
    """Numbers of getfem_summary.txt by name."""
    words = (line.split() for line in (folder / "getfem_summary.txt").read_text().splitlines())
    return {key: float(value) for key, value in words}
