# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubic curves in the plane: length, splitting, turning. Points are pairs (x, y) in centimetres; a curve is four."""
import math


def add(p, q, factor=1.0):
    return (p[0] + factor * q[0], p[1] + factor * q[1])


def mix(p, q, t):
    return (p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]))


def distance(p, q):
    return math.hypot(q[0] - p[0], q[1] - p[1])


def direction(p, q):
    d = distance(p, q)
    return ((q[0] - p[0]) / d, (q[1] - p[1]) / d)


def straight(p, q):
    return (p, mix(p, q, 1 / 3), mix(p, q, 2 / 3), q)


def is_straight(curve):
    p, a, b, q = curve
    u = direction(p, q)
    off = [abs((c[0] - p[0]) * u[1] - (c[1] - p[1]) * u[0]) for c in (a, b)]
    return max(off) < 1e-9


def split(curve, t):
    """The parts before and after parameter t."""
    p, a, b, q = curve
    pa, ab, bq = mix(p, a, t), mix(a, b, t), mix(b, q, t)
    pab, abq = mix(pa, ab, t), mix(ab, bq, t)
    middle = mix(pab, abq, t)
    return (p, pa, pab, middle), (middle, abq, bq, q)


def point(curve, t):
    return split(curve, t)[0][3]


def length(curve):
    """By Simpson's rule over the speed."""
    p, a, b, q = curve
    d = [(v[0] - u[0], v[1] - u[1]) for u, v in ((p, a), (a, b), (b, q))]

    def speed(t):
        s = 1.0 - t
        w = (s * s, 2.0 * s * t, t * t)
        return math.hypot(sum(wi * di[0] for wi, di in zip(w, d)), sum(wi * di[1] for wi, di in zip(w, d)))

    steps = 40
    inner = sum((4.0 if i % 2 else 2.0) * speed(i / steps) for i in range(1, steps))
    return (speed(0.0) + inner + speed(1.0)) / steps


def solve(function, low, high):
    """Where an increasing function is zero, by halving."""
    for _ in range(60):
        middle = 0.5 * (low + high)
        if function(middle) < 0:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def split_at_lengths(curve, lengths):
    """Pieces of these lengths from the start, then the rest."""
    pieces = []
    for wanted in lengths:
        t = solve(lambda t: length(split(curve, t)[0]) - wanted, 0.0, 1.0)
        piece, curve = split(curve, t)
        pieces.append(piece)
    return pieces + [curve]


def from_tangents(p, p_direction, p_reach, q, q_direction, q_reach):
    """From p to q: leaves p along p_direction, arrives at q along q_direction (unit)."""
    return (p, add(p, p_direction, p_reach), add(q, q_direction, -q_reach), q)


def at_angle(degrees):
    return (math.cos(math.radians(degrees)), math.sin(math.radians(degrees)))
