#!/usr/bin/python3
"""The study of the preprint (Aronov & Rodin 2019, Keldysh Institute preprint 87), in one command.

Tables 1-3 and 5-8 beside our figures, why the preprint's stresses oscillate, and its figures from our results. Written
into OUTPUT are preprint.md, tables.csv, variants.csv, verdicts.csv, effects.csv, unprinted.csv, medians.csv,
gaps.csv, gallery.csv and the pictures; the runs lie in OUTPUT/runs and are not repeated. Exit status: 0 if the study is
complete, 1 if it could not run. MORTISE names another executable than build/release/mortise.
"""

import os
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import preprint_runs  # makes common/ known
import cause
import gallery
import launch
import mesh_gaps
import page
import preprint_charts as charts
import printed_tables
import tables
import template

SCENE, MESH = "parabola_2", (80, 100)  # of the curves that show the cause
TEXTS = template.texts(Path(__file__).with_name("preprint_texts.md"))


@dataclass(frozen=True)
class Size:
    """What a study takes in; None is all."""

    meshes: list | None
    variants: list
    figures: list | None
    curves_mesh: tuple
    unprinted: tuple


SHOWN = [cause.OURS, cause.NORMALS, cause.GAP, cause.RULE]  # in the pictures
QUICK = Size([(40, 50)], [*SHOWN, cause.BOTH], [2, 3, 14, 16, 26, 31], (40, 50), (25, 20))
FULL = Size(None, list(cause.VARIANTS), None, MESH, cause.UNPRINTED)


def study(store, output, size, say):
    """Everything: a dictionary of tables."""
    printed = printed_tables.printed_rows(size.meshes)
    found = {"tables": tables.compute(store, printed, say)}
    charts.printed_against_ours(output / "tables.png", found["tables"])
    found["variants"] = list(cause.compute(store, size.variants, printed, say))
    found["verdicts"] = cause.judge_all(found["variants"])
    best = cause.nearest(found["verdicts"])
    found["best"], found["printed"] = best, cause.figures_printed(found["variants"])
    charts.variants(output / "variants.png", found["variants"], found["verdicts"])
    charts.by_mesh(output / "meshes.png", found["variants"], SHOWN, best["reading"])
    side = printed_tables.MAPPINGS[best["reading"]]("G1")
    charts.stress_curves(output / "curves.png", store, SHOWN, side, SCENE, size.curves_mesh)
    found["effects"] = list(cause.effects(found["variants"], best["reading"]))
    compared = [cause.OURS, cause.BOTH, cause.RULE]
    found["unprinted"] = cause.unprinted(store, compared, size.unprinted, printed, say)
    found["medians"] = list(cause.medians(found["variants"] + found["unprinted"], compared, best["reading"]))
    meshes = sorted({row["mesh"] for row in printed})
    found["gaps"] = list(mesh_gaps.rows(store, ("circle", "parabola_1", "parabola_2"), meshes))
    view = gallery.View(store, best["reading"], best["variant"])
    found["gallery"] = list(gallery.make(view, output, size.figures, say))
    return found


# ---- The page ----


def is_number(value):
    return value == value  # not NaN


def required(rows):
    """Is ours at most the printed figure?"""
    for at in dict.fromkeys(row["at"] for row in rows):
        targets = [row for row in rows if row["target"] and row["at"] == at]
        better, best = (len(targets) - len(tables.exceptions(targets, name)) for name in ("better", "best"))
        yield "required", {"at": at, "better": better, "best": best, "count": len(targets)}
    for row in tables.exceptions(rows):
        names = ("table", "scene", "mesh", "at", "active", "body", "printed", "better", "best")
        yield "exception", {name: row[name] for name in names} | {"share": 100 * row["better_share_of_worst"]}


