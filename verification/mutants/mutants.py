"""Faults put into the program on purpose, one at a time: does a test notice?

Each line of mutants.txt is a fault: file @@ old text @@ new text @@ what it breaks, and @@ why it may survive where no
test can tell. It goes into a copy of the tree, which is built incrementally; then the tests run, the cheap ones first: of at most
0.1 s (of its own room 1 s), of at most 5 s, the other C++ tests, the Python tests on sweeps and scenes. What kills it ends its
turn. A mutant that does not compile is an error of the list. Results stand in WORK/journal.csv, by the fault's line;
those that are there are not run again."""

import argparse
import csv
import fcntl
import fnmatch
import json
import os
import random
import re
import shutil
import subprocess
import sys
import time
from collections import Counter, namedtuple
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
STAGES = ["fast", "quick", "slow", "scenes"]
FAST, QUICK = 0.1, 5  # seconds of a test, at most
# Python tests that solve scenes; the others look at pages, pictures and programs.
SCENES = ["exact", "accuracy", "stability", "fuzz"]

Mutant = namedtuple("Mutant", "file old new what reason")


def read_mutants(path=HERE / "mutants.txt"):
    """The faults of the list, in its order."""
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return [Mutant(*(line.split(" @@ ") + [""])[:5]) for line in lines]


def room(mutant):
    return mutant.file.split("/")[0]


