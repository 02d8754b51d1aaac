"""What a sweep writes: its table, and the groups of runs that are complete."""

import contextlib
import hashlib
import itertools
import json
import os
import re
import stat
from pathlib import Path

JOURNAL = "mortise sweep: runs that are complete"


class Refused(Exception):
    """Bad input: its message."""


def printable(text):
    """Without characters that could steer a terminal."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape", "surrogatepass").decode() for c in text)


def check_target(path, scene, ours):
    """It is not there yet, or empty or `ours` by its first line, and not the scene."""

    def refuse(why):
        raise Refused(f"{path}: cannot be written: {why}")

    try:
        mode = path.stat().st_mode
        if stat.S_ISDIR(mode):
            refuse("it is a folder; expected a file")
        if not stat.S_ISREG(mode):
            refuse("it is a device or a pipe")
        if scene.exists() and path.samefile(scene):
            refuse(f"it is the input {scene}")
        with open(path, encoding="utf-8", errors="replace") as file:
            first = file.readline(1 << 16).rstrip("\n")
        if first and not ours(first):
            refuse("a file of this name is there that mortise did not write; choose another name or remove it")
    except FileNotFoundError:
        if not Path(os.path.realpath(path)).parent.is_dir():  # of what a link names
            refuse("no such folder")
    except OSError as error:
        refuse(error.strerror)


def is_table(header):
    """Its columns end with "status", or go on with the figures. No scene, geometry or mesh begins so."""
    return header.endswith(",status") or ",status,nodes,elements,dofs," in header


def field(word):
    """A word as it stands in a table, as output/csv writes it: what a spreadsheet would take for a formula is text."""
    formula = word[:1] in tuple("=+-@\t\r") and not re.fullmatch(r"-?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?|-?(inf|nan)(inity)?", word, re.I)
    if not formula and not re.search(r'[,;"\t\r\n]', word):
        return word
    return '"' + "'" * formula + word.replace('"', '""') + '"'


def fields(line):
    """The fields of a line as they stand there, with their quotes. A field has no end of line in it."""
    return re.findall(r'((?:[^,"]|"[^"]*"?)*),', line + ",")


def write_lines(path, lines):
    """In one step, through symbolic links."""
    target = Path(os.path.realpath(path))
    staged = target.with_name(f".{target.stem}.new.mortise{target.suffix}")
    try:
        with open(staged, "w", encoding="utf-8", newline="") as file:
            file.writelines(line + "\n" for line in lines)
        os.replace(staged, target)
    except OSError as error:
        with contextlib.suppress(OSError):
            staged.unlink()
        raise Refused(f"{path}: cannot be written: {error.strerror}") from None


def write_table(path, keys, runs, rows):
    """`rows`: by number of the run. Columns stand in the order in which they first appear."""
    names = dict.fromkeys(itertools.chain.from_iterable(rows[k]["figures"] for k in sorted(rows)))
    lines = [",".join(map(field, [*keys, "status", *names]))]
    for k in sorted(rows):
        figures = (rows[k]["figures"].get(name) for name in names)
        lines.append(",".join([*map(field, runs[k]), field(rows[k]["status"]), *("" if f is None else f"{f:.17g}" for f in figures)]))
    write_lines(path, lines)


class Journal:
    """Groups that are complete, a line each with its checksum; damaged ones are left out."""

    def __init__(self, path, scene):
        check_target(path, scene, lambda line: line == JOURNAL)
        self.path, self.kept = path, {}
        with contextlib.suppress(FileNotFoundError):
            for line in path.read_text(encoding="utf-8", errors="replace").splitlines()[1:]:
                checksum, _, text = line.partition(" ")
                if checksum == self.checksum(text):
                    group = json.loads(text)
                    self.kept[group["key"]] = group["rows"]
        self.file = open(path, "a" if self.kept else "w", encoding="utf-8")
        if not self.kept:
            print(JOURNAL, file=self.file, flush=True)

    def add(self, key, rows):
        text = json.dumps({"key": key, "rows": rows})
        print(self.checksum(text), text, file=self.file, flush=True)

    def remove(self):
        self.file.close()
        self.path.unlink()

    @staticmethod
    def checksum(text):
        return hashlib.sha256(text.encode()).hexdigest()[:16]
