"""Each message of the program is provoked by a test that looks at it (messages.py); here those that no other does."""

import dataclasses
import os
import resource
import shutil
import signal
import subprocess

import pytest

import deck_files
import launch
import messages
import msh_file
import plates

# What cannot be provoked in a test: what the machine lacks, or another program's fault.
ELSEWHERE = {
    "out of memory": "a machine that is full",
    "has more than 2^31 entries": "ten million unknowns of one body",
    "the copies have": "a thousand million nodes",
    "interrupted before the first solve": "a Ctrl-C of the right moment; Accuracy.* sees that nothing comes back",
    "several processes solve": "mpirun; tests/ddm/ranks_test.py, where it is built for that",
    "its folder cannot be opened": "a user who may not read it: tests may run as root",
    "what was written cannot be read back": "a fault of our own writer",
    "what was written is not the whole mesh": "a fault of our own writer",
    "no space left on the device": "a disk that is full",
    "cannot write summary.json": "a disk that fills at the last moment",
}

SCENE = """
mesh.file = "plates.msh"
materials.steel = { young = 210e9, poisson = 0.3 }
bodies = { lower = "steel", upper = "steel" }
[[boundary]]
on = "lower_bottom"
displacement = { y = 0 }
[[boundary]]
on = ["lower_left", "upper_left"]
displacement = { x = 0 }
[[boundary]]
on = "upper_top"
pressure = 1e6
[[contact]]
between = ["upper_bottom", "lower_top"]
"""
PLATES = plates.mesh_of([
    plates.Body("lower", plates.even(2), 1, plates.between(0, 1, 0, 1), plates.QUAD4),
    plates.Body("upper", plates.even(3), 1, plates.between(0, 1, 1, 2), plates.QUAD4),
])  # fmt: skip


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


def test_every_message_is_quoted_by_a_test():
    unsaid = [f"{m.place}: {' ... '.join(m.words)}" for m, by in messages.quoted_by()
              if not by and not any(key in " ".join(m.words) for key in ELSEWHERE)]  # fmt: skip
    assert not unsaid, "no test quotes:\n" + "\n".join(unsaid)


def test_what_is_left_out_is_a_message():
    said = " ".join(" ".join(m.words) for m in messages.messages())
    assert [key for key in ELSEWHERE if key not in said] == []


