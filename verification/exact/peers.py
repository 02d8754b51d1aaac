"""The benchmarks by other programs on mortise's meshes, with multipliers on the same side.

FreeFEM (freefem/active_set.edp): P2 on 6-node triangles or on two triangles of each quadrilateral, with straight sides, and
the gaps and segments that the cross-check writes out for it. GetFEM (chart/getfem_contact.py): the mesh's own elements.
"""

import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.with_name("crosscheck")), str(HERE.with_name("chart"))]

import benchmark_cases
import by_getfem
import launch
import on_mesh
import run as crosscheck
import scene as scenes

# FreeFEM's active set starts closed, without springs.
FAILURES = {"contact is lost everywhere": "loses all contact", "no convergence": "does not converge"}


def execute(run):
    """`error` of p as of mortise's runs, processor `seconds` of the program, its start included; or why it `failed`."""
    case = benchmark_cases.by_name(run["case"])
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        path, mesh = folder / "scene.toml", folder / "mesh.msh"
        path.write_text(benchmark_cases.scene_text(case, run["size"]))
        launch.call("mesh", path, "-o", mesh)
        side = launch.solve(path, {}, folder / "out")["method"]["multipliers_on"][0]
        before = launch.processor_seconds()
        try:
            if run["by"] == "FreeFEM":
                lines = on_mesh.line(scenes.read_scene(path, {}), mesh, [side], folder)
            else:
                lines = by_getfem.contact(path, mesh, side, folder)
        except launch.StudyError as failure:
            said = next((short for long, short in FAILURES.items() if long in str(failure)), str(failure))
            return {"failed": said, "error": None, "seconds": None}
        seconds = launch.processor_seconds() - before
    _, x, y, p, *_ = lines.T
    at = benchmark_cases.places(case, {"x": x, "y": y})
    return {"failed": "", "error": benchmark_cases.error(case, at, p), "seconds": seconds}


def found(by):
    """Of GetFEM, or where FreeFEM lies; None where the program is missing."""
    return crosscheck.find_freefem() if by == "FreeFEM" else by_getfem.version()


def rows(store, wanted, by):
    """Of each (case, size) a row, or none without the program."""
    if found(by) is None:
        print(f"SKIPPED: {by} is not there")
        return []
    return store.rows([{"case": case, "size": size, "by": by} for case, size in wanted], execute, by)
