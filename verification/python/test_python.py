"""Python's module: results that the program wrote are read back, scenes are solved without files."""

import concurrent.futures
import os
import re
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import launch

BUILT = launch.MORTISE.with_name("python")
sys.path.insert(0, str(BUILT if BUILT.exists() else launch.ROOT / "src/python"))

import mortise

solves = pytest.mark.skipif(not list(BUILT.glob("mortise/_mortise*.so")), reason=f"{BUILT} has no module: ./dev build makes it")


@pytest.fixture(scope="module", name="punch")
def solved_by_the_program(tmp_path_factory):
    if not launch.MORTISE.is_file():
        pytest.skip(f"{launch.MORTISE} is missing: ./dev build makes it")
    folder = tmp_path_factory.mktemp("punch") / "results"
    launch.solve("punch", {}, folder)
    return folder


def test_results_are_read_as_the_files_have_them(punch):
    run, table = mortise.read(punch), launch.contact(punch)
    for name in ("s", "p", "p_error", "gap"):
        np.testing.assert_array_equal(getattr(run, name), table[name])
    assert run.status == "solved" and all(check["ok"] for check in run.checks.values())
    assert run.x.shape == run.u.shape == (len(run.stress), 2) and run.stress.shape[1] == 4
    assert np.abs(run.u).max() == pytest.approx(1.07e-5, rel=0.01)  # the punch goes down by so much
    with pytest.raises(KeyError, match="known: foot, block_top"):
        run.side("nothing")
    rows = run.contact["curve"] == "foot"
    run.contact["pair"] = np.where(np.cumsum(rows) > 5, 1, 0)
    assert len(run.side("foot", 0)["p"]) == 5 and len(run.side("foot", 1)["p"]) == rows.sum() - 5
    with pytest.raises(KeyError, match=r"curve 'foot' is in the pairs 0, 1; expected side\('foot', pair\)"):
        run.side("foot")
    with pytest.raises(KeyError, match="curve 'foot' is not in pair 2; its pairs: 0, 1"):
        run.side("foot", 2)


def test_a_field_of_a_file_is_what_other_readers_find(punch):
    mesh = pytest.importorskip("meshio").read(punch / "result.vtu")
    run = mortise.read(punch)
    np.testing.assert_array_equal(run.x, mesh.points[:, :2])
    np.testing.assert_array_equal(run.stress, mesh.point_data["stress"])


@solves
def test_a_fluid_has_its_column(tmp_path):
    changes = {"contact.0.fluid.pressure": 4e6, "contact.0.fluid.from": [0.2, 0.2]}
    launch.solve("punch", changes, tmp_path / "results")
    run, read = mortise.solve(launch.scene_file("punch"), changes), mortise.read(tmp_path / "results")
    assert list(run.contact) == list(read.contact)
    np.testing.assert_array_equal(run.contact["p_fluid"], read.contact["p_fluid"])
    assert set(run.contact["p_fluid"]) <= {0.0, 4e6}


@solves
def test_solved_here_is_as_solved_by_the_program(punch):
    run, read = mortise.solve(launch.scene_file("punch")), mortise.read(punch)
    for name in ("s", "p", "p_error", "x", "u", "stress"):
        ours, theirs = getattr(run, name), getattr(read, name)
        np.testing.assert_allclose(ours, theirs, atol=1e-9 * np.abs(theirs).max())
    assert list(run.contact) == list(read.contact) and run.checks.keys() == read.checks.keys()


@solves
def test_a_dict_is_a_scene():
    scene = {
        "mesh": {"file": launch.ROOT / "geo/punch.geo"},
        "materials": {"steel": {"young": 210e9, "poisson": 0.3}},
        "bodies": {"block": "steel", "punch": "steel"},
        "boundary": [
            {"on": ["ground"], "displacement": {"x": 0, "y": 0}},
            {"on": ["head"], "displacement": {"x": 0.0}},
            {"on": ["head"], "pressure": np.float64(10e6)},
        ],
        "contact": [{"between": ["foot", "block_top"]}],
    }
    a, b = mortise.solve(scene), mortise.solve(scene, {"boundary.2.pressure": 20e6}, estimate=False)
    np.testing.assert_allclose(b.u, 2 * a.u, atol=1e-9 * np.abs(b.u).max())
    with pytest.raises(KeyError, match="estimated no error"):
        b.p_error


