"""Numbers: units, magnitudes, coordinates far from the origin, threads, repeated runs: how many digits p loses."""

import matplotlib.pyplot as plt
import numpy as np

import atlas_mesh
from atlas_regions import checks_of, ends, first, largest, last, quote, region, say, solved

TITLE = "Units, magnitudes, far coordinates, repetition"
INTRODUCTION = (
    "The same problem in other units must give the same digits. Two plates along a parabola (8-node quadrilaterals, "
    "12 and 15 along the line, pressure 10 MPa, closed gap), and two blocks 0.1 mm apart of which the upper one is "
    "pushed down by 0.3 mm (measured gap). Coordinates (with the prescribed displacements), moduli with pressures, "
    "and pressures alone are multiplied by powers of ten; or all coordinates are shifted. The figure is the largest "
    "difference of p over the largest p, after scaling back."
)
CAPTION = (
    "Largest difference of p from the unscaled run, over the largest p (dotted: 1e-6). Runs that mortise refuses "
    "are crosses at the top. Dashed: machine epsilon times the shift, over the shorter element (0.053 m) and over "
    "the measured gap (0.1 mm)."
)
SCALES = [10.0**k for k in (-9, -6, -3, 0, 3, 6, 9)]
LOADS = [*(10.0**k for k in range(0, 11, 2)), 1e11, 1e12]  # Pa
SHIFTS = [0.0, *(10.0**k for k in range(0, 10))]  # m
LOST = 1e-6  # a relative difference that is called a loss
PUSH = -3e-4
SCENES = ("closed", "measured")
UPPER, LOWER = 12, 15
EPSILON = 2.0**-52


def curve(x):
    return 0.2 + x - 1.25 * x * x


def scaled(scene, axis, value, length=1.0, stiffness=1.0, load=10e6, shift=0.0, **others):
    """A run with coordinates times `length` plus `shift`, moduli times `stiffness`, and this pressure on top."""
    gap = 1e-4 if scene == "measured" else 0
    line = curve if scene == "closed" else lambda x: 0.3
    bodies = atlas_mesh.plates(line, atlas_mesh.even(UPPER), atlas_mesh.even(LOWER))
    raise_by = {"lower": 0, "upper": gap}
    boundary = atlas_mesh.PRESSED[:2]
    if scene == "closed":
        boundary = [*boundary, f'on = "upper_top", pressure = {load * stiffness!r}']
    else:
        boundary = [*boundary, f'on = "upper_top", displacement = {{ y = {PUSH * length!r} }}']
    move = lambda name, x, y: (x * length + shift, (y + raise_by[name]) * length + shift)
    run = atlas_mesh.run(
        {
            "scene": scene,
            "axis": axis,
            "value": value,
            "p_scale": stiffness * (load / 10e6 if scene == "closed" else 1),
        },
        bodies,
        boundary,
        atlas_mesh.touching(scene),
        measures=["pressure"],
        move=move,
        young=210e9 * stiffness,
    )
    return {**run, **others}


def repeated(threads, time):
    """parabola_1 as it stands."""
    return {
        "axes": {"scene": "parabola_1", "axis": "threads", "value": threads, "time": time, "p_scale": 1},
        "scene": "parabola_1",
        "settings": {},
        "arguments": ["--threads", str(threads)],
        "measures": ["pressure", "digests"],
    }


def runs(quick):
    some = (lambda values: ends(values, 3)) if quick else (lambda values: values)
    listed = []
    for scene in SCENES:
        listed.append(scaled(scene, "base", 1.0))
        listed += [scaled(scene, "length", value, length=value) for value in some(SCALES)]
        listed += [scaled(scene, "stiffness", value, stiffness=value) for value in some(SCALES)]
        listed += [scaled(scene, "shift", value, shift=value) for value in some(SHIFTS)]
    listed += [scaled("closed", "load", value, load=value) for value in some(LOADS)]
    return listed + [repeated(threads, time) for threads in (1, 2) for time in (1, 2)]


def complete(rows):
    """difference: of p from the run without a scale, over the largest p there."""
    base = {row["scene"]: np.array(row["profile"]["p"]) for row in rows if row["axis"] == "base"}
    for row in rows:
        if row["scene"] in base and "profile" in row:
            p = np.array(row["profile"]["p"]) / row["p_scale"]
            same = len(p) == len(base[row["scene"]])
            reference = base[row["scene"]]
            row["difference"] = float(np.abs(p - reference).max() / np.abs(reference).max()) if same else 1.0
    return rows


def line_of(rows, scene, axis):
    return sorted((row for row in rows if (row["scene"], row["axis"]) == (scene, axis)), key=lambda row: row["value"])


def draw_axis(axes, rows, axis, label):
    for scene, marker in zip(SCENES, "os"):
        line = [row for row in line_of(rows, scene, axis) if row["value"] > 0]
        known = [row for row in line if "difference" in row]
        axes.plot(
            [row["value"] for row in known],
            [max(row["difference"], 1e-17) for row in known],
            marker + "-",
            fillstyle="none",
            label={"closed": "parabola, closed gap", "measured": "blocks, measured gap"}[scene],
        )
        refused = [row["value"] for row in line if "difference" not in row]
        axes.plot(refused, [3.0] * len(refused), "x", color="#c00000")
    axes.axhline(LOST, color="0.4", linestyle=":", linewidth=0.9)
    axes.set(xscale="log", yscale="log", ylim=(3e-18, 10), xlabel=label)
    axes.grid(alpha=0.25)


