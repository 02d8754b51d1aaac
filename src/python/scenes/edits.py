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


def parsed(text):
    """What the text says; nothing where it is no TOML."""
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        return {}


def with_entry(text, section, entry):
    """With one more entry of a list of the scene, contact or boundary: where they stand, or as a table at the end."""
    wanted = [*tomllib.loads(text).get(section, []), entry]
    tries = [text.rstrip("\n") + f"\n\n[[{section}]]\n" + "".join(f"{key} = {toml(item)}\n" for key, item in entry.items())]
    if head := re.search(rf"^{section}[ \t]*=[ \t]*\[", text, re.MULTILINE):
        for end in (found.start() for found in re.finditer(r"\]", text) if found.start() >= head.end()):
            line = text.rfind("\n", 0, end) + 1
            alone = not text[line:end].strip()  # the closing bracket on its line
            parts = (text[:line] + "  ", ",\n", text[line:]) if alone else (text[:end], "", text[end:])
            tries += [f"{parts[0]}{comma}{toml(entry)}{parts[1]}{parts[2]}" for comma in ("", ", ")]
    for changed in tries:
        if parsed(changed).get(section) == wanted:
            return changed
    raise ValueError(f"{section}: cannot be added to by the window; expected {section} = [...] or [[{section}]]")


def with_value(text, key, value):
    """With another value of a key such as boundary.0.pressure or materials.steel.young, in whatever way it is written."""
    wanted, (*path, last) = tomllib.loads(text), (int(part) if part.isdigit() else part for part in key.split("."))
    if reduce(getitem, path, wanted)[last] == value:
        return text
    reduce(getitem, path, wanted)[last] = value
    for found in re.finditer(r"[-+]?\b[\d._]+(?:[eE][-+]?\d+)?\b|\"[^\"\n]*\"", text):
        changed = text[: found.start()] + toml(value) + text[found.end() :]
        if parsed(changed) == wanted:
            return changed
    raise ValueError(f"{key}: not found as it is written")


def numbers(value, key=""):
    """Every number of the scene's drawing, materials, supports and loads, by the key that --set takes."""
    if isinstance(value, dict):
        for name, item in value.items():
            if key or name in ("mesh", "materials", "boundary", "body_force", "contact"):
                yield from numbers(item, f"{key}.{name}".lstrip("."))
    elif isinstance(value, list):
        for k, item in enumerate(value):
            yield from numbers(item, f"{key}.{k}")
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        yield key, value


def named_geo(text, kind, name, tags):
    """The .geo with a physical group, Physical Curve("foot") = {5, 6}; a line that gave one of these its number for a name goes."""
    for tag in tags:
        text = re.sub(rf'^Physical {kind}\("{kind.lower()}_{tag}"\) = \{{{tag}\}};\n', "", text, flags=re.MULTILINE)
    return text.rstrip("\n") + f'\nPhysical {kind}("{name}") = {{{", ".join(map(str, tags))}}};\n'
