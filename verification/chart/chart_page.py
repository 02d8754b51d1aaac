"""The chart in words and tables (chart_texts.md): OUT/chart.md, and docs/chart.md with its pictures."""

import advice
import economy
import page
import template
from advice import TEXTS, of_problem
from chart_methods import PROBLEMS, TURNS, label
from template import percent

CHECKS = {"chart, s": "chart", "process, s": "process", "summary.json, s": "reported", "process / chart": "ratio",
          "processor, s": "processor", "processor / chart": "processor_ratio"}  # fmt: skip
ECONOMY = ("study", "scene", "way", "unknowns", "steps", "seconds", "whole process, s", "difference of p")
ELEMENTS = ("problem", "elements", "error in p at most", "mesh", "unknowns", "seconds")
RATES = ("problem", "method", "p, L2", "energy norm", "p, largest")
KINDS = (("t3_linear", "q4_linear"), ("t6_linear", "q8_linear"))


def same_reference(rows):
    """FreeFEM's errors on parabola_1 beside those of the same triangles."""
    error = lambda row: f"{row['e_p_l2_inner'] or 0:.2e}"
    for name, ours in (("freefem_p1", "t3_linear"), ("freefem_p2", "t6_linear")):
        pairs = zip(*(of_problem(rows, "parabola_1", method) for method in (name, ours)))
        series = ", ".join(f"{theirs['mesh']} {error(theirs)} ({error(own)})" for theirs, own in pairs)
        if series:
            yield template.fill(TEXTS["same reference"], theirs=label(name), ours=label(ours), series=series)


def check_table(checks):
    texts = lambda c: [f"{c[key]:.3f}" if "ratio" in key else f"{c[key]:.4f}" for key in CHECKS.values()]
    rows = [[c["problem"], label(c["method"]), c["mesh"], *texts(c)] for c in checks]
    return template.table(["problem", "method", "mesh", *CHECKS], rows)


def economy_table(rows):
    return template.table(ECONOMY, [
        [*(row[key] for key in ("study", "scene", "way", "unknowns", "steps")), f"{row['seconds']:.4f}",
         f"{row['whole']:.3f}", f"{row['difference_of_p']:.1e}"]
        for row in rows
    ])  # fmt: skip


def savings(rows):
    """What the half model and the bilateral condition save: the ratios of the seconds."""
    for full, less in zip(rows[::2], rows[1::2]):
        share = less["seconds"] / full["seconds"]
        yield f"{full['scene']}: {less['way']} takes {share:.2f} of the seconds of {full['way']}"


def element_lines(rows):
    """How many times the seconds of the better quadratic element the better linear one takes."""
    for target in dict.fromkeys(row["target"] for row in rows):
        ratios = []
        for problem in dict.fromkeys(row["problem"] for row in rows):
            mine = [r for r in of_problem(rows, problem) if r["target"] == target and "seconds" in r]
            least = [min((r["seconds"] for r in mine if r["method"] in kinds), default=None) for kinds in KINDS]
            ratios.append(f"{problem} {least[0] / least[1]:.2g}" if all(least) else f"{problem}: not reached by both")
        yield f"{percent(target)} in p: {', '.join(ratios)}"


def element_table(rows):
    seconds = lambda row: f"{row['seconds']:.4f}" if "seconds" in row else ""
    return template.table(ELEMENTS, [
        [row["problem"], label(row["method"]), percent(row["target"]), row.get("mesh", "not reached"),
         row.get("unknowns", ""), seconds(row)] for row in rows
    ])  # fmt: skip


def contents(rows, about, checks, saved):
    """The page as Markdown, its pictures beside it."""
    table, trust, differences = about["reference"], about["reference"]["trust"], about["reference"]["differences"]
    largest = lambda key: max(d[key] for d in differences.values())
    left_out = [template.fill(TEXTS["left out"], name=label(n), said=s) for n, s in about["left_out"].items()]
    machine = {key: value for key, value in about["machine"].items() if key not in ("system", "threads")}
    return template.fill(
        TEXTS["page"], turns=TURNS["full"], advice=template.table(advice.HEADING, advice.table(rows)),
        recommendation="\n\n".join(advice.recommendation(rows)), start=max(check["start"] for check in checks),
        **{problem: known["title"] for problem, known in PROBLEMS.items()},
        columns=table["columns"], unknowns=table["unknowns"], energy=table["energy"],
        off_l2=largest("e_p_l2_inner"), off_max=largest("e_p_max_inner"), trust_l2=trust["e_p_l2_inner"],
        trust_max=trust["e_p_max_inner"], trust_energy=trust["energy"], trust_norm=trust["e_energy"],
        energy_rate=table["energy_rates"]["3"], even_rate=table["energy_rate_even_meshes"],
        singular=table["energy_rate_even_meshes"] / 2 - 1,
        same_reference="\n\n".join([*same_reference(rows), *left_out]), checks=check_table(checks), wall=about["wall"],
        **machine, economy=economy_table(saved), savings="; ".join(savings(saved)),
        elements="; ".join(element_lines(list(economy.elements(rows)))),
    )  # fmt: skip


def write(output, rows, text, docs):
    """The page, in the report with the tables of elements and of rates; in docs/ with how to have it again."""
    rates = "### Rates of the last halving\n\n" + template.table(RATES, advice.rates(rows))
    page.write(output, "chart", "\n\n".join([text, element_table(list(economy.elements(rows))), rates]))
    if docs:
        page.write_docs(output, "chart", f"{text}\n\n{TEXTS['again']}\n")
