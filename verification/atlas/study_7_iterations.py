"""Iterations: the active set where contact is about to change, and the relaxation of domain decomposition."""

import subprocess
import sys
from pathlib import Path

import atlas_iterations_picture
import atlas_mesh
import launch
from atlas_iterations_picture import count_of, of_part
from atlas_regions import first, quote, region, solved

TITLE = "Iterations: active set and relaxation"
INTRODUCTION = (
    "Scenes in which rows stand at the border of opening: lift_off over the force that bends the plate off; "
    "gap_close with the prescribed displacement within 1e-1 to 1e-14 of the gap; a flat line with p = 0 exactly "
    "(compressed along the line only) and small pressures on it; cosine, hertz and rings with the gap as the meshes "
    "have it; unilateral domain decomposition. And the region of beta in which Neumann-Dirichlet converges "
    "(verification/ddm/region.py)."
)
CAPTION = (
    "Steps of the active set (solves), and of domain decomposition. Crosses: not converged; runs that are refused "
    "are not drawn. In the last panel the limit predicted from the eigenvalues against runs that converge (dots) "
    "and diverge (crosses)."
)
SPACES = ["linear", "quadratic", "dual"]
PERTURBATIONS = [1e-14, 1e-12, 1e-9, 1e-6, 1e-3, 1e-1]
FORCES = [0, 0.1, 0.2, 0.3, 0.5, 1, 1.5, 2, 3, 3.9, 4, 5]
GAP = 1e-4
MESHES = [(20, 25), (39, 51), (40, 50), (80, 100)]
BAR = 10  # steps: what is called many
ALLOWED = 100  # steps after which mortise stops
REGION = Path(__file__).resolve().parents[1] / "ddm/region.py"


def geo(part, scene, settings, value, line):
    return {
        "axes": {"part": part, "value": value, "line": line},
        "scene": scene,
        "settings": settings,
        "measures": ["pressure"],
    }


