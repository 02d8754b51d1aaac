"""mortise sweep by several processes and in parts: the rows of one process; killed, it goes on.

Usage: sweep_test.py MORTISE
"""

import csv
import json
import math
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

GEO = Path(__file__).resolve().parents[2] / "geo"
SCENE = GEO / "lift_off.toml"
PRESSURES = "1e6,1.01e6,1.02e6,1.03e6,1.04e6,-1e6x,1.06e6,1.07e6,1.08e6,1.09e6"  # the sixth is bad input


def command(mortise, *arguments):
    return [mortise, "sweep", SCENE, "--vary", f"boundary.2.pressure={PRESSURES}", *map(str, arguments)]


def sweep(mortise, *arguments, status=2):
    done = subprocess.run(command(mortise, *arguments), capture_output=True, text=True, timeout=120)
    assert done.returncode == status, (arguments, done.returncode, done.stderr)
    return done.stderr


def rows(path):
    """All but the seconds, which no two runs share."""
    with open(path, newline="") as file:
        table = list(csv.DictReader(file))
    return [{key: value for key, value in row.items() if not key.startswith("seconds.")} for row in table]


def same(table, other):
    """Bars to 1e-9: functionals that are alike to 1e-10 share their dual solutions with other runs on the same factor."""
    assert len(table) == len(other)
    for row, of_other in zip(table, other):
        assert row.keys() == of_other.keys()
        for key, value in row.items():
            bar = "error" in key and value not in ("", of_other[key])
            assert value == of_other[key] or bar and math.isclose(float(value), float(of_other[key]), rel_tol=1e-9), key
    return True


def test_jobs(mortise, folder, whole):
    sweep(mortise, "--jobs", 2, "-o", folder / "jobs.csv")
    assert same(rows(folder / "jobs.csv"), whole)
    sweep(mortise, "--jobs", 64, "-o", folder / "many.csv")
    assert same(rows(folder / "many.csv"), whole)


def test_parts(mortise, folder, whole):
    table = folder / "parts.csv"
    for part in (1, 2, 3):
        sweep(mortise, "--part", f"{part}/3", "-o", table, status=2 if part == 2 else 0)
    said = sweep(mortise, "--join", 4, "-o", table, status=1)
    assert "parts.1_of_4.csv, part 1 of 4: no such file; expected what --part 1/4 writes" in said, said
    sweep(mortise, "--join", 3, "-o", table)
    assert same(rows(table), whole)
    # The text of the whole: its rows one after the other, with the header of the first part that has figures.
    texts = [(folder / f"parts.{part}_of_3.csv").read_text().splitlines() for part in (1, 2, 3)]
    assert table.read_text().splitlines() == texts[0] + texts[1][1:] + texts[2][1:]
    # A part that is not complete, and one of another sweep.
    second = folder / "parts.2_of_3.csv"
    lines = second.read_text().splitlines(keepends=True)
    second.write_text("".join(lines[:-1]))
    said = sweep(mortise, "--join", 3, "-o", table, status=1)
    assert "part 2 of 3: 3 of its 4 runs are complete; start it again" in said, said
    second.write_text("".join(lines).replace("1.04e6", "1.5e6"))
    said = sweep(mortise, "--join", 3, "-o", table, status=1)
    assert "is of another sweep" in said, said
    second.write_bytes("".join(lines).encode().replace(b"solved", b"sol\xffed", 1))
    said = sweep(mortise, "--join", 3, "-o", table, status=1)
    assert "part 2 of 3: is damaged: it holds 'sol" in said, said
    assert same(rows(table), whole), "an error leaves the table standing"


def test_more_parts_than_runs(mortise, folder, whole):
    for part in range(1, 8):
        subprocess.run(command(mortise, "--part", f"{part}/7", "-o", folder / "few.csv", "--quiet"), check=False)
    sweep(mortise, "--join", 7, "-o", folder / "few.csv")
    assert same(rows(folder / "few.csv"), whole)


def kill_after(running, journal, groups):
    """Whether it was killed before it was done."""
    limit = time.monotonic() + 60
    while running.poll() is None and time.monotonic() < limit:
        if journal.exists() and len(journal.read_text().splitlines()) > groups:
            break
        time.sleep(0.002)
    running.send_signal(signal.SIGKILL)
    return running.wait() == -signal.SIGKILL


def test_what_is_kept_hangs_on_the_geometry(mortise, folder):
    shutil.copytree(GEO, folder / "geo")
    words = [mortise, "sweep", folder / "geo/lift_off.toml", "--vary", "boundary.2.pressure=" + ",".join(f"{1 + k / 100}e6" for k in range(40)), "-o", folder / "kept.csv"]
    for changed in (False, True):
        if not kill_after(subprocess.Popen(words, stderr=subprocess.DEVNULL), folder / ".kept.csv.runs", 2):
            return  # a machine that is too quick
        if changed:
            os.utime(folder / "geo/lift_off.geo", (1, 1))
        said = subprocess.run(words, capture_output=True, text=True, timeout=120).stderr
        assert ("(kept)" in said) != changed, said


