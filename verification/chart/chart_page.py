"""The chart in words and tables: OUT/section.html, and docs/charts.md with its pictures."""

import shutil
from pathlib import Path

import advice
import chart_runs  # makes launch and page known
import launch
import page
from chart_methods import PROBLEMS, TURNS, label

INTRODUCTION = (
    "Accuracy and speed, one against the other: every method on a sequence of meshes, each with elements half as wide "
    "as the one before. Upwards is the error, to the right the seconds from the mesh to recovered stresses (assembly, "
    "coupling, factorisation, solution, recovery and checks; no meshing, no writing): one thread, processor time, the "
    "median of 3 to {turns} runs that took turns. Nothing on the thick grey line is beaten in both.",
    "Curves are named by element (T3, T6 triangles of 3 and 6 nodes; Q4, Q8, Q9 quadrilaterals) and multipliers; these "
    "lie on the finer side and are integrated on segments where nothing else is said. DDM is domain decomposition, "
    "with linear multipliers and to its default tolerance. Meshes are elements along the two contact curves: 8x10 has 8 on "
    "the upper (inner) body's and 10 on the lower (outer) one's.",
    "FreeFEM's seconds are those that its scripts report, of the processor: assembly, coupling and solution, no "
    "recovery. A part of them is the coupling, written in FreeFEM's own interpreted language; the columns of "
    "chart.csv keep it apart. Its triangles are those of the curve T3, with straight sides also for P2. The "
    "manufactured problem has loads that vary from place to place, which its case files cannot say: no curves there.",
)
KNOWN = {
    "manufactured": "u, stresses and p are exact (a field without body force from Kolosov-Muskhelishvili potentials).",
    "rings": "u, stresses and p are exact (Lamé). As p is constant along the line, p comes out far better here than it "
    "does in general.",
    "parabola_1": "No exact answer: p against a reference on meshes that shrink towards the ends of the line; the "
    "energy norm as sqrt(|E - E_ref| / E_ref), E the strain energy, which is the energy norm of the error but for what "
    "the contact conditions add. At the ends p is singular and not square-integrable: p in L2 is taken without a tenth "
    "of the line at each end. Errors below the trust in the reference are not drawn. The graded mesh has as many "
    "elements as the others of its name; its columns shrink towards both ends (column i of n at (2 i / n)^3 / 2 of the "
    "width, mirrored) and its rows towards the line.",
}


def trust_lines(about, rows):
    """How far the reference can be trusted, in sentences."""
    table = about["reference"]
    trust, differences = table["trust"], table["differences"]
    largest = {key: max(float(d[key]) for d in differences.values()) for key in ("e_p_l2_inner", "e_p_max_inner")}
    yield (
        f"The reference of parabola_1 ({table['columns']} columns, {table['unknowns']} unknowns): two others of "
        f"different gradings differ from it by {largest['e_p_l2_inner']:.1e} in p (L2) and "
        f"{largest['e_p_max_inner']:.1e} (largest); trusted to twice that, {trust['e_p_l2_inner']:.1e} and "
        f"{trust['e_p_max_inner']:.1e}. Its energy, extrapolated to h = 0 (Richardson with the "
        f"measured rate, {table['energy_rates']['3']:.2f}), is "
        f"{table['energy']:.8g} J/m, trusted to {trust['energy']:.1e}, or {trust['e_energy']:.1e} in the energy norm."
    )
    yield (
        f"On even meshes the energy converges as h^{table['energy_rate_even_meshes']:.2f}: near the ends p grows as "
        f"r^{table['energy_rate_even_meshes'] / 2 - 1:.2f}."
    )
    for name, ours in (("freefem_p1", "t3_linear"), ("freefem_p2", "t6_linear")):
        pairs = [[row for row in rows if (row["problem"], row["method"]) == ("parabola_1", m)] for m in (name, ours)]
        errors = lambda row: f"{row['e_p_l2_inner'] or 0:.2e}"
        series = ", ".join(f"{theirs['mesh']} {errors(theirs)} ({errors(own)})" for theirs, own in zip(*pairs))
        if series:
            yield f"{label(name)} comes to the same reference, in p (L2; in brackets {label(ours)}): {series}."


