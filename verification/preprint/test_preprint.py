"""The study of the preprint: its measure by hand, the printed tables, the cause, and a quick study as a whole."""

import csv
from dataclasses import replace

import numpy as np
import pytest

import cause
import elements
import gallery
import gallery_measures
import mesh_gaps
import oscillation
import preprint
import preprint_runs  # makes launch known
import nodal_stress
import printed_tables
import projected_elements
import figure
import launch


@pytest.fixture(scope="module")
def quick(mortise, tmp_path_factory):
    """Folder of a study quicker than --quick, whose figures show the meshes of its tables, and how many runs it took."""
    folder = tmp_path_factory.mktemp("preprint")
    with pytest.MonkeyPatch.context() as patch:
        shown = [cause.OURS, cause.NORMALS, cause.GAP]
        figures = [1, *preprint.QUICK.figures[1:]]
        patch.setattr(preprint, "SHOWN", shown)
        patch.setattr(preprint, "QUICK", replace(preprint.QUICK, variants=[*shown, cause.BOTH], figures=figures, unprinted=(12, 10)))
        for module in (gallery, gallery.claims):
            patch.setattr(module, "MESH", (40, 50))
            patch.setattr(module, "MATCHING", (40, 40))
        yield folder, preprint.main(["--quick", "--jobs", "2", "-o", str(folder)])


@pytest.fixture(scope="module")
def store(mortise, tmp_path_factory):
    return preprint_runs.Store(tmp_path_factory.mktemp("runs"))


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def test_delta_by_hand():
    x = np.linspace(0, 1, 9)
    s = np.array([1, 1, 1, -2, 4, -5, 1, 1, 1.0])
    off = np.array([9, 9, 9, 0.2, 1, -1, 9, 9, 9.0])  # nodes of the first and last element do not count
    curve, reference = {"x": x, "sigma_2": s + off}, {"x": x, "sigma_2": s}
    assert oscillation.mean_delta(curve, reference) == pytest.approx(((0.1 + 0.25 + 0.2) / 3, 1))
    of_centres = (0.1 + 0.25 + 0.2 + 4 * 9) / 7, 36.45 / 36.55
    assert oscillation.mean_delta(curve, reference, "centres") == pytest.approx(of_centres)
    with pytest.raises(ValueError, match="different nodes"):
        oscillation.mean_delta({**curve, "x": x + 1e-3}, reference)


def test_printed_tables():
    rows = printed_tables.printed_rows()
    assert [sum(row["at"] == at for row in rows) for at in ("nodes", "centres")] == [72, 12]
    assert sum(not row["target"] for row in rows) == 6
    places = {(r["table"], r["scene"], r["active"], r["body"]) for r in rows}
    assert len(places) == len(rows) == 7 * 12
    one = next(r for r in rows if (r["table"], r["scene"], r["active"], r["body"]) == (6, "parabola_2", "G1", "G2"))
    assert one["printed"] == 0.190678 and one["mesh"] == (80, 100)


def test_fit_and_factors():
    printed = [1.0, 2.0, 5.0, 3.0]
    figures = printed_tables.fit([10 * value for value in printed], printed)
    assert figures["median"] == pytest.approx(1) and figures["spread"] == pytest.approx(0)
    assert figures["within_3"] == 0 and figures["rank"] == pytest.approx(1)
    line = {"scene": "circle", "active": "G1", "body": "G1", "at": "nodes"}
    rows = [{**line, "mesh": (n, n), "v": v} for n, v in ((40, 16), (80, 4), (160, 2))]
    assert list(cause.factors(rows, "v")) == [4, 2]


def test_predicted_gap_is_that_of_quadratic_edges():
    """Edges through points even in arc length, and how far parabola 2 lies from them, against the formula."""
    a, b = mesh_gaps.CURVATURE["parabola_2"]
    n, x = 80, np.linspace(0, mesh_gaps.WIDTH, 400001)
    slope = np.hypot(1, 2 * a * x + b)
    s = np.concatenate([[0], np.cumsum((slope[1:] + slope[:-1]) / 2 * np.diff(x))])
    nodes = np.interp(np.linspace(0, s[-1], 2 * n + 1), s, x)
    y = lambda x: a * x * x + b * x
    xi, largest = np.linspace(-1, 1, 101), 0
    shape = elements.edge(xi)[0].T
    for e in range(n):
        ends = nodes[2 * e : 2 * e + 3]
        X, Y = ends @ shape, y(ends) @ shape
        largest = max(largest, np.abs((Y - y(X)) / np.hypot(1, 2 * a * X + b)).max())
    assert mesh_gaps.length("parabola_2") == pytest.approx(s[-1], rel=1e-6)
    assert 2 * largest == pytest.approx(mesh_gaps.predicted("parabola_2", (n, n)), rel=0.05)


