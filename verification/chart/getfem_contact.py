"""A scene of two bodies by GetFEM (Debian: python3-getfem):

  /usr/bin/python3 getfem_contact.py SCENE.toml MESH.msh MULTIPLIER_CURVE FOLDER [KEY=VALUE...]

The mesh's own elements, of 6 or 8 nodes, with their curved sides; multipliers of order 1 on the side of
MULTIPLIER_CURVE. All terms are in GetFEM's weak form language. GetFEM's raytracing finds the place opposite a Gauss
point, along the normal, in the undeformed bodies. Unilateral contact is Alart & Curnier's augmented Lagrangian (1991),
solved by GetFEM's Newton steps from the bilateral solution, with MUMPS. An edge is integrated in CUTS pieces: GetFEM does
not find the segments.

Written are FOLDER/getfem_bodies.txt (body x y u1 u2 at each node; bodies in mortise's order), getfem_contact.txt (0 x y
p 0 at each multiplier) and getfem_summary.txt (unknowns, steps, seconds of the processor).
"""

import ast
import sys
import time
from pathlib import Path

import getfem as gf
import meshio
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "crosscheck"))

import cases  # noqa: F401  makes common/ known
import convert
import scene as scenes

CUTS = 5
STIFF = 1e9  # of E, springs that prescribe displacements: GetFEM eliminates whole vectors only
AUGMENTATION = 0.01  # of E over the shortest edge
STEPS = 100
ELEMENTS = {  # of meshio: map, displacements, multipliers, integration, meshio's nodes in GetFEM's order
    "triangle6": ("GT_PK(2,2)", "FEM_PK(2,2)", "FEM_PK(2,1)", "IM_TRIANGLE(6)", [0, 3, 1, 5, 4, 2]),
    "quad8": ("GT_Q2_INCOMPLETE(2)", "FEM_Q2_INCOMPLETE(2)", "FEM_QK(2,1)", "IM_GAUSS_PARALLELEPIPED(2,5)",
              [0, 4, 1, 7, 5, 3, 6, 2]),
}  # fmt: skip
PLACES = {"x": "X(1)", "y": "X(2)"}


class WeakForm(ast.NodeTransformer):
    """Of a scene's functions of place."""

    def visit_Name(self, node):
        return ast.parse(PLACES.get(node.id, node.id), mode="eval").body

    def visit_BinOp(self, node):
        node = self.generic_visit(node)
        return ast.Call(ast.Name("pow"), [node.left, node.right], []) if isinstance(node.op, ast.Pow) else node


def expression(value):
    """A number or a function of place in the weak form language; of conditions `a < b ? c : d`."""
    if not isinstance(value, str):
        return repr(float(value))
    condition, chosen, values = value.partition("?")
    if chosen:
        (small, large), (inside, outside) = condition.split("<"), values.split(":", 1)
        step = expression(f"Heaviside({large} - ({small}))")
        return f"({step} * ({expression(inside)}) + (1 - {step}) * ({expression(outside)}))"
    return ast.unparse(WeakForm().visit(ast.parse(value.strip().replace("^", "**"), mode="eval")))


class Body:
    """Its mesh with the curves as regions, and its integration rules: of the elements, and in pieces of an edge."""

    def __init__(self, mesh, name, tags):
        self.mesh, self.kinds, places, own = gf.Mesh("empty", 2), [], mesh.points[:, :2], []
        for block, chosen in zip(mesh.cells, mesh.cell_sets[name]):
            if chosen is not None and len(chosen) and block.type in ELEMENTS:
                cells = block.data[np.asarray(chosen, dtype=int)]
                shape, *_, order = ELEMENTS[block.type]
                numbers = self.mesh.add_convex(gf.GeoTrans(shape), places[cells[:, order]].transpose(2, 1, 0))
                self.kinds.append((block.type, numbers))
                own.append(np.unique(cells))
        boundary = {tuple(face) for face in self.mesh.outer_faces().T}
        self.curves = []
        for curve, tag in tags.items():
            nodes = np.intersect1d(nodes_of(mesh, curve), np.concatenate(own))
            faces = self.mesh.faces_from_pid(np.ravel(self.mesh.pid_from_coords(places[nodes].T)))
            if faces := [face for face in map(tuple, faces.T) if face in boundary]:
                self.mesh.set_region(tag, np.array(faces).T)
                self.curves.append(tag)
        self.rule, self.pieces = self.integration("{}"), self.integration(f"IM_STRUCTURED_COMPOSITE({{}},{CUTS})")

    def integration(self, form):
        rule = gf.MeshIm(self.mesh)
        for kind, numbers in self.kinds:
            rule.set_integ(gf.Integ(form.format(ELEMENTS[kind][3])), numbers)
        return rule

    def field(self, components):
        """Displacements (2) or multipliers (1)."""
        field = gf.MeshFem(self.mesh, components)
        for kind, numbers in self.kinds:
            field.set_fem(gf.Fem(ELEMENTS[kind][1 if components == 2 else 2]), numbers)
        return field


