"""What the pictures of a run show, part by part, and that other programs can read what they are made from."""

import re

import meshio
import numpy as np
import pytest

import launch  # makes src/python/pictures known
import drawn_bodies
import drawn_cases
import drawn_cells
import drawn_forces
import drawn_pairs
import drawn_pressure
import figure
import result_tables
import shapes


@pytest.mark.parametrize("scene", ["parabola_1", "stack", "wall"])
def test_arrows_are_in_balance(solve, scene):
    """Loads and reactions, each at its place with its moment about it: their sums vanish."""
    model = launch.summary(solve(scene))["model"]
    forces = list(drawn_forces.acting_forces(model))
    size = sum(np.linalg.norm(force) for _, force, _, _ in forces)
    assert np.linalg.norm(sum(force for _, force, _, _ in forces)) < 1e-10 * size
    assert {colour for colour, _, _, _ in forces} == {drawn_forces.LOAD, drawn_forces.REACTION}
    everything = drawn_forces.acting_forces(model | {"supports": [s | {"displacement": {"x": 0, "y": 0}} for s in model["supports"]]})
    moments = [at[0] * force[1] - at[1] * force[0] + moment for colour, force, at, moment in everything if colour == drawn_forces.REACTION]
    assert sum(moments) == pytest.approx(-sum(load["moment"] for load in model["loads"]), abs=1e-9 * size)


def test_zoom_on_hertz_is_a_little_more_than_the_contact(solve):
    results = solve("hertz")
    low, high = drawn_bodies.loaded_box(meshio.read(results / "result.vtu"), result_tables.columns(results / "contact.csv"))
    half_width = 0.0100757  # Hertz, geo/hertz.toml
    assert low[0] < 0 and half_width < high[0] < 1.5 * half_width
    assert high[1] - low[1] == pytest.approx(high[0] - low[0])


def test_no_gap_is_drawn_as_an_overlap():
    """A flat gap of 1e-3 that closes to 0: magnified so many times it is (1 - scale) * 1e-3."""
    both = np.array([0.0, 1.0, 0.0, 1.0])
    table = {
        "pair": np.zeros(4),
        "curve": np.array(["low", "low", "high", "high"]),
        "x": both,
        "y": np.array([0, 0, 1e-3, 1e-3]),
        "u_n": np.array([0, 0, -1e-3, -1e-3]),
        "gap": np.array([0, 0, np.nan, np.nan]),
    }
    assert drawn_bodies.scale_without_overlap(table, size=1) == pytest.approx((1e-3 + drawn_bodies.OVERLAP) / 1e-3)
    assert drawn_bodies.scale_without_overlap(table | {"gap": np.full(4, 1e-3)}, 1) == pytest.approx((2e-3 + drawn_bodies.OVERLAP) / 1e-3)
    assert drawn_bodies.scale_without_overlap(table | {"u_n": np.zeros(4)}, 1) == np.inf


@pytest.mark.parametrize("scene", ["hertz", "gap_close"])
def test_bodies_are_not_magnified_into_each_other(solve, scene):
    table = result_tables.columns(solve(scene) / "contact.csv")
    points = meshio.read(solve(scene) / "result.vtu").points[:, :2]
    assert drawn_bodies.scale_without_overlap(table, drawn_cells.size_of(points)) < 100  # thousands without


def test_the_stress_across_the_contact_is_the_pressure_there(solve):
    results = solve("punch")
    mesh, curve = (meshio.read(results / name) for name in ("result.vtu", "contact.vtu"))
    of_bodies = drawn_bodies.field_of(mesh, curve, "sigma_n")
    known = np.isfinite(curve.point_data["sigma_n"].ravel())
    places, expected = curve.points[known, :2], curve.point_data["sigma_n"].ravel()[known]
    numbers = [(block.data, np.ravel(body)) for block, body in zip(mesh.cells, mesh.cell_data["body"])]
    bodies = [np.unique(np.concatenate([cells[body == k].ravel() for cells, body in numbers])) for k in (0, 1)]
    found = [of_bodies[of[drawn_cells.nearest(places, mesh.points[of, :2])]] for of in bodies]
    error = np.min([np.abs(values - expected) for values in found], axis=0)
    assert error.max() < 1e-9 * np.abs(expected).max()


