"""Two seconds of the chart against the executable itself, timed from outside.

The whole process `mortise solve --no-estimate --threads 1` by time.perf_counter, less the meshing and writing that its
summary.json reports, less the start of a process that does nothing (`mortise --version`: loading of the libraries).
What remains should be the chart's seconds: the ratio of the two is near 1, a little above it for what nobody counts
(reading the scene, freeing memory). Other work on the machine spoils it; therefore the same by processor time too, of
`mortise solve` less `mortise mesh`, which starts, meshes and writes a file of about the same size.
"""

import os
import statistics
import tempfile
from pathlib import Path

import chart_runs  # makes launch known
import launch
from chart_methods import mesh_of, ways

PICKED = {
    "full": (("parabola_1", "q8_linear", 4), ("rings", "q4_linear", 5)),
    "quick": (("parabola_1", "q8_linear", 2), ("rings", "q4_linear", 2)),
}
REPEATS = 5


def seconds_of(*arguments):
    """Of a process of mortise: by the wall clock, and of the processor."""
    before = launch.processor_seconds()
    _, whole = launch.run([launch.MORTISE, *arguments], env={**os.environ, **launch.ONE_THREAD})
    return whole, launch.processor_seconds() - before


def timed(problem, settings, folder):
    """Seconds of one process less meshing and writing; of the stages that it reports; of the processor less meshing."""
    arguments = [launch.scene_file(problem), *launch.options(settings)]
    whole, processor = seconds_of("solve", *arguments, "-o", folder, "--quiet", "--no-estimate", "--threads", 1)
    _, meshing = seconds_of("mesh", *arguments, "-o", folder / "mesh.msh")
    own = launch.summary(folder)["seconds"]
    return whole - own["mesh"] - own["write"], own["total"] - own["mesh"] - own["write"], processor - meshing


def check(rows, quick):
    """A row for each picked figure that the chart has: its seconds there, those of the process, their ratio."""
    found = []
    start = statistics.median(seconds_of("--version")[0] for _ in range(REPEATS))
    for problem, method, level in PICKED["quick" if quick else "full"]:
        mesh = launch.mesh_name(mesh_of(problem, level))
        key = (problem, method, mesh)
        charted = next((row for row in rows if (row["problem"], row["method"], row["mesh"]) == key), None)
        if charted is None:
            continue
        settings = dict(ways(problem, level, quick))[method]
        with tempfile.TemporaryDirectory() as folder:
            outside, inside, processor = zip(*(timed(problem, settings, Path(folder)) for _ in range(REPEATS)))
        process = statistics.median(outside) - start
        found.append(
            {
                **{"problem": problem, "method": method, "mesh": mesh, "chart": charted["s_total"]},
                **{"process": process, "start": start, "reported": statistics.median(inside)},
                "ratio": process / charted["s_total"],
                "processor": statistics.median(processor),
                "processor_ratio": statistics.median(processor) / charted["s_total"],
            }
        )
    return found
