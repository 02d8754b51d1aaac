"""A layer pressed on a half plane without friction: the receding contact of Keer, Dundurs & Tsai (J. Appl. Mech. 39
(1972) 1115-1120), from Fourier transforms: a singular integral equation, solved again here.

Layer 0 < y < 1 (its height is the unit), half plane y < 0; `ratio`: E' of the layer over that of the half plane. On top
the pressure q(x) = load_shape(x), in contact p(x), both even, as cosine transforms. With A = (cosh k - 1) / (sinh k + k)
for both faces pressed alike and B = (cosh k + 1) / (sinh k - k) for both faces pushed one way, the gap opens by

    E' k / 2 g(k) = A (q + p) / 2 + B (p - q) / 2 + ratio p,

from the strip's stress functions (Filon 1903). In contact dg/dx = 0: as A, B -> 1 the singular part is (1 + ratio) times
the Hilbert transform of p, and what is left decays as k exp(-k).
"""

import numpy as np
from scipy.optimize import brentq

HALF_LOAD = 0.5  # half the width of the load
LAST_K = 40.0


def load_shape(x):
    """q over its largest value."""
    return np.where(np.abs(x) < HALF_LOAD, (1 - (x / HALF_LOAD) ** 2) ** 2, 0.0)


LOAD = HALF_LOAD * 16 / 15  # the integral of load_shape


def faces(k):
    """A and B of the transforms."""
    return (np.cosh(k) - 1) / (np.sinh(k) + k), (np.cosh(k) + 1) / (np.sinh(k) - k)


def gauss(low, high, count):
    node, weight = np.polynomial.legendre.leggauss(count)
    return low + (high - low) * (node + 1) / 2, (high - low) / 2 * weight


def equations(half_width, ratio, count):
    """Matrix and right-hand side of dg/dx = 0 (last row: equilibrium) in the values of p / sqrt(b^2 - x^2) at the nodes
    of Gauss and Chebyshev, and these nodes (Erdogan & Gupta, Quart. Appl. Math. 29 (1972) 525)."""
    j = np.arange(1, count + 1)
    t, weight = half_width * np.cos(np.pi * j / (count + 1)), np.pi / (count + 1) * np.sin(np.pi * j / (count + 1)) ** 2
    weight = weight * half_width**2
    r = np.arange(1, count + 2)
    x = half_width * np.cos(np.pi * (2 * r - 1) / (2 * (count + 1)))
    k, dk = gauss(1e-3, LAST_K, 400)
    alike, one_way = faces(k)
    sines = dk * np.sin(np.outer(x, k)) / np.pi
    s, ds = gauss(-HALF_LOAD, HALF_LOAD, 60)
    q = ds * load_shape(s) @ (np.cos(np.outer(s, k)) - 1)  # its transform less LOAD: p's is less LOAD too
    cosines = np.cos(np.outer(k, t))
    regular = (sines * (alike - 1) / 2) @ cosines + (sines * (one_way - 1) / 2) @ (cosines - 1)
    rows = ((1 + ratio) / (np.pi * (x[:, None] - t[None, :])) + regular) * weight
    right = -(sines * (alike - 1) / 2) @ (q + LOAD) + (sines * (one_way - 1) / 2) @ q
    return np.vstack([rows, weight]), np.append(right, LOAD), t


def solve(ratio, count=60):
    """Half the width of contact, and p over the largest q as a function of x. Any width has a bounded p; the right one's
    bears the load."""

    def bears(half_width):
        """The load over what p bears, and p at the nodes over the root."""
        matrix, right, t = equations(half_width, ratio, count)
        keep = np.arange(count + 1) != count // 2  # x = 0, which symmetry fulfils
        found = np.linalg.solve(matrix[:-1][keep], right[:-1][keep])
        return LOAD / (matrix[-1] @ found), found, t

    half_width = 0.8
    while bears(half_width + 0.05)[0] > 1:
        half_width += 0.05
    half_width = brentq(lambda b: bears(b)[0] - 1, half_width, half_width + 0.05, xtol=1e-13)
    _, found, t = bears(half_width)
    series = np.polynomial.chebyshev.Chebyshev.fit(t, found, 24, domain=[-half_width, half_width])
    return half_width, lambda x: np.sqrt(np.maximum(half_width**2 - x**2, 0)) * series(x)


def bilateral_zero():
    """Where p of a layer on a rigid ground under a point force turns to tension, were it bonded against opening: Filon's
    1.35 heights."""
    k, dk = gauss(1e-3, LAST_K, 2000)
    alike, one_way = faces(k)
    pressure = lambda x: dk @ ((one_way - alike) / (one_way + alike) * np.cos(k * x))
    return brentq(pressure, 1, 2)