def test_the_axis_of_the_pressure_is_cut_to_the_contact():
    s = np.linspace(0, 10, 101)
    part = np.where((s > 3.95) & (s < 6.05), 1.0, 0.0)
    assert drawn_pressure.loaded_part(s, part) == pytest.approx((3.8, 6.2), abs=0.02)
    assert drawn_pressure.loaded_part(s, np.ones(101)) == (0, 10)


@pytest.mark.parametrize("singular, shown", [([], True), ([0.7], False), ([1.0], True)])
def test_a_peak_is_shown_where_p_has_a_limit(singular, shown):
    s = np.linspace(0, 1, 201)
    p = 1 + 99 * np.exp(-((s - 0.5) ** 2) / 1e-5)
    table = {"curve": np.array(["foot"] * 201), "s": s, "x": s, "y": 0 * s, "p": p, "sigma_n": -p}
    table = {name: np.concatenate([column, column]) for name, column in table.items()}
    table["curve"][201:] = "top"
    table["pair"] = np.zeros(402, dtype=int)
    points = [{"pair": 0, "pressure_exponent": exponent} for exponent in singular]
    bounded = drawn_pressure.has_limit({"estimate": {"pressure": {"singular": points}}}, 0)
    drawing, axes = figure.panels(1, 1, (4, 3))
    drawn_pressure.draw_pair(axes, table, 0, bounded)
    assert (axes.get_ylim()[1] > 100) == shown == ("off the scale" not in axes.get_xlabel())
    assert not drawn_pressure.has_limit({"estimate": None}, 0)


README = re.findall(r"```\w*\n(.*?)```", (launch.ROOT / "README.md").read_text(), re.DOTALL)


def test_curves_of_a_few_edges_end_where_they_face_nothing(mortise, tmp_path):
    """3-node triangles: means over edges, 3 of either side face each other, along a line that is twice half an edge longer."""
    for name, start in (("punch.geo", "SetFactory"), ("punch.toml", 'title = "A punch')):
        (tmp_path / name).write_text(next(text for text in README if text.startswith(start)))
    launch.solve(tmp_path / "punch.toml", {}, tmp_path / "out")
    drawing, axes = figure.panels(1, 1, (4, 3))
    drawn_pressure.draw_pair(axes, result_tables.contact_table(tmp_path / "out", centres=True), 0, False)
    assert axes.get_xlim() == pytest.approx((0, 0.2)) and "off the scale" not in axes.get_xlabel()
    for line in axes.get_lines():
        s, p = np.array(line.get_data())[:, np.isfinite(line.get_ydata())]
        np.testing.assert_allclose(s, [0.1 / 3, 0.1, 0.5 / 3])
        assert p.min() > 7e6
        assert np.isfinite(line.get_data()[0]).all(), "one piece"


def test_p_ends_where_contact_does(solve):
    table, pairs = result_tables.contact_table(solve("wall")), launch.summary(solve("wall"))["contact"]
    drawing, axes = figure.panels(1, len(pairs), (40, 3))
    drawn_pairs.draw_small(axes, table, pairs, range(len(pairs)))
    for panel in axes:
        p = panel.get_lines()[0].get_ydata()
        p = p[np.isfinite(p)]
        assert p.min() > 0.9 * p.max() and panel.get_ylabel() in ("", "$10^{6}$", "$10^{5}$")


def test_forces_act_where_the_pressure_does():
    table = {"s": np.array([0.0, 1, 2, 3]), "x": np.array([0.0, 1, 2, 3]), "y": np.zeros(4), "p": np.array([0.0, 0, 3, 3])}
    np.testing.assert_allclose(drawn_forces.place_of_force(table, np.full(4, True)), (2.5, 0))
    table["p"][:] = 0  # no force: in the middle
    np.testing.assert_allclose(drawn_forces.place_of_force(table, np.full(4, True)), (1.5, 0))


