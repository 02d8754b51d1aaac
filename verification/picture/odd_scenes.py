"""Small scenes for pictures: every kind of support, load and gap, and names and titles that are no plain words."""

NAMES = ["=a", "+b", "-c", "@d", "$x$", "a$b", "_under", "12", "-3e5", "nan", "50 %", "a,b;c", "{x}", "\\frac", "^a_b",
         "ünï 漢字", "'=a", "long " * 40, " edge "]
TITLES = ["", "$", "costs 5 $ and 7 $", "$\\frac{$", "two\nlines\tand a tab", "a \"quoted\" 'title' with %d and {x}",
          "=SUM(A1)", "ünï 漢字 \u202e", "word " * 200, "x" * 400, "\u0007"]
PLANES = ["strain", "stress", "axisymmetric"]

# What holds the lower body's ground, the block's top and side; the sides hold x where the rest does not.
SUPPORTS = {
    "clamp": "{ on = 'ground', displacement = { x = 0, y = 0 } }",
    "normal": "{ on = 'ground', displacement = { normal = 0 } }",
    "direction": "{ on = 'ground', displacement = { direction = [0, 1], value = '1e-4 * x' } }",
    "foundation": "{ on = 'ground', foundation = 1e3 }",
    "foundation by place": "{ on = 'ground', foundation = ['1e3 * (1 + x)', 2e3] }",
    "rigid": "{ on = 'ground', rigid = { x = 0, y = 0, rotation = 0 } }",
    "rigid with a force": "{ on = 'ground', rigid = { x = 0, y = 0, rotation = 0, force = [0, 3], about = [1.5, 0.1] } }",
    "springs": "{ on = 'corner', spring = [1e3, 2e3] }, { on = 'corner_2', spring = 1e4 }",
    "points": "{ on = ['corner', 'corner_2'], displacement = { x = 0, y = 0 } }",
}
LOADS = {
    "pressure": "{ on = 'top', pressure = '3 * (1 + x)' }",
    "traction": "{ on = 'top', traction = [0, -3] }",
    "force": "{ on = 'top', force = [0, -3] }",
    "point": "{ on = 'corner_3', force = [0, -3] }, { on = 'top', rigid = { x = 0, rotation = 0 } }",
    "rigid": "{ on = 'top', rigid = { x = 0, rotation = 0, force = [0, -3], moment = 0.1 } }",
    "displacement": "{ on = 'top', displacement = { y = -1e-3 } }",
    "pull": "{ on = 'top', pressure = -1e-3 }, { on = 'top_2', displacement = { y = -1e-3 } }",
}
GAPS = ["", "initial_gap = -1e-4", "initial_gap = '1e-5 * x'", "initial_gap = 'closed'", "initial_gap = 'measured'",
        "clearance = -1e-4", "condition = 'tied'", "condition = 'bilateral'"]


def geometry(foot="foot", track="track", low="low", up="up"):
    """Two blocks on one another; the radius begins at 1, so that they may be rings too."""
    return f"""
SetFactory("OpenCASCADE");
Rectangle(1) = {{1, 0, 0, 2, 1}}; Rectangle(2) = {{1.5, 1, 0, 1, 1}};
Mesh.ElementOrder = 2; Mesh.MeshSizeMax = 0.4;
Physical Surface("{low}") = {{1}}; Physical Surface("{up}") = {{2}};
Physical Curve("ground") = {{1}}; Physical Curve("{track}") = {{3}};
Physical Curve("{foot}") = {{5}}; Physical Curve("top") = {{7}};
Physical Curve("side") = {{4}}; Physical Curve("side_2") = {{8}}; Physical Curve("top_2") = {{6}};
Physical Point("corner") = {{1}}; Physical Point("corner_2") = {{2}}; Physical Point("corner_3") = {{7}};
"""


def toml_text(text):
    """A TOML string of any text."""
    escaped = "".join(c if c.isprintable() and c not in '"\\' else f"\\u{ord(c):04X}" for c in text)
    return f'"{escaped}"'


def scene(support="clamp", load="pressure", gap="", plane="strain", title="", foot="foot", track="track", low="low", up="up"):
    """The text of its .toml, over blocks.geo."""
    of = toml_text
    holds = "" if plane == "axisymmetric" else "{ on = ['side', 'side_2'], displacement = { x = 0 } },"
    return f"""
title = {of(title)}
mesh.file = "blocks.geo"
model.plane = "{plane}"
materials.steel = {{ young = 1e4, poisson = 0.3, thermal_expansion = 1e-6, density = 1e-6 }}
bodies = {{ {of(low)} = "steel", {of(up)} = "steel" }}
boundary = [ {holds} {SUPPORTS[support]}, {LOADS[load]} ]
body_force = [{{ body = "*", force = [0, -1e-3] }}]
initial_strain = [{{ body = {of(up)}, temperature_change = 1 }}]
contact = [{{ between = [{of(foot)}, {of(track)}]{", " + gap if gap else ""} }}]
"""
