"""What the chart comes to in words: which method and mesh for 5 %, 1 % and 0.1 % in p, and one for everything."""

import pareto
from chart_methods import METHODS, PROBLEMS, label
from chart_pictures import PANELS

TARGETS = (0.05, 0.01, 0.001)
HEADING = ("problem", "error in p at most", "method", "mesh", "error reached", "seconds", "unknowns")


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
                yield [problem, percent(target), "no mesh of the chart reaches it", "", "", "", ""]
                continue
            reached, seconds = row[PANELS[problem][0]], row["s_total"]
            yield [
                *(problem, percent(target), label(row["method"]), row["mesh"]),
                *(percent(reached), digits(seconds), str(row["dofs"])),
            ]


def recommendation(rows):
    """Sentences: the method that costs least over all problems and targets, and what follows it."""
    problems = [by_mortise(of_problem(rows, problem)) for problem in PROBLEMS if of_problem(rows, problem)]
    order = pareto.general(problems, error_of, TARGETS)
    if not order:
        return ["No method reaches every error that another one reaches: take the table's, by problem."]
    best, cost = order[0]
    sentences = [
        f"One method for everything: {label(best)}. Over the problems and errors of the table it takes {cost:.2g} "
        "times the seconds of the quickest method for each (geometric mean; a method that misses an error which "
        "another one reaches does not count)."
    ]
    if len(order) > 1:
        others = "; ".join(f"{label(method)} {value:.2g}" for method, value in order[1:])
        sentences.append(f"The others: {others}.")
    return sentences


def rates(rows):
    """Rates of the last halving of each method: problem, method, a rate for each error."""
    for problem in PROBLEMS:
        for method in dict.fromkeys(row["method"] for row in of_problem(rows, problem)):
            mine = [row for row in of_problem(rows, problem) if row["method"] == method]
            found = [pareto.rate(mine, error) for error in PANELS[problem]]
            yield [problem, label(method), *("" if value is None else f"{value:.2f}" for value in found)]
