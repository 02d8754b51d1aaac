"""The verdict of `mortise certify`: scenes that agree, and scenes with something wrong in one of the runs."""

import copy
import csv
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import meshio
import numpy as np
import pytest

import launch
from launch import ROOT

sys.path.append(str(ROOT / "src/python/reports"))

import certify
import figures
import report

PUNCH, HERTZ, RINGS = (ROOT / f"geo/{name}.toml" for name in ("punch", "hertz", "rings"))


@pytest.fixture(scope="module")
def solved():
    """What certify.solve gave, by scene, changes and name: the runs that are not spoilt are the same in many tests."""
    return {}


@pytest.fixture
def wrong(mortise, tmp_path, solved, monkeypatch):
    """Kinds of figures that do not agree, each with the run that says so, and the certificate."""
    solve = certify.solve

    def once(mortise, scene, changes, variation, folder):
        key = (scene, variation.name, *changes, *variation.changes)
        if key not in solved:
            solved[key] = solve(mortise, scene, changes, variation, folder)
        vars(variation).update(vars(copy.deepcopy(solved[key])))
        return variation

    monkeypatch.setattr(certify, "solve", once)

    def find(scene, changes=(), spoil=None):
        found = certify.certify(mortise, scene, tmp_path / "runs", changes, freefem=False, spoil=spoil)
        return {row["kind"]: row["run"] for row in found["figures"] if not row["agrees"]}, found

    return find


def test_certificate_of_hertz(call, tmp_path):
    said = call("certify", HERTZ, "-o", tmp_path / "runs")
    found = json.loads((tmp_path / "runs/certificate.json").read_text())
    assert found["agrees"] and found["troubles"] == []
    assert {row["kind"] for row in found["figures"]} == {
        "p along the lines", "contact forces", "lengths in contact", "largest p", "displacements", "stresses"
    }  # fmt: skip
    others = ["quadrilaterals", "finer_4", "finer_16", "other_side", "feti", *["freefem"] * bool(shutil.which("FreeFem++"))]
    assert [run["name"] for run in found["runs"]] == ["own", *others]
    assert found["skipped"] == ([] if "freefem" in others else ["FreeFEM on the same mesh: FreeFem++ is not installed"])
    assert f"agrees: 20 figures by {len(others)} other runs" in said
    assert found["deformed_gap"]["off"] < 1e-3 < found["deformed_gap"]["tilt"] < 0.01  # a / R = 0.01
    page = (tmp_path / "runs.html").read_text()
    assert page.count("<svg") == 3 and "not drawn" not in page and "does not" not in page
    assert all(words in page for words in ("A cylinder pressed on a block: Hertz", "all 14 checks hold", "agree within the bars"))
    assert not re.search(r'(src|href)="(?!#|data:)', page)
    largest = next(row for row in found["figures"] if row["kind"] == "largest p")
    assert largest["value"] == pytest.approx(5.8184e8, abs=2 * largest["bar"])  # Hertz: docs/benchmarks.md
    own, finer, _ = found["study"]
    # The error of the first is luck: what is told of it holds in the mean over where in its edge contact ends.
    assert (own["estimated"] / finer["estimated"]) ** finer["rate"] == pytest.approx(own["off"] / finer["off"]) and finer["rate"] > 0
    unknowns = [row["unknowns"] for row in found["study"]]
    assert unknowns == sorted(unknowns) and found["study"][0]["off"] > found["study"][1]["off"]


@pytest.mark.parametrize(
    "scene, run, change, kinds",
    [
        (PUNCH, "feti", "materials.steel.poisson=0.35", {"p along the lines"}),
        (HERTZ, "quadrilaterals", "materials.steel.young=200e9", {"largest p", "lengths in contact", "displacements"}),
        (RINGS, "other_side", "boundary.2.pressure=9.8e6", {"p along the lines", "contact forces"}),
        (PUNCH, "quadrilaterals", 'boundary.2.pressure="10e6 + 4e9 * exp(-((x - 0.3137) / 2e-4)^2)"', {"contact forces"}),
        (HERTZ, "feti", "contact.0.clearance=2e-6", {"displacements"}),  # the cylinder, which the load holds, sinks further
        (HERTZ, "finer_4", "model.plane=stress", {"p along the lines", "lengths in contact", "largest p"}),
    ],
)
def test_what_one_run_has_wrong_is_named(wrong, scene, run, change, kinds):
    named, found = wrong(scene, spoil={run: [change]})
    assert not found["agrees"] and kinds <= named.keys() and set(named.values()) == {run}


