"""What the answers are worth: against references, row by row; and what is held of all of them."""

import math
from pathlib import Path
from statistics import median

import numpy as np
from scipy.interpolate import CubicSpline

import launch
import persson
from accuracy_runs import ANGLE, BORDERS, PIN, STIFFNESS
from lame import RINGS, lame
from line import Line, at_vertices, fitted, inside_bars, pressure_of, rms_error, samples

HERE = Path(__file__).resolve().parent
HERTZ_FORCE, HERTZ_RADIUS = 9.2e6, 1.0  # geo/hertz.toml
SOLVING = ("assemble", "couple", "factorise", "solve", "recover")


def hertz(x):
    """Half planes: a and p0 are 0.01 % from those of the scene's bodies."""
    a = math.sqrt(8 * HERTZ_FORCE * HERTZ_RADIUS / (math.pi * STIFFNESS))
    return 2 * HERTZ_FORCE / (math.pi * a) * np.sqrt(np.maximum(1 - (x[:, 0] / a) ** 2, 0))


def angle(x):
    return np.arctan2(x[:, 0], -x[:, 1])


def pin(x):
    """An infinite plate: the scene's has 40 radii."""
    return persson.pressure(angle(x), ANGLE) * PIN


def hp():
    """parabola_1 by another program: quadrilaterals of degree 10 in layers towards the ends, right to 3e-9 where x is
    from 0.08 to 0.72 (parabola_1_hp.csv; two of its meshes agree to that)."""
    known = launch.columns(HERE / "parabola_1_hp.csv")
    p = CubicSpline(known["x"], known["p"])
    return lambda x: p(np.minimum(x[:, 0], 0.8 - x[:, 0]))


FORMULAS = {"rings": lambda x: np.full(len(x), lame(RINGS["materials"])[0]), "hertz": hertz, "pin": pin, "parabola_1": hp()}
# Where contact ends, the finest meshes are at their worst, and the form of p is known: sqrt(1 - t) times a polynomial.
FORMS = {"hertz": (lambda x: x[:, 0] ** 2, 1), "pin": (lambda x: np.tan(angle(x) / 2) ** 2, 6)}


def functions(scene, references):
    """p of the two references, as functions of places; exact ones twice."""
    if scene == "rings":
        return [FORMULAS["rings"]] * 2
    lines = [Line.of(row["line"]) for row in references]
    return [fitted(line, *FORMS[scene])[0] if scene in FORMS else pressure_of(line) for line in lines]


def zones(row):
    """Points where p has no limit, and the distance within which it is left out."""
    points = [point for point in row["estimate"]["pressure"]["singular"] if point["unbounded"]]
    return [point["position"] for point in points], max((point["left_out"] for point in points), default=0)


def judged(scene, run, row, references):
    """A row of the study's table. `got`: of the nodes; `got_line`: along the edges, where p is linear."""
    told = {"scene": scene, "asked": run["settings"]["accuracy.value"]}
    told |= {"first_edges": run["settings"]["accuracy.first_edges"], "failed": row["failed"]}
    if row["failed"]:
        return told
    line, zone, estimate = Line.of(row["line"]), zones(row), row["estimate"]
    exact, second = functions(scene, references)
    got, got_line = (rms_error(line, exact, *zone, places) for places in (at_vertices, samples))
    own = rms_error(Line(line.x, second(line.x), line.bar), exact, *zone)
    inside, inside_excluded, worst = inside_bars(line, exact, *zone)
    unknowns = [solve["unknowns"] for solve in row["accuracy"]["solves"]]
    energy = abs(references[0]["energy"] - row["energy"]) / row["energy"]
    known = energy > 0 and references[0]["estimate"]["error"] < 0.3 * estimate["error"] and scene not in FORMS
    return told | {
        "reached": row["accuracy"]["reached"],
        "reason": row["accuracy"]["reason"],
        "got": got,
        "got_line": got_line,
        "estimated": estimate["pressure"]["error"],
        "ratio": estimate["pressure"]["error"] / got,
        "ratio_line": estimate["pressure"]["error"] / got_line,
        "reference": own,
        "trusted": own < got / 5,
        "inside": inside,
        "inside_excluded": inside_excluded,
        "worst": worst[2],
        "worst_x": worst[0],
        "worst_y": worst[1],
        "solves": len(unknowns),
        "unknowns": unknowns[row["accuracy"]["answer"] - 1],
        "work": sum(n**1.24 for n in unknowns) / unknowns[row["accuracy"]["answer"] - 1] ** 1.24,
        "seconds": row["processor"],
        "wall": row["wall"],
        "meshing": row["seconds"]["mesh"] / sum(row["seconds"][key] for key in SOLVING),
        "energy_ratio": estimate["error"] / math.sqrt(energy) if known else None,
    }


