"""The study in words and tables: summary, Markdown and the section of the report."""

import cause
import gallery
import page
import preprint
import tables

MEASURE = (
    "delta, eq. (28) of the preprint: the mean over a body's contact line, without its first and last element, of "
    "|sigma_2 - s| / |s|, s from matching meshes. G1 is the upper, G2 the lower body; a mesh is n_upper x "
    "n_lower."
)
OURS = (
    "Ours: 8-node quadrilaterals and quadratic multipliers, as the preprint; segments; a closed gap. 'better': "
    "the smaller of both multiplier sides; 'best': the smallest of both sides and of quadratic and linear "
    "multipliers; 'our default': linear multipliers on the finer side."
)
SIGN = (
    "The shear term of the preprint's eq. (26) has the wrong sign: with w the angle of the tangent, n.sigma.n "
    "(theory, eq. 21) has - 2 tau_12 sin w cos w. Ours is n.sigma.n. delta is taken of sigma_2 and does not "
    "depend on it."
)
GAP = (
    "A quadratic edge with its nodes evenly on a curve misses it by up to |kappa'| h^3 / (72 sqrt 3), kappa' the "
    "change of curvature with arc length: zero on a circle, where only h^4 is left, not on a parabola. Two meshes "
    "that do not match then show a gap between them. Enforced as if real, it makes the stress swing by about E g0 "
    "/ h: four times less on half the mesh width. The table has the gap as the meshes have it, this prediction, E "
    "g0 / h on the finer mesh, and the swing of sigma_n on G2 with the multipliers there and the gap enforced on "
    "segments."
)
FITS = (
    "A variant 'fits' if on the parabolas the median of variant/printed is within a factor of {factor}, three "
    "rows in four are, and the median factor between a mesh and the next is {low} to {high}. Printed: {printed}."
)
SHOWN = (
    "Shown, with everything else the same: on segments, enforcing the gap between the meshes raises delta on the "
    "parabolas more than tenfold in the median and leaves the circle as it is (straight lines have no gap); what "
    "it adds falls by about four from mesh to mesh; both as printed. With a closed gap no variant has either. "
    "Second-order nodes at the middles of straight edges make delta a hundred times too large and more, on the "
    "circle too, and it falls by two: the preprint's lie on the curve. Nodes even in arc length or in x1 make no "
    "difference that the tables tell."
)
GUESS = (
    "A guess: that the preprint enforced this gap (its figures point there, no word of its text that we know), how "
    "it integrated, and how it took nodal stresses. With segments and stresses taken at the nodes themselves order "
    "and factor are met and the size to a factor of 2 in the median, but with a wide spread. On whole edges "
    "without cutting more rows are met in size, but their own error does not fall with h, which the preprint's "
    "tents and circle deny. Which side 'active' means stays open: the parabolas speak for the opposite side, the "
    "circle on segments for the multiplier side."
)


def place(row):
    return f"table {row['table']}, {row['scene']} {row['mesh']} {row['at']}, {row['active']} active, on {row['body']}"


def required(rows):
    """Is ours at most the printed figure?"""
    for at in dict.fromkeys(row["at"] for row in rows):
        targets = [row for row in rows if row["target"] and row["at"] == at]
        better, best = (len(targets) - len(tables.exceptions(targets, name)) for name in ("better", "best"))
        yield (
            f"{at}: ours is at most the printed figure in {better} of {len(targets)} target rows on the better side, "
            f"in {best} with linear multipliers too (best)"
        )
    for row in tables.exceptions(rows):
        yield (
            f"exception: {place(row)}: printed {row['printed']:.3g}, better {row['better']:.3g}, best "
            f"{row['best']:.3g}; {100 * row['better_share_of_worst']:.0f} % of ours comes from 6 places, beside the "
            "ends or the kink"
        )


def is_number(value):
    return value == value  # not NaN


def verdict_on_the_cause(best, printed):
    """The variant nearest to the printed parabola rows, with what it meets and what it misses."""
    words = "fits the printed parabola rows" if best["fits"] else "comes nearest to the parabola rows, but none fits"
    pairs = [f"{name} {best[name]:.2g} (printed {printed[name]:.2g})" for name in printed if is_number(best[name])]
    sizes = ", ".join(f"{series} {best[f'ours/printed, {series}']:.2g}" for series in preprint.SERIES)
    yield (
        f"cause: '{best['variant']}', where '{best['reading']}', {words}: median of variant/printed {sizes}; "
        f"{100 * best['parabolas: rows within 3']:.0f} % of the parabola rows within a factor of 3; {', '.join(pairs)}"
    )
    if not is_number(best["factor between meshes"]):
        yield "one mesh only: whether a variant fits needs the factor between meshes, that is the full study"


