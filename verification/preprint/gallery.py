"""The preprint's 31 figures (gallery.toml) from our results: same quantities, scenes, meshes, axes.

Ours is the preprint's discretisation with gap and normals of the curve; pale lines are the variant of cause.py that
comes nearest to the printed tables.
"""

from dataclasses import dataclass

import numpy as np

import figure
import gallery_claims as claims
import gallery_measures as measures
import oscillation
import preprint_runs
import printed_tables as printed
from cause import OURS, VARIANTS
from gallery_claims import MATCHING, MESH, PARABOLA, TABLE

PIECE = (0.44, 0.76)
COLOURS = {"G1": "#d1495b", "G2": "#2e6fab"}
MARKS = {"G1": {"linewidth": 1.3}, "G2": {"linewidth": 1.1, "linestyle": (0, (4, 2))}}
QUANTITIES = {"sigma_n": (r"$\sigma_n$, MPa", 1e-6), "u_n": (r"$u_n$, $\mu$m", 1e6), "p": (r"$p$, MPa", 1e-6)}
DDM = {"method.solver": "ddm", "method.dirichlet": "upper", "mesh.parameters.order": 1, "mesh.parameters.kind": 1}


@dataclass(frozen=True)
class View:
    """Curves for the gallery: a reading of "active", our method, and the variant nearest to the preprint's."""

    store: preprint_runs.Store
    reading: str  # of printed_tables.MAPPINGS
    like: str  # variant of cause.VARIANTS

    def settings(self, active, variant=None):
        changes = VARIANTS[variant] if variant else preprint_runs.METHOD
        return {**changes, **preprint_runs.on_side(printed.MAPPINGS[self.reading](active))}

    def curve(self, scene, mesh, active, body, at="nodes", variant=OURS):
        return self.store.curve(scene, mesh, self.settings(active, variant), body, at)

    def both(self, *arguments, **options):
        return [self.curve(*arguments, body, **options) for body in ("G1", "G2")]

    def matching(self, scene, mesh, body, at="nodes", variant=OURS):
        return oscillation.matching_curve(self.store, scene, mesh, VARIANTS[variant], body, at)

    def folder_with_fields(self, scene, mesh, active, variant=OURS):
        return self.store.run(scene, mesh, self.settings(active, variant), fields=True)

    def cosine(self, mesh, active, body):
        return self.store.curve("cosine", mesh, self.settings(active), body)

    def cosine_status(self, mesh, method):
        """How the run ends with the multipliers on the side that the program chooses."""
        return self.store.summary("cosine", mesh, method)["status"]

    def ddm(self, scene, mesh, body):
        return self.store.curve(scene, mesh, DDM, body)

    def ddm_residual(self, scene, mesh):
        return self.store.summary(scene, mesh, DDM)["iteration"]["force"]


# ---- Curves: label: (style, columns) ----


def bodies(curves):
    """Both bodies' curves with their labels."""
    names = {"G1": "G1 (upper)", "G2": "G2 (lower)"}
    return {names[body]: ({"color": COLOURS[body], **MARKS[body]}, curve) for body, curve in zip(COLOURS, curves)}


def reference(curve):
    return {"matching meshes": ({"color": "black", "linewidth": 0.9}, curve)}


def variant(view, scene, mesh, active, body, at="nodes"):
    """The same by the variant that comes nearest to the preprint, pale."""
    curve = view.curve(scene, mesh, active, body, at=at, variant=view.like)
    return {f"{body}, by the variant": ({"color": COLOURS[body], "linewidth": 0.8, "alpha": 0.45}, curve)}


def limits(curves, name, factor, piece):
    """Of the middle part of the curves: the ends are singular and would hide the rest."""
    values = np.concatenate([factor * c[name][(c["x"] >= piece[0]) & (c["x"] <= piece[1])] for _, c in curves])
    low, high = values.min(), values.max()
    return low - 0.12 * (high - low), high + 0.3 * (high - low)


def line(path, curves, name="sigma_n", piece=None, whole=False, y_limits=None):
    """`piece`: part of x1; `whole`: the corners' peaks too."""
    label, factor = QUANTITIES[name]
    drawing, axes = figure.panels(1, 1, (4.6, 2.7))
    for text, (style, curve) in curves.items():
        axes.plot(curve["x"], factor * curve[name], label=text, **style)
    shown = (0, 0.8) if whole else (0.03, 0.77)
    y_limits = y_limits or limits(curves.values(), name, factor, piece or shown)
    legend = {"fontsize": 7.5, "frameon": False, "ncol": 2, "loc": "upper center"}
    figure.label(axes, r"$x_1$, m", label, xlim=piece or (0, 0.8), ylim=y_limits, legend=legend)
    figure.save(drawing, path)


# ---- What the figures show: functions of the view, a path and the arguments of gallery.toml ----


