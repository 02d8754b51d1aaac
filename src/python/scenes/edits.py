"""Changes to a scene's text and to a .geo that leave all else in them as it is."""

import json
import re
import tomllib
from functools import reduce
from operator import getitem


def toml(value):
    """A value as TOML writes it on one line."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return f"{value:.12g}" if isinstance(value, float) else json.dumps(value, ensure_ascii=False)


def table(head, entry):
    """A table at the end of a scene: its head and a line a key."""
    return f"\n\n{head}\n" + "".join(f"{key} = {toml(item)}\n" for key, item in entry.items())


def first_that_says(wanted, texts, key):
    for text in texts:
        try:
            if tomllib.loads(text) == wanted:
                return text
        except tomllib.TOMLDecodeError:
            pass
    raise ValueError(f"{key}: not found as it is written; expected it changed by hand")


def with_entry(text, section, entry):
    """With one more entry of contact or boundary: at the end of their list, or as a table."""
    scene, new = tomllib.loads(text), toml(entry)
    tries = [text.rstrip("\n") + table(f"[[{section}]]", entry)]
    for end in (found.start() for found in re.finditer(r"\]", text)):
        alone = text[:end].endswith("\n")  # the closing bracket on its line
        for added in (f"  {new},\n", f"  , {new}\n") if alone else (new, f", {new}"):
            tries.append(text[:end] + added + text[end:])
    return first_that_says(scene | {section: [*scene.get(section, []), entry]}, tries, section)


def with_value(text, key, value):
    """With another value of a key such as boundary.0.pressure, or of one that stands there as a comment."""
    wanted, (*path, last) = tomllib.loads(text), (int(part) if part.isdigit() else part for part in key.split("."))
    place = reduce(getitem, path, wanted)
    if isinstance(place, dict) and last not in place:
        return re.sub(rf"(?m)^# {last} = .*", f"{last} = {toml(value)}", text, count=1)
    if place[last] == value:
        return text
    place[last] = value
    found = re.finditer(r"[-+]?\b[\d._]+(?:[eE][-+]?\d+)?\b|\"[^\"\n]*\"", text)
    return first_that_says(wanted, (text[: old.start()] + toml(value) + text[old.end() :] for old in found), key)


def numbers(value, key=""):
    """Every number of the scene's drawing, materials, supports and loads, by the key that --set takes."""
    if isinstance(value, (dict, list)):
        for name, item in value.items() if isinstance(value, dict) else enumerate(value):
            if key or name in ("mesh", "materials", "boundary", "body_force", "contact"):
                yield from numbers(item, f"{key}.{name}".lstrip("."))
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        yield key, value


def named_geo(text, kind, name, tags):
    """The .geo with a physical group; a line that gave one of these its number for a name goes."""
    for tag in tags:
        number = f'Physical {kind}("{kind.lower()}_{tag}") = {{{tag}}};\n'
        text = text.replace("\n" + number, "\n")
    return text.rstrip("\n") + f'\nPhysical {kind}("{name}") = {{{", ".join(map(str, tags))}}};\n'
