"""Writes manufactured.toml beside it: parabola 1 under the loads of a field that is known everywhere.

The field is tests/support/manufactured.hpp's, from the potentials of Kolosov and Muskhelishvili: 2 mu (u_x + i u_y) =
kappa phi - z conj(phi') - conj(psi), sigma_xx + sigma_yy = 4 Re phi', sigma_yy - sigma_xx + 2 i sigma_xy =
2 (conj(z) phi'' + psi').
"""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "common"))

from polynomial import Polynomial, polynomial

YOUNG, POISSON = 1000.0, 0.3
PHI = (0, 0, 0.3 - 0.2j, -0.4 + 0.3j, 0.25 + 0.35j)  # coefficients of 1, z, z^2, ...
PSI = (0, -0.5 + 0.1j, 0.3 + 0.4j, -0.2 + 0.3j)
Z = Polynomial([[0, 1j], [1, 0]])
SLOPE = Polynomial([[1], [-2.5]])  # h' of the contact line y = h(x)

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


def of_z(coefficients):
    """A polynomial in z, by Horner."""
    found = polynomial(0)
    for c in reversed(coefficients):
        found = found * Z + c
    return found


def derivative(coefficients):
    return [k * c for k, c in enumerate(coefficients)][1:]


def field():
    """u_x, u_y; sigma_xx, sigma_yy, sigma_xy."""
    mu, kappa = YOUNG / 2 / (1 + POISSON), 3 - 4 * POISSON
    dphi = derivative(PHI)
    u = (of_z(PHI) * kappa - Z * of_z(dphi).conjugate() - of_z(PSI).conjugate()) * (0.5 / mu)
    total = of_z(dphi).real * 4
    other = (Z.conjugate() * of_z(derivative(dphi)) + of_z(derivative(PSI))) * 2
    return (u.real, u.imag), ((total - other.real) * 0.5, (total + other.real) * 0.5, other.imag * 0.5)


def boundaries():
    """Curves with what is prescribed there."""
    text = "{:.14g}".format
    (u, v), (xx, yy, xy) = field()
    yield ["top", "bottom"], f'displacement = {{ x = "{text(u)}", y = "{text(v)}" }}'
    for side, sign in (("left", -1.0), ("right", 1.0)):
        tractions = ", ".join(f'"{text(s * sign)}"' for s in (xx, xy))
        yield [f"upper_{side}", f"lower_{side}"], f"traction = [{tractions}]"
    # Along t = (1, h') / w the line with the normal (-h', 1) / w has the traction t . sigma . n, w^2 = 1 + h'^2.
    shear = xy - SLOPE * SLOPE * xy + SLOPE * (yy - xx)
    w = f"(1 + ({text(SLOPE)})^2)"
    for body, sign in (("lower", 1), ("upper", -1)):
        along = f"{sign} * ({text(shear)}) / ({w} * sqrt({w}))"
        yield [f"{body}_contact"], f'traction = ["{along}", "{along} * ({text(SLOPE)})"]'


def scene_text():
    entries = (f"[[boundary]]\non = {curves!r}\n{given}\n".replace("'", '"') for curves, given in boundaries())
    return HEAD.format(young=YOUNG, poisson=POISSON) + "\n" + "\n".join(entries)


if __name__ == "__main__":
    Path(__file__).with_suffix(".toml").write_text(scene_text())
