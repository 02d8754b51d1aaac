#!/usr/bin/python3
"""Solves a scene to an accuracy and again by what does not share its errors: another mesh family, the multipliers on the
other side, another solver, two finer meshes, FreeFEM on the same mesh. Says of each figure its value, its bar, how far the other runs are off, and
whether all of them agree within their bars.

Each run is a `mortise solve` with a few --set, and its results stay in a folder: what certificate.json and the report list
can be run again by hand. Exit status: 0 all figures agree; 1 bad input; 2 one does not, or the scene's own run fails.
"""

import argparse
import json
import math
import os
import shutil
import subprocess
import sys
import time
import tomllib
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from pathlib import Path

try:
    from figures import compare, deformed_gaps, line_difference, middles, of_freefem, read_run, stress_difference, tilt
    from report import percent, write_report
    from script import Parser, run
except ImportError as missing:
    raise SystemExit(f"certify.py: {missing}: apt-get install python3-numpy python3-meshio") from missing

FINER = (4, 16)  # times as accurate: the meshes of the study
RECOVERED = 0.01  # what recovered stresses may be off from p besides
FIRST_EDGES, MOST_FIRST_EDGES = 20, 1000  # of accuracy.first_edges: where the scene says nothing, and at most
WEAK = 3  # times what was asked: a run whose bar of p is wider confirms nothing
FREEFEM = Path(__file__).resolve().parents[3] / "verification/crosscheck/on_mesh.py"


@dataclass
class Variation:
    """One more run: its folder's name, what it does not share with the scene's own, and its --set."""

    name: str
    what: str
    changes: list
    status: str = ""  # of summary.json, or "skipped"
    seconds: float = 0
    words: str = ""  # of the program, where it is not solved
    command: list = field(default_factory=list)
    run: object = None
    finer: int = 1  # times as accurate as what was asked

    @property
    def counts(self):
        return self.run is not None and self.status in ("solved", "accuracy_not_reached")

    def weaker_than(self, asked):
        told = self.counts and (self.run.summary["estimate"] or {}).get("pressure")
        return bool(told) and not told["error"] <= WEAK * asked


def solve(mortise, scene, changes, variation, folder):
    """Runs a variation and reads its results; what the program refuses is skipped."""
    words = [word for change in [*changes, *variation.changes] for word in ("--set", change)]
    variation.command = ["mortise", "solve", str(scene), *words, "-o", str(folder)]
    start = time.perf_counter()
    ended = subprocess.run([mortise, *variation.command[1:], "--quiet"], capture_output=True, text=True)
    variation.seconds = time.perf_counter() - start
    variation.words = ended.stderr.strip().removeprefix("mortise: ")
    if ended.returncode in (0, 2):
        variation.run = read_run(folder)
        variation.status = variation.run.summary["status"]
    else:
        variation.status = "skipped" if ended.returncode == 1 else "failed"
    return variation