@solves
def test_files_of_a_dict_are_where_one_works(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "load.csv").write_text("x,y,q\n-99,-99,2\n99,-99,2\n0,99,2\n")
    (tmp_path / "cases.csv").write_text("name,boundary.2.pressure\none,1e6\ntwo,2e6\n")
    scene = {
        "mesh": {"file": os.path.relpath(launch.ROOT / "geo/punch.geo")},
        "fields": {"q": {"file": "load.csv"}},
        "materials": {"steel": {"young": 210e9, "poisson": 0.3}},
        "bodies": {"*": "steel"},
        "boundary": [
            {"on": "ground", "displacement": {"x": 0, "y": 0}},
            {"on": "head", "displacement": {"x": 0}},
            {"on": "head", "pressure": "1e6 * q"},
        ],
        "contact": [{"between": ["foot", "block_top"]}],
    }
    by_field = mortise.solve(scene, estimate=False)
    table = mortise.cases(scene | {"case": [{"file": "cases.csv"}]})
    assert list(table["status"]) == ["solved", "solved"]
    forces = [float(force) for force in table["contact.0.force.y"]]
    assert forces[1] == pytest.approx(2 * forces[0], rel=1e-9) == pytest.approx(by_field.summary["contact"][0]["force"][1], rel=1e-9)


@solves
def test_errors_are_exceptions_with_the_words_of_the_program():
    scene = launch.scene_file("punch")
    said = subprocess.run([launch.MORTISE, "solve", scene, "--set", "materials.steel.young=-1"], capture_output=True, text=True, check=False)
    with pytest.raises(mortise.InputError) as error:
        mortise.solve(scene, {"materials.steel.young": -1})
    assert said.stderr == f"mortise: error: {error.value}\n" and isinstance(error.value, ValueError)


@solves
def test_errors_of_a_dict_name_its_keys():
    steel = {"young": 1, "poisson": 0.3}
    scene = {"mesh": {"file": launch.ROOT / "geo/punch.geo"}, "materials": {"steel": steel}, "bodies": {"block": "steel", "punch": "steel"}}
    held = {"boundary": [{"on": ["ground", "head"], "displacement": {"x": 0, "y": 0}}], "contact": [{"between": ["foot", "block_top"]}]}
    soft = {"materials": {"steel": steel | {"young": -1}}}
    words = "materials.steel.young: expected a number > 0, found -1"
    with pytest.raises(mortise.InputError, match=f"^{words}$"):
        mortise.solve(scene | held | soft)
    with pytest.raises(mortise.InputError, match="^bodies: body 'punch' of .* has no material"):
        mortise.solve(scene | held | {"bodies": {"block": "steel"}})
    table = mortise.cases(scene | held, {"case": [{"name": "a"}, {"name": "b", "mesh.parameters.n_block": 0.5}]})
    assert table["status"][0] == "solved" and table["status"][1].startswith("bad input: ") and "scene.toml" not in table["status"][1]
    table = mortise.sweep(scene | held, {"materials.steel.young": [1, -1]})
    assert list(table["status"]) == ["solved", f"bad input: --set materials.steel.young=-1: {words}"]


@solves
def test_what_is_no_list_is_refused():
    scene = launch.scene_file("punch")
    for vary, text in ({"model.plane": "stress"}, "'stress'"), ({"boundary.2.pressure": 1e6}, "1000000.0"):
        with pytest.raises(mortise.InputError, match=f"{[*vary][0]}: expected a list, found {text}"):
            mortise.sweep(scene, vary)
    with pytest.raises(mortise.InputError, match="of: expected a list, found 'energy'"):
        mortise.gradient(scene, "energy", {"boundary.2.pressure": 10e6})


