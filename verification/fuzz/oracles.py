"""What must hold after any call of mortise, whatever it was given. Each oracle returns what is wrong, as a text."""

import json
import math
import os
import unicodedata

import results_files
from fuzz_case import REFUSED, SOLVED

LONGEST_LINE = 2000  # characters of a message that somebody will still read
RESULT_FILES = {"result.vtu", "contact.vtu", "contact.csv", "contact_centres.csv", "iteration.csv", "summary.json"}
NO_PRESSURE = 1e-9  # of E u / size: a difference of pressures below is round-off of what the bodies carry


def crash(case, run, folder):
    if run.status is None or 0 <= run.status < 99:
        return None
    sanitizer = next((line for line in run.said.splitlines() if "Sanitizer" in line or "runtime error" in line), "")
    return f"ended by signal {-run.status}" if run.status < 0 else f"exit status {run.status}: {sanitizer}"


def hang(case, run, folder):
    return f"not ended after {run.seconds:.0f} s" if run.status is None else None


def internal_error(case, run, folder):
    if run.status is not None and 2 < run.status < 99:
        return f"exit status {run.status}: {run.said.strip()[:200]!r}"


def steers(character):
    """Controls, what turns a line round, and bytes that are no UTF-8; a character that no font has does no harm."""
    return unicodedata.category(character) in ("Cc", "Cf", "Cs", "Zl", "Zp")


def one_line(case, run, folder):
    """Exit status 1: one printable line that says where."""
    if run.status != 1:
        return None
    lines = run.said.split("\n")
    if lines[-1] != "" or len(lines) != 2 or not lines[0].startswith("mortise: error: "):
        return f"not one line 'mortise: error: ...': {run.said[:200]!r}"
    if strange := next(filter(steers, lines[0]), None):
        return f"a character {strange!r} that is not printable: {lines[0][:200]!r}"
    if len(lines[0]) > LONGEST_LINE:
        return f"a line of {len(lines[0])} characters"


def place(case, run, folder):
    """Exit status 1: the message names a file of the case, an option or the command line."""
    if run.status != 1 or case.words == []:
        return None
    names = [os.path.basename(name) for name in case.files] + [word for word in case.words if word]
    names += [os.path.dirname(name) for name in names if os.path.dirname(name).strip("/")]
    as_written = lambda n: n.encode("ascii", "backslashreplace").decode().replace("\\udc", "\\x").replace("\n", "\\n")
    names += [as_written(name)[:200] for name in names]
    if not any(name in run.said for name in [*names, "command line", "--set", "--vary"]):
        return f"no place in {run.said[:200]!r}"


def terminal(case, run, folder):
    """Nothing reaches the terminal that it would obey; of an error one_line says it."""
    texts = {"standard output": run.printed} | ({"standard error": run.said} if run.status != 1 else {})
    for where, text in texts.items():
        if strange := next((c for c in text if c not in "\n\t" and steers(c)), None):
            return f"a raw {strange!r} on {where}"


def is_within(path, outputs):
    """Whether a call may write there: below its output, or a folder above it."""
    if "." in outputs and path in RESULT_FILES:  # results into the case's own folder
        return True
    return any(path == output or path.startswith(output.rstrip("/") + "/") or output.startswith(path + "/")
               for output in map(os.path.normpath, outputs))


def files(case, run, folder):
    """Inputs stand as they were; only results are written, and nothing at all by a call that refuses."""
    sweeps = case.words[:1] == ["sweep"]
    for path, what in run.before.items():
        is_input = path in case.files and not is_within(path, case.output)
        stands = is_input or path.endswith("mine.txt") or (run.status == 1 and not sweeps)
        if run.after.get(path) != what and stands:
            return f"{path} was {'changed' if path in run.after else 'removed'}"
    for path in run.after.keys() - run.before.keys():
        is_staged = ".part" in path or os.path.basename(path).startswith(".")
        may_write = (run.status in (0, 2) or sweeps) and is_within(path, case.output) and not is_staged
        if run.status in (0, 1, 2) and not may_write:
            return f"{path!r} was left behind"


def verdict(case, run, folder):
    """The exit status, summary.json and the terminal say the same."""
    if run.status == 2 and run.said.strip() == "":
        return "exit status 2 without a word on standard error"
    if run.status not in (0, 2) or case.results is None:
        return None
    try:
        told = results_files.summary(os.path.join(folder, case.results))
    except (OSError, json.JSONDecodeError) as error:
        return f"exit status {run.status}, and summary.json cannot be read: {error}"
    failed = [check["name"] for check in told["checks"] if not check["ok"]]
    if (run.status == 0) != (told["status"] == "solved") or (run.status == 0 and failed):
        return f"exit status {run.status}, but summary.json says {told['status']}, failed {failed}"