def test_killed(mortise, folder, whole, jobs):
    table = folder / f"killed_{jobs}.csv"
    journal = folder / f".killed_{jobs}.csv.runs"
    running = subprocess.Popen(command(mortise, "--jobs", jobs, "-o", table), stderr=subprocess.DEVNULL)
    killed = kill_after(running, journal, 2)
    # A figure of it that has changed since: its group is run again.
    lines = journal.read_text().splitlines(keepends=True) if killed else []
    if killed:
        journal.write_text("".join([lines[0], lines[1].replace("1", "7", 1) if "1" in lines[1] else "7" + lines[1], *lines[2:]]))
    kept = sum(len(json.loads(line.split(" ", 1)[1])["rows"]) for line in lines[2:])
    said = sweep(mortise, "--jobs", jobs, "-o", table)
    assert not killed or said.count("(kept)") == kept, said
    assert same(rows(table), whole)
    assert not journal.exists()
    said = sweep(mortise, "-o", table)
    assert "(kept)" not in said, "what is complete is run anew"


def test_a_process_that_ends(mortise, folder):
    """Its own line, then one that says how to go on; no worker is left."""
    running = subprocess.Popen(command(mortise, "--jobs", 2, "-o", folder / "ended.csv"), stderr=subprocess.PIPE, text=True)
    workers = []
    while running.poll() is None and not workers:
        children = Path(f"/proc/{running.pid}/task/{running.pid}/children").read_text().split()
        workers = [int(child) for child in children]
    os.kill(workers[0], signal.SIGKILL)
    said = running.communicate(timeout=60)[1]
    assert running.returncode == 1 and "the same command goes on" in said, said
    assert not any(Path(f"/proc/{worker}").exists() for worker in workers)


def test_words(mortise, folder):
    for part in ("0/2", "3/2", "1", "1/x", "1/2/3", "/"):
        said = sweep(mortise, "--part", part, "-o", folder / "no.csv", status=1)
        assert f"--part '{part}': expected K/N" in said, said
    sweep(mortise, "--part", "1/2", "--join", 2, status=1)
    sweep(mortise, "--jobs", 0, status=1)
    many = "materials.steel.young=" + ",".join(map(str, range(1, 10001)))
    said = sweep(mortise, "--vary", many, "--vary", many.replace("young", "poisson"), "-o", folder / "no.csv", status=1)
    assert "combine to more than 100000 runs" in said, said
    assert not list(folder.glob(".*.mortise.csv")), "nothing is left of those that were killed"


def run(mortise, *words, status=0):
    done = subprocess.run([mortise, "sweep", *map(str, words)], capture_output=True, text=True, timeout=120)
    assert done.returncode == status and (status != 1 or done.stderr.count("\n") == 1), (words, done.returncode, done.stderr)
    return done.stderr


def test_a_row_a_run(mortise, folder):
    """Combinations, the last key fastest; of a load each run starts from the one before."""
    vary = ["--vary", "mesh.parameters.n_upper=3,4,5", "--vary", "contact.multipliers_on=upper_contact,lower_contact"]
    said = run(mortise, GEO / "patch_flat.toml", *vary, "-o", folder / "six.csv")
    assert said.startswith("1/6 mesh.parameters.n_upper=3 contact.multipliers_on=upper_contact: solved\n"), said
    table = rows(folder / "six.csv")
    assert list(table[0])[:4] == ["mesh.parameters.n_upper", "contact.multipliers_on", "status", "nodes"]
    assert [row["mesh.parameters.n_upper"] for row in table] == ["3", "3", "4", "4", "5", "5"]
    assert {row["status"] for row in table} == {"solved"}
    steps = {}
    for name, values in (("four", "1e6,1.01e6,1.02e6,1.03e6"), ("one", "1.03e6")):
        run(mortise, SCENE, "--vary", f"boundary.2.pressure={values}", "-o", folder / f"{name}.csv", "--quiet")
        steps[name] = [int(row["iterations.contact"]) for row in rows(folder / f"{name}.csv")]
    assert steps["four"][3] < steps["one"][0] and sum(steps["four"][1:]) < 3 * steps["one"][0], steps


def test_what_is_not_its_own_stays(mortise, folder):
    own = folder / "own"
    shutil.copytree(GEO, own)
    scene, vary = own / "patch_flat.toml", ["--vary", "mesh.parameters.n_upper=3"]
    (own / "link.csv").symlink_to(scene)
    (own / "loop.csv").symlink_to("loop.csv")
    (own / "mine.csv").write_text("a,b\n1,2\n")
    before = {path: path.read_bytes() for path in own.rglob("*") if path.is_file()}
    for target, why in [("patch_flat.toml", "it is the input"), ("link.csv", "it is the input"), ("common", "it is a folder"),
                        ("patch_flat.geo", "mortise did not write"), ("mine.csv", "mortise did not write"), ("loop.csv", "loop.csv"),
                        ("/dev/null", "it is a device"), ("/proc/no/such.csv", "/proc/no")]:  # fmt: skip
        assert why in run(mortise, scene, *vary, "-o", own / target, status=1), target
    for _ in range(2):
        run(mortise, scene, *vary, "-o", own / "s.csv")
    assert {path: path.read_bytes() for path in before} == before
    (own / "patch_flat.geo").write_text(f'SystemCall "touch {own}/proof";\n' + (own / "patch_flat.geo").read_text())
    assert "it runs a program" in run(mortise, scene, *vary, "--no-programs", "-o", own / "s.csv", status=2)
    assert not (own / "proof").exists()


