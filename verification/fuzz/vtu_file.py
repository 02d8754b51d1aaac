"""The arrays of a .vtu file whose data is appended raw, which is how mortise writes them.

Not by meshio: it looks for the ends of the arrays in the raw bytes, and loses its way in some of them.
"""

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy

TYPES = {"Float64": "<f8", "Float32": "<f4", "Int32": "<i4", "Int64": "<i8", "UInt8": "u1"}
LENGTH = 8  # bytes of the length before each array (header_type UInt64)


class VtuError(Exception):
    """The file is not what it should be."""


def read(path):
    """{(section, name): array} of the one piece, one row a point or cell; sections as in the file: PointData, ..."""
    data = Path(path).read_bytes()
    mark = b'<AppendedData encoding="raw">'
    head, found, raw = data.partition(mark)
    if not found:
        raise VtuError("no raw data")
    raw = raw[raw.index(b"_") + 1 :]
    root = ElementTree.fromstring(head + b"</VTKFile>")
    if root.get("header_type") != "UInt64":
        raise VtuError(f"header_type {root.get('header_type')}")
    piece = root.find("UnstructuredGrid/Piece")
    counts = {"PointData": "NumberOfPoints", "Points": "NumberOfPoints", "CellData": "NumberOfCells"}
    arrays = {}
    for section in piece:
        for entry in section:
            array = one_array(raw, entry)
            if section.tag in counts and len(array) != int(piece.get(counts[section.tag])):
                raise VtuError(f"{entry.get('Name')} has {len(array)} rows")
            arrays[section.tag, entry.get("Name")] = array
    return arrays


def one_array(raw, entry):
    start = int(entry.get("offset"))
    length = int.from_bytes(raw[start : start + LENGTH], "little")
    content = raw[start + LENGTH : start + LENGTH + length]
    if len(content) != length:
        raise VtuError(f"{entry.get('Name')} ends early")
    array = numpy.frombuffer(content, TYPES[entry.get("type")])
    return array.reshape(-1, int(entry.get("NumberOfComponents", 1)))
