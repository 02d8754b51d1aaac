"""How the rollers of a bearing with stiff rings share its load: as Stribeck (1901) and Sjovall (1933) say."""

import numpy as np
import pytest
from scipy.optimize import brentq

import launch

YOUNG, POISSON, LOAD = 210e3, 0.3, np.pi * (30**2 - 20**2)  # geo/rollers.toml
RADIUS, RACES = 5, (-30, 40)  # of a roller; of the races, < 0 where they are convex towards it


def shares(rollers, play):
    """Forces of the rollers from the lowest on: each gives way by what is left of the play of both its contacts, as a cylinder
    between rigid bodies (Johnson 1985, eq. 5.57, half of it a contact)."""
    modulus = YOUNG / (1 - POISSON**2)
    curvatures = [1 / RADIUS - 1 / race for race in RACES]

    def approach(force):
        half_widths = [np.sqrt(4 * force / (np.pi * modulus * curvature)) for curvature in curvatures]
        return sum(force / (np.pi * modulus) * (2 * np.log(4 * RADIUS / a) - 1) for a in half_widths)

    falls = np.cos(2 * np.pi * np.arange(rollers) / rollers)
    of = lambda given: brentq(lambda force: approach(force) - given, 1e-9, 10 * LOAD) if given > approach(1e-9) else 0
    forces = lambda shift: np.array([of(shift * fall - play) for fall in falls])
    return forces(brentq(lambda shift: forces(shift) @ falls - LOAD, play, play + approach(LOAD)))


@pytest.mark.parametrize("rollers, play", [(10, 0), (11, 0), (9, 2e-3)])
def test_rollers_share_the_load_of_stiff_rings(mortise, tmp_path, rollers, play):
    changes = {"mesh.parameters": f"{{rollers={rollers}}}", "contact.0.clearance": play / 2, "bodies.inner": "stiff",
               "bodies.outer": "stiff", "materials.stiff": "{ young = 210e6, poisson = 0.3 }"}  # fmt: skip
    pairs = launch.solve("rollers", changes, tmp_path, "--accuracy", "5%", expected=[0])["contact"]
    outer = {name: np.hypot(*pair["force"]) for pair in pairs for name in pair["between"] if name.endswith("_out")}
    found, expected = np.array([outer[f"roller_{k}_out"] for k in range(rollers)]), shares(rollers, play)
    assert np.abs(found - expected).max() < 0.005 * expected.max()
    if play == 0:  # Stribeck: 4.08 F / Z on the lowest, of any number of rollers; Sjovall: more with play
        assert abs(rollers * found[0] / LOAD - 4.08) < 0.04


def test_rollers_without_load_answer_any_load_on_the_shaft(mortise, tmp_path):
    """What refinement leaves of their balance is round-off of the others' forces, and no tension."""
    scales = 10 ** np.random.default_rng(1).uniform(-2, 1, 15)
    for rollers, fine, some in [(9, 0.06, scales), (12, 0.02, [0.9982, 0.02678])]:  # by the factor of all; body by body
        cases = ", ".join(f'{{name="case_{k}", scale={scale:.4g}}}' for k, scale in enumerate(some))
        changes = {"mesh.parameters": f"{{rollers={rollers}, fine={fine}, coarse=5}}", "case": f"[{cases}]"}
        options = launch.options(changes)
        launch.call("solve", launch.scene_file("rollers"), *options, "--no-estimate", "-o", tmp_path, expected=[0])
