#!/usr/bin/python3
"""One page of a run, to hand over: what was modelled, how good the answer is and how that is known; pictures, tables, checks,
warnings and the scene itself. A single HTML file without links to others, for a screen (light or dark) and for paper.

Usage: report.py FOLDER [PAGE.html] (mortise report does the same). FOLDER is one that `mortise solve` or `mortise certify` wrote.
"""

import csv
import datetime
import html
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "pictures"))
from script import Parser, run

STYLE = """
:root { color-scheme: light dark; --paper: #fff; --ink: #1a1a1a; --soft: #5c5c5c; --line: #d5d5d5;
  --good: #1a7f37; --bad: #c00000; --blue: #0b4f9c; --red: #b00020 }
@media (prefers-color-scheme: dark) { :root { --paper: #16181b; --ink: #e6e6e6; --soft: #a0a0a0; --line: #3a3d42;
  --good: #57c274; --bad: #ff7b72; --blue: #79b8ff; --red: #ff7b72 } }
body { margin: 0 auto; max-width: 70rem; padding: 1.2rem; background: var(--paper); color: var(--ink);
  font: 15px/1.45 system-ui, sans-serif }
h1 { font-size: 1.5rem; margin: 0 0 .3rem } h2 { font-size: 1.1rem; margin: 1.8rem 0 .5rem } p, ul { margin: .4rem 0 }
.verdict { font-size: 1.1rem; border-left: 5px solid var(--good); padding: .1rem .8rem } .bad { border-color: var(--bad) }
.no, .bad b { color: var(--bad); font-weight: 600 } .soft, figcaption { color: var(--soft); font-size: .87rem }
.first { display: grid; grid-template-columns: minmax(0, 1fr) minmax(0, 1fr); gap: 0 2rem }
figure { margin: .6rem 0; break-inside: avoid } figure svg { width: 100%; height: auto; max-height: 85vh; fill: var(--ink) } figure.tall svg { max-height: none }
.sheet { --paper: #fff; --ink: #1a1a1a; --blue: #0b4f9c; --red: #b00020 } .sheet svg { background: #fff }
table { margin-bottom: .8rem; border-collapse: collapse; font-size: .87rem; font-variant-numeric: tabular-nums } tr { break-inside: avoid }
.wide { overflow-x: auto } th, td { padding: .15rem .8rem .15rem 0; border-bottom: 1px solid var(--line); text-align: left }
dl { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: .15rem 1rem; margin: .5rem 0 } dt { color: var(--soft) }
dd { margin: 0; overflow-wrap: anywhere } pre { white-space: pre-wrap; overflow-wrap: anywhere; font-size: .8rem;
  border: 1px solid var(--line); padding: .6rem }
@media (max-width: 800px) { .first { grid-template-columns: minmax(0, 1fr) } }
@media print { :root { --paper: #fff; --ink: #000; --soft: #444; --line: #ccc; --good: #1a7f37; --bad: #c00000; --blue: #0b4f9c;
  --red: #b00020 }
  figure svg { max-height: 100mm } figure.tall svg { max-height: 225mm } body { padding: 0; font-size: 9.5pt } h2 { break-after: avoid } @page { margin: 16mm } }
"""
PROBES_SHOWN = 20
COARSE = 0.1  # error of p from which on the program warns: where no accuracy was asked, a page with more is not green


def text(value):
    return html.escape(str(value))


def number(value, digits=5):
    return "–" if value is None else text(f"{value:.{digits}g}") if isinstance(value, (int, float)) else text(value)


def percent(part):
    return "more than 1000 %" if part > 10 else f"{round(10 * part) * 10} %" if part >= 0.995 else f"{100 * part:.2g} %"


def vector(values, digits=5):
    """With zeros for what is round-off of the largest."""
    if values is None:
        return "–"
    least = 1e-10 * max(abs(value) for value in values)  # as the program's checks of balance
    return "(" + ", ".join(number(value if abs(value) > least else 0, digits) for value in values) + ")"


def table(head, rows):
    """Rows of cells that are HTML already; nothing without rows."""
    if not rows:
        return ""
    cells = lambda row, tag: "<tr>" + "".join(f"<{tag}>{cell}</{tag}>" for cell in row) + "</tr>"
    return f'<div class="wide"><table>{cells(head, "th")}{"".join(cells(row, "td") for row in rows)}</table></div>'


