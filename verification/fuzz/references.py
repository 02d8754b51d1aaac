"""The pressure of a case against that of a reference which knows where its feature is; what the answer is worth.

A reference is solved on a mesh and on one of half as many edges; what the two are apart is more than three times what
the finer one is off by. Where that is more than a part of what is asked, the case decides nothing.
"""

import hashlib
import os
import re
import sys
import tempfile
import threading
from functools import cache
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.linalg import solveh_banded

sys.path[:0] = [str(Path(__file__).resolve().parents[1] / study) for study in ("accuracy", "stability")]

import launch
import one_call
from fuzz_case import solve_case
from judge_answers import zones
from line import Line, distance, pressure_of, rms_error, samples

LABELS = ("kept", "short", "worse", "told", "refused", "not reached", "unsure")
SURE = 0.3  # largest difference of two references, over what is asked or promised
SHORT = 2.0  # times what was asked: further off is "worse", and never without a word
INSIDE = 0.95  # of the nodes on a mesh of one's own
SWINGS = 16  # nodes, of eight edges: so far p swings beside the tip of a crack that slides
ROUND_OFF = 1e-7  # of the largest p: as two references agree where the answer is exact
NEAR = 0.06  # of the length: a place that a message gives is that of the feature
NUMBER = r"(-?\d+\.?\d*(?:e[-+]?\d+)?)"
PLACE = rf"\((?:x = )?{NUMBER}, (?:y = )?{NUMBER}\)"


def line_of(folder, middles=True):
    """The line with the multipliers; of edges without middle nodes with such added."""
    table = launch.contact(folder)
    names = ("s", "x", "y", "p", "p_error")
    columns = [np.nan_to_num(table.get(name, table["p"])) for name in names]  # of a reference without bars
    if not middles:
        columns = [np.insert(v, range(1, len(v)), (v[1:] + v[:-1]) / 2) for v in columns]
    return columns[0], Line.of(dict(zip(names, columns)))


def sharpened(s, line):
    """The line with many places, p the cubic spline that has the moments of the multipliers on their hats: these are the
    projection of p, at a vertex off by h^2 p'' / 12. Where contact is open p has no spline, and is taken as it is."""
    s, p = s[::2], line.p[::2]
    if p.min() <= 0:
        return Line(line.x, line.p, np.zeros(len(line.p)))
    h = np.diff(s)
    xi, weight = np.polynomial.legendre.leggauss(4)
    t = (1 + xi) / 2
    mass = np.zeros((2, len(s)))
    mass[1] = (np.r_[h, 0] + np.r_[0, h]) / 3
    mass[0, 1:] = h / 6
    spline = CubicSpline(s, p)
    places, nodes = s[:-1, None] + h[:, None] * t, p
    for _ in range(30):  # the projection takes at most two thirds of any wave: these are 5e-6
        values, moments = spline(places), np.zeros(len(s))
        moments[:-1] += (values * (1 - t) * weight).sum(1) * h / 2
        moments[1:] += (values * t * weight).sum(1) * h / 2
        nodes = nodes + p - solveh_banded(mass, moments)
        spline = CubicSpline(s, nodes)
    fine = (s[:-1, None] + h[:, None] * np.linspace(0, 1, 9)[:8]).ravel()
    fine = np.r_[fine, s[-1]]
    along = CubicSpline(s, line.x[::2])
    return Line(along(fine), spline(fine), np.zeros(len(fine)))


def calmed(s, line, places):
    """The line with p beside the places as the parabola through the vertices further on has it, if these are loaded."""
    p = line.p.copy()
    for place in places:
        end = int(np.argmin(np.linalg.norm(line.x - place, axis=1)))
        far = end - np.arange(SWINGS, 3 * SWINGS) if end > len(s) // 2 else end + np.arange(SWINGS, 3 * SWINGS)
        if (p[far] > 0).all():
            near = np.arange(min(end, far[0] + 1), max(end + 1, far[0]))
            size = np.abs(s[far] - s[end]).max()
            p[near] = np.polyval(np.polyfit((s[far] - s[end]) / size, p[far], 2), (s[near] - s[end]) / size)
    return Line(line.x, p, line.bar)


@cache
def lock_of(_):
    return threading.Lock()


def borders(line):
    """Where contact ends along the line: places, between two vertices of which one is open."""
    v = line.vertices()
    ends = np.flatnonzero((v.p[1:] > 0) != (v.p[:-1] > 0))
    return [tuple(place) for place in ((v.x[ends] + v.x[ends + 1]) / 2).tolist()]


