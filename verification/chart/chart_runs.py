"""The runs of the chart: mortise_chart by problem and mesh, kept in files, and their medians."""

import csv
import hashlib
import io
import json
import os
import statistics
import subprocess
import sys
from pathlib import Path

for folder in ("common", "crosscheck"):
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / folder))

import launch

TOOL = Path(
    os.environ.get("MORTISE_CHART", launch.ROOT / "build/release/verification/chart/mortise_chart")
).absolute()
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
ERRORS = ("e_energy", "e_p_l2", "e_p_l2_inner", "e_p_max_inner")
STAGES = ("s_assemble", "s_couple", "s_factorise", "s_solve", "s_recover", "s_total", "s_wall")
SIZES = ("nodes", "elements", "dofs", "multipliers", "interface_steps")
COLUMNS = (
    *("problem", "method", "mesh", "n", "status", "turns", *SIZES, "energy", *ERRORS, *STAGES),
    *("s_total_min", "s_total_max"),
)


class ToolError(Exception):
    """A program of the chart is missing, or fails, with what it said."""


def digest(*parts):
    """A name for files and texts: it changes when one of them does."""
    sha = hashlib.sha256()
    for part in parts:
        sha.update(part.read_bytes() if isinstance(part, Path) else str(part).encode())
        sha.update(b"\0")
    return sha.hexdigest()[:16]


def write_json(path, table):
    """The file appears whole or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_suffix(".part")
    temporary.write_text(json.dumps(table, indent=1) + "\n")
    temporary.replace(path)


def kept(path, key, make):
    """What `make` returns, or the file's content if it was made with the same key before; and whether it was."""
    if path.is_file():
        old = json.loads(path.read_text())
        if old["key"] == key:
            return old["rows"], True
    rows = make()
    write_json(path, {"key": key, "rows": rows})
    return rows, False


def run_words(name, settings):
    return ";".join([name, *(f"{key}={value}" for key, value in settings.items())])


def tool(problem, named_ways, turns, *options, threads=1):
    """Rows of mortise_chart, texts as printed, and what it said of ways that it refuses."""
    if not TOOL.is_file():
        raise ToolError(f"{TOOL} is missing: ./dev chart makes it, or MORTISE_CHART names another")
    words = [word for name, settings in named_ways for word in ("--run", run_words(name, settings))]
    command = [TOOL, problem, *words, "--turns", turns, "--threads", threads, *options]
    environment = {**os.environ, **ONE_THREAD}
    done = subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, env=environment, check=False
    )
    if done.returncode != 0:
        raise ToolError(f"mortise_chart {problem}: exit status {done.returncode}\n{done.stderr.strip()}")
    return list(csv.DictReader(io.StringIO(done.stdout))), done.stderr.strip()


def number(text):
    return None if text in ("", None) else float(text)


def of_turns(rows):
    """One row of the turns of a method: medians of the seconds, and the range of the whole."""
    first, totals = rows[0], [float(row["s_total"]) for row in rows]
    return {
        "method": first["name"],
        "status": first["status"],
        "turns": len(rows),
        **{key: int(first[key]) for key in SIZES},
        **{key: number(first[key]) for key in ("energy", *ERRORS)},
        **{key: statistics.median(float(row[key]) for row in rows) for key in STAGES},
        "s_total_min": min(totals),
        "s_total_max": max(totals),
    }


def solve_ways(problem, named_ways, turns, options):
    """For each way, by its words: its row, or what was said where it is refused."""
    rows, said = tool(problem, named_ways, turns, *options)
    found = {}
    for name, settings in named_ways:
        mine = [row for row in rows if row["name"] == name]
        refused = next((line for line in said.splitlines() if line.startswith(name + ":")), name)
        found[run_words(name, settings)] = {"refused": refused} if mine[0]["status"] == "refused" else of_turns(mine)
    return found


def runs(problem, mesh_text, named_ways, turns, folder, reference=None):
    """The methods' rows on one mesh, the refused ones with what was said, and whether all were kept from before.

    The ways that the file of the mesh does not have yet are run together, by turns.
    """
    options, path = (["--reference", reference] if reference else []), folder / f"{problem}_{mesh_text}.json"
    key = digest(TOOL if TOOL.is_file() else "", turns, COLUMNS, *options[1:])
    table = json.loads(path.read_text()) if path.is_file() else {}
    known = table["ways"] if table.get("key") == key else {}
    missing = [way for way in named_ways if run_words(*way) not in known]
    if missing:
        known |= solve_ways(problem, missing, turns, options)
        write_json(path, {"key": key, "ways": known})
    found = {way[0]: known[run_words(*way)] for way in named_ways}
    rows = [row for row in found.values() if "refused" not in row]
    return rows, {name: row["refused"] for name, row in found.items() if "refused" in row}, not missing
