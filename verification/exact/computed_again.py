"""The references once more by numbers, from the equations of elasticity and not from the closed forms.

Contact of bodies whose surfaces move by G p under a pressure p: p >= 0, gap >= 0, p gap = 0 (an active set).
"""

import numpy as np


def superposed(indenter, x, axisymmetric=False, points=400):
    """p / E* at places 0 < x < 1 by flat punches that grow with the load (Jaeger, Arch. Appl. Mech. 65 (1995) 478): of
    each the pressure is that of a flat end, and the load at which contact has the half width s is Sneddon's integral."""
    node, weight = np.polynomial.legendre.leggauss(points)
    theta = np.pi / 4 * (node + 1)
    parts = np.pi / 4 * weight * np.sin(theta)

    def load(s):
        """Over E*, of contact with the half widths s."""
        slope = indenter.slope(s[..., None] * np.sin(theta))
        return 2 * s**2 * (slope * parts * np.sin(theta)).sum(-1) if axisymmetric else s * (slope * parts).sum(-1)

    x = np.asarray(x)
    root = np.sqrt(1 - x**2)[:, None]
    s = np.sqrt(x[:, None] ** 2 + (root * (node + 1) / 2) ** 2)
    step = 1e-5
    growth = (load(s + step) - load(s - step)) / (2 * step)
    flat = growth / (2 * np.pi * s**2) if axisymmetric else growth / (np.pi * s)
    return (flat * weight).sum(1) * root[:, 0] / 2


def in_contact(moves, gap, motion, weights, load):
    """Pressures p >= 0 at points, where `moves` p + gap - d `motion` = 0 or p = 0, with weights p = load; d is found."""
    active = np.ones(len(gap), bool)
    for _ in range(200):
        some = np.flatnonzero(active)
        system = np.block([[moves[np.ix_(some, some)], -motion[some, None]], [weights[some], np.zeros(1)]])
        *found, rigid = np.linalg.solve(system, np.append(-gap[some], load))
        p = np.zeros(len(gap))
        p[some] = found
        wanted = np.where(active, p > 0, moves @ p + gap < rigid * motion)
        if (wanted == active).all():
            return p
        active = wanted
    raise AssertionError("the active set goes round")


def half_plane(profile, load, width=1.5, count=600):
    """(x, p / E*) by linear pressures on a half plane: the surface sinks by -2 / (pi E*) times the integral of
    p(t) ln |x - t| (Johnson, eq. 2.25b). `profile`: the gap f(x)."""
    x = np.linspace(-width, width, count + 1)
    step = x[1] - x[0]
    twice = lambda s: np.where(s == 0, 0, s**2 * (np.log(np.maximum(np.abs(s), 1e-300)) / 2 - 0.75))
    s = x[:, None] - x[None, :]
    moves = -2 / np.pi * (twice(s + step) - 2 * twice(s) + twice(s - step)) / step
    return x, in_contact(moves, profile(x), np.ones(len(x)), np.full(len(x), step), load)


def pin(clearance, load, count=1024, terms=60000):
    """(phi, p) of a disk in a hole of an infinite plate, both of radius 1, by linear pressures. cos(n phi) of pressure
    moves both surfaces together by 2 / E' times 2 n / (n^2 - 1), one for n = 0 (Muskhelishvili's potentials
    z^(n+1), z^(n-1) of either body); cos(phi) is a motion. clearance: E' dR; load: Q."""
    phi = 2 * np.pi * np.arange(count) / count - np.pi
    n = np.arange(2, terms)
    step = 2 * np.pi / count
    smooth = np.sinc(n / count) ** 2  # of the linear function
    kernel = np.zeros(count)
    np.add.at(kernel, n % count, 4 * n / (n**2 - 1) * smooth)  # what count points tell apart
    kernel = step / np.pi * (np.fft.fft(kernel).real + 1)
    moves = kernel[(np.arange(count)[:, None] - np.arange(count)[None, :]) % count]
    half = np.abs(phi) < np.pi / 2  # contact is no wider
    phi, moves = phi[half], moves[np.ix_(half, half)]
    return phi, in_contact(moves, np.full(len(phi), clearance), np.cos(phi), step * np.cos(phi), load)
