"""Runs of mortise for the study of the preprint, each of them once.

A run is a scene, a mesh and settings. Curves are dictionaries of arrays: the columns of contact.csv or
contact_centres.csv of one body, by x1.
"""

import json
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import launch
import nodal_stress
import runs

SIDES = {"G1": "upper_contact", "G2": "lower_contact"}
METHOD = {"method.multipliers": "quadratic"}  # of the preprint; the other defaults are the scenes' own
CLOSED, MEASURED = ({"contact.initial_gap": name} for name in ("closed", "measured"))
STRESS, AT_THE_NODES = "study.stress", "at the nodes"  # a setting of curves only, not of mortise: nodal_stress.py
FILES = {"nodes": "contact.csv", "centres": "contact_centres.csv"}


def on_side(body):
    """The multipliers on this body's contact line."""
    return {"contact.multipliers_on": SIDES[body]}


class Store(runs.Store):
    """The study's runs; the tables that were read are kept in memory."""

    def __init__(self, folder):
        super().__init__(folder, [nodal_stress.__file__])
        self.tables = {}

    def run(self, scene, mesh, settings, fields=False):
        """Folder of the results. `fields`: result.vtu too, which is large and else thrown away."""

        def solve(run, folder):
            launch.solve(scene, {**launch.sizes(mesh), **settings}, folder)
            for name in ["contact.vtu"] + ([] if fields else ["result.vtu"]):
                (folder / name).unlink()

        return self.results([scene, mesh, settings, fields], solve, f"{scene}-{mesh[0]}x{mesh[1]}")

    def summary(self, scene, mesh, settings):
        return json.loads((self.run(scene, mesh, settings) / "summary.json").read_text())

    def table(self, path):
        if path not in self.tables:
            self.tables[path] = {name: np.array(values) for name, values in launch.columns(path).items()}
        return self.tables[path]

    def nodal_stresses(self, scene, mesh, settings):
        """The stresses taken at the nodes, by the rows of contact.csv."""

        def measure(run):
            with tempfile.TemporaryDirectory() as folder:
                launch.solve(scene, {**launch.sizes(mesh), **settings}, folder)
                columns = launch.columns(Path(folder, "contact.csv")).items()
                return nodal_stress.at_contact(Path(folder), {name: np.array(values) for name, values in columns})

        found = self.row([scene, mesh, settings, STRESS], measure, f"nodal_stress-{scene}-{mesh[0]}x{mesh[1]}")
        return {name: np.array(values) for name, values in found.items()}

    def curve(self, scene, mesh, settings, body, at="nodes"):
        """Columns of one body's contact line by x1, at its nodes or its element centres."""
        settings = dict(settings)
        direct = settings.pop(STRESS, None) == AT_THE_NODES and at == "nodes"
        table = self.table(self.run(scene, mesh, settings) / FILES[at])
        if direct:
            table = {**table, **self.nodal_stresses(scene, mesh, settings)}
        here = np.flatnonzero(table["curve"] == SIDES[body])
        order = here[np.argsort(table["x"][here])]
        curve = {name: values[order] for name, values in table.items()}
        return nodal_stress.replaced(curve) if direct else curve
