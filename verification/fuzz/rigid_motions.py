"""Whether contact carries the loads of an assembly, apart from mortise: a linear programme on the rigid motions.

Frictionless contact of elastic bodies has an answer unless a rigid motion that opens no contact lets the loads do work.
"""

import math

import numpy as np
from scipy.optimize import linprog


def polyline(piece, count=24):
    """Places along a straight curve or an arc of less than half a turn."""
    _, word, points = piece
    a, b, t = np.array(points[0]), np.array(points[-1]), np.linspace(0, 1, count + 1)[:, None]
    if word == "Line":
        return a + t * (b - a)
    centre = np.array(points[1])
    start, end = (math.atan2(*(place - centre)[::-1]) for place in (a, b))
    angle = start + t[:, 0] * ((end - start + math.pi) % (2 * math.pi) - math.pi)
    return centre + np.linalg.norm(a - centre) * np.column_stack([np.cos(angle), np.sin(angle)])


def area_and_centre(loop):
    """Of a loop; the area is positive counter-clockwise."""
    x, y = np.concatenate([polyline(piece)[:-1] for piece in loop]).T
    cross = x * np.roll(y, -1) - np.roll(x, -1) * y
    area = cross.sum() / 2
    return area, np.array([((v + np.roll(v, -1)) * cross).sum() / (6 * area) for v in (x, y)])


def segments(part, curve):
    """Starts and ends of short pieces of a curve, the body on their left."""
    found = []
    for k, loop in enumerate(part.loops):
        left = (area_and_centre(loop)[0] > 0) == (k == 0)  # further loops are holes
        for piece in (piece for piece in loop if piece[0] == curve):
            line = polyline(piece)
            found.append(np.stack([line[:-1], line[1:]], 1) if left else np.stack([line[1:], line[:-1]], 1))
    return np.concatenate(found)


def segments_of(assembly, curve):
    name, piece = curve.split("_")
    return segments(next(part for part in assembly.parts if part.name == name), piece)


MIDDLE = (0.5,)
TO_THE_ENDS = (1e-6, 0.5, 1 - 1e-6)  # a load may press at the very end of a side


def openings(assembly, pair, at=MIDDLE):
    """Of each place of the first curve from which a normal meets the second: the place, the normal, the gap. `at`: parts of
    each short piece of the curve."""
    mine, other = (segments_of(assembly, curve) for curve in pair)
    along, beyond = mine[:, 1] - mine[:, 0], other[:, 1] - other[:, 0]
    place = np.concatenate([mine[:, 0] + part * along for part in at])
    along = np.tile(along, (len(at), 1))
    normal = np.column_stack([along[:, 1], -along[:, 0]]) / np.linalg.norm(along, axis=1)[:, None]
    cross = lambda a, b: a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    away, across = other[None, :, 0] - place[:, None], cross(normal[:, None], beyond[None])
    with np.errstate(divide="ignore", invalid="ignore"):
        gap, t = cross(away, beyond[None]) / across, cross(away, normal[:, None]) / across
    # The second curve faces the first, and lies before it: an overlap is a small part of an edge.
    met = (t >= 0) & (t <= 1) & (gap > -0.1 * assembly.size) & (across < 0)
    gap = np.where(met, gap, np.inf).min(1)
    return place[np.isfinite(gap)], normal[np.isfinite(gap)], gap[np.isfinite(gap)]


def centre_of(assembly, curve):
    """Of a curve whose pieces are arcs about one centre; None of any other."""
    name, piece = curve.split("_")
    part = next(part for part in assembly.parts if part.name == name)
    centres = {points[1] if word == "Circle" else None for loop in part.loops for end, word, points in loop if end == piece}
    return np.array(next(iter(centres))) if len(centres) == 1 and None not in centres else None


def nearest(assembly, pair):
    """Of the openings of a pair those where the sides are nearest; where curves touch, one there, on the line of centres or
    that through the centre at right angles to what is straight: to first order no other is felt."""
    place, normal, gap = openings(assembly, pair)
    near = gap <= gap.min(initial=np.inf) + 1e-2 * assembly.size
    place, normal, gap = place[near], normal[near], gap[near]
    turn = np.abs(normal - normal[:1]).max(initial=0.0)
    if turn < 1e-9 or turn > 0.5:  # flat, or all along one another
        return place, normal, gap
    one, other = (centre_of(assembly, curve) for curve in pair)
    if one is not None and other is not None and np.allclose(one, other):  # sectors of rings
        return place, normal, gap
    if one is not None and other is not None:
        exact = other - one
    else:
        start, end = segments_of(assembly, pair[0 if one is None else 1])[0]
        exact = np.array([start[1] - end[1], end[0] - start[0]])
    exact = exact / np.linalg.norm(exact) * np.sign(exact @ normal.mean(0))
    centre = other if one is None else one
    return (centre + (place.mean(0) - centre) @ exact * exact)[None], exact[None], gap[:1]


def drift(assembly, near_only):
    """The most work that the loads can do on rigid motions of at most 1, over the sum of the loads' sizes: 0 where contact
    carries them. Such a motion opens no contact further: all that face each other along the normals of either side (which of
    them counts is the side's with the multipliers), or only the nearest places."""
    column = {part.name: 3 * k for k, part in enumerate(assembly.parts)}
    reach = max(np.abs(polyline(piece)).max() for part in assembly.parts for loop in part.loops for piece in loop)
    at = lambda place, way: np.array([way[0], way[1], (place[0] * way[1] - place[1] * way[0]) / reach])
    closes, fixed, work, total = [], [], np.zeros(3 * len(column)), 0.0
    pairs = [*assembly.pairs, *([] if near_only else [pair[::-1] for pair in assembly.pairs])]
    for pair in pairs:
        first, second = (column[end.split("_")[0]] for end in pair)
        for place, normal, gap in zip(*(nearest(assembly, pair) if near_only else openings(assembly, pair, TO_THE_ENDS))):
            row = np.zeros(len(work))
            row[first : first + 3], row[second : second + 3] = at(place, normal), -at(place + gap * normal, normal)
            closes.append(row)
    for first, second, force in assembly.ties:  # free along the normal
        name, curve = first.split("_")
        start, end = segments(next(part for part in assembly.parts if part.name == name), curve)[0]
        along, jump = (end - start) / np.linalg.norm(end - start), np.zeros((3, len(work)))
        for of, sign in ((name, 1), (second.split("_")[0], -1)):
            jump[0, column[of] :][:3], jump[1, column[of] :][:3] = sign * at(start, along), sign * at(start, (along[1], -along[0]))
            jump[2, column[of] + 2] += sign
        fixed += [jump[0], jump[2]]
        work += force * jump[1]
        total += 2 * abs(force)
    for part in assembly.parts:
        for curve, axes in part.held.items():
            for place in segments(part, curve)[:: 6, 0]:
                for axis in axes:
                    fixed.append(np.zeros(len(work)))
                    fixed[-1][column[part.name] :][:3] = at(place, (axis == "x", axis == "y"))
        for k, loop in enumerate(part.loops):
            area, centre = area_and_centre(loop)
            force = np.array(part.force) * abs(area) * (1 if k == 0 else -1)
            work[column[part.name] :][:3] += at(centre, force)
            total += np.abs(force).sum()
    if total == 0:
        return 0.0
    found = linprog(-work / total, closes or None, np.zeros(len(closes)) if closes else None, fixed or None,
                    np.zeros(len(fixed)) if fixed else None, bounds=(-1, 1), method="highs")  # fmt: skip
    return -found.fun
