"""The failures of the study of over-constraint."""

from atlas_regions import checks_of, first, largest, quote, region, solved


def of_case(rows, chosen):
    return [row for row in rows if row["part"] == "case" and chosen(row["case"])]


def counts(rows, verdicts):
    found = [row["verdict"] for row in rows]
    return ", ".join(f"{found.count(name)} {name}" for name in verdicts if name in found)


def state_of(rows):
    """What can be said of a group of cases as a whole: the worst of its runs."""
    found = {row["verdict"] for row in rows}
    if "wrong, and solved" in found:
        return "open"
    if found <= {"right"}:
        return "fixed"
    return "guarded" if not any(name.startswith("wrong") for name in found) else "shown"


DEPENDENT = (
    "A row of the coupling whose displacements are all prescribed says nothing of the unknowns, and rows that "
    "others imply make the saddle-point matrix singular (Brezzi & Fortin 1991, section II.1: B must have full rank)."
)
GROUPS = [
    (
        "One contact curve prescribed",
        lambda name: name == "lower curve prescribed",
        DEPENDENT + " Here the finer side's multipliers have more rows than the other side has nodes.",
    ),
    (
        "Both contact curves prescribed",
        lambda name: name.startswith("both curves"),
        DEPENDENT + " The prescribed values then decide whether the bodies touch, overlap or are apart, and a pressure "
        "is not determined.",
    ),
    (
        "Ends prescribed so that they overlap",
        lambda name: name.startswith("left ends prescribed, overlap"),
        "The condition at the end contradicts the prescribed values; the multiplier takes the neighbour's row, "
        "whose weighted gap contains the overlap (Wohlmuth 2000 ties end multipliers for homogeneous conditions "
        "only).",
    ),
    (
        "Nodes that both bodies share",
        lambda name: "shared" in name and "ddm" not in name,
        DEPENDENT + " At a shared node the gap is zero whatever the displacement.",
    ),
    (
        "One curve in two pairs",
        lambda name: name == "one curve in two pairs",
        "Two pairs on one curve demand the same gap twice, or that two bodies are at one place; only pieces of the "
        "curve that do not overlap are independent.",
    ),
    (
        "Three bodies that meet at a point",
        lambda name: name.startswith("three bodies"),
        "At the common point three conditions meet, of which each body feels two (a cross point; Bernardi, Maday & "
        "Patera 1994). With a node for each body the three are independent.",
    ),
    (
        "Prescribed curve or shared nodes, domain decomposition",
        lambda name: "ddm" in name,
        "The body that takes the displacement must be able to answer with a pressure: C_D is singular where its "
        "curve is prescribed (theory, eq. 32).",
    ),
]


def case_region(rows, name, chosen, why, verdicts):
    group = of_case(rows, chosen)
    wrong = [row for row in group if row["verdict"].startswith("wrong")]
    refused = quote(group, lambda row: row["outcome"] == "refused")
    warning = quote(wrong)
    said = f"{refused}. " if refused != "nothing" else f"The only word is the warning {warning}. " if warning != "nothing" else ""
    checks = checks_of(group)
    checks = f"Failing checks: {checks}. " if checks != "none" else ""
    worst = largest([row for row in wrong if row["right"] == "exact"], "p_error")
    begins = counts(group, verdicts) + (f"; p off by up to {worst:.0e} times" if worst else "")
    return region(
        name,
        begins,
        float(len(wrong)),
        state_of(group),
        why,
        (said + checks).strip() or ("Nothing is said." if wrong else "Solved as it should be."),
    )


def covered_region(rows, limit):
    line = [row for row in rows if row["part"] == "covered" and solved(row)]
    spaces = list(dict.fromkeys(row["space"] for row in line))
    bounds = {
        space: first(
            [{**row, "q": -row["value"]} for row in line if row["space"] == space],
            "q",
            lambda row: row["p_error"] > limit,
        )
        for space in spaces
    }
    words = "; ".join(
        f"{space} {-bound:g}" if bound else f"{space}: not found"
        for space, bound in bounds.items()
    )
    at = lambda q: [
        row["p_error"] / row["p_error_facing"] for row in line if row["space"] == "linear" and row["value"] == q
    ]
    factor = f"at q = 0.01 the nodes' own error is magnified {at(0.01)[0]:.0f} times; " if at(0.01) else ""
    facing = largest(line, "p_error_facing")
    untold = [row for row in line if row["p_error"] > limit and row["outcome"] == "solved"]
    why = (
        "Over the fraction q of its edge the shape function of the far node is at most q, so its value is an "
        "extrapolation over 1 / q from an integral of the size of q^2: errors are magnified by 1 / q^2 (Cichosz & "
        "Bischoff 2011)."
    )
    mortise = (
        "Multipliers whose weighted gap has no sign, or without support, are tied or left out with a warning (theory, "
        f"section 4). p where the sides face each other is off by {facing:.0e} at most. {len(untold)} runs with a "
        f"value off by more than {limit:.0%} end as solved."
    )
    begins = (
        f"{factor}p at the node past the end is off by more than {limit:.0%} from q = {words} (with an error of "
        f"{facing:.0e} at the nodes that face)"
    )
    found = [-bound for bound in bounds.values() if bound]
    return region(
        "An edge that hardly faces the other side",
        begins,
        max(found, default=None),
        "open" if untold else "fixed",
        why,
        mortise,
    )


def regions(rows, verdicts, limit):
    return [*(case_region(rows, *group, verdicts) for group in GROUPS), covered_region(rows, limit)]
