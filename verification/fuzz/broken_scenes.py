"""Scenes with something wrong: values of a wrong kind or size, names that are not there, TOML that is none."""

import copy

from fuzz_case import ANY, REFUSED
from toml_text import Raw

HUGE = (1e308, -1e308, 1e300, -1e300, 1e160, 1e-160, 5e-324, 1e20, -1.0, 0, 2**63 - 1, -(2**63))
NOT_NUMBERS = (float("nan"), float("inf"), float("-inf"), Raw("1e999"), Raw("99999999999999999999999"))
WRONG = (True, Raw("1979-05-27T07:32:00Z"), Raw("07:32:00"), [[]], {"unknown": 1}, [{}], {"x": {"y": {"z": 1}}})
WORDS = ("", " ", "no_such_name", "\x1b[31mred\x07", "two\nlines", "=1+1", "\u202eright to left", "ü" * 300,
         "a" * 20000, "../../etc/passwd", "%s%n%x", "mesh.msh\x00.toml", '";"', "\U0001f600")
VALUES = {"huge": HUGE, "not a number": NOT_NUMBERS, "word": WORDS, "wrong type": WRONG}


def paths(tree, before=()):
    """Every key of the scene, from the root."""
    entries = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ()
    for key, value in entries:
        yield (*before, key)
        yield from paths(value, (*before, key))


def at(tree, path):
    for key in path:
        tree = tree[key]
    return tree


def change(random, scene):
    """Changes one thing of the scene in place; returns what, and what must come of it."""
    path = random.choice(list(paths(scene)))
    parent, key, place = at(scene, path[:-1]), path[-1], ".".join(map(str, path))
    value = parent[key]
    numeric = isinstance(value, (int, float)) and not isinstance(value, bool)
    choices = ["huge", "huge", "not a number"] if numeric else ["word"] * 3 if isinstance(value, str) else ["empty"] * 3
    choice = random.choice((*choices, "wrong type", "missing", "unknown key", "twice"))
    if choice in VALUES:
        parent[key] = random.choice(VALUES[choice])
        refused = choice == "not a number" or (choice == "wrong type" and isinstance(parent[key], (bool, Raw)))
        shown = parent[key][:20] if choice == "word" else parent[key]
        return f"{place} = {shown!r}", REFUSED if refused else ANY
    if choice == "missing":
        del parent[key]
        return f"{place} is missing", ANY
    if choice == "unknown key":
        owner, name = (parent, place) if isinstance(parent, dict) else (scene, "the root")
        owner["unknown\x07 key" if random.random() < 0.3 else "unknown"] = 1
        return f"an unknown key beside {name}", REFUSED
    if choice == "twice" and isinstance(parent, list):
        parent.append(copy.deepcopy(value))
        return f"{place} twice", ANY
    parent[key] = [] if random.random() < 0.5 else {}
    return f"{place} is empty", ANY


def change_text(random, text):
    """Changes the TOML text, as bytes; returns it, what is wrong, and what must come of it."""
    at_line = text.find(b"\n", random.randrange(len(text))) + 1
    garbage = bytes(random.randrange(256) for _ in range(random.choice((1, 4, 100))))
    deep = random.choice((50, 1000, 20000))
    nested = "[" * deep + "]" * deep
    inserts = {
        "a table twice": b"[model]\nplane = 'strain'\n[model]\n",
        "a key twice": b"title = 'a'\ntitle = 'b'\n",
        "a text without its end": b'title = "no end\n',
        "a long text without its end": b'"""' + b"a" * 100000,
        "arrays in arrays": f"deep = {nested}\n".encode(),
        "a dotted key of many parts": b"a" + b".a" * deep + b" = 1\n",
        "a table of many parts": b"[a" + b".a" * deep + b"]\n",
        "tables in tables": b"a = " + b"{a=" * deep + b"1" + b"}" * deep + b"\n",
        "a control character": b"# \x07\x1b[2J\x00\n",
        "letters that are no UTF-8": b"title = '\xff\xfe\xc3'\n",
        "random bytes": garbage,
        "a long line": b"x" * 1000000 + b"\n",
    }
    others = ("cut off", "Windows line ends", "a byte order mark", "empty", "one byte")
    choice = random.choice((*inserts, *inserts, *others))
    place = random.randrange(len(text)) if choice in ("cut off", "one byte") else None
    if choice == "one byte":
        return text[:place] + bytes([random.randrange(256)]) + text[place + 1 :], choice, ANY
    whole = {"cut off": text[:place], "Windows line ends": text.replace(b"\n", b"\r\n"),
             "a byte order mark": b"\xef\xbb\xbf" + text, "empty": b""}  # fmt: skip
    if choice in whole:
        return whole[choice], choice, REFUSED if choice == "empty" else ANY
    expect = ANY if choice in ("random bytes", "a table twice") else REFUSED
    return text[:at_line] + inserts[choice] + text[at_line:], choice, expect