def check_rows(checks):
    for c in checks:
        yield [
            *(c["problem"], label(c["method"]), c["mesh"], f"{c['chart']:.4f}", f"{c['process']:.4f}"),
            *(f"{c['reported']:.4f}", f"{c['ratio']:.3f}", f"{c['processor']:.4f}", f"{c['processor_ratio']:.3f}"),
        ]


CHECK_HEADING = (
    *("problem", "method", "mesh", "chart, s", "process, s", "summary.json, s", "process / chart"),
    *("processor, s", "processor / chart"),
)
CHECK_TEXT = (
    "Two of these seconds against the executable, timed from outside by the wall clock: the whole process "
    "`mortise solve --threads 1`, less the meshing and writing of its summary.json and less the {start:.2f} s in which "
    "a process that does nothing starts. And by processor time: `mortise solve` less `mortise mesh`."
)
ECONOMY_HEADING = ("study", "scene", "way", "unknowns", "steps", "seconds", "whole process, s", "difference of p")
ECONOMY_TEXT = (
    "Half of a symmetric scene against the whole (the same elements on the half, symmetry at its end), and bilateral "
    "against unilateral contact where nothing opens. Seconds from assembly to recovery, one thread, medians; the "
    "difference is the largest of p over its largest value."
)
ELEMENTS_HEADING = ("problem", "elements", "error in p at most", "mesh", "unknowns", "seconds")
ELEMENTS_TEXT = (
    "Linear or quadratic elements for a coarse answer: the quickest mesh of the chart for each. Linear ones (the "
    "better of 3 and 4 nodes) take so many times the seconds of quadratic ones (the better of 6 and 8 nodes): "
)
KINDS = (("t3_linear", "q4_linear"), ("t6_linear", "q8_linear"))


def economy_rows(rows):
    for row in rows:
        yield [
            *(row["study"], row["scene"], row["way"], row["unknowns"], row["steps"]),
            *(f"{row['seconds']:.4f}", f"{row['whole']:.3f}", f"{row['difference_of_p']:.1e}"),
        ]


def saving_lines(rows):
    """What the half model and the bilateral condition save: the ratios of the seconds."""
    for study, ways in (("half", ("whole", "half")), ("condition", ("unilateral", "bilateral"))):
        for scene in dict.fromkeys(row["scene"] for row in rows if row["study"] == study):
            full, less = (next(r for r in rows if (r["scene"], r["way"]) == (scene, way)) for way in ways)
            yield f"{scene}: {ways[1]} takes {less['seconds'] / full['seconds']:.2f} of the seconds of {ways[0]}"


def element_lines(rows):
    """How many times the seconds of the better quadratic element the better linear one takes."""
    for target in dict.fromkeys(row["target"] for row in rows):
        ratios = []
        for problem in dict.fromkeys(row["problem"] for row in rows):
            mine = [r for r in rows if (r["problem"], r["target"]) == (problem, target) and "seconds" in r]
            least = [min((r["seconds"] for r in mine if r["method"] in kinds), default=None) for kinds in KINDS]
            ratios.append(f"{problem} {least[0] / least[1]:.2g}" if all(least) else f"{problem}: not reached by both")
        yield f"{advice.percent(target)} in p: {', '.join(ratios)}"


def element_rows(rows):
    for row in rows:
        seconds = f"{row['seconds']:.4f}" if "seconds" in row else ""
        mesh = row.get("mesh", "not reached")
        yield [
            *(row["problem"], label(row["method"]), advice.percent(row["target"])),
            *(mesh, row.get("unknowns", ""), seconds),
        ]