def finite(case, run, folder):
    """Nothing that is not finite under exit status 0."""
    if run.status != 0:
        return None
    if case.words[0] == "sweep" and "table.csv" in run.after:
        text = open(os.path.join(folder, "table.csv"), "rb").read().lower()
        return "table.csv holds nan or inf" if any(b",%s," % n in text for n in (b"nan", b"inf", b"-inf")) else None
    if case.results is None:
        return None
    where = os.path.join(folder, case.results)
    try:
        bad = results_files.not_finite(where, results_files.summary(where))
    except Exception as error:  # whatever a reader says of a file that is not what it should be
        return f"a file of the results cannot be read: {type(error).__name__}: {error}"
    return f"not finite: {', '.join(bad[:5])}" if bad else None


def formulas(case, run, folder):
    """No cell of a table is a formula to a spreadsheet."""
    tables = [path for path in run.after.keys() - case.files.keys() if path.endswith(".csv") and run.status in (0, 2)]
    for path in tables:
        for cell in (cell for row in results_files.rows(os.path.join(folder, path)) for cell in row.values()):
            if isinstance(cell, str) and cell[:1] in tuple("=+-@") and not results_files.is_number(cell):
                return f"{path}: a cell {cell[:30]!r}"


def force(case, run, folder):
    """Exit status 0: every contact pair carries what equilibrium asks for."""
    if run.status != 0 or case.thrust is None:
        return None
    for pair in results_files.summary(os.path.join(folder, case.results))["contact"]:
        if not abs(abs(pair["force"][1] or 0) - case.thrust) <= case.accuracy * case.thrust:
            return f"contact force {pair['force'][1]} on {pair['between']}, equilibrium asks for {case.thrust}"


def expectation(case, run, folder):
    """What is surely wrong is refused; what is right is not."""
    if case.expect == REFUSED and run.status in (0, 2):
        return f"exit status {run.status}, though {case.what}"
    if case.expect == SOLVED and run.status == 1:
        return f"refused, though nothing is wrong: {run.said[:200]!r}"


ORACLES = (crash, hang, internal_error, one_line, place, terminal, files, verdict, finite, formulas, force, expectation)


def judge(case, run, folder):
    """[(oracle, what is wrong)]: those after a crash, or without results to be read, are not asked."""
    found = []
    for oracle in ORACLES:
        if wrong := oracle(case, run, folder):
            found.append((oracle.__name__, wrong))
            if oracle in (crash, hang, internal_error, verdict):
                break
    return found


# ---- Twins: two calls on the same problem, said or solved in two ways ----


def size_of(setting):
    return math.hypot(*(max(values) - min(values) for values in zip(*setting.mesh.nodes)))


def least_pressure(results, setting):
    young = max(material["young"] for material in setting.scene["materials"].values())
    return NO_PRESSURE * young * results_files.largest_displacement(results) / size_of(setting)


def difference(first, second, size):
    """Largest difference of p between the same places of two tables, and the place; None where places do not match."""
    worst, rest = (0.0, None), list(second)
    for pair, x, y, p in first:
        near = next((r for r in rest if r[0] == pair and math.hypot(r[1] - x, r[2] - y) < 1e-6 * size), None)
        if near is None:
            return None
        rest.remove(near)
        worst = max(worst, (abs(near[3] - p), (x, y)), key=lambda entry: entry[0])
    return None if rest else worst


def compare(setting, twin, first, second, folder, other):
    """What differs between the call in `folder` and its twin in `other`, or None; p only where both are solved."""
    results, others = (os.path.join(where, "results") for where in (folder, other))
    if twin.same_verdict and first.status != second.status and not borderline(first, results, second, others):
        return f"{twin.name}: exit status {second.status} instead of {first.status} {second.said.strip()[:150]!r}"
    if first.status != 0 or second.status != 0:
        return None
    told, told_other = results_files.summary(results), results_files.summary(others)
    if not told["contact"]:
        return None
    p = results_files.pressures(results, told)
    q = results_files.pressures(others, told_other, twin.back, twin.factor)
    found = difference(p, q, size_of(setting))
    if found is None:
        return f"{twin.name}: multipliers on {told_other['method']['multipliers_on']} at other places"
    largest = max(abs(row[3]) for row in p)
    if found[0] > max(twin.limit * largest, least_pressure(results, setting)):
        return f"{twin.name}: p differs by {found[0]:.2g} at {found[1]}, the largest is {largest:.2g}"


def borderline(first, results, second, others):
    """Whether a check stands so near its limit that round-off may turn it."""
    if {first.status, second.status} != {0, 2}:
        return False
    checks = [check for where in (results, others) for check in results_files.summary(where)["checks"]]
    return any(check["value"] is not None and 0.99 < check["value"] / check["limit"] < 1.01 for check in checks)
