#!/usr/bin/python3
"""Steps that domain decomposition needs to 1e-8: schemes, accelerations, ratios of stiffness, meshes, scenes.

The body that takes the displacement is the program's own choice. beta is the program's own too (none: fixed at the best
for the estimated spectrum). Written are steps.csv, a row a run, and steps.md. Exit status 1 if the default method
(method.solver = "ddm" and nothing else) needs more than 14 steps anywhere.
"""

import argparse
import sys
from pathlib import Path

import ddm_runs  # makes launch known
import launch

SCENES = {
    "parabola_1": {},
    "cosine": {"contact.condition": "bilateral"},
}
SCHEMES = ["neumann_dirichlet", "neumann_neumann", "dirichlet_dirichlet"]
ACCELERATIONS = ["none", "aitken", "anderson", "krylov"]
RATIOS = [0.01, 0.1, 1, 10, 100]  # of Young's moduli, upper over lower body
MESHES = {
    "quick": [(20, 25)],
    "usual": [(20, 25), (40, 50), (80, 100), (160, 200)],
    "full": [(20, 25), (40, 50), (80, 100), (160, 200), (320, 400)],
}
MOST_STEPS = 300
BAR = 14
DEFAULT = "default"


def shortened(row, scene, mesh, scheme):
    """One run of a sweep as a row of steps.csv."""
    young = row["materials.other.young"]
    return {
        "scene": scene,
        "mesh": f"{mesh[0]}x{mesh[1]}",
        "ratio": float(f"{young / launch.YOUNG:.6g}"),
        "scheme": scheme,
        "acceleration": row.get("method.acceleration", DEFAULT),
        "outcome": ddm_runs.outcome(row, MOST_STEPS),
        "steps": int(row["iteration.steps"]),
        "factor": row["iteration.convergence_rate"],
        "mu_smallest": row["iteration.eigenvalue.smallest"],
        "mu_largest": row["iteration.eigenvalue.largest"],
        "seconds": row["seconds.solve"],
    }


def measure(scene, mesh, ratios, schemes, accelerations):
    """The default method, then all schemes and accelerations, on one mesh."""
    settings = {**SCENES[scene], **launch.sizes(mesh), **launch.stiffness(1)}
    young = {"materials.other.young": [launch.YOUNG * ratio for ratio in ratios]}
    rows = [shortened(row, scene, mesh, DEFAULT) for row in ddm_runs.sweep(scene, settings, young)]
    settings["method.max_iterations"] = MOST_STEPS
    for scheme in schemes:
        choice = {**settings, "method.scheme": scheme}
        found = ddm_runs.sweep(scene, choice, {**young, "method.acceleration": accelerations})
        rows += [shortened(row, scene, mesh, scheme) for row in found]
    return rows


def measure_all(meshes):
    return [
        row for scene in SCENES for mesh in meshes for row in measure(scene, mesh, RATIOS, SCHEMES, ACCELERATIONS)
    ]


def over_the_bar(rows):
    return [r for r in rows if r["scheme"] == DEFAULT and (r["outcome"] != "converged" or r["steps"] > BAR)]


def cell(rows):
    """Steps on the meshes, from coarse to fine."""
    words = {"converged": "{steps}", "diverged": "diverged", "unfinished": "> {steps}"}
    return ", ".join(words[row["outcome"]].format(**row) for row in rows)


def table(rows):
    """Lines of a Markdown table: methods by ratios."""
    ratios = list(dict.fromkeys(row["ratio"] for row in rows))
    yield "| scheme | acceleration | " + " | ".join(f"ratio {ratio:g}" for ratio in ratios) + " |"
    yield "|---|---|" + "---|" * len(ratios)
    for scheme, acceleration in dict.fromkeys((row["scheme"], row["acceleration"]) for row in rows):
        here = [row for row in rows if (row["scheme"], row["acceleration"]) == (scheme, acceleration)]
        cells = [cell([row for row in here if row["ratio"] == ratio]) for ratio in ratios]
        first = f"**{scheme}** | " if scheme == DEFAULT else f"{scheme} | {acceleration}"
        yield f"| {first} | " + " | ".join(cells) + " |"


def markdown(rows):
    meshes = ", ".join(dict.fromkeys(row["mesh"] for row in rows))
    yield "# Steps of domain decomposition"
    yield ""
    yield "Evaluations of the interface until both relative residuals are below 1e-8. Ratio: Young's modulus of the"
    yield "upper body over that of the lower one. The program chooses the roles and beta; the default is"
    yield f"neumann_dirichlet with krylov. The numbers of a cell belong to the meshes {meshes}, in this order."
    for scene in dict.fromkeys(row["scene"] for row in rows):
        yield f"\n## {scene}, bilateral\n"
        yield from table([row for row in rows if row["scene"] == scene])
    most = max(row["steps"] for row in rows if row["scheme"] == DEFAULT)
    yield f"\nThe default needs at most {most} steps; the bar is {BAR}."


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, default=Path("out/ddm"), help="folder (default: out/ddm)")
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--quick", action="store_const", dest="size", const="quick", help="the coarsest mesh only")
    size.add_argument("--full", action="store_const", dest="size", const="full", help="320 x 400 elements too")
    options = parser.parse_args(arguments)
    options.output.mkdir(parents=True, exist_ok=True)
    try:
        rows = measure_all(MESHES[options.size or "usual"])
    except launch.MortiseError as error:
        sys.exit(f"steps.py: {error}")
    launch.write_csv(options.output / "steps.csv", rows)
    text = "\n".join(markdown(rows)) + "\n"
    (options.output / "steps.md").write_text(text)
    print(text + f"\n{options.output}/steps.csv, steps.md")
    worse = over_the_bar(rows)
    for row in worse:
        print("over the bar: {scene}, {mesh}, ratio {ratio:g}: {outcome}, {steps} steps".format(**row))
    sys.exit(1 if worse else 0)


if __name__ == "__main__":
    main()
