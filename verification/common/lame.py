"""Two rings in contact under pressure, those of geo/rings.toml: Lame's solution, plane strain."""

RINGS = {"radii": (1, 2, 3), "inside": 10e6, "outside": 4e6, "materials": [(210e9, 0.3), (70e9, 0.3)]}


def ring(young, poisson, inside, outside, a, b):
    """A, B and u_r(r): sigma_r = A - B / r^2, sigma_t = A + B / r^2, u_r = (1 + nu) / E ((1 - 2 nu) A r + B / r)."""
    A = (inside * a**2 - outside * b**2) / (b**2 - a**2)
    B = (inside - outside) * a**2 * b**2 / (b**2 - a**2)
    return A, B, lambda r: (1 + poisson) / young * ((1 - 2 * poisson) * A * r + B / r)


def lame(materials):
    """The contact pressure, and `ring` of the inner and the outer one; `materials`: E and nu of both."""
    a, b, c = RINGS["radii"]
    inner = lambda p: ring(*materials[0], RINGS["inside"], p, a, b)
    outer = lambda p: ring(*materials[1], p, RINGS["outside"], b, c)
    gap = lambda p: outer(p)[2](b) - inner(p)[2](b)
    some = RINGS["inside"]
    exact = -gap(0) * some / (gap(some) - gap(0))  # the gap is linear in p
    return exact, [inner(exact), outer(exact)]
