"""The report: report.json with every figure, crosscheck.md for people."""

import json
import math
import platform
from datetime import datetime, timezone
from pathlib import Path

import run  # makes common/ known
from judge import rates

import page
import pictures
import template

TEXTS = template.texts(Path(__file__).with_name("report_texts.md"))
LEVELS = tuple(name for name in TEXTS if name)
TIMES = {"unknowns": "{:.0f}", "multipliers": "{:.0f}", "mortise": "{:.2f}", "freefem": "{:.2f}", "ratio": "{:.1f}",
         "mortise_solve": "{:.4f}", "freefem_solve": "{:.4f}", "ratio_solve": "{:.1f}"}  # fmt: skip


def number(value):
    return "–" if value is None or not math.isfinite(value) else f"{value:.2e}"


def link(result):
    return f"[{result.name}]({result.folder})"


def without_nan(value):
    """JSON has no NaN: null."""
    if isinstance(value, dict):
        return {key: without_nan(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [without_nan(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def worst_of(results):
    """Of each scene the result whose figures come nearest to their limits, or pass them by most."""
    worst = {}
    for result in (result for result in results if result.steps):
        nearness = max((f.value / f.limit for f in result.figures if not f.is_rate and f.limit > 0), default=0)
        if result.scene not in worst or not nearness <= worst[result.scene][0]:
            worst[result.scene] = nearness, result
    return [result for _, result in worst.values()]


# ---- Tables: a heading and rows of texts; the first text of a row is the status or a name ----


def one_mesh_table(results):
    """A row a case of the same discretisation."""
    limits = {figure.name: figure.limit for result in results for figure in result.figures}
    rows = []
    for result in results:
        values = {figure.name: figure.value for figure in result.figures}
        cells = [number(values.get(name)) for name in limits]
        rows.append([result.status, link(result), *cells, f"{result.seconds:.1f}"])
    return ["", "case", *(f"{name} ≤ {limit:g}" for name, limit in limits.items()), "seconds"], rows


def figure_row(result, name):
    """One quantity of a series: its values on the meshes, the limit of the last, the rates and the least rate."""
    values = [step["differences"][name] for step in result.steps]
    mine = {f.is_rate: f for f in result.figures if f.name in (name, f"rate of {name}")}
    limit, rate = mine[False].limit if False in mine else None, mine.get(True)
    both = [", ".join(f"{r:.2f}" for r in rates(values)), f"{rate.value:.2f} ≥ {rate.limit:g}"] if rate else ["", ""]
    status = "ok" if all(figure.ok for figure in mine.values()) else "failed"
    return [status, link(result), name, *map(number, values), number(limit), *both]


def series_table(results):
    """A row for each quantity of each series."""
    heading = ["", "case", "quantity", "coarse", "middle", "fine", "limit of fine", "rates", "mean rate ≥ least"]
    rows = [figure_row(r, name) for r in results if r.figures for name in r.steps[0]["differences"]]
    rows += [[r.status, link(r), *[""] * (len(heading) - 2)] for r in results if not r.figures]
    return heading, sorted(rows, key=lambda row: row[0] == "ok")


def timing_table(results):
    heading = ["", "case", "unknowns", "multipliers", "mortise", "FreeFEM", "ratio"]
    heading += ["mortise, solve", "FreeFEM, solve", "ratio, solve"]
    texts = lambda r: [form.format(r.timing[key]) if r.timing else "" for key, form in TIMES.items()]
    return heading, [[r.status, link(r), *texts(r)] for r in results]


def worst_table(results):
    """The largest figure of each quantity, a row a scene."""
    names, rows = {f.name: f.is_rate for r in results for f in r.figures}, []
    for scene in dict.fromkeys(r.scene for r in results):
        mine = [r for r in results if r.scene == scene]
        row = [scene, len(mine), sum(r.status != "ok" for r in mine)]
        for name, is_rate in names.items():
            values = [f.value for r in mine for f in r.figures if f.name == name]
            row.append((f"{min(values):.2f}" if is_rate else number(max(values))) if values else "")
        rows.append(row)
    extremes = [f"{'least' if is_rate else 'largest'} {name}" for name, is_rate in names.items()]
    return ["scene", "cases", "not ok", *extremes], rows


TABLES = {"same_discretisation": one_mesh_table, "same_problem": series_table, "timing": timing_table}


# ---- Pages ----


def draw_pictures(results, output):
    """The rates, and the worst case of each scene and level; (level, Markdown) of each."""
    for level in LEVELS:
        found = [result for result in results if result.level == level]
        series = [result for result in found if any(figure.is_rate for figure in result.figures)]
        if series:
            pictures.draw_rates(series, output / "pictures/rates.png")
            caption = "Differences of all series; solid: multipliers on the upper or inner side"
            yield level, f"![{caption}](pictures/rates.png)"
        for result in worst_of(found):
            path = f"pictures/{level}_{result.scene}.png"
            title = result.name if level != "same_problem" else f"{result.name}, finest mesh"
            pictures.draw_case(output / result.folder, title, result.side, output / path)
            yield level, f"![{result.scene}: the case nearest to its limits]({path})"


def summary_line(results, seconds):
    bad = sum(result.status != "ok" for result in results)
    return f"{len(results)} cases in {seconds:.0f} s. " + ("All hold." if bad == 0 else f"{bad} do not hold.")


def markdown(results, seconds, drawn):
    """The page; within a level, the cases that fail come first."""
    parts = ["# mortise against FreeFEM", summary_line(results, seconds)]
    parts += [f"**{result.name}**\n{result.message}" for result in results if result.message]
    for level in LEVELS:
        found = sorted((r for r in results if r.level == level), key=lambda r: r.status == "ok")
        if not found:
            continue
        by_scene = [] if level == "timing" else ["### By scene", template.table(*worst_table(found))]
        mine = [text for at, text in drawn if at == level]
        parts += [TEXTS[level], *by_scene, *mine, "### All cases", template.table(*TABLES[level](found))]
    return "\n\n".join(parts) + "\n"


def write(results, output, seconds):
    """All files of the report into the folder `output`, beside the folders of the cases."""
    drawn = list(draw_pictures(results, output))
    table = {
        "date": datetime.now(timezone.utc).isoformat(timespec="seconds"),
        "machine": platform.machine(),
        "seconds": seconds,
        "cases": len(results),
        "not_ok": sum(result.status != "ok" for result in results),
        "results": [result.as_table() for result in results],
    }
    (output / "report.json").write_text(json.dumps(without_nan(table), indent=1, allow_nan=False) + "\n")
    page.write(output, "crosscheck", markdown(results, seconds, drawn))