def trend(best, printed):
    """The variant nearest in size, order and factor together."""
    order, factor = ("parabolas over circle", "factor between meshes")
    return (
        f"nearest in size, order and factor together is '{best['variant']}', '{best['reading']}': median of "
        f"variant/printed on the parabolas {best['ours/printed, parabolas']:.2g}, "
        f"{100 * best['parabolas: rows within 3']:.0f} % of the rows within a factor of 3, parabolas over circle "
        f"{best[order]:.2g} (printed {printed[order]:.2g}), factor "
        f"between meshes {best[factor]:.2g} (printed {printed[factor]:.2g}), rank correlation "
        f"{best['parabolas: rank correlation']:.2g}"
    )


def summary(found):
    """Lines: the required results and the verdict on the cause."""
    yield from required(found["rows"])
    for row in tables.ratios(found["rows"]):
        yield (
            f"median of printed/ours, {row['series']} ({row['rows']} rows): {row['better']:.3g} (better side), "
            f"{row['best']:.3g} (best), {row['default']:.3g} (our default)"
        )
    yield from verdict_on_the_cause(found["best"], found["printed"])
    others = [f"'{v['variant']}', '{v['reading']}'" for v in found["verdicts"] if v["fits"] and v is not found["best"]]
    if others:
        yield "also fit: " + "; ".join(others)
    if found["trend"]:
        yield "cause: " + trend(found["trend"], found["printed"])
    claims = [row["holds"].split("; ") for row in found["gallery"]]
    theirs = [words[-1].endswith("it holds") for words in claims if len(words) == 2]
    yield (
        f"gallery: what the preprint says holds in our results for {sum(words[0] == 'holds' for words in claims)} of "
        f"{len(claims)} figures; by the variant for {sum(theirs)} of {len(theirs)}"
    )


def parts(found):
    """Headings, texts, tables and pictures, in order, for both formats."""
    yield "text", MEASURE
    yield "text", OURS
    yield "picture", ("tables.png", "delta of every target row, ours (better side) over the printed figure.")
    yield "heading", 'What "active" means: fit of both readings'
    yield "text", "Median and standard deviation of log10(ours/printed), share within 3, rank correlation (Spearman)."
    yield "table", tables.as_table(list(tables.fits(found["rows"])))
    yield "heading", "Why the preprint's stresses oscillate"
    yield "text", GAP
    yield "table", tables.as_table(found["gaps"])
    yield "picture", ("curves.png", "sigma_n on parabola 2: ours, and with the meshes' gap enforced.")
    yield "picture", ("variants.png", "Target rows by variant, in the reading that fits the parabolas better.")
    yield "picture", ("meshes.png", "delta over the mesh: geometric mean of the four rows of a scene.")
    low, high = cause.BETWEEN_MESHES
    figures = ", ".join(f"{name} {value:.2g}" for name, value in found["printed"].items() if is_number(value))
    yield "text", FITS.format(factor=cause.FACTOR, low=low, high=high, printed=figures)
    yield "table", tables.as_table(found["verdicts"])
    yield "text", SHOWN
    yield "text", GUESS
    yield "text", SIGN
    yield "heading", "Tables " + ", ".join(dict.fromkeys(str(row["table"]) for row in found["rows"]))
    yield "table", (list(tables.COLUMNS.values()), list(tables.lines(found["rows"])))


def about_the_gallery(found):
    best = found["best"]
    return f"'The variant' and the pale lines are '{best['variant']}'; {best['reading']}, in ours and in the variant."


def markdown(found):
    forms = {"text": "{0}\n", "heading": "## {0}\n", "picture": "![{0[1]}]({0[0]})\n"}
    lines = ["# The preprint's study", "", *(f"- {line}" for line in summary(found)), ""]
    for kind, value in parts(found):
        lines += tables.markdown_table(*value) if kind == "table" else [forms[kind].format(value)]
    lines += ["## Gallery", "", about_the_gallery(found), "", *tables.markdown_table(*gallery.table(found["gallery"]))]
    return "\n".join(lines)


def write_html(output, found):
    makers = {
        "text": page.paragraph,
        "heading": page.heading,
        "picture": lambda value: page.picture(*value),
        "table": lambda value: page.table(*value),
    }
    first = [page.paragraph(line) for line in summary(found)]
    body = [makers[kind](value) for kind, value in parts(found)]
    last = [page.heading("Gallery: the preprint's figures from our results"), page.paragraph(about_the_gallery(found))]
    figures = gallery.section(found["gallery"])
    page.write_section(output, "paper", "The preprint's study", [*first, *body, *last, *figures])
