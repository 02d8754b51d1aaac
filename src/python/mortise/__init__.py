"""mortise from Python: solve a scene without files, or read the results that the program wrote.

    import mortise
    run = mortise.solve("punch.toml", {"accuracy.value": "1%"})
    run.s, run.p, run.p_error                    # along the contact line

`solve` needs the compiled part (./dev build); `read` needs numpy only. docs/python.md.
"""

import contextlib
import csv
import itertools
import json
import os
import re
import tempfile
import threading
from concurrent import futures
from pathlib import Path
from typing import NamedTuple

import numpy as np

try:
    from ._mortise import InputError
except ImportError:  # only the reader is there
    InputError = ValueError

__all__ = ["Gradients", "InputError", "Results", "cases", "gradient", "read", "solve", "sweep"]


class Results:
    """What a run found, as arrays.

    contact  columns of contact.csv by name: pair, curve, s, x, y, u_n, p, gap, sigma_n, sigma_2, p_error and p_multiplier if estimated,
             p_fluid if a fluid gets into a gap
    x, u     places and displacements (n, 2) of the points of result.vtu; stress (n, 4): 11, 22, 33, 12
             (not of a case that [cases] write = "contact" left without them)
    summary  summary.json (docs/files.md); status and checks of it
    s, p, p_error, gap: of the first pair's multiplier side, in the order of s; of another: side(curve)
    """

    def __init__(self, contact, fields, summary):
        self.contact = contact
        vars(self).update(fields)
        self.summary = summary
        self.status = summary["status"]
        self.checks = {check["name"]: check for check in summary["checks"]}

    def __getattr__(self, name):
        if name in ("x", "u", "stress"):
            raise AttributeError(f'{name}: the folder has no result.vtu; expected a scene with [cases] write = "all"')
        raise AttributeError(name)

    def side(self, curve, pair=None):
        """The columns of `contact` along one curve, which is in several pairs only with the number of one."""
        here = self.contact["curve"] == curve
        if not here.any():
            raise KeyError(f"no contact curve '{curve}'; known: {', '.join(dict.fromkeys(self.contact['curve']))}")
        pairs = sorted({int(k) for k in self.contact["pair"][here]})
        if pair is None and len(pairs) > 1:
            raise KeyError(f"curve '{curve}' is in the pairs {', '.join(map(str, pairs))}; expected side('{curve}', pair)")
        if pair is not None and pair not in pairs:
            raise KeyError(f"curve '{curve}' is not in pair {pair}; its pairs: {', '.join(map(str, pairs))}")
        here &= True if pair is None else self.contact["pair"] == pair
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

    with _file_of(scene) as path:
        return _results(*_mortise.solve(path, _words(changes), estimate, case))


def cases(scene, changes=None, estimate=True):
    """Solves all cases of a scene, on one mesh and one factor where only loads differ: the columns of cases.csv by name, as
    arrays with a value a case. Of keys that cases change these are words, as are "case" and "status" ("solved", or
    "bad input: ..." of a case without a solution, whose figures are nan)."""
    from . import _mortise

    with _file_of(scene) as path:
        words, numbers = _mortise.cases(path, _words(changes), estimate)
    words["status"] = [_of_dict(scene, path, status) for status in words["status"]]
    table = {name: np.array(column) for name, column in words.items()} | numbers
    if "scale" in table:
        table["scale"] = table["scale"].astype(float)
    return table


_group = 4  # runs of one task: each starts from the rows that were closed in the one before
_worker = threading.local()


def sweep(scene, vary, executor=None, changes=None):
    """Solves every combination of the values of `vary`, {"boundary.2.pressure": [1e6, 2e6], ...}, the last key fastest, by
    any executor of concurrent.futures; without one here, run by run. Returns the columns of the table of `mortise sweep` by
    name, as arrays with a value a run: those of `vary`, "status" ("solved", or "bad input: ..." of a run whose figures are
    nan), figures. Raises InputError where no run can be read. They do not depend on the executor, but for the seconds. Files that the scene names must be there for all
    workers; a worker keeps the last mesh and factor, and if it is another process it has one thread. Where a process of the
    executor is killed, processes of our own do what it left; a run that kills two of these raises BrokenExecutor."""
    from . import _mortise

    runs = list(itertools.product(*(_listed(key, values) for key, values in _dict("vary", vary).items())))
    words = [_words(_dict("changes", changes or {}) | dict(zip(vary, run))) for run in runs]
    groups = [words[k : k + _group] for k in range(0, len(words), _group)]
    scene = _anywhere(scene)
    with _file_of(scene) as path:
        if refusal := _mortise.refusal(path, words):
            raise InputError(refusal)
    if executor is None:
        solver = _mortise.Solver()
        done = [_rows(scene, group, solver) for group in groups]
    else:
        done = _by_workers(executor, scene, groups)
    rows = list(itertools.chain.from_iterable(done))
    table = {key: np.array(column) for key, column in zip(vary, zip(*runs))}
    table["status"] = np.array([status for status, _ in rows])
    for k, (_, figures) in enumerate(rows):
        for name, value in figures:
            table.setdefault(name, np.full(len(rows), np.nan))[k] = value
    return table


class Gradients(NamedTuple):
    """value of the figures (n); derivative of each by each parameter (n, m); between (m, 2): the values of a parameter, the
    others as they are, between which no row of contact opens or closes (of moduli and what else the equations are not linear
    in, as far as the tangents tell). Elsewhere the derivatives are others: at such a value they are of one side."""

    value: np.ndarray
    derivative: np.ndarray
    between: np.ndarray


