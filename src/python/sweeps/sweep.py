"""Solve a scene for every combination of values: a CSV table with a row a run.

Runs go in fours to processes of `mortise solve-runs` (src/app/sweep.hpp). Fours that are complete are kept beside the
table until all are there, so that a sweep that was killed goes on when it is started again.
"""

import argparse
import itertools
import json
import os
import queue
import re
import signal
import subprocess
import sys
import threading
from pathlib import Path

from table import Journal, Refused, check_target, field, fields, is_table, printable, write_lines, write_table

GROUP = 4  # runs that start from one another
MOST_RUNS = 100_000  # with a hundredth of a second each a quarter of an hour, and each row is kept in memory
OPENED = {"(": ")", "[": "]", "{": "}"}
EXAMPLE = "expected KEY=VALUE1,VALUE2,... such as mesh.parameters.n_upper=20,40,80"


def say(line):
    """On the standard error; a long line without its middle."""
    line = printable(line)
    print(line if len(line) <= 900 else f"{line[:700]} [...] {line[-200:]}", file=sys.stderr, flush=True)


# ---- Runs and parts ----


def variation(text):
    """`--vary KEY=V1,V2,...`"""
    key, equals, values = (word.strip() for word in text.partition("="))
    if any("\ud800" <= c <= "\udfff" for c in text):
        raise Refused(f"--vary '{text}': expected UTF-8")
    if not equals or not key:
        raise Refused(f"--vary '{text}': {EXAMPLE}")
    if not values:
        raise Refused(f"--vary {text}: no value; {EXAMPLE}")
    return key, parted(text, values.removesuffix(","))


def parted(text, values):
    """Values between commas; what brackets or quotes hold is one."""
    parts, waiting = [""], []  # what closes those that are open, the innermost last
    for c in values:
        if c == "," and not waiting:
            parts.append("")
            continue
        parts[-1] += c
        if waiting and c == waiting[-1]:
            waiting.pop()
        elif c in "'\"" and (not waiting or waiting[-1] not in "'\""):
            waiting.append(c)
        elif c in OPENED and (not waiting or waiting[-1] not in "'\""):
            waiting.append(OPENED[c])
    if waiting:
        raise Refused(f"--vary {text}: expected {waiting[-1]} before the end")
    return parts


def runs_of(variations):
    """The values of each run, the last key fastest."""
    count = 1
    keys = [key for key, _ in variations]
    for key, values in variations:
        if keys.count(key) > 1:
            raise Refused(f"--vary {key}: given {keys.count(key)} times; expected one list of its values")
        count *= len(values)
        if count > MOST_RUNS:
            raise Refused(f"--vary {key}: the values combine to more than {MOST_RUNS} runs; expected fewer, or several sweeps")
    return list(itertools.product(*(values for _, values in variations)))


def part_of(text):
    """`--part K/N`"""
    found = re.fullmatch(r"(\d{1,5})/(\d{1,5})", text, re.ASCII)
    part, of = map(int, found.groups()) if found else (0, 0)
    if not 1 <= part <= of <= 10_000:
        raise Refused(f"--part '{text}': expected K/N with 1 <= K <= N <= 10000, such as 2/8")
    return part, of


def groups_of(runs, part, of):
    """The groups of a part, each the numbers of its runs."""
    groups = [range(k, min(k + GROUP, len(runs))) for k in range(0, len(runs), GROUP)]
    return groups[(part - 1) * len(groups) // of : part * len(groups) // of]


def table_of(path, part, of):
    return path if of == 1 else path.with_suffix(f".{part}_of_{of}{path.suffix}")


# ---- Processes ----


class Worker:
    """A process that solves groups."""

    def __init__(self, command):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, encoding="utf-8")
        if not self.process.stdout.readline():
            if self.process.wait() == 1:  # its command line is wrong, as it has said
                sys.exit(1)
            raise EOFError

    def answer(self):
        line = self.process.stdout.readline()
        if not line.endswith("\n"):
            raise EOFError
        return json.loads(line)

    def ask(self, words):
        print(words, file=self.process.stdin, flush=True)

    def refusal(self, values):
        """Why none of these runs can be read; nothing where one can."""
        self.ask(json.dumps(values))
        words = self.answer().get("refused")
        self.ask("keep")
        return words

    def rows(self, values, kept):
        """The key of a group, whether it is kept, and its rows, solved one after another if not."""
        self.ask(json.dumps(values))
        key = self.answer()["key"]
        self.ask("keep" if key in kept else "solve")
        return key, key in kept, kept.get(key) or (self.answer() for _ in values)


