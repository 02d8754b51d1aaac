#!/usr/bin/python3
"""Speed and memory of the mortar solve of parabola 1: its stages, and the whole against its limit, one Cholesky solve of
the same stiffness by CHOLMOD (mortise_cholmod: analysis by AMD, supernodal factorisation, solution); and of walls of bricks.

Seconds are by the clock, of the whole without meshing and writing, medians of runs in turns; range is that of the single
pairs' ratios. MB is the peak of the process, of CHOLMOD's beside what it started with.
"""

import argparse
import statistics
import tempfile
from pathlib import Path

from chart_methods import size_settings  # makes common/ known

import launch
import programs

CHOLMOD = launch.MORTISE.parent / "verification/chart/mortise_cholmod"
STAGES = ("assemble", "couple", "factorise", "solve", "recover")


def limit(settings):
    """Unknowns, seconds and MB of CHOLMOD."""
    words = [f"{key}={value}" for key, value in settings.items()]
    done, _ = launch.run([launch.need(CHOLMOD), launch.scene_file("parabola_1"), *words], expected=(0,))
    return map(float, done.stdout.split())


def solved(scene, settings, threads, *words):
    """Summary, seconds and MB of one run."""
    with tempfile.TemporaryDirectory() as folder:
        words = [*launch.options(settings), "-o", folder, "--quiet", *(["--threads", threads] if threads else []), *words]
        found = programs.measured([launch.need(launch.MORTISE), "solve", launch.scene_file(scene), *words], own_threads=True)
        summary = launch.summary(folder)
    own = summary["seconds"]
    return summary, own["total"] - own["mesh"] - own["write"], found["megabytes"]


def against_limit(n_upper, repeats, threads):
    settings = size_settings("parabola_1", (n_upper, n_upper * 5 // 4))
    pairs = [(*limit(settings), *solved("parabola_1", settings, threads, "--no-estimate")) for _ in range(repeats)]
    unknowns, limits, limit_mb, summaries, wholes, mb = zip(*pairs)
    ratios = [whole / least for whole, least in zip(wholes, limits)]
    least, whole, most_mb, least_mb = map(statistics.median, (limits, wholes, mb, limit_mb))
    stages = [statistics.median(summary["seconds"][stage] for summary in summaries) for stage in STAGES]
    return [f"{n_upper}x{n_upper * 5 // 4}", int(unknowns[0]), least, whole, whole / least, f"{min(ratios):.2f}..{max(ratios):.2f}",
            least_mb, most_mb, *stages]  # fmt: skip


def wall(bricks, threads):
    settings = {"mesh.parameters.bricks": bricks, "mesh.parameters.courses": bricks}
    summary, _, megabytes = solved("wall", settings, threads)
    stages = [summary["seconds"][stage] for stage in (*STAGES, "estimate")]
    return [f"{bricks}x{bricks}", len(summary["contact"]), summary["mesh"]["multipliers"], summary["mesh"]["dofs"], *stages, megabytes]


def show(heading, rows):
    print(*(f"{name:>10}" for name in heading))
    for row in rows:
        print(*(f"{value:10.4g}" if isinstance(value, float) else f"{value:>10}" for value in row), flush=True)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, default, words in (
        ("up-to", 320, "largest mesh: elements along the upper contact curve, 40 to 640"),
        ("threads", 0, "of the factorisation (default: as mortise chooses)"),
        ("repeats", 5, "runs of each that the table takes medians of"),
        ("walls", 20, "largest wall: bricks in a course, as many courses (0: none)"),
    ):
        parser.add_argument(f"--{name}", type=int, default=default, help=words)
    options = parser.parse_args(arguments)
    sizes = [n for n in (40, 80, 160, 320, 640) if n <= options.up_to]
    show(["mesh", "unknowns", "limit s", "whole s", "ratio", "range", "limit MB", "whole MB", *STAGES],
         (against_limit(n, options.repeats, options.threads) for n in sizes))  # fmt: skip
    show(["\nbricks", "pairs", "rows", "unknowns", *STAGES, "estimate", "MB"],
         (wall(n, options.threads) for n in (5, 10, 20, 40) if n <= options.walls))  # fmt: skip


if __name__ == "__main__":
    main()