@pytest.mark.parametrize("setting, message", [
    ("boundary.2.pressure=[1]", "expected a number or an expression"),
    ("boundary.2={ on = \"upper_top\", traction = 1 }", "expected a list of two numbers or expressions [x, y]"),
    ("boundary.2.on=[]", "expected a list of names"),
    ("contact=1", "expected entries that each start with [[contact]]"),
    ('contact.0={ between = ["upper_bottom", "lower_top"], initial_gap = "closed", clearance = 1 }',
     "is added to the gap that is drawn, but initial_gap = 'closed'; expected one of them"),
    ("novalue", "expected KEY=VALUE, for example method.kind=ddm"),
    ("a..b=1", "'a..b' is not a dotted key; expected one such as method.kind or boundary.2.pressure"),
    ("accuracy.value=0.01", "a mesh has no geometry to refine; expected mesh.file = a .geo (with a .msh every solve"),
    ("materials.wood={ young = 1, poisson = 0 }", "no body has the material 'wood'; expected it in [bodies]"),
    ("bodies={}", "is empty; expected at least one entry surface = \"material\""),
    ('bodies={ "" = "steel" }', "the name of the body is empty; expected a physical surface of the mesh"),
    ("bodies={ lower = \"steel\" }", "bodies: body 'upper' of plates.msh has no material"),
    ('initial_strain=[{ body = "lower", strain = {} }]', "is empty; expected at least one of xx, yy, zz, xy"),
    ('initial_strain=[{ body = "lower", strain = { xx = 2 } }]', "expected a strain below 1, found 2"),
    ('initial_strain=[{ body = "lower", temperature_change = 2 }]',
     "body 'lower' has the material 'steel' without thermal_expansion"),
    ("boundary.0.displacement={ x = 0, normal = 0 }", "names several directions; expected x, y or both"),
    ("boundary.0.displacement={ direction = [0, 0], value = 0 }", "has no length; expected a direction, [dx, dy]"),
    ("boundary.2={ on = \"upper_top\", pressure = 1e12 }",
     "expected a load below every Young's modulus (the largest is 2.1e+11"),
    ("boundary.2={ on = \"upper_top\", spring = [-1, 1] }", "expected a stiffness > 0, or two >= 0, [kx, ky]"),
    ("boundary.2={ on = \"upper_top\", spring = 1 }",
     "is a curve; expected a physical point for a spring (along curves: 'foundation')"),
    ("boundary.2={ on = \"upper_top\", foundation = \"0.5 - x\" }", "; expected a modulus >= 0"),
    ('contact.0.between=["upper_bottom"]', "expected a list of two names, found "),
    ('contact.0.between=["upper_bottom", "upper_bottom"]', "expected two different curves, found 'upper_bottom' twice"),
    ("contact.0.multipliers_on=upper_top", "unknown curve of this pair 'upper_top'"),
    ("contact.0.initial_gap=[]", "expected a length, an expression or a word, found "),
    ("contact.0.within=1", 'goes with between = patterns, such as ["block_*", "block_*"], whose pairs are found'),
    ('copies=[{ body = "lower", name = "a\\"b", places = [[0, 1]] }]',
     "expected one line of text without quotation marks, found "),
    ("materials.steel={ young = [1, 1, 1], poisson = [0.9, 0.9, 0.9], shear = 1 }",
     "found ratios that with 'young' give some strains a negative energy; expected nu_ij^2"),
    ("materials.steel={ stiffness = [1, 2, 3, 4] }", "expected a row of four numbers"),
    ("materials.steel={ stiffness = [[1, 2, 0, 0], [2, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]] }",
     "gives some strains no positive energy; expected a positive definite matrix"),
    ("mesh.parameters={ n = 1 }", "a mesh file is meshed already and takes no parameters; expected a .geo, found"),
    ("method={ kind = \"ddm\", solver = \"direct\" }", "contradict one another; expected solver alone"),
    ("model={ plane = \"axisymmetric\", thickness = 2 }",
     'an axisymmetric model has none; expected plane = "strain" or "stress" with it'),
    ("boundary.2={ on = \"upper_top\", pressure = \"x = 1\" }", "assigns a value; expected == for a comparison"),
    ("boundary.2={ on = \"upper_top\", pressure = \"x, 1\" }", "has a comma; expected one value"),
    ("boundary.0={ on = \"lower_bottom\", displacement = { x = 0 } }",
     "; expected prescribed displacements or contact that prevent it"),
    ("boundary.1={ on = [\"lower_left\", \"upper_left\"], rigid = { x = 0 } }",
     "makes a node rigid whose displacement y another entry prescribes as 0"),
])  # fmt: skip
def test_scene_is_refused(said, setting, message):
    assert message in said(setting)


@pytest.mark.parametrize("more, message", [
    ("[[contact]]\nbetween = ['upper_bottom', 'lower_top']", "stands twice; expected once, but it does so in contact.0"),
    ("[[boundary]]\non = 'upper_right'\nrigid = {}\n[[boundary]]\non = 'upper_right'\n"
     "displacement = { direction = [1, 1], value = 0 }", "holds a node of a rigid curve; expected no other support there"),
    ("[[boundary]]\non = 'upper_right'\ndisplacement = { direction = [1, 1], value = 0 }\n[[boundary]]\n"
     "on = 'upper_right'\nrigid = {}",
     "makes a node rigid that is held along another direction or rigid already; expected no such support"),
    ("[[contact]]\nbetween = ['upper_right', 'lower_left']\ncondition = 'tied'",
     "do not face each other anywhere; expected curves that coincide"),
    ("[oops", "not valid TOML: "),
])  # fmt: skip
def test_scene_with_more_is_refused(said, more, message):
    assert message in said(more=more)