def within(line):
    """p of the line as a function of places; beyond its ends, along it, there is none: the other side may be longer."""
    pressure = pressure_of(line)
    ends = [(line.x[end], line.x[end] - line.x[next]) for end, next in ((0, 1), (-1, -2))]
    is_beyond = lambda x, end, out: (x - end) @ out > 1e-6 * (out @ out)
    return lambda x: np.where(np.any([is_beyond(x, *end) for end in ends], axis=0), 0.0, pressure(x))


class References:
    """The references that were solved, by the content of their files."""

    def __init__(self, program):
        self.program, self.known = program, {}

    def pair(self, case):
        """p as functions of places of the finer and the coarser reference, refined where contact ends; StudyError if one
        cannot be solved."""
        ends = borders(self.line(case.reference(4, ()), case.smooth))
        return [within(self.line(case.reference(coarser, ends), case.smooth)) for coarser in (1, 2)]

    def line(self, files, smooth=()):
        name = hashlib.sha1(b"".join(files[key] for key in sorted(files))).hexdigest()
        with lock_of(name):
            if name not in self.known:
                self.known[name] = self.solve(files, smooth)
        return self.known[name]

    def solve(self, files, smooth):
        case = solve_case("reference", "", files["scene.toml"], b"")
        case.files, case.words = files, [*case.words, "--no-estimate"]
        with tempfile.TemporaryDirectory(prefix="mortise_reference_") as folder:
            case.write(folder)
            run = one_call.call(self.program, case, folder)
            if run.status not in (0, 2):
                raise launch.StudyError(f"reference: exit status {run.status}: {run.said.strip()[:300]}")
            s, line = line_of(os.path.join(folder, "results"))
            return sharpened(s, calmed(s, line, smooth))


def names_place(texts, case):
    """Whether one of the texts names the entry that has the feature and its key, or gives a place (x, y) near it."""
    places = [tuple(map(float, pair)) for text in texts for pair in re.findall(PLACE, text)]
    near = lambda place, at: all(known is None or abs(x - known) < NEAR for x, known in zip(place, at))
    by_name = case.named and any(all(word in text for word in case.named) for text in texts)
    return by_name or any(near(place, at) for place in places for at in case.places)


def answer_of(pressure, line):
    """As line.samples: the line's places and lengths, the pressure there."""
    x, _, ds = samples(line)
    return x, pressure(x), ds


def judge(case, run, folder, known):
    """(one of LABELS, what is wrong or None) of a case that was run in `folder`; `known`: References."""
    if run.status not in (0, 2):
        named = names_place([run.said], case)
        return "refused", None if named else f"refused without a place: {run.said.strip()[:300]}"
    told = launch.summary(Path(folder, "results"))
    if case.asked and not told["accuracy"]["reached"]:
        return "not reached", None if told["accuracy"]["reason"] else "not reached, and no reason"
    try:
        fine, coarse = known.pair(case)
    except launch.StudyError as error:
        return "unsure", str(error)
    line = line_of(os.path.join(folder, "results"), case.middles)[1]
    label, figures = (judge_answer if case.asked else judge_bars)(line, zones(told), fine, coarse, case.asked)
    if label in ("short", "worse") and names_place(told["warnings"] + [run.said], case):
        label = "told"
    return label, figures if label in ("short", "worse") else None


def judge_answer(line, zone, fine, coarse, asked):
    """The root mean square that was asked for, points where p has no limit left out."""
    got, own = (rms_error(line, fine, *zone, places) for places in (samples, lambda line: answer_of(coarse, line)))
    figures = f"got {100 * got:.3g} % of {100 * asked:g} % asked, the reference {100 * own:.2g} %"
    if got <= asked and own <= asked:
        return "kept", figures
    if own > SURE * max(got, asked):
        return "unsure", figures
    return "short" if got <= SHORT * asked else "worse", figures


def judge_bars(line, zone, fine, coarse, _):
    """Of a mesh of one's own: p - p_error <= exact <= p + p_error at nearly all loaded vertices."""
    v = line.vertices()
    exact, other = fine(v.x), coarse(v.x)
    far = (distance(v.x, zone[0]) >= zone[1]) & ((v.p != 0) | (v.bar > 0) | (exact > 0))
    off, own = np.abs(v.p - exact)[far], np.abs(exact - other)[far]
    floor = ROUND_OFF * np.abs(exact).max()
    bar = v.bar[far] + floor
    if not far.any() or (own > SURE * np.maximum(off, bar)).mean() > 1 - INSIDE:
        return "unsure", ""
    inside, times = (off <= bar).mean(), float((off / bar).max())
    rms = float(np.sqrt((off**2).mean()) / np.abs(exact).mean())
    figures = f"bars hold at {100 * inside:.0f} % of the vertices, p is off by {100 * rms:.2g} % of its mean, "
    figures += f"by up to {times:.1f} bars"
    return "kept" if inside >= INSIDE else "short" if times <= SHORT else "worse", figures
