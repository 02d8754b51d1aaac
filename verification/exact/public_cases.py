#!/usr/bin/python3
"""Public cases: what other programs test themselves with, as scenes with --accuracy 0.1%, beside the figures in print.

The scenes are cases/*.toml, the figures public_cases.toml, what FreeFEM finds on a mesh of each is beside them. Written are
OUT/cases.csv and cases.md; the runs are kept in OUT/runs. --docs writes docs/cases.md. Exit status 1 where a run fails, a
scene's own [[expect]] does not hold, a bar is above 0.1 %, or a figure in print is off that was not, or the other way.
"""

import json
import sys
import tempfile
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.with_name("common")))

import numpy as np

import launch
import page
import peers  # makes crosscheck/ known
import on_mesh
import runs
import template

ASKED = 1e-3
CASES = tomllib.loads((HERE / "public_cases.toml").read_text())["case"]


def scene_of(case):
    return HERE / f"cases/{case['scene']}.toml"


def title_of(case):
    return tomllib.loads(scene_of(case).read_text())["title"]


def found(figure, summary):
    """The figure and its bar: by its dotted key, or as parts of the components of a displacement or a stress."""
    accuracy, factor = summary["accuracy"], figure.get("factor", 1)
    estimated = accuracy["solves"][accuracy["answer"] - 1]["estimated"]
    if "parts" in figure:
        values, parts = (np.array(a, float) for a in (summary["accuracy"]["value"], figure["parts"]))
        return parts @ values, estimated * np.linalg.norm(values) * np.abs(parts).sum()
    value = summary
    for key in figure["key"].split("."):
        value = value[int(key) if key.isdigit() else key]
    return value * factor, abs(value * factor) * estimated


def execute(run):
    """A figure on the mesh that is found for it."""
    figure, scene = run["figure"], HERE / f"cases/{run['scene']}.toml"
    settings = {"accuracy.value": ASKED / 4, "accuracy.of": json.dumps(figure["of"]), **figure.get("set", {})}
    if figure["of"] in ("displacement", "stress"):
        probe = tomllib.loads(scene.read_text())["probe"][0]
        settings |= {f"accuracy.{key}": json.dumps(probe[key]) for key in ("at", "body") if key in probe}
    with tempfile.TemporaryDirectory() as folder:
        before = launch.processor_seconds()
        try:
            summary = launch.solve(scene, settings, Path(folder) / "out")
        except launch.StudyError as error:
            return {"failed": str(error)} | dict.fromkeys(("value", "bar", "unknowns", "seconds"))
        value, bar = found(figure, summary)
        checks = [check["name"] for check in summary["checks"] if not check["ok"]]
        failed = "" if summary["status"] == "solved" else ", ".join([summary["status"], *checks])
        return {"failed": failed, "value": float(value), "bar": float(bar), "unknowns": summary["mesh"]["dofs"],
                "seconds": launch.processor_seconds() - before}  # fmt: skip


def printed_off(printed, row):
    """Whether a figure in print is off by more than our bar and the half of its last digit, or the tolerance it names."""
    value, digits = float(printed["value"]), printed["value"].partition("e")[0].partition(".")[2]
    power = int(printed["value"].partition("e")[2] or 0) - len(digits)
    allowed = printed.get("within", 0) * abs(value) or 0.5 * 10**power
    return abs(row["value"] - value) > allowed + row["bar"]


def wrong_of(figure, row):
    if row["failed"]:
        return [row["failed"]]
    wrong = [] if row["bar"] <= ASKED * abs(row["value"]) else [f"bar {row['bar'] / abs(row['value']):.2%}"]
    changed = [p for p in figure["printed"] if printed_off(p, row) != p.get("off", False)]
    return wrong + [f"{p['value']} by {p['by']} is {'not ' * p.get('off', False)}off" for p in changed]


# ---- FreeFEM ----