def machine_line(about):
    m = about["machine"]
    return (
        f"{m['processor']}, {m['cores']} cores (load {m['load_average']:.1f} at the end of the run), {m['mortise']} at "
        f"{m['commit']}, FreeFEM {m['freefem']}, {m['date'][:10]}. The wall clock went "
        f"{about['wall_over_processor'] or 1:.2f} times as fast as the processor's (median of the runs of 10 ms and "
        "more); where that is well above 1, other work disturbed the run."
    )


def contents(rows, about, checks, economy, elements):
    """Everything in order, as pairs of a kind and its content; details are for the section, not for docs/charts.md."""
    yield from (("text", text.format(turns=TURNS["full"])) for text in INTRODUCTION)
    yield "heading", "What to use"
    yield "table", (advice.HEADING, list(advice.table(rows)))
    yield from (("text", sentence) for sentence in advice.recommendation(rows))
    if checks:
        own = max(check["start"] for check in checks)
        yield "text", (
            f"Where seconds are below about 0.1, starting the program ({own:.2f} s here), meshing and writing take "
            "longer than the solution: there a finer mesh and the default method cost nothing that one would notice."
        )
    for problem in (p for p in PROBLEMS if any(row["problem"] == p for row in rows)):
        yield "heading", PROBLEMS[problem]["title"]
        yield "text", KNOWN[problem]
        yield "picture", (f"{problem}.png", PROBLEMS[problem]["title"] + ": errors against seconds")
    yield from (("text", line) for line in trust_lines(about, rows))
    yield from (("text", f"Left out: {label(name)}: {said}") for name, said in about["left_out"].items())
    yield "heading", "Are the seconds right?"
    if checks:
        yield "text", CHECK_TEXT.format(start=max(check["start"] for check in checks))
        yield "table", (CHECK_HEADING, list(check_rows(checks)))
    yield "text", machine_line(about)
    yield "heading", "Model no more than a scene needs"
    yield "text", ECONOMY_TEXT
    yield "table", (ECONOMY_HEADING, list(economy_rows(economy)))
    yield "text", "; ".join(saving_lines(economy)) + "."
    yield "text", ELEMENTS_TEXT + "; ".join(element_lines(elements)) + "."
    yield "details", (ELEMENTS_HEADING, list(element_rows(elements)))


def write_html(output, parts, rates):
    as_html = {
        "text": page.paragraph,
        "heading": page.heading,
        "table": lambda content: page.table(*content),
        "details": lambda content: page.table(*content),
        "picture": lambda content: page.picture(*content),
    }
    body = [as_html[kind](content) for kind, content in parts]
    heading = ("problem", "method", "p, L2", "energy norm", "p, largest")
    body += [page.heading("Rates of the last halving"), page.table(heading, rates)]
    page.write_section(output, "chart", "Accuracy against speed", body)


def markdown_table(heading, rows):
    line = lambda cells: "| " + " | ".join(map(str, cells)) + " |"
    return "\n".join([line(heading), "|" + "---|" * len(heading), *map(line, rows)]) + "\n"


def write_docs(output, parts):
    """docs/charts.md, and its pictures in docs/charts/."""
    folder = launch.ROOT / "docs/charts"
    folder.mkdir(exist_ok=True)
    text = ["# Accuracy against speed\n"]
    for kind, content in parts:
        if kind == "picture":
            shutil.copy(output / content[0], folder / Path(content[0]).name)
            text.append(f"![{content[1]}](charts/{content[0]})\n")
        elif kind == "table":
            text.append(markdown_table(*content))
        elif kind != "details":
            text.append(f"## {content}\n" if kind == "heading" else f"{content}\n")
    text.append(
        "## To have it again\n\n`./dev chart --docs` measures, draws and writes this page (at most 15 minutes on an "
        "idle machine of\n2 cores; it goes on where it was stopped). All figures are in `out/chart/chart.csv`.\n"
    )
    (launch.ROOT / "docs/charts.md").write_text("\n".join(text))
