"""Command lines: options, overrides, variations, and results written to where they cannot or must not go."""

import geo_cases
import plates
import twins
from fuzz_case import ANY, FOLDER, FULL_DEVICE, PIPE, REFUSED, Case, Link
from valid_scenes import Setting

NUMBERS = ("0", "-1", "1e9", "1.5", "", "abc", "99999999999999999999", "nan", "0x10", " 1", "1025")
STRANGE_NAMES = ("\x1b[31mred\x07", "two\nlines", "n" * 300, "d/" * 2100 + "x", "", " ", "ü", "\udcff\udcfe", "a\tb",
                 "=1+1")  # fmt: skip
DEEP = "a" + ".a" * 20000 + "=1"
OPTIONS = (  # not there, twice, without their value; subcommands that are not there
    ([], REFUSED), (["--help"], ANY), (["--version"], ANY), (["no_such_command"], REFUSED), (["solve"], REFUSED),
    (["solve", "--help"], ANY), (["solve", "scene.toml", "scene.toml"], REFUSED), (["solve", ""], REFUSED),
    (["solve", "--no-such-option", "scene.toml"], REFUSED), (["solve", "scene.toml", "-o"], REFUSED),
    (["solve", "scene.toml", "--set"], REFUSED), (["sweep", "scene.toml"], REFUSED), (["-o", "results"], REFUSED),
    (["solve", "scene.toml", "-o", "results", "-o", "results"], ANY), (["check", "check", "scene.toml"], ANY),
    (["solve", "no_such.toml", "-o", "results"], REFUSED), (["solve", "mesh.msh", "-o", "results"], REFUSED),
    (["solve", "--", "scene.toml"], ANY), (["solve", "scene\x07.toml"], REFUSED), (["solve", "a\nb.toml"], REFUSED),
    (["solve", "-o", "results", "n" * 5000 + ".toml"], REFUSED), (["\x1b[31m"], REFUSED),
    (["solve", "\udcff.toml"], REFUSED))  # fmt: skip
WRONG_OVERRIDES = ("", "=", "title", "=x", "a.b.c=1", "boundary.x=1", "boundary..pressure=1", ".=1",
                   "mesh.file=/dev/zero", "mesh.file=no_such.msh", "mesh.file=/", "mesh.file=", "bodies=1",
                   "materials.steel.young=nan", "materials.steel.young=-inf", "materials.steel.young=1e999",
                   "contact.condition=\x1b[31mred", "method=1", "method.kind=two\nlines", "boundary.99.pressure=1",
                   "boundary.-1.pressure=1", "boundary.0={", DEEP, "method.tolerance=0",
                   "contact.0.between=['a','b','c']")  # fmt: skip
ODD_OVERRIDES = ("title=", "contact=[]", "title=" + "a" * 100000, "boundary=" + "[" * 5000, "contact.between=[]",
                 "boundary.0={on='lower_bottom'}", "materials.steel.young=1e300", "model.plane=strain",
                 "title=\x1b[2Jx")  # fmt: skip
VARIATIONS = ("", "=", "title", "title=", "method.kind=mortar,ddm", "method.kind=,", "a.b=1,2", DEEP,
              "boundary.2.pressure=nan,1", "boundary.2.pressure=1e5,1e300,-1e300", "model.plane=strain,stress",
              "materials.steel.poisson=0.3,0.5,0.7", "mesh.file=mesh.msh,no_such.msh", "title==1+1,@SUM(A1),-2",
              "title=a\nb,c", "method.kind=" + "mortar," * 30)  # fmt: skip
SCENES = {
    "a folder": FOLDER, "a pipe": PIPE, "a device without an end": Link("/dev/zero"),
    "an empty device": Link("/dev/null"), "a link to itself": Link("scene.toml"),
    "a link to nothing": Link("nowhere"), "a full device": Link("/dev/full"),
    "an unreadable file": Link("/proc/self/mem"), "random numbers": Link("/dev/urandom"),
}  # fmt: skip


def plain(random, geo=False):
    """The files of a scene that is right: with a mesh, or with a geometry."""
    if geo:
        return {"scene.toml": geo_cases.scene("mesh.geo"), "mesh.geo": geo_cases.PLATES.encode()}
    scene, mesh = twins.files_of(simple_setting(random))
    return {"scene.toml": scene, "mesh.msh": mesh}


def simple_setting(random):
    """Two plates, the pressure the same everywhere, on a small random mesh: solved, and all checks hold."""
    cell = random.choice(plates.CELL_TYPES)
    sizes = [(random.randint(1, 4), random.randint(1, 2)) for _ in range(2)]
    made = [plates.Body(name, plates.even(columns), rows, plates.between(0.0, 1.0, low, low + 0.5), cell)
            for name, low, (columns, rows) in zip(("lower", "upper"), (0.0, 0.5), sizes)]
    scene = {
        "title": "two plates", "mesh": {"file": "mesh.msh"},
        "materials": {"steel": {"young": 2.1e11, "poisson": 0.3}}, "bodies": {"lower": "steel", "upper": "steel"},
        "boundary": [{"on": "lower_bottom", "displacement": {"y": 0.0}},
                     {"on": ["lower_left", "upper_left"], "displacement": {"x": 0.0}},
                     {"on": "upper_top", "pressure": 1e7}],
        "contact": [{"between": ["upper_bottom", "lower_top"]}],
    }  # fmt: skip
    return Setting(scene, plates.mesh_of(made), 1e7)