def independent(scene, references):
    """Of the program's reference: the difference from what is known otherwise, the ends of contact (0.95) and the
    singular points left out."""
    line = Line.of(references[0]["line"])
    x, p, ds = samples(line)
    kept = np.full(len(x), True)
    if scene in FORMS:
        p, end = functions(scene, references)[0](x), fitted(line, *FORMS[scene])[1]
        kept = FORMS[scene][0](x) < 0.9 * end
    if scene == "parabola_1":
        kept = (x[:, 0] >= 0.08) & (x[:, 0] <= 0.72)
    q = FORMULAS[scene](x)
    return float(np.sqrt((ds * (p - q) ** 2)[kept].sum() / (ds * q**2)[kept].sum()))


def verdicts(rows, seconds):
    """(what is held, what was found, whether it holds) of the answers; `seconds`: of the whole process."""
    good = [row for row in rows if not row["failed"]]
    values = lambda key, **where: [row[key] for row in good if all(row[k] == v for k, v in where.items())]
    count = lambda found, text=".3g": ", ".join(format(value, text) for value in found)
    extremes = lambda key: f"{min(values(key)):.2g} to {max(values(key)):.3g}, median {median(values(key)):.2g}"
    missed = [row for row in rows if row["failed"] or not row["reached"]]
    yield "every answer is reached", f"{len(rows) - len(missed)} of {len(rows)}", not missed
    for key, where in (("got", "at the nodes"), ("got_line", "along the edges")):
        held = sum(row[key] <= row["asked"] for row in good)
        yield f"got <= asked, {where}", f"{held} of {len(good)}", held == len(good)
    inside = sum(share >= 0.95 for share in values("inside"))
    words = "95 % of the nodes inside their bars, in 95 % of answers"
    yield words, f"{inside} of {len(good)}", inside >= 0.95 * len(good)
    for key, where in (("ratio", "at the nodes"), ("ratio_line", "along the edges")):
        fine = all(0.8 <= ratio <= 8 for ratio in values(key)) and median(values(key)) <= 4
        yield f"estimated over true 0.8 to 8, median at most 4, {where}", extremes(key), fine
    for scene, asked, most in (("parabola_1", 0.01, 5000), ("parabola_1", 0.001, 10000), ("parabola_1", 0.0001, 30000),
                               ("hertz", 0.002, 13000)):  # fmt: skip
        if found := values("unknowns", scene=scene, asked=asked):
            yield f"{scene} at {100 * asked:g} %: at most {most} unknowns", count(found, "d"), max(found) <= most
    dear = [row for row in good if row["work"] > (3 if row["scene"] in BORDERS else 2)]
    words = f"{extremes('work')}; {len(dear)} above" if dear else extremes("work")
    yield "all work at most 2 times the last solve's, 3 with borders", words, not dear
    yield "meshing at most the seconds of solving", extremes("meshing"), max(values("meshing")) <= 1
    if energies := [ratio for ratio in values("energy_ratio") if ratio]:
        fine = 0.5 <= min(energies) and max(energies) <= 2
        yield "energy estimate over true energy error 0.5 to 2", f"{min(energies):.2g} to {max(energies):.2g}", fine
    yield "parabola_1 at 1 %: the whole process at most 0.35 processor s", f"{seconds:.3f} s", seconds <= 0.35
    trusted = sum(values("trusted"))
    words = "the reference's own error below a fifth of what is measured"
    yield words, f"{trusted} of {len(good)}", trusted == len(good)