def section(title, *parts):
    parts = [part for part in parts if part]
    return f"<section><h2>{title}</h2>{''.join(parts)}</section>" if parts else ""


def listed(words):
    return "<ul>" + "".join(f"<li>{text(line)}</li>" for line in words) + "</ul>" if words else ""


def holds(is_so, yes="holds", no="does not hold"):
    return yes if is_so else f'<span class="no">{no}</span>'


# ---- Pictures ----


def inline(svg):
    """A picture of matplotlib inside a page, in the page's ink and on its paper."""
    svg = re.sub(r"^.*?(?=<svg)", "", svg, flags=re.DOTALL)
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    svg = re.sub(r' d="[^"]*"', lambda path: re.sub(r"(\.\d\d)\d+", r"\1", path[0]), svg)  # hundredths of a point are enough
    svg = re.sub(r'(<svg[^>]*?) width="[^"]*"', r"\1", re.sub(r'(<svg[^>]*?) height="[^"]*"', r"\1", svg, count=1), count=1)
    return re.sub("#(000000|111111)", "var(--ink)", svg).replace("#ffffff", "var(--paper)").replace("#0b4f9c", "var(--blue)").replace("#b00020", "var(--red)")


def figure(caption, command, folder, options=()):
    """What a command draws into a picture that it is given behind its words; in words, why there is none."""
    picture = Path(folder) / "picture.svg"
    picture.unlink(missing_ok=True)
    ended = subprocess.run([*command, picture, *options], capture_output=True, text=True)
    if ended.returncode or not picture.exists():
        said = (ended.stderr.strip() or "no picture").splitlines()[-1]
        return f'<p class="soft">{text(caption)}: not drawn ({text(said)})</p>'
    drawn = inline(picture.read_text())
    width, height = map(float, re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', drawn).groups())
    kind = "sheet" if "--picture" in command else "tall" if height > 1.4 * width else "whole"  # sheet: names stand on pale bodies there
    return f'<figure class="{kind}">{drawn}<figcaption>{text(caption)}</figcaption></figure>'


# ---- Words ----


def verdict(s, certificate):
    """In a sentence; whether it is good."""
    failed = [check["name"] for check in s["checks"] if not check["ok"]]
    told = (s["estimate"] or {}).get("pressure")
    coarse = told is not None and not told["error"] <= COARSE and not s["accuracy"]
    words = [s["status"].replace("_", " ").capitalize() + (f" ({s['accuracy']['reason']})" if (s["accuracy"] or {}).get("reason") else "")]
    if told:
        asked = f", {percent(s['accuracy']['asked'])} were asked" if s["accuracy"] else ""
        only = " only: the mesh is too coarse for it" if coarse else ""
        words.append(f"the contact pressure is within {percent(told['error'])} along the lines (estimated{asked}){only}")
    moved = s.get("large_displacement") or 0
    if moved > max(told["error"] if told else 0, COARSE):
        words.append(f"displacements are so large that it may be off by {percent(moved)}")
    words.append(f"not all checks hold: {', '.join(failed)}" if failed else f"all {len(s['checks'])} checks hold")
    if certificate:
        apart = [row for row in certificate["figures"] if row["of_normals"]]
        agreed = "agree within the bars" + (", but for which curve's normals p acts along" if apart else "")
        words.append("other meshes, side and solver " + (agreed if certificate["agrees"] else "do not agree"))
    return "; ".join(words) + ".", s["status"] == "solved" and not coarse and not moved > COARSE and (not certificate or certificate["agrees"])


def material_words(name, material):
    told = {key: value for key, value in material.items() if value or key == "poisson"}
    of = lambda value: f"{value:g}" if isinstance(value, (int, float)) else str(value)
    return f"{name}: " + ", ".join(f"{key.replace('_', ' ')} {of(value)}" for key, value in told.items())


def model_words(s):
    model = s["model"]
    bodies = list(model["bodies"].items()) if isinstance(model["bodies"], dict) else [(b["name"], b["material"]) for b in model["bodies"]]
    yield "model", f"plane {model['plane']}" if model["plane"] != "axisymmetric" else "axisymmetric"
    yield "bodies", ", ".join(f"{name} ({material})" for name, material in bodies[:8]) + (f" and {len(bodies) - 8} more" * (len(bodies) > 8))
    for name, material in model["materials"].items():
        yield "material", material_words(name, material)
    alike = {}
    for pair, condition in zip(s["contact"], s["method"]["condition"]):
        alike.setdefault(f"{condition}, frictionless, gap {pair['gap']}", []).append(" – ".join(pair["between"]))
    for kind, names in alike.items():
        yield "contact", f"{names[0] if len(names) == 1 else f'{len(names)} pairs, such as {names[0]}'}: {kind}"
    size = f"{s['mesh']['nodes']} nodes, {s['mesh']['dofs']} unknowns, {s['mesh']['multipliers']} multipliers"
    yield "mesh", size
    yield "left out", "friction, large displacements, plasticity, time"


def known_words(s, certificate):
    """How one knows, in short."""
    sums = [s["balance"][key]["force"] for key in ("loads", "reactions")]
    if s["model"]["plane"] == "axisymmetric":  # what acts along the radius balances itself round the axis
        yield "balance", f"along the axis: loads {number(sums[0][1], 4)}, reactions {number(sums[1][1], 4)}"
    else:
        yield "balance", f"loads {vector(sums[0], 4)}, reactions {vector(sums[1], 4)}"
    pairs = sorted(enumerate(s["contact"]), key=lambda pair: -pair[1]["pressure"]["max"])
    for k, pair in pairs[:3]:
        unbounded = any(at["pair"] == k and at["unbounded"] for at in ((s["estimate"] or {}).get("pressure") or {}).get("singular", []))
        bar = pair["pressure"].get("max_error")
        largest = f"{number(pair['pressure']['max'])}, which has no limit" if unbounded else number(pair["pressure"]["max"]) + (f" ± {number(bar, 2)}" if bar else "")
        yield "pressure", f"{' – '.join(map(text, pair['between']))}: mean {number(pair['pressure']['mean'])}, largest {largest}"
    if len(pairs) > 3:
        yield "pressure", f"and {len(pairs) - 3} more pairs with less"
    if s["accuracy"]:
        yield "meshes", f"{len(s['accuracy']['solves'])} solved, each finer where the error came from"
    if certificate:
        counted = [run["what"] for run in certificate["runs"][1:] if run["status"] not in ("skipped", "failed")]
        yield "confirmed by", text(", ".join(counted))
    else:
        yield "confirmed by", "no other run; <code>mortise certify</code> makes some"
    closes = ", p ≥ 0, no overlap" * ("unilateral" in s["method"]["condition"])
    yield "checked", f"equilibrium of each body{', contact forces equal and opposite' * bool(s['contact'])}{closes} (table below)"
    more = f" (and {len(s['warnings']) - 1} more below)" if len(s["warnings"]) > 1 else ""
    yield "warnings", text(s["warnings"][0]) + more if s["warnings"] else "none"


def described(pairs, escape=True):
    return "<dl>" + "".join(f"<dt>{term}</dt><dd>{text(words) if escape else words}</dd>" for term, words in pairs) + "</dl>"


# ---- Tables ----


def on(entry):
    return text(", ".join(entry["on"]) if isinstance(entry.get("on"), list) else entry.get("on", entry.get("body", "all bodies")))


def force_tables(s):
    loads = [[on(load), text(load.get("words", "")), vector(load.get("sum")), number(load.get("moment"))] for load in s["model"]["loads"]]
    supports = [[on(entry), text(entry.get("words", "")), vector(entry.get("reaction")), number(entry.get("moment"))] for entry in s["model"]["supports"]]
    return table(["load on", "", "sum", "moment about the origin"], loads), table(["support on", "", "reaction", "moment"], supports)


def pair_table(s):
    rows = []
    for pair in s["contact"]:
        length = f"{number(pair['length_in_contact'])} ± {number(pair['length_in_contact_error'], 2)}"
        p = pair["pressure"]
        rows.append([text(" – ".join(pair["between"])), vector(pair["force"]), vector(pair["force_error"], 2), length, number(p["mean"]), number(p["max"])])
    return table(["pair", "force", "its bar", "length in contact", "mean p", "largest p"], rows)


def probe_table(path):
    if not path.exists():
        return ""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    names = ("u_x", "u_y", "sigma_11", "sigma_22", "sigma_12")
    figure_of = lambda row, name: f"{float(row[name]):.5g}" + (f" ± {float(bar):.2g}" if (bar := row.get(f"{name}_error")) else "")
    shown = [[text(row["body"]), f"({float(row['x']):.5g}, {float(row['y']):.5g})", *(figure_of(row, n) for n in names)] for row in rows[:PROBES_SHOWN]]
    more = f'<p class="soft">and {len(rows) - PROBES_SHOWN} more in probes.csv</p>' if len(rows) > PROBES_SHOWN else ""
    return table(["body", "place", *names], shown) + more


def extreme_rows(s):
    e = s["extremes"]
    place = lambda at: f"{text(at['body'])}, {vector(at['position'])}"
    limit = "" if e["von_mises"]["limit"] else " (no limit there: it grows with every finer mesh)"
    return [
        ["von Mises stress", number(e["von_mises"]["value"]) + limit, place(e["von_mises"])],
        ["largest principal stress", number(e["principal"]["max"]["value"]), place(e["principal"]["max"])],
        ["smallest principal stress", number(e["principal"]["min"]["value"]), place(e["principal"]["min"])],
        ["displacement", number(e["displacement"]), ""],
    ]


def certificate_section(c):
    figures = [
        [text(r["figure"]) + (f' <span class="soft">worst of {r["count"]}</span>' if r["count"] > 1 else ""), number(r["value"], 6),
         number(r["bar"], 2), number(r["off"], 2), number(r["allowed"], 2), text(r["run"]), number(r["of_normals"] or None, 2),
         holds(r["agrees"], "agrees", "does not agree")]
        for r in c["figures"]
    ]  # fmt: skip
    runs = [[text(r["name"]), text(r["what"]), text(r["status"].replace("_", " ")), number(r["unknowns"], 9), f"{r['seconds']:.1f}"] for r in c["runs"]]
    study = [
        [text(r["run"]), number(r["unknowns"], 9), percent(r["estimated"]), number(r["off"], 2), number(r["rate"], 2)] for r in c["study"]
    ]
    gap = c["deformed_gap"]
    gaps = "" if gap is None else (
        f"<p>Where p acts the deformed sides are apart by {percent(gap['off'])} of the largest displacement ({percent(gap['allowed'])} expected), "
        f"their normals by {gap['tilt']:.2g} radians.</p>"
    )  # fmt: skip
    if stress := c["stress_difference"]:
        gaps += f"<p>p is off from the stresses of the nearer body by {percent(stress['off'])} ({percent(stress['allowed'])} expected).</p>"
    return section(
        "Confirmed by other means",
        table(["figure", "value", "bar", "off by", "both bars", "in", "by the other curve's normals", ""], figures),
        table(["run", "what differs", "status", "unknowns", "seconds"], runs),
        table(["mesh", "unknowns", "p estimated within", "rms of p off the finest", "falls as the estimate to the power"], study),
        gaps,
        listed([f"not confirmed: {words}" for words in [*c["troubles"], *c["skipped"], *c["left_out"]]]),
    )


# ---- The page ----


def scene_file(folder, scene):
    """The scene by its name in the summary, which is from where the run was started: most often above its results."""
    places = [start / scene for start in (*folder.resolve().parents, Path())]
    return next((path for path in places if path.is_file()), Path(scene))


def scene_text(path):
    try:
        return f"<pre>{text(path.read_text())}</pre>"
    except (OSError, ValueError):
        return f'<p class="no">{text(path)} cannot be read any more</p>'


def page_of(folder, certificate, mortise):
    """The whole page."""
    s = json.loads((folder / "summary.json").read_text())
    title = (s["title"] or s["scene"]) + (f", case {s['case']}" if s.get("case") else "")
    scene = scene_file(folder, s["scene"])
    words, good = verdict(s, certificate)
    picture = [sys.executable, Path(__file__).resolve().parents[1] / "pictures/picture.py", folder]
    with tempfile.TemporaryDirectory() as at:
        changes = [word for change in s.get("changes", []) for word in ("--set", change)]
        changes += ["--case", s["case"]] if s.get("case") else []
        setup = figure("The set-up", [mortise, "check", scene, *changes, "--quiet", "--no-programs", "--picture"], at)
        dots = ["--dpi", "100"]  # of the bodies' colours
        whole = figure("Deformed bodies; p along the contact lines with its bar", picture, at, dots)
        zoomed = figure("Where contact carries pressure", picture, at, ["--zoom=contact", "--bodies", *dots]) if s["contact"] else ""
    solves = [[number(v["unknowns"], 9), percent(v["estimated"]), f"{v['seconds']:.2f}"] for v in (s["accuracy"] or {}).get("solves", []) if v["estimated"] is not None]
    checks = [[text(c["name"]), number(c["value"], 2), number(c["limit"], 2), holds(c["ok"])] for c in s["checks"]]
    expected = [
        [text(e["figure"]), text(e["value"]), number(e["found"]), "–" if e["off"] is None else percent(e["off"]), percent(e["tolerance"]), text(e["source"] or "")]
        for e in s.get("expected", [])
    ]  # fmt: skip
    body = [
        f"<header><h1>{text(title)}</h1><p class='verdict{'' if good else ' bad'}'>{text(words)}</p></header>",
        f"<div class='first'><div><h2>What was modelled</h2>{described(model_words(s))}</div>"
        f"<div><h2>How good it is, and how one knows</h2>{described(known_words(s, certificate), False)}</div></div>",
        setup,
        section("Result", whole, zoomed),
        section("Forces and contact", *force_tables(s), pair_table(s)),
        section("Extremes and probes", table(["largest", "value", "where"], extreme_rows(s)), probe_table(folder / "probes.csv")),
        certificate_section(certificate) if certificate else "",
        section("Meshes on the way to the accuracy", table(["unknowns", "estimated error", "seconds"], solves)),
        section("What the scene expects", table(["figure", "expected", "found", "off", "tolerance", "source"], expected)),
        section("Checks", table(["check", "value", "limit", ""], checks)),
        section("Warnings", listed(s["warnings"]) or "<p>None.</p>"),
        section("Versions", f"<p>mortise {text(s['version'])}; {text(s['dense_kernel'])}; page of {datetime.date.today()}</p>"),
        section("The scene", f'<p class="soft">{text(" ".join([s["scene"], *(f"--set {change}" for change in s.get("changes", []))]))}</p>', scene_text(scene)),
    ]
    head = f'<meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1"><title>{text(title)}</title>'
    return f'<!doctype html>\n<html lang="en"><head>{head}<style>{STYLE}</style></head><body>{"".join(body)}</body></html>\n'


def write_report(folder, page, mortise):
    """The report of a folder of `solve` or `certify`."""
    certificate = folder / "certificate.json"
    found = json.loads(certificate.read_text()) if certificate.is_file() else None
    page.write_text(page_of(folder / "own" if found else folder, found, mortise))


def main():
    parser = Parser(__doc__, prog="mortise report")
    parser.add_argument("folder", type=Path, help="that mortise solve or mortise certify wrote")
    parser.add_argument("page", type=Path, nargs="?", help=".html (default: FOLDER.html)")
    options = parser.parse_args()
    if not any((options.folder / name).is_file() for name in ("summary.json", "certificate.json")):
        parser.error(f"{options.folder}: no summary.json there; expected the folder of a run of mortise solve or certify")
    if (options.folder / "cases.csv").is_file():
        parser.error(f"{options.folder}: the cases of a scene; expected one of the folders cases/NAME in it, which [cases] write = \"contact\" or \"all\" makes")
    page = options.page or options.folder.with_name(options.folder.resolve().name + ".html")
    if page.suffix != ".html":
        parser.error(f"{page}: expected a name that ends in .html")
    try:
        write_report(options.folder, page, os.environ.get("MORTISE_PROGRAM", "mortise"))
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise SystemExit(f"report.py: {options.folder}: no report of it ({type(error).__name__}: {error})") from None
    print(page)


if __name__ == "__main__":
    run(main)
