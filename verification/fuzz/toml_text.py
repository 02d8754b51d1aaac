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


def inline(value):
    """A value on one line."""
    match value:
        case Raw():
            return str(value)
        case bool():
            return str(value).lower()
        case str():
            return text(value)
        case float() if math.isinf(value):
            return "inf" if value > 0 else "-inf"
        case int() | float():
            return repr(value)
        case dict():
            return "{ " + ", ".join(entries(value)) + " }"
    return "[" + ", ".join(inline(v) for v in value) + "]"


def entries(table):
    return [f"{key(k)} = {inline(v)}" for k, v in table.items()]


def is_tables(value):
    return isinstance(value, list) and value != [] and all(isinstance(entry, dict) for entry in value)


def document(scene):
    """The whole scene: values first, then tables and arrays of tables."""
    tables = {name: value for name, value in scene.items() if isinstance(value, dict) or is_tables(value)}
    parts = ["\n".join(entries({name: value for name, value in scene.items() if name not in tables}))]
    for name, value in tables.items():
        head = "[{}]" if isinstance(value, dict) else "[[{}]]"
        for table in [value] if isinstance(value, dict) else value:
            parts.append("\n".join([head.format(key(name)), *entries(table)]))
    return "\n\n".join(part for part in parts if part) + "\n"
