"""./dev fuzz [N] [SEED]: mortise on N random inputs, right and broken ones, and what must hold after each of them.

A finding is stored in out/fuzz/SEED_NUMBER with the files and the line to repeat it; `./dev fuzz 1 SEED:NUMBER` makes
the same case again. Exit status 1 if anything was found.
"""

import argparse
import os
import shlex
import shutil
import sys
import tempfile
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import launch
import one_call
import oracles
import references
import template
from make_case import HELD, MAKERS, make_case


def arguments():
    parser = argparse.ArgumentParser(prog="./dev fuzz", description=__doc__.split("\n\n")[0])
    parser.add_argument("count", nargs="?", type=int, default=300, metavar="N", help="number of cases (300)")
    parser.add_argument("seed", nargs="?", default="1", metavar="SEED", help="SEED, or SEED:NUMBER to begin with (1)")
    parser.add_argument("--jobs", type=int, default=2, help="calls of mortise at once (2)")
    parser.add_argument("--kind", action="append", choices=[*MAKERS, *HELD], help="only this kind of case; may be repeated")
    parser.add_argument("--sanitize", action="store_true", help="the program is built with the address sanitizer")
    parser.add_argument("--out", type=Path, default=launch.ROOT / "out/fuzz", help="folder of the findings (out/fuzz)")
    return parser.parse_args()


def examine(program, case, known=None):
    """Runs a case and its twins in folders of their own, and holds it against its reference, of those that are `known`:
    the outcome, and [(oracle, what is wrong)]."""
    with tempfile.TemporaryDirectory(prefix="mortise_fuzz_") as base:

        def run(one, name):
            folder = os.path.join(base, name)
            os.mkdir(folder)
            one.write(folder)
            outcome = one_call.call(program, one, folder)
            return folder, outcome, oracles.judge(one, outcome, folder)

        folder, outcome, found = run(case, "case")
        for k, twin in enumerate(case.twins if not found else ()):
            other, second, wrong = run(twin.case, f"twin_{k}")
            found += wrong
            if not found:
                differs = oracles.compare(case.setting, twin, outcome, second, folder, other)
                found += [("twin", differs)] if differs else []
        if case.judge and not found:
            outcome.worth, wrong = case.judge(case, outcome, folder, known)
            found += [(outcome.worth, wrong)] if wrong else []
        return outcome, found


def fuzz(program, count, seed, first=0, jobs=2, kinds=tuple(MAKERS), out=None, show=print):
    """Runs the cases; [(number, case, outcome, findings)] of all, in their order."""
    start, done, known = time.monotonic(), [], references.References(program)

    def one(number):
        case = make_case(seed, number, kinds)
        outcome, found = examine(program, case, known)
        if found and out is not None:
            store(out / f"{seed}_{number}", f"{seed}:{number}", program, case, outcome, found)
        return number, case, outcome, found

    with ThreadPoolExecutor(jobs) as pool:
        for result in pool.map(one, range(first, first + count)):
            done.append(result)
            if result[3]:
                show(f"{seed}:{result[0]}  {result[1].kind}: {result[3][0][0]}: {result[3][0][1][:150]}")
            if len(done) % 100 == 0:
                show(f"{len(done)} of {count} cases, {time.monotonic() - start:.0f} s")
    return done


# ---- Findings as folders that can be run again, and the table at the end ----


def shell_word(word):
    """A word for bash that survives line breaks, control characters and bytes that are no UTF-8."""
    if word.isprintable() and "\udc80" not in word:
        return shlex.quote(word)
    data = word.encode("utf-8", "surrogateescape")
    return "$'" + "".join(chr(b) if 32 <= b < 127 and chr(b) not in "'\\" else f"\\x{b:02x}" for b in data) + "'"


def printable(text):
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)


