"""The tables that mortise writes, column by column, and the two sides of a contact pair in them."""

import csv
import math
import re
from pathlib import Path

import numpy as np

NAMES = ("curve", "body")  # columns of names


def number_or_text(text):
    try:
        return float(text)
    except ValueError:
        return text


def name_in_table(text):
    """A name as it is: mortise puts an apostrophe before one that a spreadsheet would take for a formula."""
    return text[1:] if re.match(r"'[=+\-@\t\r]", text) else text


def read_csv(path):
    """The rows of a CSV file: dictionaries of numbers and texts. A name is a text, whatever it looks like."""
    of = lambda key, text: name_in_table(text) if key in NAMES else number_or_text(text)
    with open(path, newline="") as file:
        return [{key: of(key, value) for key, value in row.items()} for row in csv.DictReader(file)]


def columns(path):
    """The columns of a CSV file: arrays of numbers, NaN where nothing stands, or of texts."""
    table = read_csv(path)
    lists = {key: [row[key] for row in table] for key in (table[0] if table else {})}
    is_text = lambda values: any(isinstance(value, str) and value for value in values)
    of = lambda values: np.array(values if is_text(values) else [math.nan if v == "" else v for v in values])
    return {key: of(values) for key, values in lists.items()}


def contact(folder, curve=None, table="contact.csv"):
    """Columns of a table of the contact line, of one curve: by default of the first pair's multiplier side."""
    found = columns(Path(folder) / table)
    here = found["curve"] == (curve or found["curve"][0])
    return {key: values[here] for key, values in found.items()}


def sides_of(table, pair):
    """Which rows of contact.csv are the multiplier side of a pair, which stands first there, and which its opposite."""
    on = table["pair"] == pair
    first = on & (table["curve"] == table["curve"][on][0])
    return first, on & ~first


def arc_length_on(along, s, points):
    """Arc length at the place of the polyline `along` nearest to each point."""
    start, step = along[:-1], np.diff(along, axis=0)
    from_start = points[:, None, :] - start[None]
    t = np.clip((from_start * step).sum(axis=2) / (step**2).sum(axis=1), 0, 1)
    distance = np.linalg.norm(from_start - t[..., None] * step, axis=2)
    nearest, row = distance.argmin(axis=1), np.arange(len(points))
    return s[nearest] + t[row, nearest] * np.diff(s)[nearest]
