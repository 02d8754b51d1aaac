"""The report: report.json with every figure, report.md and report.html for people, section.html for the whole."""

import html
import json
import math
import platform
import sys
from datetime import datetime, timezone
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import page
import pictures
from judge import rates

LEVELS = {
    "same_discretisation": (
        "Same discretisation",
        "Triangles with straight sides, the same spaces, the same points on the contact curve: both programs solve one "
        "and the same system. displacement is max |Δu| / max |u| over the nodes, "
        "pressure is max |Δp| / max |p| over the multipliers.",
    ),
    "same_problem": (
        "Same problem",
        "mortise on 8-node quadrilaterals with curved sides, FreeFEM with P2 on straight-sided triangles between the "
        "same corner nodes: two discretisations of one problem. The differences must fall with h. displacement and "
        "pressure are relative L2 differences, over the corner nodes and along the contact curve; pressure_inside is "
        "the largest difference over the mean |p| without 10 % of the length at each end and on either side of a kink.",
    ),
    "timing": (
        "Time",
        "Both programs in turns on the same mesh, with the same discretisation; medians in seconds. Solve: mortise's "
        "seconds.factorise + seconds.solve, FreeFEM's seconds_solve. The ratio is FreeFEM over mortise.",
    ),
}
def of_level(results, level):
    """Results of a level, first those that do not hold."""
    return sorted((r for r in results if r.level == level), key=lambda r: r.status == "ok")


def number(value):
    return "–" if value is None or not math.isfinite(value) else f"{value:.2e}"


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
    for result in results:
        passed = [f.value / f.limit for f in result.figures if not f.is_rate and f.limit > 0]
        nearness = max(passed, default=0)
        if result.steps and (result.scene not in worst or not nearness <= worst[result.scene][0]):
            worst[result.scene] = nearness, result
    return [result for _, result in worst.values()]


# ---- Tables: a heading and rows of texts; the first text of a row is the status or a name ----


def one_mesh_table(results):
    """A row a case of the same discretisation."""
    names = list(dict.fromkeys(figure.name for result in results for figure in result.figures))
    limits = {figure.name: figure.limit for result in results for figure in result.figures}
    heading = ["", "case", *(f"{name} ≤ {limits[name]:g}" for name in names), "seconds"]
    rows = []
    for result in results:
        values = {figure.name: figure.value for figure in result.figures}
        cells = [number(values.get(name)) for name in names]
        rows.append([result.status, page.Link(result.name, result.folder), *cells, f"{result.seconds:.1f}"])
    return heading, rows


def figure_row(result, name):
    """One quantity of a series: its values on the meshes, the limit of the last, the rates and the least rate."""
    values = [step["differences"][name] for step in result.steps]
    limit = next((f.limit for f in result.figures if f.name == name), None)
    rate = next((f for f in result.figures if f.name == f"rate of {name}"), None)
    holds = all(f.ok for f in result.figures if f.name in (name, f"rate of {name}"))
    both = [", ".join(f"{r:.2f}" for r in rates(values)), f"{rate.value:.2f} ≥ {rate.limit:g}"] if rate else ["", ""]
    link = page.Link(result.name, result.folder)
    return ["ok" if holds else "failed", link, name, *map(number, values), number(limit), *both]


def series_table(results):
    """A row for each quantity of each series."""
    heading = ["", "case", "quantity", "coarse", "middle", "fine", "limit of fine", "rates", "mean rate ≥ least"]
    rows = [figure_row(result, name) for result in results if result.figures for name in result.steps[0]["differences"]]
    rows += [[r.status, page.Link(r.name, r.folder), *[""] * (len(heading) - 2)] for r in results if not r.figures]
    return heading, sorted(rows, key=lambda row: row[0] == "ok")


def timing_table(results):
    heading = ["", "case", "unknowns", "multipliers", "mortise", "FreeFEM", "ratio"]
    heading += ["mortise, solve", "FreeFEM, solve", "ratio, solve"]
    keys = ["unknowns", "multipliers", "mortise", "freefem", "ratio", "mortise_solve", "freefem_solve", "ratio_solve"]
    formats = ["{:.0f}", "{:.0f}", "{:.2f}", "{:.2f}", "{:.1f}", "{:.4f}", "{:.4f}", "{:.1f}"]
    rows = []
    for r in results:
        texts = [f.format(r.timing[key]) for f, key in zip(formats, keys)] if r.timing else [""] * len(keys)
        rows.append([r.status, page.Link(r.name, r.folder), *texts])
    return heading, rows


def worst_table(results):
    """The largest figure of each quantity, a row a scene."""
    names = list(dict.fromkeys(f.name for r in results for f in r.figures))
    rows = []
    for scene in dict.fromkeys(r.scene for r in results):
        mine = [r for r in results if r.scene == scene]
        row = [scene, str(len(mine)), str(sum(r.status != "ok" for r in mine))]
        for name in names:
            values = [f.value for r in mine for f in r.figures if f.name == name]
            extreme = min if name.startswith("rate") else max
            text = "{:.2f}".format if name.startswith("rate") else number
            row.append(text(extreme(values)) if values else "")
        rows.append(row)
    heading = ["scene", "cases", "not ok", *(("least " if n.startswith("rate") else "largest ") + n for n in names)]
    return heading, rows