@pytest.mark.parametrize("scene", ["patch_flat", "rings"])
def test_meshio_reads_quadratic_cells(solve, scene):
    mesh = meshio.read(solve(scene) / "result.vtu")
    assert {block.type for block in mesh.cells} == {"quad8"}
    assert mesh.point_data["displacement"].shape == (len(mesh.points), 3)
    assert mesh.point_data["stress"].shape == (len(mesh.points), 4)
    assert {block.type for block in meshio.read(solve(scene) / "contact.vtu").cells} == {"line3"}


def test_sub_triangles_cover_the_bodies(solve):
    """Quarter rings between the radii 1 and 3: area 2 pi, up to the error of the sub-triangles' straight sides."""
    mesh = meshio.read(solve("rings") / "result.vtu")
    xy, _, triangles = drawn_cells.shaded_triangles(mesh, mesh.points[:, :2], mesh.point_data["von_mises"].ravel())
    a, b = xy[triangles[:, 1]] - xy[triangles[:, 0]], xy[triangles[:, 2]] - xy[triangles[:, 0]]
    twice_the_area = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    assert (twice_the_area > 0).all()
    assert twice_the_area.sum() / 2 == pytest.approx(2 * np.pi, rel=1e-3)


@pytest.mark.parametrize("kind, n", [("triangle", 1), ("triangle6", 3), ("quad", 1), ("quad8", 4), ("quad9", 2)])
def test_shape_functions_and_subdivision(kind, n):
    x, y, triangles = shapes.subdivision(kind, n)
    N = shapes.shape_functions(kind, x, y)
    np.testing.assert_allclose(N.sum(axis=1), 1, atol=1e-14)
    corners = shapes.CORNERS[kind]
    assert len(triangles) == (n * n if corners == 3 else 2 * n * n)
    area = lambda t: np.linalg.det(np.stack([[x[j] - x[t[0]], y[j] - y[t[0]]] for j in t[1:]])) / 2
    assert sum(area(t) for t in triangles) == pytest.approx(0.5 if corners == 3 else 4)


def test_a_rigid_curve_s_forces_are_in_balance():
    """Held along x, pushed along y and turned: its own force and moment, and the reaction about the same point."""
    rigid = {"x": 0, "force": [0, -3], "moment": 0.5, "about": [2, 1], "displacement": [0, -1], "turned": 0.1}
    support = {"rigid": rigid, "reaction": [4, 0], "moment": -4.0, "curves": [{"reaction": [4, 0], "centre": [2, 0]}]}
    load, reaction = drawn_forces.acting_forces({"loads": [], "supports": [support]})
    assert load[0] == drawn_forces.LOAD and list(load[1]) == [0, -3] and list(load[2]) == [2, 1] and load[3] == 0.5
    assert reaction[0] == drawn_forces.REACTION and list(reaction[1]) == [4, 0] and reaction[3] == 0  # 4 at an arm of 1 about 0


def test_reactions_that_are_round_off_are_not_drawn():
    drawing, axes = figure.panels(1, 1, (4, 3))
    model = {"loads": [], "supports": [{"curves": [{"reaction": [1e-11, 0], "centre": [0, 0]}]}]}
    points = np.array([[0.0, 0], [1, 1]])
    drawn_forces.draw_arrows(axes, points, model, at_work=1.0)
    assert not axes.texts
    drawn_forces.draw_arrows(axes, points, model, at_work=0.0)
    assert axes.texts


def test_labels_of_forces_far_from_the_bodies_stay_in_the_panel():
    """A moment has no arrow, but a label; a place far off makes the panel wider, and labels with it."""
    drawing, axes = figure.panels(1, 1, (8, 3))
    far = {"rigid": {"force": [0, 0], "moment": -320.0, "about": [0, 0]}, "reaction": [7, -20], "moment": 0, "curves": []}
    clamp = {"displacement": {"x": 0, "y": 0}, "curves": [{"reaction": [-7, 20], "centre": [20, -1], "moment_about_centre": -64.0}]}
    drawn_forces.draw_arrows(axes, np.array([[12.0, -4], [20, 3]]), {"loads": [], "supports": [far, clamp]}, at_work=20.0)
    axes.autoscale_view()
    axes.set_aspect("equal")
    drawing.canvas.draw()
    labels = [text for text in axes.texts if text.get_text()]
    assert {text.get_text() for text in labels} == {"moment -320", "21.2", "21.2\nmoment -64"}
    panel = axes.get_window_extent()
    for text in labels:
        at = text.get_window_extent()
        assert panel.x0 <= at.x0 and at.x1 <= panel.x1, text.get_text()


