"""Fields of two bodies that slide along a curve, known everywhere.

The bodies meet along y = h(x), with N = (-h', 1), W = |N|^2 and f = y - h. Their displacements are a common one, a slip
along the curve, and in the softer body f a(x) e_y, which moves nothing on the curve and makes both normal stresses equal:
N . C : eps(f a e_y) . N = (lambda + 2 mu) W a there. The common part and the slip are without divergence but for a part
of the size of mu / lambda, so that stresses stay bounded as nu goes to 1/2.
"""

from dataclasses import dataclass

import numpy as np

from polynomial import X, Y, polynomial

SIZE = 1e-4  # of the strains


@dataclass(frozen=True)
class Law:
    young: float
    poisson: float
    plane: str

    @property
    def mu(self):
        return self.young / 2 / (1 + self.poisson)

    @property
    def lam(self):
        if self.plane == "stress":
            return self.young * self.poisson / (1 - self.poisson**2)
        return self.young * self.poisson / (1 + self.poisson) / (1 - 2 * self.poisson)

    def stress(self, strain):
        """(xx, yy, zz, xy) of (xx, yy, zz, xy), xy the tensor component; zz is zero in plane models."""
        xx, yy, zz, xy = strain
        trace = (xx + yy + zz) * self.lam
        return [trace + xx * (2 * self.mu), trace + yy * (2 * self.mu), trace + zz * (2 * self.mu), xy * (2 * self.mu)]


class Quotient:
    """a = P / W and its first two derivatives, of x."""

    def __init__(self, P, W):
        self.P, self.W = P, W
        dP, dW = P.dx(), W.dx()
        # Numerators over W, W^2 and W^3.
        self.numerators = [P, dP * W - P * dW,
                           (dP.dx() * W - P * dW.dx()) * W - (dP * W - P * dW) * dW * 2.0]  # fmt: skip

    def value(self, k, x):
        return self.numerators[k](x, 0 * x) / self.W(x, 0 * x) ** (k + 1)


class Part:
    """A field: the sum of c[0] and c[k + 1] times the k-th derivative of a quotient; c are polynomials of x and y."""

    def __init__(self, quotient, *c):
        self.quotient, self.c = quotient, [polynomial(value) for value in c] + [polynomial(0)] * (4 - len(c))

    def __add__(self, other):
        return Part(self.quotient or other.quotient, *(a + b for a, b in zip(self.c, other.c)))

    def __mul__(self, factor):
        return Part(self.quotient, *(a * factor for a in self.c))

    def __sub__(self, other):
        return self + other * -1.0

    def __call__(self, x, y):
        return self.c[0](x, y) + sum(c(x, y) * self.quotient.value(k, x) for k, c in enumerate(self.c[1:]) if c.c.any())

    def __str__(self):
        parts = [k for k, c in enumerate(self.c[1:]) if c.c.any()]
        if not parts:
            return str(self.c[0])
        numerators, W = self.quotient.numerators, self.quotient.W
        sum, power = polynomial(0), max(parts) + 1
        for k in parts:
            term = self.c[k + 1] * numerators[k]
            for _ in range(k + 1, power):
                term = term * W
            sum = sum + term
        return f"{self.c[0]} + ({sum})/({W})^{power}"

    def dx(self):
        c = [a.dx() for a in self.c]
        assert not self.c[3].c.any(), "no third derivative"
        return Part(self.quotient, c[0], c[1], c[2] + self.c[1], c[3] + self.c[2])

    def dy(self):
        return Part(self.quotient, *(a.dy() for a in self.c))

    def over_x(self):
        return Part(self.quotient, *(a.over_x() for a in self.c))


def strain(u, rings):
    """Of displacements that in rings are a multiple of x along x."""
    nothing = u[0] * 0.0
    return [u[0].dx(), u[1].dy(), u[0].over_x() if rings else nothing, (u[0].dy() + u[1].dx()) * 0.5]


def curl(stream, rings):
    """Without divergence: (stream_y, -stream_x); of rings that of stream x^2, over x."""
    return [X * stream.dy(), stream * -2.0 - X * stream.dx()] if rings else [stream.dy(), -stream.dx()]


def plus(u, v, factor=1.0):
    return [a + b * factor for a, b in zip(u, v)]


