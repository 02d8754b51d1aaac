"""Geometries (.geo): two plates in gmsh's language, right ones and ones with something wrong. A .geo is a program."""

from fuzz_case import ANY, REFUSED, SOLVED, Case

PLATES = """\
DefineConstant[ n_upper = 3, n_lower = 2, order = 2 ];
Macro Plate
  p = newp; Point(p) = {0, low, 0}; Point(p + 1) = {1, low, 0};
  Point(p + 2) = {1, high, 0}; Point(p + 3) = {0, high, 0};
  c = newc; Line(c) = {p, p + 1}; Line(c + 1) = {p + 1, p + 2}; Line(c + 2) = {p + 2, p + 3}; Line(c + 3) = {p + 3, p};
  Transfinite Curve{c, c + 2} = n + 1; Transfinite Curve{c + 1, c + 3} = 2;
  s = news; Curve Loop(s) = {c : c + 3}; Plane Surface(s) = {s}; Transfinite Surface{s}; Recombine Surface{s};
Return
low = 0; high = 0.4; n = n_lower;
Call Plate;
Physical Surface("lower") = {s}; Physical Curve("bottom") = {c}; Physical Curve("lower_top") = {c + 2};
Physical Curve("sides") = {c + 1, c + 3};
low = 0.4; high = 0.9; n = n_upper;
Call Plate;
Physical Surface("upper") = {s}; Physical Curve("upper_bottom") = {c}; Physical Curve("top") = {c + 2};
Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 1;
"""
SCENE = """\
mesh.file = "FILE"
materials.steel = { young = 2.1e11, poisson = 0 }
bodies = { lower = "steel", upper = "steel" }
boundary = [{ on = "bottom", displacement = { x = 0, y = 0 } }, { on = "top", displacement = { x = 0 } },
            { on = "top", pressure = 1e7 }]
contact = [{ between = ["upper_bottom", "lower_top"] }]
"""
ERRORS = "\n".join(f"Nonsense_{k}(;" for k in range(60)) + "\n"

# Name: lines put into the geometry, and what must come of them.
LINES = {
    "one syntax error": ("Point(1) = {0, 0\n", REFUSED),
    "sixty syntax errors": (ERRORS, REFUSED),
    "an unknown variable": ("x = no_such_variable;\n", REFUSED),
    "Abort": ("Abort;\n", REFUSED),
    "Exit": ("Exit;\n", REFUSED),
    "an Error of its own": ('Error("stop %g", 1);\n', REFUSED),
    "an element order of 99": ("Mesh.ElementOrder = 99;\n", ANY),
    "an element order of -1": ("Mesh.ElementOrder = -1;\n", ANY),
    "abort on errors": ("General.AbortOnError = 4;\nx = no_such_variable;\n", REFUSED),
    "no end of a macro": ("Macro Open\n x = 1;\n", ANY),
    "a call of what is not there": ("Call NoSuchMacro;\n", REFUSED),
    "a missing include": ('Include "no_such_file.geo";\n', REFUSED),
    "a missing merge": ('Merge "no_such_file.msh";\n', REFUSED),
    "a point twice": ("Point(1) = {5, 5, 0};\n", ANY),
    "a surface that is not there": ('Physical Surface("ghost") = {77};\n', ANY),
    "a curve that is not there": ('Physical Curve("ghost") = {77};\n', ANY),
    "a name with a line break": ('Physical Curve("two\nlines") = {1};\n', ANY),
    "a name with control characters": ('Physical Curve("\x1b[31mred\x07") = {2};\n', ANY),
    "a name that is a formula": ('Physical Curve("=1+1") = {2};\n', ANY),
    "a huge number of elements": ("Transfinite Curve{1} = -5;\n", ANY),
    "division by zero": ("x = 1 / 0; Point(newp) = {x, 0, 0};\n", ANY),
    "a point at infinity": ("Point(newp) = {1e308 * 10, 0, 0};\n", ANY),
    "a mesh size of zero": ("MeshSize{:} = 0;\nMesh.Algorithm = 99;\n", ANY),
    "an unknown option": ("Mesh.NoSuchOption = 1;\n", REFUSED),
    "a volume": ("Extrude {0, 0, 1} { Surface{s}; }\n", ANY),
    "a deleted model": ("Delete Model;\n", ANY),
    "meshing in 3D by itself": ("Mesh 3;\n", ANY),
    "a plot": ("Draw;\n", ANY),
    "random bytes": ("\x00\x01\x02\xc3\x28 };;{{\n", ANY),
    "tables of numbers too long": ("list[] = {0 : 100000};\n", ANY),
}
# These run on for ever unless a guard ends them.
ENDLESS = {
    "an endless recursion": 'Macro Again\n Call Again;\nReturn\nCall Again;\n',
    "an include of itself": 'Include "mesh.geo";\n',
    "an endless loop": "For k In {1 : 1e300}\nEndFor\n",
}
# These do more than make a mesh.
PROGRAMS = {
    "SystemCall": 'SystemCall "touch escaped";\n',
    "SystemCall without waiting": 'NonBlockingSystemCall "touch escaped";\n',
    "Save": 'Mesh 2;\nSave "escaped.msh";\n',
    "Printf into a file": 'Printf("escaped") > "escaped.txt";\n',
    "Print": 'Print "escaped.geo_unrolled";\n',
    "OnelabRun": 'OnelabRun("escaped", "touch escaped");\n',
    "Save over the scene": 'Printf("escaped") > "scene.toml";\n',
}
FOLDERS = ('a" ; SystemCall "touch escaped"; "', "it's", "a\nb", "\x1b[31m", "a b%20c", "ü", "a\\b", '"', "${HOME}",
           "`x`")
