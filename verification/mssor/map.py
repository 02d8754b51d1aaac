#!/usr/bin/python3
"""The preprint's solver, MSSOR, over its parameters and against the direct solver (docs/theory.md, section 12).

First the region of convergence over (omega, tau) with the steps to 1e-8, for the stationary method and as
preconditioner, on two meshes of parabola_1 (8-node quadrilaterals); then steps and seconds to 1e-10 from 20x25 to
160x200, the stationary method with the best parameters found. Written below the output folder are map.csv, map.png,
steps.csv, steps.png and section.html. Runs that are already there, of the same executable, are not repeated. Exit
status 1 if a run converges outside the region or diverges inside, if one that should converge does not, or if a
pressure differs from the direct solver's by more than 1e-8 of the largest.
"""

import argparse
import sys
from pathlib import Path

import mssor_region
import mssor_runs  # makes launch and page known
import mssor_steps
import launch
import page

# Of the map: mesh, fineness of the grid for each acceleration, most steps of the stationary method.
MAPS = {
    "full": [
        ((20, 25), {"none": "usual", "krylov": "full"}, 20000),
        ((40, 50), {"none": "coarse", "krylov": "full"}, 40000),
    ],
    "quick": [((8, 10), {"none": "coarse", "krylov": "coarse"}, 20000)],
}
MOST_KRYLOV_STEPS = 5000
# Of the table: meshes, and of each method the finest of them.
MESHES = {"full": [(20, 25), (40, 50), (80, 100), (160, 200)], "quick": [(8, 10), (16, 20)]}
FINEST = {
    "full": {"direct": (160, 200), "krylov": (160, 200), "minres": (160, 200), "none": (40, 50)},
    "quick": {"direct": (16, 20), "krylov": (16, 20), "minres": (16, 20), "none": (8, 10)},
}
LIMIT = 1e-8  # of the pressures' difference


def measure_maps(folder, size):
    return [
        row
        for mesh, grids, most_steps in MAPS[size]
        for acceleration, grid in grids.items()
        for row in mssor_region.measure(
            folder,
            mesh,
            acceleration,
            mssor_region.OMEGAS[grid],
            mssor_region.TAUS[grid],
            most_steps if acceleration == "none" else MOST_KRYLOV_STEPS,
        )
    ]


def best_parameters(rows):
    """Of the stationary method, where it needs the fewest steps on the coarser mesh of the map."""
    row = mssor_region.best(rows, rows[0]["mesh"], "none")
    return {"none": {"method.omega": row["omega"], "method.tau": row["tau"]}} if row else {}


def map_text(rows):
    for mesh in dict.fromkeys(row["mesh"] for row in rows):
        for acceleration, words in mssor_region.ACCELERATIONS.items():
            here = [row for row in rows if row["mesh"] == mesh and row["acceleration"] == acceleration]
            least = mssor_region.best(rows, mesh, acceleration)
            count = lambda outcome: sum(row["outcome"] == outcome for row in here)
            at = f"{least['steps']} steps at omega = {least['omega']:g}, tau = {least['tau']:g}" if least else "none"
            yield (
                f"{mesh}, {words}: {len(here)} runs, {count('converged')} converge, {count('diverged')} diverge, "
                f"{count('unfinished')} are not done at the limit of steps; fewest {at}; "
                f"{sum(row['ok'] for row in here)} of {len(here)} are as eq. (38) says."
            )


def steps_table(rows):
    heading = ["mesh", "unknowns", "multipliers", "method", "omega", "tau", "steps", "seconds", "times direct"]
    heading += ["force residual", "kinematic residual", "p against direct"]
    cells = []
    for r in rows:
        figures = [f"{r['seconds']:.3g}", f"{r['over_direct']:.3g}"]
        figures += [f"{r[key]:.1e}" for key in ("force", "kinematic", "p_difference")]
        chosen = [r["omega"], r["tau"], r["steps"] or "–"]
        cells.append([r["mesh"], r["unknowns"], r["multipliers"], mssor_steps.WORDS[r["method"]], *chosen, *figures])
    return page.table(heading, cells)


def growth(rows):
    """By what the steps grow from mesh to mesh, in words."""
    for method in ("krylov", "minres", "none"):
        steps = [row["steps"] for row in rows if row["method"] == method]
        if len(steps) > 1:
            factors = ", ".join(f"{b / a:.2f}" for a, b in zip(steps, steps[1:]))
            yield f"{mssor_steps.WORDS[method]}: steps times {factors} from mesh to mesh of half the size"


ABOUT = (
    "Block SSOR for saddle points after Bychenkov and Chizhonkov: sweeps over u, multipliers, u with the SSOR splitting "
    "of K (parameter omega) and S = B diag(K)^-1 B^T (parameter tau). The stationary method converges for 0 < omega < 2 "
    "and tau below a limit that follows from an eigenvalue problem on the contact rows; as preconditioner it converges "
    "for any tau > 0. The default is omega = 1.3, tau = 0.7 as preconditioner of symmetric QMR."
)
WHY = (
    "The direct solver is faster on all of these meshes. What holds the iteration up is not the stand-in S: the steps "
    "hardly depend on tau below the limit. It is the smooth deformations of the bodies, which SSOR sees last. So the "
    "steps of the stationary method grow about as the number of unknowns, those of the accelerated ones as its root."
)
MAP_CAPTION = (
    "Steps to 1e-8 over the parameters, parabola_1, 8-node quadrilaterals, order of the unknowns by Cuthill and McKee. "
    "Above the black line the stationary method diverges."
)


def write_section(folder, maps, steps):
    parts = [
        page.paragraph(ABOUT),
        page.picture("map.png", MAP_CAPTION),
        *(page.paragraph(line) for line in map_text(maps)),
        page.heading("Steps and seconds against the direct solver"),
        steps_table(steps),
        page.picture("steps.png", "Steps to 1e-10, and seconds for the equations alone, one thread."),
        *(page.paragraph(line + ".") for line in growth(steps)),
        page.paragraph(WHY),
    ]
    page.write_section(folder, "mssor", "MSSOR, the preprint's solver", parts)


def failures(maps, steps):
    for row in maps:
        if not row["ok"]:
            yield "NOT ok: " + ", ".join(f"{key} {value}" for key, value in row.items())
    for row in steps:
        if not row["converged"] or row["p_difference"] > LIMIT:
            yield "NOT ok: " + ", ".join(f"{key} {value}" for key, value in row.items())


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, default=Path("out/mssor"), help="folder (default: out/mssor)")
    parser.add_argument("--quick", action="store_true", help="coarse meshes and grids")
    options = parser.parse_args(arguments)
    size, folder = "quick" if options.quick else "full", options.output
    folder.mkdir(parents=True, exist_ok=True)
    try:
        maps = measure_maps(folder, size)
        launch.write_csv(folder / "map.csv", maps)
        mssor_region.draw(folder / "map.png", maps)
        steps = mssor_steps.measure(folder, MESHES[size], FINEST[size], best_parameters(maps))
        launch.write_csv(folder / "steps.csv", steps)
        mssor_steps.draw(folder / "steps.png", steps)
        write_section(folder, maps, steps)
    except launch.MortiseError as error:
        sys.exit(f"map.py: {error}")
    wrong = list(failures(maps, steps))
    print(*map_text(maps), *growth(steps), *wrong, f"{folder}/map.csv, steps.csv, section.html", sep="\n")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
