"""Runs of the atlas: each is a scene with settings; its row says how it ended and what was measured.

A run is a dictionary: `axes` (what the study varies, for people and pictures), `scene` (a name in geo/, or the text of
a scene file), `settings` (--set), `files` (texts beside that scene file), `measures` (names in atlas_measures),
`arguments` (more words for the command line). Rows are kept in OUT/STUDY/rows.jsonl under a key of all of these, the
executable, the geometries and the measures: a run whose key is there is not repeated.
"""

import hashlib
import json
import os
import subprocess
import sys
import tempfile
import time
from functools import cache
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import atlas_measures
import launch


TIME_LIMIT = 60  # seconds for one run; the longest of the atlas takes about 3
OUTCOMES = {0: "solved", 1: "refused", 2: "check", 3: "internal error"}


@cache
def version():
    """Hash of what every run depends on: executable, scenes, measures."""
    digest = hashlib.sha1()
    geo = [path for path in sorted((launch.ROOT / "geo").rglob("*")) if path.is_file()]
    for path in [launch.MORTISE, Path(atlas_measures.__file__), *geo]:
        digest.update(path.read_bytes())
    return digest.hexdigest()


def key_of(run):
    return hashlib.sha1((version() + json.dumps(run, sort_keys=True)).encode()).hexdigest()


def outcome(status, seconds):
    if seconds is None:
        return "hang"
    return OUTCOMES.get(status, f"crash ({status})")


def write_scene(run, folder):
    """The scene file of the run: geo's, or the run's own text with its other files beside it."""
    for name, text in run.get("files", {}).items():
        (folder / name).write_text(text)
    if "\n" not in run["scene"]:
        return launch.scene_file(run["scene"])
    path = folder / "scene.toml"
    path.write_text(run["scene"])
    return path


def message(stderr, folder):
    """What mortise says, without the paths."""
    text = stderr.strip().splitlines()[0] if stderr.strip() else ""
    return text.replace(str(folder) + "/", "").replace(str(launch.ROOT) + "/", "").removeprefix("mortise: ")


def execute(run):
    """The row of one run: axes, outcome, message, seconds, and what the measures say."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        scene = write_scene(run, folder)
        out = folder / "out"
        words = ["solve", scene, *launch.options(run.get("settings", {})), *run.get("arguments", []), "-o", out]
        command = [str(word) for word in (launch.MORTISE, *words, "--quiet")]
        start = time.monotonic()
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=TIME_LIMIT, check=False)
            status, stderr, seconds = done.returncode, done.stderr, time.monotonic() - start
        except subprocess.TimeoutExpired:
            status, stderr, seconds = None, "", None
        row = {
            **run["axes"], "outcome": outcome(status, seconds), "seconds": seconds, "message": message(stderr, folder)
        }
        if status in launch.SOLVED:
            for measure in ("summary", *run.get("measures", [])):
                row.update(getattr(atlas_measures, measure)(out, run))
            if row["status"] == "not_converged":
                row["outcome"] = "not converged"
        return row


def stored(path):
    """Rows by key, of this and of other versions; a line that a stopped run left unfinished is skipped."""
    rows = {}
    for line in path.read_text().splitlines() if path.is_file() else []:
        try:
            entry = json.loads(line)
            rows[entry["key"]] = entry["row"]
        except (json.JSONDecodeError, KeyError):
            continue
    return rows


def run_all(runs, folder, label):
    """The rows of the runs, in order; returns them and how many were run now (the others were there)."""
    if not launch.MORTISE.is_file():
        raise launch.MortiseError(f"{launch.MORTISE} is missing: ./dev build makes it, or MORTISE names another")
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "rows.jsonl"
    known, rows, fresh, start = stored(path), [], 0, time.monotonic()
    with open(path, "a") as file:
        for number, run in enumerate(runs, 1):
            key = key_of(run)
            if key not in known:
                known[key] = execute(run)
                file.write(json.dumps({"key": key, "row": known[key]}) + "\n")
                file.flush()
                fresh += 1
            rows.append(known[key])
            if number % 50 == 0 or number == len(runs):
                print(
                    f"  {label}: {number}/{len(runs)} runs, {fresh} new, {time.monotonic() - start:.0f} s", flush=True
                )
    return rows, fresh


def write_table(path, rows):
    """rows.csv: every scalar of every row; a key that a row lacks is an empty field."""
    keys = list(dict.fromkeys(key for row in rows for key, value in row.items() if not isinstance(value, (list, dict))))
    launch.write_csv(path, [{key: row.get(key) for key in keys} for row in rows])
