"""The fuzzer: that each oracle fails on a wrong program, that a case can be made again, and some cases."""

import itertools
import os
import re
import shutil
import stat
import subprocess
import sys
from random import Random

import meshio
import pytest

import command_cases
import deck_files
import fuzz
import geo_cases
import msh_file
import one_call
import oracles
import results_files
import twins
from fuzz_case import REFUSED, SOLVED, Twin, solve_case
from make_case import MAKERS, make_case

SEED = "pytest"

# A program that runs mortise and then does the lines of a test; `status` is how it ends, `said` its standard error.
WRONG = """#!{python}
import os, pathlib, re, subprocess, sys, time
done = subprocess.run([{mortise!r}, *sys.argv[1:]], capture_output=True, text=True)
status, said, results = done.returncode, done.stderr, pathlib.Path("results")
def change(name, what, by):
    text = (results / name).read_text()
    assert re.search(what, text), (what, text)
    (results / name).write_text(re.sub(what, by, text, count=1))
{lines}
sys.stderr.write(said)
sys.exit(status)
"""
# An oracle, and lines that it must object to where mortise itself is right.
WRONGS = [
    ("crash", "os.kill(os.getpid(), 11)"),
    ("crash", "said, status = 'AddressSanitizer: heap-use-after-free', 99"),
    ("hang", "time.sleep(60)"),
    ("internal_error", "status = 3"),
    ("one_line", "said, status = 'mortise: error: scene.toml: one\\nmortise: error: scene.toml: two\\n', 1"),
    ("one_line", "said, status = '', 1"),
    ("one_line", "said, status = 'mortise: error: scene.toml: \\x1b[31mred\\n', 1"),
    ("one_line", "said, status = 'mortise: error: scene.toml: ' + 'a' * 3000 + '\\n', 1"),
    ("place", "said, status = 'mortise: error: something is wrong\\n', 1"),
    ("terminal", "print('\\x1b[2J')"),
    ("files", "open('scene.toml', 'a').write('# changed')"),
    ("files", "os.replace('mesh.msh', 'results/mesh.msh')"),
    ("files", "open('results.part', 'w')"),
    ("files", "said, status = 'mortise: error: scene.toml: wrong\\n', 1"),
    ("verdict", "status, said = 2, 'mortise: scene.toml: check_failed\\n'"),
    ("verdict", "status = 2"),
    ("verdict", "os.remove('results/summary.json')"),
    ("verdict", "change('summary.json', '\"ok\": true', '\"ok\": false')"),
    ("finite", "change('summary.json', '\"energy\": [^,]*', '\"energy\": null')"),
    ("finite", "change('contact.csv', r'(\\nn?0,\\w+,)[^,]*,', r'\\1nan,')"),
    ("finite", "change('contact_centres.csv', ',[^,]*\\n$', ',\\n')"),
    ("finite", "f = results / 'result.vtu'; b = bytearray(f.read_bytes()); n = b.index(b'_', b.index(b'raw')) + 9;"
               " b[n:n + 8] = b'\\0' * 6 + b'\\xf8\\x7f'; f.write_bytes(b)"),
    ("formulas", "change('contact.csv', 'upper_bottom', '=1+1')"),
    ("force", "change('summary.json', r'\"force\": \\[\\s*[^,]*,\\s*[^,\\]]*', '\"force\": [0.0, 1.1e7')"),
]


@pytest.fixture(scope="module")
def mortise(mortise):
    return one_call.Program(str(mortise))


@pytest.fixture
def wrong_program(mortise, tmp_path):
    def make(lines):
        path = tmp_path / "wrong_mortise"
        path.write_text(WRONG.format(python=sys.executable, mortise=mortise.path, lines=lines))
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return one_call.Program(str(path), time_limit=20 if "sleep" not in lines else 1)

    return make


def right_case():
    """Two plates under pressure, which mortise solves: the contact carries 1e7."""
    setting = command_cases.simple_setting(Random(1))
    return solve_case("valid scene", "two plates", *twins.files_of(setting), thrust=setting.thrust, expect=SOLVED,
                      setting=setting)


def objections(program, case):
    return [oracle for oracle, _ in fuzz.examine(program, case)[1]]


def test_nothing_is_found_where_all_is_right(mortise):
    assert objections(mortise, right_case()) == []


@pytest.mark.parametrize("oracle,lines", WRONGS)
def test_each_oracle_objects_to_a_wrong_program(wrong_program, oracle, lines):
    assert oracle in objections(wrong_program(lines), right_case())


def test_every_oracle_is_tested():
    assert {oracle for oracle, _ in WRONGS} | {"expectation"} == {oracle.__name__ for oracle in oracles.ORACLES}


def test_a_refusal_of_what_is_right_is_found(wrong_program):
    lines = "said, status = 'mortise: error: scene.toml: wrong\\n', 1; import shutil; shutil.rmtree('results')"
    assert objections(wrong_program(lines), right_case()) == ["expectation"]


def test_an_answer_to_what_is_wrong_is_found(mortise):
    case = right_case()
    case.expect = REFUSED
    assert objections(mortise, case) == ["expectation"]


