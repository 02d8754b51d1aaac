"""The pressure of a round pin in a round hole of an infinite plate of the same material, without friction (A. Persson,
On the stress distribution of cylindrical elastic bodies in contact, Chalmers 1964; M. Ciavarella, P. Decuzzi, Int. J.
Solids Structures 38 (2001) 4507-4523). A weight of the pin acts as a force at its centre does: both move its rim by
cos(phi) only, which is a motion."""

import math

import numpy as np


def pressure(phi, angle):
    """p R / Q at the angle phi from the line of the force, over half of the contact's angle; Q force per thickness."""
    b2 = math.tan(angle / 2) ** 2
    y2 = np.tan(np.minimum(np.abs(phi), angle) / 2) ** 2
    root, top = np.sqrt(np.maximum(b2 - y2, 0)), math.sqrt(b2 + 1)
    closed = np.log((top + root) / (top - root)) / (2 * math.pi * b2 * (1 + b2))
    return 2 / math.pi * root / (top * (1 + y2)) + closed


def clearance(angle):
    """E dR / ((1 - nu^2) Q), dR the difference of the radii, where contact ends at `angle`; 0 at 84.8 degrees."""
    b2 = math.tan(angle / 2) ** 2
    return (2 * (1 - b2**2) - math.log(1 + b2)) / (math.pi * b2 * (1 + b2))


def widest():
    """The angle without a clearance, by bisection."""
    low, high = 1.0, 1.5
    while high - low > 1e-14:
        middle = (low + high) / 2
        low, high = (middle, high) if clearance(middle) > 0 else (low, middle)
    return low
