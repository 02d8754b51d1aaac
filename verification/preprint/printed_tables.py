"""The preprint's printed tables of delta, and what its word "active" may mean.

A row: table, scene, mesh (n_upper, n_lower), at (nodes or centres), active and body (G1 upper, G2 lower), printed, and
whether it is a target (rows that the preprint prints twice are none).
"""

import csv
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from scipy import stats

import launch
import oscillation

PRINTED = Path(__file__).with_name("printed")
SERIES = {"straight": ("tent_a", "tent_b", "tent_c"), "circle": ("circle",), "parabolas": ("parabola_1", "parabola_2")}
OTHER = {"G1": "G2", "G2": "G1"}
MAPPINGS = {  # side of the multipliers, of the body that the preprint calls active
    "active carries the multipliers": lambda active: active,
    "active is the opposite side": OTHER.get,
}


def series_of(scene):
    return next(name for name, scenes in SERIES.items() if scene in scenes)


def read_table(at):
    lines = [line for line in (PRINTED / f"delta_{at}.csv").read_text().splitlines() if not line.startswith("#")]
    for row in csv.DictReader(lines):
        yield {
            **{"table": int(row["table"]), "scene": row["scene"], "mesh": (int(row["n1"]), int(row["n2"])), "at": at},
            **{"active": row["paper_active"], "body": row["body"], "printed": float(row["delta"])},
            "target": row["flag"] != "copy",
        }


def printed_rows(meshes=None):
    """All rows of the tables, or those of some meshes."""
    rows = [*read_table("nodes"), *read_table("centres")]
    return [row for row in rows if meshes is None or row["mesh"] in meshes]


def deltas(store, rows, settings_of, words, say):
    """Each row with our figures for it, {side of the multipliers: (delta, share of its worst places)}; once for the rows
    of the same scene, mesh, body and `at`. `settings_of`: a scene's."""
    place = lambda row: tuple(row[name] for name in ("scene", "mesh", "at", "body"))

    def measure(place):
        scene, mesh, at, body = place
        say(f"{words}: {scene} {launch.mesh_name(mesh)} {at}, {body}")
        return {side: oscillation.delta_of(store, scene, mesh, settings_of(scene), side, body, at) for side in OTHER}

    asked = list(dict.fromkeys(map(place, rows)))
    with ThreadPoolExecutor(store.jobs) as pool:
        found = dict(zip(asked, pool.map(measure, asked)))
    return [(row, found[place(row)]) for row in rows]


def of_series(rows, series):
    """The targets of a series."""
    return [row for row in rows if row["target"] and row["scene"] in SERIES[series]]


def fit(ours, printed):
    """How figures agree with printed ones: median and standard deviation of log10(ours/printed), the share within a
    factor of 3, and the rank correlation (Spearman)."""
    logs = np.log10(np.array(ours) / np.array(printed))
    rank = stats.spearmanr(ours, printed)[0] if len(logs) > 2 else np.nan
    figures = {"median": np.median(logs), "spread": np.std(logs), "within_3": np.mean(np.abs(logs) <= np.log10(3))}
    return {"rows": len(logs)} | {name: float(value) for name, value in (figures | {"rank": rank}).items()}
