"""What must hold after any call of mortise, whatever it was given. Each oracle returns what is wrong, as a text."""

import json
import os
import unicodedata

import results_files
from fuzz_case import REFUSED, SOLVED

LONGEST_LINE = 2000  # characters of a message that somebody will still read
RESULT_FILES = {"result.vtu", "contact.vtu", "contact.csv", "contact_centres.csv", "iteration.csv", "summary.json"}


def crash(case, run, folder):
    if run.status is not None and (run.status < 0 or run.status >= 99) and not run.in_gmsh:
        sanitizer = next((line for line in run.said.splitlines() if "Sanitizer" in line or "runtime error" in line), "")
        return f"ended by signal {-run.status}" if run.status < 0 else f"exit status {run.status}: {sanitizer}"


def hang(case, run, folder):
    if run.status is None:
        return f"not ended after {run.seconds:.0f} s"


def internal_error(case, run, folder):
    if run.status is not None and 0 <= run.status < 99 and run.status not in (0, 1, 2):
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
    names = [name.encode("ascii", "backslashreplace").decode().replace("\\udc", "\\x").replace("\n", "\\n")[:200]
             for name in names] + names  # as messages write them
    if not any(name in run.said for name in [*names, "command line", "--set", "--vary"]):
        return f"no place in {run.said[:200]!r}"


def terminal(case, run, folder):
    """Nothing reaches the terminal that it would obey."""
    for where, text in (("standard output", run.printed), ("standard error", run.said)):
        strange = next((c for c in text if c not in "\n\t" and steers(c)), None)
        if strange and not (run.status == 1 and where == "standard error"):  # one_line says it
            return f"a raw {strange!r} on {where}"


def is_within(path, outputs):
    """Whether a call may write there: below its output, or a folder above it."""
    if "." in outputs and path in RESULT_FILES:  # results into the case's own folder
        return True
    return any(path == output or path.startswith(output.rstrip("/") + "/") or output.startswith(path + "/")
               for output in (os.path.normpath(o) for o in outputs))


def files(case, run, folder):
    """Inputs stand as they were; only results are written, and nothing at all by a call that refuses."""
    for path, what in run.before.items():
        is_input = path in case.files and not is_within(path, case.output)
        stands = is_input or path.endswith("mine.txt") or (run.status == 1 and case.words[0] != "sweep")
        if run.after.get(path) != what and stands:
            return f"{path} was {'changed' if path in run.after else 'removed'}"
    for path in run.after.keys() - run.before.keys():
        may_write = run.status in (0, 2) or case.words[0] == "sweep"
        if may_write and is_within(path, case.output):
            if ".part" not in path and not os.path.basename(path).startswith("."):
                continue
        if run.status in (0, 1, 2):
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
    if run.status == 2 and told["status"] == "solved":
        return "exit status 2, but summary.json says solved"
    if run.status == 0 and (told["status"] != "solved" or failed):
        return f"exit status 0, but summary.json says {told['status']}, failed {failed}"


def finite(case, run, folder):
    """Nothing that is not finite under exit status 0."""
    if run.status != 0:
        return None
    if case.words[0] == "sweep" and "table.csv" in run.after:
        text = open(os.path.join(folder, "table.csv"), "rb").read().lower()
        return "table.csv holds nan or inf" if b",nan," in text or b",inf," in text or b",-inf," in text else None
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
    for path in run.after.keys() - case.files.keys():
        if path.endswith(".csv") and run.status in (0, 2):
            for row in results_files.rows(os.path.join(folder, path)):
                for cell in row.values():
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
        wrong = oracle(case, run, folder)
        if wrong:
            found.append((oracle.__name__, wrong))
            if oracle in (crash, hang, internal_error, verdict):
                break
    return found
