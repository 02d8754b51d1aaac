#!/usr/bin/python3
"""Solves every case of cases.toml by mortise and by FreeFEM on the same mesh, and compares the two.

The report is written to OUTPUT: crosscheck.md, report.json, pictures, and a folder a case with difference.vtu.
Exit status: 0 all cases ran and hold; 1 one does not, or nothing could run; 77 with --test if FreeFEM is not there.
MORTISE names another executable than build/release/mortise.
"""

import argparse
import sys
import time
from pathlib import Path

import run
from cases import StudyError, all_cases, choose
from judge import judge

SKIPPED = 77
SHORT = {"displacement": "u", "pressure": "p", "pressure_inside": "p inside", "energy": "energy", "active": "active"}


def read_options(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="only the cases marked quick")
    parser.add_argument("--case", action="append", default=[], metavar="GLOB", help="only the cases of this name")
    parser.add_argument("--list", action="store_true", help="print the names of the cases and end")
    parser.add_argument("-o", "--output", type=Path, default=Path("out/crosscheck"), help="default: out/crosscheck")
    parser.add_argument("--test", action="store_true", help="no report; exit status 77 if FreeFEM is missing")
    return parser.parse_args(arguments)


def figure_text(figure, with_limit):
    """A figure, and its limit where it is not the same for all; an inequality that does not hold says NOT."""
    name = SHORT[figure.name.removeprefix("rate of ")]
    text = f"rate of {name} {figure.value:.2f}" if figure.is_rate else f"{name} {figure.value:.1e}"
    relation = f"{'>=' if figure.is_rate else '<='} {figure.limit:g}"
    return text + (f" {'' if figure.ok else 'NOT '}{relation}" if with_limit else "")


def one_line(result):
    """Figures of a result against their limits, in a line."""
    if result.status == "error":
        return result.message.splitlines()[0]
    if result.level == "timing":
        return "mortise {mortise:.2f} s, FreeFEM {freefem:.2f} s, ratio {ratio:.1f}".format(**result.timing)
    limits = {figure.limit for figure in result.figures}
    short = len(limits) == 1 and result.status == "ok"
    words = [figure_text(figure, with_limit=not short) for figure in result.figures]
    return ", ".join(words) + (f"; limit {min(limits):g}" if short else "")


def run_cases(cases, output):
    """Runs all cases and shows each as it ends."""
    for number, case in enumerate(cases, 1):
        result = judge(case, output)
        status = {"ok": "ok    ", "failed": "FAILED", "error": "ERROR "}[result.status]
        counter = f"[{number:3}/{len(cases)}]"
        print(f"{counter} {status} {result.name}: {one_line(result)} ({result.seconds:.1f} s)", flush=True)
        for line in result.message.splitlines()[1:]:
            print(f"          {line}", flush=True)
        yield result


def main(arguments=None):
    options = read_options(arguments)
    try:
        cases = choose(all_cases(), options.case, options.quick)
        if options.list:
            print("\n".join(case.name for case in cases))
            return 0
        if options.test and run.find_freefem() is None:
            print("skipped: FreeFem++ is not on the PATH")
            return SKIPPED
        run.need_programs()
    except StudyError as error:
        print(f"crosscheck: error: {error}", file=sys.stderr)
        return 1
    start, output = time.perf_counter(), options.output.absolute()
    output.mkdir(parents=True, exist_ok=True)
    results = list(run_cases(cases, output))
    seconds = time.perf_counter() - start
    if not options.test:
        import results_page  # which draws: matplotlib takes as long to start as some cases to run

        results_page.write(results, output, seconds)
    bad = [result for result in results if result.status != "ok"]
    print(f"{len(results) - len(bad)} of {len(results)} cases hold, {seconds:.0f} s; {options.output}")
    print(*(f"{result.status}: {result.name}" for result in bad), sep="\n")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