def share(workers, groups, solve):
    """Yields what solve(worker, group) yields of all groups, in the order in which it comes. Raises what it raises."""
    left, found = iter(groups), queue.SimpleQueue()

    def serve(worker):
        try:
            for group in left:
                for item in solve(worker, group):
                    found.put(item)
            found.put(None)
        except BaseException as error:
            found.put(error)

    threads = [threading.Thread(target=serve, args=[worker], daemon=True) for worker in workers]
    for thread in threads:
        thread.start()
    for _ in threads:
        while (item := found.get()) is not None:
            if isinstance(item, BaseException):
                raise item
            yield item


# ---- The sweep ----


def refuse_unreadable(worker, groups):
    """Where no run of the sweep can be read: that is the scene's fault, or of a key."""
    first = None
    for values in groups:
        if not (words := worker.refusal(values)):
            return
        first = first or words
    raise Refused(f"{first}{' (every run)' if len(groups[0]) > 1 else ''}")


def sweep(options, keys, runs, path):
    """Solves a part and writes its table after each run; returns its rows."""
    command = [os.environ.get("MORTISE_PROGRAM", "mortise"), "solve-runs", options.scene, *options.passed]
    workers = []
    try:
        workers.append(Worker(command))
        refuse_unreadable(workers[0], [[list(zip(keys, runs[k])) for k in group] for group in groups_of(runs, 1, 1)])
        return solve_part(options, keys, runs, path, workers, command)
    except (EOFError, BrokenPipeError):
        raise Refused(f"{path}: a process of the sweep has ended before its runs were complete; the same command goes on with those that are missing") from None
    finally:
        for worker in workers:
            worker.process.kill()
            worker.process.wait()


def solve_part(options, keys, runs, path, workers, command):
    """As sweep, by `workers`, to which it adds."""
    groups = groups_of(runs, *options.part)
    path.parent.mkdir(parents=True, exist_ok=True)
    check_target(path, options.scene, is_table)
    journal = Journal(path.with_name(f".{path.name}.runs"), options.scene)

    def solve(worker, group):
        values = [list(zip(keys, runs[k])) for k in group]
        key, kept, rows = worker.rows(values, journal.kept)
        done = []
        for k, row in zip(group, rows):
            done.append(row)
            yield k, row, kept, (key, done) if len(done) == len(group) and not kept else None

    found = {}
    while len(workers) < min(options.jobs, len(groups)):
        workers.append(Worker(command))
    for k, row, kept, complete in share(workers, groups, solve):
        found[k] = row
        write_table(path, keys, runs, found)
        if complete:
            journal.add(*complete)
        if not options.quiet:
            values = "".join(f" {key}={value}" for key, value in zip(keys, runs[k]))
            say(f"{k + 1}/{len(runs)}{values}: {row['status']}{' (kept)' * kept}")
    if not groups:
        write_table(path, keys, runs, found)
    journal.remove()
    return found


# ---- Joining parts ----


def read_part(path, keys, runs, part, of):
    """The header and the rows of a part's table, which must be whole."""
    path = table_of(path, part, of)
    name = f"{path}, part {part} of {of}: "
    if not path.is_file():
        raise Refused(f"{name}no such file; expected what --part {part}/{of} writes")
    header, *rows = map(fields, path.read_text(encoding="utf-8", errors="surrogateescape").split("\n")[:-1] or [""])
    for text in itertools.chain.from_iterable(rows):
        if printable(text) != text:
            raise Refused(f"{name}is damaged: it holds '{text}'; start it again")
    own = [runs[k] for group in groups_of(runs, part, of) for k in group]
    same = header[: len(keys) + 1] == [*map(field, keys), "status"] and len(rows) <= len(own)
    if not same or any(len(row) != len(header) or row[: len(keys)] != [*map(field, run)] for row, run in zip(rows, own)):
        raise Refused(f"{name}is of another sweep; expected the same scene, values of --vary and number of parts")
    if len(rows) < len(own):
        raise Refused(f"{name}{len(rows)} of its {len(own)} runs are complete; start it again")
    return header, rows


