"""The reference of parabola_1, which has no exact answer, and how far it can be trusted.

Both plates get the same number of columns, so that nothing is lost at the contact line, and elements that shrink
towards the ends of the line, where the stress is singular (8 nodes, quadratic multipliers). Three gradings are solved:
column i of n lies at (2 i / n)^g / 2 of the width, g = 2, 3, 4, and the rows shrink likewise. They share nothing but
the number of columns: their errors at the ends and in the middle differ by much. The middle one is the reference.

- pressure: how far the other two are from it, in each norm, is what it can be trusted to, times SAFETY.
- energy: of each grading extrapolated to h = 0 (Aitken on n / 4, n / 2, n); the reference is that of g = 3, trusted to
  its distance from that of g = 2, times SAFETY. Gradings of 4 and more do not serve there: round-off of their
  smallest elements (1e-10 of the width) is seen in the energy.

At the ends p grows as r^(a - 1), where the strain energy converges as h^(2 a) on even meshes. On parabola_1 a is about
0.4: p^2 has no finite integral, and p in L2 of the whole line does not exist. So there errors in p are those without a
tenth of the length at each end.
"""

import json
import math
import tempfile
from pathlib import Path

import chart_runs
import errors
import known

COLUMNS = {"full": 384, "quick": 64}
GRADINGS = (2, 3, 4)
CHOSEN = 3
SAFETY = 2
KEYS = ("e_p_l2_inner", "e_p_max_inner")


def solve(columns, grading, path=None, reference=None):
    """One run's row; its pressure goes to a file, its errors are against a reference."""
    sizes = {"mesh.parameters.n_upper": columns, "mesh.parameters.n_lower": columns}
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        row = chart_runs.solve("parabola_1", {**sizes, "chart.grading": grading, "method.multipliers": "quadratic"}, folder)
        if path:
            errors.write_pressure(folder, path)
        return row | errors.of_run(folder, known.known("parabola_1", reference))


def aitken(energies):
    """The limit of three energies on meshes each half as wide as the one before, and the rate of their approach."""
    a, b, c = energies
    ratio = (b - a) / (c - b)
    return c + (c - b) / (ratio - 1), math.log2(ratio)


def make(columns, folder):
    """Solves everything into reference.csv (x, p) and reference.json of the folder."""
    path = folder / "reference.csv"
    chosen = solve(columns, CHOSEN, path)
    others = {g: solve(columns, g, reference=path) for g in GRADINGS if g != CHOSEN}
    limits = {}
    for g in (2, CHOSEN):
        finest = chosen if g == CHOSEN else others[g]
        energies = [solve(columns // part, g)["energy"] for part in (4, 2)]
        limits[g] = aitken([*energies, finest["energy"]])
    even = [solve(columns // part, 1)["energy"] for part in (4, 2)]
    energy = limits[CHOSEN][0]
    trust = abs(limits[CHOSEN][0] - limits[2][0]) / energy
    table = {
        **{"columns": columns, "unknowns": chosen["dofs"], "energy": energy},
        "energy_rates": {g: rate for g, (_, rate) in limits.items()},
        "energy_limits": {g: limit for g, (limit, _) in limits.items()},
        "energy_rate_even_meshes": math.log2((energy - even[0]) / (energy - even[1])),
        "differences": {g: {key: row[key] for key in KEYS} for g, row in others.items()},
        "trust": {
            **{key: SAFETY * max(row[key] for row in others.values()) for key in KEYS},
            "energy": SAFETY * trust,
            "e_energy": math.sqrt(SAFETY * trust),
        },
    }
    (folder / "reference.json").write_text(json.dumps(table))


def reference(store, quick):
    """The table, and the path of x,p."""
    columns = COLUMNS["quick" if quick else "full"]
    folder = store.results(["reference", columns], lambda _, folder: make(columns, folder), "reference")
    return json.loads((folder / "reference.json").read_text()), folder / "reference.csv"

