"""parabola_1 by GetFEM: /usr/bin/python3 getfem_plates.py N_UPPER N_LOWER PRESSURE.csv (Debian: python3-getfem).

The even meshes of parabola_mesh.py, biquadratic elements. Multipliers of order 1 on the upper plate's side for the normal
displacements, which GetFEM's weak form language takes across the line by an interpolate transformation; one solve by
MUMPS. PRESSURE.csv: x,p.
"""

import sys

import getfem as gf
import numpy as np
import parabola_mesh

YOUNG, POISSON, PRESSURE = 210e9, 0.3, 10e6
STIFF = 1e9 * YOUNG  # of the springs that hold sides and bottom: GetFEM eliminates whole vectors only
# Five pieces of an edge: the segments, where 4 elements stand on 5 and both are even in x. GetFEM does not find them.
PIECES = "IM_STRUCTURED_COMPOSITE(IM_GAUSS_PARALLELEPIPED(2,5),5)"
SIDES, DOWN, UP = 1, 2, 3


def mesh_of(body, columns):
    places = parabola_mesh.lattice(body, columns, 1)
    numbers = np.arange(places.shape[0] * places.shape[1]).reshape(places.shape[:2])
    cells = parabola_mesh.elements(numbers, [(j, i) for j in range(3) for i in range(3)], 2)
    mesh = gf.Mesh("empty", 2)
    mesh.add_convex(gf.GeoTrans("GT_QK(2,2)"), places.reshape(-1, 2)[cells].transpose(2, 1, 0))
    cell = np.arange(len(cells)).reshape(-1, columns)
    faces = lambda of, which: np.stack([of, np.full_like(of, which)])  # 0 right, 1 left, 2 up, 3 down
    mesh.set_region(SIDES, np.hstack([faces(cell[:, -1], 0), faces(cell[:, 0], 1)]))
    mesh.set_region(DOWN, faces(cell[0], 3))
    mesh.set_region(UP, faces(cell[-1], 2))
    return mesh


def run(n_upper, n_lower, path):
    gf.util_trace_level(0)
    meshes = {"u": mesh_of("upper", n_upper), "v": mesh_of("lower", n_lower)}
    mu = YOUNG / 2 / (1 + POISSON)
    model = gf.Model("real")
    model.add_initialized_data("mu", mu)
    model.add_initialized_data("la", 2 * mu * POISSON / (1 - 2 * POISSON))
    rules = {}
    for name, mesh in meshes.items():
        field = gf.MeshFem(mesh, 2)
        field.set_fem(gf.Fem("FEM_QK(2,2)"))
        model.add_fem_variable(name, field)
        rules[name] = gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(2,5)"))
        model.add_isotropic_linearized_elasticity_brick(rules[name], name, "la", "mu")
        model.add_linear_term(rules[name], f"{STIFF} * {name}(1) * Test_{name}(1)", SIDES, True)
    model.add_linear_term(rules["v"], f"{STIFF} * v.Test_v", DOWN, True)
    model.add_linear_term(rules["u"], f"{PRESSURE} * Test_u(2)", UP)
    multipliers = gf.MeshFem(meshes["u"], 1)
    multipliers.set_fem(gf.Fem("FEM_QK(2,1)"))
    model.add_filtered_fem_variable("p", multipliers, DOWN)
    model.add_interpolate_transformation_from_expression("across", meshes["u"], meshes["v"], "X")
    terms = "p * (Test_u - Interpolate(Test_v, across)).Normal + Test_p * (u - Interpolate(v, across)).Normal"
    across = model.add_linear_term(gf.MeshIm(meshes["u"], gf.Integ(PIECES)), terms, DOWN, True)
    # Two assemblies: in one, GetFEM takes ten times as long.
    model.disable_bricks([across])
    model.assembly()
    matrix, load = model.tangent_matrix(), model.rhs()
    model.disable_bricks(list(range(across)))
    model.enable_bricks([across])
    model.assembly()
    matrix = gf.Spmat("add", matrix, model.tangent_matrix())
    solution = np.ravel(gf.linsolve_mumps(matrix, load))
    first, count = model.interval_of_variable("p")
    field = model.mesh_fem_of_variable("p")
    x = field.basic_dof_nodes()[0][field.basic_dof_on_region(DOWN)]
    order = np.argsort(x)
    np.savetxt(path, np.c_[x, solution[first : first + count]][order], delimiter=",", header="x,p", comments="")
    print(model.nbdof())


if __name__ == "__main__":
    run(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3])
