"""One run of a program on parabola_1, a whole process: its seconds, its memory, its pressure."""

import functools
import os
import re
import sys

import launch
import numpy as np
import parabola_mesh
import peer_runs

HERE = launch.Path(__file__).resolve().parent
SCENE = """
mesh.file = "mesh.msh"
materials.steel = { young = 210e9, poisson = 0.3 }
bodies = { upper = "steel", lower = "steel" }
boundary = [
  { on = ["upper_left", "upper_right", "lower_left", "lower_right"], displacement = { x = 0 } },
  { on = "bottom", displacement = { x = 0, y = 0 } },
  { on = "top", pressure = 10e6 },
]
contact = [{ between = ["upper_contact", "lower_contact"], condition = "bilateral", initial_gap = "closed" }]
"""
# The labels of parabola_mesh.write_freefem: upper left, right, contact (3), top; lower left, right, bottom, contact (8).
CASE = """plane strain
mesh mesh_freefem.msh
body 210e9 0.3
body 210e9 0.3
contact 8 3
order 2
multipliers 1
integration segments
gauss 5
gap closed
displacement 1 x 0
displacement 2 x 0
displacement 5 x 0
displacement 6 x 0
displacement 7 x 0
displacement 7 y 0
pressure 4 10e6
end
"""

# Starts a program and prints its exit status, seconds and memory: from a process of a few MB, since the memory of the
# one that forks counts as its child's.
METER = """
import os, sys, time
start = time.perf_counter()
nowhere = os.open(os.devnull, os.O_WRONLY)
files = [(os.POSIX_SPAWN_DUP2, nowhere, 1), (os.POSIX_SPAWN_DUP2, nowhere, 2)]
_, status, usage = os.wait4(os.posix_spawnp(sys.argv[1], sys.argv[1:], os.environ, file_actions=files), 0)
print(os.waitstatus_to_exitcode(status), usage.ru_utime + usage.ru_stime, time.perf_counter() - start,
      usage.ru_maxrss / 1024)
"""


def prepare(folder, sizes, grading, names):
    """The meshes and what else the programs read; a mesh file costs nobody seconds."""
    folder.mkdir(parents=True)
    parabola_mesh.write_gmsh(folder / "mesh.msh", sizes, grading)
    (folder / "scene.toml").write_text(SCENE)
    if "FreeFEM" in names:
        parabola_mesh.write_freefem(folder / "mesh_freefem.msh", sizes, grading)
        (folder / "case.txt").write_text(CASE)


def command(name, folder, sizes, threads=1):
    if name == "mortise":
        return [launch.need(launch.MORTISE), "solve", folder / "scene.toml", "-o", folder / "out", "--quiet",
                "--no-estimate", "--threads", threads]  # fmt: skip
    if name == "FreeFEM":
        return ["FreeFem++", "-nw", "-v", "0", launch.ROOT / "freefem/mortar.edp", "-case", folder / "case.txt"]
    return [sys.executable, HERE / "getfem_plates.py", *sizes, folder / "getfem.csv"]


def version(name):
    """Of a program that is there, else None."""
    if name == "mortise":
        return launch.run([launch.need(launch.MORTISE), "--version"])[0].stdout.strip().replace("\n", "; ")
    return peer_runs.version(name)


@functools.cache
def dense_kernel():
    return re.search(r"OpenBLAS \S+ (\w+)", version("mortise"))[1]


def measured(words, own_threads=False):
    """Processor and wall seconds and peak memory (MB) of a process; on one thread, unless it knows how many."""
    own = {"FF_LOADPATH": "/usr/lib/freefem++", "FF_INCLUDEPATH": str(launch.ROOT / "freefem")}
    environment = {**own, **os.environ}
    if "--threads" not in words and not own_threads:  # the others; the dense kernel that mortise has chosen, too
        environment = {**launch.ONE_THREAD, "OPENBLAS_CORETYPE": dense_kernel(), **environment}
    done, _ = launch.run([sys.executable, "-SEc", METER, *words], range(256), env=environment)
    status, seconds, wall, megabytes = map(float, done.stdout.split())
    if status not in launch.SOLVED:
        raise launch.StudyError(f"{' '.join(map(str, words))}: exit status {status:.0f}")
    return {"seconds": seconds, "wall": wall, "megabytes": megabytes}


def pressure(name, folder):
    """x and p along the side of the multipliers, from left to right."""
    if name == "mortise":
        table = launch.contact(folder / "out")
        x, p = table["x"], table["p"]
    elif name == "FreeFEM":
        _, x, _, p, *_ = np.loadtxt(folder / "freefem_contact.txt").T
    else:
        x, p = np.loadtxt(folder / "getfem.csv", delimiter=",", skiprows=1).T
    order = np.argsort(x)
    return x[order], p[order]


def unknowns(name, sizes):
    """Displacements: 8-node elements have no middle node."""
    nodes = sum((2 * n + 1) * (2 * round(0.375 * n) + 1) for n in sizes)
    return 2 * (nodes - (sum(n * round(0.375 * n) for n in sizes) if name == "mortise" else 0))
