"""The failures of the study of geometry, with the bounds where they begin."""

from atlas_geometry_picture import of_part
from atlas_regions import checks_of, first, largest, last, quote, region, say, solved, told


def over(limit, key="p_error"):
    return lambda row: row.get(key) is not None and row[key] > limit


def silent(rows, limit):
    """Runs that are off by more than the limit, and of which neither status, checks nor warnings tell."""
    return [row for row in rows if over(limit)(row) and row["outcome"] == "solved" and not row["warning_count"]]


def kink_regions(rows, limit):
    line = of_part(rows, "kink")
    with_vertex = [row for row in line if row["line"] == "vertex in both"]
    without = [row for row in line if row["line"] != "vertex in both"]
    steepest = max(row["value"] for row in with_vertex)
    yield region(
        "Kinks with a vertex in both meshes",
        f"not found up to {steepest:g} degrees: p off by at most {largest(with_vertex, 'p_error'):.0e}",
        first(with_vertex, "value", over(1e-8)),
        "fixed",
        "Each edge has its own normal, and the segments end at the vertices, so a kink is only a jump of the normal "
        "between two edges (Puso & Laursen 2004 average the normals at the nodes instead).",
        "The geometries in geo/ put a vertex on every kink.",
    )
    bound, tells = first(without, "value", over(limit)), first(
        without, "value", lambda row: row["outcome"] != "solved" or row["warning_count"]
    )
    worst = max(silent(without, limit), key=lambda row: row["p_error"], default=None)
    says = f"; at worst {worst['p_error']:.0%} at {worst['value']:g} degrees and nothing tells" if worst else ""
    yield region(
        "Kinks that a mesh cuts short",
        f"p off by more than {limit:.0%} from {say(bound)} degrees{says}",
        bound,
        told([row for row in without if over(limit)(row)]),
        "An edge across the kink is another line: the two bodies overlap or part by h sin(theta) / 2 or so, and the "
        "normals of one side are not those of the other, so that equal and opposite forces are not equal pressures "
        "(Strang & Fix, An Analysis of the Finite Element Method, section 4.4, on changed domains).",
        (
            f"A check fails, or the scene is refused, from {tells:g} degrees: {checks_of(without)}; {quote(without)}."
            if tells
            else "Nothing is said."
        ),
    )


def wall_region(rows):
    finest = max(row["count"] for row in of_part(rows, "wall"))
    line = [row for row in of_part(rows, "wall", count=finest) if solved(row)]
    bounds = {
        kind: first([row for row in line if row["line"] == kind], "value", over(1.1, "growth"))
        for kind in ("sliding", "clamped")
    }
    most = {kind: last([row for row in line if row["line"] == kind], "growth", solved) for kind in bounds}
    begins = "largest p grows by more than 10 % with every refinement: " + "; ".join(
        f"{kind} walls from {say(bound)} degrees (by {say(most[kind], '.2f')} at the steepest)"
        for kind, bound in bounds.items()
    )
    why = (
        "Where the line meets a wall at an angle the body's corner is sharper or blunter than a right one, and the "
        "stress goes as r^(a - 1) with a < 1 (Williams 1952; Dundurs & Lee 1972 for frictionless contact): the "
        "largest p is no number of the problem, but of the mesh."
    )
    failing = checks_of(line)
    mortise = (
        f"The warning of p against sigma_n leaves such corners out for this reason; failing checks: {failing}."
    )
    found = [bound for bound in bounds.values() if bound]
    return region(
        "Fixed walls at an angle",
        begins,
        min(found, default=None),
        "open" if failing == "none" else "shown",
        why,
        mortise,
    )