def lift(force, space, mesh):
    settings = {"boundary.3.traction": f"[0, {2e6 * force!r}]", "method.multipliers": space}
    settings |= {"mesh.parameters.n_plate": mesh, "mesh.parameters.n_block": mesh * 5 // 4}
    return geo("lift_off", "lift_off", settings, force, f"{space}, {mesh} elements")


def near_gap(perturbation, space):
    """gap_close with the top moved down by the gap times 1 + perturbation."""
    settings = {"boundary.2.displacement": f"{{ y = {-GAP * (1 + perturbation)!r} }}", "method.multipliers": space}
    return geo("near", "gap_close", settings, perturbation, f"gap_close, {space}")


def sideways(share, space):
    """Two plates with 10 MPa from the right, which leaves a flat line without pressure, and `share` of that on top."""
    bodies = atlas_mesh.plates(lambda x: 0.3, atlas_mesh.even(7), atlas_mesh.even(11))
    boundary = [*atlas_mesh.SLIDING[:2], f'on = "upper_top", pressure = {10e6 * share!r}']
    boundary.append('on = ["upper_right", "lower_right"], pressure = 10e6')
    axes = {"part": "near", "value": share, "line": f"p = 0, {space}"}
    return atlas_mesh.run(axes, bodies, boundary, atlas_mesh.touching(), {"method.multipliers": space}, ["pressure"])


def others(quick):
    for n, mesh in enumerate(MESHES[:2] if quick else MESHES):
        for space in SPACES:
            settings = {**launch.sizes(mesh), "method.multipliers": space}
            yield geo("others", "cosine", settings, n, f"cosine, {space}")
            rings = {
                "mesh.parameters.n_inner": mesh[0],
                "mesh.parameters.n_outer": mesh[1],
                "contact.initial_gap": "measured",
            }
            edges = {"mesh.parameters.straight": 1, "method.multipliers": space}
            yield geo("others", "rings", {**rings, **edges}, n, f"rings, measured, straight edges, {space}")
        yield geo("others", "hertz", {"boundary.2.pressure": 4.6e6 * 4.0**-n}, n, "hertz, loads")


def decomposed(quick):
    """Unilateral domain decomposition, where contact opens."""
    for n, mesh in enumerate(MESHES[:2] if quick else MESHES):
        for acceleration in ("aitken", "krylov"):
            for kind in (0, 1):
                settings = {**launch.sizes(mesh), "method.solver": "ddm", "method.acceleration": acceleration}
                settings |= {"mesh.parameters.order": 2 - kind, "mesh.parameters.kind": kind}
                elements = ("8-node quadrilaterals", "3-node triangles")[kind]
                yield geo("ddm", "cosine", settings, n, f"{acceleration}, {elements}")


def runs(quick):
    forces, steps = (FORCES[::5], PERTURBATIONS[::2]) if quick else (FORCES, PERTURBATIONS)
    listed = [
        lift(force, space, mesh) for mesh in ((32,) if quick else (32, 64)) for space in SPACES for force in forces
    ]
    values = [-value for value in steps] + [0] + steps
    listed += [near_gap(value, space) for space in SPACES for value in values]
    listed += [sideways(value, space) for space in SPACES for value in values]
    return listed + [*others(quick), *decomposed(quick)]


def extra(folder, quick):
    """The rows of region.csv: of ./dev ddm's folder beside the atlas if it is there, else made now."""
    table = folder.parent / "ddm/region.csv"
    if not table.is_file():
        table = folder / "iterations/ddm/region.csv"
    if not table.is_file():
        print("  verification/ddm/region.py runs", flush=True)
        words = [sys.executable, REGION, "-o", table.parent, *(["--quick"] if quick else [])]
        subprocess.run([str(word) for word in words], check=True, stdout=subprocess.DEVNULL)
    columns = launch.columns(table)
    return [{"part": "region", **dict(zip(columns, values))} for values in zip(*columns.values())]


def draw(rows, path):
    atlas_iterations_picture.draw(rows, path, PERTURBATIONS, MESHES)


def widest(rows, holds):
    """The largest distance from the border at which a run fulfils a condition."""
    return max((abs(row["value"]) for row in rows if holds(row)), default=None)


def noisy_pressure(line):
    return max((row["p_max"] for row in line if row["outcome"] == "check"), default=0.0)


def border_regions(rows):
    line = of_part(rows, "near")
    cycles, noise = (widest(line, lambda row: row["outcome"] == name) for name in ("not converged", "check"))
    wrong_way = [row for row in line if row["outcome"] == "refused"]
    calm = [row for row in line if row["outcome"] == "solved"]
    why = (
        "Where p and the gap vanish together the sign of both is rounding, and a row changes side in every step; "
        "the active set's finite end (Hintermüller, Ito & Kunisch 2003) is that of exact arithmetic. A floor for "
        "both (theory, section 10) makes p = 0 itself quiet; a pull just above the floor is decided by rounding still."
    )
    yield region(
        "p = 0 and gap = 0 at once: the active set goes round",
        (
            f"not converged after {max(row['steps'] for row in line if solved(row))} solves within {cycles:g} of the "
            "border (of the load)"
            if cycles is not None
            else "not found"
        ),
        cycles,
        "fixed" if cycles is None else "shown",
        why,
        f"Status not_converged, with the places: {quote(line, lambda row: row['outcome'] == 'not converged')}. "
        f"Outside the border the motion is named: {quote(wrong_way)}.",
    )
    yield region(
        "p = 0 and gap = 0 at once: checks of rounding by rounding",
        (
            f"checks fail within {noise:g} of the border; from there on {max(row['steps'] for row in calm)} steps at "
            "most"
            if noise is not None
            else "not found"
        ),
        noise,
        "fixed" if noise is None else "shown",
        "A check that divides by the largest multiplier has nothing to measure by where all are rounding (Higham, "
        "Accuracy and Stability of Numerical Algorithms, chapter 1: relative errors of zero).",
        f"The run ends as check_failed although p is rounding, {noisy_pressure(line):.0e} Pa at most: a false alarm. "
        f"Failing "
        f"checks: {'; '.join(sorted({row['failed_checks'] for row in line if row['outcome'] == 'check'})) or 'none'}.",
    )


def lift_region(rows):
    line = of_part(rows, "lift_off")
    bound = first(line, "value", lambda row: row["outcome"] == "not converged")
    most = max(row["steps"] for row in line if row["outcome"] in ("solved", "check"))
    begins = f"at {bound:g} times the force (resultant 0, a moment left)" if bound is not None else "not found"
    why = (
        "The force then cancels the pressure: no multiplier <= 0 balances the moment that is left, so the problem "
        "has no solution (Farkas; theory, section 10), but the load's work on the lifting motion is rounding and "
        "not clearly positive."
    )
    mortise = (
        f"Below it at most {most} steps. There: {quote(line, lambda row: row['outcome'] == 'not converged')}; other "
        "meshes end as check_failed with a pressure of rounding."
    )
    return region("Lift-off to the last point", begins, bound, "fixed" if bound is None else "shown", why, mortise)


def many_region(rows):
    line = of_part(rows, "others")
    most, bad = max(row["steps"] for row in line), [row for row in line if row["outcome"] == "not converged"]
    why = (
        "From a set that is too large the method opens a curve a few rows a step, more steps on finer meshes, and "
        "on many small gaps it may cycle (Hüeber & Wohlmuth 2005; Júdice & Pires 1994)."
    )
    mortise = "The second step starts from joined rows, and a rule of single changes ends cycles (theory, section 10)."
    begins = f"not found: at most {most} steps in {len(line)} runs" if not bad else f"{len(bad)} of {len(line)} runs"
    return region(
        "Many places of contact",
        begins,
        float(len(bad)) or None,
        "fixed" if not bad and most <= BAR else "shown",
        why,
        mortise,
    )


def ddm_region(rows):
    line = of_part(rows, "ddm")
    krylov = [row for row in line if row["line"].startswith("krylov")]
    aitken = [row for row in line if row["line"].startswith("aitken")]
    failed = [row for row in aitken if row["outcome"] == "not converged"]
    bad = [row for row in krylov if row["outcome"] == "not converged"]
    begins = (
        f"default acceleration: {len(bad)} of {len(krylov)} runs fail, at most "
        f"{max(count_of(row) for row in krylov)} steps; aitken: {len(failed)} of {len(aitken)}"
    )
    why = (
        "The Dirichlet body's contact problem makes the map piecewise linear: relaxation by one number meets kinks "
        "of the map where rows open and close (Krause & Wohlmuth 2002; Küttler & Wall 2008)."
    )
    mortise = f"The default does not relax by one number. Else not_converged: {quote(failed)}."
    return region(
        "Unilateral domain decomposition", begins, float(len(failed)), "default" if not bad else "shown", why, mortise
    )


def relaxation_region(rows):
    found = [row for row in of_part(rows, "region") if row["dirichlet"] == "upper"]
    limit = {row["ratio"]: 2 / row["mu_largest"] for row in found}
    words = ", ".join(f"{limit[ratio]:.3g} at {ratio:g}" for ratio in sorted(limit))
    agree = sum(int(row["ok"]) for row in found)
    why = (
        "A step multiplies the error by the eigenvalues of I - beta (I + C_D^-1 C_N), which are all below 1 in size "
        "for 0 < beta < 2 / mu_max only (Toselli & Widlund 2005, section 1.3.3; theory, eq. 33)."
    )
    mortise = (
        f"beta = \"auto\" takes the best beta from the eigenvalues; the default acceleration needs none. {agree} of "
        f"{len(found)} runs lie on the predicted side with the predicted factor."
    )
    return region(
        "Fixed relaxation",
        f"beta, by E_upper/E_lower (displacement on the upper body): {words}",
        min(limit.values()),
        "default",
        why,
        mortise,
    )


def regions(rows):
    return [*border_regions(rows), lift_region(rows), many_region(rows), ddm_region(rows), relaxation_region(rows)]
