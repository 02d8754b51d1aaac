"""One case of the fuzzer: files, one call of mortise, and what may come of it."""

import os
import stat
from dataclasses import dataclass, field
from typing import Callable, NamedTuple

ANY, SOLVED, REFUSED = "any", "solved", "refused"


class Link(str):
    """A symbolic link to this path."""


def make_full_device(path):
    """A node of the device that is always full, of the case's own: a program may replace what it writes to. Needs root;
    without, a pipe is as unfit for results."""
    try:
        os.mknod(path, stat.S_IFCHR | 0o666, os.makedev(1, 7))
    except OSError:
        os.mkfifo(path)


PIPE, FOLDER, FULL_DEVICE = "a pipe that nobody writes to", "an empty folder", "a full device"
MAKERS = {PIPE: os.mkfifo, FOLDER: lambda path: os.makedirs(path, exist_ok=True), FULL_DEVICE: make_full_device}


class Twin(NamedTuple):
    """A second call whose pressures must be those of the first: the same problem said, or solved, in another way."""

    name: str
    case: "Case"
    factor: float = 1.0  # its pressures over the first's
    back: Callable = lambda x, y: (x, y)  # from its places to the first's
    limit: float = 1e-6  # largest difference of p, over the largest p
    same_verdict: bool = True  # the exit status must be the same too


@dataclass
class Case:
    kind: str  # row of the summary table
    what: str  # what is strange in it
    files: dict  # path in the case's folder: bytes, Link, or a key of MAKERS
    words: list  # arguments of mortise, which runs in that folder
    expect: str = ANY  # REFUSED: only exit status 1 is right; SOLVED: only 0 or 2
    output: tuple = ()  # paths that the call may make or change
    results: str | None = None  # folder in which summary.json must stand if the exit status is 0 or 2
    thrust: float | None = None  # force of every contact pair, from equilibrium
    accuracy: float = 1e-6  # how far forces may be off, relatively
    largest_file: int | None = None  # bytes after which the disk is full
    setting: object = None  # the Setting of a valid scene
    twins: list = field(default_factory=list)
    # Of a case whose answer is held against what is known otherwise:
    judge: Callable | None = None  # (case, outcome, folder, References): one of references.LABELS, what is wrong or None
    group: str = ""  # row of the table of what the answers are worth
    reference: Callable | None = None  # files of it: on edges so many times as long (1, 2), where contact ends at places
    asked: float | None = None  # the accuracy of p; None: on a mesh of its own, where the bars are held
    middles: bool = True  # whether edges have middle nodes
    named: list = field(default_factory=list)  # words that a warning of the feature has, or else a place near one of
    places: list = field(default_factory=list)  # these (x, y); None: any
    smooth: tuple = ()  # places beside which p of a reference swings and is smooth
    variant: str = ""  # of an assembly: how it is solved again, its files, and how these see it
    other: dict = field(default_factory=dict)
    view: object = None

    def write(self, folder):
        """Puts the files into `folder`."""
        for name, content in self.files.items():
            path = os.path.join(folder, name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            if isinstance(content, bytes):
                with open(path, "wb") as file:
                    file.write(content)
            elif isinstance(content, Link):
                os.symlink(content, path)
            else:
                MAKERS[content](path)


def solve_case(kind, what, scene, mesh, mesh_file="mesh.msh", **settings):
    """`mortise solve scene.toml` of a scene and a mesh, both bytes."""
    files, words = {"scene.toml": scene, mesh_file: mesh}, ["solve", "scene.toml", "-o", "results"]
    return Case(kind, what, files, words, output=("results",), results="results", **settings)
