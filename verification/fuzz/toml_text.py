"""A scene, given as dictionaries and lists, as TOML text."""

import math
import re

BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")
ESCAPES = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t", "\r": "\\r"}


class Raw(str):
    """TOML text that stands for itself: a date, a number in a strange form, a broken value."""


def text(words):
    """A basic string: control characters and lone surrogates escaped as TOML asks."""
    return '"' + "".join(ESCAPES.get(c, c if c >= " " and c != "\x7f" else f"\\u{ord(c):04x}") for c in words) + '"'


def key(name):
    return name if BARE_KEY.fullmatch(name) else text(name)


def number(value):
    if isinstance(value, int):
        return str(value)
    if math.isnan(value):
        return "nan"
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    return repr(value)


def inline(value):
    """A value on one line."""
    if isinstance(value, Raw):
        return str(value)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return text(value)
    if isinstance(value, (int, float)):
        return number(value)
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key(k)} = {inline(v)}" for k, v in value.items()) + " }"
    return "[" + ", ".join(inline(v) for v in value) + "]"


def document(scene):
    """The whole scene: values first, then tables and arrays of tables."""
    plain = [f"{key(k)} = {inline(v)}" for k, v in scene.items() if not is_table(v) and not is_tables(v)]
    parts = ["\n".join(plain)]
    for name, value in scene.items():
        if is_table(value):
            parts.append(table(f"[{key(name)}]", value))
        elif is_tables(value):
            parts += [table(f"[[{key(name)}]]", entry) for entry in value]
    return "\n\n".join(part for part in parts if part) + "\n"


def table(head, entries):
    return "\n".join([head, *(f"{key(k)} = {inline(v)}" for k, v in entries.items())])


def is_table(value):
    return isinstance(value, dict)


def is_tables(value):
    return isinstance(value, list) and value != [] and all(isinstance(entry, dict) for entry in value)
