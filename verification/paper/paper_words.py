"""The study in words and tables: summary, Markdown and the section of the report."""

import cause
import page
import preprint
import tables

MOST_EXCEPTIONS = 20
MEASURE = (
    "delta, eq. (28) of the preprint: the mean over a body's contact line, without its first and last element, of "
    "|sigma_2 - s| / |s|, s from matching meshes. G1 is the upper, G2 the lower body; a mesh is n_upper x n_lower."
)
OURS = (
    "Ours: 8-node quadrilaterals, quadratic multipliers (as the preprint), segments, closed gap. 'better': the smaller "
    "of both multiplier sides; 'best': the smallest of both sides and of quadratic and linear multipliers; 'our default': "
    "linear multipliers on the finer side."
)
SIGN = (
    "Eq. (26) of the preprint has a slip in the sign of its shear term: sigma_n is n.sigma.n (theory, eq. 21), with "
    "- 2 tau_12 sin w cos w for the angle w of the tangent. Ours uses n.sigma.n."
)


def required(rows):
    """Is ours at most the printed figure?"""
    targets = [row for row in rows if row["target"]]
    for name in ("better", "best"):
        worse = tables.exceptions(rows, name)
        yield f"ours ({name}) is at most the printed figure in {len(targets) - len(worse)} of {len(targets)} target rows"
        for row in worse[:MOST_EXCEPTIONS] if name == "better" else []:
            place = f"table {row['table']}, {row['scene']} {row['mesh']} at {row['at']}, {row['active']} active, {row['body']}"
            yield (
                f"exception: {place}: printed {row['printed']:.3g}, ours {row['better']:.3g}, best {row['best']:.3g}, "
                f"{100 * row['better_share_of_worst']:.0f} % of ours comes from 6 places, beside the ends or the kink"
            )


def verdict_on_the_cause(best, printed):
    """The variant nearest to the printed parabola rows, in a line; and what it misses."""
    words = "fits the printed parabola rows best" if best["fits"] else "comes nearest to the printed parabola rows, none fits"
    between = {name: best[name] for name in printed}
    pairs = ", ".join(f"{name} {value:.2g} (printed {printed[name]:.2g})" for name, value in between.items() if value == value)
    sizes = ", ".join(f"{series} {best[f'ours/printed, {series}']:.2g}" for series in preprint.SERIES)
    yield (
        f"cause: '{best['variant']}' with '{best['reading']}' {words}: median of variant/printed {sizes}; "
        f"{100 * best['parabolas: rows within 3']:.0f} % of the parabola rows within a factor of 3; {pairs}"
    )
    if not between["factor between meshes"] == between["factor between meshes"]:
        yield "one mesh only: whether a variant fits needs the factor between meshes, that is the full study"


def summary(found):
    """Lines: the required results and the verdict on the cause."""
    yield from required(found["rows"])
    for row in tables.ratios(found["rows"]):
        yield (
            f"median of printed/ours, {row['series']} ({row['rows']} rows): {row['better']:.3g} (better side), "
            f"{row['best']:.3g} (best), {row['default']:.3g} (our default)"
        )
    yield from verdict_on_the_cause(found["best"], found["printed"])
    others = [f"{v['variant']} ({v['reading']})" for v in found["verdicts"] if v["fits"] and v is not found["best"]]
    if others:
        yield "also fit: " + "; ".join(others)
    for row in found["gaps"][-1:]:
        yield (
            f"gap between the meshes, {row['scene']} {row['mesh']}: {row['largest gap, m']:.3g} m, predicted "
            f"{row['predicted, m']:.3g} m; E g0 / h = {row['E g0 / h, MPa']:.2g} MPa"
        )
    claims = [row["holds"].split(";")[0] for row in found["gallery"]]
    yield f"gallery: of {len(claims)} figures what the preprint says holds in ours for {claims.count('holds')}"


def parts(found):
    """Headings, texts, tables and pictures, in order, for both formats."""
    yield "text", MEASURE
    yield "text", OURS
    yield "picture", ("tables.png", "delta of every target row, ours (better side) over the printed figure.")
    yield "heading", 'What "active" means: fit of both readings'
    fitted = list(tables.fits(found["rows"]))
    yield "text", "median and spread (standard deviation) of log10(ours/printed), share of rows within a factor of 3, Spearman."
    yield "table", tables.as_table(fitted)
    yield "heading", "Why the preprint's stresses oscillate"
    yield "text", (
        "A quadratic edge with its nodes evenly on a curve misses it by up to |kappa'| h^3 / (72 sqrt 3), kappa' the change of "
        "curvature with arc length: zero on a circle, not on a parabola. Two meshes that do not match then show a gap, and "
        "enforced as if it were real it makes the pressure swing by about E g0 / h, four times less at half the mesh width."
    )
    yield "table", tables.as_table(found["gaps"])
    yield "picture", ("curves.png", "sigma_n on parabola 2: ours, with the meshes' gap enforced, and the nearest variant.")
    yield "picture", ("variants.png", "Every target row by variant, each in the reading that fits the parabolas better.")
    yield "picture", ("meshes.png", "delta over the mesh: geometric mean of the four rows of a scene.")
    yield "text", (
        f"Printed: parabolas over circle {found['printed']['parabolas over circle']:.2g}, factor between meshes "
        f"{found['printed']['factor between meshes']:.2g}. Fits: median within a factor of {cause.FACTOR}, three rows in four "
        f"within it, factor between meshes {cause.BETWEEN_MESHES[0]} to {cause.BETWEEN_MESHES[1]}."
    )
    yield "table", tables.as_table(found["verdicts"])
    yield "text", SIGN
    yield "heading", "Tables 1-3 and 5-8"
    yield "table", (list(tables.COLUMNS.values()), list(tables.lines(found["rows"])))


def markdown(found):
    import gallery

    lines = ["# The preprint's study", "", *(f"- {line}" for line in summary(found)), ""]
    for kind, value in parts(found):
        if kind == "table":
            lines += tables.markdown_table(*value)
        else:
            form = {"text": "{0}\n", "heading": "## {0}\n", "picture": "![{0[1]}]({0[0]})\n"}[kind]
            lines.append(form.format(value))
    lines += ["## Gallery", "", *tables.markdown_table(*gallery.table(found["gallery"]))]
    return "\n".join(lines)


def write_html(output, found):
    import gallery

    makers = {
        "text": page.paragraph,
        "heading": page.heading,
        "picture": lambda value: page.picture(*value),
        "table": lambda value: page.table(*value),
    }
    first = [page.paragraph(line) for line in summary(found)]
    body = [makers[kind](value) for kind, value in parts(found)]
    last = [page.heading("Gallery: the preprint's figures from our results"), *gallery.section(found["gallery"])]
    page.write_section(output, "paper", "The preprint's study", [*first, *body, *last])