# A value of the mesh file in the place of another, by what it stands for, and the format.
@pytest.mark.parametrize("kind, role, value, message", [
    ("4.1 ascii", "whether binary", 7, "expected 0 for text or 1 for binary, then 8 for the size of a number"),
    ("4.1 ascii", "node tag", 0, "the node's tag is 0; expected a number > 0"),
    ("4.1 ascii", "element tag", 0, "the element's tag is 0; expected a number > 0"),
    ("4.1 ascii", "entity", 2**40, "the entity's tag is 1099511627776, which is too large"),
    ("2.2 ascii", "number of tags", -1, "the number of tags is -1; expected 0 or more"),
    ("2.2 binary", "number of elements in the block", 99, "says 99 elements of a kind follow, where 1 to "),
    ("2.2 ascii", "dimension of a name", "x", "expected a dimension, a tag and a \"name\", found "),
    ("2.2 ascii", "tag of a name", 2, "the group of dimension 1 and tag 2 has two names"),
    ("2.2 ascii", "number of names", 3, "behind as many entries as the section says, found "),
    ("2.2 ascii", "name", '"upper_bottom"', "have the same name 'upper_bottom'"),
    ("2.2 ascii", "name", '"a\tb"', "has characters that cannot be shown; expected one line of text"),
])  # fmt: skip
def test_mesh_file_is_refused(said, kind, role, value, message):
    sections = msh_file.sections(PLATES, kind)
    next(v for part in sections for v in part.values if v.role == role).value = value
    assert message in said(files={"plates.msh": msh_file.write(sections, kind)})


@pytest.mark.parametrize("kind, role, value, message", [
    ("Nodes", "dimension of a block", 7, "the dimension of the entity is 7; expected 0 to 3"),
    ("Nodes", "number of nodes", 20, "the section says 20 nodes, but lists "),
    ("Elements", "number of elements", 20, "the section says 20 elements, but lists "),
    ("Elements", "dimension of a block", 2, "elements of the kind 'Line 2' on an entity of dimension 2"),
])  # fmt: skip
def test_section_is_refused(said, kind, role, value, message):
    sections = msh_file.sections(PLATES, "4.1 ascii")
    next(v for part in sections if part.name == kind for v in part.values if v.role == role).value = value
    assert message in said(files={"plates.msh": msh_file.write(sections, "4.1 ascii")})


@pytest.mark.parametrize("old, new, message", [
    (b"$MeshFormat\n", b"$Nonsense\n", "this is no .msh: expected $MeshFormat, found '$Nonsense'"),
    (b"$Nodes\n", b"Nodes\n", "expected a section such as $Nodes, found 'Nodes'"),
    (b"$Elements\n", b"$Other\n$Nodes\n", "the section has no $EndOther"),
    (b"$Elements\n", b"$PhysicalNames\n0\n$EndPhysicalNames\n$Elements\n", "the section comes a second time"),
    (b"$Elements\n", b"$PartitionedEntities\n$Elements\n", "a partitioned mesh; expected one that is not partitioned"),
    (b"$EndElements\n", b"", "expected $EndElements, found the end of the file"),
])  # fmt: skip
def test_text_of_a_mesh_is_refused(said, old, new, message):
    text = msh_file.write(msh_file.sections(PLATES, "4.1 ascii"), "4.1 ascii")
    assert message in said(files={"plates.msh": text.replace(old, new, 1)})


def test_mesh_without_elements_is_refused(said):
    text = msh_file.write(msh_file.sections(PLATES, "4.1 ascii")[:-1], "4.1 ascii")
    assert "the file has no section $Elements" in said(files={"plates.msh": text})
    names = msh_file.write(msh_file.sections(PLATES, "4.1 ascii")[:1], "4.1 ascii")
    cut = names + b'$PhysicalNames\n2\n1 1 "a name as long as two"\n'
    assert "expected a physical name, found the end of the file" in said(files={"plates.msh": cut})


