"""One call of mortise in a folder of its own: what it said, how it ended, and what it did to the files (Linux)."""

import hashlib
import os
import re
import resource
import signal
import stat
import subprocess
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

PATIENCE = 5  # time limits by the wall clock after which even a process that waits for a busy processor is ended
MEMORY = 4 * 2**30  # bytes of address space: a scene without an end must not fill the machine


@dataclass
class Program:
    path: str
    time_limit: int = 20  # seconds of the processor for one call
    sanitized: bool = False


@dataclass
class Outcome:
    status: int | None  # exit status; below 0: the signal that ended it; None: it hung
    said: str  # standard error
    printed: str  # standard output
    before: dict  # what stood in the folder: path, what it is
    after: dict
    seconds: float = 0.0
    worth: str = ""  # one of references.LABELS, of a case with a reference


def snapshot(folder):
    """Every path below the folder: kind, and digest of the content or target of the link."""
    paths = [os.path.join(root, name) for root, names, files in os.walk(folder) for name in names + files]
    return {os.path.relpath(path, folder): describe(path) for path in paths}


def describe(path):
    mode = os.lstat(path).st_mode
    if stat.S_ISLNK(mode):
        return "link to " + os.readlink(path)
    if stat.S_ISREG(mode):
        return hashlib.sha1(Path(path).read_bytes()).hexdigest()
    return "folder" if stat.S_ISDIR(mode) else f"device or pipe {stat.S_IFMT(mode):o}"


def environment(reports):
    """One thread for each call, no meshes in the user's cache; sanitizers end a call with an exit status of their own and
    report to a file: while gmsh works standard error is not the caller's."""
    chosen = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "XDG_CACHE_HOME": "/proc/none",
              "ASAN_OPTIONS": f"detect_leaks=0:exitcode=99:log_path={reports}/report",
              "UBSAN_OPTIONS": "print_stacktrace=1:halt_on_error=1:exitcode=99"}  # fmt: skip
    return os.environ | chosen


def limits(program, case):
    def set_limits():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_CPU, (program.time_limit, program.time_limit + 1))
        if not program.sanitized:  # which reserves terabytes
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        if case.largest_file is not None:
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # the write fails, as on a full disk
            resource.setrlimit(resource.RLIMIT_FSIZE, (case.largest_file, case.largest_file))

    return set_limits


def end(process):
    """Ends the process and all that it started."""
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    process.wait()


def status_within(process, limit):
    """The exit status, or None of a process that hangs: that has used up the processor's seconds (RLIMIT_CPU), or sleeps."""
    try:
        status = process.wait(timeout=PATIENCE * limit)
    except subprocess.TimeoutExpired:
        return None
    return None if status == -signal.SIGXCPU else status


def is_of_gmsh(report):
    """Whether gmsh stands between mortise and the mistake: the first frame that is of either is gmsh's."""
    frames = (line for line in report.splitlines() if re.search(r"#\d+ 0x", line))
    return "libgmsh" in next((line for line in frames if re.search(r"libgmsh|(?<!\.\.)/src/", line)), "")


def call(program, case, folder):
    """Runs mortise on the case's files, which stand in `folder`. What a sanitizer reports of gmsh's own mistakes is left
    out: gmsh works in a child, whose end mortise tells."""
    with tempfile.TemporaryDirectory() as reports:
        run = run_once(program, case, folder, reports)
        report = "".join(path.read_text(errors="replace") for path in sorted(Path(reports).iterdir()))
    return run if is_of_gmsh(report) else replace(run, said=run.said + report)


def run_once(program, case, folder, reports):
    before, start = snapshot(folder), time.monotonic()
    words = [program.path, *(word.encode("utf-8", "surrogateescape") for word in case.words)]
    process = subprocess.Popen(words, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, env=environment(reports), start_new_session=True,
                               restore_signals=False, preexec_fn=limits(program, case))  # fmt: skip
    with ThreadPoolExecutor(2) as readers:
        texts = [readers.submit(beginning, stream) for stream in (process.stderr, process.stdout)]
        status = status_within(process, program.time_limit)
        end(process)
    said, printed = (text.result() for text in texts)
    return Outcome(status, said, printed, before, snapshot(folder), time.monotonic() - start)


def beginning(stream):
    """The first million bytes; the rest is read and dropped, so that the program can go on."""
    with stream:
        first = stream.read(2**20)
        while stream.read(2**20):
            pass
    return first.decode("utf-8", "surrogateescape")