def toml(value):
    """As TOML writes it, tables inline."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key)} = {toml(item)}" for key, item in value.items()) + "}"
    return "[" + ", ".join(map(toml, value)) + "]" if isinstance(value, list) else json.dumps(value, ensure_ascii=False)


def with_probes(tables, run):
    """A --set that adds probes in the middles of bodies, and where the largest von Mises stress is if it has a limit there."""
    largest = run.summary["extremes"]["von_mises"]
    if not largest["limit"]:
        run.left_out.append("largest von Mises stress: it has no limit where it stands")
    at = [{"at": largest["position"], "body": largest["body"]}] if largest["limit"] and largest["value"] > 0 else []
    return ["probe=" + toml([*tables.get("probe", []), *({"at": place} for place in middles(run)), *at])]


def other_sides(tables, summary):
    """A --set for each contact entry whose other side can be named, and carries no multipliers yet."""
    on = set(summary["method"]["multipliers_on"])
    for k, entry in enumerate(tables.get("contact", [])):
        first, second = entry["between"]
        if first != second and entry.get("condition") not in ("tied", "cyclic"):
            taken = any(fnmatchcase(curve, first) for curve in on)
            yield f"contact.{k}.multipliers_on={json.dumps(second if taken else first)}"


def variations_of(tables, summary, accuracy):
    """What else to run, as far as the scene allows it, and what is skipped and why."""
    runs, skipped = [], []
    if accuracy is None:
        skipped.append("other meshes: the scene has a mesh of its own or copies, and no geometry to mesh anew")
    else:
        family = tables.get("accuracy", {}).get("recombine", False)
        other = json.dumps(not family)
        runs.append(Variation("triangles" if family else "quadrilaterals", "mesh family", [f"accuracy.recombine={other}"]))
        runs += [Variation(f"finer_{k}", f"asked {k} times the accuracy", [f"accuracy.value={accuracy / k:.3g}"], finer=k) for k in FINER]
    if sides := list(other_sides(tables, summary)):
        runs.append(Variation("other_side", "multipliers on the other side", sides))
    elif summary["contact"]:
        skipped.append("the other side: both curves have one pattern")
    if not summary["contact"]:
        skipped.append("another solver: there is no contact that one could solve for")
    else:
        solver = "feti" if summary["method"]["solver"] == "direct" else "direct"
        runs.append(Variation(solver, "solver", [f"method.solver={json.dumps(solver)}"]))
    return runs, skipped


def shorter_first_edges(tables, changes, finer):
    """A --set that halves the edges of the first mesh for each four times as much accuracy."""
    said = [change.partition("=")[2] for change in changes if change.startswith("accuracy.first_edges=")]
    first = float(said[-1]) if said else tables.get("accuracy", {}).get("first_edges", FIRST_EDGES)
    return f"accuracy.first_edges={min(MOST_FIRST_EDGES, round(first * math.sqrt(finer)))}"


def by_freefem(base, mortise, output):
    """p by FreeFEM on the mesh of the scene's own run; in words, why there is none."""
    name = "FreeFEM on the same mesh"
    if not shutil.which("FreeFem++"):
        return None, f"{name}: FreeFem++ is not installed"
    if not FREEFEM.is_file():
        return None, f"{name}: the scripts that write its case are in the source tree only (verification/crosscheck)"
    if not base.run.lines:
        return None, f"{name}: nothing is pressed"
    folder, words = output / "freefem", base.command[2 : base.command.index("-o")]
    folder.mkdir(parents=True, exist_ok=True)
    found = Variation("freefem", "another program on the same mesh", [])
    curves = ",".join(base.run.summary["method"]["multipliers_on"])
    changes = [word for word in words[1:] if word != "--set"]
    found.command = ["on_mesh.py", words[0], str(folder / "mesh.msh"), str(folder), curves, *changes]
    start = time.perf_counter()
    for command in [mortise, "mesh", *words, "-o", folder / "mesh.msh", "--quiet"], [sys.executable, FREEFEM, *found.command[1:]]:
        ended = subprocess.run(command, capture_output=True, text=True, env=os.environ | {"MORTISE": mortise})
        if ended.returncode:
            return None, f"{name}: {(ended.stderr.strip() or 'no answer').splitlines()[-1]}"
    found.seconds, found.status = time.perf_counter() - start, "solved"
    found.run = of_freefem(base.run, folder / "freefem_contact.txt")
    return found, ""


# ---- The verdict ----


def untold_of(base, runs):
    """Of displacements that are undetermined in some runs, in which: these confirm nothing. And those which no run confirms."""
    left = {}
    for variation in runs:
        for name in sorted(variation.run.undetermined & (base.run.figures or {}).keys()):
            left.setdefault(name, []).append(variation.name)
    every = [v for v in runs if v.run.figures is not None]
    return left, [name for name, by in left.items() if len(by) == len(every)]


def rows_of(base, runs):
    """One row a kind of figures: the one that is nearest to its limit, of all runs."""
    rows = {}
    for variation in runs:
        for found in compare(base.run, variation.run):
            row = rows.setdefault(found.kind, {"kind": found.kind, "count": set(), "agrees": True, "of_normals": 0, "worst": -1.0})
            row["count"].add(found.name)
            part = found.off / found.allowed if found.allowed > 0 else float(found.off > 0)
            part = math.inf if math.isnan(found.off) else part  # the other run does not have it
            if found.agrees and not found.by_bars:  # told by itself: no bar of a mesh is to hold it
                row["of_normals"], part = max(row["of_normals"], found.off), 0.0
            if part > row["worst"]:
                row |= {"figure": found.name, "value": found.value, "bar": found.bar, "off": found.off, "allowed": found.allowed}
                row |= {"worst": part, "run": variation.name}
            row["agrees"] = row["agrees"] and found.agrees
    for row in rows.values():
        row["count"] = len(row["count"])
    return list(rows.values())