@pytest.mark.parametrize("old, new, message", [
    ("*NODE", "*INCLUDE, INPUT=x.inp\n*NODE",
     "included files are not read; expected their text here, or mesh.file = the one with the mesh"),
    ("*NODE", "*PART, NAME=a\n*PART, NAME=b\n*NODE", "a second part; expected one, or a deck without parts"),
    ("*NODE", "*INSTANCE, NAME=a\n*INSTANCE, NAME=b\n*NODE", "a second instance; expected one, or a deck without parts"),
    ("*NODE", "*INSTANCE, NAME=a\n1, 2, 3\n*NODE", "a part that is moved; expected its nodes where they are to be"),
    ("*NODE", "*NODE, NSET=", "the set has no name"),
])  # fmt: skip
def test_deck_is_refused(said, old, new, message):
    text = deck_files.WRITERS[".inp"](PLATES, lambda node: node + 1)
    scene = SCENE.replace("plates.msh", "plates.inp")
    assert message in said(scene=scene, files={"plates.inp": text.replace(old, new, 1).encode()})


@pytest.mark.parametrize("behind, message", [
    ("*SURFACE, NAME=s, TYPE=CUTTING", "left out: the surface s of TYPE=CUTTING"),
    ("*SURFACE, NAME=s\nlower, S1\n*SURFACE, NAME=s\nlower, S1", "a second surface 's'"),
])  # fmt: skip
def test_surface_of_a_deck(said, behind, message):
    text = deck_files.WRITERS[".inp"](PLATES, lambda node: node + 1) + behind + "\n"
    assert message in said(scene=SCENE.replace("plates.msh", "plates.inp"), files={"plates.inp": text.encode()})


def test_universal_file_is_refused(said):
    text = deck_files.WRITERS[".unv"](PLATES, lambda node: node + 1)
    run = lambda changed: said(scene=SCENE.replace("plates.msh", "plates.unv"), files={"plates.unv": changed.encode()})
    lines = text.splitlines()
    element = lines.index("  2412") + 1
    assert "expected 6 numbers or more" in run("\n".join(lines[:element] + ["  1  44  1"] + lines[element + 1 :]))
    nodes = next(i for i in range(element, len(lines)) if len(lines[i].split()) == 4)
    assert "has more nodes than it says" in run("\n".join(lines[:nodes] + [lines[nodes] + "  1"] + lines[nodes + 1 :]))


def twice_named():
    """The plates with a second name for the right side of the lower one, and for the top."""
    mesh = dataclasses.replace(PLATES, edges=list(PLATES.edges), curves=list(PLATES.curves))
    for name in ("lower_right", "upper_top"):
        number = PLATES.curves.index(name)
        mesh.edges += [(len(mesh.curves), kind, nodes) for curve, kind, nodes in PLATES.edges if curve == number]
        mesh.curves.append("again_" + name)
    return msh_file.write(msh_file.sections(mesh, "2.2 ascii"), "2.2 ascii")


@pytest.mark.parametrize("more, message", [
    ("[[boundary]]\non = 'again_upper_top'\npressure = 1",
     "load the same edges, near (0.5, 2)"),
    ("[[boundary]]\non = 'lower_right'\ndisplacement = { direction = [1, 1], value = 1 }\n[[boundary]]\n"
     "on = 'again_lower_right'\ndisplacement = { direction = [1, -1], value = 3 }",
     "prescribes a displacement of 3 along (0.707107, -0.707107), where another entry makes it 1; expected one value a node"),
])  # fmt: skip
def test_edges_of_two_names(said, more, message):
    assert message in said(more=more, files={"plates.msh": twice_named()})


