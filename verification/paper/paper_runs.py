"""Runs of mortise for the study of the preprint, each of them once.

A run is a scene, a mesh and settings; its results lie in STORE/SCENE-MESH-KEY, where KEY is made of the settings, the
executable and the scene's files. What is there is not solved again, so a study that was stopped goes on where it was.
Curves are dictionaries of arrays: the columns of contact.csv or contact_centres.csv of one body, by x1.
"""

import hashlib
import json
import sys
from functools import lru_cache
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import launch
import nodal_stress

SIDES = {"G1": "upper_contact", "G2": "lower_contact"}
METHOD = {"method.multipliers": "quadratic"}  # of the preprint; the other defaults are the scenes' own
STRESS, AT_THE_NODES = "study.stress", "at the nodes"  # a setting of curves only, not of mortise: nodal_stress.py
FILES = {"nodes": "contact.csv", "centres": "contact_centres.csv"}


@lru_cache
def fingerprint(path):
    """Of a file's contents, so that a changed executable or scene is solved again."""
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def scene_files(scene):
    toml = launch.scene_file(scene)
    return [toml, toml.with_suffix(".geo"), *sorted((toml.parent / "common").glob("*.geo"))]


def key_of(scene, settings):
    if not launch.MORTISE.is_file():
        raise launch.MortiseError(f"{launch.MORTISE} is missing: ./dev build makes it, or MORTISE names another")
    parts = [fingerprint(path) for path in (launch.MORTISE, *scene_files(scene))]
    return hashlib.sha256(json.dumps([parts, sorted(settings.items())]).encode()).hexdigest()[:12]


class Store:
    """A folder of results. `solved` counts the runs that were not there, `refused` names what mortise did not run."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.solved = 0
        self.tables = {}

    def run(self, scene, mesh, settings, fields=False):
        """Folder of the results. `fields`: result.vtu too, which is large and else thrown away."""
        settings = {**launch.sizes(mesh), **settings}
        folder = self.folder / f"{scene}-{mesh[0]}x{mesh[1]}-{key_of(scene, settings)}"
        whole = (folder / "settings.json").is_file() and (not fields or (folder / "result.vtu").is_file())
        if not whole:
            folder.parent.mkdir(parents=True, exist_ok=True)
            launch.solve(scene, settings, folder)
            for name in ["contact.vtu"] + ([] if fields else ["result.vtu"]):
                (folder / name).unlink()
            (folder / "settings.json").write_text(json.dumps(settings, indent=1) + "\n")  # the last: all is there
            self.solved += 1
        return folder

    def nodal_stresses(self, scene, mesh, settings):
        """Path of the stresses taken at the nodes, row by row of contact.csv. Needs result.vtu once."""
        path = self.run(scene, mesh, settings) / "nodal_stress.csv"
        if not path.is_file():
            fields = path.with_name("result.vtu")
            kept = fields.is_file()
            self.run(scene, mesh, settings, fields=True)
            launch.write_csv(path, nodal_stress.at_contact(path.parent, self.table(path.with_name("contact.csv"))))
            if not kept:
                fields.unlink()
        return path

    def table(self, path):
        if path not in self.tables:
            self.tables[path] = {name: np.array(values) for name, values in launch.columns(path).items()}
        return self.tables[path]

    def curve(self, scene, mesh, settings, body, at="nodes"):
        """Columns of one body's contact line by x1, at its nodes or its element centres."""
        settings = dict(settings)
        direct = settings.pop(STRESS, None) == AT_THE_NODES and at == "nodes"
        table = self.table(self.run(scene, mesh, settings) / FILES[at])
        if direct:
            table = {**table, **self.table(self.nodal_stresses(scene, mesh, settings))}
        here = np.flatnonzero(table["curve"] == SIDES[body])
        order = here[np.argsort(table["x"][here])]
        curve = {name: values[order] for name, values in table.items()}
        return nodal_stress.replaced(curve) if direct else curve


def on_side(body):
    """The multipliers on this body's contact line."""
    return {"contact.multipliers_on": SIDES[body]}