NO_PROGRAMS = "--no-programs"


def scene(name, *lines):
    escaped = name.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n").replace("\x1b", "\\u001b")
    return ("\n".join(lines) + "\n" + SCENE.replace("FILE", escaped)).encode()


def geo_case(what, geo, expect, *more, name="mesh.geo", command="solve", files=None, output=("results",)):
    files = {"scene.toml": scene(name), name: geo.encode("utf-8", "surrogateescape"), **(files or {})}
    words = [command, "scene.toml", *(["-o", "results"] if command == "solve" else []), *more]
    return Case("geometry", what, files, words, expect, output, "results" if command == "solve" else None,
                thrust=1e7 if expect == SOLVED and command == "solve" else None)


def inserted(random, text):
    """The plates with `text` before a statement or at an end: at a line that does not stand within a macro."""
    lines = PLATES.splitlines(keepends=True)
    places = [0, *range(8, len(lines) + 1)]
    place = random.choice(places)
    return "".join(lines[:place]) + text + "".join(lines[place:])


def changed_characters(random):
    """The plates with some characters lost, doubled or changed."""
    text = list(PLATES)
    for _ in range(random.choice((1, 1, 2, 5))):
        place = random.randrange(len(text))
        text[place] = random.choice(("", 2 * text[place], random.choice("{}();=[],:\"'1-\n")))
    return "".join(text)


def make_geo_case(random, options):
    """A random case; `options` are those of the program under test."""
    command = random.choice(("solve", "solve", "check"))
    choice = random.choices(("lines", "characters", "numbers", "include", "program", "folder", "endless"),
                            (40, 20, 10, 8, 8, 11, 3))[0]
    if choice == "lines":
        what = random.choice(list(LINES))
        text, expect = LINES[what]
        return geo_case(what, inserted(random, text), expect, command=command)
    if choice == "characters":
        return geo_case("some characters changed", changed_characters(random), ANY, command=command)
    if choice == "numbers":
        key = random.choice(("n_upper", "n_lower", "order", "unknown"))
        value = random.choice((-3, 0, 0.5, 1e9 if key == "order" else 4, "1e400", "nan", '"text"', 3))
        expect = REFUSED if key == "unknown" or value in ("1e400", "nan", '"text"') else ANY
        return geo_case(f"{key}={value}", PLATES, expect, "--set", f"mesh.parameters.{key}={value}", command=command)
    if choice == "include":
        what, text, expect = random.choice((("Exit", "Exit;\n", REFUSED), ("Abort", "Abort;\n", REFUSED),
                                            ("a syntax error", "x = ;\n", REFUSED), ("nothing", "", SOLVED)))
        geo = inserted(random, 'Include "part.geo";\n')
        return geo_case(f"an included {what}", geo, expect, command=command, files={"part.geo": text.encode()})
    if choice == "program":
        what = random.choice(list(PROGRAMS))
        geo = inserted(random, PROGRAMS[what])
        if NO_PROGRAMS in options:
            return geo_case(what, geo, REFUSED, NO_PROGRAMS, command=command)
        allowed = ("results", "escaped", "escaped.msh", "escaped.txt", "escaped.geo_unrolled", "scene.toml")
        return geo_case(what, geo, ANY, command=command, output=allowed)
    if choice == "folder":
        name = random.choice(FOLDERS) + "/mesh.geo"
        return geo_case(f"in a folder {name[:-9]!r}", PLATES, ANY, name=name, command=command)
    what = random.choice(list(ENDLESS))
    limit = ["--set", "mesh.time_limit=3"] if NO_PROGRAMS in options else []  # both came together
    return geo_case(what, PLATES + ENDLESS[what], REFUSED, *limit, command=command)