TABLES = {"same_discretisation": one_mesh_table, "same_problem": series_table, "timing": timing_table}


def markdown_table(heading, rows):
    text = lambda cell: f"[{cell.name}]({cell.folder})" if isinstance(cell, page.Link) else str(cell).replace("|", "\\|")
    lines = [heading, ["---"] * len(heading), *([text(cell) for cell in row] for row in rows)]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def summary_line(results, seconds):
    bad = sum(result.status != "ok" for result in results)
    outcome = "All hold." if bad == 0 else f"{bad} do not hold."
    return f"{len(results)} cases in {seconds:.0f} s. {outcome}"


# ---- Pictures ----


def draw_pictures(results, output):
    """The worst case of each scene and level, and the rates; returns (level, caption, path below the output)."""
    (output / "pictures").mkdir(exist_ok=True)
    drawn = []
    for level in LEVELS:
        found = [result for result in results if result.level == level]
        series = [result for result in found if any(figure.is_rate for figure in result.figures)]
        if series:
            pictures.draw_rates(series, output / "pictures/rates.png")
            caption = "Differences of all series; solid: multipliers on the upper or inner side"
            drawn.append((level, caption, "pictures/rates.png"))
        for result in worst_of(found):
            path = f"pictures/{level}_{result.scene}.png"
            title = result.name if level != "same_problem" else f"{result.name}, finest mesh"
            pictures.draw_case(output / result.folder, title, result.side, output / path)
            drawn.append((level, f"{result.scene}: the case nearest to its limits", path))
    return drawn


# ---- Files ----


def write_json(results, output, seconds):
    table = {
        "date": datetime.now(timezone.utc).isoformat(timespec="seconds"),
        "machine": platform.machine(),
        "seconds": seconds,
        "cases": len(results),
        "not_ok": sum(result.status != "ok" for result in results),
        "results": [result.as_table() for result in results],
    }
    (output / "report.json").write_text(json.dumps(without_nan(table), indent=1, allow_nan=False) + "\n")


def messages(results):
    return [(result.name, result.message) for result in results if result.message]


def write_markdown(results, output, seconds, drawn):
    parts = ["# mortise against FreeFEM\n", summary_line(results, seconds) + "\n"]
    parts += [f"**{name}**\n\n```\n{message}\n```\n" for name, message in messages(results)]
    for level, (title, text) in LEVELS.items():
        found = of_level(results, level)
        if not found:
            continue
        parts.append(f"## {title}\n\n{text}\n")
        if level != "timing":
            parts += ["### By scene\n", markdown_table(*worst_table(found)), "### All cases\n"]
        parts.append(markdown_table(*TABLES[level](found)))
        parts += [f"![{caption}]({path})\n" for at, caption, path in drawn if at == level]
    (output / "report.md").write_text("\n".join(parts))


def write_html(results, output, seconds, drawn):
    bad = any(result.status != "ok" for result in results)
    kind = "bad" if bad else ""
    parts = [f'<h1>mortise against FreeFEM</h1>\n<p class="{kind}">{summary_line(results, seconds)}</p>']
    for name, message in messages(results):
        parts.append(f'<h3 class="bad">{html.escape(name)}</h3><pre>{html.escape(message)}</pre>')
    for level, (title, text) in LEVELS.items():
        found = of_level(results, level)
        if not found:
            continue
        parts.append(f'<h2 id="{level}">{title}</h2>\n<p>{html.escape(text)}</p>')
        if level != "timing":
            parts += ["<h3>By scene</h3>", page.table(*worst_table(found))]
        for at, caption, path in drawn:
            if at == level:
                parts.append(f'<h3>{html.escape(caption)}</h3>\n<img src="{path}" alt="{html.escape(caption)}">')
        parts += ["<h3>All cases</h3>" if level != "timing" else "", page.table(*TABLES[level](found))]
    head = f'<meta charset="utf-8"><title>mortise against FreeFEM</title><style>{page.STYLE}</style>'
    text = f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head>\n<body>\n' + "\n".join(parts) + "\n</body></html>\n"
    (output / "report.html").write_text(text)


def write_section(results, output, seconds, drawn):
    """The part of the whole report: tables by scene, the rates and the times."""
    parts = [page.paragraph(summary_line(results, seconds))]
    for level, (title, text) in LEVELS.items():
        found = of_level(results, level)
        if not found:
            continue
        parts += [page.heading(title), page.paragraph(text)]
        heading, rows = TABLES[level](found) if level == "timing" else worst_table(found)
        parts.append(page.table(heading, [[getattr(cell, "name", cell) for cell in row] for row in rows]))
        parts += [page.picture(path, caption) for at, caption, path in drawn if at == level and "rates" in path]
    page.write_section(output, "verify", "The same scenes by FreeFEM", parts)


def write(results, output, seconds):
    """All files of the report into the folder `output`, beside the folders of the cases."""
    drawn = draw_pictures(results, output)
    write_json(results, output, seconds)
    write_markdown(results, output, seconds, drawn)
    write_html(results, output, seconds, drawn)
    write_section(results, output, seconds, drawn)
