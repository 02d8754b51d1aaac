"""Which runs are worth their seconds: the Pareto front, the advice for an error asked for, rates."""

import math

AS_GOOD = 1.15  # seconds within this factor of the quickest count as equal: timings vary by so much


def usable(row, error):
    return row.get(error) not in (None, "") and float(row[error]) > 0 and float(row["s_total"]) > 0


def front(rows, error):
    """The rows that no other beats in both seconds and error, by seconds. A tie in both keeps the first."""
    best, chosen = math.inf, []
    for row in sorted((r for r in rows if usable(r, error)), key=lambda r: (r["s_total"], r[error])):
        if row[error] < best:
            best = row[error]
            chosen.append(row)
    return chosen


def advice(rows, error, targets, prefer=()):
    """For each target the quickest row whose error is at most that, or None.

    Where others are as good as equally quick, the one whose method stands first in `prefer`.
    """
    rank = {method: place for place, method in enumerate(prefer)}
    found = {}
    for target in targets:
        good = [row for row in rows if usable(row, error) and row[error] <= target]
        least = min((row["s_total"] for row in good), default=0)
        equal = [row for row in good if row["s_total"] <= AS_GOOD * least] if prefer else good
        key = lambda row: (rank.get(row["method"], len(rank)), row["s_total"])
        found[target] = min(equal, key=key, default=None)
    return found


def general(problems, error, targets):
    """The method that costs least over all problems and targets, and how many times the quickest it costs.

    `problems`: the rows of each problem. The cost of a method is the geometric mean over problems and targets of its
    quickest seconds over those of the quickest method of all; a method that misses a target which another reaches is
    out. Returns pairs of a method and its cost, cheapest first.
    """
    logs, out = {}, set()
    methods = {row["method"] for rows in problems for row in rows}
    for rows in problems:
        of_all = advice(rows, error(rows), targets)
        for target in (t for t in targets if of_all[t]):
            for method in methods:
                own = advice([row for row in rows if row["method"] == method], error(rows), [target])[target]
                if own is None:
                    out.add(method)
                    continue
                logs.setdefault(method, []).append(math.log(own["s_total"] / of_all[target]["s_total"]))
    costs = {method: math.exp(sum(v) / len(v)) for method, v in logs.items() if method not in out}
    return sorted(costs.items(), key=lambda pair: pair[1])


def rate(rows, error):
    """log2 of the error's ratio between the last two meshes, each half as wide as the one before; None without them."""
    good = sorted((row for row in rows if usable(row, error)), key=lambda row: row["n"])
    if len(good) < 2 or good[-1]["n"] != 2 * good[-2]["n"]:
        return None
    return math.log2(good[-2][error] / good[-1][error])
