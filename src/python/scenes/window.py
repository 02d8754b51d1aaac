#!/usr/bin/python3
"""A scene in gmsh's own window: name curves, pick supports, loads and pairs, check, solve, look at p.

Usage: window.py SCENE.toml | PART.geo (mortise window does the same)
Without a scene PART.toml is written as `mortise new` does it.
"""

import contextlib
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

try:
    import gmsh
    import numpy as np
except ImportError:
    sys.exit("mortise: error: the window needs apt-get install python3-gmsh python3-meshio python3-matplotlib")

import edits
import new
import signs
import views
from geometry import meeting

MORTISE = os.environ.get("MORTISE_PROGRAM", "mortise")
ACTION, NUMBERS, VERDICT = "ONELAB/Action", "0Mortise/5Numbers of the scene/", "0Mortise/0Verdict/"
ACCURACY, PAIR, CASE = "0Mortise/1Accuracy of p [%]", "0Mortise/7Pair shown", "0Mortise/8Case shown"
NAME, HOLD, PRESSURE = "0Mortise/3Pick/1Name", "0Mortise/3Pick/3Support", "0Mortise/3Pick/5Pressure"
MATERIAL, YOUNG = "0Mortise/4Bodies/1Material", "0Mortise/4Bodies/2Young's modulus"
POISSON = "0Mortise/4Bodies/3Poisson's ratio"
HOLDS = {"fixed": {"x": 0, "y": 0}, "x = 0": {"x": 0}, "y = 0": {"y": 0}, "normal = 0": {"normal": 0}}
PICKS = {"name": "curves to name", "hold": "curves to hold", "load": "curves that bear the pressure",
         "pair": "two curves, or one where they lie on each other", "material": "bodies"}  # fmt: skip
LOOK = {"Geometry.Points": 0, "Geometry.CurveWidth": 3, "Geometry.Surfaces": 0, "Mesh.SurfaceEdges": 0, "Mesh.Lines": 0,
        "Mesh.Points": 0, "General.BackgroundGradient": 0, "Solver.AutoMesh": 0, "General.SmallAxes": 0,
        "General.GraphicsFontSize": 15, "General.MenuWidth": 330, "General.GraphicsWidth": 1250,
        "General.GraphicsHeight": 800, "General.GraphicsPositionX": 20, "General.GraphicsPositionY": 30}  # fmt: skip


def field(name, *values, **more):
    return {"type": "string" if isinstance(values[0], str) else "number", "name": name, "values": list(values)} | more


def button(name, action):
    return field(f"0Mortise/{name}", action, attributes={"Macro": "Action", "Aspect": "MiddleReturnButton"})


def put(*fields):
    gmsh.onelab.set(json.dumps(fields))


def clear(folder):
    for name in gmsh.onelab.getNames(folder + ".*"):
        gmsh.onelab.clear(name)


def number(name, default=0):
    """What stands in a field."""
    return [*gmsh.onelab.getNumber(name), default][0]


CONTROLS = [
    field("ONELAB/Button", "Solve", "solve", visible=False), field(ACTION, "", visible=False),
    field(ACCURACY, 1, min=0, max=10, choices=[0, 0.1, 0.2, 0.5, 1, 2, 5, 10]),
    button("2Check", "check scene"), button("2Stop", "stop"),
    field(NAME, "contact"), button("3Pick/2Name curves", "name"),
    field(HOLD, "fixed", choices=list(HOLDS)), button("3Pick/4Hold curves", "hold"),
    field(PRESSURE, 1), button("3Pick/6Load curves", "load"), button("3Pick/7Pair of curves", "pair"),
    field(MATERIAL, "steel"), field(YOUNG, 210e9), field(POISSON, 0.3), button("4Bodies/4Give to bodies", "material"),
]  # fmt: skip


