"""The figures of a run that another run can confirm, each with its bar."""

import csv
import json
import math
import sys
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

import meshio
import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[1] / "pictures"))
from drawn_cells import polylines

# Of a figure's scale: what another solver may leave (its iterations end at 1e-8 of the load) and bars do not know.
ROUND_OFF = 1e-6
LENGTHS = "lengths in contact"  # their scale is the length of the curve
SMOOTH = 0.6  # radians from edge to edge: more is a corner


@dataclass
class Figure:
    kind: str  # figures of a kind are told together
    value: float
    bar: float
    scale: float  # of its kind, for round-off
    of_side: bool = False  # means another thing where the multipliers are on the other side


@dataclass
class Run:
    """What a results folder says: figures by name, and what has none, in words."""

    folder: Path
    summary: dict
    figures: dict | None = field(default_factory=dict)  # None: this program tells p alone
    left_out: list = field(default_factory=list)
    undetermined: set = field(default_factory=set)  # displacements: nothing holds what they are of
    lines: dict = field(default_factory=dict)  # by pair: places, p and weights of the nodes that count
    multipliers: dict = field(default_factory=dict)  # the same of the multipliers' pressure, which is FreeFEM's on the same mesh


def pair_key(pair):
    return frozenset(pair["between"])


def rows_of(path):
    if not path.exists():
        return []
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def has_no_limit(summary, k):
    """The places of pair k's line at which p has no limit, each with the distance within which it does not count."""
    points = summary["estimate"]["pressure"]["singular"]
    return [(np.array(at["position"]), at["left_out"]) for at in points if at["pair"] == k and at["unbounded"]]


def sides_of(table, k):
    """Of pair k the rows of its two curves, the multiplier side first."""
    rows = [row for row in table if row["pair"] == str(k)]
    return [[row for row in rows if row["curve"] == curve] for curve in dict.fromkeys(row["curve"] for row in rows)]


def read_line(run, side, k, of="p"):
    """The nodes of a side of pair k, those that count: places, p, and the length that each stands for."""
    xy = np.array([[float(row["x"]), float(row["y"])] for row in side]).reshape(-1, 2)
    p, s = (np.array([float(row[name]) for row in side]) for name in (of, "s"))
    edges = np.diff(s)
    length = (np.append(edges, 0) + np.append(0, edges)) / 2 if len(s) > 1 else np.ones(len(s))  # halves of the edges beside
    for place, distance in has_no_limit(run.summary, k):
        length = np.where(np.linalg.norm(xy - place, axis=1) < distance, 0, length)
    return xy, p, length


def read_pairs(run):
    summary, table = run.summary, rows_of(run.folder / "contact.csv")
    pairs = summary["contact"]
    carried = max((pair["pressure"]["max"] * pair["length_in_contact"] for pair in pairs), default=0)
    largest = max((pair["pressure"]["max"] for pair in pairs), default=0)
    by_node = {}
    for row in table:
        key = int(row["pair"])
        if row["p"] and (key not in by_node or float(row["p"]) > float(by_node[key]["p"])):
            by_node[key] = row
    for k, pair in enumerate(pairs):
        name = " - ".join(pair["between"])
        sign = 1 if summary["method"]["multipliers_on"][k] == pair["between"][0] else -1
        for axis, force, bar in zip("xy", pair["force"], pair["force_error"] or []):
            across = abs(force) < max(map(abs, pair["force"]))  # goes with the normals, which the two curves do not share
            run.figures[f"force {axis}, {name}"] = Figure("contact forces", sign * force, bar, carried, across)
        if pair["length_in_contact_error"] is not None:
            run.figures[f"length in contact, {name}"] = Figure(
                LENGTHS, pair["length_in_contact"], pair["length_in_contact_error"], pair["length"], True
            )
        if summary["estimate"]["pressure"] is None:
            continue
        faced = [row for row in sides_of(table, k)[0] if row["gap"]]
        run.lines[pair_key(pair)] = read_line(run, faced, k)
        run.multipliers[pair_key(pair)] = read_line(run, faced, k, "p_multiplier")
        if has_no_limit(summary, k):
            run.left_out.append(f"largest p of {name}: it has no limit there")
        elif k in by_node and by_node[k].get("p_error"):
            value, bar = float(by_node[k]["p"]), float(by_node[k]["p_error"])
            run.figures[f"largest p, {name}"] = Figure("largest p", value, bar, largest)


