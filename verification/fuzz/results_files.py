"""What the files of a results folder say, read by other means than mortise's own."""

import csv
import json
import math
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy

# Keys of summary.json that are null where they do not apply.
NONE_ALLOWED = {"accuracy.largest", "iteration", "inf_sup", "accuracy", "accuracy.value", "estimate.pressure", "ends", "matrix",
                "contact.pressure.error", "accuracy.solves.estimated"}  # numbers of lists left out
TYPES = {"Float64": "<f8", "Float32": "<f4", "Int32": "<i4", "Int64": "<i8", "UInt8": "u1"}  # of VTK
LENGTH = 8  # bytes of the length before each array of a .vtu file (header_type UInt64)


def vtu_arrays(path):
    """{(section, name): array} of a .vtu file of one piece with appended raw data, one row a point or cell; sections as
    in the file: PointData, ... ValueError if it is not what it should be. Not by meshio: it looks for the ends of the
    arrays in the raw bytes, and loses its way in some of them."""
    head, found, raw = Path(path).read_bytes().partition(b'<AppendedData encoding="raw">')
    if not found:
        raise ValueError("no raw data")
    raw, root = raw[raw.index(b"_") + 1 :], ElementTree.fromstring(head + b"</VTKFile>")
    if root.get("header_type") != "UInt64":
        raise ValueError(f"header_type {root.get('header_type')}")
    piece, arrays = root.find("UnstructuredGrid/Piece"), {}
    counts = {"PointData": "NumberOfPoints", "Points": "NumberOfPoints", "CellData": "NumberOfCells"}
    for section, entry in ((section, entry) for section in piece for entry in section):
        name, start = entry.get("Name"), int(entry.get("offset"))
        end = start + LENGTH + int.from_bytes(raw[start : start + LENGTH], "little")
        if len(raw) < end:
            raise ValueError(f"{name} ends early")
        array = numpy.frombuffer(raw[start + LENGTH : end], TYPES[entry.get("type")])
        array = array.reshape(-1, int(entry.get("NumberOfComponents", 1)))
        if section.tag in counts and len(array) != int(piece.get(counts[section.tag])):
            raise ValueError(f"{name} has {len(array)} rows")
        arrays[section.tag, name] = array
    return arrays


def summary(folder):
    return json.loads((Path(folder) / "summary.json").read_text(), parse_constant=float)


def rows(path):
    with open(path, newline="", encoding="utf-8", errors="surrogateescape") as file:
        return list(csv.DictReader(file))


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


def not_finite_in(value, place=""):
    """Keys of summary.json with a number that is not finite, which mortise writes as null."""
    if not isinstance(value, (dict, list)):
        bad = value is None or (isinstance(value, float) and not math.isfinite(value))
        keys = [key for key in place.split(".") if not key.isdigit()]
        return [place] if bad and not {".".join(keys), keys[-1]} & NONE_ALLOWED else []
    entries = value.items() if isinstance(value, dict) else enumerate(value)
    return [found for key, entry in entries for found in not_finite_in(entry, f"{place}.{key}" if place else str(key))]


def not_finite_in_csv(path, may_be_empty=()):
    """Columns of a table with an empty or non-finite number."""
    bad = set()
    for key, text in (cell for row in rows(path) for cell in row.items()):
        if key is None or text is None:
            bad.add("the number of columns")
        elif (text == "" and key not in may_be_empty) or (is_number(text) and not math.isfinite(float(text))):
            bad.add(key)
    return [f"{path.name}: {key}" for key in sorted(bad)]


def not_finite_in_vtu(path, may_be_nan=()):
    return [f"{path.name}: {name}" for (_, name), array in vtu_arrays(path).items()
            if name not in may_be_nan and not numpy.isfinite(array).all()]


def singular_points(told):
    return ((told["estimate"] or {}).get("pressure") or {}).get("singular", [])


def not_finite(folder, told):
    """All that is not finite in a results folder whose summary.json is `told`."""
    folder = Path(folder)
    without_limit = {f"contact.{at['pair']}.pressure.max_error" for at in singular_points(told) if at["unbounded"]}
    bad = ["summary.json: " + place for place in not_finite_in(told) if place not in without_limit] + not_finite_in_vtu(folder / "result.vtu")
    if told["contact"]:
        bad += not_finite_in_vtu(folder / "contact.vtu", {"gap", "p_error"})
        bad += not_finite_in_csv(folder / "contact.csv", {"gap", "p_error"}) + not_finite_in_csv(folder / "contact_centres.csv")
    return bad


def pressures(folder, told, back=lambda x, y: (x, y), factor=1.0):
    """(pair, x, y, p of the multiplier) at the nodes of the multiplier sides, put back by `back` and divided by `factor`."""
    sides = told["method"]["multipliers_on"]
    return [(int(row["pair"]), *back(float(row["x"]), float(row["y"])), float(row.get("p_multiplier", row["p"])) / factor)
            for row in rows(Path(folder) / "contact.csv") if row["curve"] == sides[int(row["pair"])]]


def largest_displacement(folder):
    return float(numpy.abs(vtu_arrays(Path(folder) / "result.vtu")["PointData", "displacement"]).max())