def test_finer_meshes_are_finer_where_the_first_is_fine_enough(wrong, tmp_path):
    (tmp_path / "blocks.geo").write_text(
        """SetFactory("OpenCASCADE"); Rectangle(1) = {0, -1, 0, 1, 1}; Rectangle(2) = {0, 0, 0, 1, 1};
        Physical Surface("A") = {1}; Physical Surface("B") = {2}; Physical Curve("ground") = {1}; Physical Curve("seat") = {3};
        Physical Curve("foot") = {5}; Physical Curve("head") = {7}; Physical Curve("left") = {4, 8};"""
    )
    scene = tmp_path / "blocks.toml"
    scene.write_text(
        """mesh.file = "blocks.geo"
        materials.a = { young = 1000, poisson = 0.3 }
        bodies."*" = "a"
        boundary = [{ on = "ground", displacement = { y = 0 } }, { on = "left", displacement = { x = 0 } }, { on = "head", pressure = 1 }]
        contact = [{ between = ["foot", "seat"] }]"""
    )
    for first in (20, 8):
        _, found = wrong(scene, [f"accuracy.first_edges={first}"])
        unknowns = {run["name"]: run["unknowns"] for run in found["runs"]}
        assert found["agrees"] and 1.3 * unknowns["own"] < unknowns["finer_4"] and 1.3 * unknowns["finer_4"] < unknowns["finer_16"]


def test_too_coarse_a_mesh_of_its_own(call, wrong, tmp_path):
    mesh, scene = tmp_path / "coarse.msh", tmp_path / "coarse.toml"
    call("mesh", PUNCH, *launch.options({"mesh.parameters.n_punch": 6, "mesh.parameters.n_block": 15}), "-o", mesh, "--quiet")
    text = PUNCH.read_text().replace("punch.geo", str(mesh))
    scene.write_text("\n".join(line for line in text.splitlines() if not line.startswith("parameters")))
    _, found = wrong(scene)
    assert not found["agrees"] and "only on the scene's own mesh, 1 % are asked" in found["troubles"][0]
    assert found["skipped"] == ["other meshes: the scene has a mesh of its own or copies, and no geometry to mesh anew"]


def test_a_multiplier_space_that_is_wrong_for_a_mesh_of_its_own(mortise, call, tmp_path):
    """Quadratic multipliers on the edges of a body a hundred times as stiff as the other: p swings, and its bar knows."""
    mesh, scene = tmp_path / "own.msh", tmp_path / "own.toml"
    call("mesh", HERTZ, "--set", "mesh.parameters={n_upper=10, n_lower=12}", "-o", mesh, "--quiet")
    text = HERTZ.read_text().replace("hertz.geo", str(mesh)).replace('block = "steel"', 'block = "hard"')
    lines = [line for line in text.splitlines() if not line.startswith("parameters")]
    scene.write_text("\n".join([*lines, "[materials.hard]", "young = 210e11", "poisson = 0.3"]))
    changes = lambda space: ["contact.0.multipliers_on=block_top", f"method.multipliers={space}"]
    wide = lambda space: certify.certify(mortise, scene, tmp_path / space, changes(space), accuracy=0.15, freefem=False)["troubles"]
    assert wide("linear") == [] and "p is within 41 % only on the scene's own mesh" in wide("quadratic")[0]


def test_a_run_that_knows_less_confirms_nothing(wrong):
    _, found = wrong(HERTZ, spoil={"feti": ["accuracy.value=0.3"]})
    assert found["agrees"] and re.fullmatch("feti: it knows p to .* % only, and confirms nothing", found["skipped"][0])


def test_multipliers_beyond_the_end_of_the_other_curve_are_no_gap(wrong):
    _, found = wrong(PUNCH, ["contact.0.multipliers_on=block_top"])
    assert found["agrees"] and found["deformed_gap"]["off"] < 0.01


