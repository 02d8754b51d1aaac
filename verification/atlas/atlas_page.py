"""The atlas as a page: OUT/section.html, and docs/stability.md with its pictures."""

import textwrap

from PIL import Image

import atlas_runs  # makes launch and page known
import launch
import page

STATES = {
    "fixed": "does not happen: the runs do not find it",
    "default": "the defaults keep away from it",
    "guarded": "mortise refuses the scene, or a warning says so",
    "shown": "a check fails, or the status is not_converged",
    "open": "some runs are off and end as solved, without a warning that means it",
}
DOCS = launch.ROOT / "docs"
HEAD = """# Where it fails

Each method has a region where it works and a limit where it stops. This page shows the limits, why they are there,
and what mortise does about them. It is written by `./dev atlas --docs` (verification/atlas) from runs of mortise
itself, and the numbers and messages are those of that run. The states:

| state | means |
|---|---|
| fixed | does not happen: the runs do not find it |
| default | the defaults keep away from it |
| guarded | mortise refuses the scene, or a warning says so |
| shown | a check fails, or the status of the run is not_converged |
| open | some runs are off and end as solved, without a warning that means it |

Runs with the warning of p against sigma_n are often right: the meshes are coarse on purpose.

## Before any method: the audit

A scene may be solved exactly and not be the one that was meant. `mortise check` and `mortise solve` look at the outlines
of all bodies, named or not, for what a scene does not say. Refused: elements listed twice, an edge in two loads, bodies
drawn over one another (one covers more than half of the other, or reaches more than a quarter of its thickness into it
where no contact pair is). Said in one line for two bodies, with the place and what to write: boundaries that meet, or
overlap a little, where no pair stands between them (within 1 % of the edges, and what two meshes of one curve show).
After the solve: bodies that pass through one another where no pair stands between them, and contact of a pair that
reaches the end of a curve where the boundary goes on smoothly and faces the other body: the pressure would go on there
(two cylinders: peaks of 2 to 4 times the true one). Silent by intent: bodies that share nodes, an interference along a
pair, bodies with a gap between them that stays open.
"""

REFERENCES = """
## References

Beyond those of [theory.md](theory.md):

- F. Ben Belgacem, "The mortar finite element method with Lagrange multipliers", Numer. Math. 84 (1999) 173-197
- C. Bernardi, Y. Maday, A. T. Patera, "A new nonconforming approach to domain decomposition: the mortar element method",
  in: Nonlinear Partial Differential Equations and Their Applications (1994) 13-51
- F. Brezzi, M. Fortin, "Mixed and hybrid finite element methods", Springer (1991)
- P. G. Ciarlet, P.-A. Raviart, "Interpolation theory over curved elements, with applications to finite element methods",
  Comput. Methods Appl. Mech. Engrg. 1 (1972) 217-249
- J. Dundurs, M.-S. Lee, "Stress concentration at a sharp edge in contact problems", J. Elasticity 2 (1972) 109-112
- P. Farah, A. Popp, W. A. Wall, "Segment-based vs. element-based integration for mortar methods in computational contact
  mechanics", Comput. Mech. 55 (2015) 209-228
- B. Flemisch, J. M. Melenk, B. I. Wohlmuth, "Mortar methods with curved interfaces", Appl. Numer. Math. 54 (2005) 339-361
- G. H. Golub, C. F. Van Loan, "Matrix computations", Johns Hopkins University Press (1996)
- A. Greenbaum, "Iterative methods for solving linear systems", SIAM (1997)
- N. J. Higham, "Accuracy and stability of numerical algorithms", SIAM (2002)
- T. J. R. Hughes, "The finite element method", Prentice-Hall (1987)
- G. Strang, G. J. Fix, "An analysis of the finite element method", Prentice-Hall (1973)
- M. L. Williams, "Stress singularities resulting from various boundary conditions in angular corners of plates in
  extension", J. Appl. Mech. 19 (1952) 526-528
"""


def outcomes(rows):
    """How many runs ended in which way, as words."""
    counts = {}
    for row in rows:
        counts[row["outcome"]] = counts.get(row["outcome"], 0) + 1
    return ", ".join(f"{count} {outcome}" for outcome, count in sorted(counts.items(), key=lambda item: -item[1]))


def study_html(result):
    study, rows = result["study"], result["rows"]
    yield page.heading(f"{result['number']}. {study.TITLE}")
    yield page.paragraph(study.INTRODUCTION)
    yield page.picture(f"{result['name']}/picture.png", study.CAPTION)
    heading = ["what fails", "begins at", "state", "mortise"]
    yield page.table(heading, [[r["name"], r["begins"], r["state"], r["mortise"]] for r in result["regions"]])
    for region in result["regions"]:
        yield page.paragraph(f"{region['name']}: {region['why']}")
    yield page.paragraph(f"{len(rows)} runs: {outcomes(rows)}. Table: {result['name']}/rows.csv")


def write_html(folder, results, quick):
    parts = [page.paragraph("States: " + "; ".join(f"{state}: {words}" for state, words in STATES.items()) + ".")]
    if quick:
        parts.append(page.paragraph("Quick: a subset of the runs; the bounds are those of the subset."))
    for result in results:
        parts += study_html(result)
    page.write_section(folder, "atlas", "Where each method fails: the stability atlas", parts)


def wrapped(text, indent=""):
    return textwrap.fill(text, 120, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)


def study_markdown(result):
    study = result["study"]
    yield f"\n## {result['number']}. {study.TITLE}\n\n{wrapped(study.INTRODUCTION)}\n"
    yield f"![{study.TITLE}](stability/{result['name']}.png)\n\n{wrapped(study.CAPTION)}\n"
    yield "| what fails | begins at | state |\n|---|---|---|"
    yield from (f"| {r['name']} | {r['begins']} | {r['state']} |" for r in result["regions"])
    yield ""
    yield from (wrapped(f"- **{r['name']}.** {r['why']} *mortise:* {r['mortise']}", "  ") for r in result["regions"])
    yield f"\n{len(result['rows'])} runs: {outcomes(result['rows'])}."


def write_docs(folder, results):
    """docs/stability.md and docs/stability/*.png."""
    (DOCS / "stability").mkdir(exist_ok=True)
    for result in results:
        picture = Image.open(folder / result["name"] / "picture.png").convert("RGB")
        picture.quantize(64).save(DOCS / "stability" / f"{result['name']}.png", optimize=True)
    lines = [line for result in results for line in study_markdown(result)]
    (DOCS / "stability.md").write_text(HEAD + "\n".join(lines) + "\n" + REFERENCES)
