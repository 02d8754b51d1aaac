#!/usr/bin/python3
"""The Neumann-Dirichlet iteration of mortise against FreeFEM's (freefem/ddm.edp), step by step on the same triangles.

Both start from no pressure, l_1 = 0, and go on by l := (1 - beta) l + beta r, where r(l) is the pressure that the body
with the multipliers takes. FreeFEM's history has l of every step, so that r_k = (l_{k+1} - (1 - beta) l_k) / beta.
mortise writes r_k as the pressure p of contact.csv if it is stopped after k steps. In a step compared are r_k (largest
difference over largest pressure) and the force residual of the history, max |r_k - l_k| / max |r_k|. The upper body
takes the displacement and has the multipliers. Both have the preprint's closed gap and edges' normals. The meshes are
converted as in verification/crosscheck.

Written is iterates.csv. Exit status 1 if a difference is above 1e-8.
"""

import itertools
import sys
import tempfile
import tomllib
from pathlib import Path

import numpy as np

for folder in ("common", "crosscheck"):
    sys.path.append(str(Path(__file__).resolve().parents[1] / folder))

import compare
import launch
import run
from cases import TABLE, one_discretisation_step

SCRIPT = launch.ROOT / "freefem/ddm.edp"
SCENE = "parabola_1"
STEPS = 10
LIMIT = 1e-8
SPACES = ["P1-P1", "P2-P1", "P2-P2"]  # of the displacements and the multipliers, as in crosscheck/cases.toml
SIDE, BODY = "upper_contact", "upper"  # the other body must be held without contact, as only the lower one is
MESHES = {"quick": ["8x10"], "usual": ["8x10", "20x25"]}
RATIOS = {"quick": [1], "usual": [0.1, 1]}  # of Young's moduli, upper over lower body
BETAS = {"quick": [0.3, 0.9], "usual": [0.1, 0.3, 0.5, 0.9]}  # with 0.9 and equal stiffness it diverges


def cases(size):
    """One iteration each, run by both programs."""
    every = itertools.product(MESHES[size], SPACES, RATIOS[size], BETAS[size])
    return [dict(zip(("mesh", "space", "ratio", "beta"), values)) for values in every]


def step_of(case):
    """As verification/crosscheck describes a mesh and a discretisation."""
    table = tomllib.loads(TABLE.read_text())
    return one_discretisation_step(table, SCENE, case["mesh"], SIDE, case["space"], "segments")


def with_stiffness(scene, ratio):
    """The scene with an upper body `ratio` times as stiff as the lower one."""
    other = {"young": launch.YOUNG * ratio, "poisson": 0.3}
    materials = {**scene["materials"], "other": other}
    return {**scene, "materials": materials, "bodies": {**scene["bodies"], "upper": "other"}}


def freefem_iterates(case, folder):
    """Places of the multipliers, r_1 to r_STEPS at them (fewer if it has converged), and the force residuals."""
    beta = case["beta"]
    run.call_freefem(SCRIPT, "-beta", repr(beta), "-steps", STEPS + 1, folder=folder, expected=(0, 2))
    places = np.loadtxt(folder / "freefem_contact.txt", ndmin=2)[:, 1:3]
    history = np.loadtxt(folder / "freefem_history.txt", ndmin=2)
    l, converged = history[:, 3:], history[-1, 1:3].max() < 1e-8
    if l.shape[1] != len(places) or not (len(l) == STEPS + 1 or len(l) > 1 and converged):
        raise launch.StudyError(f"FreeFEM's history has the shape {l.shape}; expected {(STEPS + 1, len(places))}")
    r = (l[1:] - (1 - beta) * l[:-1]) / beta
    return places, r, np.abs(r - l[:-1]).max(axis=1) / np.abs(r).max(axis=1)


def mortise_iterates(case, mesh, folder, places, steps):
    """The same of mortise, one run for each step; the last one's history has all residuals."""
    step, found = step_of(case), []
    settings = {
        **launch.stiffness(case["ratio"]),
        **run.settings_of(step, mesh),
        **{"method.solver": "ddm", "method.acceleration": "none", "method.dirichlet": BODY, "method.beta": case["beta"]},
        "method.tolerance": 1e-14,
    }
    for k in range(1, steps + 1):
        results = folder / "mortise"
        launch.solve(SCENE, {**settings, "method.max_iterations": k}, results)
        line = launch.contact(results, SIDE)
        own = np.stack([line["x"], line["y"]], axis=1)
        found.append(line["p_multiplier"][compare.match(places, own, 1.0, f"multipliers on {SIDE}")])
    return np.array(found), launch.columns(results / "iteration.csv")["force"]


def run_case(case):
    """Rows of iterates.csv."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        _, mesh, *_ = run.prepare(step_of(case), folder, lambda scene: with_stiffness(scene, case["ratio"]))
        places, theirs, their_residuals = freefem_iterates(case, folder)
        ours, our_residuals = mortise_iterates(case, mesh, folder, places, len(theirs))
    rows = []
    for k, residual in enumerate(our_residuals[: len(theirs)]):
        pressure = np.abs(ours[k] - theirs[k]).max() / np.abs(theirs[k]).max()
        off = {"pressure_difference": pressure, "residual_difference": abs(residual - their_residuals[k])}
        rows.append({**case, "step": k + 1, "force_residual": residual, **off, "ok": int(max(off.values()) <= LIMIT)})
    return rows


def main(arguments=None):
    options = launch.command_line(__doc__, "iterates", arguments, jobs=False)
    rows = []
    try:
        run.need_programs()
        for case in cases("quick" if options.quick else "usual"):
            found = run_case(case)
            worst = {key: max(row[key] for row in found) for key in ("pressure_difference", "residual_difference")}
            print(case, *(f"{key} {value:.1e}" for key, value in worst.items()), flush=True)
            rows += found
    except launch.StudyError as error:
        sys.exit(f"iterates.py: {error}")
    options.output.mkdir(parents=True, exist_ok=True)
    launch.write_csv(options.output / "iterates.csv", rows)
    print(f"{sum(row['ok'] for row in rows)} of {len(rows)} steps agree; {options.output}/iterates.csv")
    sys.exit(0 if all(row["ok"] for row in rows) else 1)


if __name__ == "__main__":
    main()
