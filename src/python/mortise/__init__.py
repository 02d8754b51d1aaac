"""mortise from Python: solve a scene without files, or read the results that the program wrote.

    import mortise
    run = mortise.solve("punch.toml", {"accuracy.value": "1%"})
    run.s, run.p, run.p_error                    # along the contact line

`solve` needs the compiled part (./dev build); `read` needs numpy only. docs/python.md.
"""

import contextlib
import csv
import json
import os
import re
import tempfile
from pathlib import Path

import numpy as np

try:
    from ._mortise import InputError
except ImportError:  # only the reader is there
    InputError = ValueError

__all__ = ["InputError", "Results", "cases", "read", "solve"]


class Results:
    """What a run found, as arrays.

    contact  columns of contact.csv by name: pair, curve, s, x, y, u_n, p, gap, sigma_n, sigma_2, and p_error if estimated
    x, u     places and displacements (n, 2) of the points of result.vtu; stress (n, 4): 11, 22, 33, 12
    summary  summary.json (docs/files.md); status and checks of it
    s, p, p_error, gap: of the first pair's multiplier side, in the order of s; of another: side(curve)
    """

    def __init__(self, contact, fields, summary):
        self.contact = contact
        self.x, self.u, self.stress = fields["x"], fields["u"], fields["stress"]
        self.summary = summary
        self.status = summary["status"]
        self.checks = {check["name"]: check for check in summary["checks"]}

    def side(self, curve):
        """The columns of `contact` along one curve."""
        here = self.contact["curve"] == curve
        if not here.any():
            raise KeyError(f"no contact curve '{curve}'; known: {', '.join(dict.fromkeys(self.contact['curve']))}")
        return {name: column[here] for name, column in self.contact.items()}

    def _first(self, name):
        if not self.summary["contact"]:
            raise KeyError(f"{name}: the scene has no contact pair")
        pair, side = self.contact["pair"], self.summary["method"]["multipliers_on"][0]
        if name not in self.contact:
            raise KeyError(f"{name}: the run estimated no error")
        return self.contact[name][(pair == 0) & (self.contact["curve"] == side)]

    s = property(lambda self: self._first("s"))
    p = property(lambda self: self._first("p"))
    p_error = property(lambda self: self._first("p_error"))
    gap = property(lambda self: self._first("gap"))


def solve(scene, changes=None, estimate=True, case=""):
    """Meshes and solves a scene: the path of a .toml or its tables as a dict, in which mesh.file is relative to the
    working directory. `changes`: {"materials.steel.young": 70e9, ...} as `mortise solve --set`. Writes no files. Raises
    InputError (a ValueError) with the words of the program; whether all checks hold is Results.status. `case`: the name of
    the one of the scene's [[case]] entries that is solved."""
    from . import _mortise

    words = [(key, _toml(value)) for key, value in (changes or {}).items()]
    with _file_of(scene) as path:
        return _results(*_mortise.solve(path, words, estimate, case))


def cases(scene, changes=None, estimate=True):
    """Solves all cases of a scene, on one mesh and one factor where only loads differ: the columns of cases.csv by name, as
    arrays with a value a case. Of keys that cases change these are words, as are "case" and "status" ("solved", or
    "bad input: ..." of a case without a solution, whose figures are nan)."""
    from . import _mortise

    with _file_of(scene) as path:
        words, numbers = _mortise.cases(path, [(key, _toml(value)) for key, value in (changes or {}).items()], estimate)
    table = {name: np.array(column) for name, column in words.items()} | numbers
    if "scale" in table:
        table["scale"] = table["scale"].astype(float)
    return table


def read(folder):
    """The results that `mortise solve` wrote into a folder."""
    folder = Path(folder)
    contact = _columns(folder / "contact.csv") if (folder / "contact.csv").exists() else {}
    arrays = _appended(folder / "result.vtu")
    fields = {"x": arrays["Points"][:, :2], "u": arrays["displacement"][:, :2], "stress": arrays["stress"]}
    return Results(contact, fields, json.loads((folder / "summary.json").read_text()))


def _results(contact, fields, summary):
    return Results({name: np.asarray(column) for name, column in contact.items()}, fields, json.loads(summary))


@contextlib.contextmanager
def _file_of(scene):
    """The path of a scene, that of a dict for as long as it is asked for."""
    if not isinstance(scene, dict):
        yield os.fspath(scene)
        return
    tables = dict(scene)
    if isinstance(tables.get("mesh"), dict) and isinstance(tables["mesh"].get("file"), (str, os.PathLike)):
        tables["mesh"] = tables["mesh"] | {"file": os.path.abspath(tables["mesh"]["file"])}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_text("".join(f"{_key(key)} = {_toml(value)}\n" for key, value in tables.items()))
        yield str(path)


def _key(key):
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else json.dumps(key, ensure_ascii=False)


def _toml(value):
    """A value as TOML writes it, tables inline."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(key)} = {_toml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(_toml(item) for item in value) + "]"
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    return json.dumps(os.fspath(value), ensure_ascii=False)


def _columns(path):
    with open(path, newline="") as file:
        names, *rows = csv.reader(file)
    columns = dict(zip(names, zip(*rows))) if rows else {name: () for name in names}
    number = lambda text: float(text) if text else np.nan
    read = {name: [number(text) for text in column] for name, column in columns.items() if name != "curve"}
    read["pair"] = [int(k) for k in read["pair"]]
    return {name: np.array(read.get(name, columns[name])) for name in names}


def _appended(path):
    """The arrays of numbers in a .vtu as mortise writes it: raw, appended, each after its length in 8 bytes."""
    data = Path(path).read_bytes()
    start = data.index(b"_", data.index(b"<AppendedData")) + 1
    arrays = {}
    for tag in re.findall(r"<DataArray [^>]*>", data[:start].decode("utf-8", "replace")):
        attributes = dict(re.findall(r'(\w+)="([^"]*)"', tag))
        if attributes["type"] != "Float64":
            continue
        at = start + int(attributes["offset"])
        length = int.from_bytes(data[at : at + 8], "little")
        values = np.frombuffer(data, "<f8", length // 8, at + 8)
        arrays[attributes["Name"]] = values.reshape(-1, int(attributes.get("NumberOfComponents", 1)))
    return arrays
