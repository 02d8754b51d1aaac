#!/usr/bin/python3
"""Bars of p against fields that slide, drawn at random: spaces x sides x elements x models.

Written is OUT/bars.csv (a row a run), and shown a summary by space, side, element and model. Exit status 1 where a run
fails or, of the runs whose elements do not lock, the bars hold at fewer than 95 % of the nodes in more than 5 % of the runs,
an estimate is below 0.7 of the true error, or the median is above 4 times that.
"""

import random as random_numbers
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.with_name("common")))

import numpy as np

import launch
import runs
from polynomial import Polynomial
from sliding import Law, SlidingFields

ELEMENTS = {  # parameters of sliding.geo
    "T3": {"kind": 1, "order": 1},
    "T6": {"kind": 1, "order": 2},
    "Q4": {"kind": 0, "order": 1},
    "Q8": {"kind": 0, "order": 2},
    "Q9": {"kind": 0, "order": 2, "nine_node": 1},
}
SOFT = 1e4  # Young's modulus of the softer body: stresses are about 1
NODES, RUNS = 0.95, 0.95  # bars hold at so many nodes, in so many runs
LEAST_RATIO, MOST_MEDIAN = 0.7, 4  # of the estimated error over the true one
ROUND_OFF = 1e-9  # of the largest p: an error that no estimate need tell


def draw(seed):
    """A run; all that is drawn comes from the seed."""
    random = random_numbers.Random(seed)
    contrast = random.choice([1, 10, 100])
    plane = random.choice(["strain", "stress", "axisymmetric"])
    softer = random.choice(["lower", "upper"])
    nus = [random.choice([0, 0.3, 0.45, 0.49, 0.4999]) if plane != "stress" else random.choice([0, 0.3, 0.45])
           for _ in range(2)]  # fmt: skip
    ratio = random.choice([1 / 3, 1 / 2, 2 / 3, 4 / 5, 1.25, 1.5, 2, 3])
    coarse = random.choice([6, 8, 10, 14, 20])
    fine = round(coarse * max(ratio, 1 / ratio))
    x0 = random.choice([0, 0.5]) if plane == "axisymmetric" else 0
    lines = [[0.5, 0, 0]] if plane == "axisymmetric" and x0 == 0 else [[0.5, 0, 0], [0.5, 0, 0.2], [0.45, 0.2, -0.2]]
    return {
        "seed": seed, "space": random.choice(["linear", "quadratic", "dual"]),
        "element": random.choice(list(ELEMENTS)), "plane": plane, "x0": x0,
        "side": random.choice(["finer", "coarser"]), "free": random.choice([0, 0, 1]),
        "n_lower": fine if ratio < 1 else coarse, "n_upper": coarse if ratio < 1 else fine,
        "young_lower": SOFT if softer == "lower" else contrast * SOFT,
        "young_upper": contrast * SOFT if softer == "lower" else SOFT,
        "nu_lower": nus[0], "nu_upper": nus[1], "contrast": contrast,
        "line": random.choice(lines),
        "strains": random.choice([False, False, True]), "ends": random.choice(["traction", "guide"]),
    }  # fmt: skip


def fields_of(run):
    laws = [Law(run[f"young_{body}"], run[f"nu_{body}"], run["plane"]) for body in ("lower", "upper")]
    return SlidingFields(random_numbers.Random(run["seed"]), Polynomial(np.array(run["line"], float)[:, None]), laws,
                         run["x0"], run["strains"])  # fmt: skip


def entry(on, what):
    return f'[[boundary]]\non = "{on}"\n{what}\n'


def vector(values):
    return ", ".join(f'"{value}"' for value in values)


def scene_of(run, fields):
    mesh = {key: run[key] for key in ("n_lower", "n_upper", "free", "x0")} | ELEMENTS[run["element"]]
    mesh |= dict(zip(("c0", "c1", "c2"), run["line"]))
    lower_finer = run["n_lower"] > run["n_upper"]
    multipliers = "lower" if lower_finer == (run["side"] == "finer") else "upper"
    text = f'[mesh]\nfile = "{HERE / "sliding.geo"}"\nparameters = {{ {", ".join(f"{k} = {v}" for k, v in mesh.items())} }}\n'
    text += f'[model]\nplane = "{run["plane"]}"\n[method]\nmultipliers = "{run["space"]}"\n[bodies]\nlower = "lower"\nupper = "upper"\n'
    for k, (body, outer) in enumerate((("lower", "bottom"), ("upper", "top"))):
        text += f'[materials.{body}]\nyoung = {run[f"young_{body}"]}\npoisson = {run[f"nu_{body}"]}\n'
        text += f'[[body_force]]\nbody = "{body}"\nforce = [{vector(fields.body_force(k))}]\n'
        if fields.initial[k]:
            parts = ", ".join(f'{name} = "{part}"' for name, part in zip(("xx", "yy", "zz", "xy"), fields.initial[k]))
            text += f'[[initial_strain]]\nbody = "{body}"\nstrain = {{ {parts} }}\n'
        held = 'displacement = {{ x = "{}", y = "{}" }}'.format(*fields.u[k])
        text += entry(outer, held)
        for side, sign in (("left", -1), ("right", 1)):
            if fields.axis and side == "left":
                continue
            s = fields.stress[k]
            guide = run["ends"] == "guide"
            traction = vector(("0" if guide else s[0] * float(sign), s[3] * float(sign)))
            text += entry(f"{body}_{side}", f"traction = [{traction}]")
            if guide:
                text += entry(f"{body}_{side}", f'displacement = {{ x = "{fields.u[k][0]}" }}')
        text += entry(f"{body}_contact", f"traction = [{vector(fields.shear(k))}]")
    return text + (
        '[[contact]]\nbetween = ["lower_contact", "upper_contact"]\ncondition = "bilateral"\n'
        f'initial_gap = "closed"\nmultipliers_on = "{multipliers}_contact"\n'
    )