def about_the_cause(found):
    """The variant nearest to the printed parabola rows, with what it meets and misses."""
    best, printed = found["best"], found["printed"]
    pairs = [f"{name} {best[name]:.2g} (printed {printed[name]:.2g})" for name in printed if is_number(best[name])]
    sizes = ", ".join(f"{series} {best[f'ours/printed, {series}']:.2g}" for series in printed_tables.SERIES)
    words = {name: best[name] for name in ("variant", "reading", "fits")}
    within = 100 * best["parabolas: rows within 3"]
    yield "cause", {**words, "sizes": sizes, "within": within, "pairs": ", ".join(pairs)}
    if not is_number(best["factor between meshes"]):
        yield "one mesh", {}
    others = [f"'{v['variant']}', '{v['reading']}'" for v in found["verdicts"] if v["fits"] and v is not best]
    if others:
        yield "others", {"others": "; ".join(others)}


def summary(found):
    """Lines: the required results and the verdict on the cause."""
    verdicts = [row["holds"].split("; ") for row in found["gallery"]]
    theirs = [words[-1].endswith("it holds") for words in verdicts if len(words) == 2]
    ours = sum(words[0] == "holds" for words in verdicts)
    counts = {"ours": ours, "figures": len(verdicts), "variant": sum(theirs), "compared": len(theirs)}
    lines = [*required(found["tables"]), *(("ratios", row) for row in tables.ratios(found["tables"]))]
    by = {(row["variant"], row["series"]): row for row in found["effects"]}
    names = {"normals": cause.NORMALS, "gap": cause.GAP, "both": cause.BOTH}
    which = {name: by[variant, "parabolas"]["median"] for name, variant in names.items()}
    which |= {f"circle_{name}": by[variant, "circle"]["median"] for name, variant in names.items()}
    lines += [("which", which | {"largest": by[cause.GAP, "parabolas"]["largest"]})]
    lines += [*about_the_cause(found), ("gallery", counts)]
    return [template.fill(TEXTS[name], **values).replace("\n", " ") for name, values in lines]


def as_table(rows):
    """Dictionaries as a table."""
    return template.table(rows[0], [map(tables.short, row.values()) for row in rows])


def markdown(found):
    figures = ", ".join(f"{name} {value:.2g}" for name, value in found["printed"].items() if is_number(value))
    numbers = ", ".join(dict.fromkeys(str(row["table"]) for row in found["tables"]))
    low, high = cause.BETWEEN_MESHES
    tabulated = {name: as_table(meshes_as_text(found[name])) for name in ("gaps", "effects", "medians", "verdicts")}
    return template.fill(
        TEXTS["page"], summary="\n\n".join(summary(found)), factor=cause.FACTOR, low=low, high=high, printed=figures,
        rows=template.table(tables.COLUMNS.values(), tables.lines(found["tables"])),
        variant=found["best"]["variant"], reading=found["best"]["reading"], numbers=numbers, **tabulated,
    )  # fmt: skip


def meshes_as_text(rows):
    text = lambda mesh: mesh if isinstance(mesh, str) else launch.mesh_name(mesh)
    return [row | {"mesh": text(row["mesh"])} if "mesh" in row else row for row in rows]


def write(output, found):
    for name in ("tables", "variants", "verdicts", "effects", "unprinted", "medians", "gaps", "gallery"):
        launch.write_csv(output / f"{name}.csv", meshes_as_text(found[name]))
    page.write(output, "preprint", "\n\n".join([markdown(found), *map(gallery.words, found["gallery"])]))


def main(arguments=None):
    options = launch.command_line(__doc__, "preprint", arguments)
    options.output.mkdir(parents=True, exist_ok=True)
    os.environ.update(launch.ONE_THREAD)
    start = time.time()
    try:
        store = preprint_runs.Store(options.output / "runs", options.jobs)
        say = lambda text: print(f"[{time.time() - start:5.0f} s, {store.fresh:3} runs] {text}", flush=True)
        found = study(store, options.output, QUICK if options.quick else FULL, say)
        write(options.output, found)
    except launch.StudyError as error:
        sys.exit(f"preprint.py: {error}")
    print(*summary(found), f"{options.output}/preprint.md, tables.csv", sep="\n")
    return store.fresh


if __name__ == "__main__":
    main()