def test_loads_of_two_names_are_told_with_their_length(said):
    found = said(more="[[boundary]]\non = 'again_upper_top'\npressure = 1", files={"plates.msh": twice_named()})
    assert "and over a length of 1 in all: they would add up; expected at most one load on each edge" in found


VTU = """<VTKFile type="UnstructuredGrid" version="1.0"><UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="1">
<PointData><DataArray type="Float64" Name="T" format="ascii">1 1 1 1</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">-1 -1 0 2 -1 0 2 3 0 -1 3 0</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">9</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>
"""


@pytest.mark.parametrize("old, new, message", [
    ("2 3 0", "2 3 1", ": its points leave the plane z = 0"),
    ('ascii">9<', 'ascii">7<', "is a vtkPolygon; expected triangles of 3 or 6 points, quadrilaterals of 4, 8 or 9"),
    ('ascii">9<', 'ascii">4<', ": it has no plane cells"),
    ('"Float64" Name="T" format="ascii">1 1 1 1', '"String" Name="T" format="ascii">65 0 65 0 65 0 65 0',
     "'T' is no array of numbers, one a point"),
    ('<DataArray type="Float64" Name="T" format="ascii">1 1 1 1</DataArray>', "", ": it has no values at its points"),
    ("</Points>", "", ": is no .vtu that VTK can read: "),
])  # fmt: skip
def test_field_is_refused(said, old, new, message):
    assert VTU.count(old) >= 1
    settings = ['fields.T={ file = "T.vtu" }', "boundary.2.pressure=T"]
    assert "error" not in said(*settings, files={"T.vtu": VTU.encode()})
    assert message in said(*settings, files={"T.vtu": VTU.replace(old, new, 1).encode()})


GEO = """
Point(1) = {0, 0, 0, 0.5}; Point(2) = {1, 0, 0, 0.5}; Point(3) = {1, 1, 0, 0.5}; Point(4) = {0, 1, 0, 0.5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Surface("lower") = {1}; Physical Curve("lower_bottom") = {1}; Physical Curve("lower_top") = {3};
"""
ONE_BODY = """
mesh.file = "body.geo"
materials.steel = { young = 210e9, poisson = 0.3 }
bodies = { lower = "steel" }
[[boundary]]
on = "lower_bottom"
displacement = { x = 0, y = 0 }
"""


@pytest.mark.parametrize("old, new, message", [
    ('Physical Surface("lower") = {1};', "", ': no physical surface; a body is a Physical Surface("name") = {...}'),
    ("Plane Surface(1) = {1};", "Plane Surface(1) = {1}; SetFactory(\"OpenCASCADE\"); Rectangle(2) = {2, 0, 0, 1, 1};",
     "its surfaces are drawn by both the built-in kernel and OpenCASCADE; expected one of them"),
])  # fmt: skip
def test_geometry_is_refused(said, old, new, message):
    scene = SCENE.replace("plates.msh", "body.geo").replace(', upper = "steel"', "") if "Open" in new else ONE_BODY
    settings = ["accuracy.value=0.1"] if "Open" in new else []
    found = said(*settings, scene=scene, files={"body.geo": GEO.replace(old, new, 1).encode()},
                 command="solve" if settings else "check")  # fmt: skip
    assert message in found


@pytest.mark.parametrize("group, message", [("bodies", "' has no cells"), ("curves", "' has no edges; does it name a")])
def test_group_without_elements_is_refused(said, group, message):
    mesh = dataclasses.replace(PLATES, **{group: [*getattr(PLATES, group), "none"]})
    if group == "curves":  # the bodies' numbers follow those of the curves
        assert len(mesh.curves) == len(PLATES.curves) + 1
    found = said('bodies={ "*" = "steel" }',
                 files={"plates.msh": msh_file.write(msh_file.sections(mesh, "4.1 ascii"), "4.1 ascii")})  # fmt: skip
    assert message in found