def command(what, files, words, expect=ANY, output=(), results=None, **settings):
    return Case("command line", what, files, words, expect, output, results, **settings)


def options_case(random):
    words, expect = random.choice(OPTIONS)
    return command(f"options {' '.join(words)[:40]!r}", plain(random), words, expect, ("results", "out"))


def number_case(random):
    value = random.choice(NUMBERS)
    words = ["solve", "scene.toml", "-o", "results", f"--threads={value}"]
    expect = ANY if value in (" 1", "0x10") else REFUSED
    return command(f"--threads {value!r}", plain(random), words, expect, ("results",))


def override_case(random):
    wrong = random.random() < 0.7
    text, verb = random.choice(WRONG_OVERRIDES if wrong else ODD_OVERRIDES), random.choice(("solve", "solve", "check"))
    words = [verb, "scene.toml", "--set", text] + (["-o", "results"] if verb == "solve" else [])
    results = "results" if verb == "solve" else None
    return command(f"--set {text[:40]!r}", plain(random), words, REFUSED if wrong else ANY, ("results",), results)


def variation_case(random):
    text = random.choice(VARIATIONS)
    words = ["sweep", "scene.toml", "--vary", text, "-o", "table.csv", "--quiet"]
    return command(f"--vary {text[:40]!r}", plain(random), words, ANY, ("table.csv",))


def scene_case(random):
    """A scene, or a mesh, that is no ordinary file."""
    what = random.choice(list(SCENES))
    files, broken = plain(random), random.choice(("scene.toml", "mesh.msh"))
    files[broken] = Link(broken) if what == "a link to itself" else SCENES[what]
    verb = random.choice(("solve", "check", "sweep"))
    more = {"solve": ["-o", "results"], "check": [], "sweep": ["--vary", "title=a,b", "-o", "table.csv"]}[verb]
    expect = ANY if verb == "sweep" else REFUSED
    return command(f"{broken} is {what}", files, [verb, "scene.toml", *more], expect, ("results", "table.csv"))


def output_case(random):
    """Results onto what is there already, or where nothing can be."""
    verb = random.choice(("solve", "mesh", "sweep"))
    files = plain(random, geo=random.random() < 0.3)
    mesh = "mesh.geo" if "mesh.geo" in files else "mesh.msh"
    end = {"solve": "", "mesh": ".msh", "sweep": ".csv"}[verb]
    extra = {"loop" + end: Link("loop" + end), "linked" + end: Link(mesh), "folder" + end: FOLDER,
             "file" + end: b"mine", "dangling" + end: Link("nowhere/at/all" + end), "full" + end: FULL_DEVICE,
             "taken/result.vtu": FOLDER, "taken/summary.json": FOLDER, "taken/mine.txt": b"mine"}  # fmt: skip
    refused = ["scene.toml", "./scene.toml", "scene.toml/results", mesh, mesh + "/results" + end,
               "full" + end, f"full{end}/results{end}", "/proc/no_such" + end, "/sys/no_such/x" + end]  # fmt: skip
    refused += {"solve": ["file", "taken"], "mesh": ["folder.msh", "name.vtu"], "sweep": ["folder.csv"]}[verb]
    allowed = ["folder", ".", "out/"] + [name + end for name in ("new/deep", "file", "dangling", "linked", "loop")]
    target = random.choice(refused) if random.random() < 0.6 else random.choice(allowed + list(STRANGE_NAMES))
    words = [verb, "scene.toml", *(["--vary", "title=a,b"] if verb == "sweep" else []), "-o", target, "--quiet"]
    expect, output = (REFUSED, ()) if target in refused else (ANY, (target.rstrip("/") or "out",))
    return command(f"{verb} -o {target[:40]!r}", files | extra, words, expect, output)


def full_disk_case(random):
    """Files cannot grow beyond some size: as a full disk, old results must stand."""
    verb, size = random.choice(("solve", "mesh", "sweep")), random.choice((0, 10, 100, 1000, 2000))
    target = {"solve": "results", "mesh": "old.msh", "sweep": "old.csv"}[verb]
    old = "results/summary.json" if verb == "solve" else target
    files = plain(random) | {old: b"{}"}  # no geometry: it goes through files in memory, which know no full disk
    words = [verb, "scene.toml", *(["--vary", "title=a,b"] if verb == "sweep" else []), "-o", target, "--quiet"]
    what = f"{verb} on a full disk, {size} bytes left"
    return command(what, files, words, REFUSED if size <= 100 else ANY, (target,), largest_file=size)


SHARES = {options_case: 15, number_case: 5, override_case: 20, variation_case: 15, scene_case: 10, output_case: 25,
          full_disk_case: 10}  # fmt: skip


def make_command_case(random):
    return random.choices(list(SHARES), SHARES.values())[0](random)
