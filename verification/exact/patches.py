"""The contact patch test (R. Taylor & P. Papadopoulos 1991; N. El-Abbasi & K.-J. Bathe, Comput. Struct. 79 (2001) 1473):
a block on a wider one under one pressure on both; p must be that pressure on meshes that do not match."""

from pathlib import Path

import numpy as np

import launch

HERE = Path(__file__).resolve().parent
ELEMENTS = {
    "3-node triangles": (1, 0),
    "4-node quadrilaterals": (1, 1),
    "6-node triangles": (2, 0),
    "8-node quadrilaterals": (2, 1),
}  # order, quads
ROUND_OFF = 1e-10
SCENE = """
materials.steel = { young = 210e3, poisson = 0.3 }
bodies = { lower = "steel", upper = "steel" }
boundary = [
  { on = "axis", displacement = { x = 0 } },
  { on = "ground", displacement = { y = 0 } },
  { on = ["head", "rest"], pressure = 100 },
]
"""


def execute(run):
    """`error`: the largest of p at the nodes, over p."""
    order, quads = ELEMENTS[run["patch"]]
    side = f'multipliers_on = "{run["side"]}_contact"'
    pair = f'contact = [{{ between = ["lower_contact", "upper_contact"], {side} }}]'
    mesh = f'mesh.file = "{HERE / "patch.geo"}"\nmesh.parameters = {{ order = {order}, quads = {quads} }}\n'
    error = lambda folder, _: {"error": float(np.abs(launch.contact(folder)["p"] / 100 - 1).max())}
    return launch.measured(mesh + SCENE + pair, error)


def rows(store):
    wanted = [{"patch": name, "side": side} for name in ELEMENTS for side in ("lower", "upper")]
    return store.rows(wanted, execute, "patch test")


def wrong(found):
    """What does not hold: texts."""
    return [f"patch test: {row}" for row in found if row["failed"] or not row["error"] < ROUND_OFF]