def told_apart(base, asked):
    """How far the deformed sides are apart where p acts, as a part of the largest displacement: of what small displacements
    leave out, the angle between the curves' normals squared, besides what was asked."""
    gap = deformed_gaps(base.run) if base.run.lines else None
    if gap is None:
        return None
    angle = tilt(base.run)
    off = gap / base.run.summary["extremes"]["displacement"]
    return {"off": off, "allowed": asked + angle**2, "tilt": angle, "agrees": off <= asked + angle**2}


def by_stresses(base, asked):
    """How far p is off from the stresses that the bodies have where it acts; they are known to some 1 % besides."""
    off = stress_difference(base.run) if base.run.lines else None
    return None if off is None else {"off": off, "allowed": asked + RECOVERED, "agrees": off <= asked + RECOVERED}


def study_of(base, runs):
    """The meshes of the study: how far p is from the finest one's, and as which power of the estimate that falls (1, if the estimate
    is right: on graded meshes the size of the elements says little)."""
    finer = [variation for variation in runs if variation.name.startswith("finer_")]
    meshes = [base, *finer]
    if not finer or not base.run.lines:
        return []
    finest, rows = meshes[-1].run, []
    for variation in meshes:
        off = line_difference(variation.run, finest) if variation.run is not finest else None
        size = variation.run.summary["mesh"]["dofs"]
        told = variation.run.summary["estimate"]["pressure"]["error"]
        rows.append({"run": variation.name, "unknowns": size, "estimated": told, "off": off, "rate": None})
    for coarse, fine in zip(rows, rows[1:-1]):  # the finest has no error to compare
        if coarse["off"] > 0 and fine["off"] > 0 and coarse["estimated"] > fine["estimated"] > 0:
            fine["rate"] = math.log(coarse["off"] / fine["off"]) / math.log(coarse["estimated"] / fine["estimated"])
    return rows


def troubles_of(base, runs, asked, geometry, gap, stress):
    """What keeps the certificate from being one, besides figures that do not agree."""
    if base.status != "solved":
        return [f"its own run: {base.words}"]
    troubles = [f"{v.name}: {v.words}" for v in runs if not v.counts and v.status != "skipped"]
    told = (base.run.summary["estimate"] or {}).get("pressure")
    if not geometry and told and told["error"] > asked:
        troubles.append(f"p is within {percent(told['error'])} only on the scene's own mesh, {100 * asked:g} % are asked")
    if gap and not gap["agrees"]:
        troubles.append(f"the deformed sides are apart by {gap['off']:.2g} of the largest displacement where p acts, {gap['allowed']:.2g} expected")
    if stress and not stress["agrees"]:
        troubles.append(f"p is off by {percent(stress['off'])} from the stresses of both bodies, {percent(stress['allowed'])} expected")
    if not any(v.counts and not (geometry and v.weaker_than(asked)) for v in runs):
        troubles.append("no other run could be made")
    return troubles


