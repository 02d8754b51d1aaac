"""What the atlas measures in a results folder: functions that take the folder and the run, and return named figures."""

import hashlib
import json

import numpy as np

import launch

RINGS = {"radii": (1, 2, 3), "inside": 10e6, "outside": 4e6}  # geo/rings.toml
AGAINST_SIGMA_N = "p against sigma_n (a warning)"  # beside the checks that fail
END = 0.1  # of the length of a curve, left out at either end where a scene has corners there


def is_of_the_curves(warning):
    """What these scenes mean: "closed" leaves out the gaps of coarse meshes of one curve. Other warnings come first."""
    return "leaves out gaps" in warning


def summary(folder, run):
    """Of summary.json: how it ended, steps, the checks that fail and the warning of p against sigma_n, warnings."""
    table = json.loads((folder / "summary.json").read_text())
    checks = {check["name"]: check["value"] for check in table["checks"]}
    failed = [check["name"] for check in table["checks"] if not check["ok"]]
    compared = (table["contact"][0]["against_sigma_n"] or {}) if table["contact"] else {}
    if compared.get("difference", 0) > 0.1:  # as in src/results/warnings.cpp
        failed.append(AGAINST_SIGMA_N)
    iteration = table["iteration"] or {}
    return {
        "status": table["status"],
        "failed_checks": "; ".join(failed),
        "warnings": " | ".join(sorted(table["warnings"], key=is_of_the_curves))[:1000],
        "warning_count": len(table["warnings"]),
        "steps": table["iterations"]["contact"],
        "interface_steps": table["iterations"]["solver"],
        "factor": iteration.get("convergence_rate"),
        "force_residual": checks.get("residual of the forces"),
        "row_residual": checks.get("residual of the contact condition"),
        "against_stress": compared.get("difference"),
        "covered": checks.get("segments (or points) cover the closed contact curve")
        or checks.get("segments cover the closed contact curve"),
        "multipliers": table["mesh"]["multipliers"],
        "energy": table["energy"],
        "p_max_summary": table["contact"][0]["pressure"]["max"] if table["contact"] else None,
    }


def inf_sup(folder, run):
    """The inf-sup constant of a run with --diagnose."""
    return {"inf_sup": json.loads((folder / "summary.json").read_text())["inf_sup"]}


def multiplier_side(folder):
    """s, x, y, p along the multiplier side of the first pair."""
    columns = launch.columns(folder / "contact.csv")
    first = columns["curve"][0]
    rows = [i for i, (pair, curve) in enumerate(zip(columns["pair"], columns["curve"])) if (pair, curve) == (0, first)]
    return {name: np.array([columns[name][i] or 0.0 for i in rows], dtype=float) for name in ("s", "x", "y", "p")}


def mean_square(s, values):
    """Mean of values^2 along s (trapezia)."""
    return float(np.sqrt(np.trapz(values**2, s) / (s[-1] - s[0])))


def pressure(folder, run):
    """p along the multiplier side as lists, and its extremes."""
    side = multiplier_side(folder)
    return {
        "p_min": float(side["p"].min()),
        "p_max": float(side["p"].max()),
        "profile": {"s": side["s"].tolist(), "x": side["x"].tolist(), "p": side["p"].tolist()},
    }


def swing(folder, run):
    """How p swings from node to node: |p[i-1] - 2 p[i] + p[i+1]| / 4, mean and largest, over the mean |p|; no END."""
    side = multiplier_side(folder)
    s, p = side["s"] / side["s"][-1], side["p"]
    second = np.abs(np.diff(p, 2)) / 4
    inside = (s[1:-1] > END) & (s[1:-1] < 1 - END)
    size = np.abs(p).mean()
    if not inside.any() or size == 0:
        return {"swing_mean": None, "swing_max": None}
    return {"swing_mean": float(second[inside].mean() / size), "swing_max": float(second[inside].max() / size)}


