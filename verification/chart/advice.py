"""What the chart comes to in words: which method and mesh for 5 %, 1 % and 0.1 % in p, and one for everything."""

from pathlib import Path

import chart_runs  # makes common/ known
import pareto
import template
from chart_methods import METHODS, PANELS, PEERS, PROBLEMS, label
from template import percent

TEXTS = template.texts(Path(__file__).with_name("chart_texts.md"))
TARGETS = (0.05, 0.01, 0.001)
LEAST_SECONDS = 0.01  # less than the program takes to start
HEADING = ("problem", "error in p at most", "method", "mesh", "error reached", "seconds", "unknowns", "its checks")
CHECKS = {"solved": "hold", "check_failed": "one fails"}


def say(name, **values):
    return template.fill(TEXTS[name], **values).replace("\n", " ")


def of_problem(rows, problem, *methods):
    return [row for row in rows if row["problem"] == problem and (not methods or row["method"] in methods)]


def by_mortise(rows, problem):
    """On meshes that are given: what is compared by the seconds without meshing."""
    given = lambda row: row["method"] != "asked" and row["method"] not in PEERS
    return [row for row in of_problem(rows, problem) if given(row)]


def table(rows):
    """A row of HEADING for each problem and target."""
    for problem, (error, *_) in PANELS.items():
        for target, row in pareto.advice(by_mortise(rows, problem), error, TARGETS, list(METHODS)).items():
            cells = ["no mesh of the chart reaches it", *[""] * 5]
            if row is not None:
                cells = [label(row["method"]), row["mesh"], percent(row[error]), f"{row['s_total']:.2g}"]
                cells += [str(row["dofs"]), CHECKS[row["status"]]]
            yield [problem, percent(target), *cells]


def ordered(costs):
    """Cheapest first; of those as good as equal to the cheapest the one that stands first in METHODS leads."""
    places = list(METHODS)
    equal = [pair for pair in costs if pair[1] <= pareto.AS_GOOD * costs[0][1]]
    first = min(equal, key=lambda pair: places.index(pair[0]), default=None)
    return [first, *(pair for pair in costs if pair is not first)] if costs else []


def for_everything(problems, error, words):
    """The method that costs least over all problems and targets in an error, and the others."""
    order = ordered(pareto.general(problems, error, TARGETS, LEAST_SECONDS))
    if not order:
        return say("no method", words=words)
    others = "; ".join(f"{label(method)} {value:.2g}" for method, value in order[1:])
    return say("for everything", words=words, best=label(order[0][0]), cost=order[0][1], others=others or None)


def cut_or_not(rows):
    """What leaving out the cutting costs: where the errors of p end."""
    ends = []
    for problem, (error, *_) in PANELS.items():
        last = [percent(row[error]) for row in of_problem(rows, problem, "q8_elements")[-2:]]
        ends += [say("ends", before=last[0], last=last[1], problem=problem)] if len(last) > 1 else []
    return say("cut or not", ends="; ".join(ends))


def graded_or_even(rows):
    """What a mesh that shrinks towards the ends saves on parabola_1, for the smallest target."""
    error = PANELS["parabola_1"][0]
    series = pareto.by_method(by_mortise(rows, "parabola_1"), error)
    seconds = {method: pareto.seconds_at(mine, error, TARGETS[-1]) for method, mine in series.items()}
    graded, even = seconds.pop("q8_graded", None), {method: value for method, value in seconds.items() if value}
    if not graded or not even:
        return say("graded untold")
    best, least = ordered(sorted(even.items(), key=lambda pair: pair[1]))[0]
    texts = {"graded": f"{graded:.2g}", "even": f"{least:.2g}"}
    return say("graded", error=percent(TARGETS[-1]), method=label(best), **texts)


def asked(rows):
    """What asking for an accuracy got on parabola_1, and took."""
    error, found = PANELS["parabola_1"][0], []
    for target in TARGETS:
        name = f"{100 * target:g} % asked"
        found += [row for row in of_problem(rows, "parabola_1", "asked") if row["mesh"] == name]
    cells = [say("asked one", asked=row["mesh"].removesuffix(" asked"), got=percent(row[error]) if row[error] else "less "
                 "than the reference tells", seconds=f"{row['s_total']:.2g}", unknowns=row["dofs"]) for row in found]
    return say("asked", answers="; ".join(cells))


def recommendation(rows):
    """Sentences: the method that costs least over all problems and targets, and what else the chart says."""
    problems = [by_mortise(rows, problem) for problem in PROBLEMS if of_problem(rows, problem)]
    yield say("weights", least=LEAST_SECONDS)
    yield for_everything(problems, lambda rows: PANELS[rows[0]["problem"]][0], "For p")
    stresses = "For the stresses in the bodies (the same errors in the energy norm)"
    yield for_everything(problems, lambda rows: "e_energy", stresses)
    for method, sentence in (("q8_elements", cut_or_not), ("q8_graded", graded_or_even), ("asked", asked)):
        if any(row["method"] == method for row in rows):
            yield sentence(rows)


def rates(rows):
    """Rates of the last halving of each method: problem, method, a rate for each error."""
    for problem, errors in PANELS.items():
        for method in dict.fromkeys(row["method"] for row in of_problem(rows, problem) if row["method"] != "asked"):
            found = [pareto.rate(of_problem(rows, problem, method), error) for error in errors]
            yield [problem, label(method), *("" if value is None else f"{value:.2f}" for value in found)]