def join(options, keys, runs):
    """Writes the table of the whole; returns the status of each run."""
    check_target(options.output, options.scene, is_table)
    parts = [read_part(options.output, keys, runs, k, options.join) for k in range(1, options.join + 1)]
    names = list(dict.fromkeys(name for header, _ in parts for name in header))
    lines = [",".join(names)]
    for header, rows in parts:
        lines += [",".join(map(dict(zip(header, row)).get, names, itertools.repeat(""))) for row in rows]
    write_lines(options.output, lines)
    return [row[len(keys)] for _, rows in parts for row in rows]


# ---- The command line ----


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise Refused(f"command line: {message} (mortise sweep --help)")


def filled(text):
    if not text:
        raise argparse.ArgumentTypeError("expected a path, found an empty text")
    return Path(text)


def within(most):
    def number(text):
        if not text.isdecimal() or not 1 <= int(text) <= most:
            raise argparse.ArgumentTypeError(f"expected a whole number from 1 to {most}, found '{text}'")
        return int(text)

    return number


def options_of(words):
    parser = Parser(prog="mortise sweep", description=__doc__.split("\n\n")[0], allow_abbrev=False)
    parser.add_argument("scene", type=filled, help="scene file (.toml)")
    parser.add_argument("--vary", action="append", required=True, type=str, metavar="KEY=V1,V2,...", help="values to run through; repeat for combinations")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="override a value of the scene, in all runs")
    parser.add_argument("-o", "--output", type=filled, metavar="FILE.csv", help="table to write (default: out/SCENE_sweep.csv)")
    parser.add_argument("--jobs", type=within(1024), default=1, metavar="N", help="runs at the same time, each on one thread (default: 1)")
    parts = parser.add_mutually_exclusive_group()
    parts.add_argument("--part", default="1/1", metavar="K/N", help="run the Kth of N parts and write FILE.K_of_N.csv, as one of a batch system's jobs")
    parts.add_argument("--join", type=within(10_000), metavar="N", help="put the tables of N parts together")
    parser.add_argument("--diagnose", action="store_true", help="find the inf-sup constant too: do the meshes control the pressure?")
    parser.add_argument("--no-programs", action="store_true", help="refuse a .geo that runs programs or writes files")
    parser.add_argument("--no-cache", action="store_true", help="mesh a .geo anew, and do not keep its mesh for later runs")
    parser.add_argument("--threads", type=within(128), metavar="N", help="threads, of one job (default: all cores)")
    parser.add_argument("--quiet", action="store_true", help="print errors only")
    options = parser.parse_args(words)
    options.output = options.output or Path("out") / f"{options.scene.stem}_sweep.csv"
    options.part = part_of(options.part)
    threads = options.threads or (1 if options.jobs > 1 else None)
    options.passed = [f"--set={text}" for text in options.set] + [f"--threads={threads}"] * bool(threads)
    options.passed += [word for word in ("--diagnose", "--no-programs", "--no-cache") if getattr(options, word[2:].replace("-", "_"))]
    return options


def main(words):
    options = options_of(words)
    keys, _ = zip(*(variations := [variation(text) for text in options.vary]))
    runs = runs_of(variations)
    path = table_of(options.output, *options.part)
    if options.join:
        statuses = join(options, keys, runs)
    else:
        statuses = [row["status"] for row in sweep(options, keys, runs, path).values()]
    if not options.quiet:
        print(printable(str(path)))
    if any(status != "solved" for status in statuses):
        say(f"mortise: {options.scene}: not every run is solved (see the status in {path})")
        return 2
    return 0


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # the processes of the sweep have it too
    try:
        sys.exit(main(sys.argv[1:]))
    except Refused as refused:
        say(f"mortise: error: {refused}")
        sys.exit(1)
    except OSError as error:
        say(f"mortise: error: {error.filename}: {error.strerror}")
        sys.exit(1)
