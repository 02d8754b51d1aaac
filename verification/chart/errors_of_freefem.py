"""FreeFEM's runs of the chart: the scripts of freefem/ on the triangles that mortise's 3-node meshes have.

Displacements P1 or P2, linear multipliers on the finer side, segments, straight sides. Seconds are those that the
script reports, of the processor: assembly, coupling (curves, segments, projections: loops of FreeFEM's interpreted
language) and solution. Errors are integrated as for mortise: 5 Gauss points an edge, 4 x 4 points a triangle.
"""

import shutil
import statistics
import subprocess

import numpy as np

import chart_runs  # makes common/ and crosscheck/ known
import compare
import launch
import run
import runs
from cases import CaseError, Step
from chart_methods import PROBLEMS, mesh_name

LEFT_OUT = 0.1  # as errors.hpp
GAUSS_X, GAUSS_W = np.polynomial.legendre.leggauss(5)
GAUSS_POINTS = {1: 2, 2: 5}  # an edge piece, by the order


def version():
    """Of FreeFEM, or None where it is missing."""
    program = run.find_freefem()
    if program is None:
        return None
    said = subprocess.run([program, "-nw", "-?"], capture_output=True, text=True, check=False)
    words = (said.stdout + said.stderr).split()
    return words[words.index("version") + 1] if "version" in words else "unknown"


def step_of(problem, mesh, order):
    scene, side = PROBLEMS[problem]["freefem"]
    freefem = {"order": order, "multipliers": "linear", "integration": "segments", "gauss": GAUSS_POINTS[order]}
    return Step(scene, mesh, side, {"kind": 1, "order": 1}, {}, freefem, "bilateral", "closed", same_nodes=False)


def along_line(table):
    """Rows x, y, p of the multipliers from one end of the line to the other: x grows along all charted lines."""
    return table[np.argsort(table[:, 0])]


def pressure_errors(x, y, p, exact):
    """Relative errors of p, linear between the nodes: L2, inner L2, inner maximum. `exact`: p at places x, y."""
    a, b = np.stack([x[:-1], y[:-1]], 1), np.stack([x[1:], y[1:]], 1)
    length = np.linalg.norm(b - a, axis=1)
    t = (1 + GAUSS_X) / 2
    places = a[:, None] + t[None, :, None] * (b - a)[:, None]
    of_run = p[:-1, None] + t * (p[1:] - p[:-1])[:, None]
    of_exact = exact(places[..., 0], places[..., 1])
    ds = length[:, None] * GAUSS_W / 2
    start = np.concatenate([[0], np.cumsum(length)])
    s = start[:-1, None] + t * length[:, None]
    inner = (s >= LEFT_OUT * start[-1]) & (s <= (1 - LEFT_OUT) * start[-1])
    difference = of_run - of_exact
    l2 = lambda where: np.sqrt(np.sum((ds * difference**2)[where]) / np.sum((ds * of_exact**2)[where]))
    at_nodes = np.abs(p - exact(x, y))[(start >= LEFT_OUT * start[-1]) & (start <= (1 - LEFT_OUT) * start[-1])]
    worst = max(np.abs(difference[inner]).max(), at_nodes.max(initial=0))
    return {
        "e_p_l2": float(l2(np.full(s.shape, True))),
        "e_p_l2_inner": float(l2(inner)),
        "e_p_max_inner": float(worst / np.abs(of_exact[inner]).max()),
    }


def triangle_rule():
    """4 x 4 points collapsed onto the triangle (0,0), (1,0), (0,1), weights adding up to 1/2."""
    x, w = np.polynomial.legendre.leggauss(4)
    u, v = np.meshgrid((1 + x) / 2, (1 + x) / 2, indexing="ij")
    return np.stack([u, v * (1 - u)], -1).reshape(-1, 2), (np.outer(w, w) / 4 * (1 - u)).ravel()


def gradients(order, xi, eta):
    """Of the shape functions on the reference triangle, nodes as VTK numbers triangle or triangle6."""
    if order == 1:
        return np.array([[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]])
    rest = 1 - xi - eta
    along_xi = [1 - 4 * rest, 4 * xi - 1, 0, 4 * (rest - xi), 4 * eta, -4 * eta]
    along_eta = [1 - 4 * rest, 0, 4 * eta - 1, -4 * xi, 4 * xi, 4 * (rest - eta)]
    return np.stack([along_xi, along_eta], 1)