def test_nodal_stresses_of_a_uniform_strain():
    """Of a distorted 8-node element, against Hooke's law for plane strain written out."""
    corners = np.array([(0, 0), (1, 0.1), (1.2, 0.9), (-0.1, 1)])
    middles = (corners + np.roll(corners, -1, axis=0)) / 2 + [[0.02, 0.03]] * 4
    points = np.concatenate([corners, middles])
    a, b, c, d = 1e-3, 2e-4, -4e-4, -5e-4  # u = (a x + b y, c x + d y)
    u = np.stack([a * points[:, 0] + b * points[:, 1], c * points[:, 0] + d * points[:, 1]], axis=1)
    found = nodal_stress.element_stresses(points[None], u[None])[0]
    E, nu = 210e9, 0.3
    factor = E / (1 + nu) / (1 - 2 * nu)
    expected = [factor * ((1 - nu) * a + nu * d), factor * ((1 - nu) * d + nu * a), E / (1 + nu) * (b + c) / 2]
    assert found == pytest.approx(np.array([expected] * 8), rel=1e-10)


def test_nodal_stresses_come_near_the_recovered_ones(store):
    settings = {**cause.METHOD, **preprint_runs.on_side("G2")}
    own = store.curve("circle", (16, 20), {**settings, **preprint_runs.AT_THE_NODES}, "G1")
    recovered = store.curve("circle", (16, 20), settings, "G1")
    for name in ("sigma_2", "sigma_n"):
        assert own[name][5:-5] == pytest.approx(recovered[name][5:-5], rel=0.1)
        assert np.abs(own[name] - recovered[name]).max() > 1  # Pa; they are not the same figures
    assert not list(store.folder.glob("*/result.vtu"))


@pytest.fixture(scope="module")
def enforced(mortise, tmp_path_factory):
    """Runs of a scene on 16x20 with the meshes' gap, the edges' normals and the multipliers below."""

    def run(scene):
        folder = tmp_path_factory.mktemp(scene)
        settings = {**cause.ENFORCED, **preprint_runs.on_side("G2")}
        launch.solve(scene, {**launch.sizes((16, 20)), **settings}, folder)
        return nodal_stress.Run(folder)

    return run


def test_stresses_of_mortise_s_own_displacements_are_its_own(enforced):
    run = enforced("parabola_2")
    tables = ["contact.csv", "contact_centres.csv"]
    before = [launch.columns(run.folder / name) for name in tables]
    run.write()
    for name, old in zip(tables, before):
        new = launch.columns(run.folder / name)
        by_place = lambda table: dict(zip(zip(table["curve"], np.round(table["x"], 9)), table["sigma_2"]))
        old, new = by_place(old), by_place(new)
        assert new == pytest.approx({place: old[place] for place in new}, abs=1) and len(new) == len(old)  # Pa


@pytest.mark.parametrize("scene, near, whole", [("tent_b", 1e-10, (1e-3, 2e-3)), ("parabola_2", 0.03, (0.5, 1))])
def test_projected_elements_that_are_cut_are_segments(enforced, scene, near, whole):
    """Another program's u: the same on straight lines, near it on curves; not cut, it is something else."""
    run = enforced(scene)
    for cut, (least, most) in ((True, (0, near)), (False, whole)):
        found = projected_elements.solve(run, "lower_contact", gap=True, cut=cut)
        assert least <= np.abs(found - run.u).max() / np.abs(run.u).max() <= most


def test_roughness_of_a_line_and_of_a_zigzag():
    x = np.linspace(0, 0.8, 81)
    curve = {"x": x, "sigma_n": 2 + x}
    assert gallery_measures.roughness("circle", curve) < 1e-12
    curve["sigma_n"] = 10 + (-1.0) ** np.arange(81)
    assert gallery_measures.roughness("circle", curve) == pytest.approx(0.2, rel=0.01)
    other = {"x": x, "sigma_n": curve["sigma_n"] + 3}
    assert gallery_measures.apart("circle", curve, other) == pytest.approx(0.3, rel=0.01)


@pytest.mark.parametrize("scene", ["parabola_1", "tent_b"])
def test_matching_meshes_give_no_delta_on_either_side(store, scene):
    for side, body in (("G1", "G2"), ("G2", "G1"), ("G2", "G2")):
        settings = cause.settings_of(cause.BOTH, scene)
        assert oscillation.delta_of(store, scene, (16, 16), settings, side, body)[0] < 1e-8


def test_a_gap_that_is_enforced_oscillates_on_the_parabola_and_falls_with_the_mesh(store):
    found = {
        (variant, mesh): oscillation.delta_of(store, "parabola_2", mesh, cause.VARIANTS[variant], "G2", "G2")[0]
        for variant in (cause.OURS, cause.NORMALS, cause.GAP)
        for mesh in ((16, 20), (32, 40))
    }
    for mesh in ((16, 20), (32, 40)):
        assert found[cause.OURS, mesh] < 0.1 * found[cause.GAP, mesh]
        assert found[cause.NORMALS, mesh] == pytest.approx(found[cause.OURS, mesh], rel=0.3)
    assert 2.5 < found[cause.GAP, (16, 20)] / found[cause.GAP, (32, 40)] < 10


