"""Writes manufactured.toml beside it: parabola 1 under the loads of a field that is known everywhere.

The field is tests/support/manufactured.hpp's, from the potentials of Kolosov and Muskhelishvili: 2 mu (u_x + i u_y) =
kappa phi - z conj(phi') - conj(psi), sigma_xx + sigma_yy = 4 Re phi', sigma_yy - sigma_xx + 2 i sigma_xy =
2 (conj(z) phi'' + psi'). Polynomials in x and y are dictionaries: powers of x and y, coefficient.
"""

from pathlib import Path

YOUNG, POISSON = 1000.0, 0.3
PHI = (0, 0, 0.3 - 0.2j, -0.4 + 0.3j, 0.25 + 0.35j)  # coefficients of 1, z, z^2, ...
PSI = (0, -0.5 + 0.1j, 0.3 + 0.4j, -0.2 + 0.3j)
Z = {(1, 0): 1, (0, 1): 1j}
SLOPE = {(0, 0): 1, (1, 0): -2.5}  # h' of the contact line y = h(x)

HEAD = """title = "Two plates along parabola 1 under the loads of a known field"
# Written by manufactured.py: exact displacements on top and bottom, exact tractions on the vertical sides, exact
# tangential ones on the contact line; the normal ones are left to the contact.
materials.elastic = {{ young = {young}, poisson = {poisson} }}
bodies = {{ upper = "elastic", lower = "elastic" }}

[mesh]
file = "../../geo/parabola_1.geo"
parameters = {{ n_upper = 8, n_lower = 10 }}

[[contact]]
between = ["upper_contact", "lower_contact"]
condition = "bilateral"
initial_gap = "closed"
"""


def plus(a, b, factor=1):
    return {key: a.get(key, 0) + factor * b.get(key, 0) for key in {**a, **b}}


def times(a, b):
    product = {}
    for (i, j), s in a.items():
        for (k, m), t in b.items():
            product[i + k, j + m] = product.get((i + k, j + m), 0) + s * t
    return product


def conjugate(a):
    return {key: complex(value).conjugate() for key, value in a.items()}


def of_z(coefficients):
    """A polynomial in z, by Horner."""
    found = {}
    for c in reversed(coefficients):
        found = plus(times(found, Z), {(0, 0): c})
    return found


def derivative(coefficients):
    return [k * c for k, c in enumerate(coefficients)][1:]


def real(a):
    return {key: complex(value).real for key, value in a.items()}


def imaginary(a):
    return {key: complex(value).imag for key, value in a.items()}


def text(a):
    power = lambda x, n: f" * {x}^{n}" if n > 1 else f" * {x}" * n
    terms = [f"{value:.15g}{power('x', i)}{power('y', j)}" for (i, j), value in sorted(a.items()) if value]
    return " + ".join(terms).replace("+ -", "- ")


def field():
    """u_x, u_y; sigma_xx, sigma_yy, sigma_xy."""
    mu, kappa = YOUNG / 2 / (1 + POISSON), 3 - 4 * POISSON
    dphi = derivative(PHI)
    u = times({(0, 0): kappa / (2 * mu)}, of_z(PHI))
    u = plus(u, times(Z, conjugate(of_z(dphi))), -1 / (2 * mu))
    u = plus(u, conjugate(of_z(PSI)), -1 / (2 * mu))
    total = times({(0, 0): 4}, real(of_z(dphi)))
    other = times({(0, 0): 2}, plus(times(conjugate(Z), of_z(derivative(dphi))), of_z(derivative(PSI))))
    half = {(0, 0): 0.5}
    return (real(u), imaginary(u)), (times(half, plus(total, real(other), -1)), times(half, plus(total, real(other))),
                                     times(half, imaginary(other)))  # fmt: skip


def boundaries():
    """Curves with what is prescribed there."""
    (u, v), (xx, yy, xy) = field()
    yield ["top", "bottom"], f'displacement = {{ x = "{text(u)}", y = "{text(v)}" }}'
    for side, sign in (("left", -1), ("right", 1)):
        tractions = ", ".join(f'"{text(times({(0, 0): sign}, s))}"' for s in (xx, xy))
        yield [f"upper_{side}", f"lower_{side}"], f"traction = [{tractions}]"
    # Along t = (1, h') / w the line with the normal (-h', 1) / w has the traction t . sigma . n, w^2 = 1 + h'^2.
    shear = plus(plus(xy, times(times(SLOPE, SLOPE), xy), -1), times(SLOPE, plus(yy, xx, -1)))
    w = f"(1 + ({text(SLOPE)})^2)"
    for body, sign in (("lower", 1), ("upper", -1)):
        along = f"{sign} * ({text(shear)}) / ({w} * sqrt({w}))"
        yield [f"{body}_contact"], f'traction = ["{along}", "{along} * ({text(SLOPE)})"]'


def scene_text():
    entries = (f"[[boundary]]\non = {curves!r}\n{given}\n".replace("'", '"') for curves, given in boundaries())
    return HEAD.format(young=YOUNG, poisson=POISSON) + "\n" + "\n".join(entries)


if __name__ == "__main__":
    Path(__file__).with_suffix(".toml").write_text(scene_text())