def test_geometry_of_an_odd_name_is_refused(said):
    scene = ONE_BODY.replace('"body.geo"', "'bo\"dy.geo'")
    assert ("gmsh cannot open a file with quotes, backslashes or control characters in its name"
            in said(scene=scene, files={'bo"dy.geo': GEO.encode()}))  # fmt: skip


@pytest.mark.parametrize("curve, message", [
    (False, "'Triangle 10', near (0, 0); expected triangles of 3 or 6 nodes, quadrilaterals of 4, 8 or 9"),
    (True, "'Line 4', near (0, 0); expected lines of 2 or 3 nodes"),
])  # fmt: skip
def test_element_of_high_order_is_refused(said, curve, message):
    triangle = "2 9 2 1 1 1 2 3" if curve else "2 21 2 2 2 1 2 3 4 4 4 4 4 4 4"
    line = "1 26 2 1 1 1 2 4 4" if curve else "1 1 2 1 1 1 2"
    triangle = "2 2 2 2 2 1 2 3" if curve else triangle
    text = f"""$MeshFormat\n2.2 0 8\n$EndMeshFormat
$PhysicalNames\n2\n1 1 "lower_bottom"\n2 2 "lower"\n$EndPhysicalNames
$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0.5 0 0\n$EndNodes
$Elements\n2\n{line}\n{triangle}\n$EndElements
"""
    found = said(scene=ONE_BODY.replace("body.geo", "one.msh"), files={"one.msh": text.encode()})
    assert "has elements of a kind that is not supported, " + message in found


def test_temperature_is_too_high(said):
    scene = SCENE.replace("poisson = 0.3 }", "poisson = 0.3, thermal_expansion = 1e-5 }")
    found = said('initial_strain=[{ body = "lower", temperature_change = 1e6 }]', scene=scene)
    assert "expected a thermal strain below 1, found " in found


def test_rings(said):
    rings = "model.plane=axisymmetric"
    rigid = "[[boundary]]\non = 'upper_right'\nrigid = { x = 0 }"
    assert "rings that are rigid move along the axis alone; expected y or force" in said(rings, more=rigid)
    on_axis = "boundary.2={ on = 'lower_left', force = [0, 1] }"
    assert ").force: its curves have no length; expected some to put the force on" in said(rings, on_axis)


def test_sides_whose_displacements_are_prescribed(said):
    both = ["boundary.0={ on = 'lower_top', displacement = { y = 0.1 } }",
            "boundary.2={ on = 'upper_bottom', displacement = { y = 0 } }"]  # fmt: skip
    found = said(*both, command="solve")
    assert "the prescribed displacements of the two sides overlap by 0.1 " in found


def test_ties_of_a_rigid_curve(said):
    tied = ["contact.0.condition=tied", "contact.0.multipliers_on=upper_bottom",
            "boundary.2={ on = 'upper_bottom', rigid = { force = [0, -1] } }"]  # fmt: skip
    tied += ["boundary.1={ on = 'lower_left', displacement = { x = 0 } }"]
    assert "ties a node of a rigid curve; expected multipliers_on the other curve" in said(*tied)


def with_nodes(move, cell=plates.QUAD4):
    mesh = plates.mesh_of([
        plates.Body("lower", plates.even(2), 1, plates.between(0, 1, 0, 1), cell),
        plates.Body("upper", plates.even(3), 1, plates.between(0, 1, 1, 2), cell),
    ])  # fmt: skip
    return msh_file.write(msh_file.sections(plates.moved(mesh, move), "4.1 ascii"), "4.1 ascii")


@pytest.mark.parametrize("cell, move, message", [
    (plates.QUAD4, lambda x, y: (x, y / 1e20 if y <= 1 else y), "is degenerate: it has no area"),
    (plates.QUAD8, lambda x, y: (x, 1.2 if (x, y) == (0.25, 0) else y),
     "is inverted or degenerate (Jacobian -"),
])  # fmt: skip
def test_cell_is_refused(said, cell, move, message):
    assert message in said(files={"plates.msh": with_nodes(move, cell)})


