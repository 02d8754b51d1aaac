"""The study on one scene, and its verdicts on answers that are known."""

import meshio
import numpy as np
import pytest

import accuracy
import judge_answers
import launch

GOOD = {
    "scene": "hertz", "asked": 0.01, "first_edges": 20, "failed": "", "reached": True, "got": 0.004, "got_line": 0.003,
    "ratio": 2, "ratio_line": 3, "inside": 1.0, "work": 2.5, "meshing": 0.9, "energy_ratio": 1.1, "trusted": True,
    "unknowns": 8000,
}  # fmt: skip


def broken(row, seconds=0.1):
    """How many verdicts a row makes false."""
    return sum(not holds for _, _, holds in judge_answers.verdicts([row], seconds))


def test_verdicts_tell_good_from_bad():
    assert broken(GOOD) == 0 and broken(GOOD, seconds=0.4) == 1
    changes = [
        {"got": 0.011}, {"got_line": 0.011}, {"reached": False}, {"inside": 0.94}, {"ratio": 0.7}, {"ratio": 5},
        {"work": 3.1}, {"work": 2.5, "scene": "punch"}, {"meshing": 1.1}, {"energy_ratio": 3}, {"trusted": False},
        {"asked": 0.002, "unknowns": 13001, "got": 0.001, "got_line": 0.001},
    ]  # fmt: skip
    for wrong in changes:
        assert broken(GOOD | wrong) == 1, wrong


def test_the_study_of_one_scene(mortise, tmp_path, capsys):
    with pytest.raises(SystemExit) as ended:
        accuracy.main(["--quick", "--only", "rings", "-o", str(tmp_path)])
    assert ended.value.code == 0, capsys.readouterr().out
    rows = launch.columns(tmp_path / "answers.csv")
    assert rows["asked"].tolist() == [0.05, 0.05, 0.01, 0.01] and max(rows["got"]) < 1e-3 and min(rows["inside"]) > 0.95
    assert "holds" in (tmp_path / "accuracy.md").read_text()


@pytest.mark.parametrize("rollers", [7, 8])
def test_rollers_between_the_nodes_of_a_first_mesh_carry_load(mortise, tmp_path, rollers):
    """Coarse first edges pass through the rollers at the sides; a mesh of one's own, fine at all of them, does not."""

    def forces(fine, *more):
        changes = {"mesh.parameters": f"{{rollers={rollers}, fine={fine}}}"}
        pairs = launch.solve("rollers", changes, tmp_path, *more)["contact"]
        return np.array([np.hypot(*pair["force"]) for pair in sorted(pairs, key=lambda pair: sorted(pair["between"]))])

    found, expected = forces(0.2, "--accuracy", "5%"), forces(0.15)
    assert (expected > 0.1 * expected.max()).sum() >= 6 and np.abs(found - expected).max() < 0.015 * expected.max()


PIN = """
SetFactory("OpenCASCADE"); play = 1e-4;
Rectangle(1) = {-3, -2, 0, 6, 1}; Rectangle(2) = {1 + play, -0.9, 0, 2, 2.9}; Disk(3) = {0, 0, 0, 1};
Rectangle(4) = {-3, -0.9, 0, 2 - play, 2.9};
Physical Surface("floor") = 1; Physical Surface("walls") = {2, 4}; Physical Surface("pin") = 3;
Physical Curve("ground") = 1; Physical Curve("top") = 3; Physical Curve("far") = {6, 13};
Physical Curve("east") = 8; Physical Curve("west") = 11; Physical Curve("rim") = 9;
Mesh.ElementOrder = 2; MeshSize{:} = 0.26;
"""
SCENE = """
mesh.file = "pin.geo"
materials.one = { young = 1, poisson = 0.3 }
bodies = { floor = "one", walls = "one", pin = "one" }
boundary = [{ on = ["ground", "far"], displacement = { x = 0, y = 0 } }]
contact = [{ between = ["rim", "top"] }, { between = ["rim", "east"] }, { between = ["rim", "west"] }]
body_force = [{ body = "pin", force = [2.4e-6, 0] }]
accuracy = { value = 0.1, first_edges = 10 }
"""


def test_a_pin_that_just_touches_the_floor_gets_no_long_row_of_tiny_edges(mortise, tmp_path):
    """Where it dips into the floor between two nodes a mesh must be fine, but not all the way between them."""
    (tmp_path / "pin.geo").write_text(PIN)
    (tmp_path / "pin.toml").write_text(SCENE)
    summary = launch.solve(tmp_path / "pin.toml", {}, tmp_path / "out", expected=[0])
    first, second, *_ = (solve["unknowns"] for solve in summary["accuracy"]["solves"])
    assert second < 5 * first