def measure(folder, summary, fields):
    """The true error of p at the nodes and along the line, and what the run says of them."""
    line = launch.contact(folder)
    x, y, p, s, bar = (line[key] for key in ("x", "y", "p", "s", "p_error"))
    exact = fields.pressure(x, y)
    error = np.abs(p - exact)
    told = summary["estimate"]["pressure"]
    counts = np.ones(len(s), bool)
    for point in told["singular"]:
        counts &= np.hypot(x - point["position"][0], y - point["position"][1]) >= point["left_out"]
    s, p, bar, exact, error = (v[counts] for v in (s, p, bar, exact, error))
    root = lambda v: np.sqrt(np.trapz(v**2, s))
    said = told["error"] * root(p) if told["error"] is not None else np.nan
    floor = ROUND_OFF * np.abs(exact).max()
    return {
        "inside": float(np.mean(error <= bar + floor)),
        "ratio": float(said / max(root(error), floor)),
        "error": float(root(error) / root(exact)),
        "local": told.get("line"), "far": told.get("far_field"),
        "worst": float((error / (bar + floor)).max()),
    }  # fmt: skip


def execute(run):
    fields = fields_of(run)
    found = launch.measured(scene_of(run, fields), lambda *found: measure(*found, fields))
    return found | {"failed": found["failed"] if len(found) == 1 else ""}


def groups(rows):
    """Rows by name: all of them, and by space, side, element and model."""
    yield "all", rows
    for key in ("space", "side", "element", "plane"):
        for value in sorted({row[key] for row in rows}):
            yield value, [row for row in rows if row[key] == value]


def told(rows):
    """What a table says of some runs."""
    ratios, inside = (np.array([row[key] for row in rows]) for key in ("ratio", "inside"))
    return {
        "runs": len(rows), "least": ratios.min(), "median": np.median(ratios), "below": np.mean(ratios < LEAST_RATIO),
        "nodes": inside.mean(), "hold": np.mean(inside >= NODES),
    }  # fmt: skip


def locks(run):
    """Linear elements near incompressibility: mortise warns of them, and bars do not hold."""
    nu = max(run["nu_lower"], run["nu_upper"])
    return run["element"] in ("T3", "Q4") and run["plane"] != "stress" and nu > 0.48


def verdict(rows):
    """Whether bars and estimates are what they should be, where elements do not lock."""
    found = told([row for row in rows if not locks(row)])
    return found["hold"] >= RUNS and found["least"] >= LEAST_RATIO and found["median"] <= MOST_MEDIAN


def main(arguments=None):
    options = launch.command_line(__doc__, "bars", arguments)
    store = runs.Store(options.output / "runs", [__file__, HERE / "sliding.py", HERE / "sliding.geo"], jobs=options.jobs)
    drawn = [draw(seed) for seed in range(40 if options.quick else 300)]
    rows = [run | found for run, found in zip(drawn, store.rows(drawn, execute, "bars"))]
    failed = [row for row in rows if row["failed"]]
    for row in failed:
        print(f"seed {row['seed']}: {row['failed']}")
    rows = [row for row in rows if not row["failed"]]
    launch.write_csv(options.output / "bars.csv", rows)
    print("of                 runs  least  median  below 0.7  nodes inside  runs that hold")
    for name, some in [*groups(rows), ("not locking", [row for row in rows if not locks(row)])]:
        t = told(some)
        print(f"{name:18s} {t['runs']:4d}  {t['least']:5.2f}  {t['median']:6.2f}  {t['below']:8.0%}  {t['nodes']:11.0%}  {t['hold']:13.0%}")
    sys.exit(1 if failed or not verdict(rows) else 0)


if __name__ == "__main__":
    main()
