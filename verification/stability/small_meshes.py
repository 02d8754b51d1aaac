"""Small meshes and scenes of the studies' own, where geo/ has no parameter for what a study varies."""

import msh_file
from plates import Body, between, mesh_of

FORMAT = "2.2 ascii"


def mesh_text(bodies, join=()):
    """The mesh file; `join`: pairs of bodies whose nodes at the same places are one."""
    return msh_file.write(msh_file.sections(mesh_of(bodies, join), FORMAT), FORMAT).decode()


def scene_text(bodies, boundary, contact, young=210e9, poisson=0.3):
    """A scene file; `boundary` and `contact` are lists of the insides of inline tables. `young`: one, or one a body."""
    young = young if isinstance(young, (list, tuple)) else [young] * len(bodies)
    lines = ['title = "stability"', 'mesh.file = "mesh.msh"']
    lines += [f"materials.m{i} = {{ young = {E!r}, poisson = {poisson!r} }}" for i, E in enumerate(young)]
    lines.append("bodies = { " + ", ".join(f'{one.name} = "m{i}"' for i, one in enumerate(bodies)) + " }")
    lines.append("boundary = [" + ", ".join("{ " + text + " }" for text in boundary) + "]")
    lines.append("contact = [" + ", ".join("{ " + text + " }" for text in contact) + "]")
    return "\n".join(lines) + "\n"


def run(axes, bodies, boundary, contact, settings=None, measures=(), join=(), **others):
    """A run (stability_runs) on a mesh of its own."""
    physical = {key: others.pop(key) for key in ("young", "poisson") if key in others}
    return {
        "axes": axes,
        "scene": scene_text(bodies, boundary, contact, **physical),
        "files": {"mesh.msh": mesh_text(bodies, join)},
        "settings": settings or {},
        "measures": list(measures),
        **others,
    }


WIDTH = 0.8
LOAD = 'on = "upper_top", pressure = 10e6'
PRESSED = [
    'on = ["upper_left", "upper_right", "lower_left", "lower_right"], displacement = { x = 0 }',
    'on = "lower_bottom", displacement = { x = 0, y = 0 }',
    LOAD,
]
LEFT = 'on = ["upper_left", "lower_left"], displacement = { x = 0 }'
SLIDING = [LEFT, 'on = "lower_bottom", displacement = { y = 0 }', LOAD]


def touching(condition="unilateral", multipliers=None, gap=None):
    """The pair of two plates; `gap`: initial_gap, where it is not the default."""
    side = f', multipliers_on = "{multipliers}"' if multipliers else ""
    side += f', initial_gap = "{gap}"' if gap else ""
    return [f'between = ["upper_bottom", "lower_top"], condition = "{condition}"{side}']


def plates(curve, upper, lower, top=0.6, rows=6):
    """Two plates of width 0.8 m that meet along y = curve(x); `upper`, `lower`: their columns."""
    return [
        Body("lower", lower, rows, between(0, WIDTH, 0, curve)),
        Body("upper", upper, rows, between(0, WIDTH, curve, top)),
    ]
