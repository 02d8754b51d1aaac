#!/usr/bin/python3
"""A scene in gmsh's own window: look at it, name curves, pick supports, loads and pairs, check, solve, look at p.

Usage: window.py SCENE.toml | PART.geo (mortise window does the same). Without a scene PART.toml is written as `mortise new` does it.
"""

import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path

try:
    import gmsh
    import numpy as np
except ImportError:
    sys.exit("mortise: error: the window needs Python's gmsh: apt-get install python3-gmsh python3-meshio python3-matplotlib")

import edits
import new
import signs
from geometry import meeting

MORTISE = os.environ.get("MORTISE_PROGRAM", "mortise")
ACTION, ACCURACY, PAIR, CASE = "ONELAB/Action", "0Mortise/1Accuracy of p [%]", "0Mortise/7Pair shown", "0Mortise/8Case shown"
NAME, HOLD, PRESSURE = "0Mortise/3Pick/1Name", "0Mortise/3Pick/3Support", "0Mortise/3Pick/5Pressure"
MATERIAL, YOUNG, POISSON = "0Mortise/4Bodies/1Material", "0Mortise/4Bodies/2Young's modulus", "0Mortise/4Bodies/3Poisson's ratio"
NUMBERS, VERDICT = "0Mortise/5Numbers of the scene/", "0Mortise/0Verdict/"
HOLDS = {"fixed": {"x": 0, "y": 0}, "x = 0": {"x": 0}, "y = 0": {"y": 0}, "normal = 0": {"normal": 0}}
LOOK = {"Geometry.Points": 0, "Geometry.CurveWidth": 3, "Geometry.Surfaces": 0, "Mesh.SurfaceEdges": 0, "Mesh.Lines": 0, "Mesh.Points": 0,
        "Solver.AutoMesh": 0, "General.SmallAxes": 0, "General.GraphicsFontSize": 15, "General.MenuWidth": 330, "General.GraphicsWidth": 1250,
        "General.GraphicsHeight": 800, "General.GraphicsPositionX": 20, "General.GraphicsPositionY": 30}  # fmt: skip


def field(name, *values, **more):
    return {"type": "string" if isinstance(values[0], str) else "number", "name": name, "values": list(values)} | more


def button(name, action):
    return field(f"0Mortise/{name}", action, attributes={"Macro": "Action", "Aspect": "MiddleReturnButton"})


CONTROLS = [
    field("ONELAB/Button", "Solve", "solve", visible=False), field(ACCURACY, 1, min=0, max=10, choices=[0, 0.1, 0.2, 0.5, 1, 2, 5, 10]),
    button("2Check", "check scene"), button("2Stop", "stop"), button("6Save numbers", "save"),
    field(NAME, "contact"), button("3Pick/2Name curves", "name"), field(HOLD, "fixed", choices=list(HOLDS)), button("3Pick/4Hold curves", "hold"),
    field(PRESSURE, 1), button("3Pick/6Load curves", "load"), button("3Pick/7Pair of curves", "pair"),
    field(MATERIAL, "steel"), field(YOUNG, 210e9), field(POISSON, 0.3), button("4Bodies/4Give to bodies", "material"),
]  # fmt: skip


class Run:
    """The program beside the window, on a terminal of its own, to which it tells its stages."""

    def __init__(self, kind, words):
        self.kind, self.begin, self.errors, self.out = kind, time.monotonic(), "", tempfile.TemporaryFile("w+")
        self.terminal, theirs = os.openpty()
        self.process = subprocess.Popen([MORTISE, *words], stdout=self.out, stderr=theirs, stdin=subprocess.DEVNULL)
        os.close(theirs)
        os.set_blocking(self.terminal, False)

    def ended(self):
        over = self.process.poll() is not None
        try:
            while read := os.read(self.terminal, 65536):
                self.errors += re.sub(r"\x1b\[[0-9;]*[A-Za-z]", "", read.decode(errors="replace"))
        except OSError:  # nothing there yet, or no more
            pass
        return over

    def stage(self):
        lines = re.split(r"[\r\n]+", self.errors.strip())
        return f"{lines[-1].strip() or self.kind} ({time.monotonic() - self.begin:.0f} s)"

    def said(self):
        os.close(self.terminal)
        self.out.seek(0)
        return [line.rstrip() for line in self.out.read().splitlines() + re.split(r"[\r\n]+", self.errors) if "mortise:" in line or line.startswith("  ")]


