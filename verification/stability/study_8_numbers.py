"""Numbers: units, magnitudes, coordinates far from the origin, threads, repeated runs: how many digits p loses."""

import numpy as np

import figure
from failures import checks_of, draw_line, ends, failure, first, largest, last, of_scene, quote, select, solved
from plates import even
from small_meshes import PRESSED, plates, run, touching

SCALES = [10.0**k for k in (-9, -6, -3, 0, 3, 6, 9)]
LOADS = [*(10.0**k for k in range(0, 11, 2)), 1e11, 1e12]  # Pa
SHIFTS = [0.0, *(10.0**k for k in range(0, 10))]  # m
LOST = 1e-6  # a relative difference that is called a loss
PUSH = -3e-4
SCENES = {"closed": "parabola, closed gap", "drawn": "blocks, drawn gap"}
EDGE, GAP = 0.053, 1e-4  # m: the shorter element, and the drawn gap
EPSILON = 2.0**-52


def scaled(scene, axis, value, length=1.0, stiffness=1.0, load=10e6, shift=0.0):
    """A run with coordinates times `length` plus `shift`, moduli times `stiffness`, and this pressure on top."""
    closed = scene == "closed"
    bodies = plates((lambda x: 0.2 + x - 1.25 * x * x) if closed else (lambda x: 0.3), even(12), even(15))
    top = f"pressure = {load * stiffness!r}" if closed else f"displacement = {{ y = {PUSH * length!r} }}"
    scale = lambda gap: lambda x, y: (x * length + shift, (y + gap) * length + shift)
    bodies = [one.put(scale(gap)) for one, gap in zip(bodies, (0, 0 if closed else GAP))]
    axes = {"scene": scene, "axis": axis, "value": value, "p_scale": stiffness * (load / 10e6 if closed else 1)}
    boundary, young = [*PRESSED[:2], f'on = "upper_top", {top}'], 210e9 * stiffness
    pair = touching(gap="closed" if closed else None)
    return run(axes, bodies, boundary, pair, measures=["pressure"], young=young)


def repeated(threads, time):
    """parabola_1 as it stands."""
    axes = {"scene": "parabola_1", "axis": "threads", "value": threads, "time": time, "p_scale": 1}
    return of_scene(axes, "parabola_1", {}, "pressure", "digests", arguments=["--threads", str(threads)])


def runs(quick):
    some = (lambda values: ends(values, 3)) if quick else (lambda values: values)
    listed = []
    for scene in SCENES:
        listed.append(scaled(scene, "base", 1.0))
        for axis, values in (("length", SCALES), ("stiffness", SCALES), ("shift", SHIFTS)):
            listed += [scaled(scene, axis, value, **{axis: value}) for value in some(values)]
    listed += [scaled("closed", "load", value, load=value) for value in some(LOADS)]
    return listed + [repeated(threads, time) for threads in (1, 2) for time in (1, 2)]


def complete(rows):
    """difference: of p from the run without a scale, over the largest p there."""
    base = {row["scene"]: np.array(row["profile"]["p"]) for row in rows if row["axis"] == "base"}
    for row in rows:
        if row["scene"] in base and "profile" in row:
            p, reference = np.array(row["profile"]["p"]) / row["p_scale"], base[row["scene"]]
            same = len(p) == len(reference)
            row["difference"] = float(np.abs(p - reference).max() / np.abs(reference).max()) if same else 1.0
    return rows


def draw_axis(axes, rows, label):
    for (scene, name), marker in zip(SCENES.items(), "os"):
        line = [row for row in select(rows, scene=scene) if row["value"] > 0]
        draw_line(axes, line, "value", "difference", marker + "-", fillstyle="none", label=name)
        refused = [row["value"] for row in line if "difference" not in row]
        axes.plot(refused, [3.0] * len(refused), "x", color=figure.RED)
    figure.label(axes, label, log="xy", limit=LOST, ylim=(3e-18, 10))


def draw(rows, path):
    drawing, panels = figure.panels(1, 4, (14, 4), sharey=True)
    labels = {"length": "coordinates times", "stiffness": "E and pressure times", "load": "pressure on top, Pa"}
    labels["shift"] = "coordinates shifted by, m"
    for axes, (axis, label) in zip(panels, labels.items()):
        draw_axis(axes, select(rows, axis=axis), label)
    shifts = np.array(SHIFTS[1:])
    for size in (EDGE, GAP):
        panels[3].plot(shifts, EPSILON * shifts / size, ":", color="0.4", linewidth=1)
    panels[0].set_ylabel("largest difference of p / largest p")
    panels[0].legend(loc="upper left")
    figure.save(drawing, path)


def load_failure(rows):
    line = select(rows, scene="closed", axis="load")
    runs_at = last(line, "value", solved)
    noted = first(line, "value", lambda row: row.get("warning_count"))
    return failure(
        "Loads beyond small strains",
        runs_at / 210e9,
        "guarded" if noted else "open",
        refused=first(line, "value", lambda row: row["outcome"] == "refused"),
        runs_at=runs_at,
        strain=runs_at / 210e9,
        refusal=quote(line, lambda row: not solved(row)),
        noted=noted,
        said=quote(line, solved),
    )


def shift_failure(rows, scene):
    line = select(rows, scene=scene, axis="shift")
    bound = first(line, "value", lambda row: row.get("difference", 0) > LOST)
    tells = lambda row: row.get("warning_count") or "equal and opposite" in row.get("failed_checks", "")
    warned = first(line, "value", tells)
    return failure(
        f"Far coordinates, {scene} gap",
        bound,
        "shown" if warned and bound and warned <= bound else "open",
        lost=LOST,
        at_million=next((row.get("difference") for row in line if row["value"] == 1e6), None),
        warned=warned,
        checks=checks_of(line),
    )


def threads_failure(rows):
    line, p, equal = select(rows, axis="threads"), [], True
    for threads in (1, 2):
        some = select(line, value=threads)
        hashes = [[row[key] for key in row if key.startswith("sha1")] for row in some]
        equal = equal and all(one == hashes[0] for one in hashes)
        p.append(np.array(some[0]["profile"]["p"]))
    off = float(np.abs(p[0] - p[1]).max() / np.abs(p[0]).max())
    return failure("Repetition and threads", off, "fixed" if equal else "open", equal=equal, off=off)


def failures(rows):
    worst = largest([row for row in rows if row["axis"] in ("length", "stiffness")], "difference")
    units = failure("Units", None if worst < LOST else worst, "fixed" if worst < LOST else "open", worst=worst)
    shifts = [shift_failure(rows, scene) for scene in SCENES]
    return [units, load_failure(rows), *shifts, threads_failure(rows)]
