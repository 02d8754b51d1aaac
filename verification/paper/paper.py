#!/usr/bin/python3
"""The study of the preprint (Aronov & Rodin 2019, Keldysh Institute preprint 87), in one command.

Tables 1-3 and 5-8 beside our figures, why the preprint's stresses oscillate, and its figures from our results. Written
into OUTPUT are section.html, paper.md, tables.csv, fits.csv, variants.csv, verdicts.csv, gaps.csv, gallery.csv and the
pictures; the runs lie in OUTPUT/runs and are not repeated. Exit status: 0 if the study is complete, 1 if it could not
run. MORTISE names another executable than build/release/mortise.
"""

import argparse
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import cause
import gallery
import gallery_view
import mesh_gaps
import paper_charts
import paper_runs  # makes launch and page known
import paper_words
import preprint
import tables
import launch

SCENE, MESH = "parabola_2", (80, 100)  # of the curves that show the cause
MEASURED = "segments, measured"


@dataclass(frozen=True)
class Size:
    """What a study takes in; None is all."""

    meshes: list | None
    variants: list
    figures: list | None
    curves_mesh: tuple


QUICK_VARIANTS = [cause.OURS, MEASURED, "elements, closed", "elements, measured"]
QUICK = Size([(40, 50)], QUICK_VARIANTS, [3, 14, 16, 26, 31], (40, 50))
FULL = Size(None, list(cause.VARIANTS), None, MESH)


def progress(store, started):
    """Shows what is done next, with the runs so far."""
    return lambda text: print(f"[{time.time() - started:5.0f} s, {store.solved:3} runs] {text}", flush=True)


def flat(rows):
    """Rows for a CSV: the mesh as a text."""
    text = lambda mesh: mesh if isinstance(mesh, str) else "x".join(map(str, mesh))
    return [{**row, "mesh": text(row["mesh"])} for row in rows]


def study(store, output, size, say):
    """Everything, as a dictionary of tables for paper_words."""
    printed = preprint.printed_rows(size.meshes)
    found = {"rows": tables.compute(store, printed, say)}
    paper_charts.printed_against_ours(output / "tables.png", found["rows"])
    found["variants"] = list(cause.compute(store, size.variants, printed, say))
    found["verdicts"] = cause.judge_all(found["variants"])
    best = cause.nearest(found["verdicts"])
    found["best"], found["printed"] = best, cause.printed_figures(found["variants"])
    whole = len({row["mesh"] for row in printed if row["at"] == "nodes"}) > 1  # else there is no factor between meshes
    found["trend"] = cause.nearest_in_trend(found["verdicts"], found["printed"]) if whole else None
    paper_charts.variants(output / "variants.png", found["variants"], found["verdicts"])
    chosen = list(dict.fromkeys([cause.OURS, MEASURED, best["variant"], (found["trend"] or best)["variant"]]))
    paper_charts.by_mesh(output / "meshes.png", found["variants"], chosen, best["reading"])
    side = preprint.MAPPINGS[best["reading"]]("G1")
    paper_charts.stress_curves(output / "curves.png", store, chosen, side, SCENE, size.curves_mesh)
    meshes = sorted({row["mesh"] for row in printed})
    found["gaps"] = list(mesh_gaps.rows(store, ("circle", "parabola_1", "parabola_2"), meshes))
    view = gallery_view.View(store, best["reading"], best["variant"])
    found["gallery"] = list(gallery.make(view, output, size.figures, say))
    return found


def write(output, found):
    launch.write_csv(output / "tables.csv", flat(found["rows"]))
    launch.write_csv(output / "fits.csv", list(tables.fits(found["rows"])))
    launch.write_csv(output / "variants.csv", flat(found["variants"]))
    launch.write_csv(output / "verdicts.csv", found["verdicts"])
    launch.write_csv(output / "gaps.csv", found["gaps"])
    launch.write_csv(output / "gallery.csv", found["gallery"])
    (output / "paper.md").write_text(paper_words.markdown(found))
    paper_words.write_html(output, found)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, default=Path("out/paper"), help="folder (default: out/paper)")
    parser.add_argument("--quick", action="store_true", help="one mesh, 4 variants, 5 figures: under 2 minutes")
    options = parser.parse_args(arguments)
    options.output.mkdir(parents=True, exist_ok=True)
    store = paper_runs.Store(options.output / "runs")
    try:
        say = progress(store, time.time())
        found = study(store, options.output, QUICK if options.quick else FULL, say)
        write(options.output, found)
    except launch.MortiseError as error:
        sys.exit(f"paper.py: {error}")
    say("done")
    print(*paper_words.summary(found), f"{options.output}/section.html, paper.md, tables.csv", sep="\n")
    return store.solved


if __name__ == "__main__":
    main()
