"""Polynomials of x and y, their coefficients real or complex."""

import numpy as np


class Polynomial:
    """c[i, j] x^i y^j."""

    def __init__(self, coefficients):
        self.c = np.atleast_2d(np.asarray(coefficients) + 0.0)

    def __add__(self, other):
        other = polynomial(other)
        sum = np.zeros(np.maximum(self.c.shape, other.c.shape), np.result_type(self.c, other.c))
        sum[: self.c.shape[0], : self.c.shape[1]] += self.c
        sum[: other.c.shape[0], : other.c.shape[1]] += other.c
        return Polynomial(sum)

    def __mul__(self, other):
        other = polynomial(other)
        product = np.zeros(np.array(self.c.shape) + other.c.shape - 1, np.result_type(self.c, other.c))
        for (i, j), value in np.ndenumerate(self.c):
            if value:
                product[i : i + other.c.shape[0], j : j + other.c.shape[1]] += value * other.c
        return Polynomial(product)

    __radd__, __rmul__ = __add__, __mul__

    def __neg__(self):
        return self * -1.0

    def __sub__(self, other):
        return self + -polynomial(other)

    def __call__(self, x, y):
        return np.polynomial.polynomial.polyval2d(x, y, self.c)

    def __format__(self, digits):
        """As an expression of a scene, to eight digits unless `digits` says else; of real coefficients."""
        power = lambda name, n: f"*{name}^{n}" if n > 1 else f"*{name}" * n
        least = 1e-14 * np.abs(self.c).max()
        terms = [f"{v:{digits or '.8g'}}{power('x', i)}{power('y', j)}" for (i, j), v in np.ndenumerate(self.c) if abs(v) > least]
        return "+".join(terms).replace("+-", "-") or "0"

    __str__ = lambda self: format(self)

    def conjugate(self):
        """The conjugate value, of real x and y."""
        return Polynomial(self.c.conjugate())

    real, imag = property(lambda self: Polynomial(self.c.real)), property(lambda self: Polynomial(self.c.imag))

    def dx(self):
        return Polynomial(self.c[1:] * np.arange(1, len(self.c))[:, None]) if len(self.c) > 1 else polynomial(0)

    def dy(self):
        if self.c.shape[1] == 1:
            return polynomial(0)
        return Polynomial(self.c[:, 1:] * np.arange(1, self.c.shape[1]))

    def over_x(self):
        """Divided by x, which it must be a multiple of."""
        assert np.all(np.abs(self.c[0]) <= 1e-9 * np.abs(self.c).max()), "not a multiple of x"
        return Polynomial(self.c[1:]) if len(self.c) > 1 else polynomial(0)

    def on(self, line):
        """A polynomial of x: itself where y is that polynomial of x."""
        sum, power = polynomial(0), polynomial(1)
        for column in self.c.T:
            sum, power = sum + Polynomial(column[:, None]) * power, power * line
        return sum


def polynomial(value):
    return value if isinstance(value, Polynomial) else Polynomial([[value]])


X, Y = Polynomial([[0], [1]]), Polynomial([[0, 1]])
