"""The benchmarks by FreeFEM (freefem/active_set.edp), on mortise's meshes: P2 on 6-node triangles or on two triangles of each
quadrilateral, with straight sides, and the same multipliers, gaps and segments, which the cross-check writes out for it."""

import sys
import tempfile
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.with_name("crosscheck")))

import benchmark_cases
import cases
import launch
import run as crosscheck
import scene as scenes

METHOD = {"order": 2, "multipliers": "linear", "integration": "segments", "gauss": 5}


def execute(run):
    """`error` of p as of mortise's runs, processor `seconds` of FreeFEM without its mesh; or why it `failed`."""
    case = benchmark_cases.by_name(run["case"])
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        path, mesh = folder / "scene.toml", folder / "mesh.msh"
        path.write_text(benchmark_cases.scene_text(case, run["size"]))
        launch.call("mesh", path, "-o", mesh)
        side = launch.solve(path, {}, folder / "out")["method"]["multipliers_on"][0]
        scene = scenes.read_scene(path, {})
        gap = "scene" if "initial_gap" in scene["contact"][0] and scene["contact"][0]["initial_gap"] != "curve" else "curve"
        step = cases.Step(case.name, (), side, {}, {}, METHOD, "unilateral", gap, same_nodes=False)
        crosscheck.convert_step(step, scene, mesh, folder)
        before = launch.processor_seconds()
        try:
            crosscheck.call_freefem(crosscheck.SCRIPTS["unilateral"], folder=folder)
        except launch.StudyError as failure:
            lost = "contact is lost everywhere" in str(failure)  # its active set starts closed, without springs
            return {"failed": "loses all contact" if lost else str(failure), "error": None, "seconds": None}
        seconds = launch.processor_seconds() - before
        _, x, y, p, _ = np.loadtxt(folder / "freefem_contact.txt").T
    at = benchmark_cases.places(case, {"x": x, "y": y})
    return {"failed": "", "error": benchmark_cases.error(case, at, p), "seconds": seconds}


def rows(store, wanted):
    """Of each (case, size) a row, or none without FreeFEM."""
    if crosscheck.find_freefem() is None:
        print("SKIPPED: FreeFem++ is not on the PATH: ./dev setup installs it")
        return []
    return store.rows([{"case": case, "size": size, "by": "FreeFEM"} for case, size in wanted], execute, "FreeFEM")