@solves
def test_what_is_no_value_is_refused(tmp_path):
    scene, key = launch.scene_file("punch"), "boundary.2.pressure"
    for wrong in None, 1j, {1}, [1, None], np.array([None]):
        with pytest.raises(mortise.InputError, match=f"^{key}: expected a number, a text, a list or a dict, found "):
            mortise.solve(scene, {key: wrong})
        with pytest.raises(mortise.InputError, match="^mesh.parameters.n_block: expected a number, a text, a list or a dict, found "):
            mortise.cases({"mesh": {"file": "punch.geo", "parameters": {"n_block": wrong}}})
    for wrong in "10 * x", None, True, [1.0], np.array([1.0]):
        with pytest.raises(mortise.InputError, match=f"^{key}: expected a number, found "):
            mortise.gradient(scene, ["energy"], {key: wrong})
    for call in lambda: mortise.solve(scene, [(key, 1)]), lambda: mortise.sweep(scene, [key]), lambda: mortise.gradient(scene, ["energy"], [key]):
        with pytest.raises(mortise.InputError, match="^(changes|vary|by): expected a dict of keys and values, found "):
            call()
    for value in np.array(3e6), np.float32(3e6), np.int64(3000000):
        assert mortise.gradient(scene, ["energy"], {key: value}).value == mortise.gradient(scene, ["energy"], {key: 3e6}).value
        assert mortise.solve(scene, {key: value}).summary["energy"] == mortise.solve(scene, {key: 3e6}).summary["energy"]
    with pytest.raises(mortise.InputError, match="no summary.json there; expected the folder of a run of mortise solve"):
        mortise.read(tmp_path)


@solves
def test_a_sweep_of_which_no_run_can_be_read():
    with pytest.raises(mortise.InputError, match="unknown key 'presure'"):
        mortise.sweep(launch.scene_file("punch"), {"boundary.2.presure": [1, 2]})
    with pytest.raises(mortise.InputError, match="no.toml: no such file"):
        mortise.sweep("no.toml", {"boundary.2.pressure": [1, 2]})


@solves
def test_a_case_without_bodies_is_read(tmp_path):
    launch.call("solve", launch.scene_file("punch"), "--set", "case=[{name='a'}]", "--set", "cases.write=contact", "-o", tmp_path / "out")
    run, whole = mortise.read(tmp_path / "out/cases/a"), mortise.solve(launch.scene_file("punch"))
    np.testing.assert_allclose(run.p, whole.p, rtol=1e-9)
    with pytest.raises(AttributeError, match="no result.vtu"):
        run.stress
    with pytest.raises(mortise.InputError, match="expected the folder cases/NAME of one of them"):
        mortise.read(tmp_path / "out")


@solves
def test_the_scripts_of_the_page_run(tmp_path):
    blocks = re.compile(r"```\w*\n(.*?)```", re.DOTALL)
    readme = blocks.findall((launch.ROOT / "README.md").read_text())
    (tmp_path / "punch.geo").write_text(next(text for text in readme if text.startswith("SetFactory")))
    (tmp_path / "punch.toml").write_text(next(text for text in readme if text.startswith('title = "A punch')))
    draw, sweep, gradient = blocks.findall((launch.ROOT / "docs/python.md").read_text())
    (tmp_path / "sweep.py").write_text(sweep)
    environment = os.environ | {"PYTHONPATH": str(BUILT), "MPLBACKEND": "Agg"}
    for script in (draw, gradient):
        subprocess.run([sys.executable, "-c", script], cwd=tmp_path, env=environment, check=True)
    assert (tmp_path / "punch.png").read_bytes().startswith(b"\x89PNG")
    said = subprocess.run([sys.executable, "sweep.py"], cwd=tmp_path, env=environment, check=True, capture_output=True, text=True).stdout
    assert said.startswith("[ 5000000. 10000000. 20000000.] [") and said.endswith("['solved' 'solved' 'solved']\n")