def read_probes(run):
    extremes = run.summary["extremes"]
    scales = {"u": ("displacements", extremes["displacement"]), "s": ("stresses", extremes["von_mises"]["value"])}
    for number, row in enumerate(rows_of(run.folder / "probes.csv")):
        place = f"({float(row['x']):.6g}, {float(row['y']):.6g}) of {row['body']}"
        for name in ("u_x", "u_y", "sigma_11", "sigma_22", "sigma_12"):
            if not row.get(f"{name}_error"):
                run.left_out.append(f"{name} at {place}: it has no bar")
                run.undetermined |= {f"{name} at {place} [{number}]"} if name[0] == "u" else set()
                continue
            kind, scale = scales[name[0]]
            run.figures[f"{name} at {place} [{number}]"] = Figure(kind, float(row[name]), float(row[f"{name}_error"]), scale)


def read_run(folder):
    """The figures of the results in a folder."""
    run = Run(folder, json.loads((folder / "summary.json").read_text()))
    if run.summary["estimate"] is not None:
        read_pairs(run)
        read_probes(run)
    return run


def chain(side):
    """Places and p of one curve's nodes, in the order of its arc length."""
    return np.array([[float(row[name] or "nan") for name in ("x", "y", "p")] for row in side])


def tangents(xy):
    """Of a chain at its nodes, as complex numbers."""
    return np.gradient(xy[:, 0] + 1j * xy[:, 1])


def tilt(run):
    """The angle between the normals of a pair's two curves where p acts, weighed by p: the largest of all pairs, radians."""
    worst, table = 0, rows_of(run.folder / "contact.csv")
    for k in range(len(run.summary["contact"])):
        mine, theirs = (chain(side) for side in sides_of(table, k))
        pressed = np.nan_to_num(mine[:, 2]) > 0
        if len(mine) < 2 or len(theirs) < 2 or not pressed.any():
            continue
        nearest = np.linalg.norm(mine[pressed, None, :2] - theirs[None, :, :2], axis=2).argmin(axis=1)
        angle = np.abs(np.angle(tangents(mine)[pressed] / tangents(theirs)[nearest]))  # both run the same way
        worst = max(worst, float(np.average(angle, weights=mine[pressed, 2])))
    return worst


def of_chords(run):
    """By how much of itself p changes where edges are straight, as all of FreeFEM's are: they lie angle^2 / 8 of the radius beside
    a line that turns by the angle from one to the next. Corners turn no line."""
    turns = [np.angle(step[1:] / step[:-1]) for xy, *_ in run.lines.values() if len(step := np.diff(xy[:, 0] + 1j * xy[:, 1])) > 1]
    smooth = np.concatenate([turn[np.abs(turn) < SMOOTH] for turn in turns] or [np.zeros(0)])
    return float(np.sqrt(np.mean((smooth**2 / 8) ** 2))) if len(smooth) else 0.0


def root_mean_square(lines, values):
    """Of values at the vertices of lines, over their length; NaN without any."""
    length = sum(lines[key][2].sum() for key in values)
    return math.sqrt(sum((lines[key][2] * values[key] ** 2).sum() for key in values) / length) if length > 0 else math.nan


def p_at(places, line):
    """p of a run at places of another's line: between the two vertices of the edge that is nearest."""
    xy, p, _ = line
    start, step = xy[:-1], np.diff(xy, axis=0)
    values = np.empty(len(places))
    for i, place in enumerate(places):
        t = np.clip(((place - start) * step).sum(axis=1) / (step**2).sum(axis=1), 0, 1)
        e = np.linalg.norm(start + t[:, None] * step - place, axis=1).argmin()
        values[i] = p[e] + t[e] * (p[e + 1] - p[e])
    return values


