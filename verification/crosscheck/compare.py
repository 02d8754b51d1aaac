"""Both programs' results on the same nodes, and how far they are apart."""

import math
from dataclasses import dataclass

import meshio
import numpy as np
from scipy.spatial import cKDTree

import run  # makes common/ known
import launch
from launch import StudyError

NEAR = 1e-10  # of the body's size: nodes nearer than this are one
ENDS, KINKS = 0.10, 0.10  # fractions of the length left out of pressure_inside: at an end, on each side of a kink


@dataclass
class Field:
    """Displacements of one body on the same nodes."""

    name: str
    points: np.ndarray  # nodes x 2
    cells: np.ndarray  # triangles of 3 or 6 of them
    mortise: np.ndarray  # nodes x 2
    freefem: np.ndarray


@dataclass
class Curve:
    """Contact pressures at the same places of the multiplier side, by arc length."""

    name: str
    s: np.ndarray
    mortise: np.ndarray
    freefem: np.ndarray


@dataclass
class Comparison:
    fields: list
    curve: Curve
    energies: tuple  # mortise, FreeFEM


def match(points, others, size, what):
    """Row of `others` for each of `points`; StudyError where one has no partner within NEAR of the body's size."""
    distance, row = cKDTree(others).query(points)
    worst = int(np.argmax(distance))
    if not distance[worst] <= NEAR * size:
        place = "({:.9g}, {:.9g})".format(*points[worst])
        nearest = f"the nearest is {distance[worst]:.3g} off"
        raise StudyError(f"{what}: nothing within {NEAR:g} of the body's size of {place}; {nearest}")
    if len(np.unique(row)) != len(row):
        raise StudyError(f"{what}: two nodes have the same partner")
    return row


def read_numbers(path, columns):
    table = np.loadtxt(path, ndmin=2)
    if table.shape[1] != columns:
        raise StudyError(f"{path.name}: {table.shape[1]} columns; expected {columns}")
    if not np.isfinite(table).all():
        raise StudyError(f"{path.name}: a number is not finite")
    return table


def mortise_bodies(folder):
    """Points and displacements of each body of result.vtu, by the body's number."""
    mesh, bodies = meshio.read(folder / "result.vtu"), {}
    for block, number in zip(mesh.cells, mesh.cell_data["body"]):
        for body in np.unique(number):
            bodies.setdefault(int(body), []).append(block.data[number == body].ravel())
    nodes = {body: np.unique(np.concatenate(found)) for body, found in bodies.items()}
    return {body: (mesh.points[n, :2], mesh.point_data["displacement"][n, :2]) for body, n in nodes.items()}


def displacements(solved, order, same_nodes):
    """Both programs' displacements on the nodes of FreeFEM's mesh, or on its vertices if those are all they share."""
    by_mortise, fields = mortise_bodies(solved.folder / "mortise"), []
    for body, number, side in zip(solved.bodies, solved.body_numbers, ("multiplier", "opposite")):
        points, cells = body.nodes(order if same_nodes else 1)
        table = read_numbers(solved.folder / f"freefem_{side}.txt", 4)
        theirs, ours = by_mortise[number]
        if same_nodes and not len(table) == len(theirs) == len(points):
            counts = f"{len(theirs)} nodes in mortise, {len(table)} in FreeFEM, {len(points)} in the mesh"
            raise StudyError(f"{body.name}: {counts}")
        of_mortise = match(points, theirs, body.size(), f"{body.name}, mortise")
        of_freefem = match(points, table[:, :2], body.size(), f"{body.name}, FreeFEM")
        fields.append(Field(body.name, points, cells, ours[of_mortise], table[of_freefem, 2:]))
    return fields


def pressures(solved, side):
    """Both programs' pressures at FreeFEM's multipliers."""
    ours = launch.contact(solved.folder / "mortise", side)
    theirs = read_numbers(solved.folder / "freefem_contact.txt", 4)
    places = np.stack([ours["x"], ours["y"]], axis=1)
    row = match(theirs[:, :2], places, solved.bodies[0].size(), f"multipliers on {side}")
    order = np.argsort(ours["s"][row])
    return Curve(side, ours["s"][row][order], ours["p"][row][order], theirs[order, 2])