def test_p_that_no_body_feels_is_seen(mortise, tmp_path):
    """Where it alone is larger, in the files."""
    launch.solve(HERTZ, {"accuracy.value": 0.002}, tmp_path / "own", expected=[0])
    base = certify.Variation("own", "", [], "solved", run=figures.read_run(tmp_path / "own"))
    kept = certify.by_stresses(base, 0.01)
    table = figures.rows_of(tmp_path / "own/contact.csv")
    with open(tmp_path / "own/contact.csv", "w") as file:
        writer = csv.DictWriter(file, table[0])
        writer.writeheader()
        writer.writerows(row | {"p": row["p"] and 1.03 * float(row["p"])} for row in table)
    off = certify.by_stresses(base, 0.01)
    assert kept["agrees"] and kept["off"] < 5e-3 and not off["agrees"] and off["off"] == pytest.approx(0.03 / 1.03, rel=0.05)
    assert "p is off by 2.8 % from the stresses of both bodies" in certify.troubles_of(base, [base], 0.01, True, None, off)[0]


def test_an_accuracy_that_is_not_reached(wrong):
    _, found = wrong(PUNCH, ["accuracy.unknowns_max=600"])
    assert not found["agrees"] and "accuracy_not_reached" in found["troubles"][0] and len(found["runs"]) == 1


def test_a_run_that_ends_without_an_answer_is_a_trouble(mortise, tmp_path):
    """What the program refuses is skipped, with its words."""
    program = tmp_path / "program"
    program.write_text(f'#!/bin/sh\ncase "$*" in *feti*) exit 3;; *other*|*multipliers_on*) echo "mortise: no" >&2; exit 1;; esac\nexec {mortise} "$@"\n')
    program.chmod(0o755)
    found = certify.certify(str(program), RINGS, tmp_path / "runs", freefem=False)
    status = {run["name"]: run["status"] for run in found["runs"]}
    assert status["feti"] == "failed" and status["other_side"] == "skipped" and not found["agrees"]
    assert found["troubles"] == ["feti: "] and found["skipped"] == ["other_side: no"]


@pytest.mark.parametrize("script, words", [("certify", [PUNCH]), ("report", [])])
def test_an_interrupt_is_no_traceback(mortise, tmp_path, script, words):
    """While the program runs, which is another here."""
    launch.solve(PUNCH, {}, tmp_path / "out", expected=[0])
    program = tmp_path / "program"
    program.write_text(f"#!/bin/sh\ntouch {tmp_path}/started\nexec sleep 60\n")
    program.chmod(0o755)
    # A shell that runs the tests in the background tells them to ignore SIGINT.
    command = [sys.executable, ROOT / f"src/python/reports/{script}.py", *(words or [tmp_path / "out"])]
    heard = {"preexec_fn": lambda: signal.signal(signal.SIGINT, signal.SIG_DFL), "start_new_session": True}
    running = subprocess.Popen(command, cwd=tmp_path, env=os.environ | {"MORTISE_PROGRAM": str(program)}, stderr=subprocess.PIPE, text=True, **heard)
    while not (tmp_path / "started").exists() and running.poll() is None:
        time.sleep(0.02)
    os.killpg(running.pid, signal.SIGINT)
    assert running.communicate(timeout=20)[1] == "" and running.returncode == -signal.SIGINT


def test_a_reader_who_leaves_has_the_page(mortise, tmp_path):
    command = [mortise, "certify", RINGS, "--no-freefem", "-o", tmp_path / "runs"]
    running = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    running.stdout.close()
    assert running.stderr.read() == "" and running.wait() == -signal.SIGPIPE and (tmp_path / "runs.html").is_file()


@pytest.mark.parametrize("words, said", [(["certify", "no.toml"], "mortise certify: error: no.toml: No such file or directory\n"),
                                         (["certify"], "the following arguments are required: scene"),
                                         (["certify", PUNCH, "--accuracy", "x"], "argument --accuracy: x: expected a part above 0 and below 1, such as 1%"),
                                         (["certify", PUNCH, "--accuracy", "0"], "argument --accuracy: 0: expected a part above 0 and below 1, such as 1%"),
                                         (["report", "no"], "no: no summary.json there"), (["report"], "required: folder")])  # fmt: skip
