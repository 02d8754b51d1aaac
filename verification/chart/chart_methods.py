"""What is charted: the methods, the problems and their meshes. Data only.

A method is a dictionary of the scene's keys (docs/files.md), as `mortise solve --set` takes them, so that every curve
can be had again by hand. A row whose keys the executable refuses is skipped, and says so.
"""

import sys
from pathlib import Path

for folder in ("common", "crosscheck"):
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / folder))

import launch

T3 = {"mesh.parameters.kind": 1, "mesh.parameters.order": 1}
T6 = {"mesh.parameters.kind": 1}
Q4 = {"mesh.parameters.order": 1}
Q9 = {"mesh.parameters.nine_node": 1}
DDM = {"method.solver": "ddm", "method.max_iterations": 1000}
FIXED = {**DDM, "method.acceleration": "none"}
QUADRATIC, LINEAR, DUAL = ({"method.multipliers": name} for name in ("quadratic", "linear", "dual"))

# name: the label of its curve, settings, and the largest number of times that its coarsest mesh is halved
METHODS = {
    "q8_linear": ("Q8, linear (default)", LINEAR, 5),
    "q8_quadratic": ("Q8, quadratic", QUADRATIC, 5),
    "q8_dual": ("Q8, dual", DUAL, 4),
    "q8_elements": ("Q8, linear, no cutting", {**LINEAR, "method.integration": "elements"}, 4),
    "q8_coarser": ("Q8, linear, coarser side", LINEAR, 4),
    "q9_linear": ("Q9, linear", {**Q9, **LINEAR}, 5),
    "t6_linear": ("T6, linear", {**T6, **LINEAR}, 5),
    "t6_quadratic": ("T6, quadratic", {**T6, **QUADRATIC}, 4),
    "q4_linear": ("Q4, linear", {**Q4, **LINEAR}, 6),
    "t3_linear": ("T3, linear", {**T3, **LINEAR}, 6),
    "q8_ddm": ("Q8, DDM (default)", {**LINEAR, **DDM}, 5),
    "q8_ddm_fixed": ("Q8, DDM, fixed β", {**LINEAR, **FIXED}, 4),
    "t3_ddm_fixed": ("T3, DDM, β = 0.3", {**T3, **LINEAR, **FIXED, "method.beta": 0.3}, 5),
    "q8_mssor": ("Q8, MSSOR", {**LINEAR, "method.solver": "mssor"}, 4),
}
# Only where the mesh may shrink towards the ends of the contact line: parabola_1.
GRADED = {"q8_graded": ("Q8, linear, graded mesh", {**LINEAR, "chart.grading": 3}, 5)}
# The whole loop of `mortise solve --accuracy`, meshes included; a point an accuracy.
ASKED = {"asked": ("asked accuracy, with meshing", LINEAR, 6)}
ACCURACIES = (0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005)
# Program, order of the displacements; linear multipliers; FreeFEM: segments, straight-sided triangles.
PEERS = {
    "freefem_p1": ("FreeFEM P1", "FreeFEM", 1, 5),
    "freefem_p2": ("FreeFEM P2", "FreeFEM", 2, 4),
    "getfem_q8": ("GetFEM Q8", "GetFEM", 2, 4),
}

# Settings of a method that have other names in each problem. beta = 0.3 and the roles with it are the preprint's: the
# upper body takes the displacement; on the rings the program's choice, the soft outer one.
OWN = {
    "q8_coarser": {
        "manufactured": {"contact.multipliers_on": "upper_contact"},
        "rings": {"contact.multipliers_on": "inner_contact"},
        "parabola_1": {"contact.multipliers_on": "upper_contact"},
    },
    "t3_ddm_fixed": {
        "manufactured": {"method.dirichlet": "upper"},
        "rings": {},
        "parabola_1": {"method.dirichlet": "upper"},
    },
}

# The scene, its size parameters, the coarsest mesh, and the curve with more elements, of the others' multipliers.
PROBLEMS = {
    "manufactured": {
        "title": "Manufactured field on two plates along a parabola (exact)",
        "sizes": ("n_upper", "n_lower"),
        "coarsest": (8, 10),
        "scene": Path(__file__).with_name("manufactured.toml"),
        "finer": "lower_contact",
    },
    "rings": {
        "title": "Two rings under pressure (Lamé, exact)",
        "sizes": ("n_inner", "n_outer"),
        "coarsest": (6, 8),
        "scene": "rings",
        "finer": "outer_contact",
    },
    "parabola_1": {
        "title": "Two plates along parabola 1 (against a reference)",
        "sizes": ("n_upper", "n_lower"),
        "coarsest": (8, 10),
        "scene": "parabola_1",
        "finer": "lower_contact",
    },
}
ERRORS = ("e_energy", "e_p_l2", "e_p_l2_inner", "e_p_max_inner")  # errors.py
# The errors that are drawn; the advice goes by the first.
PANELS = {
    "manufactured": ("e_p_l2", "e_energy", "e_p_max_inner"),
    "rings": ("e_p_l2", "e_energy", "e_p_max_inner"),
    "parabola_1": ("e_p_l2_inner", "e_energy", "e_p_max_inner"),
}
QUICK_METHODS = ("asked", "q8_linear", "q8_quadratic", "q4_linear", "t3_linear", "q8_ddm", "q8_mssor", "q8_graded", "freefem_p1",
                 "getfem_q8")  # fmt: skip
LEVELS = {"full": 7, "quick": 3}
TURNS = {"full": 5, "quick": 2}


def mesh_of(problem, level):
    """Elements along the two contact curves after so many halvings."""
    return tuple(n << level for n in PROBLEMS[problem]["coarsest"])


def row_name(problem, method, mesh):
    """What a row's mesh is called: of an asked accuracy, that."""
    if method != "asked":
        return launch.mesh_name(mesh)
    return f"{100 * ACCURACIES[(mesh[0] // PROBLEMS[problem]['coarsest'][0]).bit_length() - 1]:g} % asked"


def size_settings(problem, mesh):
    return {f"mesh.parameters.{key}": n for key, n in zip(PROBLEMS[problem]["sizes"], mesh)}


def ways(problem, level, quick):
    """Name and settings of the methods that are run by mortise at a level."""
    table = {**METHODS, **(GRADED if problem == "parabola_1" else {}), **ASKED}
    for name, (_, settings, deepest) in table.items():
        if level <= deepest and (not quick or name in QUICK_METHODS):
            own = OWN.get(name, {}).get(problem, {}) if name != "asked" else {"accuracy.value": ACCURACIES[level]}
            yield name, {**size_settings(problem, mesh_of(problem, level)), **settings, **own}


def peer_ways(level, quick):
    """Name, program and order of the displacements of what others run at a level."""
    for name, (_, program, order, deepest) in PEERS.items():
        if level <= deepest and (not quick or name in QUICK_METHODS):
            yield name, program, order


def label(name):
    return {**METHODS, **GRADED, **ASKED, **PEERS}[name][0]