@pytest.mark.parametrize("weight, edges", [(2.7e-5, 34), (3e-6, 23)])
def test_a_pin_that_just_touches_a_wall_presses_on_it_as_it_widens(mortise, tmp_path, weight, edges):
    """By its own weight, so little that no point at which contact is integrated on a first mesh sees it."""
    (tmp_path / "pin.geo").write_text(PIN.replace("play = 1e-4", "play = 0"))
    (tmp_path / "pin.toml").write_text(SCENE.replace("[2.4e-6, 0]", f"[0, -{weight}]"))

    def wall(accuracy, first):
        settings = {"accuracy.value": accuracy, "accuracy.first_edges": first}
        told = launch.solve(tmp_path / "pin.toml", settings, tmp_path / "out")["contact"][1]
        return np.hypot(*told["force"]), np.hypot(*told["force_error"])

    (found, bar), (expected, known) = wall(0.1, edges), wall(0.01, 100)
    assert expected > 10 * known and abs(found - expected) < bar + known


@pytest.mark.parametrize("scene", ["parabola_1", "tent_b", "punch"])
def test_displacements_at_random_places_lie_within_their_bars(mortise, tmp_path, scene):
    """In large cells, within which u itself errs: no dual of a place shows the cell that has it."""

    def solve(accuracy, settings):
        launch.solve(scene, settings, tmp_path, "--accuracy", accuracy, expected=[0])
        return launch.columns(tmp_path / "probes.csv") if settings else meshio.read(tmp_path / "result.vtu")

    mesh, draw = solve("1%", {}), np.random.default_rng(35)
    corners = [cell[: 3 if cells.type.startswith("tri") else 4] for cells in mesh.cells for cell in cells.data]
    corners.sort(key=lambda cell: np.ptp(mesh.points[cell], axis=0).max())
    chosen = [corners[-1 - k] for k in draw.choice(len(corners) // 3, 60, replace=False)]
    places = [draw.dirichlet(np.full(len(cell), 4.0)) @ mesh.points[cell, :2] for cell in chosen]
    probes = {"probe": "[" + ", ".join(f"{{at = [{x:.17g}, {y:.17g}]}}" for x, y in places) + "]"}
    found, exact = solve("1%", probes), solve("0.02%", probes)
    for u in ("u_x", "u_y"):
        off, bar = np.abs(found[u] - exact[u]), found[u + "_error"] + exact[u + "_error"]
        assert (off <= bar).all() and np.median(off / bar) > 0.02, (off / bar).max()


def test_pairs_of_patterns_stay_pairs_on_finer_meshes(mortise, tmp_path):
    """Found within half an edge of the first mesh; on the last one half an edge is less than the gap that the load closes."""
    gap = 0.014
    (tmp_path / "two.geo").write_text(f"""SetFactory("OpenCASCADE"); Rectangle(1) = {{0, 0, 0, 1, 1}}; Rectangle(2) = {{0.2, {1 + gap}, 0, 0.6, 0.5}};
Physical Surface("lower") = {{1}}; Physical Surface("upper") = {{2}}; Physical Curve("base") = {{1}};
Physical Curve("lower_face") = {{3}}; Physical Curve("upper_face") = {{5}}; Physical Curve("head") = {{7}}; Mesh.ElementOrder = 2;""")
    (tmp_path / "two.toml").write_text("""mesh.file = "two.geo"
materials.one = { young = 1e5, poisson = 0.3 }
bodies = { "*" = "one" }
boundary = [{ on = "base", displacement = { x = 0, y = 0 } }, { on = "head", displacement = { x = 0, y = -0.03 } }]
contact = [{ between = ["*_face", "*_face"] }]
""")
    forces = []
    for entry in ('["*_face", "*_face"]', '["lower_face", "upper_face"]'):
        settings = {"accuracy.value": 0.005, "contact.0.between": entry}
        summary = launch.solve(tmp_path / "two.toml", settings, tmp_path / "out", expected=[0])
        (pair,) = summary["contact"]
        lines = (tmp_path / "out/contact.csv").read_text().splitlines()[1:]
        edges = [sum(f",{name}," in line for line in lines) / 2 for name in pair["between"]]  # of three nodes
        assert summary["accuracy"]["reached"] and min(0.6 / edges[0], 1 / edges[1]) / 2 < gap
        forces.append(abs(pair["force"][1]))
    assert forces[0] == pytest.approx(forces[1], rel=1e-9)