def energy_sums(points, cells, u, order, law, exact_stress):
    """Squared energy norms of the error and of the exact field on one body of straight-sided triangles."""
    corners = points[cells[:, :3]]
    edges = np.stack([corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]], 1)  # rows: d x / d reference
    area, inverse = np.linalg.det(edges), np.linalg.inv(edges)
    lam, mu = law
    C = np.array([[lam + 2 * mu, lam, 0], [lam, lam + 2 * mu, 0], [0, 0, mu]])
    compliance = np.linalg.inv(C)
    error = norm = 0.0
    for (xi, eta), weight in zip(*triangle_rule()):
        place = corners[:, 0] + xi * edges[:, 0] + eta * edges[:, 1]
        gradient = np.einsum("cij,aj->cai", inverse, gradients(order, xi, eta))
        du = np.einsum("cak,cai->cki", u[cells], gradient)
        strain = np.stack([du[:, 0, 0], du[:, 1, 1], du[:, 0, 1] + du[:, 1, 0]], 1)
        exact = exact_stress(place)
        difference = strain @ C - exact
        error += np.sum(weight * area * np.einsum("ci,ij,cj->c", difference, compliance, difference))
        norm += np.sum(weight * area * np.einsum("ci,ij,cj->c", exact, compliance, exact))
    return error, norm


def energy_error(bodies, folder, order, laws, exact_stress):
    """Relative energy norm of the error; `laws`, `exact_stress`: of the bodies by name."""
    sums = np.zeros(2)
    for body, side in zip(bodies, ("multiplier", "opposite")):
        points, cells = body.nodes(order)
        table = compare.read_numbers(folder / f"freefem_{side}.txt", 4)
        row = compare.match(points, table[:, :2], body.size(), f"{body.name}, FreeFEM")
        sums += energy_sums(points, cells, table[row, 2:], order, laws[body.name], exact_stress[body.name])
    return float(np.sqrt(sums[0] / sums[1]))


def measured(problem, mesh, name, order, turns, folder, exact):
    """One row of the chart. `exact`: pressure(x, y) and, for the energy norm, laws and stresses of the bodies."""
    step, programs = step_of(problem, mesh, order), run.find_programs()
    folder = folder / f"freefem_{problem}_{mesh_name(mesh)}_p{order}"
    _, _, bodies, _ = run.prepare(programs, step, folder)
    script, seconds = launch.ROOT / "freefem/mortar.edp", []
    for _ in range(turns):
        run.solve_by_freefem(programs, (folder / "case.txt").absolute(), script)
        summary = run.freefem_summary(folder)
        seconds.append([summary[f"seconds_{key}"] for key in ("assemble", "couple", "solve")])
    contact = along_line(compare.read_numbers(folder / "freefem_contact.txt", 4))
    errors = pressure_errors(contact[:, 0], contact[:, 1], contact[:, 2], exact["pressure"])
    energy = energy_error(bodies, folder, order, exact["laws"], exact["stress"]) if "stress" in exact else None
    totals, (assemble, couple, solve) = [sum(s) for s in seconds], map(statistics.median, zip(*seconds))
    nodes, elements = (sum(len(body.nodes(order)[i]) for body in bodies) for i in (0, 1))
    shutil.rmtree(folder)
    return {
        **{"method": name, "status": "solved", "turns": turns},
        **{"nodes": nodes, "elements": elements, "dofs": int(summary["unknowns"])},
        **{"multipliers": int(summary["multipliers"]), "interface_steps": 0},
        **{"energy": summary["energy"], "e_energy": energy, **errors},
        **{"s_assemble": assemble, "s_couple": couple, "s_factorise": 0.0, "s_solve": solve, "s_recover": 0.0},
        "s_wall": None,
        **{"s_total": statistics.median(totals), "s_total_min": min(totals), "s_total_max": max(totals)},
    }


def of_freefem(store, problem, mesh, ways, turns, exact, reference=None):
    """The rows on one mesh."""
    make = lambda _: [measured(problem, mesh, name, order, turns, store.folder, exact) for name, order in ways]
    key = ["FreeFEM", version(), problem, mesh, ways, turns, reference and runs.digest(reference)]
    try:
        return store.row(key, make, f"freefem_{problem}")
    except CaseError as error:
        raise launch.MortiseError(f"FreeFEM on {problem} {mesh_name(mesh)}: {error}") from error
