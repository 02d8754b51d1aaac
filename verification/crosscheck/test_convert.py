"""The conversion for FreeFEM: triangles, labels, digits, and the case file."""

import meshio
import numpy as np
import pytest

import convert
import run
import scene as scenes
from cases import CaseError


def two_squares(kind):
    """Two unit squares of one cell or two, the upper shifted to x = 1/3 by 0.7; curves low (tag 5) and high (tag 7)."""
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    middles = (corners + np.roll(corners, -1, axis=0)) / 2
    square = np.concatenate([corners, middles, [[0.5, 0.5]]])
    points = np.concatenate([square, square + [1 / 3, 1.7]])
    cells = {"quad8": [[0, 1, 2, 3, 4, 5, 6, 7]], "triangle6": [[0, 1, 2, 4, 5, 8], [0, 3, 2, 7, 6, 8]]}[kind]
    both = np.array(cells), np.array(cells) + 9
    lines = np.array([[2, 3, 6]]), np.array([[9, 10, 13]])
    blocks = [("line3", lines[0]), ("line3", lines[1]), (kind, both[0]), (kind, both[1])]
    names = {"low": [5, 1], "high": [7, 1], "lower": [9, 2], "upper": [2, 2]}
    empty = np.array([], dtype=int)
    sets = {n: [np.arange(len(blocks[i][1])) if i == k else empty for i in range(4)] for k, n in enumerate(names)}
    field = {name: np.array(value) for name, value in names.items()}
    return meshio.Mesh(np.pad(points, ((0, 0), (0, 1))), blocks, cell_sets=sets, field_data=field)


def area(body):
    a, b = (body.points[body.triangles[:, i]] - body.points[body.triangles[:, 0]] for i in (1, 2))
    return (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2


@pytest.mark.parametrize("kind", ["triangle6", "quad8"])
def test_bodies_of_a_mesh(kind):
    mesh = two_squares(kind)
    bodies = convert.read_bodies(mesh, ["lower", "upper"])
    for name, tag, y in (("lower", 5, 1), ("upper", 7, 1.7)):
        body = bodies[name]
        assert len(body.points) == 4 and len(body.triangles) == 2 and len(body.edges) == 4
        assert (area(body) > 0).all() and area(body).sum() == pytest.approx(1)
        (named,) = body.edges[body.labels == tag]
        np.testing.assert_array_equal(body.points[named, 1], y)
        assert sorted(body.labels) == [convert.UNNAMED] * 3 + [tag]
        assert convert.body_of_curve(bodies, tag) == name
    assert convert.body_order(mesh, ["lower", "upper"]) == ["upper", "lower"]
    with pytest.raises(CaseError, match="bounds 0 bodies"):
        convert.body_of_curve(bodies, 99)
    with pytest.raises(CaseError, match="no physical surface 'middle'"):
        convert.read_bodies(mesh, ["middle"])


def test_medit_keeps_every_digit(tmp_path):
    body = convert.read_bodies(two_squares("triangle6"), ["upper"])["upper"]
    convert.write_medit(body, tmp_path / "body.mesh")
    again = meshio.read(tmp_path / "body.mesh")
    np.testing.assert_array_equal(again.points, body.points)
    np.testing.assert_array_equal(again.cells_dict["triangle"], body.triangles)
    np.testing.assert_array_equal(again.cells_dict["line"], body.edges)
    np.testing.assert_array_equal(again.cell_data_dict["medit:ref"]["line"], body.labels)


def test_quadrilaterals_are_split_by_the_shorter_diagonal():
    points = np.array([[0, 0], [2, 0], [3, 1], [1, 1], [0, 2], [-1, 1]], dtype=float)
    leaning, other_way = [0, 1, 2, 3], [0, 3, 4, 5]
    triangles = convert.split_quadrilaterals(points, np.array([leaning, other_way]))
    assert triangles.tolist() == [[0, 1, 3], [1, 2, 3], [0, 3, 4], [0, 4, 5]]


def test_round_off_does_not_choose_the_diagonal():
    square = np.array([[0, 0], [1 + 1e-14, 0], [1 + 1e-14, 1], [1e-14, 1]])
    turned = np.array([[0, 0], [1 - 1e-14, 0], [1, 1], [-1e-14, 1]])
    for points in (square, turned):
        assert convert.split_quadrilaterals(points, np.array([[0, 1, 2, 3]])).tolist() == [[0, 1, 2], [0, 2, 3]]


def test_middles_of_the_sides_as_vtk_numbers_them():
    body = convert.read_bodies(two_squares("triangle6"), ["lower"])["lower"]
    points, cells = body.nodes(2)
    assert points.shape == (9, 2) and cells.shape == (2, 6)
    for cell in cells:
        for middle, (start, end) in zip(cell[3:], [(0, 1), (1, 2), (2, 0)]):
            np.testing.assert_array_equal(points[middle], (points[cell[start]] + points[cell[end]]) / 2)


def test_case_file_holds_the_physics_of_the_scene():
    """shrink_fit: two materials, a temperature change, symmetry planes."""
    scene = scenes.read_scene(run.ROOT / "geo/shrink_fit.toml")
    tags = {"inner_cut_x": 2, "inner_contact": 3, "inner_cut_y": 4}
    tags |= {"outer_cut_x": 7, "outer_cut_y": 9, "outer_contact": 10}
    freefem = {"order": 2, "multipliers": "quadratic", "integration": "elements", "gauss": 3}
    files = ["multiplier.mesh", "opposite.mesh"]
    lines = scenes.case_text(scene, ["outer", "inner"], files, [10, 3], tags, freefem).splitlines()
    strain = repr(12e-6 * -100)
    assert lines[0] == "plane strain"
    assert lines[1:3] == ["body multiplier.mesh 70000000000.0 0.3", "body opposite.mesh 210000000000.0 0.3"]
    assert lines[-1] == "end"
    assert set(lines[3:-1]) == {
        "contact 10 3", "order 2", "multipliers 2", "integration elements", "gauss 3", "gap closed",
        "displacement 2 y 0.0", "displacement 7 y 0.0", "displacement 4 x 0.0", "displacement 9 x 0.0",
        f"initial_strain 0 {strain} {strain} {strain} 0.0",
    }  # fmt: skip


def test_scenes_with_several_pairs_are_refused():
    with pytest.raises(CaseError, match="2 contact pairs"):
        scenes.read_scene(run.ROOT / "geo/stack.toml")
