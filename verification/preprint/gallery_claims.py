"""What the preprint says of each of its figures, and whether it holds in our results: a figure, and yes or no.

A claim takes the view and the arguments of its figure (gallery.toml) and returns the text with its figures, whether it
holds in ours and, where the variant is held against it too, whether it holds there. "Visible" is taken to be 1 % of the
mean |sigma_n|; where the preprint says that one oscillation is larger than another, larger is at least twice.
"""

import tomllib
from pathlib import Path

import numpy as np

import gallery_measures as measures
import template
from cause import OURS
from preprint_runs import METHOD

TABLE = tomllib.loads(Path(__file__).with_name("gallery.toml").read_text())
VISIBLE, LARGER = 0.01, 2
NEAR = measures.NEAR_A_CORNER
PARABOLA = "parabola_2"
MESH, MATCHING, DRAWN = (80, 100), (80, 80), (16, 20)
TENTS = ("tent_a", "tent_b", "tent_c")


def percent(value):
    return f"{100 * value:.2g} %" if value < 0.995 else f"{100 * value:.0f} %"


def found(claim, **values):
    """The claim's text; shares are written in percent."""
    share = lambda v: percent(v) if isinstance(v, float) else v
    return template.fill(TABLE["found"][claim], **{name: share(value) for name, value in values.items()})


def passes_through(view, *scenes):
    """Both bodies' contact lines pass through the points that the preprint's text gives."""
    heights = {s: [np.interp((0, 0.4, 0.8), c["x"], c["y"]) for c in view.both(s, DRAWN, "G1")] for s in scenes}
    words = [f"{TABLE['names'][s]} " + ", ".join(f"{h:.6g}" for h in upper) for s, (upper, _) in heights.items()]
    missed = [np.abs(np.array(both) - TABLE["heights"][scene]).max() for scene, both in heights.items()]
    return found("passes_through", heights="; ".join(words)), bool(max(missed) < 1e-6)


def matching_is_smooth(view, scene):
    """One curve away from the corners, no oscillation there."""
    upper, lower = view.both(scene, MATCHING, "G1")
    apart, rough = measures.apart(scene, upper, lower), measures.roughness(scene, upper)
    return found("matching_is_smooth", apart=apart, rough=rough), apart <= 3 * VISIBLE and rough <= VISIBLE


def corner_values_grow(view, scene):
    """Of the matching tents: also the largest stress at the ends and the kink grows with the angle."""
    text, smooth = matching_is_smooth(view, scene)
    largest = [np.abs(view.curve(scene, MATCHING, "G1", "G1")["sigma_n"]).max() / 1e6 for scene in TENTS]
    values = ", ".join(f"{value:.0f}" for value in largest)
    return found("corner_values_grow", smooth=text, largest=values), smooth and largest == sorted(largest)


def displacement_is_smooth(view, _):
    rough = max(measures.roughness(s, c, "u_n") for s in ("tent_a", PARABOLA) for c in view.both(s, MESH, "G1"))
    return found("displacement_is_smooth", rough=rough), rough <= VISIBLE


def from_matching(view, scene, mesh=MESH, at="nodes", active="G2", variant=OURS):
    """Mean distance of both bodies' sigma_n from matching meshes: the larger of the two."""
    curves = view.both(scene, mesh, active, at=at, variant=variant)
    references = [view.matching(scene, mesh, body, at, variant) for body in ("G1", "G2")]
    return max(measures.away(scene, *pair) for pair in zip(curves, references))


def tents_do_not_oscillate(view, _):
    values = [from_matching(view, scene) for scene in TENTS]
    text = found("tents_do_not_oscillate", distances=", ".join(map(percent, values)))
    return text, max(values) <= VISIBLE


