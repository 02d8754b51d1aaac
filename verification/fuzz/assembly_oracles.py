"""What must hold of an assembly: it is refused if nothing carries its load, and only then; its contact forces are those of
a convex problem's answer, and the same however it is solved.
"""

import math
import os
import tempfile
from pathlib import Path

import numpy as np

import launch
import one_call
from fuzz_case import solve_case
from rigid_motions import drift

DRIVEN = 1e-6  # work of the loads on a motion of 1, over their sizes: above the linear programme's round-off
EXACT = 1e-9
APART = 1e-6  # of moments: a pair's force has another arm on either side of the gap between two meshes of an arc
ROUND_OFF = 1e-12  # of Young's modulus times the largest displacement: gaps below that part of it are round-off to mortise, too
HONEST = {"estimated error of p", "turn and slide of contact lines"}  # checks of the mesh and the model, not of the solver
ALIKE = 1e-6  # forces of the pairs by two solvers, over the largest


def feasible(assembly):
    """Whether anything carries the load; None where only places far from the nearest ones do: whether they face each other
    hangs on whose normals count, that is on the side with the multipliers."""
    if drift(assembly, near_only=False) > DRIVEN:
        return False
    return True if drift(assembly, near_only=True) < DRIVEN else None


def forces(told):
    """(curve with the multipliers, the other, force and moment on the first's body and on the other's) of every pair."""
    for pair, side in zip(told["contact"], told["method"]["multipliers_on"]):
        other = next(curve for curve in pair["between"] if curve != side)
        force = np.array([*pair["force"], pair["moment"]])
        besides = pair.get("fluid", {}).get("besides", {"force": (0, 0), "moment": 0})
        yield side, other, force, np.array([*besides["force"], besides["moment"]]) - force


def unbalanced(told, assembly):
    """The largest sum of forces and moments on a body, over the largest load or contact force."""
    sums, largest = {part.name: np.zeros(3) for part in assembly.parts}, 0.0

    def add(curve, force):
        nonlocal largest
        sums[curve.split("_")[0]] += force
        largest = max(largest, np.abs(force).max())

    for side, other, force, back in forces(told):
        add(side, force)
        add(other, back)
    for tie in told["model"].get("ties", []):
        force = np.array([*tie["force"], tie["moment"]])
        add(tie["follows"], force)
        angle = math.radians(tie.get("turned", 0.0))  # of a sector: the force on the other cut is that of the next one, turned back
        across = complex(*force[:2]) * complex(math.cos(angle), -math.sin(angle))
        add(tie["leads"], -np.array([across.real, across.imag, force[2]]))
    for load in told["model"]["loads"]:
        add(load["body"], np.array([*load["sum"], load["moment"]]))
    for curve in (curve for support in told["model"]["supports"] for curve in support["curves"]):
        add(curve["on"], np.array([*curve["reaction"], curve["moment"]]))
    for body, held in told["balance"]["held"].get("bodies", {}).items():  # of motions that nothing holds
        add(body, np.array([*held["force"], held["moment"]]))
    return max(np.abs(total * [1, 1, EXACT / APART]).max() for total in sums.values()) / largest


def unsolved(told):
    """What the run itself says of a contact problem that it has not solved."""
    failed = [check for check in told["checks"] if not check["ok"]]
    wrong = [f"{check['name']} {check['value']}" for check in failed if check["name"] not in HONEST]
    return wrong + ([told["status"]] if told["status"] == "not_converged" else [])


def violated(told, folder):
    """What of p >= 0, gap >= 0, p gap = 0 and the balance of every body does not hold, by how much."""
    checks = unsolved(told)
    p = launch.columns(Path(folder, "results/contact.csv"))["p"]
    if np.nanmin(p) < -EXACT * np.nanmax(p) - round_off(told):
        checks.append(f"p down to {np.nanmin(p):.2g}")
    return checks


def round_off(told):
    """Of stresses, by the displacement of the bodies that are free to move."""
    return ROUND_OFF * max(material["young"] for material in told["model"]["materials"].values()) * told["extremes"]["displacement"]


def by_pair(told):
    """The force of each pair, on the curve that is first by its name."""
    return {frozenset((side, other)): force[:2] if side < other else -force[:2] for side, other, force, _ in forces(told)}


