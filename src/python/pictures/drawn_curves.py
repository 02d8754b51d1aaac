"""Named curves as lines of points, from what mortise writes of a geometry (src/results/setup_json.hpp)."""

import numpy as np

from drawn_cells import polylines


def chained(edges):
    """Edges (start, end, ...) in the order in which one begins where another ends; of one that two bodies share, the first's."""
    following, seen = {}, set()
    for edge in edges:
        if (edge[1], edge[0]) not in seen:
            seen.add((edge[0], edge[1]))
            following[edge[0]] = edge
    ends = {edge[1] for edge in following.values()}
    chain = []
    for first in [edge for edge in edges if edge[0] not in ends] + edges:
        edge = following.pop(first[0], None)
        while edge is not None:
            chain.append(edge)
            edge = following.pop(edge[1], None)
    return chain


def lines_of(nodes, edges):
    """Of each edge [start, end, middle, body, places] its points, with the body on their left; as it is drawn, where that is known."""
    chain = chained(edges)
    lines = polylines(nodes, [edge[:3] for edge in chain])
    return [np.array(edge[4]) if edge[4] else line for edge, line in zip(chain, lines)]
