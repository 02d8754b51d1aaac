"""Two calls on the same problem, said or solved in two ways: their pressures and verdicts against one another."""

import math
import os

import results_files

NO_PRESSURE = 1e-9  # of E u / size: a difference of pressures below is round-off of what the bodies carry


def young_and_size(setting):
    xs, ys = zip(*setting.mesh.nodes)
    young = max(m["young"] for m in setting.scene["materials"].values())
    return young, math.hypot(max(xs) - min(xs), max(ys) - min(ys))


def least_pressure(folder, setting):
    young, size = young_and_size(setting)
    return NO_PRESSURE * young * results_files.largest_displacement(folder) / size


def difference(first, second, size):
    """Largest difference of p between the same places of two tables, and the place; None where places do not match."""
    if len(first) != len(second):
        return None
    worst = (0.0, None)
    rest = list(second)
    for pair, x, y, p in first:
        near = [r for r in rest if r[0] == pair and math.hypot(r[1] - x, r[2] - y) < 1e-6 * size]
        if not near:
            return None
        rest.remove(near[0])
        worst = max(worst, (abs(near[0][3] - p), (x, y)), key=lambda entry: entry[0])
    return worst


def compare(setting, twin, first, second, folder, other):
    """What differs between the call in `folder` and its twin in `other`, or None; p only where both are solved."""
    if twin.same_verdict and first.status != second.status and not borderline(folder, first, other, second):
        return f"{twin.name}: exit status {second.status} instead of {first.status} {second.said.strip()[:150]!r}"
    if first.status != 0 or second.status != 0:
        return None
    told, told_other = (results_files.summary(os.path.join(f, "results")) for f in (folder, other))
    if not told["contact"]:
        return None
    p = results_files.pressures(os.path.join(folder, "results"), told)
    q = results_files.pressures(os.path.join(other, "results"), told_other, twin.back, twin.factor)
    found = difference(p, q, young_and_size(setting)[1])
    if found is None:
        return f"{twin.name}: multipliers on {told_other['method']['multipliers_on']} at other places"
    largest = max(abs(row[3]) for row in p)
    if found[0] > max(twin.limit * largest, least_pressure(os.path.join(folder, "results"), setting)):
        return f"{twin.name}: p differs by {found[0]:.2g} at {found[1]}, the largest is {largest:.2g}"


def borderline(folder, first, other, second):
    """Whether a check stands so near its limit that round-off may turn it."""
    if {first.status, second.status} != {0, 2}:
        return False
    for where in (folder, other):
        for check in results_files.summary(os.path.join(where, "results"))["checks"]:
            if check["value"] is not None and 0.99 < check["value"] / check["limit"] < 1.01:
                return True
    return False