def test_overlap_without_a_pair_is_told(said):
    moved = plates.mesh_of([
        plates.Body("lower", plates.even(2), 1, plates.between(0, 1, 0, 1), plates.QUAD4),
        plates.Body("upper", plates.even(3), 1, plates.between(0, 1, 0.99, 2), plates.QUAD4),
    ])  # fmt: skip
    files = {"plates.msh": msh_file.write(msh_file.sections(moved, "4.1 ascii"), "4.1 ascii")}
    scene = SCENE[: SCENE.index("[[contact]]")] + "[[boundary]]\non = 'upper_right'\ndisplacement = { x = 0, y = 0 }"
    found = said(scene=scene, files=files)
    assert "are drawn into one another by 0.01 near (" in found
    assert "), and no contact pair presses them apart there: " in found


def test_closed_curves_that_are_apart(said):
    moved = plates.mesh_of([
        plates.Body("lower", plates.even(2), 1, plates.between(0, 1, 0, 1), plates.QUAD4),
        plates.Body("upper", plates.even(3), 1, plates.between(0, 1, 1.1, 2), plates.QUAD4),
    ])  # fmt: skip
    files = {"plates.msh": msh_file.write(msh_file.sections(moved, "4.1 ascii"), "4.1 ascii")}
    found = said("contact.0.initial_gap=closed", files=files)
    assert "are 0.1 apart near (" in found and 'where two meshes of one curve differ by at most ' in found


def test_branching_curve_is_refused(said):
    text = """$MeshFormat\n2.2 0 8\n$EndMeshFormat
$PhysicalNames\n3\n1 1 "fork"\n2 2 "lower"\n1 3 "other"\n$EndPhysicalNames
$Nodes\n7\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 2 1 0\n6 2 2 0\n7 1 2 0\n$EndNodes
$Elements\n7\n1 3 2 2 2 1 2 3 4\n2 3 2 2 2 3 5 6 7\n3 1 2 1 1 2 3\n4 1 2 1 1 3 4\n5 1 2 1 1 3 5\n6 1 2 1 1 7 3
7 1 2 3 3 1 2\n$EndElements
"""
    scene = ONE_BODY.replace("body.geo", "fork.msh").replace("lower_bottom", "other")
    found = said(scene=scene + "[[contact]]\nbetween = ['fork', 'other']", files={"fork.msh": text.encode()})
    assert "branches near (1, 1): more than two of its edges meet; expected one chain" in found


def test_motions_that_no_load_drives_are_told(said):
    free = "boundary.1={ on = 'lower_left', displacement = { x = 0 } }"
    found = said(free)
    assert "nothing holds body 'upper': translation (1, 0), rotation 0, but no load drives it either: held" in found
    many = "[[copies]]\nbody = 'upper'\nname = 'u_*'\ngrid = { count = [9, 1], step = [3, 0] }"
    loose = said('bodies={ lower = "steel", "u_*" = "steel" }', "contact=[]", "boundary.2.pressure=0", more=many,
                 scene=SCENE.replace('"upper_top"', '"u_0_0_top"').replace(', "upper_left"', ""))  # fmt: skip
    assert "motions of " in loose and ", but no load drives them either: held" in loose, loose


def test_load_that_lifts_off(said):
    found = said("boundary.2.pressure=-1e6", command="solve")
    assert "the load moves it away from the contact; expected a load that presses it on, or prescribed " in found


def test_probe_of_a_free_motion_is_told(said):
    found = said("boundary.1={ on = 'lower_left', displacement = { x = 0 } }",
                 'probe=[{ at = [0.5, 1.5] }]', command="solve")  # fmt: skip
    assert "the displacement along x near (0.5, 1.5) is undetermined and has no bar: nothing holds body 'upper'" in found


