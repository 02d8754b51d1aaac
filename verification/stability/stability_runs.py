"""Runs of the stability studies: each is a scene with settings; its row says how it ended and what was measured.

A run is a dictionary: `axes` (what the study varies, for people and pictures), `scene` (a name in geo/, or the text of
a scene file), `settings` (--set), `files` (texts beside that scene file), `measures` (names of functions below, which
take the results folder and the run and return named figures), `arguments` (more words for the command line),
`from_mesh` (the mesh is written first, and read without the geometry).
"""

import hashlib
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

import launch
from lame import RINGS, lame

SHORT = 2.0  # seconds: runs that are timed and shorter are repeated
REPEATS = 3
TIME_LIMIT = 60  # seconds for one run; the longest takes about 3
OUTCOMES = {None: "hang", 0: "solved", 1: "refused", 2: "check", 3: "internal error"}  # by exit status
ESTIMATED_ERROR = "estimated error of p above 10 % (a warning)"  # beside the checks that fail


def outcome(status):
    return OUTCOMES.get(status, f"crash ({status})")


def write_scene(run, folder):
    """The scene file of the run: geo's, or the run's own text with its other files beside it."""
    for name, text in run.get("files", {}).items():
        (folder / name).write_text(text)
    if "\n" not in run["scene"]:
        return launch.scene_file(run["scene"])
    path = folder / "scene.toml"
    path.write_text(run["scene"])
    return path


def message(stderr, folder):
    """What mortise says, without the paths."""
    text = stderr.strip().splitlines()[0] if stderr.strip() else ""
    return text.replace(f"{folder}/", "").replace(f"{launch.ROOT}/", "").removeprefix("mortise: ")


def execute(run):
    """The row of one run: axes, outcome, message, seconds, and what the measures say."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        out = folder / "out"
        scene, settings = write_scene(run, folder), run.get("settings", {})
        if run.get("from_mesh"):
            launch.call("mesh", scene, *launch.options(settings), "-o", folder / "mesh.msh", "--quiet")
            settings = {key: value for key, value in settings.items() if not key.startswith("mesh.")}
            settings |= {"mesh.file": folder / "mesh.msh", "mesh.parameters": "{}"}
        words = ["solve", scene, *launch.options(settings), *run.get("arguments", [])]
        command = [str(word) for word in (launch.MORTISE, *words, "-o", out, "--quiet")]
        start, status, stderr = time.monotonic(), None, ""
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=TIME_LIMIT, check=False)
            status, stderr = done.returncode, done.stderr
        except subprocess.TimeoutExpired:
            pass
        row = {**run["axes"], "outcome": outcome(status), "message": message(stderr, folder)}
        row["seconds"] = time.monotonic() - start
        if status in launch.SOLVED:
            for measure in ("summary", *run.get("measures", [])):
                row.update(globals()[measure](out, run))
            if row["status"] == "not_converged":
                row["outcome"] = "not converged"
        return row


def is_of_the_curves(warning):
    """What these scenes mean: "closed" leaves out the gaps of coarse meshes of one curve. Other warnings come first."""
    return "leaves out gaps" in warning


def summary(folder, run):
    """Of summary.json: how it ended, steps, the checks that fail and the warning of p, warnings, the estimate."""
    table = launch.summary(folder)
    checks = {check["name"]: check["value"] for check in table["checks"]}
    failed = [check["name"] for check in table["checks"] if not check["ok"]]
    pressure = table["estimate"]["pressure"] or {"error": None, "singular": []}
    if (pressure["error"] or 0) > 0.1:  # as in src/results/error_report.hpp
        failed.append(ESTIMATED_ERROR)
    return {
        "status": table["status"],
        "failed_checks": "; ".join(failed),
        "warnings": " | ".join(sorted(table["warnings"], key=is_of_the_curves))[:1000],
        "warning_count": len(table["warnings"]),
        "steps": table["iterations"]["contact"],
        "interface_steps": table["iterations"]["solver"],
        "factor": (table["iteration"] or {}).get("convergence_rate"),
        "force_residual": checks.get("residual of the forces"),
        "row_residual": checks.get("residual of the contact condition"),
        "covered": next((value for name, value in checks.items() if "cover the closed" in name), None),
        "p_estimated": pressure["error"],
        "pressure_exponent": min((point["pressure_exponent"] for point in pressure["singular"]), default=None),
        "energy": table["energy"],
        "multipliers": table["mesh"]["multipliers"],
        "p_max_summary": table["contact"][0]["pressure"]["max"] if table["contact"] else None,
    }


def inf_sup(folder, run):
    """The inf-sup constant of a run with --diagnose."""
    return {"inf_sup": launch.summary(folder)["inf_sup"]}


def multiplier_side(folder):
    """s, x, y, p along the multiplier side of the first pair."""
    side = launch.contact(folder)
    return {name: np.nan_to_num(side[name][side["pair"] == 0]) for name in ("s", "x", "y", "p")}


def pressure(folder, run):
    """p along the multiplier side as lists, and its extremes."""
    side = multiplier_side(folder)
    profile = {name: side[name].tolist() for name in ("s", "x", "p")}
    return {"p_min": float(side["p"].min()), "p_max": float(side["p"].max()), "profile": profile}


def uniform(folder, run):
    """Patch tests: largest |p - exact| over the exact pressure, run["exact"] (10 MPa where it is not given)."""
    exact = run.get("exact", 10e6)
    return {"p_error": float(np.abs(multiplier_side(folder)["p"] - exact).max() / abs(exact))}


def uniform_facing(folder, run):
    """As uniform, of the multipliers up to run["last"], where the last edge ends that faces the other side: p_error;
    and of p at the nodes that face it themselves: p_error_facing. The edges are run["edge"] long."""
    side, exact = launch.contact(folder), run.get("exact", 10e6)
    error, at = np.abs(side["p"] / exact - 1), side["x"] / run["edge"]
    near = (side["x"] < run["last"] + 1e-9) & (side["p"] != 0)
    if run["settings"].get("method.multipliers") == "linear":
        near &= np.abs(at - np.round(at)) < 1e-6  # the vertices
    return {"p_error": float(error[near].max()), "p_error_facing": float(error[~np.isnan(side["gap"])].max())}


def rings(folder, run):
    """Against Lame, relative: p in the mean square and at most; materials are run["materials"] or the scene's."""
    exact, _ = lame(run.get("materials", RINGS["materials"]))
    side = multiplier_side(folder)
    s, error = side["s"], side["p"] / exact - 1
    mean_square = float(np.sqrt(np.trapz(error**2, s) / (s[-1] - s[0])))
    return {"p_error": float(np.abs(error).max()), "p_error_l2": mean_square, "p_exact": exact}