@pytest.mark.parametrize("limits, label, tick", [((0, 2e7), "p, $10^{7}$", "1.5"), ((0, 15), "p", "4"), ((-4e-5, 0), "p, $10^{-5}$", "-2")])
def test_the_power_of_ten_is_in_the_label(limits, label, tick):
    drawing, axes = figure.panels(1, 1, (4, 3))
    axes.set_ylim(*limits)
    figure.scientific(axes.yaxis, "p")
    drawing.canvas.draw()
    texts = [text.get_text().replace("\u2212", "-") for text in axes.get_yticklabels()]
    assert axes.get_ylabel() == label and tick in texts and not axes.yaxis.get_offset_text().get_text()


@pytest.mark.parametrize("value", [1.1e6, -3.0])
def test_round_off_is_drawn_as_a_constant(value):
    drawing, axes = figure.panels(1, 1, (4, 3))
    axes.plot([0, 1, 2], [value, value * (1 + 1e-7), value])
    figure.scientific(axes.yaxis, "p")
    drawing.canvas.draw()
    texts = [text.get_text() for text in axes.get_yticklabels()]
    assert len(set(texts)) == len(texts) > 2 and 0 in axes.get_ylim()


def test_the_columns_that_cases_are_drawn_over():
    table = {"case": np.array(["a", "b"]), "scale": np.array([1.0, 1.0]), "boundary.2.pressure": np.array([2.0, 1.0]),
             "status": np.array(["solved"] * 2), "support.1.displacement.x": np.array([0.0, 1.0]),
             "support.1.displacement.y": np.array([0.0, -3.0]), "support.1.turned": np.array([0.0, 1e-20]),
             "support.1.acting.x": np.array([0.0, 1.0]), "support.1.acting.y": np.array([5.0, 6.0]),
             "support.1.acting.turn": np.array([1e3, 1e3]), "energy": np.array([0.0, 9.0])}  # fmt: skip
    assert drawn_cases.load_axis(table, None)[0] == "boundary.2.pressure"
    name, moved, reaction = drawn_cases.approach(table)
    assert name == "support.1.displacement.y" and moved[1] == -3 and reaction[1] == 6
    shaft = table | {"support.1.displacement.x": np.array([0.0, 1e-19]), "support.1.displacement.y": np.array([0.0, -1e-19])}
    assert drawn_cases.approach(shaft) is None  # moves by round-off
    name, moved, moment = drawn_cases.approach(shaft | {"support.1.turned": np.array([0.0, 1e-4])})  # held in x and y, it turns
    assert name == "support.1.turned" and moved[1] == 1e-4 and moment[1] == 1e3
    del table["boundary.2.pressure"]
    assert drawn_cases.load_axis(table, None)[0] == "case"


def test_the_history_is_that_of_the_most_pressed_pair():
    table = {"case": np.array(["a", "b"]), "contact.0.pressure.max": np.array([3.0, 2.0]), "contact.2.pressure.max": np.array([np.nan, 9.0])}
    assert drawn_cases.most_pressed(table, [0, 2]) == 2
    assert [label for label, _, _ in drawn_cases.contact_panels(table, 2, [0, 2])][0] == "largest p, contact.2"
    assert [label for label, _, _ in drawn_cases.contact_panels(table, 0, [0])][0] == "largest p"


