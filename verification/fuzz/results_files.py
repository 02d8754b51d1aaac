"""What the files of a results folder say, read by other means than mortise's own."""

import csv
import json
import math
from pathlib import Path

import numpy
import vtu_file

NONE_ALLOWED = {"iteration", "inf_sup", "against_sigma_n"}  # keys of summary.json that are null where they do not apply


def summary(folder):
    return json.loads((Path(folder) / "summary.json").read_text(), parse_constant=lambda word: float(word))


def not_finite_in(value, place=""):
    """Keys of summary.json with a number that is not finite, which mortise writes as null."""
    if isinstance(value, dict):
        entries = value.items()
    elif isinstance(value, list):
        entries = enumerate(value)
    else:
        bad = value is None or (isinstance(value, float) and not math.isfinite(value))
        return [place] if bad and place.split(".")[-1] not in NONE_ALLOWED else []
    return [found for key, entry in entries for found in not_finite_in(entry, f"{place}.{key}" if place else str(key))]


def rows(path):
    with open(path, newline="", encoding="utf-8", errors="surrogateescape") as file:
        return list(csv.DictReader(file))


def not_finite_in_csv(path, may_be_empty=()):
    """Columns of a table with an empty or non-finite number."""
    bad = set()
    for row in rows(path):
        for key, text in row.items():
            if key is None or text is None:
                bad.add("the number of columns")
            elif text == "" and key not in may_be_empty:
                bad.add(key)
            elif is_number(text) and not math.isfinite(float(text)):
                bad.add(key)
    return [f"{Path(path).name}: {key}" for key in sorted(bad)]


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


def not_finite_in_vtu(path, may_be_nan=()):
    arrays = vtu_file.read(path)
    return [f"{Path(path).name}: {name}" for (_, name), array in arrays.items()
            if name not in may_be_nan and not numpy.isfinite(array).all()]


def not_finite(folder, told):
    """All that is not finite in a results folder whose summary.json is `told`."""
    folder = Path(folder)
    bad = ["summary.json: " + place for place in not_finite_in(told)]
    bad += not_finite_in_vtu(folder / "result.vtu")
    if told["contact"]:
        bad += not_finite_in_vtu(folder / "contact.vtu", {"gap"})
        bad += not_finite_in_csv(folder / "contact.csv", {"gap"})
        bad += not_finite_in_csv(folder / "contact_centres.csv")
    return bad


def pressures(folder, told, back=lambda x, y: (x, y), factor=1.0):
    """(pair, x, y, p) at the nodes of the multiplier sides, put back by `back` and divided by `factor`."""
    sides = told["method"]["multipliers_on"]
    return [(int(row["pair"]), *back(float(row["x"]), float(row["y"])), float(row["p"]) / factor)
            for row in rows(Path(folder) / "contact.csv") if row["curve"] == sides[int(row["pair"])]]


def largest_displacement(folder):
    return float(numpy.abs(vtu_file.read(Path(folder) / "result.vtu")["PointData", "displacement"]).max())
