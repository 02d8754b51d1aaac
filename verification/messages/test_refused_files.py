"""Messages of files beside a scene: meshes, decks, geometries, values at points."""

import dataclasses

import pytest

import deck_files
import msh_file
import plates
from plates_scene import ONE_BODY, PLATES, SCENE, VTU


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


def test_node_that_is_nowhere(said):
    text = msh_file.write(msh_file.sections(PLATES, "2.2 ascii"), "2.2 ascii").replace(b"1 0.0 0.0 0.0", b"1 nan 0 0", 1)
    found = said(scene=SCENE.replace("plates.msh", "all.geo"), files={"all.geo": b'Merge "one.msh";', "one.msh": text})
    assert "gmsh, meshing: the node 1 has coordinates that are not finite" in found
