"""The preprint's figures 3-9, 11-28, 30 and 31 from our results: same quantities, scenes, meshes and axes.

The preprint's figures are not redrawn from it: only what each shows and what is said of it is known. Ours is the
preprint's discretisation with segments and a closed gap; pale lines are the variant of cause.py that comes nearest to
the printed tables.
"""

import html

import gallery_claims as claims
import gallery_draw as draw
import page

MESH, MATCHING = (80, 100), (80, 80)
PIECE = (0.44, 0.76)
DECOMPOSED = [(26, "parabola_1", (41, 50)), (27, "parabola_2", (39, 51)), (28, "parabola_2", (76, 101))]
NAMES = {
    "tent_a": "tent (a)",
    "tent_b": "tent (b)",
    "tent_c": "tent (c)",
    "circle": "the circle",
    "parabola_1": "parabola 1",
    "parabola_2": "parabola 2",
}


def matching_bodies(view, path, scene):
    draw.line(path, draw.bodies(view.both(scene, MATCHING, "G1")), whole=scene.startswith("tent"))


def displacement(view, path, scene):
    draw.line(path, draw.bodies(view.both(scene, MESH, "G1")), "u_n")


def piece_against_matching(view, path, scene):
    """Of three tents on one scale, that of the steepest one."""
    curves = lambda s: {**draw.reference(view.matching(s, MESH, "G1")), **draw.bodies(view.both(s, MESH, "G2"))}
    every = [curve for s in claims.TENTS for _, curve in curves(s).values()]
    scale = draw.limits(every, "sigma_n", 1e-6, PIECE)
    draw.line(path, curves(scene), piece=PIECE, y_limits=scale)


def one_side_active(view, path, scene, active):
    pale = {k: v for body in ("G1", "G2") for k, v in draw.variant(view, scene, MESH, active, body).items()}
    draw.line(path, {**pale, **draw.bodies(view.both(scene, MESH, active))})


def against_matching(view, path, scene, at="nodes"):
    pale = draw.variant(view, scene, MESH, "G2", "G1", at)
    black = draw.reference(view.matching(scene, MESH, "G1", at))
    draw.line(path, {**pale, **black, **draw.bodies(view.both(scene, MESH, "G2", at=at))})


def one_body(view, path, scene, body):
    mesh = (40, 50)
    black, pale = draw.reference(view.matching(scene, mesh, body)), draw.variant(view, scene, mesh, "G2", body)
    mine = draw.bodies(view.both(scene, mesh, "G2"))
    own = {label: curve for label, curve in mine.items() if label.startswith(body)}
    draw.line(path, {**pale, **black, **own})


def field(view, path, name):
    draw.fields(path, view, "parabola_2", name, "G1")


def decomposition(view, path, scene, mesh):
    draw.line(path, draw.bodies([view.ddm(scene, mesh, body) for body in ("G1", "G2")]), "p")


def cosine(view, path, name):
    draw.line(path, draw.bodies([view.cosine(MATCHING, "G1", body) for body in ("G1", "G2")]), name, whole=True)


def entry(number, caption, says, claim, drawing, *arguments):
    return {
        "figure": number,
        "caption": caption,
        "says": says,
        "claim": claim,
        "draw": lambda view, path: drawing(view, path, *arguments),
    }