def gradient(scene, of, by, changes=None):
    """How figures change with numbers of the scene. `by`: {"boundary.2.pressure": 1e6, "constants.crown": 2e-6, ...}: loads,
    prescribed values, gaps, moduli or constants that expressions name, and what they are here. `of`: figures by their
    columns of cases.csv: "energy", "probe.0.u_x", "contact.0.force.y", "contact.0.pressure.mean", also of a window,
    ("contact.0.pressure.mean", 0.1, 0.3), and ("contact.0.pressure.norm", 8): (int p^8 dA / int dA)^(1/8). A thread keeps the
    mesh and the factor for its next call."""
    figures = [(name, []) if isinstance(name, str) else (name[0], list(name[1:])) for name in _listed("of", of)]
    here = [(key, _number(key, value)) for key, value in _dict("by", by).items()]
    with _file_of(_anywhere(scene)) as path:
        return Gradients(*_own_solver().gradient(path, _words(changes), figures, here))


def _dict(name, values):
    if not isinstance(values, dict):
        raise InputError(f"{name}: expected a dict of keys and values, found {values!r}")
    return values


def _words(changes):
    return [(key, _toml(value, key)) for key, value in _dict("changes", changes or {}).items()]


def _number(key, value):
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if isinstance(value, bool) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise InputError(f"{key}: expected a number, found {value!r}")
    return float(value)


def _listed(name, values):
    if isinstance(values, (str, dict)) or not np.iterable(values):
        raise InputError(f"{name}: expected a list, found {values!r}")
    return list(values)


def _own_solver():
    """Of the thread."""
    from . import _mortise

    if not hasattr(_worker, "solver"):
        _worker.solver = _mortise.Solver()
    return _worker.solver


def _by_workers(executor, scene, groups):
    done = {}
    whole = _done_by(executor, scene, groups, done)
    while not whole:
        before = len(done)
        with futures.ProcessPoolExecutor(getattr(executor, "_max_workers", None)) as own:
            whole = _done_by(own, scene, groups, done)
        if not whole and len(done) == before:
            raise futures.BrokenExecutor("a run of the sweep ends each process that solves it")
    return [done[k] for k in range(len(groups))]


def _done_by(executor, scene, groups, done):
    """Adds the groups that are missing; False where one of the executor's processes was killed."""
    tasks = {}
    try:
        for k in range(len(groups)):
            if k not in done:
                tasks[executor.submit(_task, os.getpid(), scene, groups[k])] = k
        futures.wait(tasks, return_when=futures.FIRST_EXCEPTION)
        for task in tasks:
            if task.done():
                task.result()
    except futures.BrokenExecutor:
        return False
    finally:
        for task, k in tasks.items():
            if not task.cancel() and task.done() and not task.exception():
                done[k] = task.result()
    return True


def _task(caller, scene, group):
    if os.getpid() != caller:
        from . import _mortise

        _mortise.set_threads(1)
    return _rows(scene, group, _own_solver())


def _rows(scene, group, solver):
    with _file_of(scene) as path:
        return [(_of_dict(scene, path, status), figures) for status, figures in solver.rows(path, group)]


def read(folder):
    """The results that `mortise solve` wrote into a folder; of a scene with cases those of one, in cases/NAME of it."""
    folder = Path(folder)
    if (folder / "cases.csv").exists():
        raise InputError(f"{folder}: the cases of a scene; expected the folder cases/NAME of one of them")
    if not (folder / "summary.json").exists():
        raise InputError(f"{folder}: no summary.json there; expected the folder of a run of mortise solve")
    contact = _columns(folder / "contact.csv") if (folder / "contact.csv").exists() else {}
    fields = {}
    if (folder / "result.vtu").exists() or not contact:
        arrays = _appended(folder / "result.vtu")
        fields = {"x": arrays["Points"][:, :2], "u": arrays["displacement"][:, :2], "stress": arrays["stress"]}
    return Results(contact, fields, json.loads((folder / "summary.json").read_text()))


def _results(contact, fields, summary):
    return Results({name: np.asarray(column) for name, column in contact.items()}, fields, json.loads(summary))


def _anywhere(scene):
    """The same in any working directory."""
    if not isinstance(scene, dict):
        return os.path.abspath(scene)
    return scene | {name: _with_whole_paths(scene[name]) for name in ("mesh", "fields", "case") if name in scene}


def _with_whole_paths(value):
    """Tables, with what they call `file` from the root on."""
    if isinstance(value, (list, tuple)):
        return [_with_whole_paths(item) for item in value]
    if not isinstance(value, dict):
        return value
    whole = {key: _with_whole_paths(item) for key, item in value.items()}
    if isinstance(whole.get("file"), (str, os.PathLike)):
        whole["file"] = os.path.abspath(whole["file"])
    return whole


@contextlib.contextmanager
def _file_of(scene):
    """The path of a scene, that of a dict for as long as it is asked for."""
    if not isinstance(scene, dict):
        yield os.fspath(scene)
        return
    tables = _anywhere(scene)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_text("".join(f"{_key(key)} = {_toml(value, key)}\n" for key, value in tables.items()))
        try:
            yield str(path)
        except InputError as error:
            raise InputError(_of_dict(scene, path, str(error))) from None


def _of_dict(scene, path, words):
    """A message about a scene; of a dict without its file, which is there no more."""
    return re.sub(re.escape(str(path)) + r"(:\d+)*: ", "", words) if isinstance(scene, dict) else words


def _key(key):
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else json.dumps(key, ensure_ascii=False)


def _toml(value, key):
    """A value as TOML writes it, tables inline; `key` for messages."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(of)} = {_toml(item, f'{key}.{of}')}" for of, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(item, key) for item in value) + "]"
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if not isinstance(value, (str, os.PathLike)):
        raise InputError(f"{key}: expected a number, a text, a list or a dict, found {value!r}")
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