def line_pressure(run):
    """Root mean square of p on all lines, and its bar: None where nothing is pressed."""
    if not run.lines:
        return None
    size = root_mean_square(run.lines, {key: line[1] for key, line in run.lines.items()})
    return Figure("p along the lines", size, size * run.summary["estimate"]["pressure"]["error"], size)


def line_difference(run, other):
    """Root mean square of what p of another run is off from a run's, at the run's nodes; NaN if a pair is not there."""
    lines = run.lines if other.figures is not None else run.multipliers
    if lines.keys() != other.lines.keys() or any(len(line[1]) < 2 for line in other.lines.values()):
        return math.nan
    return root_mean_square(lines, {k: p_at(xy, other.lines[k]) - p for k, (xy, p, _) in lines.items()})


@dataclass
class Comparison:
    name: str
    kind: str
    value: float
    bar: float
    off: float  # |difference| of the other run
    allowed: float  # both bars, and round-off
    of_normals: float = 0  # what the choice between the curves' normals explains besides

    @property
    def by_bars(self):
        return self.off <= self.allowed  # NaN does not

    @property
    def agrees(self):
        return self.off <= self.allowed + self.of_normals


def compare(run, other):
    """Each figure of a run against another run's, which may be off by both bars together; where the multipliers are on the
    other curve, also by the angle between both curves' normals, as a part of the figure's scale: p acts along those of one."""
    same_side = run.summary["method"]["multipliers_on"] == other.summary["method"]["multipliers_on"]
    angle = 0 if same_side else tilt(run)
    mine = line_pressure(run)
    found = []
    if mine:
        theirs = line_pressure(other) if other.figures is not None else mine
        round_off = ROUND_OFF if other.figures is not None else ROUND_OFF + of_chords(run)
        allowed = mine.bar + (theirs.bar if theirs else math.nan) + round_off * mine.scale
        found.append(Comparison(mine.kind, mine.kind, mine.value, mine.bar, line_difference(run, other), allowed, angle * mine.scale))
    for name, figure in run.figures.items() if other.figures is not None else ():
        if (figure.of_side and not same_side) or name in other.undetermined:
            continue
        theirs = other.figures.get(name)
        off = abs(theirs.value - figure.value) if theirs else math.nan
        allowed = figure.bar + (theirs.bar if theirs else math.nan) + ROUND_OFF * figure.scale
        if theirs and figure.kind == LENGTHS:  # of curves that edges of two meshes make longer or shorter
            allowed += abs(theirs.scale - figure.scale)
        found.append(Comparison(name, figure.kind, figure.value, figure.bar, off, allowed, angle * figure.scale))
    return found


def stress_difference(run):
    """Root mean square of what p is off from the stress across the line that a body has recovered, over that of p: of each
    pair's two bodies the one that is nearer; None where nothing is pressed. Those stresses carry the loads, whatever p is."""
    total, table = np.zeros(2), rows_of(run.folder / "contact.csv")
    for k in range(len(run.summary["contact"])):
        sums = []
        for side in sides_of(table, k):
            side = [row for row in side if float(row["p"] or 0) and row["sigma_n"] and row["gap"]]
            _, p, length = read_line(run, side, k)
            off = np.abs(p + [float(row["sigma_n"]) for row in side])
            sums.append(((length * off**2).sum(), (length * p**2).sum()))
        total += min((pair for pair in sums if pair[1] > 0), key=lambda pair: pair[0] / pair[1], default=0)
    return float(math.sqrt(total[0] / total[1])) if total[1] > 0 else None


def middles(run, most=6):
    """A place inside each of the first bodies: the middle of the cell that is nearest to the mean of all."""
    mesh = meshio.vtu.read(run.folder / "result.vtu")
    body = np.concatenate(mesh.cell_data["body"]).ravel()
    places = np.concatenate([mesh.points[block.data[:, : 3 if "triangle" in block.type else 4], :2].mean(axis=1) for block in mesh.cells])
    for number in np.unique(body)[:most]:
        mine = places[body == number]
        yield mine[np.linalg.norm(mine - mine.mean(axis=0), axis=1).argmin()].tolist()