def compare(solved, step):
    """Reads both programs' results of a step."""
    fields, curve = displacements(solved, step.freefem["order"], step.same_nodes), pressures(solved, step.side)
    ours, theirs = run.mortise_summary(solved.folder), run.freefem_summary(solved.folder)
    rows = ours["mesh"]["multipliers"], int(theirs["multipliers"])
    if step.same_nodes and rows[0] != rows[1]:
        raise StudyError("{} multipliers in mortise, {} in FreeFEM".format(*rows))
    return Comparison(fields, curve, (ours["energy"], theirs["energy"]))


def ratio(difference, size):
    """Not a number where either is not: a limit then never holds."""
    return float(difference / size) if size > 0 else (0.0 if difference == 0 else math.nan)


def lengths(vectors):
    return np.linalg.norm(vectors, axis=1)


def energy_difference(comparison):
    ours, theirs = comparison.energies
    return ratio(abs(theirs - ours), abs(ours))


def largest_differences(comparison):
    """Same discretisation: max |du| / max |u|, max |dp| / max |p|, the energy; multipliers that only one has closed."""
    difference = max(lengths(f.mortise - f.freefem).max() for f in comparison.fields)
    size = max(lengths(f.freefem).max() for f in comparison.fields)
    curve = comparison.curve
    return {
        "displacement": ratio(difference, size),
        "pressure": ratio(np.abs(curve.mortise - curve.freefem).max(), np.abs(curve.freefem).max()),
        "energy": energy_difference(comparison),
        "active": int(np.sum((curve.mortise > 0) != (curve.freefem > 0))),
    }


def nodal_areas(points, triangles):
    """A third of each triangle's area to each of its vertices."""
    corners = points[triangles[:, :3]]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
    return np.bincount(triangles[:, :3].ravel(), np.repeat(area / 3, 3), minlength=len(points))


def displacement_l2(fields):
    """Relative, over both bodies."""
    weights = [nodal_areas(field.points, field.cells) for field in fields]
    difference = sum(w @ lengths(field.mortise - field.freefem) ** 2 for w, field in zip(weights, fields))
    size = sum(w @ lengths(field.mortise) ** 2 for w, field in zip(weights, fields))
    return ratio(math.sqrt(difference), math.sqrt(size))


def inside(s, kinks):
    """Which places are away from the ends of the curve and its kinks (given as fractions of its length)."""
    t = (s - s.min()) / np.ptp(s)
    margin = 1e-6  # a node on the border is left out, whatever its round-off
    keep = (t > ENDS + margin) & (t < 1 - ENDS - margin)
    for kink in kinks:
        keep &= np.abs(t - kink) > KINKS + margin
    return keep


def mean_differences(comparison, kinks):
    """Same problem: relative L2 norms, the largest difference of p away from corners, and the energy."""
    curve = comparison.curve
    difference = curve.mortise - curve.freefem
    mean = np.trapz(np.abs(curve.mortise), curve.s) / np.ptp(curve.s)
    norm = lambda values: math.sqrt(np.trapz(values**2, curve.s))
    return {
        "energy": energy_difference(comparison),
        "displacement": displacement_l2(comparison.fields),
        "pressure": ratio(norm(difference), norm(curve.mortise)),
        "pressure_inside": ratio(np.abs(difference[inside(curve.s, kinks)]).max(), mean),
    }


def write_difference(comparison, path):
    """The mesh of both bodies with both displacements and their difference, for ParaView."""
    a, b = comparison.fields
    cells = np.concatenate([a.cells, b.cells + len(a.points)])
    in_space = lambda first, second: np.pad(np.concatenate([first, second]), ((0, 0), (0, 1)))
    data = {
        "u_mortise": in_space(a.mortise, b.mortise),
        "u_freefem": in_space(a.freefem, b.freefem),
        "difference": in_space(a.mortise - a.freefem, b.mortise - b.freefem),
    }
    bodies = np.repeat([0, 1], [len(a.cells), len(b.cells)])
    blocks = [({3: "triangle", 6: "triangle6"}[cells.shape[1]], cells)]
    mesh = meshio.Mesh(in_space(a.points, b.points), blocks, point_data=data, cell_data={"body": [bodies]})
    meshio.write(path, mesh)


def write_pressures(curve, path):
    """Both pressures along the multiplier side, 17 digits."""
    table = np.stack([curve.s, curve.mortise, curve.freefem], axis=1)
    np.savetxt(path, table, fmt="%.17g", delimiter=",", header="s,p_mortise,p_freefem", comments="")