def by_freefem(run):
    """Unknowns of a mesh for 0.5 %, and by how much p of both programs differs on it: the root of the mean square, over that
    of p. Two triangles of straight sides stand for each of ours."""
    scene = HERE / f"cases/{run['scene']}.toml"
    with tempfile.TemporaryDirectory() as folder:
        mesh, results = Path(folder) / "mesh.msh", Path(folder) / "out"
        launch.call("mesh", scene, "--accuracy", "0.5%", "-o", mesh)
        settings = {"mesh.file": json.dumps(str(mesh)), "mesh.parameters": "{}", "expect": "[]"}
        summary = launch.solve(scene, settings, results)
        on = summary["method"]["multipliers_on"]
        try:
            x, y, p = on_mesh.line(tomllib.loads(scene.read_text()), mesh, on, Path(folder)).T[1:4]
        except launch.StudyError as error:
            return {"failed": str(error).splitlines()[-1], "unknowns": summary["mesh"]["dofs"], "off": None}
        line = launch.columns(results / "contact.csv")
        ours = np.isin(line["curve"], on)
        distance = np.hypot(line["x"][ours] - x[:, None], line["y"][ours] - y[:, None])
        at = line["p"][ours][distance.argmin(axis=1)]
        return {"failed": "", "unknowns": summary["mesh"]["dofs"], "off": float(np.linalg.norm(p - at) / np.linalg.norm(at))}


# ---- The page ----


def table_lines(case, rows):
    """Of a case: a line a figure in print."""
    title = title_of(case)
    for figure, row in zip(case["figures"], rows):
        ours = row["failed"] or f"{row['value']:.6g} ± {row['bar']:.1g}"
        for printed in figure["printed"]:
            value = float(printed["value"])
            off = "" if row["failed"] else f"{100 * (value / row['value'] - 1):+.2f} %".replace("-0.00", "0.00").replace("+0.00", "0.00")
            within = f" ± {100 * printed['within']:.2g} %" if "within" in printed else ""
            verdict = "**off**" if printed.get("off") else "holds"
            yield [title, figure["what"], ours, f"{printed['value']}{within}", printed["by"], off, verdict]
            title = ours = ""
            figure = figure | {"what": ""}


def main(arguments=None):
    names = [case["scene"] for case in CASES]
    options = launch.command_line(__doc__, "cases", arguments, names=names, docs=True)
    depends = [__file__, peers.__file__, HERE / "public_cases.toml", *HERE.glob("*.geo"), *HERE.glob("cases/*.toml")]
    store = runs.Store(options.output / "runs", sorted(map(Path, depends)), jobs=options.jobs)
    lines, table, wrong, others = [], [], [], []
    freefem = not options.quick and peers.found("FreeFEM")
    for case in CASES:
        if options.only and case["scene"] not in options.only:
            continue
        rows = store.rows([{"scene": case["scene"], "figure": figure} for figure in case["figures"]], execute, case["scene"])
        for figure, row in zip(case["figures"], rows):
            wrong += [f"{case['scene']}: {figure['what']}: {text}" for text in wrong_of(figure, row)]
            table.append({"scene": case["scene"], "figure": figure["what"]} | row)
        lines += table_lines(case, rows)
        if freefem:
            row = store.row({"scene": case["scene"], "by": "FreeFEM"}, by_freefem)
            others.append([title_of(case), row["unknowns"], row["failed"] or f"{row['off']:.0e}"])
    launch.write_csv(options.output / "cases.csv", table)
    text = template.fill(
        (HERE / "public_cases.md").read_text(),
        table=template.table(["case", "figure", "ours", "in print", "by", "off by", ""], lines),
        why="\n".join(f"- **{title_of(case)}.** {case['why']}" for case in CASES if "why" in case),
        others=template.table(["", "unknowns", "p differs by"], others) if others else "FreeFEM was not there.",
        seconds=sum(row["seconds"] or 0 for row in table),
        most=max(row["unknowns"] or 0 for row in table),
    )
    page.write(options.output, "cases", text, options.docs)
    print("\n".join(wrong) or "all as told")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
