#!/usr/bin/python3
"""Asked against got: scenes with `accuracy` from 5 to 0.01 %, five first meshes each, against references.

Written are OUT/answers.csv (a row an answer), verdicts.csv, two pictures and accuracy.md; the runs are kept in
OUT/runs. --docs writes docs/accuracy.md and its pictures. Exit status 1 where a run fails or an answer is worse than
what was asked.
"""

import os
import sys
from pathlib import Path
from statistics import median

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.with_name("common")))

import accuracy_runs
import judge_answers
import launch
import page
import answers_pictures
import runs
import template
from template import percent


def share(values):
    known = [value for value in values if value is not None]
    return f"{100 * min(known):.0f}" if known else "–"


def answers_table(rows):
    """A line for each scene and accuracy."""
    lines = []
    for scene, asked in dict.fromkeys((row["scene"], row["asked"]) for row in rows):
        some = [row for row in rows if (row["scene"], row["asked"]) == (scene, asked) and not row["failed"]]
        if not some:
            continue
        of = lambda key: [row[key] for row in some]
        ratios, solves = of("ratio_line"), of("solves")
        mark = "" if all(of("trusted")) else " *"
        lines.append([
            scene, percent(asked), f"{percent(median(of('got')))} ({percent(max(of('got')))}){mark}",
            f"{min(ratios):.1f}–{max(ratios):.1f}", share(of("inside")), share(of("inside_excluded")),
            f"{min(solves)}–{max(solves)}" if min(solves) < max(solves) else solves[0],
            f"{median(of('unknowns')) / 1000:.1f}k", f"{median(of('work')):.1f} ({max(of('work')):.1f})",
            f"{median(of('seconds')):.2f}",
        ])  # fmt: skip
    heading = ["scene", "asked", "got", "estimated over true", "inside, %", "near corners, %", "solves", "unknowns",
               "all work", "seconds"]  # fmt: skip
    return template.table(heading, lines)


def carry_out(options):
    """The rows of all answers, those of the two drawn and the verdicts."""
    store = runs.Store(options.output / "runs", [accuracy_runs.__file__], jobs=options.jobs)
    rows, known = [], {}
    for scene in options.only or accuracy_runs.ASKED:
        references = store.rows(accuracy_runs.references(scene, options.quick), accuracy_runs.execute, scene)
        asked = accuracy_runs.answers(scene, options.quick)
        found = store.rows(asked, accuracy_runs.execute, scene)
        if failed := [row["failed"] for row in references if row["failed"]]:
            found = [{"failed": f"its reference: {failed[0]}"} for _ in found]
        elif scene in judge_answers.FORMULAS:
            known[scene] = judge_answers.independent(scene, references)
        rows += [judge_answers.judged(scene, run, row, references) for run, row in zip(asked, found)]
    one = lambda run: store.row(run, accuracy_runs.execute)
    drawn = one(accuracy_runs.answer("parabola_1", 0.01))
    coarse = one(accuracy_runs.even(1, 1))
    even = one(accuracy_runs.even(coarse["mesh"]["dofs"], drawn["accuracy"]["solves"][drawn["accuracy"]["answer"] - 1]["unknowns"]))
    verdicts = list(judge_answers.verdicts(rows, accuracy_runs.whole_process("1%")))
    return rows, known, (drawn, even), verdicts


def write(folder, rows, known, drawn, verdicts, options):
    keys = list(dict.fromkeys(key for row in rows for key in row))
    launch.write_csv(folder / "answers.csv", [{key: row.get(key) for key in keys} for row in rows])
    launch.write_csv(folder / "verdicts.csv", [dict(zip(("bar", "found", "holds"), verdict)) for verdict in verdicts])
    answers_pictures.draw_band(*drawn, folder / "band.png")
    answers_pictures.draw_answers(rows, folder / "answers.png")
    text = template.fill(
        (HERE / "accuracy.md").read_text(),
        quick=options.quick,
        answers=answers_table(rows),
        count=len(rows),
        solves=max(row["solves"] for row in rows if not row["failed"]),
        seconds=max(row["seconds"] for row in rows if not row["failed"]),
        inside=sum(not row["failed"] and row["inside"] >= 0.95 for row in rows),
        verdicts=template.table(["held", "found", ""], [(*v[:2], "holds" if v[2] else "does not") for v in verdicts]),
        independent=template.table(["scene", "difference"], [[name, f"{value:.1e}"] for name, value in known.items()]),
    )
    page.write(folder, "accuracy", text, options.docs)


def finding(row):
    """A line about an answer that is not as it should be."""
    name = f"{row['scene']} asked {row['asked']:g}, first mesh {row['first_edges']}"
    if row["failed"]:
        return f"{name}: {row['failed']}"
    if row["got"] <= row["asked"] and row["inside"] >= 0.95 and row["reached"]:
        return None
    place = f"worst at ({row['worst_x']:.5g}, {row['worst_y']:.5g}), {row['worst']:.3g} times its bar"
    return f"{name}: got {row['got']:.2e}, estimated {row['estimated']:.2e}; {place} {row['reason']}".rstrip()


def main(arguments=None):
    options = launch.command_line(__doc__, "accuracy", arguments, names=list(accuracy_runs.ASKED), docs=True)
    os.environ.update(launch.ONE_THREAD)
    options.output.mkdir(parents=True, exist_ok=True)
    try:
        rows, known, drawn, verdicts = carry_out(options)
    except launch.StudyError as error:
        sys.exit(f"accuracy.py: {error}")
    write(options.output, rows, known, drawn, verdicts, options)
    for words, found, holds in verdicts:
        print(f"{'holds   ' if holds else 'does not'}  {words}: {found}")
    print(*filter(None, map(finding, rows)), f"{options.output}/accuracy.md", sep="\n")
    sys.exit(1 if any(row["failed"] or row["got"] > row["asked"] for row in rows) else 0)


if __name__ == "__main__":
    main()