def certificate(base, runs, skipped, asked, geometry, seconds):
    """All that certificate.json holds."""
    weak = [v for v in runs if geometry and v.weaker_than(asked)]
    counted = [v for v in runs if v.counts and v not in weak]
    rows = rows_of(base, counted)
    gap = told_apart(base, asked) if base.status == "solved" else None
    stress = by_stresses(base, asked) if base.status == "solved" else None
    troubles = troubles_of(base, runs, asked, geometry, gap, stress)
    skipped = skipped + [f"{v.name}: {v.words}" for v in runs if v.status == "skipped"]
    left, alone = untold_of(base, counted)
    troubles += [f"no other run determines {name}" for name in alone]
    skipped += [f"{name}: undetermined in {', '.join(by)}" for name, by in left.items() if name not in alone]
    skipped += [f"{v.name}: it knows p to {percent(v.run.summary['estimate']['pressure']['error'])} only, and confirms nothing" for v in weak]
    describe = lambda v: {
        "name": v.name, "what": v.what, "status": v.status, "seconds": round(v.seconds, 2), "command": v.command,
        "unknowns": v.run.summary["mesh"]["dofs"] if v.run else None,
    }  # fmt: skip
    return {
        "title": base.run.summary["title"],
        "scene": base.run.summary["scene"],
        "asked": asked,
        "agrees": not troubles and bool(rows) and all(row["agrees"] for row in rows),
        "figures": rows,
        "deformed_gap": gap,
        "stress_difference": stress,
        "troubles": troubles,
        "skipped": skipped,
        "left_out": base.run.left_out,
        "runs": [describe(v) for v in [base, *runs]],
        "study": study_of(base, counted),
        "large_displacements": [words for words in base.run.summary["warnings"] if words.startswith("large displacements")],
        "seconds": round(seconds, 2),
    }


def sentence(found):
    """The verdict in one sentence."""
    others = sum(run["status"] not in ("skipped", "failed") for run in found["runs"]) - 1
    if found["agrees"]:
        apart = ", ".join(f"{r['kind']} by {r['of_normals']:.2g}" for r in found["figures"] if r["of_normals"])
        besides = f", but for which curve's normals p acts along ({apart}: small displacements do not tell)" if apart else ""
        return f"agrees: {sum(r['count'] for r in found['figures'])} figures by {others} other runs, each within the bars{besides}"
    wrong = [row["kind"] for row in found["figures"] if not row["agrees"]]
    return "does not agree: " + "; ".join([*wrong, *found["troubles"]]) if wrong or found["troubles"] else "nothing to compare"


def worded(found):
    """The certificate for a terminal."""
    lines = [found["title"] or found["scene"], f"  {sentence(found)}"]
    for run in found["runs"]:
        size = "" if run["unknowns"] is None else f"{run['unknowns']} unknowns, "
        lines.append(f"  run       {run['name']} ({run['what']}): {run['status'].replace('_', ' ')}, {size}{run['seconds']:.1f} s")
    for row in found["figures"]:
        verdict = "agrees" if row["agrees"] else "DOES NOT AGREE"
        of = f" of {row['count']}: {row['figure']}" if row["count"] > 1 else "" if row["figure"] == row["kind"] else f": {row['figure']}"
        lines.append(f"  {verdict:9} {row['kind']}{of} {row['value']:.6g} ± {row['bar']:.2g}")
        off = f"off by {row['off']:.2g} of {row['allowed']:.2g} that both bars allow, in {row['run']}"
        lines.append("            " + (f"{row['run']} has no such figure" if math.isnan(row["off"]) else off))
        if row["of_normals"]:
            lines.append(f"            and by {row['of_normals']:.2g} in other_side, as p acts along the other curve's normals there")
    for row in found["study"]:
        off = "" if row["off"] is None else f", {row['off']:.2g} from the finest"
        rate = "" if row["rate"] is None else f", falling as the estimate to the power {row['rate']:.1f}"
        lines.append(f"  mesh      {row['run']}: {row['unknowns']} unknowns, p estimated within {percent(row['estimated'])}{off}{rate}")
    if gap := found["deformed_gap"]:
        off = f"{gap['off']:.2g} of the largest displacement ({gap['allowed']:.2g} expected)"
        lines.append(f"  gaps      where p acts the deformed sides are apart by {off}; their normals by {gap['tilt']:.2g} radians")
    if stress := found["stress_difference"]:
        lines.append(f"  stresses  p is off from those of the nearer body by {percent(stress['off'])} ({percent(stress['allowed'])} expected)")
    lines += [f"  warning   {words}" for words in found["large_displacements"]]
    lines += [f"  trouble   {words}" for words in found["troubles"]]
    lines += [f"  skipped   {words}" for words in found["skipped"]]
    lines += [f"  left out  {words}" for words in found["left_out"]]
    return "\n".join(lines)


