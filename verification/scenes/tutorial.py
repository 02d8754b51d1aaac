"""docs/tutorial.md as a reader does it: its commands as they are printed, its buttons by a mouse under Xvfb.

Run: writes the pictures of the page into docs/tutorial (needs Xvfb and xdotool).
"""

import json
import os
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "common"))

import launch

sys.path[:0] = [str(launch.ROOT / "verification/pages")]

import markdown
from PIL import Image

PAGE = launch.ROOT / "docs/tutorial.md"
TEXT = markdown.sections(PAGE.read_text())
DRAW, CURVES, SCENE, SOLVE, TRY, GROW, HAND_OVER, MOUSE = TEXT
BY_FILES = {"curves": "curves.png", "setup": "setup.png", "picture": "out/lug.png", "zoom": "zoom.png",
            "compare": "compare.png", "steps": "out/steps.png"}  # fmt: skip
BY_MOUSE = ("opened", "message", "window", "solved")


def by_files(mortise, folder):
    """What the commands of each section print, and the scene as `mortise new` began it."""

    def typed(command):
        words = [str(mortise) if word == "mortise" else word for word in command.split()]
        return launch.run(words, expected=(0,), cwd=folder, env=os.environ | launch.ONE_THREAD)[0].stdout

    drawing = markdown.files(TEXT[DRAW])["lug.geo"]
    (folder / "lug.geo").write_text(drawing)
    said = {CURVES: typed(*markdown.commands(TEXT[CURVES]))}
    (folder / "lug.geo").write_text(drawing + markdown.files(TEXT[CURVES])["lug.geo"])
    new, check = markdown.commands(TEXT[SCENE])
    typed(new)
    begun, full = (folder / "lug.toml").read_text(), markdown.files(TEXT[SCENE])["lug.toml"]
    (folder / "lug.toml").write_text(full)
    (folder / "steps.toml").write_text(full + markdown.files(TEXT[GROW])["steps.toml"])
    said[SCENE] = typed(check)
    for heading in (SOLVE, TRY, GROW, HAND_OVER):
        said[heading] = "".join(map(typed, markdown.commands(TEXT[heading])))
    return said, begun


@contextmanager
def screen():
    """The number of a display that nobody sees."""
    read, write = os.pipe()
    server = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1400x900x24"]
    with subprocess.Popen(server, pass_fds=[write], stderr=subprocess.DEVNULL) as running:
        yield ":" + os.read(read, 20).decode().strip()
        running.terminate()
    os.close(read)
    os.close(write)


def drive(mortise, display, folder, *words):
    """What the window told that drive_window.py had open."""
    environment = {"DISPLAY": display, "MORTISE_PROGRAM": str(mortise), "PYTHONPATH": str(Path(launch.__file__).parent)}
    command = [sys.executable, Path(__file__).with_name("drive_window.py"), *words]
    options = {"cwd": folder, "env": os.environ | environment, "capture_output": True, "text": True, "timeout": 120}
    done = subprocess.run(command, check=False, **options)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    return json.loads(done.stdout.splitlines()[-1])


def by_mouse(mortise, display, folder):
    (folder / "lug.geo").write_text(markdown.files(TEXT[DRAW])["lug.geo"])
    return drive(mortise, display, folder, "lug", "lug.geo")


def main():
    import figure

    with tempfile.TemporaryDirectory() as files, tempfile.TemporaryDirectory() as mouse, screen() as display:
        by_files(launch.MORTISE, Path(files))
        by_mouse(launch.MORTISE, display, Path(mouse))
        for name in BY_MOUSE:
            at = Path(mouse) / f"{name}.png"
            small = Image.open(at).convert("RGB").crop((20, 30, 1270, 876)).resize((1000, 677), Image.LANCZOS)
            small.quantize(256).save(PAGE.with_suffix("") / at.name, optimize=True)
        for name, at in BY_FILES.items():
            figure.copy_small(Path(files) / at, PAGE.with_suffix("") / f"{name}.png")


if __name__ == "__main__":
    main()