def test_bad_input_is_refused_as_by_solve(call, words, said):
    told = call(*words, expected=1)
    assert said in told and "Errno" not in told and "Traceback" not in told


def test_what_the_normals_of_the_other_curve_change_is_told_apart(mortise, tmp_path, monkeypatch):
    """a / R = 0.12: by 0.5 % of the largest u, on any mesh; with a quarter of the load, and so half of a, by less than half of that."""
    scene = ROOT / "geo/hertz_nafems.toml"
    monkeypatch.setattr(certify, "FINER", ())
    moved = []
    for number, load in enumerate(("350", "87.5")):
        output = tmp_path / str(number)
        found = certify.certify(mortise, scene, output, [f"boundary.2.pressure={load}"], accuracy=0.002, freefem=False)
        row = next(row for row in found["figures"] if row["kind"] == "displacements")
        moved.append(row["of_normals"] / figures.read_run(output / "own").summary["extremes"]["displacement"])
        assert found["agrees"] and row["of_normals"] > 2 * row["allowed"] and "which curve's normals" in certify.sentence(found)
    assert moved[0] == pytest.approx(4.9e-3, rel=0.1) and 0 < moved[1] < moved[0] / 2


def test_one_curve_has_one_normal(mortise, wrong):
    """What a pressure changes is no matter of normals where both curves are one."""
    named, found = wrong(RINGS, spoil={"other_side": ["boundary.2.pressure=9.9e6"]})
    assert named and figures.tilt(figures.read_run(Path(found["runs"][0]["command"][-1]))) < 1e-6


def test_freefem_is_compared_at_its_vertices(tmp_path, mortise):
    launch.solve(HERTZ, {}, tmp_path / "own", expected=[0])
    run = figures.read_run(tmp_path / "own")
    (xy, p, _), = run.multipliers.values()
    for factor, agrees in ((1, True), (1.2, False), (float("nan"), False)):
        rows = np.random.default_rng(5).permutation(np.column_stack([0 * p, xy, factor * p, 0 * p])[::2])
        np.savetxt(tmp_path / "freefem_contact.txt", rows)
        found, = figures.compare(run, figures.of_freefem(run, tmp_path / "freefem_contact.txt"))
        assert found.agrees == agrees and (factor != 1 or found.off < 1e-6 * found.value)


def test_a_report_of_a_coarse_mesh_is_not_green(mortise, tmp_path):
    """And its set-up is that of the run."""
    settings = {"mesh.parameters.n_punch": 6, "mesh.parameters.n_block": 8, "boundary.2.pressure": "2e7"}
    summary = launch.solve(PUNCH, settings, tmp_path / "out")
    assert summary["changes"] == [f"{key}={value}" for key, value in settings.items()]
    assert summary["estimate"]["pressure"]["error"] > report.COARSE
    page = report.page_of(tmp_path / "out", None, mortise)
    assert "no other run; <code>mortise certify</code>" in page and "only: the mesh is too coarse" in page and "class='verdict bad'" in page and "--set boundary.2.pressure=2e7" in page
    summary["estimate"]["pressure"]["error"], summary["status"] = 0.05, "solved"
    assert report.verdict(summary, None)[1]


def test_a_report_finds_its_scene_from_any_folder(tmp_path, monkeypatch):
    """By its name from where it was solved; another of that name where the report is asked for is not it."""
    (tmp_path / "job/out/own").mkdir(parents=True)
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    for folder, words in (("job", "solved"), ("elsewhere", "another")):
        (tmp_path / folder / "a.toml").write_text(words)
    for folder in ("job/out", "job/out/own"):
        assert report.scene_file(tmp_path / folder, "a.toml").read_text() == "solved"
    assert report.scene_file(Path("../job/out"), "a.toml").read_text() == "solved"
    assert report.scene_file(tmp_path / "job/out", str(tmp_path / "elsewhere/a.toml")).read_text() == "another"
    assert "cannot be read any more" in report.scene_text(report.scene_file(tmp_path / "job/out", "gone.toml"))