def test_large_displacements_are_told(said):
    found = said("boundary.2.pressure=4e10", command="solve")
    assert "large displacements: " in found
    turned = said("boundary.2.pressure=4e10", 'boundary.1={ on = ["lower_left"], displacement = { x = 0 } }',
                  command="solve")  # fmt: skip
    assert "; contact is written on the undeformed bodies, so p may be off by " in found + turned


def test_forces_have_their_moment(said):
    found = said(command="solve")
    assert "about (0, 0)" in found and ", moment -500000 about (0, 0)" in found


def test_what_is_left_out_is_said(said):
    assert "left out friction, large displacements, plasticity, time" in said()


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
            in said('fields.T={ file = "res/T.vtu" }', files={"res/T.vtu": VTU.encode()}, command="solve",
                    options=["-o", "res"]))  # fmt: skip


def call(*words, **changed):
    done = subprocess.run([str(word) for word in words], text=True, capture_output=True, timeout=100,
                          env={**os.environ, **changed})  # fmt: skip
    assert done.returncode == 1
    return done.stderr


def test_scenes_that_cannot_be_read(mortise):
    assert "the name of the scene is empty; expected a scene file (.toml)" in call(mortise, "check", "")
    assert "cannot be read; expected a readable file" in call(mortise, "check", "/proc/self/mem")


def test_program_without_its_parts(mortise, tmp_path):
    alone = shutil.copy(mortise, tmp_path)
    assert "picture.py (Debian package mortise-python) is not there: expected in " in call(alone, "picture", tmp_path)
    assert "a .geo is meshed by gmsh (Debian package mortise-gmsh), which cannot be loaded: " in call(alone, "check", launch.ROOT / "geo/patch_flat.toml", "--no-cache")
    assert ("picture.py is run by Python, which is not there (/no/python): apt-get install python3-matplotlib"
            in call(mortise, "picture", tmp_path, MORTISE_PYTHON="/no/python"))  # fmt: skip


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


def test_node_that_is_nowhere(said):
    text = msh_file.write(msh_file.sections(PLATES, "2.2 ascii"), "2.2 ascii").replace(b"1 0.0 0.0 0.0", b"1 nan 0 0", 1)
    found = said(scene=SCENE.replace("plates.msh", "all.geo"), files={"all.geo": b'Merge "one.msh";', "one.msh": text})
    assert "gmsh, meshing: the node 1 has coordinates that are not finite" in found


WEDGE = """
Point(1) = {-1, -1, 0, 1}; Point(2) = {1, -1, 0, 1}; Point(3) = {1, 0, 0, 1}; Point(4) = {-1, 0, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1, 2, 3, 4};
Point(5) = {0, 0, 0, 1}; Point(6) = {1, 0.1, 0, 1}; Point(7) = {1, 1, 0, 1}; Point(8) = {-1, 1, 0, 1};
Point(9) = {-1, 0.1, 0, 1};
Line(5) = {9, 5}; Line(6) = {5, 6}; Line(7) = {6, 7}; Line(8) = {7, 8}; Line(9) = {8, 9};
Curve Loop(2) = {5, 6, 7, 8, 9}; Plane Surface(1) = {1}; Plane Surface(2) = {2};
Physical Surface("lower") = {1}; Physical Surface("upper") = {2};
Physical Curve("lower_bottom") = {1}; Physical Curve("lower_top") = {3}; Physical Curve("upper_top") = {8};
Physical Curve("upper_bottom") = {5, 6}; Physical Curve("lower_left") = {4}; Physical Curve("upper_left") = {9};
"""


def test_peak_under_a_wedge_is_refused(said):
    found = said("accuracy={ value = 0.1, of = 'peak' }", "boundary.1.on=upper_top", "boundary.2.pressure=3e9", scene=SCENE.replace("plates.msh", "w.geo"),
                 files={"w.geo": WEDGE.encode()}, command="solve")  # fmt: skip
    assert "p has no largest value near (0, 0), where it grows as the logarithm of 1/r" in found
    assert '; expected of = "pressure", which leaves out what is near, or a rounded corner' in found