def certify(mortise, scene, output, changes=(), accuracy=None, freefem=True, spoil=None):
    """Runs all and returns the certificate, which is also written: output/certificate.json. `spoil`: more --set of a run by
    its name, for tests of the verdict. Raises SystemExit with the program's words where the scene is refused."""
    try:
        tables = tomllib.loads(scene.read_text())
    except (OSError, ValueError) as error:
        raise SystemExit(f"mortise certify: error: {scene}: {getattr(error, 'strerror', None) or error}") from None
    if tables.get("case") and not any(change.replace(" ", "") == "case=[]" for change in changes):
        raise SystemExit(f"mortise certify: error: {scene}: one load is certified; expected --set case=[], and a --set of what the case changes")
    start, output = time.perf_counter(), output.absolute()
    asked = accuracy if accuracy is not None else part_of(tables.get("accuracy", {}).get("value", "1%"))
    geometry = str(tables.get("mesh", {}).get("file", "")).endswith(".geo") and not tables.get("copies")
    changes = [*changes, *([f"accuracy.value={asked:.6g}"] if geometry else [])]
    run = lambda variation, more=(): solve(mortise, scene, [*changes, *more], variation, output / variation.name)
    base = run(Variation("own", "the scene as it is", []))
    if base.run is None:
        raise SystemExit(base.words)
    probe = with_probes(tables, base.run)
    if base.status == "solved" and (probed := run(Variation("own", "the scene as it is", []), probe)).run:
        probed.run.left_out += base.run.left_out
        base = probed
    others, skipped = variations_of(tables, base.run.summary, asked if geometry else None)
    done = others if base.status == "solved" else []
    for variation in done:
        variation.changes += (spoil or {}).get(variation.name, [])

    def solved(variation):  # what is expected is of the scene as it is: a force is on the multiplier side
        run(variation, [*probe, "expect=[]"])
        if variation.finer > 1 and variation.run and variation.run.summary["mesh"]["dofs"] == base.run.summary["mesh"]["dofs"]:
            variation.changes.append(shorter_first_edges(tables, changes, variation.finer))  # the same mesh confirms nothing
            run(variation, [*probe, "expect=[]"])

    # The finest mesh takes longest, and begins.
    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as beside:
        finest_first = sorted(done, key=lambda variation: variation.finer, reverse=True)
        list(beside.map(solved, finest_first))
    if freefem and done:
        peer, why = by_freefem(base, mortise, output)
        done, skipped = [*done, *([peer] if peer else [])], [*skipped, *([why] if why else [])]
    found = certificate(base, done, skipped, asked, geometry, time.perf_counter() - start)
    (output / "certificate.json").write_text(json.dumps(found, indent=1) + "\n")
    return found


def part_of(text):
    """0.01 or "1%" as a number."""
    text = str(text)
    return float(text[:-1]) / 100 if text.endswith("%") else float(text)


def asked_part(text):
    try:
        part = part_of(text)
    except ValueError:
        part = 0
    if not 0 < part < 1:
        raise argparse.ArgumentTypeError(f"{text}: expected a part above 0 and below 1, such as 1%")
    return part


def main():
    parser = Parser(__doc__, prog="mortise certify")
    parser.add_argument("scene", type=Path, help="scene file (.toml)")
    parser.add_argument("--accuracy", type=asked_part, help="of p, such as 1%% (default: the scene's, else 1%%)")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="override a value of the scene, in all runs")
    parser.add_argument("--no-freefem", action="store_true", help="not by FreeFEM too, which takes some seconds")
    parser.add_argument("-o", "--output", type=Path, help="folder of all runs (default: out/SCENE_certificate)")
    options = parser.parse_args()
    output = options.output or Path("out") / f"{options.scene.stem}_certificate"
    mortise = os.environ.get("MORTISE_PROGRAM", "mortise")
    found = certify(mortise, options.scene, output, options.set, options.accuracy, not options.no_freefem)
    page = output.with_name(output.resolve().name + ".html")
    write_report(output, page, mortise)
    print(worded(found))
    print(f"  report    {page}")
    sys.exit(0 if found["agrees"] else 2)


if __name__ == "__main__":
    run(main)