def rings_fields(folder, run):
    """Against Lame: u (largest nodal error over the largest displacement), and the mean stress (exact: constant in each
    ring) over the contact pressure, roots of the mean square, at the elements' centres and at the nodes."""
    import meshio

    materials = run.get("materials", RINGS["materials"])
    pressure_exact, exact = lame(materials)
    mesh = meshio.read(folder / "result.vtu")
    body = np.concatenate([np.asarray(block).ravel() for block in mesh.cell_data["body"]]).astype(int)
    stress = np.concatenate([np.asarray(block) for block in mesh.cell_data["stress_centre"]])
    radius = np.hypot(mesh.points[:, 0], mesh.points[:, 1])
    of_point = np.zeros(len(mesh.points), dtype=int)
    for block, numbers in zip(mesh.cells, np.split(body, np.cumsum([len(b.data) for b in mesh.cells])[:-1])):
        of_point[block.data] = numbers[:, None]
    u_exact = np.where(of_point == 0, exact[0][2](radius), exact[1][2](radius))[:, None] * mesh.points / radius[:, None]
    error = np.linalg.norm(mesh.point_data["displacement"][:, :2] - u_exact[:, :2], axis=1)
    of_ring = np.array([2 * (1 + materials[b][1]) / 3 * exact[b][0] for b in (0, 1)])
    off = lambda tensors, ring: float(np.sqrt(((tensors[:, :3].sum(axis=1) / 3 - of_ring[ring]) ** 2).mean()))
    return {
        "u_error": float(error.max() / np.linalg.norm(u_exact, axis=1).max()),
        "mean_stress_error": off(stress, body) / pressure_exact,
        "nodal_mean_stress_error": off(mesh.point_data["stress"], of_point) / pressure_exact,
    }


def digests(folder, run):
    """Hashes of the files that a repeated run must write again bit for bit."""
    digest = lambda name: hashlib.sha1((folder / name).read_bytes()).hexdigest()
    return {f"sha1_{name}": digest(name) for name in ("contact.csv", "contact_centres.csv", "result.vtu")}


def sweep(store, scene, settings, vary):
    """Rows of `mortise sweep` (launch.sweep), kept."""
    run = {"scene": scene, "settings": settings, "vary": {key: list(map(str, values)) for key, values in vary.items()}}
    return store.row(run, lambda _: launch.sweep(scene, settings, vary), "sweep")


def ended(row, most_steps=0):
    """converged, diverged or unfinished, of an iteration that stops before `most_steps` only if it is done or diverges;
    a check that fails on a coarse mesh is none of these matters."""
    if row["status"] != "not_converged":
        return "converged"
    return "diverged" if row["iteration.steps"] < most_steps or row["iteration.convergence_rate"] > 1 else "unfinished"


def timed(run):
    """Seconds, steps, residuals and pressures of a run."""
    with tempfile.TemporaryDirectory() as folder:
        summary = launch.solve(run["scene"], run["settings"], folder)
        contact = launch.columns(Path(folder) / "contact.csv")
    checks = {check["name"]: check["value"] for check in summary["checks"]}
    return {
        "seconds": summary["seconds"]["factorise"] + summary["seconds"]["solve"],
        "steps": summary["iterations"]["solver"],
        "unknowns": summary["mesh"]["dofs"],
        "multipliers": summary["mesh"]["multipliers"],
        "outcome": "unfinished" if summary["status"] == "not_converged" else "converged",
        "force": checks["residual of the forces"],
        "kinematic": checks["residual of the contact condition"],
        "p": contact["p"].tolist(),
    }


def shortest(run):
    """The quickest of REPEATS runs, or the only one if it is long."""
    found = [timed(run)]
    while len(found) < REPEATS and found[0]["seconds"] < SHORT:
        found.append(timed(run))
    return min(found, key=lambda one: one["seconds"])