def one_pair(places, p, first="foot", other="top"):
    """The columns of contact.csv of two straight curves along x, `first` the multiplier side; s from where `top` starts, or `foot`."""
    x, begin = np.array(places), {first: 0.0, other: 0.0, "top": 10.0}
    sides = [{"curve": np.full(len(x), name), "s": x - x[0] + begin[name], "p": np.array(p)} for name in (first, other)]
    table = {key: np.concatenate([side[key] for side in sides]) for key in ("curve", "s", "p")}
    return table | {"pair": np.zeros(2 * len(x)), "x": np.tile(x, 2), "y": np.zeros(2 * len(x)), "gap": np.zeros(2 * len(x))}


def test_p_of_all_cases_is_along_the_curve_of_the_first(tmp_path):
    x, p = [0.0, 0.5, 1.0], [1.0, 2.0, 1.0]
    for case, sides in [("a", ("foot", "top")), ("b", ("top", "foot"))]:
        folder = tmp_path / "cases" / case
        folder.mkdir(parents=True)
        table = one_pair(x, p, *sides)
        rows = [",".join(table), *(",".join(map(str, row)) for row in zip(*table.values()))]
        (folder / "contact.csv").write_text("\n".join(rows) + "\n")
        (folder / "summary.json").write_text('{"contact": [{"number": 0}]}')
    found = list(drawn_cases.pressures(tmp_path, {"case": np.array(["a", "b"])}, 0))
    assert [(case, list(s), curve) for case, s, _, curve in found] == [("a", x, "foot"), ("b", x, "foot")]


def test_runs_are_drawn_on_the_line_of_the_first_or_on_their_own():
    """Of one geometry, whichever side has the multipliers; of another, moved or longer, over their own arc length: none ends where
    the first one's contact does."""
    x, summary = np.linspace(0, 1, 11), {"contact": [{"between": ["foot", "top"]}]}
    runs = [("narrow", summary, one_pair(x, np.where(x < 0.35, 1.0, 0.0))), ("wide", summary, one_pair(x, np.ones(11), "top", "foot")),
            ("moved", summary, one_pair(x + 3, np.ones(11))), ("longer", summary, one_pair(2 * x, np.ones(11)))]  # fmt: skip
    drawing, axes = figure.panels(1, 1, (4, 3))
    drawn_pairs.draw_runs([axes], runs, [0], summary)
    lines = axes.get_lines()
    assert [line.get_label() for line in lines] == ["narrow", "wide", "moved, its own s", "longer, its own s"]
    for line, s in zip(lines, (x, x, x, 2 * x)):
        np.testing.assert_allclose(line.get_xdata(), s, atol=1e-12)
    assert axes.get_xlim()[0] <= 0 and axes.get_xlim()[1] >= 2


def test_cases_that_differ_in_more_than_their_scale_are_lines_of_their_own():
    table = {"case": np.array(["pull_0.5", "pull_10", "push_2", "push_1", "alone"]), "scale": np.array([0.5, 10, 2, 1, 1]),
             "boundary.2.pressure": np.array([np.nan, np.nan, 50, 50, 60]), "status": np.array(["solved"] * 5)}  # fmt: skip
    groups = drawn_cases.histories(table)
    assert [(name, list(rows)) for name, rows in groups] == [("pull", [0, 1]), ("push", [2, 3]), ("alone", [4])]
    drawing, axes = figure.panels(1, 1, (4, 3))
    drawn_cases.draw_over(axes, groups, table["scale"], np.arange(5.0), np.zeros(5), "p", "scale")
    assert [list(line.get_xdata()) for line in axes.get_lines()] == [[0.5, 10], [1, 2], [1]]
    unscaled = table | {"scale": np.ones(5)}
    assert [list(rows) for _, rows in drawn_cases.histories(unscaled)] == [[0, 1, 2, 3, 4]]
    assert drawn_cases.load_axis(unscaled, None)[0] == "case"  # two have no pressure of their own
    assert drawn_cases.history_name(["a", "b"]) == "a ... b"


def test_a_turned_scene_is_the_same_scene(solve):
    results = solve("pellets")
    mesh, curve = (meshio.read(results / f"{name}.vtu") for name in ("result", "contact"))
    table = result_tables.columns(results / "contact.csv")
    kept = drawn_bodies.field_of(mesh, curve, "sigma_n")
    x = table["x"]
    drawn_bodies.turn(mesh, curve, table)
    same = np.isclose(drawn_bodies.field_of(mesh, curve, "sigma_n"), kept)
    assert same.mean() > 0.999 and (table["y"] == x).all()  # two places may be as near
    assert np.ptp(mesh.points[:, 0]) > 3 * np.ptp(mesh.points[:, 1])