def script(program, case):
    lines, limit = ["#!/usr/bin/env bash", f"# {case.kind}: {printable(case.what)}", 'cd "$(dirname "$0")/files"'], []
    if case.largest_file is not None:
        lines.append(f"trap '' XFSZ; # files of at most {case.largest_file} bytes: needs prlimit")
        limit = ["prlimit", f"--fsize={case.largest_file}"]
    words = " ".join([*limit, '"${MORTISE:-' + program.path + '}"', *map(shell_word, case.words)])
    return "\n".join([*lines, words, 'echo "exit status $?"']) + "\n"


def store(folder, name, program, case, outcome, found):
    """Writes the files as they were, a script that repeats the call, and what was wrong."""
    twins = {folder / f"twin_{k}": twin.case for k, twin in enumerate(case.twins)}
    for where, one in ({folder: case} | twins).items():
        (where / "files").mkdir(parents=True, exist_ok=True)
        one.write(where / "files")
        (where / "repeat.sh").write_text(script(program, one), errors="surrogateescape")
        (where / "repeat.sh").chmod(0o755)
    lines = [f"{name}  {case.kind}: {printable(case.what)}", f"./dev fuzz 1 {name} --kind '{case.kind}'"]
    lines += [f"exit status {outcome.status} after {outcome.seconds:.1f} s"]
    lines += [f"{oracle}: {printable(wrong)}" for oracle, wrong in found]
    (folder / "finding.txt").write_text("\n".join([*lines, "standard error:", outcome.said[:5000]]),
                                        errors="surrogateescape")  # fmt: skip


def table(done):
    """A row a kind of case: how the calls ended, and which oracles objected."""
    rows = []
    for kind in sorted({case.kind for _, case, _, _ in done}):
        mine = [(outcome, found) for _, case, outcome, found in done if case.kind == kind]
        ended = Counter(outcome.status if outcome.status in (0, 1, 2) else "other" for outcome, _ in mine)
        by = Counter(oracle for _, found in mine for oracle, _ in found)
        words = ", ".join(f"{oracle} {count}" for oracle, count in sorted(by.items()))
        rows.append([kind, len(mine), *(ended[status] for status in (0, 1, 2, "other")), words])
    return template.table(["kind of case", "cases", "exit 0", "1", "2", "other", "objections"], rows)


def worth_table(done):
    """A row a group of the cases that were held against a reference: how many were worth what, and seconds."""
    rows = []
    for group in sorted({case.group for _, case, outcome, _ in done if outcome.worth}):
        mine = [outcome for _, case, outcome, _ in done if case.group == group and outcome.worth]
        count = Counter(outcome.worth for outcome in mine)
        seconds = sum(outcome.seconds for outcome in mine) / len(mine)
        rows.append([group, len(mine), *(count[label] or "" for label in references.LABELS), f"{seconds:.1f}"])
    return "\n" + template.table(["held against references", "cases", *references.LABELS, "seconds"], rows) if rows else ""


def failures(done):
    """Cases with a finding; of a hundred answers one may be worse than asked, by no more than SHORT."""
    short = sum(outcome.worth == "short" for _, _, outcome, _ in done)
    answers = sum(bool(outcome.worth) for _, _, outcome, _ in done)
    return sum(bool(found) for *_, found in done) - (short if short <= 0.01 * answers else 0)


def main():
    chosen = arguments()
    seed, _, first = chosen.seed.partition(":")
    program = one_call.Program(str(launch.MORTISE), 100 if chosen.sanitize else 20, chosen.sanitize)
    if not os.access(program.path, os.X_OK):
        sys.exit(f"fuzz: {program.path} cannot be run: ./dev build makes it, or MORTISE names another")
    shutil.rmtree(chosen.out, ignore_errors=True)
    kinds, show = tuple(chosen.kind or MAKERS), lambda line: print(line, flush=True)
    done = fuzz(program, chosen.count, seed, int(first or 0), chosen.jobs, kinds, chosen.out, show)
    failed = failures(done)
    print(table(done) + worth_table(done))
    print(f"{failed} of {len(done)} cases failed" + (f": {chosen.out}" if failed else ""))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
