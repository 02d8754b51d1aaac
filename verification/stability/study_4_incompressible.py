"""Near incompressibility: which elements lock, and what it does to the contact pressure (plane strain)."""

import figure
from failures import ELEMENTS, checks_of, draw_line, ends, failure, first, largest, of_scene, parameters, quote, select
from failures import silent, solved, told

POISSON = [0.3, 0.4, 0.45, 0.49, 0.499, 0.4999, 0.49999, 0.499999]
MESHES = [(12, 16), (24, 32)]
YOUNG = (210e9, 70e9)
LIMITS = {"u_error": 0.1, "p_error": 0.01, "mean_stress_error": 0.1}
COMPARED = 0.49  # of the quick studies too


def rings(element, poisson, mesh):
    axes = {"scene": "rings", "element": element, "poisson": poisson, "mesh": mesh[0]}
    settings = parameters(**ELEMENTS[element], n_inner=mesh[0], n_outer=mesh[1])
    settings |= {f"materials.{name}.poisson": poisson for name in ("stiff", "soft")}
    materials = [(young, poisson) for young in YOUNG]
    return of_scene(axes, "rings", settings, "rings", "rings_fields", materials=materials)


def patch(element, poisson):
    settings = {**parameters(**ELEMENTS[element]), "materials.steel.poisson": poisson}
    axes = {"scene": "patch_flat", "element": element, "poisson": poisson, "mesh": 7}
    return of_scene(axes, "patch_flat", settings, "uniform")


def runs(quick):
    values, meshes = (ends(POISSON, 3), MESHES[:1]) if quick else (POISSON, MESHES)
    listed = [rings(element, nu, mesh) for mesh in meshes for element in ELEMENTS for nu in values]
    return listed + [patch(element, nu) for element in ELEMENTS for nu in values]


def draw(rows, path):
    labels = ("largest error of u / largest u", "largest relative error of p", "error of the mean stress / p")
    drawing, panels = figure.panels(1, 3, (13, 4.6))
    for axes, key, label in zip(panels, LIMITS, labels):
        for number, element in enumerate(ELEMENTS):
            for mesh, style in zip(MESHES, ("o-", "o--")):
                line = select(rows, scene="rings", element=element, mesh=mesh[0])
                line = [{**row, "from half": 1 - 2 * row["poisson"]} for row in line]
                name = element if style == "o-" else None
                draw_line(axes, line, "from half", key, style, markersize=3.5, color=f"C{number}", label=name)
        figure.label(axes, r"$1 - 2\nu$", label, log="xy", limit=0.1)
        axes.invert_xaxis()
    panels[0].legend(loc="lower right")
    figure.save(drawing, path)


def is_off(rows, row, key):
    """True if a figure exceeds its limit, and twice what the mesh has without any locking, at nu = 0.3."""
    (mesh,) = select(rows, element=row["element"], mesh=row["mesh"], poisson=POISSON[0])
    return row[key] > max(LIMITS[key], 2 * mesh[key])


def locking(rows, key):
    """The runs on rings of which a figure is off, the least nu at which it is on the coarse mesh; and in words for each
    element."""
    rings = select(rows, scene="rings")
    bad = [row for row in rings if solved(row) and is_off(rings, row, key)]
    words, bounds = [], []
    for element in ELEMENTS:
        line = select(bad, element=element, mesh=MESHES[0][0])
        bound = first(line, "poisson", solved)
        bounds += [bound] if bound else []
        error = next((f" ({row[key]:.1%})" for row in line if row["poisson"] == bound), "")
        words.append(f"{element} {f'{bound:g}' if bound else 'none'}{error}")
    values = {"limit": LIMITS[key], "elements": "; ".join(words)}
    return bad, values, min(bounds, default=None)


def displacement_failure(rows):
    bad, values, bound = locking(rows, "u_error")
    said = quote([row for row in rows if row.get("warning_count")])
    name = "Locking: displacements too small"
    return failure(name, bound, told(bad), said=said, silent=len(silent(bad)), **values)


def pressure_failure(rows):
    bad, values, bound = locking(rows, "p_error")
    estimated = [row["p_estimated"] / row["p_error_l2"] for row in bad]
    values |= {"bad": len(bad), "held": sum(part >= 1 for part in estimated), "least": min(estimated, default=None)}
    return failure("Contact pressure", bound, told(bad), **values)


def stress_failure(rows):
    bad, values, bound = locking(rows, "mean_stress_error")
    (row,) = select(rows, element="8-node quadrilaterals", poisson=COMPARED, mesh=MESHES[0][0])
    values |= {"poisson": COMPARED, "centre": row["mean_stress_error"], "nodes": row["nodal_mean_stress_error"]}
    return failure("Mean stress in the bodies", bound, told(bad), silent=len(silent(bad)), bad=len(bad), **values)


def patch_failure(rows):
    line = [row for row in select(rows, scene="patch_flat") if solved(row)]
    bound = first(line, "poisson", lambda row: "residual" in row["failed_checks"])
    return failure("Rounding", bound, "shown", worst=largest(line, "p_error"), checks=checks_of(line))


def failures(rows):
    return [displacement_failure(rows), pressure_failure(rows), stress_failure(rows), patch_failure(rows)]
