"""The store of runs: what a study has measured once is not measured again, and a study that was stopped goes on.

A run is anything JSON (texts, numbers, lists, dictionaries): what is run, with which settings. Its key is a hash of it
and of the contents of all files that the result depends on: the executable, everything in geo/, and the scripts that
measure. Results are files (or folders) named by their keys; each appears whole or not at all.
"""

import hashlib
import json
import shutil
import time
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from threading import Lock

import launch


@cache
def fingerprint(path):
    """Of a file's contents."""
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def digest(*parts):
    """16 hexadecimal digits that change when one of the parts does: paths by the file's contents, all else as JSON."""
    parts = [fingerprint(part) if isinstance(part, Path) else part for part in parts]
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()[:16]


class Store:
    """Results below a folder. `depends`: files beside the programs and geo/ (mostly `Path(__file__)` of what measures).

    `programs` are those that the runs call; `jobs` how many runs at once (1 where seconds are measured); `fresh` counts
    the results that were not there. StudyError if a program is missing.
    """

    def __init__(self, folder, depends=(), programs=None, jobs=1):
        self.folder, self.jobs, self.fresh = Path(folder), jobs, 0
        self.making = defaultdict(Lock)
        programs = [launch.need(path) for path in programs or [launch.MORTISE]]
        scenes = sorted(path for path in (launch.ROOT / "geo").rglob("*") if path.is_file())
        self.version = digest(*programs, *scenes, *map(Path, depends))

    def path(self, run, name=""):
        """Where the folder of a run lies, or its file without .json; `name` may tell people what it is."""
        return self.folder / "-".join(filter(None, [name, digest(self.version, run)]))

    def row(self, run, make, name=""):
        """What make(run) gives, or gave: JSON, kept in a file."""
        path = Path(f"{self.path(run, name)}.json")
        if not path.is_file():
            result = make(run)
            self.folder.mkdir(parents=True, exist_ok=True)
            staged = Path(f"{path}.part")
            staged.write_text(json.dumps(result) + "\n")
            staged.replace(path)
            self.fresh += 1
        return json.loads(path.read_text())

    def rows(self, runs, make, label):
        """row() of each run, in order, `jobs` at once, with a line of progress now and then."""
        start, before, found = time.monotonic(), self.fresh, []
        with ThreadPoolExecutor(self.jobs) as pool:
            try:
                for row in pool.map(lambda run: self.row(run, make), runs):
                    found.append(row)
                    if len(found) % 50 == 0 or len(found) == len(runs):
                        done = f"{len(found)}/{len(runs)} runs, {self.fresh - before} new"
                        print(f"  {label}: {done}, {time.monotonic() - start:.0f} s", flush=True)
            except BaseException:
                pool.shutdown(cancel_futures=True)
                raise
        return found

    def results(self, run, make, name=""):
        """A folder that make(run, folder) has filled, now or before."""
        path = self.path(run, name)
        with self.making[path]:  # several may ask for it at once
            if not path.is_dir():
                staged = Path(f"{path}.part")
                shutil.rmtree(staged, ignore_errors=True)
                staged.mkdir(parents=True)
                make(run, staged)
                staged.replace(path)
                self.fresh += 1
        return path