def meshes(view, path, *scenes):
    """A panel for each scene: both bodies' elements."""
    drawing, panels = figure.panels(1, len(scenes), (4.6 if len(scenes) == 1 else 9.4, 2.9), squeeze=False)
    for axes, scene in zip(panels[0], scenes):
        shown = measures.fields(view.folder_with_fields(scene, claims.DRAWN, "G1"))
        for outline, body in zip(shown["outlines"], shown["body"][shown["outlines"][:, 0]]):
            axes.plot(*shown["points"][outline].T, color=COLOURS[measures.BODIES[body]], linewidth=0.5)
        figure.label(axes, r"$x_1$, m", title=TABLE["names"][scene], aspect="equal")
    panels[0][0].set_ylabel(r"$x_2$, m")
    figure.save(drawing, path)


def matching_bodies(view, path, scene):
    line(path, bodies(view.both(scene, MATCHING, "G1")), whole=scene.startswith("tent"))


def displacement(view, path, scene):
    line(path, bodies(view.both(scene, MESH, "G1")), "u_n")


def piece_against_matching(view, path, scene):
    """Of three tents on one scale, that of the steepest one."""
    curves = lambda s: {**reference(view.matching(s, MESH, "G1")), **bodies(view.both(s, MESH, "G2"))}
    every = [curve for s in claims.TENTS for curve in curves(s).values()]
    line(path, curves(scene), piece=PIECE, y_limits=limits(every, "sigma_n", 1e-6, PIECE))


def one_side_active(view, path, active):
    pale = {k: v for body in ("G1", "G2") for k, v in variant(view, PARABOLA, MESH, active, body).items()}
    line(path, {**pale, **bodies(view.both(PARABOLA, MESH, active))})


def against_matching(view, path, scene, at="nodes"):
    pale, black = variant(view, scene, MESH, "G2", "G1", at), reference(view.matching(scene, MESH, "G1", at))
    line(path, {**pale, **black, **bodies(view.both(scene, MESH, "G2", at=at))})


def centres_against_matching(view, path, scene):
    against_matching(view, path, scene, "centres")


def one_body(view, path, body):
    scene, mesh = "parabola_1", (40, 50)
    black, pale = reference(view.matching(scene, mesh, body)), variant(view, scene, mesh, "G2", body)
    own = {label: c for label, c in bodies(view.both(scene, mesh, "G2")).items() if label.startswith(body)}
    line(path, {**pale, **black, **own})


def field(view, path, name):
    """Three panels: matching meshes, ours and the variant's on 80x100."""
    cases = {"80x80": (MATCHING, OURS), "80x100": (MESH, OURS), "80x100, by the variant": (MESH, view.like)}
    found = [measures.fields(view.folder_with_fields(PARABOLA, mesh, "G1", way)) for mesh, way in cases.values()]
    drawing, panels = figure.panels(1, 3, (9.4, 2.7), sharey=True)
    low, high = np.percentile(found[0][name] * 1e-6, (2, 98))
    for axes, title, shown in zip(panels, cases, found):
        colours = {"shading": "gouraud", "vmin": low, "vmax": high, "cmap": "viridis"}
        drawn = axes.tripcolor(*shown["points"].T, shown["triangles"], shown[name] * 1e-6, **colours)
        axes.set(aspect="equal", xlabel=r"$x_1$, m", title=title)
    panels[0].set_ylabel(r"$x_2$, m")
    drawing.colorbar(drawn, ax=panels, extend="both", pad=0.01, label=rf"$\sigma_{{{name[-2:]}}}$, MPa")
    figure.save(drawing, path)


def decomposition(view, path, scene, mesh):
    line(path, bodies([view.ddm(scene, mesh, body) for body in ("G1", "G2")]), "p")


def cosine(view, path, name):
    line(path, bodies([view.cosine(MATCHING, "G1", body) for body in ("G1", "G2")]), name, whole=True)


# ---- The gallery ----


def holds(ours, *variant):
    words = lambda verdict: "holds" if verdict else "does not hold"
    return words(ours) + (f"; by the variant it {words(variant[0])}" if variant else "")


def make(view, folder, chosen=None, say=lambda text: None):
    """Draws the figures (all, or those of some numbers); rows with figure, caption, says, found, holds, picture."""
    for group in TABLE["figures"]:
        for number, *arguments in group["cases"]:
            if chosen is not None and number not in chosen:
                continue
            say(f"gallery: figure {number}")
            path = f"gallery/figure_{number:02}.png"
            globals()[group["draw"]](view, folder / path, *arguments)
            found, *verdict = getattr(claims, group["claim"])(view, *arguments)
            caption = group["caption"].format(*arguments, name=TABLE["names"].get(arguments[0]))
            row = {"figure": number, "caption": caption, "says": group["says"], "found": found}
            yield {**row, "holds": holds(*verdict), "picture": path}


def words(row):
    """A figure's picture, and what is said of it."""
    said = f"The preprint: {row['says']} Here: {row['found']} **Ours: {row['holds']}.**"
    return f"![Figure {row['figure']}. {row['caption']}]({row['picture']})\n\n{said}"
