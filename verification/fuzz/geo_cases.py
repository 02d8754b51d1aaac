"""Geometries (.geo): two plates in gmsh's language, right ones and ones with something wrong. A .geo is a program."""

import tomllib
from pathlib import Path

from fuzz_case import ANY, REFUSED, SOLVED, Case

HERE = Path(__file__).parent
PLATES, SCENE = (HERE / "plates.geo").read_text(), (HERE / "plates.toml").read_text()
TABLE = tomllib.loads((HERE / "geometries.toml").read_text())
LINES, ENDLESS, PROGRAMS = (TABLE[name] for name in ("lines", "endless", "programs"))
LINES["sixty syntax errors"][0] = "".join(LINES["sixty syntax errors"][0].format(k) for k in range(60))
FOLDERS = ('a" ; SystemCall "touch escaped"; "', "it's", "a\nb", "\x1b[31m", "a b%20c", "ü", "a\\b", '"', "${HOME}",
           "`x`")  # fmt: skip
NO_PROGRAMS = "--no-programs"


def scene(name):
    for plain, escape in (("\\", "\\\\"), ('"', '\\"'), ("\n", "\\n"), ("\x1b", "\\u001b")):
        name = name.replace(plain, escape)
    return ("\n" + SCENE.replace("FILE", name)).encode()


def geo_case(what, geo, expect, *more, name="mesh.geo", command="solve", files=None, output=("results",)):
    files = {"scene.toml": scene(name), name: geo.encode("utf-8", "surrogateescape"), **(files or {})}
    solving = command == "solve"
    words = [command, "scene.toml", *(["-o", "results"] if solving else []), *more]
    return Case("geometry", what, files, words, expect, output, "results" if solving else None,
                thrust=1e7 if expect == SOLVED and solving else None)


def inserted(random, text):
    """The plates with `text` before a statement or at an end: at a line that does not stand within a macro."""
    lines = PLATES.splitlines(keepends=True)
    place = random.choice([0, *range(8, len(lines) + 1)])
    return "".join(lines[:place]) + text + "".join(lines[place:])


def changed_characters(random):
    """The plates with some characters lost, doubled or changed."""
    text = list(PLATES)
    for _ in range(random.choice((1, 1, 2, 5))):
        place = random.randrange(len(text))
        text[place] = random.choice(("", 2 * text[place], random.choice("{}();=[],:\"'1-\n")))
    return "".join(text)


def parameter_case(random, command):
    """A number of the geometry is set on the command line."""
    key = random.choice(("n_upper", "n_lower", "order", "unknown"))
    value = random.choice((-3, 0, 0.5, 1e9 if key == "order" else 4, "1e400", "nan", '"text"', 3))
    expect = REFUSED if key == "unknown" or value in ("1e400", "nan", '"text"') else ANY
    return geo_case(f"{key}={value}", PLATES, expect, "--set", f"mesh.parameters.{key}={value}", command=command)


def make_geo_case(random):
    command = random.choice(("solve", "solve", "check"))
    choice = random.choices(("lines", "characters", "numbers", "include", "program", "folder", "endless"),
                            (40, 20, 10, 8, 8, 11, 3))[0]  # fmt: skip
    if choice == "lines":
        what = random.choice(list(LINES))
        text, expect = LINES[what]
        return geo_case(what, inserted(random, text), expect, command=command)
    if choice == "characters":
        return geo_case("some characters changed", changed_characters(random), ANY, command=command)
    if choice == "numbers":
        return parameter_case(random, command)
    if choice == "include":
        what, text, expect = random.choice((("Exit", "Exit;\n", REFUSED), ("Abort", "Abort;\n", REFUSED),
                                            ("a syntax error", "x = ;\n", REFUSED), ("nothing", "", SOLVED)))
        geo = inserted(random, 'Include "part.geo";\n')
        return geo_case(f"an included {what}", geo, expect, command=command, files={"part.geo": text.encode()})
    if choice == "program":
        what = random.choice(list(PROGRAMS))
        geo = inserted(random, PROGRAMS[what])
        return geo_case(what, geo, REFUSED, NO_PROGRAMS, command=command)
    if choice == "folder":
        name = random.choice(FOLDERS) + "/mesh.geo"
        return geo_case(f"in a folder {name[:-9]!r}", PLATES, ANY, name=name, command=command)
    what = random.choice(list(ENDLESS))
    return geo_case(what, PLATES + ENDLESS[what], REFUSED, "--set", "mesh.time_limit=3", command=command)
