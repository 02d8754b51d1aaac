#!/usr/bin/python3
"""mortise in the menu of a gmsh that somebody has open, which starts this client (docs/files.md): onelab.py -onelab NAME SOCKET.
The protocol of gmsh 4.8: messages are two ints, kind and length, and so many bytes; the fields of a parameter are parted by a zero byte.
"""

import os, socket, struct, subprocess, sys
from pathlib import Path

START, STOP, INFO, ERROR, MERGE, RUN, PARAMETER, ASK = 1, 2, 10, 12, 20, 21, 23, 24


class Client:
    def __init__(self, place):
        self.wire = socket.socket(socket.AF_UNIX)
        self.wire.connect(place)
        self.send(START, str(os.getpid()))

    def send(self, kind, text):
        self.wire.sendall(struct.pack("ii", kind, len(text.encode())) + text.encode())

    def ask(self, name):
        """The value of a string, empty if gmsh has none of this name."""
        self.send(ASK, "\0".join(["1.3", "string", name, "", "", "", ""]))
        kind, length = struct.unpack("ii", self.wire.recv(8, socket.MSG_WAITALL))
        fields = self.wire.recv(length, socket.MSG_WAITALL).decode().split("\0")
        return fields[-4] if kind == PARAMETER else ""


def solve(client, program, geo):
    """The scene beside the .geo, written where there is none, and its results into gmsh's window."""
    scene, out = geo.with_suffix(".toml"), geo.parent / "out" / geo.stem
    command = [program, "solve", scene, "--accuracy", "1%", "-o", out] if scene.exists() else [program, "new", geo]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    for line in (done.stdout + done.stderr).splitlines():
        client.send(ERROR if line.startswith("mortise:") else INFO, line)
    if command[1] != "solve" or done.returncode not in (0, 2) or not (out / "summary.json").exists():
        return
    import gmsh, views  # they take a while

    gmsh.initialize(["mortise", "-v", "0"], False)
    views.show_results(out, 0)
    last, (stress, *_, pressure) = "View[PostProcessing.NbViews-1]", gmsh.view.getTags()
    for tag, file, options in ((stress, "stress.pos", f"{last}.IntervalsType = 2;"), (pressure, "pressure.pos", f"{last}.Type = 2; {last}.Axes = 2;")):
        gmsh.view.write(tag, str(out / file))
        client.send(MERGE, str(out / file))
        client.send(RUN, options)


def main(name, place):
    client = Client(place)
    beside = Path(__file__).absolute().parents[3] / "bin/mortise"  # as they are installed
    program = os.environ.get("MORTISE_PROGRAM", beside if beside.exists() else "mortise")
    geo = Path(client.ask("Gmsh/Model absolute path")) / client.ask("Gmsh/Model name")
    if client.ask(f"{name}/Action") == "compute" and geo.suffix == ".geo":  # gmsh asks "initialize" and "check" besides
        solve(client, program, geo)
    client.send(STOP, "Goodbye!")


main(*sys.argv[sys.argv.index("-onelab") + 1 :][:2])