@solves
def test_threads_solve_geometries_beside_each_other():
    """Each mesh is made in a process of its own; its size says whose it is."""
    scene, sizes = launch.ROOT / "geo/patch_flat.toml", (3, 4, 5, 6)

    def points(size):
        return [len(mortise.solve(scene, {"mesh.parameters.n_upper": size}, estimate=False).x) for _ in range(5)]

    alone = [points(size)[0] for size in sizes]
    with concurrent.futures.ThreadPoolExecutor(len(sizes)) as pool:
        assert list(pool.map(points, sizes)) == [[count] * 5 for count in alone]


@solves
def test_what_ends_gmsh_does_not_end_python(tmp_path):
    scene = {"mesh": {"file": tmp_path / "a.geo"}, "materials": {"m": {"young": 1, "poisson": 0.3}}, "bodies": {"a": "m"}}
    (tmp_path / "a.geo").write_text("Exit;\n")
    with pytest.raises(mortise.InputError, match="gmsh ended the program"):
        mortise.solve(scene)
    (tmp_path / "a.geo").write_text("For i In {1:1e9}\n x = i;\nEndFor\n")
    with pytest.raises(mortise.InputError, match="took longer than mesh.time_limit = 0.5"):
        mortise.solve(scene, {"mesh.time_limit": 0.5})


@solves
def test_an_interrupt_ends_a_solve():
    """Between its stages; some 3 s of meshes and solves are left out."""
    # A shell that runs the tests in the background tells them to ignore SIGINT.
    script = "import signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler); " + (
        f"sys.path.insert(0, {str(BUILT)!r}); import mortise; print('go', flush=True); "
        f"[mortise.solve({str(launch.ROOT / 'geo/parabola_1.toml')!r}, {{'accuracy.value': 1e-3}}) for _ in range(30)]"
    )
    with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as run:
        assert run.stdout.readline() == "go\n"
        time.sleep(0.3)
        run.send_signal(signal.SIGINT)
        assert "KeyboardInterrupt" in run.stderr.read()
    assert run.returncode == -signal.SIGINT


@solves
def test_cases_of_a_scene():
    scene = launch.ROOT / "geo/gap_close.toml"
    changes = {"case": [{"name": "part", "scale": [0.5, 0.75]}, {"name": "deep", "boundary.2.displacement.y": -4e-4}]}
    table = mortise.cases(scene, changes)
    assert list(table["case"]) == ["part_0.5", "part_0.75", "deep"] and list(table["status"]) == ["solved"] * 3
    assert list(table["scale"]) == [0.5, 0.75, 1] and list(table["boundary.2.displacement.y"]) == ["", "", "-4e-04"]
    modulus = 1 / (0.3 / 282.692e9 + 0.3 / 94.2308e9)  # geo/gap_close.toml, with a gap of 1e-4
    np.testing.assert_allclose(table["contact.0.pressure.max"], [0.5e-4 * modulus, 1.25e-4 * modulus, 3e-4 * modulus], rtol=1e-5)
    stiff = mortise.cases(scene, changes | {"boundary.2.stiffness": True})
    force = -stiff["support.2.reaction.y"]
    np.testing.assert_allclose(stiff["support.2.stiffness.y.y"], np.diff(force)[1] / 1.75e-4, rtol=1e-9)
    deep = mortise.solve(scene, changes, case="deep")
    assert deep.p.max() == pytest.approx(table["contact.0.pressure.max"][2], rel=1e-12)
    with pytest.raises(mortise.InputError, match=r"the scene has cases; expected solve\(scene, case=NAME\)"):
        mortise.solve(scene, changes)
    with pytest.raises(mortise.InputError, match="unknown case 'dep'; did you mean 'deep'"):
        mortise.solve(scene, changes, case="dep")
    with pytest.raises(mortise.InputError, match=r"the scene has no \[\[case\]\]"):
        mortise.cases(scene)
