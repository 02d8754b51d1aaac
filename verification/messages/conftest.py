import subprocess

import pytest

import msh_file
from plates_scene import PLATES, SCENE


@pytest.fixture
def said(mortise, tmp_path):
    """What the program says of a scene, changed by --set or by text behind it, and of files beside it."""

    def run(*settings, more="", scene=SCENE, command="check", files=None, name="scene.toml", options=()):
        files = {"plates.msh": msh_file.write(msh_file.sections(PLATES, "4.1 ascii"), "4.1 ascii"), **(files or {})}
        files = {**files, name: (scene + more).encode()}
        for file, content in files.items():
            (tmp_path / file).write_bytes(content)
        words = [mortise, command, name, *(word for setting in settings for word in ("--set", setting)), *options]
        done = subprocess.run([str(word) for word in words], cwd=tmp_path, text=True, capture_output=True, timeout=100)
        assert done.returncode != 3
        return " ".join((done.stdout + done.stderr).split())

    return run
