"""Curves for the gallery: a reading of "active", our method, and the variant that comes nearest to the preprint's."""

import json
from dataclasses import dataclass

import cause
import oscillation
import paper_runs
import preprint

DDM = {
    "method.solver": "ddm",
    "method.dirichlet": "upper",
    "mesh.parameters.order": 1,
    "mesh.parameters.kind": 1,
    "contact.initial_gap": "closed",
}


@dataclass(frozen=True)
class View:
    store: paper_runs.Store
    reading: str  # of preprint.MAPPINGS
    like: str  # variant of cause.VARIANTS

    def settings(self, active, variant):
        return {**cause.VARIANTS[variant], **paper_runs.on_side(preprint.MAPPINGS[self.reading](active))}

    def curve(self, scene, mesh, active, body, at="nodes", variant=cause.OURS):
        return self.store.curve(scene, mesh, self.settings(active, variant), body, at)

    def both(self, *arguments, **options):
        scene, mesh, active = arguments
        return [self.curve(scene, mesh, active, body, **options) for body in ("G1", "G2")]

    def matching(self, scene, mesh, body, at="nodes", variant=cause.OURS):
        return oscillation.matching_curve(self.store, scene, mesh, cause.VARIANTS[variant], body, at)

    def folder_with_fields(self, scene, mesh, active, variant=cause.OURS):
        settings = {key: value for key, value in self.settings(active, variant).items() if key != paper_runs.STRESS}
        return self.store.run(scene, mesh, settings, fields=True)

    def cosine(self, mesh, active, body):
        return self.store.curve("cosine", mesh, {**paper_runs.METHOD, **self.sides(active)}, body)

    def cosine_status(self, mesh, method):
        """How the run ends with the multipliers on the side that the program chooses."""
        folder = self.store.run("cosine", mesh, method)
        return json.loads((folder / "summary.json").read_text())["status"]

    def sides(self, active):
        return paper_runs.on_side(preprint.MAPPINGS[self.reading](active))

    def ddm(self, scene, mesh, body):
        return self.store.curve(scene, mesh, DDM, body)

    def ddm_folder(self, scene, mesh):
        return self.store.run(scene, mesh, DDM)
