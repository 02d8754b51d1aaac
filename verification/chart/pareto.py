"""Which runs are worth their seconds: the Pareto front, the advice for an error asked for, rates."""

import math

AS_GOOD = 1.15  # seconds within this factor of the quickest count as equal: timings vary by so much


def usable(row, error):
    """Whether a run is an answer, and its error is known."""
    return row["status"] != "not_converged" and (row.get(error) or 0) > 0


def front(rows, error):
    """The rows that no other beats in both seconds and error, by seconds. A tie in both keeps the first."""
    best, chosen = math.inf, []
    for row in sorted((r for r in rows if usable(r, error)), key=lambda r: (r["s_total"], r[error])):
        if row[error] < best:
            best = row[error]
            chosen.append(row)
    return chosen


def by_method(rows, error):
    """The usable rows of each method, from the coarsest mesh to the finest."""
    found = {}
    for row in sorted((r for r in rows if usable(r, error)), key=lambda r: r["n"]):
        found.setdefault(row["method"], []).append(row)
    return found


def first_good(series, error, target):
    """Place of the coarsest mesh from which on all meshes of a method have errors of at most the target, or None."""
    place = len(series)
    while place > 0 and series[place - 1][error] <= target:
        place -= 1
    return place if place < len(series) else None


def advice(rows, error, targets, prefer=()):
    """For each target the quickest row whose error is at most that, as are those of all finer meshes of its method.

    None where there is no such row. Where others are as good as equally quick, the one whose method stands first in
    `prefer`.
    """
    rank = {method: place for place, method in enumerate(prefer)}
    found = {}
    for target in targets:
        places = [(series, first_good(series, error, target)) for series in by_method(rows, error).values()]
        good = [series[place] for series, place in places if place is not None]
        least = min((row["s_total"] for row in good), default=0)
        equal = [row for row in good if row["s_total"] <= AS_GOOD * least] if prefer else good
        key = lambda row: (rank.get(row["method"], len(rank)), row["s_total"])
        found[target] = min(equal, key=key, default=None)
    return found


def seconds_at(series, error, target):
    """Seconds of a method for an error, between two meshes by a power law; those of the coarsest mesh if that is good
    enough already; None if the finest is not."""
    place = first_good(series, error, target)
    if place is None or place == 0:
        return None if place is None else series[0]["s_total"]
    coarse, fine = series[place - 1], series[place]
    part = math.log(coarse[error] / target) / math.log(coarse[error] / fine[error])
    return coarse["s_total"] * (fine["s_total"] / coarse["s_total"]) ** part


def general(problems, error, targets, least=0.0):
    """The methods by what they cost over all problems and targets: pairs of a method and its cost, cheapest first.

    `problems`: the rows of each problem; `error`: of rows, the error that counts. Only methods that all problems have
    take part. The cost is the geometric mean over problems and targets of the method's seconds (seconds_at) over the
    least of all methods; seconds below `least` count as that. A method that misses a target which another reaches is
    out, a target that none reaches does not count.
    """
    common = set.intersection(*({row["method"] for row in rows} for rows in problems)) if problems else set()
    tables = []
    for rows in problems:
        series = by_method([row for row in rows if row["method"] in common], error(rows))
        for target in targets:
            seconds = {method: seconds_at(mine, error(rows), target) for method, mine in series.items()}
            tables.append({method: max(value, least) for method, value in seconds.items() if value})
    tables = [table for table in tables if table]
    methods = set.intersection(*map(set, tables)) if tables else set()
    logs = {m: [math.log(table[m] / min(table.values())) for table in tables] for m in methods}
    costs = {method: math.exp(sum(values) / len(values)) for method, values in logs.items()}
    return sorted(costs.items(), key=lambda pair: pair[1])


def rate(rows, error):
    """log2 of the error's ratio between the last two meshes, each half as wide as the one before; None without them."""
    good = sorted((row for row in rows if usable(row, error)), key=lambda row: row["n"])
    if len(good) < 2 or good[-1]["n"] != 2 * good[-2]["n"]:
        return None
    return math.log2(good[-2][error] / good[-1][error])