def entries():
    """All figures, in the order of the preprint."""
    for k, scene in enumerate(claims.TENTS):
        text = f"Normal stress on {NAMES[scene]}, matching meshes 80x80, G1 active, at nodes, both bodies."
        says = "One curve except near the corners, no oscillation; the values at ends and kink grow with the angle."
        claim = claims.corner_values_grow if k == 2 else claims.matching_is_smooth(scene)
        yield entry(3 + k, text, says, claim, matching_bodies, scene)
    text = "Normal displacement on tent (a), 80x100, G1 active, both bodies."
    says = "No oscillation of u_n is visible, here and in all scenes."
    yield entry(6, text, says, claims.displacement_is_smooth, displacement, "tent_a")
    for k, scene in enumerate(claims.TENTS):
        text = f"Normal stress on a piece of {NAMES[scene]}, 80x100 against matching meshes, G2 active; one scale."
        says = "Practically no oscillation but at the ends, whatever the angle."
        yield entry(7 + k, text, says, claims.tents_do_not_oscillate, piece_against_matching, scene)
    curves = ("circle", "parabola_1", "parabola_2")
    for k, scene in enumerate(curves):
        text = f"Normal stress on {NAMES[scene]}, matching meshes 80x80, G1 active, both bodies."
        says = "One curve; oscillation only at the corner points."
        yield entry(11 + k, text, says, claims.matching_is_smooth(scene), matching_bodies, scene)
    for k, active in enumerate(("G1", "G2")):
        text = f"Normal stress on parabola 2, 80x100, {active} active, at nodes, both bodies."
        says = "Far smaller oscillation with the body of the finer mesh, G2, active."
        yield entry(14 + k, text, says, claims.finer_active_is_smaller, one_side_active, "parabola_2", active)
    for k, scene in enumerate(curves):
        text = f"Normal stress on {NAMES[scene]}, 80x100 against matching meshes, G2 active, at nodes."
        says = "Much larger oscillation on the parabolas than on the circle."
        yield entry(16 + k, text, says, claims.parabola_against_circle(scene), against_matching, scene)
    for k, body in enumerate(("G1", "G2")):
        text = f"Normal stress on parabola 1, 40x50, G2 active, at the nodes of {body}, against matching meshes."
        says = "Larger oscillation than on finer meshes."
        yield entry(19 + k, text, says, claims.coarse_against_fine, one_body, "parabola_1", body)
    for k, scene in enumerate(curves):
        text = f"Normal stress on {NAMES[scene]} at element centres, 80x100 against matching meshes, G2 active."
        says = "Smaller oscillation than at the nodes."
        yield entry(21 + k, text, says, claims.nodes_against_centres(scene), against_matching, scene, "centres")
    for number, name in ((24, "sigma_11"), (25, "sigma_22")):
        text = f"Field of {name} for parabola 2, 80x80 and 80x100, G1 active; one scale."
        says = "On 80x100 the oscillation is visible in the field."
        yield entry(number, text, says, claims.field_oscillates(name), field, name)
    for number, scene, mesh in DECOMPOSED:
        text = f"Contact pressure on {NAMES[scene]} by domain decomposition, {mesh[0]}x{mesh[1]}, 3-node triangles."
        says = "One curve for both bodies; far less oscillation than by the mortar method."
        yield entry(number, text, says, claims.decomposed(scene, mesh), decomposition, scene, mesh)
    for number, name in ((30, "u_n"), (31, "sigma_n")):
        words = "Normal displacement" if name == "u_n" else "Normal stress"
        text = f"{words} on the cosine, unilateral contact, matching meshes 80x80, G1 active, both bodies."
        says = "Practically one curve; near the right end no stress and different u_n: contact is lost."
        yield entry(number, text, says, claims.contact_is_lost, cosine, name)


def holds(verdict):
    words = {True: "holds", False: "does not hold"}
    ours, *variant = verdict
    return words[bool(ours)] + (f"; by the variant it {words[bool(variant[0])]}" if variant else "")


def make(view, folder, chosen=None, say=lambda text: None):
    """Draws the figures (all, or those of some numbers); rows with figure, picture, caption, says, found, holds."""
    (folder / "gallery").mkdir(parents=True, exist_ok=True)
    for item in entries():
        if chosen is not None and item["figure"] not in chosen:
            continue
        say(f"gallery: figure {item['figure']}")
        path = f"gallery/figure_{item['figure']:02}.png"
        item["draw"](view, folder / path)
        found, *verdict = item["claim"](view)
        words = {name: item[name] for name in ("figure", "caption", "says")}
        yield {**words, "found": found, "holds": holds(verdict), "picture": path}


def section(rows):
    """HTML: pictures side by side, each with its caption below."""
    yield '<div style="display:grid;grid-template-columns:repeat(auto-fill,minmax(400px,1fr));gap:0 1.2em">\n'
    for row in rows:
        caption = f"<b>Figure {row['figure']}.</b> {html.escape(row['caption'])}"
        caption += f"<br>The preprint: {html.escape(row['says'])}"
        caption += f"<br>Here: {html.escape(row['found'])} <b>Ours: {html.escape(row['holds'])}.</b>"
        wide = ' style="grid-column:1/-1"' if row["figure"] in (24, 25) else ""
        image = f'<img src="{row["picture"]}" alt="Figure {row["figure"]}">'
        yield f"<figure{wide}>{image}<figcaption>{caption}</figcaption></figure>\n"
    yield "</div>\n"


def table(rows):
    """For Markdown."""
    heading = ["figure", "shows", "the preprint says", "here", "holds"]
    names = ("figure", "caption", "says", "found", "holds")
    return heading, [[str(row[name]) for name in names] for row in rows]