def nodes_of(mesh, curve):
    blocks = zip(mesh.cells, mesh.cell_sets[curve])
    lines = (block.data[np.asarray(chosen, dtype=int)] for block, chosen in blocks if block.type == "line3")
    return np.concatenate([cells.ravel() for cells in lines])


class Problem:
    """The scene as terms of a model; displacements of body k are u<k>, the multipliers p, on the curve `tag`."""

    def __init__(self, scene, mesh, curve):
        surfaces = {name: tag for name, (tag, dimension) in mesh.field_data.items() if dimension == 2}
        names = sorted(scenes.named(list(scene["bodies"]), surfaces), key=surfaces.get)
        self.scene, self.names, self.tags = scene, names, convert.curve_tags(mesh)
        self.bodies = [Body(mesh, name, self.tags) for name in names]
        self.plane = scene.get("model", {}).get("plane", "strain")
        self.weight = "X(1) * " if self.plane == "axisymmetric" else ""
        self.model = gf.Model("real")
        self.works = [self.add_elasticity(k) for k in range(len(names))]
        for entry in scene.get("boundary", []):
            scenes.refuse_others(entry, {"on", "displacement", "pressure", "traction"})
            for tag in (self.tags[name] for name in scenes.named(entry["on"], self.tags)):
                for k in self.owners(tag):
                    self.add_boundary(k, tag, entry)
        for entry in scene.get("body_force", []):
            for name in scenes.named(entry["body"], names):
                self.add_load(names.index(name), -1, entry["force"])
        (contact,) = scene["contact"]
        (other,) = (name for name in contact["between"] if name != curve)
        self.tag, self.unilateral = self.tags[curve], contact.get("condition", "unilateral") == "unilateral"
        self.add_contact(self.tags[other], contact.get("initial_gap", "curve"))

    def young(self, k):
        return scenes.material_of(self.scene, self.names[k])["young"]

    def owners(self, tag):
        """The bodies that have the curve."""
        return [k for k, body in enumerate(self.bodies) if tag in body.curves]

    def add_term(self, k, terms, region=-1):
        self.model.add_linear_term(self.bodies[k].rule, f"{self.weight}({terms})", region)

    def add_elasticity(self, k):
        """Returns the virtual work of the stresses."""
        u, field = f"u{k}", self.bodies[k].field(2)
        self.model.add_fem_variable(u, field)
        self.model.add_initialized_fem_data(f"nowhere{k}", field, np.zeros(field.nbdof()))
        poisson = scenes.material_of(self.scene, self.names[k])["poisson"]
        mu = self.young(k) / 2 / (1 + poisson)
        la = 2 * mu * poisson / (1 - poisson if self.plane == "stress" else 1 - 2 * poisson)
        hoop = f"{u}(1) / X(1)" if self.weight else "0"
        trace = f"(Trace(Grad_{u}) + {hoop})"
        work = f"({la!r} * {trace} * Id(2) + {2 * mu!r} * Sym(Grad_{u})) : Grad_Test_{u}"
        if self.weight:
            work += f" + ({la!r} * {trace} + {2 * mu!r} * {hoop}) * Test_{u}(1) / X(1)"
        self.add_term(k, work)
        return work

    def add_load(self, k, region, vector):
        self.add_term(k, f"-[{', '.join(map(expression, vector))}] . Test_u{k}", region)

    def add_boundary(self, k, tag, entry):
        for component, value in entry.get("displacement", {}).items():
            u = f"u{k}({'xy'.index(component) + 1})"
            stiff = f"{STIFF * self.young(k)!r} * ({u} - ({expression(value)})) * Test_{u}"
            self.model.add_linear_term(self.bodies[k].rule, stiff, tag)  # on the axis too, where the weight is 0
        if "pressure" in entry:
            self.add_term(k, f"({expression(entry['pressure'])}) * Normal . Test_u{k}", tag)
        if "traction" in entry:
            self.add_load(k, tag, entry["traction"])

    def add_contact(self, facing, given):
        """Opposite lies the curve `facing`; `given`: the scene's initial gap. Where the ray meets nothing p is 0."""
        (k,), (other,) = self.owners(self.tag), self.owners(facing)
        mesh = self.bodies[k].mesh
        self.model.add_filtered_fem_variable("p", self.bodies[k].field(1), self.tag)
        reach = float(np.ptp(mesh.pts(), axis=1).max()) / 10
        self.model.add_raytracing_transformation("across", reach)
        self.model.add_slave_contact_boundary_to_raytracing_transformation("across", mesh, f"nowhere{k}", self.tag)
        opposite = (self.bodies[other].mesh, f"nowhere{other}", facing)
        self.model.add_master_contact_boundary_to_raytracing_transformation("across", *opposite)

        of_curves = "(Interpolate(X, across) - X) . Normal"
        initial = of_curves if given == "curve" else expression(0 if given == "closed" else given)
        gap = f"({initial} + (Interpolate(u{other}, across) - u{k}) . Normal)"
        virtual = f"(Interpolate(Test_u{other}, across) - Test_u{k}) . Normal"
        edge = np.linalg.norm(np.diff(np.unique(self.multiplier_places(), axis=0), axis=0), axis=1).min()
        r = AUGMENTATION * min(self.young(k), self.young(other)) / edge
        pressed = f"p - {r!r} * {gap}"
        self.model.add_initialized_data("closed", 1)
        held = f"(closed * ({pressed}) + (1 - closed) * pos_part({pressed}))"
        for terms, met in ((f"{held} * {virtual} + (p - {held}) * Test_p / {r!r}", 1), (f"p * Test_p / {r!r}", 0)):
            filtered = f"Interpolate_filter(across, -{self.weight}({terms}), {met})"
            self.model.add_nonlinear_term(self.bodies[k].pieces, filtered, self.tag)

    def multiplier_places(self):
        field = self.model.mesh_fem_of_variable("p")
        return field.basic_dof_nodes()[:, field.basic_dof_on_region(self.tag)].T

    def solve(self):
        """Returns Newton's steps."""
        newton = lambda most: self.model.solve("max_res", 1e-9, "max_iter", most, "lsolver", "mumps")
        if self.unilateral:
            newton(1)
            self.model.set_variable("closed", 0)
        steps, converged = newton(STEPS)
        if not converged:
            sys.exit(f"GetFEM: no convergence in {STEPS} Newton steps")
        return steps + self.unilateral

    def energy(self):
        """Of the strains."""
        of_body = lambda k, work: gf.asm_generic(self.bodies[k].rule, 0, work.replace("Test_", ""), -1, self.model)
        return sum(float(of_body(k, f"{self.weight}({work}) / 2")) for k, work in enumerate(self.works))

    def write(self, folder, summary):
        places, p = self.multiplier_places(), self.model.variable("p")
        zero, form = np.zeros(len(p)), "%d" + " %.17g" * 4
        np.savetxt(folder / "getfem_contact.txt", np.c_[zero, places, p, zero], form)
        rows = []
        for k in range(len(self.bodies)):
            nodes = self.model.mesh_fem_of_variable(f"u{k}").basic_dof_nodes()[:, ::2].T
            rows.append(np.c_[np.full(len(nodes), k), nodes, self.model.variable(f"u{k}").reshape(-1, 2)])
        np.savetxt(folder / "getfem_bodies.txt", np.concatenate(rows), form)
        summary |= {"energy": self.energy(), "unknowns": self.model.nbdof() - len(p), "multipliers": len(p)}
        (folder / "getfem_summary.txt").write_text("".join(f"{key} {value!r}\n" for key, value in summary.items()))


def run(scene_file, mesh_file, curve, folder, settings):
    gf.util_trace_level(0)
    gf.util_warning_level(0)
    scene, mesh = scenes.read_scene(scene_file, settings), meshio.read(mesh_file, file_format="gmsh")
    start = time.process_time()
    problem = Problem(scene, mesh, curve)
    built = time.process_time()
    steps = problem.solve()
    end = time.process_time()
    problem.write(folder, {"steps": steps, "seconds_set_up": built - start, "seconds_solve": end - built})


if __name__ == "__main__":
    scene_file, mesh_file, curve, folder, *words = sys.argv[1:]
    run(Path(scene_file), Path(mesh_file), curve, Path(folder), dict(word.split("=", 1) for word in words))
