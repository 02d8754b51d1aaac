"""Both programs' results on the same nodes, and how far they are apart."""

import math
from dataclasses import dataclass, replace

import meshio
import numpy as np
from scipy.spatial import cKDTree

import run  # makes common/ known
import launch
from launch import StudyError

NEAR = 1e-10  # of the body's size: nodes nearer than this are one
NOTHING = 2e-9  # of the largest pressure: a fifth of what p may differ by; a row under less is a tie
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
    """Contact pressures at the same places of the multiplier sides, by arc length, pair behind pair."""

    name: str
    s: np.ndarray
    mortise: np.ndarray
    freefem: np.ndarray
    fluid: tuple = (0.0, 0.0)  # what of it is a fluid's, in mortise and in FreeFEM


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
    by_mortise, table = mortise_bodies(solved.folder / "mortise"), read_numbers(solved.folder / "freefem_bodies.txt", 5)
    fields = []
    for number, body in enumerate(solved.bodies):
        points, cells = body.nodes(order if same_nodes else 1)
        (places, ours), theirs = by_mortise[number], table[table[:, 0] == number, 1:]
        if same_nodes and not len(theirs) == len(places) == len(points):
            counts = f"{len(places)} nodes in mortise, {len(theirs)} in FreeFEM, {len(points)} in the mesh"
            raise StudyError(f"{body.name}: {counts}")
        of_mortise = match(points, places, body.size(), f"{body.name}, mortise")
        of_freefem = match(points, theirs[:, :2], body.size(), f"{body.name}, FreeFEM")
        fields.append(Field(body.name, points, cells, ours[of_mortise], theirs[of_freefem, 2:]))
    return fields


def without_rigid_difference(field):
    """FreeFEM's displacements of a body, moved rigidly to where they are nearest to mortise's."""
    x, y = (field.points - field.points.mean(axis=0)).T
    motions = np.stack([np.tile([1, 0], len(x)), np.tile([0, 1], len(x)), np.stack([-y, x], axis=1).ravel()], axis=1)
    part = np.linalg.lstsq(motions, (field.mortise - field.freefem).ravel(), rcond=None)[0]
    return replace(field, freefem=field.freefem + (motions @ part).reshape(-1, 2))


def pairs_of_mortise(folder):
    """Numbers of the pairs by the names of their curves, first the multiplier side's."""
    summary = run.mortise_summary(folder)
    both = zip(summary["method"]["multipliers_on"], (set(contact["between"]) for contact in summary["contact"]))
    return {(on, *(between - {on})): number for number, (on, between) in enumerate(both)}


def pressures(solved, side):
    """Both programs' multipliers at FreeFEM's, pair behind pair."""
    found, numbers = launch.columns(solved.folder / "mortise/contact.csv"), pairs_of_mortise(solved.folder)
    names = [tuple(curve.name for curve in pair) for pair in solved.pairs]
    if set(names) != set(numbers):
        raise StudyError(f"contact of {sorted(set(names) ^ set(numbers))} is known to one program only")
    table, parts, length = read_numbers(solved.folder / "freefem_contact.txt", 6), [], 0.0
    for number, name in enumerate(names):
        ours = (found["pair"] == numbers[name]) & (found["curve"] == name[0])
        theirs = table[table[:, 0] == number, 1:]
        places, size = np.stack([found["x"][ours], found["y"][ours]], axis=1), max(b.size() for b in solved.bodies)
        row = match(theirs[:, :2], places, size, f"multipliers on {name[0]}")
        s, p = found["s"][ours][row], found.get("p_multiplier", found["p"])[ours][row]
        order = np.argsort(s)
        fluid = found["p_fluid"][ours][row] if "p_fluid" in found else np.zeros(len(p))
        untold = (p != 0) & (found["p"][ours][row] == 0)  # the node itself faces nothing
        fluid = np.where(untold, theirs[:, 4], fluid)
        parts.append([length + s[order], p[order], theirs[order, 2], fluid[order], theirs[order, 4]])
        length += s.max()
    s, p, p_freefem, *fluid = np.concatenate(parts, axis=1)
    return Curve(side, s, p, p_freefem, tuple(fluid))


def compare(solved, step):
    """Reads both programs' results of a step."""
    fields, curve = displacements(solved, step.freefem["order"], step.same_nodes), pressures(solved, step.side)
    if "springs" in step.freefem:
        fields = [without_rigid_difference(field) for field in fields]
    ours, theirs = run.mortise_summary(solved.folder), run.freefem_summary(solved.folder)
    rows = ours["mesh"]["multipliers"], int(theirs["multipliers"])
    if step.same_nodes and rows[0] > rows[1]:  # of edges that hardly face the other side mortise's share one
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
    """Same discretisation: max |du| / max |u|, max |dp| / max |p|, the energy; multipliers that only one has under
    pressure, above what both have digits for, or wet."""
    difference = max(lengths(f.mortise - f.freefem).max() for f in comparison.fields)
    size = max(lengths(f.freefem).max() for f in comparison.fields)
    curve = comparison.curve
    none = NOTHING * np.abs(curve.freefem).max()
    states = [(p - fluid > none, np.broadcast_to(fluid, p.shape) > 0) for p, fluid in zip((curve.mortise, curve.freefem), curve.fluid)]
    return {
        "displacement": ratio(difference, size),
        "pressure": ratio(np.abs(curve.mortise - curve.freefem).max(), np.abs(curve.freefem).max()),
        "energy": energy_difference(comparison),
        "active": int(np.sum(np.not_equal(*states).any(axis=0))),
    }


def nodal_areas(points, triangles):
    """A third of each triangle's area to each of its vertices."""
    corners = points[triangles[:, :3]]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
    return np.bincount(triangles[:, :3].ravel(), np.repeat(area / 3, 3), minlength=len(points))


def displacement_l2(fields):
    """Relative, over all bodies."""
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
    """The mesh of all bodies with both displacements and their difference, for ParaView."""
    fields = comparison.fields
    first = np.cumsum([0, *(len(field.points) for field in fields)])
    cells = np.concatenate([field.cells + start for field, start in zip(fields, first)])
    in_space = lambda values: np.pad(np.concatenate(values), ((0, 0), (0, 1)))
    data = {
        "u_mortise": in_space([field.mortise for field in fields]),
        "u_freefem": in_space([field.freefem for field in fields]),
        "difference": in_space([field.mortise - field.freefem for field in fields]),
    }
    bodies = np.repeat(np.arange(len(fields)), [len(field.cells) for field in fields])
    blocks = [({3: "triangle", 6: "triangle6"}[cells.shape[1]], cells)]
    points = in_space([field.points for field in fields])
    mesh = meshio.Mesh(points, blocks, point_data=data, cell_data={"body": [bodies]})
    meshio.write(path, mesh)


def write_pressures(curve, path):
    """Both pressures along the multiplier sides, 17 digits."""
    table = np.stack([curve.s, curve.mortise, curve.freefem], axis=1)
    np.savetxt(path, table, fmt="%.17g", delimiter=",", header="s,p_mortise,p_freefem", comments="")
