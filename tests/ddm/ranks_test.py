"""mortise by several processes: the answer of one, errors told once, no half-written results when a rank dies.

Usage: ranks_test.py MORTISE BUILT (1: with MORTISE_MPI, 0: without, exit status 77)
"""

import csv
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

GEO = Path(__file__).resolve().parents[2] / "geo"
MPIRUN = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n"]


def command(mortise, ranks, *arguments):
    return ([*MPIRUN, str(ranks)] if ranks > 1 else []) + [mortise, "solve", *map(str, arguments)]


def run(mortise, ranks, *arguments):
    return subprocess.run(command(mortise, ranks, *arguments), capture_output=True, text=True, timeout=120)


def contact(folder):
    with open(folder / "contact.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name] or 0) for row in rows] for name in ("u_n", "p", "sigma_n", "p_error")}


def largest(values):
    return max(map(abs, values))


def same_answer(mortise, work):
    """On a unilateral wall whose joints open, with its error estimate: to 1e-10 of the largest."""
    scene = [GEO / "wall.toml", "--set", "method.solver=feti", "--quiet", "-o"]
    one = run(mortise, 1, *scene, work / "one")
    assert one.returncode == 0, one.stderr
    expected = contact(work / "one")
    for ranks in (2, 4):
        several = run(mortise, ranks, *scene, work / str(ranks))
        assert several.returncode == 0, several.stderr
        found = contact(work / str(ranks))
        for name, values in expected.items():
            size = largest(expected["p"] if name in ("sigma_n", "p_error") else values)
            difference = largest(a - b for a, b in zip(values, found[name], strict=True)) / size
            assert difference <= 1e-10, f"{ranks} ranks: {name} differs by {difference:.1e} of its size"


def printed_once(mortise, work):
    """What all ranks refuse, and what one prints."""
    refused = run(mortise, 2, GEO / "wall.toml", "--set", "bodies.nobody=steel", "-o", work / "refused")
    assert refused.returncode == 1
    assert refused.stderr.count("mortise: error:") == 1 and "nobody" in refused.stderr, refused.stderr
    assert not (work / "refused").exists()
    told = run(mortise, 2, GEO / "wall.toml", "--no-estimate", "-o", work / "told")
    assert told.returncode == 0 and told.stdout.count("  mesh  ") == 1, told.stdout
    only = subprocess.run(
        [*MPIRUN, "2", mortise, "check", GEO / "wall.toml"], capture_output=True, text=True, timeout=60
    )
    assert only.returncode == 1 and only.stderr.count("mortise solve") == 1, only.stderr


def ranks_of(parent):
    """Processes that mpirun started, once each is amid its work (its second second)."""
    found = subprocess.run(["ps", "--no-headers", "-o", "pid", "--ppid", str(parent)], capture_output=True, text=True)
    return [int(pid) for pid in found.stdout.split()]


def dies_whole(mortise, work):
    """A rank that is killed ends all of them; the results of before stand."""
    folder = work / "killed"
    assert run(mortise, 1, GEO / "patch_flat.toml", "--quiet", "-o", folder).returncode == 0
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    slow = ["--set", "mesh.parameters.n=60", "--quiet", "-o", folder]
    for number, to_rank in ((signal.SIGKILL, True), (signal.SIGINT, False)):
        mpirun = subprocess.Popen(
            command(mortise, 2, GEO / "wall.toml", *slow), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        while len(ranks_of(mpirun.pid)) < 2 and mpirun.poll() is None:
            time.sleep(0.01)
        time.sleep(0.5)
        os.kill(ranks_of(mpirun.pid)[-1] if to_rank else mpirun.pid, number)
        errors = mpirun.communicate(timeout=60)[1]
        assert mpirun.returncode != 0, "killed, with exit status 0"
        assert not to_rank or "signal 9" in errors, errors
        assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def main():
    mortise, built = sys.argv[1:]
    if built != "1":
        print("SKIPPED ] Ranks: built without MORTISE_MPI (./dev setup --mpi, ./dev build mpi)")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as work:
        for test in (same_answer, printed_once, dies_whole):
            test(mortise, Path(work))
            print("passed:", test.__name__)


if __name__ == "__main__":
    main()
