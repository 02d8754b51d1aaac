"""What the chart comes to in words: which method and mesh for 5 %, 1 % and 0.1 % in p, and one for everything."""

import pareto
from chart_methods import METHODS, PROBLEMS, label
from chart_pictures import PANELS

TARGETS = (0.05, 0.01, 0.001)
LEAST_SECONDS = 0.01  # less than the program takes to start
HEADING = ("problem", "error in p at most", "method", "mesh", "error reached", "seconds", "unknowns", "its checks")
CHECKS = {"solved": "hold", "check_failed": "one fails"}


def by_mortise(rows):
    return [row for row in rows if not row["method"].startswith("freefem")]


def of_problem(rows, problem):
    return [row for row in rows if row["problem"] == problem]


def percent(value):
    return f"{value * 100:.2g} %"


def digits(seconds):
    return f"{seconds:.2g}"


def error_of(rows):
    """The error that the advice for a problem goes by."""
    return PANELS[rows[0]["problem"]][0]


def table(rows):
    """A row of HEADING for each problem and target."""
    for problem in PROBLEMS:
        mine = by_mortise(of_problem(rows, problem))
        for target, row in pareto.advice(mine, PANELS[problem][0], TARGETS, list(METHODS)).items():
            if row is None:
                yield [problem, percent(target), "no mesh of the chart reaches it", *[""] * 5]
                continue
            reached, seconds = row[PANELS[problem][0]], row["s_total"]
            yield [
                *(problem, percent(target), label(row["method"]), row["mesh"]),
                *(percent(reached), digits(seconds), str(row["dofs"]), CHECKS[row["status"]]),
            ]


def ordered(costs):
    """Cheapest first; of those as good as equal to the cheapest the one that stands first in METHODS leads."""
    if not costs:
        return []
    places = list(METHODS)
    equal = [pair for pair in costs if pair[1] <= pareto.AS_GOOD * costs[0][1]]
    first = min(equal, key=lambda pair: places.index(pair[0]))
    return [first, *(pair for pair in costs if pair is not first)]


def for_everything(problems, error, words):
    """One sentence: the method that costs least over all problems and targets in an error, and the others."""
    order = ordered(pareto.general(problems, error, TARGETS, LEAST_SECONDS))
    if not order:
        return f"{words}: no method reaches every error that another one reaches; take it by problem."
    others = "; ".join(f"{label(method)} {value:.2g}" for method, value in order[1:])
    best, cost = order[0]
    return f"{words}: {label(best)}, {cost:.2g} times the least. The others: {others or 'none'}."


def cut_or_not(rows):
    """What leaving out the cutting costs: where the errors of p end."""
    ends = []
    for problem in PROBLEMS:
        mine = [row for row in of_problem(rows, problem) if row["method"] == "q8_elements"]
        if len(mine) > 1:
            error = error_of(mine)
            before, last = (percent(row[error]) for row in mine[-2:])
            ends.append(f"{before}, then {last} on the two finest meshes of {problem}")
    return "Without cutting (integration = elements) p does not converge: its error ends at " + "; ".join(ends) + "."


def graded_or_even(rows):
    """What a mesh that shrinks towards the ends saves on parabola_1, for the smallest target."""
    mine = by_mortise(of_problem(rows, "parabola_1"))
    series = pareto.by_method(mine, PANELS["parabola_1"][0])
    graded = pareto.seconds_at(series.pop("q8_graded", []), PANELS["parabola_1"][0], TARGETS[-1])
    even = {m: pareto.seconds_at(s, PANELS["parabola_1"][0], TARGETS[-1]) for m, s in series.items()}
    even = {method: seconds for method, seconds in even.items() if seconds}
    if not graded or not even:
        return "Where the stress is singular (parabola_1), a mesh that shrinks towards the ends converges faster."
    best, _ = ordered(sorted(even.items(), key=lambda pair: pair[1]))[0]
    return (
        f"Where the stress is singular (parabola_1), let the mesh shrink towards the ends: {percent(TARGETS[-1])} in p "
        f"takes {digits(graded)} s so, and {digits(even[best])} s at best on even meshes ({label(best)}); finer meshes "
        "gain more still."
    )


def recommendation(rows):
    """Sentences: the method that costs least over all problems and targets, and what else the chart says."""
    problems = [by_mortise(of_problem(rows, problem)) for problem in PROBLEMS if of_problem(rows, problem)]
    yield (
        "One method for everything, by the geometric mean over the problems and errors above of the seconds over those "
        f"of the quickest method (seconds below {LEAST_SECONDS} count as that, between two meshes they follow a power "
        "law; a method that misses an error which another one reaches is left out)."
    )
    yield for_everything(problems, error_of, "For p")
    stresses = "For the stresses in the bodies (the same errors in the energy norm)"
    yield for_everything(problems, lambda rows: "e_energy", stresses)
    if any(row["method"] == "q8_elements" for row in rows):
        yield cut_or_not(rows)
    if any(row["method"] == "q8_graded" for row in rows):
        yield graded_or_even(rows)


def rates(rows):
    """Rates of the last halving of each method: problem, method, a rate for each error."""
    for problem in PROBLEMS:
        for method in dict.fromkeys(row["method"] for row in of_problem(rows, problem)):
            mine = [row for row in of_problem(rows, problem) if row["method"] == method]
            found = [pareto.rate(mine, error) for error in PANELS[problem]]
            yield [problem, label(method), *("" if value is None else f"{value:.2f}" for value in found)]
