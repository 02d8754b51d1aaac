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


def contact_table(folder, centres=False):
    """The columns of contact.csv, or of the centres of its edges, contact_centres.csv, with its gap and the half of each
    edge's length. What faces nothing has no p there, nor -sigma_n to compare it with: NaN."""
    table = nodes = columns(Path(folder) / "contact.csv")
    if centres:
        table = columns(Path(folder) / "contact_centres.csv")
        table |= {"gap": np.full(len(table["s"]), np.nan), "half": np.zeros(len(table["s"]))}
        for pair, curve in set(zip(table["pair"], table["curve"])):
            edges, ends = ((t["pair"] == pair) & (t["curve"] == curve) for t in (table, nodes))
            s, middles = nodes["s"][ends], table["s"][edges]
            table["gap"][edges] = np.interp(middles, s, nodes["gap"][ends])
            table["half"][edges] = middles - s[np.searchsorted(s, middles) - 1]
    for name in table.keys() & {"p", "p_error", "sigma_n"}:
        table[name] = np.where(np.isfinite(table["gap"]), table[name], np.nan)
    return table


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


def closing_of(table, side):
    """How far the last place of a closed curve is from its first; 0 of an open one."""
    rows = np.flatnonzero(side)
    s, places = table["s"][rows], np.stack([table["x"][rows], table["y"][rows]], axis=1)
    closing = np.linalg.norm(places[0] - places[-1])
    return closing if len(s) > 2 and closing < 1.5 * max(s[1] - s[0], s[-1] - s[-2]) and closing < 0.2 * np.ptp(s) else 0.0


def line_of(table, side):
    """Row numbers of a side (rows of contact.csv) in the order in which they are drawn, and their arc lengths. A closed curve that carries
    pressure across its first node is drawn from the middle of where it carries none, with s below 0 before that node."""
    rows, closing = np.flatnonzero(side), closing_of(table, side)
    s, p = table["s"][rows], np.nan_to_num(table["p"][rows])
    free = np.flatnonzero(p <= 1e-9 * p.max())
    if not closing or len(free) == 0 or free[0] == 0 or free[-1] == len(s) - 1:
        return rows, s
    parts = np.split(free, np.flatnonzero(np.diff(free) > 1) + 1)
    longest = max(parts, key=lambda part: s[part[-1]] - s[part[0]])
    first = longest[len(longest) // 2]
    return np.roll(rows, -first), np.concatenate([s[first:] - np.ptp(s) - closing, s[:first]])


def nearest_on(along, s, points):
    """Arc length at the place of the polyline `along` nearest to each point, and the distance to there."""
    start, step = along[:-1], np.diff(along, axis=0)
    from_start = points[:, None, :] - start[None]
    t = np.clip((from_start * step).sum(axis=2) / (step**2).sum(axis=1), 0, 1)
    distance = np.linalg.norm(from_start - t[..., None] * step, axis=2)
    nearest, row = distance.argmin(axis=1), np.arange(len(points))
    return s[nearest] + t[row, nearest] * np.diff(s)[nearest], distance[row, nearest]


def arc_length_on(along, s, points):
    return nearest_on(along, s, points)[0]