def bars_of(told, folder):
    """What the bars of p allow the force of each pair to be off by: their sums along the sides with the multipliers."""
    table, sums = launch.columns(Path(folder, "results/contact.csv")), []
    for k, side in enumerate(told["method"]["multipliers_on"]):
        mine = (table["pair"] == k) & (table["curve"] == side)
        order = np.argsort(table["s"][mine])
        sums.append(float(np.trapz(np.nan_to_num(table["p_error"][mine][order]), table["s"][mine][order])))
    return sums


def weight_apart(told, again):
    """By how much the loads differ, as the areas of round bodies do by their meshes."""
    return sum(np.abs(np.subtract(one["sum"], other["sum"])).max() for one, other in zip(told["model"]["loads"], again["model"]["loads"]))


def differs(case, told, folder, program, carried):
    """What the same assembly gives in another way that it must not. `carried`: as feasible()."""
    other = solve_case("assembly", "", case.other["scene.toml"], case.other["mesh.geo"], mesh_file="mesh.geo")
    with tempfile.TemporaryDirectory(prefix="mortise_assembly_") as second:
        other.write(second)
        run = one_call.call(program, other, second)
        if run.status == 1 and carried is None and case.variant in ("other side", "view", "accuracy"):
            return None
        if run.status not in (0, 2):
            return f"{case.variant}: exit status {run.status}: {run.said.strip()[:200]}"
        again = launch.summary(Path(second, "results"))
        if wrong := unsolved(again):
            return f"{case.variant}: {', '.join(wrong)}"
        if case.variant == "again":
            files = [os.path.join(where, "results/contact.csv") for where in (folder, second)]
            same = Path(files[0]).read_bytes() == Path(files[1]).read_bytes()
            return None if same else "again: contact.csv is another one"
        if case.variant == "accuracy" and (sides := told["method"]["multipliers_on"]) != again["method"]["multipliers_on"]:
            return f"accuracy: multipliers on {', '.join(sides)} of one mesh, on other curves of another"
        mine, others = ({pair: case.view.unit * np.array(case.view.turned(*force)) for pair, force in by_pair(told).items()},
                        by_pair(again))  # fmt: skip
        bars = [np.multiply(case.view.unit, bars_of(told, folder)), bars_of(again, second)]
        largest = max(np.abs(force).max() for force in mine.values())
        weights = weight_apart(told, again) if case.variant == "accuracy" else 0.0
        for k, (pair, force) in enumerate(mine.items()):
            off, allowed = np.abs(force - others[pair]).max(), ALIKE * largest + weights + sum(bar[k] for bar in bars)
            if off > allowed:
                return f"{case.variant}: the force of {' and '.join(sorted(pair))} differs by {off:.2g}, by {allowed:.2g} at most"


def judge(case, run, folder, known):
    """(one of references.LABELS, what is wrong or None)."""
    carried = None if case.wet else feasible(case.setting)  # a fluid may blow bodies away
    advised = "expected shorter edges" in run.said
    if advised and carried is False:
        return "refused", "finer meshes are advised, though nothing carries the load"
    if advised and carried:  # the load is near to what the contact bears
        finer = solve_case("assembly", "", case.files["scene.toml"], case.files["mesh.geo"], mesh_file="mesh.geo")
        finer.words += ["--accuracy", "1%"]
        with tempfile.TemporaryDirectory(prefix="mortise_assembly_") as folder:
            finer.write(folder)
            run = one_call.call(known.program, finer, folder)
        return "refused", None if run.status in (0, 2) else f"refused on finer meshes too: {run.said.strip()[:300]}"
    if run.status not in (0, 2):
        return "refused", f"refused, though contact carries the load: {run.said.strip()[:300]}" if carried else None
    told = launch.summary(Path(folder, "results"))
    if carried is False:
        return "worse", f"{told['status']}, though nothing carries the load"
    wrong = violated(told, folder)
    if (off := unbalanced(told, case.setting)) > EXACT:
        wrong.append(f"a body is out of balance by {off:.2g}")
    wrong += [words] if (words := differs(case, told, folder, known.program, carried)) else []
    return ("worse", "; ".join(wrong)) if wrong else ("kept", None)