class Window:
    def __init__(self, file):
        self.file = file if file.suffix == ".toml" else file.with_suffix(".toml")
        if not self.file.exists():
            subprocess.run([MORTISE, "new", file], check=True)
        self.geo, self.out = self.file.parent / self.scene()["mesh"]["file"], Path("out") / self.file.stem
        self.run = self.shown = self.drawn = self.curves = None
        self.told = []  # curves that a message is about
        if self.geo.suffix != ".geo":
            sys.exit(f"mortise: error: {self.geo}: the window draws a .geo; mortise check --picture draws a mesh")
        gmsh.initialize(["mortise"], False)
        gmsh.option.setString("General.GraphicsFontEngine", "StringTexture")  # the native one swallows spaces without X fonts
        for k in range(5):
            gmsh.option.setString(f"Solver.Name{k}", "")  # only our button
        for name, value in LOOK.items():
            gmsh.option.setNumber(name, value)
        gmsh.onelab.set(json.dumps(CONTROLS))
        self.refresh()
        lengths = max(abs(curve.points).max() for curve in self.curves.values())
        gmsh.onelab.setNumber(YOUNG, [210e9 if lengths < new.METRES else 210e3])
        gmsh.fltk.initialize()
        for item in ("0Mortise", "0Mortise/3Pick"):
            gmsh.fltk.openTreeItem(item)

    def scene(self):
        return tomllib.loads(self.file.read_text())

    def changes(self):
        """Numbers of the scene that stand otherwise in the window."""
        now = {key: gmsh.onelab.getNumber(NUMBERS + key) for key, _ in edits.numbers(self.scene())}
        return {key: now[key][0] for key, value in edits.numbers(self.scene()) if len(now[key]) and now[key][0] != value}

    def refresh(self):
        """Draws the scene as its files and the fields say it."""
        scene, changed = self.scene(), self.changes()
        for name in gmsh.onelab.getNames(NUMBERS + ".*"):
            gmsh.onelab.clear(name)
        fields = [field(NUMBERS + key, changed.get(key, value), label=label_of(scene, key)) for key, value in edits.numbers(scene)]
        pairs = {f"{k}: {' - '.join(pair.get('between', []))}": k for k, pair in enumerate(scene.get("contact", []))}
        fields.append(field(PAIR, self.chosen(PAIR, 0), choices=list(pairs.values()), valueLabels=pairs, visible=len(pairs) > 1))
        count = len(self.cases())
        gmsh.onelab.set(json.dumps([*fields, field(CASE, self.chosen(CASE, 1), min=1, max=max(1, count), step=1, visible=count > 0)]))
        self.open(dict(scene["mesh"].get("parameters", {})) | {key.rpartition(".")[2]: value for key, value in changed.items() if key.startswith("mesh.")})
        signs.show_setup(self.curves, scene, self.told)

    def chosen(self, name, default):
        found = gmsh.onelab.getNumber(name)
        return int(found[0]) if len(found) else default

    def cases(self):
        """Folders of the cases that were solved last, in the order of the scene."""
        table = self.out / "cases.csv"
        rows = signs.result_tables.read_csv(table) if self.scene().get("case") and table.exists() else []
        return [self.out / "cases" / str(row["case"]) for row in rows]

    def open(self, parameters):
        """The .geo with these constants, if it is not drawn so already."""
        text = "".join(f"{key} = {value:.17g};\n" for key, value in parameters.items()) + f'Include "{self.geo.absolute()}";\n'
        if self.drawn == (text, self.geo.read_text()):
            return
        if self.drawn:
            gmsh.model.remove()
        with tempfile.NamedTemporaryFile("w", suffix=".geo") as file:
            file.write(text)
            file.flush()
            gmsh.open(file.name)
        gmsh.model.setFileName(str(self.geo))
        self.drawn, self.curves = (text, self.geo.read_text()), signs.drawn_curves()

    def tell(self, **lines):
        for name in gmsh.onelab.getNames(VERDICT + ".*"):
            gmsh.onelab.clear(name)
        gmsh.onelab.set(json.dumps([field(f"{VERDICT}{k}{name}", value, readOnly=True) for k, (name, value) in enumerate(lines.items())]))
        gmsh.fltk.setStatusMessage("; ".join(lines.values()), False)

    # ---- What the buttons do ----

    def start(self, kind, *words):
        if self.run:
            return self.tell(Busy=f"{self.run.kind} goes on; Stop ends it")
        sets = [word for key, value in self.changes().items() for word in ("--set", f"{key}={value:.12g}")]
        self.run = Run(kind, [kind, str(self.file), *sets, *words])

    def solve(self):
        percent = gmsh.onelab.getNumber(ACCURACY)[0]
        cases = ["--set", "cases.write=all"] if self.scene().get("case") else []
        self.start("solve", *(["--accuracy", f"{percent:.4g}%"] if percent else []), *cases, "-o", str(self.out))

    def stop(self):
        if self.run:  # the first time for the last answer that is complete, then at once
            self.run.process.send_signal(signal.SIGINT)

    def ended(self):
        run, self.run = self.run, None
        said, status = run.said(), run.process.returncode
        for line in said:
            gmsh.logger.write(line, "info" if status == 0 else "warning")
        errors = [line for line in said if line.startswith("mortise:")]
        self.told, self.shown = self.told_curves(" ".join(errors)), None
        self.refresh()
        if run.kind == "solve" and status in (0, 2) and (self.cases() or (self.out / "summary.json").exists()):
            self.show()
        else:
            self.tell(**{"Error" if status else "Check": errors[-1].removeprefix("mortise: ") if errors else "fine"})
        warnings = [line.split(None, 1)[1] for line in said if line.startswith("  warning")]
        at = [((x, y, 0), "(!)", 18) for x, y in re.findall(r"near \((\S+), (\S+)\)", " ".join(errors + warnings))]
        signs.add_words("messages", [((20, (-110 if self.shown else -40) - 20 * k), line, 14) for k, line in enumerate(errors + warnings)] + at)

    def told_curves(self, text):
        """Curves that a message names between quotes, or by the number of an entry of the scene."""
        names = re.findall(r"'([^']+)'", text)
        for section, k in re.findall(r"\b(boundary|contact)\.(\d+)", text):
            entry = self.scene()[section][int(k)]
            names += np.atleast_1d(entry.get("on", entry.get("between", []))).tolist()
        return signs.on_curves(self.curves, names)

    def show(self):
        """The results of the last run: of the case and the pair that are chosen."""
        cases, self.shown = self.cases(), (self.chosen(PAIR, 0), self.chosen(CASE, 1))
        folder = cases[min(self.shown[1], len(cases)) - 1] if cases else self.out
        summary = json.loads((folder / "summary.json").read_text())
        signs.show_results(folder, min(self.shown[0], len(summary["contact"]) - 1))
        error = ((summary["estimate"] or {}).get("pressure") or {}).get("error")
        self.tell(**({"Case": folder.name} if cases else {}), Status=summary["status"], Pressure="no estimate" if error is None else f"p within {100 * error:.2g} %",
                  Checks=f"{sum(check['ok'] for check in summary['checks'])} of {len(summary['checks'])} hold")  # fmt: skip

    def changed(self):
        """Of a field: another pair or case to show, another drawing."""
        if self.shown and self.shown != (self.chosen(PAIR, 0), self.chosen(CASE, 1)):
            self.show()
        elif any(key.startswith("mesh.") for key in self.changes()):
            self.refresh()

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
        """Names of picked curves; those without one get their number for it in the .geo, where a scene cannot use it yet."""
        if not all(curve.numbered for curve in self.curves.values()):
            for tag in (tag for tag in tags if self.curves[tag].numbered):
                self.geo.write_text(edits.named_geo(self.geo.read_text(), "Curve", f"curve_{tag}", [tag]))
        return [self.curves[tag].name.split(", ")[0] for tag in tags]

    def name(self):
        name = gmsh.onelab.getString(NAME)[0]
        if not re.fullmatch(r"\w[\w-]*", name) or signs.on_curves(self.curves, name):
            raise ValueError(f"the name '{name}' is taken, or has other than letters, digits, _ and -")
        if not (tags := self.pick(1, "curves to name")):
            return
        text, scene = self.geo.read_text(), self.file.read_text()
        if all(curve.numbered for curve in self.curves.values()):  # with the first name numbers are none any more
            for kind, all_tags in (("Curve", self.curves), ("Surface", [tag for _, tag in gmsh.model.getEntities(2) if not signs.names_of(2, tag)])):
                for tag in all_tags:
                    text = edits.named_geo(text, kind, f"{kind.lower()}_{tag}", [tag])
        self.geo.write_text(edits.named_geo(text, "Curve", name, tags))
        for tag in tags:
            scene = re.sub(rf"\bcurve_{tag}\b", name, scene)
        self.file.write_text(scene)

    def add(self, section, entry):
        self.file.write_text(edits.with_entry(self.file.read_text(), section, entry))

    def hold(self):
        if tags := self.pick(1, "curves to hold"):
            self.add("boundary", {"on": self.names(tags), "displacement": HOLDS[gmsh.onelab.getString(HOLD)[0]]})

    def load(self):
        if tags := self.pick(1, "curves that bear the pressure"):
            self.add("boundary", {"on": self.names(tags), "pressure": gmsh.onelab.getNumber(PRESSURE)[0]})

    def pair(self):
        tags = self.pick(1, "two curves of different bodies, or one where they lie on each other")
        if len(tags) == 1:
            tags += [tag for tag, curve in self.curves.items() if curve.bodies != self.curves[tags[0]].bodies and meeting(curve, self.curves[tags[0]])]
        if tags and len(tags) != 2:
            raise ValueError(f"a pair has two curves; these are {', '.join(self.names(tags))}")
        if tags:
            self.add("contact", {"between": self.names(tags)})

    def material(self):
        tags, name, text = self.pick(2, "bodies"), gmsh.onelab.getString(MATERIAL)[0], self.file.read_text()
        values = {key: float(gmsh.onelab.getNumber(place)[0]) for key, place in (("young", YOUNG), ("poisson", POISSON))}
        if tags and name not in (known := tomllib.loads(text)["materials"]):
            text = text.rstrip("\n") + f"\n\n[materials.{json.dumps(name)}]\n" + "".join(f"{key} = {edits.toml(value)}\n" for key, value in values.items())
        elif tags:
            for key, value in values.items():
                text = text if key in known[name] else text.replace(f"\n# {key} =", f"\n{key} =", 1)  # as mortise new leaves it
                text = edits.with_value(text, f"materials.{name}.{key}", value)
        for body in {(signs.names_of(2, tag) or [f"surface_{tag}"])[0] for tag in tags} & set(tomllib.loads(text)["bodies"]):
            text = edits.with_value(text, f"bodies.{body}", name)
        self.file.write_text(text)

    def save(self):
        text = self.file.read_text()
        for key, value in self.changes().items():
            text = edits.with_value(text, key, value)
        self.file.write_text(text)

    # ---- The loop ----

    ACTIONS = {"solve": solve, "stop": stop, "check scene": lambda self: self.start("check"), "check": changed, "name": name, "hold": hold,
               "load": load, "pair": pair, "material": material, "save": save, "ended": ended, "reset": lambda self: gmsh.onelab.set(json.dumps(CONTROLS))}  # fmt: skip

    def act(self, action):
        """What a button asks for; the window stays, whatever comes of it."""
        try:
            self.ACTIONS[action](self)
            if action in ("name", "hold", "load", "pair", "material", "save"):
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
        if action:
            gmsh.onelab.setString(ACTION, [""])
        if action in self.ACTIONS:
            self.act(action)
        if self.run and self.run.ended():
            self.act("ended")
        elif self.run:
            gmsh.fltk.setStatusMessage(self.run.stage(), False)
        if gmsh.fltk.isAvailable():
            gmsh.fltk.wait(0.1)
        return bool(gmsh.fltk.isAvailable())


def label_of(scene, key):
    """boundary.2.pressure as "head: pressure"."""
    section, number, *rest = key.split(".")
    return f"{', '.join(np.atleast_1d(scene[section][int(number)]['on']))}: {'.'.join(rest)}" if section == "boundary" else key


def main():
    if len(sys.argv) != 2 or not Path(sys.argv[1]).is_file() or Path(sys.argv[1]).suffix not in (".toml", ".geo"):
        print(__doc__.strip())
        sys.exit(0 if sys.argv[1:] in (["--help"], ["-h"]) else "mortise: error: expected SCENE.toml or PART.geo")
    window = Window(Path(sys.argv[1]))
    while window.step():
        pass
    if window.run:
        window.run.process.terminate()
    gmsh.finalize()


if __name__ == "__main__":
    main()