def test_deformed_sides_that_part_are_seen(mortise, tmp_path):
    """Where only one of them is moved on, in the files."""
    launch.solve(HERTZ, {"accuracy.value": 0.01}, tmp_path / "own", expected=[0])
    base = certify.Variation("own", "", [], "solved", run=figures.read_run(tmp_path / "own"))
    kept = certify.told_apart(base, 0.01)
    path = tmp_path / "own/contact.vtu"
    lines = meshio.vtu.read(path)
    first = [row["curve"] == "block_top" for row in figures.rows_of(tmp_path / "own/contact.csv")]
    lines.point_data["displacement"][first, 1] -= 0.05 * base.run.summary["extremes"]["displacement"]
    meshio.vtu.write(path, lines)
    moved = certify.told_apart(base, 0.01)
    assert kept["agrees"] and kept["off"] < 1e-3 and not moved["agrees"] and moved["off"] == pytest.approx(0.05, rel=0.02)
    assert "the deformed sides are apart by 0.05" in certify.troubles_of(base, [base], 0.01, True, moved, None)[0]


def test_a_fluid_between_the_sides_does_not_part_them(mortise, tmp_path):
    launch.solve(HERTZ, {}, tmp_path / "dry", expected=[0])
    rows = figures.rows_of(tmp_path / "dry/contact.csv")
    end = max((row for row in rows if row["curve"] == rows[0]["curve"]), key=lambda row: float(row["s"]))
    pressure = 1e-3 * max(float(row["p"]) for row in rows)  # more would lift the cylinder off
    fluid = {"contact.0.fluid.pressure": pressure, "contact.0.fluid.from": f"[{end['x']}, {end['y']}]"}
    launch.solve(HERTZ, fluid, tmp_path / "wet", expected=[0])
    base = certify.Variation("wet", "", [], "solved", run=figures.read_run(tmp_path / "wet"))
    assert base.run.summary["contact"][0]["fluid"]["wet_length"] > 0
    assert certify.told_apart(base, 0.05)["agrees"]


def test_what_is_expected_is_of_the_scene_as_it_is(wrong):
    kinds, found = wrong(PUNCH, ['expect=[{ figure = "contact.0.force.1", value = 2e6, tolerance = "1%" }]'])
    assert not kinds and found["agrees"], found["troubles"]


def test_places_on_a_curved_edge_are_not_apart_from_it():
    """However few pieces it would be drawn in: at 0.7 of a radius of 10 a chord of six is off by 2e-4."""
    draw = np.random.default_rng(3)
    for _ in range(20):
        nodes = [10 * np.array([np.cos(a), np.sin(a)]) for a in np.array([0, 0.07, 0.035]) + draw.uniform(0, 6)]
        nodes[2] = nodes[2] + draw.uniform(-0.02, 0.02, 2)
        xi, off = draw.uniform(-0.9, 0.9), draw.uniform(-0.01, 0.01)
        place = xi * (xi - 1) / 2 * nodes[0] + xi * (xi + 1) / 2 * nodes[1] + (1 - xi * xi) * nodes[2]
        tangent = (nodes[1] - nodes[0]) / 2 + xi * (nodes[0] + nodes[1] - 2 * nodes[2])
        x = place + off * np.array([-tangent[1], tangent[0]]) / np.linalg.norm(tangent)
        assert figures.distance_to_edge(nodes, xi + draw.uniform(-0.1, 0.1), x) == pytest.approx(abs(off), abs=1e-9)
        assert figures.distance_to_edge(nodes[:2], 0.0, (nodes[0] + nodes[1]) / 2) < 1e-12