def compared(view, larger, smaller, what, least=LARGER):
    """Two oscillations (arguments of from_matching), ours and by the variant nearest to the preprint's."""
    pair = lambda variant: [from_matching(view, *case, variant=variant) for case in (larger, smaller)]
    pairs = [pair(OURS), pair(view.like)]
    ratios = [a / b for a, b in pairs]
    ours, theirs = ((percent(a), percent(b), ratio) for (a, b), ratio in zip(pairs, ratios))
    return found("compared", what=what, ours=ours, theirs=theirs), *(ratio >= least for ratio in ratios)


def finer_active_is_smaller(view, _):
    larger, smaller = ((PARABOLA, MESH, "nodes", active) for active in ("G1", "G2"))
    return compared(view, larger, smaller, " with G1 active against G2")


def parabola_against_circle(view, scene):
    other = scene if scene != "circle" else PARABOLA
    return compared(view, (other,), ("circle",), f", {other} against circle")


def coarse_against_fine(view, _):
    return compared(view, ("parabola_1", (40, 50)), ("parabola_1",), ", 40x50 against 80x100")


def nodes_against_centres(view, scene):
    """Smaller at the centres: the ratio need only be above 1."""
    nodes, centres = ((scene, MESH, at) for at in ("nodes", "centres"))
    return compared(view, nodes, centres, ", nodes against centres", least=np.nextafter(1, 2))


def field_oscillates(view, name):
    """Visible in the field on 80x100: mean distance from matching meshes near the line, in either body."""

    def one(variant, body, n):
        pair = [measures.fields(view.folder_with_fields(PARABOLA, mesh, "G1", variant)) for mesh in (MESH, (n, n))]
        return measures.fields_apart(*pair, view.curve(PARABOLA, MESH, "G1", body, variant=variant), name, body)

    ours, theirs = ([one(variant, body, n) for body, n in zip(("G1", "G2"), MESH)] for variant in (OURS, view.like))
    text = found("field_oscillates", name=name, ours=[*map(percent, ours)], theirs=[*map(percent, theirs)])
    return text, max(ours) > VISIBLE, max(theirs) > VISIBLE


def decomposed(view, scene, mesh):
    """One curve for both bodies; far less oscillation than mortar: less than half the variant's roughness."""
    upper, lower = (view.ddm(scene, mesh, body) for body in ("G1", "G2"))
    apart, rough = measures.apart(scene, upper, lower, "p", share=0.9), measures.roughness(scene, upper, "p")
    roughest = lambda variant: max(measures.roughness(scene, c) for c in view.both(scene, mesh, "G1", variant=variant))
    ours, theirs = map(roughest, (OURS, view.like))
    residual = f"{view.ddm_residual(scene, mesh):.0e}"
    text = found("decomposed", apart=apart, residual=residual, rough=rough, ours=ours, theirs=theirs)
    return text, *(apart <= 3 * VISIBLE and rough * LARGER <= other for other in (ours, theirs))


def contact_is_lost(view, _):
    """Practically one curve; near the right end no stress, and a gap."""
    upper, lower = (view.cosine(MATCHING, "G1", body) for body in ("G1", "G2"))
    x, apart = upper["x"], np.abs(upper["sigma_n"] - lower["sigma_n"])
    open_ = np.flatnonzero((x > 0.6) & (upper["p"] == 0))
    closed = (x > NEAR) & (x < x[open_[0]] - NEAR if open_.size else True)
    mean = np.abs(upper["sigma_n"][closed]).mean()
    apart = float((apart[closed] / mean).max())
    if not open_.size:
        return found("contact_is_kept", apart=apart), False
    rest = float(np.abs(upper["sigma_n"][open_]).mean() / mean)
    opening = np.abs(upper["u_n"] - lower["u_n"])[open_].max()
    linear, quadratic = (view.cosine_status(MESH, method) for method in ({}, METHOD))
    text = template.fill(TABLE["found"]["contact_is_lost"], apart=percent(apart), first=x[open_[0]], last=x[open_[-1]],
                         rest=percent(rest), opening=opening * 1e6, touches=x[open_[-1]] < x[-1], linear=linear,
                         quadratic=quadratic)  # fmt: skip
    return text, rest < 5 * VISIBLE and opening > 0