def of_freefem(run, path):
    """The run with p by FreeFEM along its lines, at vertices in their order (verification/crosscheck/on_mesh.py)."""
    table, lines = np.loadtxt(path, ndmin=2), {}
    for k, pair in enumerate(run.summary["contact"]):
        key, rows = pair_key(pair), table[table[:, 0] == k]
        if key in run.lines:
            order = np.linalg.norm(rows[:, None, 1:3] - run.lines[key][0][None], axis=2).argmin(axis=1).argsort()
            lines[key] = rows[order, 1:3], rows[order, 3], np.ones(len(order))
    return Run(run.folder, run.summary, None, lines=lines)


def distance_to_edge(nodes, xi, x):
    """Of x from an edge of two or three nodes (start, end, middle), from the place xi on: by Newton's method."""
    start, end = nodes[:2]
    middle = nodes[2] if len(nodes) > 2 else (start + end) / 2
    bend = start + end - 2 * middle
    for _ in range(4):
        off = xi * (xi - 1) / 2 * start + xi * (xi + 1) / 2 * end + (1 - xi * xi) * middle - x
        tangent = (end - start) / 2 + xi * bend
        xi = np.clip(xi - tangent @ off / (tangent @ tangent + bend @ off), -1, 1)
    return np.linalg.norm(xi * (xi - 1) / 2 * start + xi * (xi + 1) / 2 * end + (1 - xi * xi) * middle - x)


def deformed_gaps(run):
    """Where p acts that is not a fluid's, how far the deformed sides of the drawn pairs are apart or overlap: the largest distance of a vertex of
    the multiplier side from the deformed other curve, or from its tangent at an end, as far as anything slid beyond; None without such
    pairs. Of the files' places and displacements alone, not of what the program projects and integrates."""
    lines, table = meshio.vtu.read(run.folder / "contact.vtu"), rows_of(run.folder / "contact.csv")
    moved = lines.points[:, :2] + lines.point_data["displacement"][:, :2]
    edges = [(*row[:2], row[2] if len(row) > 2 else -1) for block in lines.cells for row in block.data]
    vertices = {node for edge in edges for node in edge[:2]}
    largest = None
    for k, gap in enumerate(run.summary["method"]["initial_gap"]):
        if gap not in ("curve", "measured") or "stiffness" in run.summary["contact"][k]:
            continue
        rows = [number for number, row in enumerate(table) if row["pair"] == str(k)]
        mine = {number for number in rows if table[number]["curve"] == table[rows[0]]["curve"]}
        others = [edge for edge in edges if edge[0] in set(rows) - mine]
        other = np.array(polylines(moved, others))
        pieces = other.shape[1] - 1
        ends = Counter(node for edge in others for node in edge[:2])
        first, last = (np.array([ends[edge[side]] == 1 for edge in others]) for side in (0, 1))
        start, step = (part.reshape(-1, 2) for part in (other[:, :-1], np.diff(other, axis=1)))
        beyond = 2 * run.summary["extremes"]["displacement"] / np.linalg.norm(step, axis=1)
        low, high = np.zeros(len(step)), np.ones(len(step))
        low[::pieces] -= first * beyond[::pieces]
        high[pieces - 1 :: pieces] += last * beyond[pieces - 1 :: pieces]
        for number in mine & vertices:
            row = table[number]
            if not row["gap"] or float(row["p"] or 0) <= float(row.get("p_fluid", 0)):  # beyond the other's end it faces nothing
                continue
            t = np.clip(((moved[number] - start) * step).sum(axis=1) / (step**2).sum(axis=1), low, high)
            distances = np.linalg.norm(start + t[:, None] * step - moved[number], axis=1)
            near = int(distances.argmin())
            distance = distances[near]
            if 0 <= t[near] <= 1:  # between two points of an edge, which may be curved
                edge, xi = others[near // pieces], -1 + 2 * (near % pieces + t[near]) / pieces
                distance = distance_to_edge([moved[node] for node in edge if node >= 0], xi, moved[number])
            largest = max(largest or 0, float(distance))
    return largest
