"""Changes to a scene's text and to a .geo that leave all else in them as it is."""

import json
import re
import tomllib
from functools import reduce
from operator import getitem

TOKEN = re.compile(r"\"(?:\\.|[^\"\\\n])*\"|'[^'\n]*'|#[^\n]*|\S")


def toml(value):
    """A value as TOML writes it on one line."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return f"{value:.12g}" if isinstance(value, float) else json.dumps(value, ensure_ascii=False)


def with_entry(text, section, entry):
    """With one more entry of a list of the scene, contact or boundary: where they stand, or as a table at the end."""
    wanted = [*tomllib.loads(text).get(section, []), entry]
    if head := re.search(rf"^{section}[ \t]*=[ \t]*\[", text, re.MULTILINE):
        depth, last = 1, "["
        for token in TOKEN.finditer(text, head.end()):
            depth += (token[0] in "[{") - (token[0] in "]}")
            if depth == 0:
                break
            if not token[0].startswith("#"):
                last, end = token[0], token.end()
        if last not in "[,":
            text, at = text[:end] + "," + text[end:], token.start() + 1
        else:
            at = token.start()
        start = text.rfind("\n", 0, at) + 1
        alone = not text[start:at].strip()  # the closing bracket on its line
        text = f"{text[:start]}  {toml(entry)},\n{text[start:]}" if alone else f"{text[:at]} {toml(entry)} {text[at:]}"
    else:
        text = text.rstrip("\n") + f"\n\n[[{section}]]\n" + "".join(f"{key} = {toml(item)}\n" for key, item in entry.items())
    if tomllib.loads(text)[section] != wanted:
        raise ValueError(f"{section}: cannot be added to by the window; expected {section} = [...] or [[{section}]]")
    return text


def with_value(text, key, value):
    """With another value of a key such as boundary.0.pressure or materials.steel.young, in whatever way it is written."""
    before, wanted = tomllib.loads(text), tomllib.loads(text)
    *path, last = [int(part) if part.isdigit() else part for part in key.split(".")]
    reduce(getitem, path, wanted)[last] = value
    for found in re.finditer(r"[-+]?\b[\d._]+(?:[eE][-+]?\d+)?\b|\"[^\"\n]*\"", text):
        changed = text[: found.start()] + toml(value) + text[found.end() :]
        try:
            if tomllib.loads(changed) == wanted != before:
                return changed
        except tomllib.TOMLDecodeError:
            continue
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