def ring_regions(rows, limit):
    closed = [row for row in of_part(rows, "rings") if row["line"].endswith("closed") and solved(row)]
    straight = [row for row in closed if row["line"].startswith("straight")]
    curved = [row for row in closed if row["line"].startswith("curved")]
    finest = max(row["value"] for row in closed)
    pick = lambda line: next(row["p_error"] for row in line if row["value"] == finest)
    yield region(
        "Straight edges on a curve, closed gap",
        f"no bound, a rate: at {finest:g} elements p is off by {pick(straight):.0e} with straight quadratic edges, "
        f"{pick(curved):.0e} with curved ones",
        pick(straight) / pick(curved),
        "default",
        "A polygon turns where the curve is smooth, so the normals are off by h / (2 R) however high the order of "
        "the displacements (Strang & Fix, section 4.4; Ciarlet & Raviart 1972 for curved elements).",
        "Second-order nodes lie on the curve by default (the parameter straight = 0 of the geometries).",
    )
    measured = [row for row in of_part(rows, "rings") if row["line"].endswith("measured")]
    words = []
    for edges in ("linear", "straight quadratic", "curved quadratic"):
        line = [row for row in measured if row["line"].startswith(edges)]
        bound = last(line, "value", over(limit))
        words.append(f"{edges} edges up to {bound:g} elements" if bound else f"{edges} edges: not found")
    unsaid = silent(measured, limit)
    yield region(
        "Two meshes of one curve, measured gap",
        f"p off by more than {limit:.0%} on a quarter circle: " + "; ".join(words),
        last(measured, "value", over(limit)),
        "open" if unsaid else "guarded",
        "The two polygons overlap and part by the sagitta, h^2 / (8 R), and a gap g costs a pressure of E g / h "
        "(theory, section 2): as h falls the error of linear and straight edges does so only as E h / R, which for "
        "stiff bodies is more than p.",
        'Geometries of one curve are to be initial_gap = "closed"; a measured pair of this kind gets the warning '
        f"{quote(measured)}.",
    )


def cosine_region(rows, limit):
    line = [row for row in of_part(rows, "cosine") if row["value"] > 1]
    words = []
    for space in dict.fromkeys(row["line"] for row in line):
        bound = last([row for row in line if row["line"] == space], "value", over(limit))
        words.append(f"{space} {bound:g}" if bound else f"{space} none")
    default = [row for row in line if row["line"] == "linear"]
    unsaid = silent(line, limit)
    failing = last(line, "value", lambda row: row["outcome"] == "check")
    said = quote(line)
    why = (
        "The two meshes of a strongly curved line differ in position and normal by amounts of (h kappa)^2 and more "
        "(the consistency error of the mortar method on curved lines: Flemisch, Melenk & Wohlmuth 2005), and higher "
        "multiplier spaces follow them. With one element a period the mesh is a straight line: the curve is lost, "
        "and nothing in the mesh says so."
    )
    mortise = (
        f"Checks fail up to {say(failing)} elements a period: {checks_of(line)}; warnings and refusals: {said}. "
        f"{len(unsaid)} runs are off by more than {limit:.0%} and end as solved without a warning."
    )
    begins = (
        f"p off by more than {limit:.0%}, up to so many elements a period (multipliers on the worse side): "
        f"{', '.join(words)}"
    )
    return region(
        "Few elements on a curve",
        begins,
        last(default, "value", over(limit)),
        told([row for row in line if over(limit)(row)]),
        why,
        mortise,
    )


def sliver_regions(rows, limit):
    missed = [row for row in of_part(rows, "sliver") if row["line"].startswith("vertices")]
    out = [row for row in of_part(rows, "sliver") if row["line"].startswith("sticking")]
    yield region(
        "Vertices that nearly coincide",
        f"not found from 1e-1 to 1e-14 of an element: p off by at most {largest(missed, 'p_error'):.0e}",
        first(missed, "value", over(1e-8)),
        "fixed",
        "Segments of zero length, or points that project just past the end of an edge, drop a part of the line or "
        "count it twice in codes with absolute tolerances (Farah, Popp & Wall 2015).",
        "Cuts nearer than 1e-9 of an edge are one cut, and a point that misses its edge by so little is found on "
        "the neighbour (contact/segments).",
    )
    worst = largest([row for row in out if row["value"] <= 1e-6], "p_error")
    ratio = max(row["p_error"] / row["value"] for row in out if 1e-8 <= row["value"] <= 1e-3)
    bound = first(out, "value", over(limit))
    yield region(
        "One line sticks out past the other",
        f"p changes by up to {ratio:.2g} times the fraction of an element, so by {limit:.0%} from {say(bound)} of an "
        f"element; below 1e-6 by at most {worst:.0e}",
        bound,
        "fixed",
        "The load on the part that sticks out must be borne by the last elements of the line: by equilibrium their "
        "p changes by a few times the fraction. A code that drops or keeps a whole edge by a tolerance jumps "
        "instead (Cichosz & Bischoff 2011).",
        "The multipliers' functions are integrated over the part that faces the other side: p changes in proportion "
        f"down to 1e-14, without a jump. Failing checks: {checks_of(out)}.",
    )


def regions(rows, limit):
    found = [*kink_regions(rows, limit), wall_region(rows), *ring_regions(rows, limit)]
    return [*found, cosine_region(rows, limit), *sliver_regions(rows, limit)]