def test_a_pressure_that_hangs_on_the_place_is_found_by_a_twin(mortise, wrong_program):
    """mortise's is the same 100 m away; that of a program that multiplies the multiplier by the first x is not."""
    case, setting = right_case(), command_cases.simple_setting(Random(1))
    setting.mesh.nodes = [(x + 100, y) for x, y in setting.mesh.nodes]
    case.twins = [Twin("elsewhere", twins.case_of(setting, "elsewhere"), back=lambda x, y: (x - 100, y))]
    assert objections(mortise, case) == []
    by_place = """
rows = [row.split(",") for row in (results / "contact.csv").read_text().splitlines()]
for row in rows[1:]:
    row[-1] = repr(float(row[-1]) * (1 + float(rows[1][3])))
(results / "contact.csv").write_text("\\n".join(",".join(row) for row in rows) + "\\n")
"""
    assert objections(wrong_program(by_place), case) == ["twin"]


def test_a_difference_below_round_off_is_no_difference_of_pressure(mortise, tmp_path):
    """A twin that may not differ at all: half of the least pressure more is right, twice that pressure more is not."""
    case = right_case()
    twin = Twin("the same", case, limit=0)
    case.write(tmp_path)
    outcome = one_call.call(mortise, case, tmp_path)
    least = oracles.least_pressure(tmp_path / "results", case.setting)
    table = (tmp_path / "results/contact.csv").read_text()
    row = results_files.rows(tmp_path / "results/contact.csv")[0]
    p = row.get("p_multiplier", row["p"])
    for share, found in ((0.5, False), (2, True)):
        shutil.copytree(tmp_path / "results", tmp_path / f"{share}/results")
        changed = re.sub(rf"(?<![\d.]){re.escape(p)}(?![\d.e])", repr(float(p) + share * least), table)  # that number, whole
        assert changed != table
        (tmp_path / f"{share}/results/contact.csv").write_text(changed)
        wrong = oracles.compare(case.setting, twin, outcome, outcome, tmp_path, tmp_path / str(share))
        assert (wrong is not None) == found


@pytest.mark.parametrize("kind,random_seed", itertools.product(msh_file.KINDS, range(4)))
def test_all_kinds_of_mesh_files_are_right(mortise, kind, random_seed, tmp_path):
    """meshio reads the same nodes and cells from each, and mortise solves on it."""
    setting = command_cases.simple_setting(Random(random_seed))
    scene, mesh = twins.files_of(setting, kind)
    (tmp_path / "mesh.msh").write_bytes(mesh)
    read = meshio.read(tmp_path / "mesh.msh")
    assert [tuple(point) for point in read.points[:, :2]] == setting.mesh.nodes
    assert sum(len(block.data) for block in read.cells) == len(setting.mesh.cells) + len(setting.mesh.edges)
    assert objections(mortise, solve_case("mesh file", kind, scene, mesh, expect=SOLVED, thrust=setting.thrust)) == []


@pytest.mark.parametrize("kind,random_seed", itertools.product(deck_files.WRITERS, range(8)))
def test_decks_of_other_programs_are_right(mortise, kind, random_seed):
    setting = command_cases.simple_setting(Random(random_seed))
    if not twins.fits_decks(setting):
        pytest.skip("cells of nine nodes, which decks do not have")
    setting.scene["mesh"]["file"] = "mesh" + kind
    files = twins.files_of(setting, kind)
    assert objections(mortise, solve_case("mesh file", kind, *files, mesh_file="mesh" + kind, expect=SOLVED,
                                          thrust=setting.thrust)) == []  # fmt: skip


def test_the_geometry_is_right(mortise):
    case = geo_cases.geo_case("two plates", geo_cases.PLATES, SOLVED)
    assert case.thrust == 1e7 and objections(mortise, case) == []


def test_a_case_is_the_same_again():
    first, second = ([make_case(SEED, number) for number in range(100)] for _ in range(2))
    assert [(case.kind, case.what, case.words, case.files) for case in first] == [
        (case.kind, case.what, case.words, case.files) for case in second]  # fmt: skip
    assert {case.kind for case in first} == set(MAKERS)


def test_a_finding_can_be_repeated(wrong_program, tmp_path):
    program, case = wrong_program("status = 3"), right_case()
    outcome, found = fuzz.examine(program, case)
    fuzz.store(tmp_path / "finding", "1:1", program, case, outcome, found)
    rest = {key: value for key, value in os.environ.items() if key != "MORTISE"}
    done = subprocess.run([tmp_path / "finding/repeat.sh"], capture_output=True, text=True, check=False, env=rest)
    assert done.stdout.endswith("exit status 3\n")
    assert "internal_error: exit status 3" in (tmp_path / "finding/finding.txt").read_text()


def test_words_survive_the_shell():
    for word in (*command_cases.STRANGE_NAMES[:3], *command_cases.STRANGE_NAMES[4:], "it's", '"', "$HOME", "a\\b"):
        done = subprocess.run(["bash", "-c", f"printf %s {fuzz.shell_word(word)}"], capture_output=True, check=True)
        assert done.stdout == word.encode("utf-8", "surrogateescape")


def test_fifty_cases(mortise, tmp_path):
    done = fuzz.fuzz(mortise, 50, SEED, out=tmp_path)
    assert [result[3] for result in done if result[3]] == []


def test_a_bearing_whose_gaps_motions_alone_close_ends(mortise, tmp_path):
    """By the dual method, which has no pressure then that residuals could be compared with: drawn as the 50th of 912."""
    done = fuzz.fuzz(mortise, 1, "912", first=50, kinds=["assembly"], out=tmp_path)
    assert [result[3] for result in done] == [[]]
