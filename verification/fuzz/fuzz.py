"""./dev fuzz [N] [SEED]: mortise on N random inputs, right and broken ones, and what must hold after each of them.

A finding is stored in out/fuzz/SEED_NUMBER with the files and the line to repeat it; `fuzz.py 1 SEED:NUMBER` makes the
same case again. Exit status 1 if anything was found.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import findings
import oracles
import one_call
import twin_oracle
from make_case import SHARES, make_case

ROOT = Path(__file__).resolve().parents[2]


def arguments(words=None):
    parser = argparse.ArgumentParser(prog="./dev fuzz", description=__doc__.split("\n\n")[0])
    parser.add_argument("count", nargs="?", type=int, default=300, metavar="N", help="number of cases (300)")
    parser.add_argument("seed", nargs="?", default="1", metavar="SEED", help="SEED, or SEED:NUMBER to begin with (1)")
    parser.add_argument("--jobs", type=int, default=2, help="calls of mortise at once (2)")
    parser.add_argument("--kind", action="append", choices=list(SHARES), help="only this kind of case; may be repeated")
    parser.add_argument("--time-limit", type=float, metavar="SECONDS", help="for one call (20; 100 with --sanitize)")
    parser.add_argument("--sanitize", action="store_true", help="the program is built with the address sanitizer")
    parser.add_argument("--out", type=Path, default=ROOT / "out/fuzz", help="folder of the findings (out/fuzz)")
    parser.add_argument("--mortise", default=os.environ.get("MORTISE", str(ROOT / "build/release/mortise")))
    return parser.parse_args(words)


def options_of(program):
    """What its --help lists: a newer option is used where it is there."""
    done = subprocess.run([program, "solve", "--help"], capture_output=True, text=True, timeout=600, check=False)
    return done.stdout


def examine(program, case, keep=None):
    """Runs a case and its twins in folders of their own: the outcome, and [(oracle, what is wrong)]."""
    with tempfile.TemporaryDirectory(prefix="mortise_fuzz_") as base:
        folder = os.path.join(base, "case")
        os.mkdir(folder)
        case.write(folder)
        outcome = one_call.call(program, case, folder)
        found = oracles.judge(case, outcome, folder)
        for k, twin in enumerate(case.twins if not found else ()):
            other = os.path.join(base, f"twin_{k}")
            os.mkdir(other)
            twin.case.write(other)
            second = one_call.call(program, twin.case, other)
            found += oracles.judge(twin.case, second, other)
            if not found:
                wrong = twin_oracle.compare(case.setting, twin, outcome, second, folder, other)
                found += [("twin", wrong)] if wrong else []
        return outcome, found


def fuzz(program, count, seed, first=0, jobs=2, kinds=tuple(SHARES), out=None, show=print):
    """Runs the cases; [(number, case, outcome, findings)] of all, in their order."""
    options, start, done = options_of(program.path), time.monotonic(), []

    def one(number):
        case = make_case(seed, number, options, kinds)
        outcome, found = examine(program, case)
        if found and out is not None:
            findings.store(out / f"{seed}_{number}", f"{seed}:{number}", program, case, outcome, found)
        return number, case, outcome, found

    with ThreadPoolExecutor(jobs) as pool:
        for result in pool.map(one, range(first, first + count)):
            done.append(result)
            if result[3]:
                show(f"{seed}:{result[0]}  {result[1].kind}: {result[3][0][0]}: {result[3][0][1][:150]}")
            if len(done) % 100 == 0:
                show(f"{len(done)} of {count} cases, {time.monotonic() - start:.0f} s")
    return done


def main():
    chosen = arguments()
    seed, _, first = chosen.seed.partition(":")
    limit = chosen.time_limit or (100 if chosen.sanitize else 20)
    program = one_call.Program(str(Path(chosen.mortise).absolute()), limit, chosen.sanitize)
    if not os.access(program.path, os.X_OK):
        sys.exit(f"fuzz: {program.path} cannot be run: ./dev build makes it, or MORTISE names another")
    shutil.rmtree(chosen.out, ignore_errors=True)
    kinds = tuple(chosen.kind or SHARES)
    done = fuzz(program, chosen.count, seed, int(first or 0), chosen.jobs, kinds, chosen.out,
                lambda line: print(line, flush=True))
    print(findings.table(done))
    failed = sum(bool(result[3]) for result in done)
    print(f"{failed} of {len(done)} cases failed" + (f": {chosen.out}" if failed else ""))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
