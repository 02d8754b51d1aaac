"""Runs of mortise for the study of the preprint, each of them once.

A run is a scene, a mesh and settings. Curves are dictionaries of arrays: the columns of contact.csv or
contact_centres.csv of one body, by x1.
"""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import elements
import launch
import nodal_stress
import projected_elements
import runs

SIDES = {"G1": "upper_contact", "G2": "lower_contact"}
METHOD = {"method.multipliers": "quadratic"}  # of the preprint; else the defaults: gap and normals of the curve
MEASURED, EDGES = {"contact.initial_gap": "measured"}, {"method.normals": "edges"}
AT_THE_NODES, PROJECTED = {"study.stress": "at the nodes"}, {"study.integration": "projected edges"}  # not of mortise
FILES = {"nodes": "contact.csv", "centres": "contact_centres.csv"}


def on_side(body):
    """The multipliers on this body's contact line."""
    return {"contact.multipliers_on": SIDES[body]}


class Store(runs.Store):
    """The study's runs; the tables that were read are kept in memory."""

    def __init__(self, folder, jobs=1):
        measures = elements, nodal_stress, projected_elements
        super().__init__(folder, [module.__file__ for module in measures], jobs=jobs)
        self.tables = {}

    def run(self, scene, mesh, settings, fields=False):
        """Folder of the results. `fields`: result.vtu too, which is large and else thrown away."""

        def solve(run, folder):
            own = {key: value for key, value in settings.items() if key.startswith("study.")}
            launch.solve(scene, {**launch.sizes(mesh), **dict(settings.items() - own.items())}, folder)
            if own:
                solved = nodal_stress.Run(folder)
                if PROJECTED.items() <= own.items():
                    side, enforced = settings["contact.multipliers_on"], MEASURED.items() <= settings.items()
                    solved.u = projected_elements.solve(solved, side, enforced)
                solved.write(at_the_nodes=AT_THE_NODES.items() <= own.items())
            for name in ["contact.vtu"] + ([] if fields else ["result.vtu"]):
                (folder / name).unlink()

        return self.results([scene, mesh, settings, fields], solve, f"{scene}-{launch.mesh_name(mesh)}")

    def summary(self, scene, mesh, settings):
        return launch.summary(self.run(scene, mesh, settings))

    def table(self, path):
        if path not in self.tables:
            self.tables[path] = launch.columns(path)
        return self.tables[path]

    def curve(self, scene, mesh, settings, body, at="nodes"):
        """Columns of one body's contact line by x1, at its nodes or its element centres."""
        table = self.table(self.run(scene, mesh, settings) / FILES[at])
        here = np.flatnonzero(table["curve"] == SIDES[body])
        order = here[np.argsort(table["x"][here])]
        return {name: values[order] for name, values in table.items()}