def test_the_curve_s_gap_is_closed(store):
    for scene in ("parabola_2", "circle", "tent_c"):
        closed = {**cause.METHOD, "contact.initial_gap": "closed"}
        of = lambda settings: oscillation.delta_of(store, scene, (16, 20), settings, "G2", "G1")[0]
        assert of(cause.METHOD) == pytest.approx(of(closed), rel=1e-6)


def test_effects_and_medians_by_hand():
    place = {"scene": "circle", "target": True, "at": "nodes"}
    values = {cause.OURS: (1, 2, 4), cause.NORMALS: (1, 2, 8), cause.GAP: (3, 20, 8), cause.BOTH: (3, 2, 4)}
    rows = [
        {**place, "scene": scene, "mesh": (4 * n, 5 * n), "variant": variant, "d": value, "printed": n}
        for variant, of in values.items()
        for scene in ("circle", "parabola_1")
        for n, value in enumerate(of, 1)
    ]
    found = {(row["variant"], row["series"]): (row["median"], row["largest"]) for row in cause.effects(rows, "d")}
    assert found[cause.NORMALS, "circle"] == (1, 2) and found[cause.GAP, "parabolas"] == (3, 10)
    last = list(cause.medians(rows, [cause.OURS, cause.GAP], "d"))[-1]
    assert last == {"mesh": (12, 15), "series": "parabolas", "printed": 3, cause.OURS: 4, cause.GAP: 8}


def test_contact_lines_pass_through_the_points_of_the_text(store, monkeypatch):
    view = gallery.View(store, next(iter(printed_tables.MAPPINGS)), cause.BOTH)
    text, holds = gallery.claims.passes_through(view, "parabola_1", "tent_b")
    assert holds and "parabola 1 0.2, 0.4, 0.2" in text
    monkeypatch.setitem(gallery.TABLE["heights"], "parabola_1", [0.2, 0.45, 0.2])  # as the preprint's Table 4 prints it
    assert not gallery.claims.passes_through(view, "parabola_1", "tent_b")[1]


def test_a_missing_executable_is_said(monkeypatch, tmp_path):
    monkeypatch.setattr(launch, "MORTISE", tmp_path / "nothing")
    with pytest.raises(SystemExit, match="is missing: ./dev build"):
        preprint.main(["--quick", "-o", str(tmp_path)])


def test_quick_study_is_whole(quick):
    folder, solved = quick
    assert solved > 50
    rows = read(folder / "tables.csv")
    printed = printed_tables.printed_rows(preprint.QUICK.meshes)
    assert len(rows) == len(printed) == 24
    assert [float(row["printed"]) for row in rows] == [row["printed"] for row in printed]
    assert all(row["better_ok"] == "True" for row in rows)
    assert len(read(folder / "variants.csv")) == 24 * len(preprint.QUICK.variants)
    drawn = read(folder / "gallery.csv")
    assert [int(row["figure"]) for row in drawn] == preprint.QUICK.figures
    pictures = [row["picture"] for row in drawn] + ["tables.png", "variants.png", "meshes.png", "curves.png"]
    page = (folder / "preprint.md").read_text()
    for picture in pictures:
        figure.copy_small(folder / picture, folder / "small.png")  # as pages of docs/ are
        assert 2000 < (folder / "small.png").stat().st_size < 100000 and f"]({picture})" in page
    assert page.count("\n| ") >= 24 and "\n| 5 | parabola_2 | 40x50 | nodes | G2 | G2 | 0.17 |" in page


def test_quick_study_shows_the_cause(quick):
    folder, _ = quick
    reading = next(iter(printed_tables.MAPPINGS))
    by = {(r["variant"], r["scene"], r["active"], r["body"]): float(r[reading]) for r in read(folder / "variants.csv")}
    for place in (key[1:] for key in by if key[0] == cause.OURS):
        if place[0].startswith("parabola"):
            assert by[cause.OURS, *place] < 0.2 * by[cause.GAP, *place]
        if place[0] == "circle":
            assert by[cause.BOTH, *place] < 1.5 * by[cause.OURS, *place]
    gaps = {row["scene"]: row for row in read(folder / "gaps.csv")}
    assert float(gaps["circle"]["largest gap, m"]) < 0.01 * float(gaps["parabola_2"]["largest gap, m"])
    measured, predicted = (float(gaps["parabola_2"][name]) for name in ("largest gap, m", "predicted, m"))
    assert measured == pytest.approx(predicted, rel=0.1)


def test_second_study_solves_nothing(quick):
    folder, _ = quick
    kept = {path: path.stat().st_mtime_ns for path in (folder / "runs").glob("*/contact.csv")}
    (folder / "tables.csv").unlink()
    assert preprint.main(["--quick", "-o", str(folder)]) == 0
    assert {path: path.stat().st_mtime_ns for path in (folder / "runs").glob("*/contact.csv")} == kept
    assert (folder / "tables.csv").is_file()
