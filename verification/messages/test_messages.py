"""Each message of the program is provoked by a test that looks at it (messages.py); here those of the command line and of the machine."""

import resource
import shutil
import signal
import subprocess

import launch
import messages
from plates_scene import VTU

# What cannot be provoked in a test: what the machine lacks, or another program's fault.
ELSEWHERE = {
    "out of memory": "a machine that is full",
    "has more than 2^31 entries": "ten million unknowns of one body",
    "the copies have": "a thousand million nodes",
    "interrupted before the first solve": "a Ctrl-C of the right moment; Accuracy.* sees that nothing comes back",
    "its folder cannot be opened": "a user who may not read it: tests may run as root",
    "what was written cannot be read back": "a fault of our own writer",
    "what was written is not the whole mesh": "a fault of our own writer",
    "no space left on the device": "a disk that is full",
    "cannot write summary.json": "a disk that fills at the last moment",
}


def test_every_message_is_quoted_by_a_test():
    unsaid = [f"{m.place}: {' ... '.join(m.words)}" for m, by in messages.quoted_by()
              if not by and not any(key in " ".join(m.words) for key in ELSEWHERE)]  # fmt: skip
    assert not unsaid, "no test quotes:\n" + "\n".join(unsaid)


def test_what_is_left_out_is_a_message():
    said = " ".join(" ".join(m.words) for m in messages.messages())
    assert [key for key in ELSEWHERE if key not in said] == []


def test_command_lines_that_are_refused(said, tmp_path):
    for vary, message in [("x", "--vary 'x': expected KEY=VALUE1,VALUE2,... such as mesh.parameters.n_upper=20,40,80"),
                          ("x=", "--vary x=: no value; expected KEY=VALUE1,VALUE2,... such as mesh.parameters")]:  # fmt: skip
        assert message in said(command="sweep", options=["--vary", vary, "-o", "x.csv"])
    assert ("the scene has cases of its own; expected mortise solve, or a scene without [[case]]"
            in said("case=[{}]", command="sweep", options=["--vary", "boundary.2.pressure=1e6", "-o", "x.csv"]))  # fmt: skip
    (tmp_path / "taken.msh").write_text("mine")
    assert ("a file of this name is there that mortise did not write; choose another name or remove it"
            in said(command="mesh", options=["-o", "taken.msh"]))  # fmt: skip
    (tmp_path / "res").mkdir()
    assert ("T.vtu lies in the results folder; expected -o another folder"
            in said('fields.T={ file = "res/T.vtu" }', "boundary.2.pressure=T", files={"res/T.vtu": VTU.encode()}, command="solve",
                    options=["-o", "res"]))  # fmt: skip


def test_scenes_that_cannot_be_read(call):
    assert "the name of the scene is empty; expected a scene file (.toml)" in call("check", "", expected=1)
    assert "cannot be read; expected a readable file" in call("check", "/proc/self/mem", expected=1)


def test_program_without_its_parts(mortise, call, tmp_path):
    alone = {"program": shutil.copy(mortise, tmp_path), "expected": 1}
    assert "picture.py (Debian package mortise-python) is not there: expected in " in call("picture", tmp_path, **alone)
    said = call("check", launch.ROOT / "geo/patch_flat.toml", "--no-cache", **alone)
    assert "a .geo is meshed by gmsh (Debian package mortise-gmsh), which cannot be loaded: " in said
    said = call("picture", tmp_path, expected=1, MORTISE_PYTHON="/no/python")
    assert "picture.py is run by Python, which is not there (/no/python): apt-get install python3-matplotlib" in said


def test_disk_that_is_full(mortise, tmp_path):
    """Of files of 4 kB at most."""
    limit = lambda: (signal.signal(signal.SIGXFSZ, signal.SIG_IGN), resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096)))
    done = subprocess.run([mortise, "mesh", launch.ROOT / "geo/patch_flat.toml", "-o", tmp_path / "m.msh", "--no-cache"],
                          text=True, capture_output=True, timeout=100, preexec_fn=limit)  # fmt: skip
    assert done.returncode == 1 and "m.msh: cannot be written: File too large (is the disk full?)" in done.stderr


def test_output_that_cannot_be_written(mortise):
    with open("/dev/full", "w") as full:
        done = subprocess.run([mortise, "check", launch.ROOT / "geo/patch_flat.toml"], stdout=full, text=True,
                              stderr=subprocess.PIPE, timeout=100)  # fmt: skip
    assert done.returncode == 1 and "the standard output cannot be written" in done.stderr