def uniform(folder, run):
    """Patch tests: largest |p - exact| over the exact pressure, run["exact"] (10 MPa where it is not given)."""
    exact = run.get("exact", 10e6)
    return {"p_error": float(np.abs(multiplier_side(folder)["p"] - exact).max() / abs(exact))}


def ring(young, poisson, inside, outside, a, b):
    """Coefficients of sigma_r = A - B / r^2 and u_r = (1 + nu) / E ((1 - 2 nu) A r + B / r), plane strain (Lame)."""
    A = (inside * a**2 - outside * b**2) / (b**2 - a**2)
    B = (inside - outside) * a**2 * b**2 / (b**2 - a**2)
    u = lambda r: (1 + poisson) / young * ((1 - 2 * poisson) * A * r + B / r)
    return A, u


def lame(materials):
    """Exact contact pressure of geo/rings.toml, and u_r and the mean stress in either ring."""
    a, b, c = RINGS["radii"]
    gap = lambda p: (
        ring(*materials[1], p, RINGS["outside"], b, c)[1](b) - ring(*materials[0], RINGS["inside"], p, a, b)[1](b)
    )
    some = RINGS["inside"]
    exact = -gap(0) * some / (gap(some) - gap(0))  # the gap is linear in p
    rings = [ring(*materials[0], RINGS["inside"], exact, a, b), ring(*materials[1], exact, RINGS["outside"], b, c)]
    return exact, rings


def rings(folder, run):
    """Against Lame, relative: p in the mean square and at most; materials are run["materials"] or the scene's."""
    materials = run.get("materials", [(210e9, 0.3), (70e9, 0.3)])
    exact, _ = lame(materials)
    side = multiplier_side(folder)
    error = side["p"] / exact - 1
    return {"p_error": float(np.abs(error).max()), "p_error_l2": mean_square(side["s"], error), "p_exact": exact}


def rings_fields(folder, run):
    """Against Lame: u (largest nodal error over the largest displacement), and the mean stress (exact: constant in each
    ring) over the contact pressure, roots of the mean square, at the elements' centres and at the nodes."""
    import meshio

    materials = run.get("materials", [(210e9, 0.3), (70e9, 0.3)])
    pressure_exact, exact = lame(materials)
    mesh = meshio.read(folder / "result.vtu")
    body = np.concatenate([np.asarray(block).ravel() for block in mesh.cell_data["body"]]).astype(int)
    stress = np.concatenate([np.asarray(block) for block in mesh.cell_data["stress_centre"]])
    radius = np.hypot(mesh.points[:, 0], mesh.points[:, 1])
    of_point = np.zeros(len(mesh.points), dtype=int)
    for block, numbers in zip(mesh.cells, np.split(body, np.cumsum([len(b.data) for b in mesh.cells])[:-1])):
        of_point[block.data] = numbers[:, None]
    u_exact = np.where(of_point == 0, exact[0][1](radius), exact[1][1](radius))[:, None] * mesh.points / radius[:, None]
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


def uniform_facing(folder, run):
    """As uniform, of the multipliers up to run["last"], where the last edge ends that faces the other side: p_error;
    and of p at the nodes that face it themselves: p_error_facing. The edges are run["edge"] long."""
    columns = launch.columns(folder / "contact.csv")
    first, exact, edge = columns["curve"][0], run.get("exact", 10e6), run["edge"]
    side = [i for i, curve in enumerate(columns["curve"]) if curve == first]
    facing = [i for i in side if columns["gap"][i] != ""]
    vertices_only = run["settings"].get("method.multipliers") == "linear"
    near = [i for i in side if columns["x"][i] < run["last"] + 1e-9 and columns["p"][i] != 0]
    near = [i for i in near if not vertices_only or abs(columns["x"][i] / edge - round(columns["x"][i] / edge)) < 1e-6]
    error = lambda nodes: max(abs(columns["p"][i] / exact - 1) for i in nodes)
    return {"p_error": error(near), "p_error_facing": error(facing)}