def random_polynomial(random, degree, centre, even):
    """About the centre; even in x on request."""
    powers = lambda base: [polynomial(1.0), *np.cumprod(np.full(degree, base, dtype=object))]
    x, y, sum = powers(X - centre[0]), powers(Y - centre[1]), polynomial(0)
    for i in range(0, degree + 1, 2 if even else 1):
        for j in range(degree + 1 - i):
            sum = sum + x[i] * y[j] * random.uniform(-SIZE, SIZE)
    return sum


class SlidingFields:
    """Of the lower and the upper body `u`, `stress` and `initial` strains (None: it has none)."""

    def __init__(self, random, line, laws, x0, strains):
        """`line`: h. `laws`: of both bodies, one model. `x0`: the smallest x; where it is the axis of rings the line is
        straight. `strains`: initial strains make the stiffer body's displacements but for a part as its softness."""
        self.rings, self.axis = laws[0].plane == "axisymmetric", laws[0].plane == "axisymmetric" and x0 == 0
        self.line, self.slope = line, line.dx()
        W = self.slope * self.slope + 1
        f = Y - line
        draw = lambda degree: random_polynomial(random, degree, (0 if self.axis else x0 + 0.5, 0.5), self.axis)
        common = curl(draw(3 if self.rings else 4), self.rings)
        small = min([1.0] + [law.mu / law.lam for law in laws if law.lam > 0])
        common = plus(common, [X * draw(1), draw(2)] if self.rings else [draw(3), draw(3)], small)
        # The curl of f chi is (1, h') chi on the line, of rings x times that.
        slip = curl(f * draw(1 if self.rings else 3).on(polynomial(0)), self.rings)
        soft, stiff = (0, 1) if laws[0].young <= laws[1].young else (1, 0)
        u = [[Part(None, c) for c in part] for part in (common, plus(common, slip))]
        stressed = list(u)
        if strains:
            stressed[stiff] = [c * (laws[soft].young / laws[stiff].young) for c in u[stiff]]
        jump = self.normal_stress(laws[stiff].stress(strain(stressed[stiff], self.rings)))
        jump = jump - self.normal_stress(laws[soft].stress(strain(stressed[soft], self.rings)))
        bulge = self.bulge(f, jump * (1 / (laws[soft].lam + 2 * laws[soft].mu)), W)
        u[soft], stressed[soft] = plus(u[soft], bulge), plus(stressed[soft], bulge)
        self.u, self.stress = u, [law.stress(strain(part, self.rings)) for law, part in zip(laws, stressed)]
        self.initial = [None, None]
        if strains:
            self.initial[stiff] = strain(plus(u[stiff], stressed[stiff], -1.0), self.rings)

    def normal_stress(self, s):
        """N . s . N on the line, of stresses that are polynomials."""
        h = self.slope
        return (s[0].c[0] * h * h - s[3].c[0] * h * 2.0 + s[1].c[0]).on(self.line)

    @staticmethod
    def bulge(f, P, W):
        """f a e_y, a = P / W."""
        if not W.c[1:].any():  # a straight, level line
            return [Part(None, 0), Part(None, f * P * (1 / W.c[0, 0]))]
        return [Part(None, 0), Part(Quotient(P, W), 0, f)]

    def pressure(self, x, y):
        slope = self.slope(x, 0 * x)
        xx, yy, _, xy = (component(x, y) for component in self.stress[0])
        return -(xx * slope**2 - 2 * xy * slope + yy) / (1 + slope**2)

    def body_force(self, body):
        """Minus the divergence of the stress, expressions."""
        s = self.stress[body]
        fx, fy = (s[0].dx() + s[3].dy()) * -1.0, (s[3].dx() + s[1].dy()) * -1.0
        if not self.rings:
            return [str(fx), str(fy)]
        fx = fx - (s[0] - s[2]).over_x()
        return [str(fx), str(fy - s[3].over_x()) if self.axis else f"{fy} - ({s[3]})/x"]

    def shear(self, body):
        """Traction along the line, expressions: t (t . s . n), upwards out of the lower body."""
        s, h = self.stress[body], self.slope
        if not h.c.any():
            return [str(s[3] * (1.0 if body == 0 else -1.0)), "0"]
        along = (s[3] * (polynomial(1) - h * h) + (s[1] - s[0]) * h) * (1.0 if body == 0 else -1.0)  # t . s . N, t = (1, h')
        tangent = f"({along})/({h * h + 1})^1.5"
        return [tangent, f"{tangent}*({h})"]