def draw(rows, path):
    figure, panels = plt.subplots(1, 4, figsize=(14, 4), sharey=True, layout="constrained")
    draw_axis(panels[0], rows, "length", "coordinates times")
    draw_axis(panels[1], rows, "stiffness", "E and pressure times")
    draw_axis(panels[2], rows, "load", "pressure on top, Pa")
    draw_axis(panels[3], rows, "shift", "coordinates shifted by, m")
    shifts = np.array(SHIFTS[1:])
    panels[3].plot(shifts, EPSILON * shifts / 0.053, "--", color="0.4", linewidth=1)
    panels[3].plot(shifts, EPSILON * shifts / 1e-4, "--", color="0.4", linewidth=1)
    panels[0].set_ylabel("largest difference of p / largest p")
    panels[0].legend(fontsize=8, loc="upper left")
    figure.savefig(path, dpi=85)
    plt.close(figure)


def same_files(rows, threads):
    """True if the runs with that many threads have written the same bytes."""
    hashes = [[row[key] for key in row if key.startswith("sha1")] for row in rows if row["value"] == threads]
    return all(one == hashes[0] for one in hashes)


def units_region(rows):
    scaled_rows = [row for row in rows if row["axis"] in ("length", "stiffness")]
    worst = largest(scaled_rows, "difference")
    begins = f"not found from 1e-9 to 1e9: p differs by at most {worst:.0e}"
    why = (
        "A direct solver whose rows differ in size by the units loses digits: K is of the size of E, the coupling "
        "of that of an edge (Golub & Van Loan, Matrix Computations, section 3.5, scaling)."
    )
    mortise = (
        "The system is made dimensionless before it is factorised (theory, section 5); all tolerances are relative."
    )
    return region("Units", begins, None if worst < LOST else worst, "fixed", why, mortise)


def load_region(rows):
    line = line_of(rows, "closed", "load")
    bound = first(line, "value", lambda row: row["outcome"] == "refused")
    runs_at = last(line, "value", solved)
    noted = first(line, "value", lambda row: row.get("warning_count"))
    begins = (
        f"refused at {say(bound)} Pa; the largest load that runs, {runs_at:g} Pa, means strains of about "
        f"{runs_at / 210e9:.2g}"
    )
    why = (
        "The equations are those of small strains, linear in the load: p scales with it however large it is. Beyond "
        "strains of a few per cent the answer is that of the equations, not of the bodies (Kikuchi & Oden 1988)."
    )
    said = f"From {noted:g} Pa on a warning says {quote(line, solved)}." if noted else "Below that nothing is said."
    mortise = f"A load above every Young's modulus is refused: {quote(line, lambda row: not solved(row))}. {said}"
    return region("Loads beyond small strains", begins, runs_at / 210e9, "guarded" if noted else "open", why, mortise)


def shift_region(rows, scene, name, effect):
    line = line_of(rows, scene, "shift")
    bound = first(line, "value", lambda row: row.get("difference", 0) > LOST)
    warned = first(line, "value", lambda row: row.get("warning_count") or "equal and opposite" in row["failed_checks"])
    at_million = next((row["difference"] for row in line if row["value"] == 1e6), None)
    tail = f"; {at_million:.0e} at 1e6 m" if at_million else ""
    begins = f"{LOST:g} of p is lost from a shift of {bound:g} m{tail}" if bound else f"not found{tail}"
    why = (
        "A coordinate of size X is known to 2.2e-16 X only (IEEE 754), and everything is made of differences of "
        f"coordinates. {effect}"
    )
    mortise = (
        f"The run is told from by a check or warning from {warned:g} m: {checks_of(line)}."
        if warned
        else "Nothing is said."
    )
    return region(name, begins, bound, "shown" if warned and bound and warned <= bound else "open", why, mortise)


def threads_region(rows):
    line = [row for row in rows if row["axis"] == "threads"]
    repeated_equal = all(same_files(line, threads) for threads in (1, 2))
    p = {row["value"]: np.array(row["profile"]["p"]) for row in line}
    off = float(np.abs(p[1] - p[2]).max() / np.abs(p[1]).max())
    begins = (
        f"repeated runs: {'the same bytes' if repeated_equal else 'NOT the same bytes'}; 1 and 2 threads: p differs "
        f"by {off:.0e}"
    )
    why = (
        "Sums in another order round otherwise (floating-point addition is not associative; Higham, Accuracy and "
        "Stability of Numerical Algorithms, chapter 4), and more threads sum in another order."
    )
    mortise = (
        "The number of threads is fixed by the size of the mesh and the machine, or by --threads; with the same "
        "number all files are the same."
    )
    return region("Repetition and threads", begins, off, "fixed" if repeated_equal else "open", why, mortise)


def regions(rows):
    gap = "A measured gap of 0.1 mm is such a difference, and its error makes a pressure of E over the height."
    return [
        units_region(rows),
        load_region(rows),
        shift_region(rows, "closed", "Far coordinates, closed gap", "Here only directions and lengths suffer."),
        shift_region(rows, "measured", "Far coordinates, measured gap", gap),
        threads_region(rows),
    ]
