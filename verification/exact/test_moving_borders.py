"""Contact whose border moves with the bodies' displacements: thin shells and beams pressed on a wall, and waves that are
about to close. Drawn at random; p and the length in contact are within what is said of them."""

import numpy as np
import pytest

import launch

RADIUS = 20


def rectangle(number, x, y, names):
    """Corners from the lower left on; `names` of its sides in that order."""
    corners = [(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])]
    lines = [f"Point({number + k}) = {{{a!r}, {b!r}, 0}};" for k, (a, b) in enumerate(corners)]
    lines += [f"Line({number + k}) = {{{number + k}, {number + (k + 1) % 4}}};" for k in range(4)]
    lines += [f"Curve Loop({number}) = {{{number} : {number + 3}}}; Plane Surface({number}) = {{{number}}};"]
    return "\n".join(lines + [f'Physical Curve("{name}") = {{{number + k}}};' for k, name in enumerate(names)]) + "\n"


def drawn(random, rings):
    """A shell (of rings) or a beam beside a wall, clamped at its head or at both ends, pressed on the wall by several times
    what closes the gap."""
    t = RADIUS * 10 ** random.uniform(-2.1, -1.5 if rings else -0.8)
    outside, both = rings or random.random() < 0.5, random.random() < 0.4
    young, wall = [(70e3, 210e3), (210e3, 210e3), (3e3, 210e3), (210e3, 70e3)][random.integers(4)]
    poisson = random.choice([0, 0.3, 0.45])
    if rings:
        length, gap = RADIUS * random.uniform(0.8, 1.6), t * random.uniform(0.03, 0.25)
        pressure = gap * young * t / RADIUS**2 * random.uniform(1.5, 10)
    else:
        length, gap = t * random.uniform(25, 50), t * 10 ** random.uniform(-2, -1)
        pressure = 32 * gap * young * (t / length) ** 3 * t / length / (1 if not both else 1 / 16) * random.uniform(1.5, 10)
    left = RADIUS if rings else 0.0
    sides = ["in", "out"] if outside else ["out", "in"]
    wall_x = (left + t + gap, left + t + gap + 4) if outside else (left - gap - 4, left - gap)
    wall_sides = ["face", "back"] if outside else ["back", "face"]
    geo = rectangle(10, (left, left + t), (0.0, length), ["foot", sides[1], "head", sides[0]])
    geo += rectangle(20, wall_x, (0.0, length), ["wall_foot", wall_sides[1], "wall_head", wall_sides[0]])
    geo += 'Physical Surface("shell") = {10}; Physical Surface("wall") = {20};\n'
    scene = f"""mesh.file = "s.geo"
model.plane = "{"axisymmetric" if rings else "strain"}"
materials.shell = {{ young = {young}, poisson = {poisson} }}
materials.wall = {{ young = {wall}, poisson = 0.3 }}
bodies = {{ shell = "shell", wall = "wall" }}
contact = [{{ between = ["out", "face"] }}]
boundary = [
  {{ on = "head", displacement = {{ x = 0, y = 0 }} }}, {{ on = "in", pressure = {pressure!r} }},
  {{ on = "foot", displacement = {{ {"x = 0, " if both else ""}y = 0 }} }}, {{ on = "back", displacement = {{ x = 0 }} }},
  {{ on = "wall_foot", displacement = {{ y = 0 }} }}, {{ on = "wall_head", displacement = {{ y = 0 }} }},
]
"""
    return geo, scene


def solved(folder, geo, scene, accuracy, settings=None):
    (folder / "s.geo").write_text(geo)
    (folder / "s.toml").write_text(scene)
    return launch.solve(folder / "s.toml", settings or {}, folder / "out", "--accuracy", accuracy, expected=[0])


def line_of(folder):
    """y, p and p_error along the curve `out`, by y."""
    line = launch.contact(folder / "out", "out")
    order = np.argsort(line["y"])
    return {key: line[key][order] for key in ("y", "p", "p_error")}


@pytest.mark.parametrize("rings", [True, False])
@pytest.mark.parametrize("seed", range(6))
def test_shells_on_a_wall_are_within_their_bars(mortise, tmp_path, seed, rings):
    geo, scene = drawn(np.random.default_rng([seed, rings]), rings)
    summary, line = solved(tmp_path, geo, scene, "1%"), line_of(tmp_path)
    fine, finer = solved(tmp_path, geo, scene, "0.1%", {"accuracy.first_edges": 33}), line_of(tmp_path)
    at = np.union1d(line["y"], finer["y"])
    true, found = np.interp(at, finer["y"], finer["p"]), np.interp(at, line["y"], line["p"])
    off = np.sqrt(np.trapz((found - true) ** 2, at) / np.trapz(true**2, at))
    assert off < summary["contact"][0]["pressure"]["error"]
    truly = np.interp(line["y"], finer["y"], finer["p"])
    pressed = (truly > 0) | (line["p"] > 0)
    assert np.mean((np.abs(line["p"] - truly) <= line["p_error"])[pressed]) >= 0.95
    pair, known = summary["contact"][0], fine["contact"][0]
    allowed = pair["length_in_contact_error"] + known["length_in_contact_error"]
    assert abs(pair["length_in_contact"] - known["length_in_contact"]) < allowed


@pytest.mark.parametrize("accuracy", ["1%", "0.3%", "0.1%"])
def test_waves_about_to_close_know_how_long_they_touch(mortise, tmp_path, accuracy):
    """Westergaard (1939): sin^2(pi a / L) is the mean pressure over that which closes the waves. L = 20, one half of a wave."""
    young, poisson, height, half = 210e3, 0.3, 0.005, 10
    geo = rectangle(10, (0.0, half), (-3.0 * half, 0.0), ["ground", "right", "top", "left"])
    geo += rectangle(20, (0.0, half), (0.0, 3.0 * half), ["foot", "upper_right", "head", "upper_left"])
    geo += 'Physical Surface("lower") = {10}; Physical Surface("upper") = {20};\n'
    closing = np.pi * young / (2 * (1 - poisson**2)) * height / (2 * half)
    for part in 1 - 10 ** np.random.default_rng(1).uniform(-5, -1.5, 5):
        scene = f"""mesh.file = "s.geo"
materials.steel = {{ young = {young}, poisson = {poisson} }}
bodies = {{ lower = "steel", upper = "steel" }}
contact = [{{ between = ["foot", "top"], initial_gap = "{height} * (1 - cos(pi * x / {half}))" }}]
boundary = [
  {{ on = ["left", "right", "upper_left", "upper_right"], displacement = {{ x = 0 }} }}, {{ on = "ground", displacement = {{ y = 0 }} }},
  {{ on = "head", pressure = {float(part * closing)!r} }},
]
"""
        pair = solved(tmp_path, geo, scene, accuracy)["contact"][0]
        length = 2 * half / np.pi * np.arcsin(np.sqrt(part))
        assert abs(pair["length_in_contact"] - length) < pair["length_in_contact_error"], part
        assert pair["length_in_contact_error"] < half / 10 or accuracy == "1%"
