"""One case: run both programs, compare, and hold the figures against the limits of the table."""

import math
import shutil
import statistics
import time
from dataclasses import asdict, dataclass, field

import compare  # makes common/ known
import launch
import run
from launch import StudyError


@dataclass
class Figure:
    """One number of a case and what it must not pass: a largest difference, or a smallest rate."""

    name: str
    value: float
    limit: float
    is_rate: bool = False

    @property
    def ok(self):
        return bool(self.value >= self.limit) if self.is_rate else bool(self.value <= self.limit)


@dataclass
class Result:
    """A row of the report. status: ok; failed: a figure passes its limit; error: the case did not run to its end."""

    name: str
    level: str
    scene: str
    side: str
    folder: str  # of the last step, below the report's folder
    status: str = "ok"
    message: str = ""
    figures: list = field(default_factory=list)
    steps: list = field(default_factory=list)  # a table for each mesh: its name, differences, mortise's status
    timing: dict = field(default_factory=dict)
    seconds: float = 0.0

    def as_table(self):
        return {**asdict(self), "figures": [{**asdict(figure), "ok": figure.ok} for figure in self.figures]}


def rates(values):
    """log2 of successive ratios: 2 means that halving the elements divides the difference by 4."""
    return [math.log2(a / b) if a > 0 and b > 0 else math.nan for a, b in zip(values, values[1:])]


def mean_rate(values):
    """From the first to the last of the values, a halving."""
    found = rates(values)
    return sum(found) / len(found) if found else math.nan


def figures_of(case, steps):
    """The last step's differences against the limits, and the rates of the series against the least rates."""
    series = {name: [step["differences"][name] for step in steps] for name in case.limits | case.least_rates}
    figures = [Figure(name, series[name][-1], limit) for name, limit in case.limits.items()]
    rate = lambda name, least: Figure(f"rate of {name}", mean_rate(series[name]), least, is_rate=True)
    return figures + [rate(name, least) for name, least in case.least_rates.items()]


def run_step(case, step, folder):
    """One mesh of a case; leaves difference.vtu and pressure.csv in its folder."""
    solved = run.solve_step(step, folder)
    comparison = compare.compare(solved, step)
    compare.write_difference(comparison, folder / "difference.vtu")
    compare.write_pressures(comparison.curve, folder / "pressure.csv")
    mean, largest = compare.mean_differences, compare.largest_differences
    return {
        "mesh": launch.mesh_name(step.mesh),
        "differences": mean(comparison, case.kinks) if case.level == "same_problem" else largest(comparison),
        "mortise_status": solved.status,
        "mortise_seconds": solved.mortise_seconds,
        "freefem_seconds": solved.freefem_seconds,
    }


def measure(case, folder):
    """Both programs in turns; medians of the whole processes and of the solutions alone, and their ratios."""
    samples = []
    for _ in range(case.repeats):
        solved = run.solve_step(case.steps[0], folder)
        seconds, theirs = run.mortise_summary(folder)["seconds"], run.freefem_summary(folder)
        alone = seconds["factorise"] + seconds["solve"], theirs["seconds_solve"]
        samples.append((solved.mortise_seconds, solved.freefem_seconds, *alone))
    mortise, freefem, mortise_solve, freefem_solve = map(statistics.median, zip(*samples))
    sizes = {"mesh": launch.mesh_name(case.steps[0].mesh), **{key: theirs[key] for key in ("unknowns", "multipliers")}}
    return {**sizes, "repeats": case.repeats, "mortise": mortise, "freefem": freefem, "mortise_solve": mortise_solve,
            "freefem_solve": freefem_solve, "ratio": freefem / mortise, "ratio_solve": freefem_solve / mortise_solve}


def folder_of(case, step):
    """Below the report's folder. A series has a folder for each mesh."""
    return case.name if len(case.steps) == 1 else f"{case.name}/{launch.mesh_name(step.mesh)}"


def judge(case, output):
    """Runs a case into its folder below `output`. Never raises because of the case itself."""
    result = Result(case.name, case.level, case.scene, case.side, folder_of(case, case.steps[-1]))
    start = time.perf_counter()
    shutil.rmtree(output / case.name, ignore_errors=True)
    try:
        if case.level == "timing":
            result.timing = measure(case, output / result.folder)
        else:
            for step in case.steps:
                result.steps.append(run_step(case, step, output / folder_of(case, step)))
            result.figures = figures_of(case, result.steps)
            result.status = "ok" if all(figure.ok for figure in result.figures) else "failed"
    except (StudyError, OSError, KeyError, ValueError) as error:
        told = isinstance(error, (StudyError, OSError))
        result.status, result.message = "error", str(error) if told else f"{type(error).__name__}: {error}"
    result.seconds = time.perf_counter() - start
    return result