class Tree:
    """A copy of the working tree with a build folder of its own."""

    def __init__(self, work):
        self.work, self.source, self.build = work, work / "tree", work / "build"
        self.env = dict(os.environ, CCACHE_SLOPPINESS="pch_defines,time_macros,include_file_ctime,include_file_mtime",
                        XDG_CACHE_HOME=str(work / "cache"), MORTISE=str(self.build / "mortise"))  # fmt: skip

    def refresh(self):
        """As the working tree is now. Files that have not changed keep their times."""
        files = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, check=True, text=True,
                               capture_output=True).stdout.splitlines()  # fmt: skip
        kept = {self.source / name for name in files}
        for old in [path for path in self.source.rglob("*") if path.is_file() and path not in kept]:
            old.unlink()
        for name in files:
            new, old = ROOT / name, self.source / name
            if new.is_file() and not (old.is_file() and old.read_bytes() == new.read_bytes()):
                old.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(new, old)
                shutil.copymode(new, old)

    def configure(self):
        launcher = ["-D", "CMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        linker = ["-D", "CMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld"] if shutil.which("ld.lld") else []
        # No warnings: what a fault leaves unused is no error.
        subprocess.run(["cmake", "-S", self.source, "-B", self.build, "-G", "Ninja", "-D", "CMAKE_BUILD_TYPE=Release",
                        "-D", "CMAKE_UNITY_BUILD=ON", "-D", "CMAKE_CXX_FLAGS=-w", "-D", "CMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG",
                        "-D", "MORTISE_BENCHMARKS=OFF", *launcher, *linker,
                        "-D", f"CMAKE_PROJECT_INCLUDE={self.source}/verification/mutants/library_units.cmake"],
                       check=True, stdout=subprocess.DEVNULL, env=self.env)  # fmt: skip

    def compile(self, jobs, target="mortise_tests"):
        """What the compiler says if it fails, else nothing."""
        done = subprocess.run(["ninja", "-C", self.build, f"-j{jobs}", target],
                              text=True, errors="replace", capture_output=True, env=self.env)  # fmt: skip
        return done.stdout[-3000:] if done.returncode else ""

    def run_tests(self, names, limit, *arguments):
        """The test that fails, or "crash" or "late"; nothing if all pass."""
        listed = self.work / "tests.txt"
        listed.write_text("--gtest_filter=" + ":".join(names))
        try:
            done = subprocess.run([self.build / "tests/mortise_tests", f"--gtest_flagfile={listed}", *arguments],
                                  cwd=self.build, text=True, errors="replace", capture_output=True, timeout=limit,
                                  env=self.env)  # fmt: skip
        except subprocess.TimeoutExpired:
            return "late"
        failed = [line.split("]")[1].split(",")[0].split("(")[0].strip()
                  for line in done.stdout.splitlines() if line.startswith("[  FAILED  ]")]  # fmt: skip
        return failed[0] if failed else "" if done.returncode == 0 else "crash"

    def run_scenes(self):
        """The test that fails of those that run the program: sweeps, and the Python tests on scenes."""
        sweeps = subprocess.run(["/usr/bin/python3", self.source / "tests/app/sweep_test.py", self.build / "mortise"],
                                capture_output=True, env=self.env)  # fmt: skip
        if sweeps.returncode:
            return "sweep_test.py"
        try:
            done = subprocess.run(["/usr/bin/python3", "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider",
                                   *(self.source / "verification" / name for name in SCENES)],
                                  text=True, errors="replace", capture_output=True, timeout=3600, env=self.env)  # fmt: skip
        except subprocess.TimeoutExpired:
            return "late"
        failed = [line for line in done.stdout.splitlines() if line.startswith("FAILED")]
        return failed[0].split()[1].split("/")[-1] if failed else "" if done.returncode == 0 else "crash"

    def test_seconds(self):
        """Of each C++ test without a fault; what was measured before stays. Tests that fail here say nothing of mutants:
        an error."""
        kept, report = self.work / "seconds.json", self.work / "report.json"
        known = json.loads(kept.read_text()) if kept.is_file() else {}
        listed = subprocess.run([self.build / "tests/mortise_tests", "--gtest_list_tests"], text=True, check=True,
                                capture_output=True, env=self.env).stdout.splitlines()  # fmt: skip
        names, suite = [], ""
        for line in listed:
            suite = suite if line.startswith(" ") else line.split()[0]
            names += [suite + line.split()[0]] if line.startswith(" ") else []
        new = [name for name in names if name not in known]
        if new:
            self.run_tests(new, 3600, f"--gtest_output=json:{report}")
            tests = [(f"{suite['name']}.{test['name']}", test)
                     for suite in json.loads(report.read_text())["testsuites"] for test in suite["testsuite"]]  # fmt: skip
            if failed := [name for name, test in tests if "failures" in test]:
                sys.exit(f"mutants: tests fail without a fault: {', '.join(failed)}")
            known.update((name, float(test["time"].rstrip("s"))) for name, test in tests)
        seconds = {name: known[name] for name in names}
        kept.write_text(json.dumps(seconds))
        return seconds


def suites_of(room):
    """Of the tests of a room."""
    code = "".join(path.read_text() for path in sorted(ROOT.glob(f"tests/{room}/*_test.cpp")))
    return set(re.findall(r"\bTEST(?:_[FP])?\((\w+),", code))


def stages_of(seconds, own):
    """(stage, names, time limit) for each stage of C++ tests; `own`: suites that come first."""
    is_own = {name: name.split(".")[0].split("/")[-1] in own for name in seconds}
    parts = [
        ("fast", lambda name, time: is_own[name] and time <= 10 * FAST),
        ("fast", lambda name, time: not is_own[name] and time <= FAST),
        ("quick", lambda name, time: is_own[name] and 10 * FAST < time <= QUICK),
        ("quick", lambda name, time: not is_own[name] and FAST < time <= QUICK),
        ("slow", lambda name, time: time > QUICK),
    ]
    for stage, belongs in parts:
        names = [name for name, time in seconds.items() if belongs(name, time)]
        yield stage, names, 60 + 20 * sum(seconds[name] for name in names)


def judge(tree, mutant, seconds, last, jobs):
    """The stage that kills it ("survived": none, "error": it does not compile) and by what."""
    path = tree.source / "src" / mutant.file
    text = path.read_text()
    if text.count(mutant.old) != 1:
        return "error", "its old text does not stand once in its file"
    try:
        path.write_text(text.replace(mutant.old, mutant.new))
        if trouble := tree.compile(jobs):
            return "error", trouble
        for name, tests, limit in stages_of(seconds, suites_of(room(mutant))):
            if STAGES.index(name) > STAGES.index(last):
                return "survived", last
            if tests and (killer := tree.run_tests(tests, limit, "--gtest_fail_fast")):
                return name, killer
        if last == "slow":
            return "survived", last
        tree.compile(jobs, "mortise_executable")
        killer = tree.run_scenes()
        return ("scenes", killer) if killer else ("survived", "scenes")
    finally:
        path.write_text(text)


def read_journal(path):
    if not path.is_file():
        return {}
    with path.open(newline="") as file:
        return {tuple(row[:4]): row[4:] for row in csv.reader(file)}


def table(mutants, journal):
    """By room: how many ran, and what killed them."""
    known = [(m, journal[m[:4]]) for m in mutants if m[:4] in journal]
    counts = Counter((room(m), stage) for m, (stage, *_) in known)
    words = [*STAGES, "survived", "error"]
    lines = ["| room | listed | run | " + " | ".join(words) + " |", "|---" * (len(words) + 3) + "|"]
    for name in [*dict.fromkeys(map(room, mutants)), "all"]:
        of = [sum(n for (r, s), n in counts.items() if s == word and name in (r, "all")) for word in words]
        listed = sum(name in (room(m), "all") for m in mutants)
        lines.append(f"| {name} | {listed} | {sum(of)} | " + " | ".join(map(str, of)) + " |")
    for m, (stage, by, *_) in known:
        if stage in ("survived", "error"):
            lines.append(f"{stage} ({by.splitlines()[-1] if by else ''}): {m.file}: {m.what}" + (f" ({m.reason})" if m.reason else ""))
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", nargs="?", type=int, help="so many, drawn at random (default: all, in order)")
    parser.add_argument("seed", nargs="?", type=int, default=1)
    parser.add_argument("--room", nargs="+", default=[], metavar="ROOM", help="of these folders of src only")
    parser.add_argument("--match", default="", metavar="REGEX", help="of those whose file and words it fits only")
    parser.add_argument("--work", type=Path, default=ROOT / "out/mutants", help="tree, build folder and journal")
    parser.add_argument("--last", choices=STAGES, default="scenes", help="the last stage (default: scenes)")
    parser.add_argument("--again", action="store_true", help="those that survived before, from the start")
    parser.add_argument("--filter", metavar="SUITE.TEST", help="of the tests of at most 5 s these only, as in --gtest_filter")
    parser.add_argument("--jobs", type=int, default=2, help="of the compiler (default: 2)")
    parser.add_argument("--report", action="store_true", help="only print what the journal says")
    options = parser.parse_args()
    mutants = read_mutants()
    work = options.work.absolute()
    work.mkdir(parents=True, exist_ok=True)
    path = work / "journal.csv"
    journal = read_journal(path)
    if options.report:
        return print(table(mutants, journal))
    chosen = [m for m in mutants if not options.room or room(m) in options.room]
    chosen = [m for m in chosen if re.search(options.match, f"{m.file}: {m.what}")]
    if options.again:
        chosen = [m for m in chosen if journal.get(m[:4], [""])[0] in ("survived", "error")]
    else:
        chosen = [m for m in chosen if m[:4] not in journal]
    if options.count:
        chosen = random.Random(options.seed).sample(chosen, min(options.count, len(chosen)))
    lock = (work / "lock").open("w")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        sys.exit(f"mutants: another run is at work in {work}; expected one at a time")
    tree = Tree(work)
    tree.refresh()
    tree.configure()
    if trouble := tree.compile(options.jobs):
        sys.exit(f"mutants: the tree does not compile\n{trouble}")
    seconds_of_tests = tree.test_seconds()
    if options.filter:
        patterns = options.filter.split(":")
        seconds_of_tests = {name: seconds for name, seconds in seconds_of_tests.items()
                            if any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)}  # fmt: skip
    for m in chosen:
        start = time.perf_counter()
        stage, by = judge(tree, m, seconds_of_tests, options.last, options.jobs)
        seconds = time.perf_counter() - start
        print(f"{stage:9} {seconds:5.0f} s  {m.file}: {m.what}  {by.splitlines()[-1] if by else ''}", flush=True)
        journal[m[:4]] = [stage, by, f"{seconds:.1f}"]
        with path.open("a", newline="") as file:
            csv.writer(file).writerow([*m[:4], *journal[m[:4]]])
    print(table(mutants, {m[:4]: journal[m[:4]] for m in chosen}))
    sys.exit(any(journal[m[:4]][0] == "error" or journal[m[:4]][0] == "survived" and not m.reason for m in chosen))


if __name__ == "__main__":
    main()