def test_bodies_that_slid_beyond_an_end_are_not_apart(mortise, tmp_path):
    """A block held by nothing but friction, which there is none of, and by a wall that presses it along."""
    (tmp_path / "slide.geo").write_text("""SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 1, 1}; Rectangle(2) = {0, -1, 0, 1, 1};
Physical Surface("block") = {1}; Physical Surface("ground") = {2}; Physical Curve("foot") = {1}; Physical Curve("floor") = {7};
Physical Curve("side") = {4}; Physical Curve("top") = {3}; Physical Curve("base") = {5}; MeshSize{ : } = 0.25;
Mesh.ElementOrder = 2;""")
    (tmp_path / "slide.toml").write_text("""mesh.file = "slide.geo"
materials.one = { young = 1e5, poisson = 0.3 }
bodies = { block = "one", ground = "one" }
boundary = [{ on = "base", displacement = { x = 0, y = 0 } }, { on = "side", displacement = { x = 0.05 } }, { on = "top", pressure = 1 }]
contact = [{ between = ["foot", "floor"] }]
""")
    launch.solve(tmp_path / "slide.toml", {}, tmp_path / "out", expected=[0])
    run = figures.read_run(tmp_path / "out")
    assert figures.deformed_gaps(run) < 1e-4 * run.summary["extremes"]["displacement"]


def test_lines_of_chords():
    """A circle in n edges is off by (2 pi / n)^2 / 8 of its radius; straight lines and corners by nothing."""
    run = figures.Run(Path(), {}, lines={})
    for n in (12, 24, 48):
        angle = np.linspace(0, 2 * np.pi, n + 1)
        run.lines = {0: (np.column_stack([np.cos(angle), np.sin(angle)]), None, None)}
        assert abs(figures.of_chords(run) / ((2 * np.pi / n) ** 2 / 8) - 1) < 1e-9
    run.lines = {0: (np.array([[0.0, 0], [1, 0], [2, 0], [2, 1], [2, 2]]), None, None)}
    assert figures.of_chords(run) == 0


def run_with(figures_of, undetermined=(), method=("a",)):
    summary = {"method": {"multipliers_on": list(method)}, "extremes": {"displacement": 1.0}}
    return figures.Run(Path(), summary, {name: figures.Figure(*words) for name, words in figures_of.items()}, undetermined=set(undetermined))


def variation(name, run):
    return certify.Variation(name, "", [], "solved", run=run)


def test_a_displacement_that_is_undetermined_elsewhere_is_told_by_the_others():
    base = variation("own", run_with({"u_x": ("displacements", 1.0, 1e-3, 1.0)}))
    other, silent = variation("feti", base.run), variation("other_side", run_with({}, ["u_x"]))
    assert certify.untold_of(base, [other, silent]) == ({"u_x": ["other_side"]}, [])
    (row,) = certify.rows_of(base, [silent, other])
    assert row["agrees"] and row["run"] == "feti"
    assert certify.untold_of(base, [silent])[1] == ["u_x"] and certify.rows_of(base, [silent]) == []


def test_a_figure_that_another_run_does_not_have_is_the_one_named():
    words = ("largest p", 1.0, 1e-3, 1.0)
    base = variation("own", run_with({"first": words, "second": words}))
    for order in (["first"], ["second"]):
        (row,) = certify.rows_of(base, [variation("feti", run_with({name: words for name in order})), variation("direct", base.run)])
        assert not row["agrees"] and {row["figure"], *order} == {"first", "second"} and row["run"] == "feti"


def test_lengths_differ_by_what_the_meshes_of_a_curve_do():
    """All of a curve in contact, whose edges on two meshes are 1e-5 longer or shorter; half of it is another length."""
    length = lambda value, whole: run_with({"length": (figures.LENGTHS, value, 0.0, whole)})
    off = lambda one, other: [found.agrees for found in figures.compare(one, other)]
    assert off(length(1.0, 1.0), length(1.00001, 1.00001)) == [True]
    assert off(length(1.0, 1.0), length(0.5, 1.00001)) == [False]


@pytest.mark.skipif(not shutil.which("FreeFem++"), reason="FreeFem++ is not installed")
def test_freefem_is_skipped_where_it_is_not_told_all_of_a_contact(mortise, tmp_path):
    """A fluid, a clearance: with a part of the physics left out p would be another."""
    found = certify.certify(mortise, PUNCH, tmp_path / "runs", ["contact.0.clearance=1e-9"])
    assert found["agrees"] and any("FreeFEM is not told 'clearance'" in words for words in found["skipped"])
