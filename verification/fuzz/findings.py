"""Findings as folders that can be run again, and the table at the end."""

import os
import shlex
from collections import Counter


def shell_word(word):
    """A word for bash that survives line breaks, control characters and bytes that are no UTF-8."""
    if word.isprintable() and "\udc80" not in word:
        return shlex.quote(word)
    data = word.encode("utf-8", "surrogateescape")
    return "$'" + "".join(chr(b) if 32 <= b < 127 and chr(b) not in "'\\" else f"\\x{b:02x}" for b in data) + "'"


def script(program, case):
    lines = ["#!/usr/bin/env bash", f"# {case.kind}: {printable(case.what)}", 'cd "$(dirname "$0")/files"']
    if case.largest_file is not None:
        lines.append(f"trap '' XFSZ; # files of at most {case.largest_file} bytes: needs prlimit")
    limit = [] if case.largest_file is None else ["prlimit", f"--fsize={case.largest_file}"]
    words = " ".join([*limit, '"${MORTISE:-' + program.path + '}"', *map(shell_word, case.words)])
    return "\n".join([*lines, words, 'echo "exit status $?"']) + "\n"


def printable(text):
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)


def store(folder, name, program, case, outcome, found):
    """Writes the files as they were, a script that repeats the call, and what was wrong."""
    os.makedirs(folder / "files", exist_ok=True)
    case.write(folder / "files")
    for k, twin in enumerate(case.twins):
        os.makedirs(folder / f"twin_{k}/files", exist_ok=True)
        twin.case.write(folder / f"twin_{k}/files")
        write_script(folder / f"twin_{k}/repeat.sh", script(program, twin.case))
    write_script(folder / "repeat.sh", script(program, case))
    lines = [f"{name}  {case.kind}: {printable(case.what)}"]
    lines += [f"exit status {outcome.status} after {outcome.seconds:.1f} s"]
    lines += [f"{oracle}: {printable(wrong)}" for oracle, wrong in found]
    lines += ["standard error:", outcome.said[:5000]]
    (folder / "finding.txt").write_text("\n".join(lines), errors="surrogateescape")


def write_script(path, text):
    path.write_text(text, errors="surrogateescape")
    path.chmod(0o755)


def table(done):
    """A row a kind of case: how the calls ended, and what was found."""
    columns = ["cases", "0", "1", "2", "other", "found"]
    counts = {}
    for _, case, outcome, found in done:
        row = counts.setdefault(case.kind, Counter())
        row["cases"] += 1
        row[str(outcome.status) if outcome.status in (0, 1, 2) else "other"] += 1
        row["found"] += bool(found)
        row.update({f"oracle {oracle}" for oracle, _ in found})
    lines = ["", f"{'kind of case':14}" + "".join(f"{c:>7}" for c in columns) + "  by oracle"]
    for kind, row in sorted(counts.items()):
        by = ", ".join(f"{key[7:]} {n}" for key, n in sorted(row.items()) if key.startswith("oracle "))
        lines.append(f"{kind:14}" + "".join(f"{row[c]:7}" for c in columns) + "  " + by)
    return "\n".join(lines)
