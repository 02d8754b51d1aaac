"""Drives `mortise window` as a user would, by a mouse under Xvfb: picks curves on the screen, presses Solve.

Usage: drive_window.py punch|lug|stop|feet FILE (in its folder, with DISPLAY, MORTISE_PROGRAM); prints what the window told, as JSON.
lug: docs/tutorial.md, with its pictures; the others: what test_window.py looks at.
"""

import json
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
from PIL import ImageGrab

import launch

sys.path.insert(0, str(launch.ROOT / "src/python/scenes"))

import gmsh
import signs
import window

SOLVE, STOP = (265, 838), (121, 190)  # the buttons; the second where it is before there is a verdict


def mouse(*words):
    subprocess.run(["xdotool", *map(str, words)], check=True)


def on_screen(place, box):
    """The pixel of a place: the drawing, box in lengths, is where the colours of curves are."""
    picture = np.array(ImageGrab.grab().convert("RGB")).astype(int)
    drawn = np.zeros(picture.shape[:2], dtype=bool)
    for colour in (signs.HELD, signs.LOADED, signs.UNUSED, *signs.PAIRS[:1]):
        drawn |= np.abs(picture - colour).sum(axis=2) < 4
    drawn[:, : 20 + window.LOOK["General.MenuWidth"]] = False
    rows, columns = np.flatnonzero(drawn.sum(axis=1) > 40), np.flatnonzero(drawn.sum(axis=0) > 40)  # whole sides, not signs
    (x0, y0), (x1, y1) = box
    x = columns[0] + (place[0] - x0) / (x1 - x0) * (columns[-1] - columns[0])
    return round(x), round(rows[-1] - (place[1] - y0) / (y1 - y0) * (rows[-1] - rows[0]))


def pick(places, box):
    """Clicks on these places when the window waits for it, and ends the picking."""

    def clicks():
        time.sleep(0.7)
        for place in places:
            mouse("mousemove", *on_screen(place, box), "sleep", 0.2, "click", 1, "sleep", 0.2)
        mouse("key", "e")

    thread = threading.Thread(target=clicks)
    thread.start()
    return thread


def wait(shown, condition, seconds=20):
    end = time.monotonic() + seconds
    while not condition():
        shown.step()
        if time.monotonic() > end:
            raise TimeoutError("the window does not do it")


def picked(shown, action, places, box):
    clicks = pick(places, box)
    shown.act(action)
    clicks.join()


def lug(shown):
    box = ((-100, -30), (30, 30))
    ImageGrab.grab().save("opened.png")
    gmsh.onelab.setString(window.NAME, ["bore"])
    picked(shown, "name", [(0, 8)], box)
    picked(shown, "hold", [(0, 8)], box)
    gmsh.onelab.setString(window.HOLD, ["y = 0"])
    picked(shown, "hold", [(-100, 10)], box)
    gmsh.onelab.setNumber(window.PRESSURE, [-50])
    picked(shown, "load", [(-100, 10)], box)
    shown.act("check scene")
    wait(shown, lambda: not shown.run)
    ImageGrab.grab().save("message.png")
    picked(shown, "material", [(-60, 0)], box)
    ImageGrab.grab().save("window.png")
    mouse("mousemove", *SOLVE, "click", 1)
    wait(shown, lambda: shown.run)
    wait(shown, lambda: not shown.run, 60)
    ImageGrab.grab().save("solved.png")
    return told_by(shown)


def punch(shown):
    box, told = ((0, 0), (0.6, 0.3)), {}
    gmsh.onelab.setString(window.NAME, ["head"])
    picked(shown, "name", [(0.25, 0.3)], box)
    told["named"] = sorted(curve.name for curve in shown.curves.values())
    picked(shown, "pair", [(0.25, 0.2)], box)
    pressure = next(name for name in gmsh.onelab.getNames(window.NUMBERS + ".*") if name.endswith("pressure"))
    gmsh.onelab.setNumber(pressure, [20e6])
    mouse("mousemove", *SOLVE, "click", 1)
    wait(shown, lambda: shown.run)
    steps = 0
    while shown.run:
        shown.step()
        steps += 1
    told["steps while it solved"] = steps
    told["full"] = told_by(shown)
    for case in (2, 1):  # as the slider moves
        gmsh.onelab.setNumber(window.CASE, [case])
        gmsh.onelab.setString(window.ACTION, ["check"])
        shown.step()
        told[f"case {case}"] = told_by(shown)
    gmsh.onelab.setString(window.HOLD, ["fixed"])
    shown.file.write_text(shown.file.read_text().replace('"curve_1"', '["curve_2", "nowhere"]'))
    shown.act("check scene")
    wait(shown, lambda: not shown.run)
    told["error"] = told_by(shown)
    told["highlighted"] = [shown.curves[tag].name for tag in shown.told]
    return told


def stop(shown):
    gmsh.onelab.setNumber(window.ACCURACY, [0])  # on the mesh of the .geo, which takes a while
    mouse("mousemove", *SOLVE, "click", 1)
    wait(shown, lambda: shown.run)
    run, end = shown.run, time.monotonic() + 1.5
    wait(shown, lambda: time.monotonic() > end)
    told = {"ran": shown.run is run}
    mouse("mousemove", *STOP, "click", 1)
    wait(shown, lambda: not shown.run, 5)
    told |= {"status": run.returncode, "stopped": told_by(shown)["lines"]}
    shown.geo.write_text(shown.geo.read_text().split("Mesh.")[0])  # coarse again
    shown.act("check scene")
    wait(shown, lambda: not shown.run)
    return told | {"checked": told_by(shown)["lines"]}


def feet(shown):
    mouse("mousemove", *SOLVE, "click", 1)
    wait(shown, lambda: shown.run)
    wait(shown, lambda: not shown.run, 60)
    told = {"0": told_by(shown)}
    for pair in (1, 0):  # as the list of pairs is clicked
        gmsh.onelab.setNumber(window.PAIR, [pair])
        gmsh.onelab.setString(window.ACTION, ["check"])
        shown.step()
        told[str(pair)] = told_by(shown)
    return told


def told_by(shown):
    graph = next((tag for tag in gmsh.view.getTags() if gmsh.option.getString(f"View[{gmsh.view.getIndex(tag)}].Name").startswith("p along")), None)
    values = gmsh.view.getListData(graph)[2][0] if graph is not None else []
    lines = [gmsh.onelab.getString(name)[0] for name in gmsh.onelab.getNames(window.VERDICT + ".*")]
    return {"p": [float(value) for value in np.reshape(values, (-1, 4))[:, 3]], "s": [float(value) for value in np.reshape(values, (-1, 4))[:, 0]], "lines": lines}


def main():
    shown = window.Window(Path(sys.argv[2]))
    for _ in range(5):
        shown.step()
    print(json.dumps({"punch": punch, "lug": lug, "stop": stop, "feet": feet}[sys.argv[1]](shown)))


if __name__ == "__main__":
    main()