class Window:
    def __init__(self, file):
        self.file = file if file.suffix == ".toml" else file.with_suffix(".toml")
        if not self.file.exists():
            subprocess.run([MORTISE, "new", file], check=True)
        self.geo, self.out = self.file.parent / self.scene()["mesh"]["file"], Path("out") / self.file.stem
        self.run, self.shown, self.drawn, self.told = None, None, None, []  # told: curves that a message is about
        if self.geo.suffix != ".geo":
            sys.exit(f"mortise: error: {self.geo}: the window draws a .geo; mortise check --picture draws a mesh")
        gmsh.initialize(["mortise"], False)
        gmsh.option.setString("General.GraphicsFontEngine", "StringTexture")  # the native one swallows spaces
        for k in range(5):
            gmsh.option.setString(f"Solver.Name{k}", "")  # only our button
        for name, value in LOOK.items():
            gmsh.option.setNumber(name, value)
        put(*CONTROLS)
        self.refresh()
        if max(np.abs(curve.points).max() for curve in self.curves.values()) > new.METRES:
            gmsh.onelab.setNumber(YOUNG, [210e3])
        self.open()
        for item in ("0Mortise", "0Mortise/3Pick"):
            gmsh.fltk.openTreeItem(item)

    def open(self):
        try:
            gmsh.fltk.initialize()
        except Exception as error:  # of gmsh, which has no other
            sys.exit(f"mortise: error: the window cannot be opened: {error}; expected a display that DISPLAY names")

    def scene(self):
        return tomllib.loads(self.file.read_text())

    def keep(self):
        """Writes the numbers that were changed in the window into the scene."""
        for key, value in self.numbers.items():
            if (now := number(NUMBERS + key, value)) != value:
                self.file.write_text(edits.with_value(self.file.read_text(), key, now))
                self.numbers[key] = now

    def refresh(self):
        """Draws the scene as its files say it."""
        scene, count = self.scene(), len(self.cases())
        self.numbers = dict(edits.numbers(scene))
        clear(NUMBERS)
        put(*(field(NUMBERS + key, value, label=key.split(".", 1)[1]) for key, value in self.numbers.items()))
        pairs = {f"{k}: {' - '.join(pair.get('between', []))}": k for k, pair in enumerate(scene.get("contact", []))}
        put(field(PAIR, number(PAIR), choices=list(pairs.values()), valueLabels=pairs, visible=len(pairs) > 1),
            field(CASE, number(CASE, 1), min=1, max=max(1, count), step=1, visible=count > 0))  # fmt: skip
        self.draw(scene["mesh"].get("parameters", {}))
        signs.show_setup(self.curves, self.bodies, scene, self.told)

    def cases(self):
        """Folders of the cases that were solved last, in the order of the scene."""
        table = self.out / "cases.csv"
        rows = views.result_tables.read_csv(table) if self.scene().get("case") and table.exists() else []
        return [self.out / "cases" / str(row["case"]) for row in rows]

    def draw(self, parameters):
        """The .geo with these constants, if it is not drawn so already."""
        constants = "".join(f"{key} = {value:.17g};\n" for key, value in parameters.items())
        if self.drawn == (drawn := (constants, self.geo.read_text())):
            return
        if self.drawn:
            gmsh.model.remove()
        with tempfile.NamedTemporaryFile("w", suffix=".geo") as file:
            file.write(f'{constants}Include "{self.geo.absolute()}";\n')
            file.flush()
            gmsh.open(file.name)
        gmsh.model.setFileName(str(self.geo))
        self.drawn, self.bodies = drawn, signs.drawn_bodies()
        self.curves = signs.drawn_curves(self.bodies)

    def tell(self, **lines):
        clear(VERDICT)
        put(*(field(f"{VERDICT}{k}{name}", text, readOnly=True) for k, (name, text) in enumerate(lines.items())))
        gmsh.fltk.setStatusMessage("; ".join(lines.values()), False)

    def start(self, *words):
        if self.run:
            raise ValueError(f"{self.kind} goes on; Stop ends it")
        self.terminal, theirs = os.openpty()  # of its own: there the program tells its stages
        command, streams = [MORTISE, words[0], self.file, *words[1:]], {"stdout": theirs, "stderr": theirs}
        self.run, self.kind, self.text = subprocess.Popen(command, stdin=subprocess.DEVNULL, **streams), words[0], ""
        os.close(theirs)
        os.set_blocking(self.terminal, False)

    def lines(self):
        """What the program has told until now."""
        with contextlib.suppress(OSError):  # nothing there yet, or no more
            while read := os.read(self.terminal, 65536):
                self.text += read.decode(errors="replace")
        lines = re.split(r"[\r\n]+", re.sub(r"\x1b\[[0-9;]*[A-Za-z]", "", self.text))
        return [line.rstrip() for line in lines if line.strip()]

    def solve(self):
        accuracy = ["--accuracy", f"{number(ACCURACY):.4g}%"] if number(ACCURACY) else []
        cases = ["--set", "cases.write=all"] if self.scene().get("case") else []
        self.start("solve", *accuracy, *cases, "-o", str(self.out))

    def stop(self):
        if self.run:  # the first time for the last answer that is complete, then at once
            self.run.send_signal(signal.SIGINT)

    def ended(self):
        run, self.run = self.run, None
        status, lines = run.returncode, self.lines()
        os.close(self.terminal)
        for line in lines:
            gmsh.logger.write(line, "warning" if status else "info")
        errors = [line.removeprefix("mortise: ") for line in lines if line.startswith("mortise:")]
        messages = errors + [line.split(None, 1)[1] for line in lines if line.startswith("  warning")]
        entries = re.findall(r"\b(boundary|contact)\.(\d+)", " ".join(errors))  # that a message is about
        entries = [self.scene()[section][int(k)] for section, k in entries]
        names = [entry.get("on") or entry.get("between", []) for entry in entries]
        names = np.hstack([re.findall(r"'([^']+)'", " ".join(errors)), *names])
        self.told, self.shown = signs.on_curves(self.curves, names), None
        self.refresh()
        if self.kind == "solve" and status in (0, 2) and (self.cases() or (self.out / "summary.json").exists()):
            self.show()
        else:
            self.tell(**{"Error" if status else "Check": (errors or ["stopped" if status else "fine"])[-1]})
        places = re.findall(r"near \((\S+), (\S+)\)", " ".join(messages))
        top = -110 if self.shown else -40
        words = [((20, top - 20 * k), line, 14) for k, line in enumerate(messages)]
        signs.add_words("messages", words + [((x, y, 0), "(!)", 18) for x, y in places])

    def show(self):
        """The results of the last run: of the case and the pair that are chosen."""
        cases, self.shown = self.cases(), (int(number(PAIR)), int(number(CASE, 1)))
        folder = cases[min(self.shown[1], len(cases)) - 1] if cases else self.out
        summary = json.loads((folder / "summary.json").read_text())
        views.show_results(folder, min(self.shown[0], len(summary["contact"]) - 1))
        error = ((summary["estimate"] or {}).get("pressure") or {}).get("error")
        case = {"Case": folder.name} if cases else {}
        pressure = "no estimate" if error is None else f"p within {100 * error:.2g} %"
        self.tell(**case, Status=summary["status"], Pressure=pressure)

    def changed(self):
        """Of a field: another pair or case to show, another drawing."""
        if not self.shown:
            self.refresh()
        elif self.shown != (number(PAIR), number(CASE, 1)):
            self.show()

    def pick(self, dim, what):
        """Tags that the user picks; none where he leaves it."""
        gmsh.option.setNumber("Geometry.Surfaces", dim == 2)
        gmsh.fltk.setStatusMessage(f"Pick {what}, then press e (end) or q (quit)", True)
        self.refresh()
        gmsh.graphics.draw()
        ended, picked = gmsh.fltk.selectEntities(dim)
        gmsh.option.setNumber("Geometry.Surfaces", 0)
        gmsh.fltk.setStatusMessage("", True)
        return sorted({tag for _, tag in picked}) if ended else []

    def names(self, tags):
        """Of picked curves. All numbers become names in the .geo: where it has a name, a scene cannot use numbers."""
        text = self.geo.read_text()
        unnamed = {"Curve": [tag for tag, curve in self.curves.items() if curve.numbered]}
        unnamed["Surface"] = [*sum(self.bodies.values(), [])] if not gmsh.model.getPhysicalGroups(2) else []
        for kind, all_tags in unnamed.items():
            for tag in all_tags:
                text = edits.named_geo(text, kind, f"{kind.lower()}_{tag}", [tag])
        self.geo.write_text(text)
        return [self.curves[tag].name.split(", ")[0] for tag in tags]

    def name(self, tags):
        name, scene = gmsh.onelab.getString(NAME)[0], self.file.read_text()
        if not re.fullmatch(r"\w[\w-]*", name) or signs.on_curves(self.curves, name):
            raise ValueError(f"the name '{name}' is taken, or has other than letters, digits, _ and -")
        self.names(tags)
        self.geo.write_text(edits.named_geo(self.geo.read_text(), "Curve", name, tags))
        self.file.write_text(re.sub(rf"\bcurve_({'|'.join(map(str, tags))})\b", name, scene))

    def add(self, section, entry):
        self.file.write_text(edits.with_entry(self.file.read_text(), section, entry))

    def hold(self, tags):
        self.add("boundary", {"on": self.names(tags), "displacement": HOLDS[gmsh.onelab.getString(HOLD)[0]]})

    def load(self, tags):
        self.add("boundary", {"on": self.names(tags), "pressure": number(PRESSURE)})

    def pair(self, tags):
        if len(tags) == 1:
            picked = self.curves[tags[0]]
            others = {tag: curve for tag, curve in self.curves.items() if curve.bodies != picked.bodies}
            tags += [tag for tag, curve in others.items() if meeting(curve, picked)]
        if len(tags) != 2:
            raise ValueError(f"a pair has two curves; these are {', '.join(self.names(tags))}")
        self.add("contact", {"between": self.names(tags)})

    def material(self, tags):
        name, text = gmsh.onelab.getString(MATERIAL)[0], self.file.read_text()
        values = {"young": number(YOUNG), "poisson": number(POISSON)}
        if name not in self.scene()["materials"]:
            text = text.rstrip("\n") + edits.table(f"[materials.{json.dumps(name)}]", values)
        for key, value in values.items():
            text = edits.with_value(text, f"materials.{name}.{key}", value)
        for body, surfaces in self.bodies.items():
            if body in self.scene()["bodies"] and set(surfaces) & set(tags):
                text = edits.with_value(text, f"bodies.{body}", name)
        self.file.write_text(text)

    ACTIONS = {"check scene": lambda self: self.start("check"), "solve": solve, "stop": stop, "ended": ended,
               "check": changed, "name": name, "hold": hold, "load": load, "pair": pair, "material": material}

    def act(self, action):
        """What a button asks for; the window stays, whatever comes of it."""
        try:
            self.keep()
            picked = [self.pick(2 if action == "material" else 1, PICKS[action])] if action in PICKS else []
            if picked != [[]]:
                self.ACTIONS[action](self, *picked)
            if picked:
                self.shown, self.told = None, []
                self.tell()
                self.refresh()
        except Exception as error:
            self.tell(Error=f"{type(error).__name__}: {error}")
        if gmsh.fltk.isAvailable():
            gmsh.fltk.update()
            gmsh.graphics.draw()

    def step(self):
        """Waits for what comes next, a tenth of a second at most; False when the window is closed."""
        action = (gmsh.onelab.getString(ACTION) or [""])[0]
        gmsh.onelab.setString(ACTION, [""])
        if action in self.ACTIONS:
            self.act(action)
        if self.run:
            gmsh.fltk.setStatusMessage([self.kind, *self.lines()][-1], False)
            if self.run.poll() is not None:
                self.act("ended")
        if gmsh.fltk.isAvailable():
            gmsh.fltk.wait(0.1)
        return bool(gmsh.fltk.isAvailable())


def main():
    if len(sys.argv) != 2 or Path(sys.argv[1]).suffix not in (".toml", ".geo"):
        print(__doc__.strip())
        sys.exit(0 if sys.argv[1:] in (["--help"], ["-h"]) else "mortise: error: expected SCENE.toml or PART.geo")
    if not Path(sys.argv[1]).is_file():
        sys.exit(f"mortise: error: {sys.argv[1]}: no such file")
    window = Window(Path(sys.argv[1]))
    while window.step():
        pass
    if window.run:
        window.run.terminate()
    gmsh.finalize()


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    main()