def test_command_lines_that_are_refused(mortise, folder):
    for words, why in [((SCENE,), "required: --vary"), ((SCENE, "--vary", "x=1", "--job", 2), "unrecognized arguments: --job"),
                       ((SCENE, "--vary", "x=1", "-o", ""), "expected a path, found an empty text"),
                       ((SCENE, "--vary", "x=1", "--jobs", "x"), "expected a whole number from 1 to 1024, found 'x'"),
                       ((SCENE, "--vary", b"x=\xff".decode(errors="surrogateescape")), "expected UTF-8"),
                       ((SCENE, "--vary", "x=1", "--set", "y", "--jobs", 2), "--set 'y': expected KEY=VALUE")]:  # fmt: skip
        words = [os.fsencode(str(word)) for word in (*words, *(() if "-o" in words else ("-o", folder / "no.csv")))]
        done = subprocess.run([mortise, "sweep", *words], capture_output=True, timeout=60)
        assert done.returncode == 1 and why in done.stderr.decode() and done.stderr.count(b"\n") == 1, (words, done)
    assert not (folder / "no.csv").exists()


def test_a_scene_or_a_key_that_no_run_can_be_read_with(mortise, folder):
    """One error, before anything runs or is written."""
    cases = folder / "cases.toml"
    cases.write_text((GEO / "lift_off.toml").read_text().replace("lift_off.geo", str(GEO / "lift_off.geo")) + "\n[[case]]\nscale = [1, 2]\n")
    for scene, vary, why in [("no.toml", ["x=1"], "no.toml: no such file"), (cases, ["boundary.2.pressure=1,2"], "the scene has cases of its own"),
                             (SCENE, ["boundary.2.pressure=1,2", "boundary.2.pressure=3,4"], "--vary boundary.2.pressure: given 2 times; expected one list"),
                             (SCENE, ["boundary.2.presure=1,2,3,4,5"], "unknown key 'presure'; did you mean 'pressure'"),
                             (SCENE, ["boundary.2.pressure=1,2", "model.plan=strain"], "unknown key 'plan'; did you mean 'plane'")]:  # fmt: skip
        assert why in run(mortise, scene, *(f"--vary={text}" for text in vary), "-o", folder / "none/no.csv", status=1), vary
    assert not (folder / "none").exists()


def test_brackets_and_quotes_hold_a_value_together(mortise, folder):
    for text, values in [("model.gravity=[0,-1],[0,-2]", ["[0,-1]", "[0,-2]"]), ('title="a,b",c', ['"a,b"', "c"]),
                         ("boundary.2.pressure=1e6*(1+0*atan2(x,y)),1e6", ["1e6*(1+0*atan2(x,y))", "1e6"])]:  # fmt: skip
        run(mortise, SCENE, "--vary", text, "--set", "materials.steel.density=1", "-o", folder / "held.csv", "--quiet")
        with open(folder / "held.csv", newline="") as file:
            assert [row[0] for row in list(csv.reader(file))[1:]] == values
    assert "expected ] before the end" in run(mortise, SCENE, "--vary", "model.gravity=[0,-1", status=1)


def test_fields_are_those_of_other_tables(mortise, folder):
    """Quotes, and an apostrophe before what a spreadsheet would take for a formula."""
    run(mortise, SCENE, "--vary", "title==1+1,-5,say \"x\"; y", "-o", folder / "words.csv", "--quiet", status=2)
    text = (folder / "words.csv").read_text().splitlines()
    assert [line.split(",")[0] for line in text[1:]] == ['"\'=1+1"', "-5", '"say ""x""; y"'], text


def main(mortise):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.environ["XDG_CACHE_HOME"] = name
        sweep(mortise, "-o", folder / "whole.csv")
        whole = rows(folder / "whole.csv")
        assert [row["status"][:9] for row in whole] == ["solved"] * 5 + ["bad input"] + ["solved"] * 4, whole
        test_jobs(mortise, folder, whole)
        test_parts(mortise, folder, whole)
        test_more_parts_than_runs(mortise, folder, whole)
        for jobs in (1, 2):
            test_killed(mortise, folder, whole, jobs)
        test_a_process_that_ends(mortise, folder)
        test_words(mortise, folder)
        test_what_is_kept_hangs_on_the_geometry(mortise, folder)
        test_a_row_a_run(mortise, folder)
        test_what_is_not_its_own_stays(mortise, folder)
        test_command_lines_that_are_refused(mortise, folder)
        test_a_scene_or_a_key_that_no_run_can_be_read_with(mortise, folder)
        test_brackets_and_quotes_hold_a_value_together(mortise, folder)
        test_fields_are_those_of_other_tables(mortise, folder)


if __name__ == "__main__":
    main(sys.argv[1])
