"""What the studies of domain decomposition share."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import launch


def sweep(scene, settings, vary):
    """launch.sweep by domain decomposition."""
    return launch.sweep(scene, {"method.solver": "ddm", **settings}, vary)


def outcome(row, most_steps):
    """converged, diverged or unfinished; a check that fails on a coarse mesh is none of these matters."""
    if row["status"] != "not_converged":
        return "converged"
    return "diverged" if row["iteration.steps"] < most_steps or row["iteration.convergence_rate"] > 1 else "unfinished"