def test_the_curve_of_most_pairs_and_the_most_loaded():
    pairs = [{"between": [f"pellet_{k}", "inside" if k != 7 else "outside"], "force": [0, k % 5]} for k in range(20)]
    assert drawn_pairs.shared_curve(pairs) == ("inside", [k for k in range(20) if k != 7])
    assert drawn_pairs.shared_curve(pairs[7:8]) is None
    chosen = drawn_pairs.most_loaded(pairs)
    assert len(chosen) == drawn_pairs.SMALL and chosen == sorted(chosen) and {k % 5 for k in chosen} == {2, 3, 4}


def test_users_texts_are_drawn_as_they_are_written():
    assert figure.plain("5 $ or $x$") == "5 \\$ or \\$x\\$"
    assert figure.plain("a\x07b\u202e") == "a?b?"
    assert len(figure.short("long" * 40)) <= figure.LONGEST
    assert figure.wrapped("word " * 200).count("\n") == 2


def test_meshio_finds_the_arrays_of_the_smallest_meshes(mortise, tmp_path):
    """It renumbers their places by multiples of 4 as it reads: where ours were such, it took one array for another."""
    for n in range(1, 9):
        results = tmp_path / str(n)
        launch.solve("patch_flat", launch.sizes((n, n + 1)) | {"mesh.parameters.order": 1}, results)
        for name in ("result.vtu", "contact.vtu"):
            header = (results / name).read_bytes().split(b"<AppendedData")[0].decode()
            places = [int(place) for place in re.findall(r'offset="(\d+)"', header)]
            assert places[0] == 0 and all(place % 4 for place in places[1:])
            mesh = meshio.read(results / name)
            assert max(block.data.max() for block in mesh.cells) == len(mesh.points) - 1


@pytest.mark.parametrize("start", [0.0, 0.5, 3.0, 6.0])
def test_p_of_a_closed_curve_is_drawn_in_one_piece_wherever_the_curve_starts(start):
    """Circles of radius 1 in contact over an angle of 1 to each side of 0: p = cos^2; s is the angle from the start."""
    drawing, axes = figure.panels(1, 1, (4, 3))
    sides = []
    for count in (100, 87):
        s = 2 * np.pi * np.arange(count) / count
        angle = np.mod(s + start + np.pi, 2 * np.pi) - np.pi
        p = np.where(np.abs(angle) < 1, np.cos(np.pi / 2 * angle) ** 2, 0)
        sides.append({"s": s, "x": np.cos(angle), "y": np.sin(angle), "p": p, "sigma_n": -p, "curve": np.full(count, str(count))})
    table = {key: np.concatenate([side[key] for side in sides]) for key in sides[0]} | {"pair": np.zeros(187, dtype=int)}
    drawn_pressure.draw_pair(axes, table, 0, True)
    left, right = axes.get_xlim()
    assert right - left == pytest.approx(2.4, abs=0.2)
    for line in axes.get_lines():
        s, p = line.get_data()
        inside = np.isfinite(s) & (s >= left) & (s <= right)
        assert np.isfinite(p[inside]).all() and p[inside].max() > 0.99
        assert np.nanmax(np.abs(np.diff(s))) < 0.2, line.get_label()  # no line across the graph


def test_names_that_would_lie_on_others_are_left_out():
    drawing, axes = figure.panels(1, 1, (4, 3))
    axes.set(xlim=(0, 1), ylim=(0, 1))
    texts = [axes.annotate(text, at, rotation=turned) for text, at, turned in (("first", (0.5, 0.5), 0), ("on it", (0.52, 0.5), 90), ("beside", (0.1, 0.9), 0))]
    assert figure.leave_out_overlaps(drawing, texts) == 1
    assert [text.get_visible() for text in texts] == [True, False, True]
