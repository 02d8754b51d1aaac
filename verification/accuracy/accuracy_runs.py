"""What the study runs: the scenes, what is asked of them, the first meshes; and a run as a row."""

import math
import tempfile
import time
from pathlib import Path

import launch
import persson

HERE = Path(__file__).resolve().parent
STABILITY = HERE.with_name("stability")

ANGLE = math.radians(80)  # where the pin's contact ends
STIFFNESS = 210e9 / (1 - 0.3**2)  # E / (1 - nu^2) of all steel here
PIN = STIFFNESS * 1e-4 / persson.clearance(ANGLE)  # the pin's weight
FIRST_EDGES = [10, 14, 20, 28, 40]
ROUGH, FINE = [0.05, 0.01, 0.001], [0.05, 0.01, 0.001, 0.0001]
ASKED = {
    "parabola_1": FINE,
    "parabola_2": FINE,
    "circle": FINE,
    "tent_b": ROUGH,
    "punch": FINE,
    "rings": FINE,
    "hertz": sorted([*FINE, 0.002], reverse=True),
    "cosine": ROUGH,
    "pin": ROUGH,
    "arm": ROUGH,
}
BORDERS = ("hertz", "cosine", "pin", "arm")  # where contact ends is found
PATHS = {"pin": STABILITY / "pin.toml", "arm": HERE / "arm.toml"}
SETTINGS = {"pin": {"mesh.parameters.clearance": 1e-4, "body_force.0.force": f"[0, {-PIN / math.pi!r}]"}}
REFERENCES = {"hertz": 5e-5}  # what is asked for the reference; else a twentieth of the least
REFERENCE_EDGES, REFERENCE_UNKNOWNS = [24, 34], 300000
KEPT = ("accuracy", "estimate", "energy", "seconds", "mesh", "status", "warnings")


def answer(scene, asked, first_edges=20, **more):
    """A run of the program."""
    settings = SETTINGS.get(scene, {}) | {"accuracy.value": asked, "accuracy.first_edges": first_edges} | more
    return {"scene": scene, "settings": settings}


def answers(scene, quick):
    asked, edges = (ASKED[scene][:2], FIRST_EDGES[:3:2]) if quick else (ASKED[scene], FIRST_EDGES)
    return [answer(scene, value, n) for value in asked for n in edges]


def references(scene, quick):
    """Two, from different first meshes: how far they are apart says what the first can be trusted to."""
    asked = 0.001 if quick else REFERENCES.get(scene, min(ASKED[scene]) / 20)
    return [answer(scene, asked, n, **{"accuracy.unknowns_max": REFERENCE_UNKNOWNS}) for n in REFERENCE_EDGES]


def even(unknowns_of, unknowns):
    """parabola_1 on even meshes of about as many unknowns as an answer, `unknowns_of` being those of 80 x 100."""
    n = round(80 * math.sqrt(unknowns / unknowns_of))
    return {"scene": "parabola_1", "settings": launch.sizes((n, round(1.25 * n)))}


def execute(run):
    """The row of a run: the side of its contact line that has the multipliers, and what its summary says; or `failed`:
    what was said instead."""
    path = PATHS.get(run["scene"], launch.scene_file(run["scene"]))
    with tempfile.TemporaryDirectory() as folder:
        start, used = time.monotonic(), launch.processor_seconds()
        try:
            summary = launch.solve(path, run["settings"], Path(folder))
        except launch.StudyError as error:
            return {"failed": str(error)[-400:]}
        row = {"failed": "", "wall": time.monotonic() - start, "processor": launch.processor_seconds() - used}
        row |= {key: summary.get(key) for key in KEPT}
        side = launch.contact(folder)
    return row | {"line": {key: side[key].tolist() for key in ("s", "x", "y", "p", "p_error")}}


def whole_process(asked, repeats=5):
    """Processor seconds of `mortise solve parabola_1 --accuracy ASKED --quiet`, the least."""
    seconds = []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(repeats):
            used = launch.processor_seconds()
            launch.call("solve", launch.scene_file("parabola_1"), "--accuracy", asked, "-o", folder, "--quiet")
            seconds.append(launch.processor_seconds() - used)
    return min(seconds)
