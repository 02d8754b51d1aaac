"""Model no more than a scene needs: what half of a symmetric scene, bilateral contact and linear elements save.

half        Scenes that are symmetric about x1 = 0.4 m, whole and as their left half with symmetry there, on meshes that
            coincide (even in x1). Both must have the same p on the left half.
condition   Scenes where nothing opens, as unilateral and as bilateral contact: p must be the same.
elements    For an answer to 5 % and 1 % in p: the quickest mesh of linear and of quadratic elements (from chart.csv).

Seconds are those of assembly to recovery in summary.json, one thread, medians of repeats in turns; `whole` has meshing
and writing too.
"""

import statistics
import tempfile
from pathlib import Path

import numpy as np

import chart_runs  # makes launch known
import launch
import pareto
from chart_methods import PANELS

SAME = 1e-9  # of the largest p
HALVES = ("parabola_1", "circle", "tent_a", "tent_b", "tent_c")
CONDITIONS = ("parabola_1", "circle", "rings")
MESH = {"full": (128, 160), "quick": (32, 40)}
REPEATS = {"full": 3, "quick": 2}


def replaced(text, old, new, path):
    if old not in text:
        raise launch.StudyError(f"{path}: expected '{old}', of which the half model is made")
    return text.replace(old, new)


def half_scene(name, folder):
    """The left half of geo/NAME.toml as a scene of its own in the folder; returns its path.

    Of the geometry's text: half the width, twice as many rows for the same columns, the line up to the middle.
    """
    geo = launch.ROOT / "geo"
    (folder / "common").mkdir(parents=True, exist_ok=True)
    (folder / "common/body.geo").write_text((geo / "common/body.geo").read_text())
    plates = (geo / "common/two_plates.geo").read_text()
    plates = replaced(plates, "width = 0.8;", "width = 0.4;", "two_plates.geo")
    plates = replaced(plates, "Round(3 * n / 8)", "Round(3 * n / 4)", "two_plates.geo")
    (folder / "common/two_plates.geo").write_text(plates)
    text = (geo / f"{name}.geo").read_text()
    knots = "knots[] = {0, 0.8};" if "knots[] = {0, 0.8};" in text else "knots[] = {0, 0.4, 0.8};"
    (folder / f"half_{name}.geo").write_text(replaced(text, knots, "knots[] = {0, 0.4};", f"{name}.geo"))
    toml = (geo / f"{name}.toml").read_text()
    path = folder / f"half_{name}.toml"
    path.write_text(replaced(toml, f'file = "{name}.geo"', f'file = "half_{name}.geo"', f"{name}.toml"))
    return path


def solve(scene, settings, folder):
    """summary.json of one run on one thread, with the seconds of the process as `process`."""
    process = launch.call("solve", scene, *launch.options(settings), "-o", folder, "--quiet", "--threads", 1)
    return {**launch.summary(folder), "process": process}


def stages(summary):
    own = summary["seconds"]
    return own["total"] - own["mesh"] - own["write"]


def pressure(folder):
    """x and the multiplier's p along its side."""
    side = launch.contact(folder)
    return np.stack([side["x"], side["p_multiplier"]], axis=1)


def compare(study, scene, named, folder, repeats):
    """One row for each of two named ways (path, settings) to solve a scene, the seconds' medians taken in turns."""
    summaries = {name: [] for name in named}
    for _ in range(repeats):
        for name, (path, settings) in named.items():
            summaries[name].append(solve(path, settings, folder / f"{scene}_{name}"))
    tables = [pressure(folder / f"{scene}_{name}") for name in named]
    difference = largest_difference(*tables) / np.abs(tables[0][:, 1]).max()
    for name in named:
        first = summaries[name][0]
        yield {
            **{"study": study, "scene": scene, "way": name, "unknowns": first["mesh"]["dofs"]},
            "steps": first["iterations"]["contact"],
            "seconds": statistics.median(map(stages, summaries[name])),
            "whole": statistics.median(summary["process"] for summary in summaries[name]),
            "difference_of_p": difference,
        }


def largest_difference(first, second):
    """Of p at the nodes of the second, which must be among those of the first."""
    rows = np.array([np.argmin(np.abs(first[:, 0] - x)) for x in second[:, 0]])
    if np.abs(first[rows, 0] - second[:, 0]).max() > 1e-9:
        return np.inf
    return np.abs(first[rows, 1] - second[:, 1]).max()


def halves(mesh, folder, repeats):
    for scene in HALVES:
        even = {} if scene.startswith("tent") else {"mesh.parameters.spacing": 1}
        whole, half = ({**launch.sizes(size), **even} for size in (mesh, [n // 2 for n in mesh]))
        named = {"whole": (launch.scene_file(scene), whole), "half": (half_scene(scene, folder / "scenes"), half)}
        yield from compare("half", scene, named, folder, repeats)


def conditions(mesh, folder, repeats):
    for scene in CONDITIONS:
        rings = {"mesh.parameters.n_inner": mesh[0], "mesh.parameters.n_outer": mesh[1]}
        sizes = rings if scene == "rings" else launch.sizes(mesh)
        named = {condition: (launch.scene_file(scene), {**sizes, "contact.condition": condition})
                 for condition in ("unilateral", "bilateral")}
        yield from compare("condition", scene, named, folder, repeats)


def elements(rows):
    """The quickest mesh of each kind of element for 5 % and 1 % in p, from the rows of chart.csv."""
    for problem in dict.fromkeys(row["problem"] for row in rows):
        for method in ("t3_linear", "q4_linear", "t6_linear", "q8_linear"):
            mine = [row for row in rows if row["problem"] == problem and row["method"] == method]
            found = pareto.advice(mine, PANELS[problem][0], (0.05, 0.01))
            for target, row in found.items():
                seconds = {"mesh": row["mesh"], "unknowns": row["dofs"], "seconds": row["s_total"]} if row else {}
                yield {"problem": problem, "method": method, "target": target, **seconds}


def measure(store, quick):
    """The rows of `half` and `condition`."""
    size = "quick" if quick else "full"

    def make(run):
        with tempfile.TemporaryDirectory() as folder:
            arguments = MESH[size], Path(folder), REPEATS[size]
            return [*halves(*arguments), *conditions(*arguments)]

    return store.row(["economy", HALVES, CONDITIONS, MESH[size], REPEATS[size]], make, "economy")
