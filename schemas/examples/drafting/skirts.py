# SPDX-License-Identifier: GPL-3.0-or-later
"""A-line skirt: the straight two-dart skirt block, flared from the hip."""
import math

import curves
from people import WOMAN
from piece import Garment, Piece, unfolded

FRONT, BACK = 22.0, -22.0


def waist_with_darts(half, curve, pieces, darts):
    """Walks the waist from the side seam to the middle: a piece, a dart, a piece, ... Darts are (intake, length); both
    legs are equally long, square on the waist."""
    lengths = [pieces[0]]
    for (intake, _), piece in zip(darts, pieces[1:]):
        lengths += [intake, piece]
    parts = curves.split_at_lengths(curve, lengths[:-1])
    for i, part in enumerate(parts):
        if i % 2 == 0:
            half.curve(part, "waist", label="lower_interface")
            continue
        number = len(darts) - i // 2  # counted from the middle
        opening, end = part[0], part[3]
        u = curves.direction(opening, end)
        tip = curves.add(curves.mix(opening, end, 0.5), (-u[1], u[0]), darts[i // 2][1])
        half.line(tip, f"dart {number} outer").line(end, f"dart {number} inner")


def skirt_side(hip, side_waist, flare, hem_level):
    """Curve over the hip and straight flare below; square to the hem, as long as the middle."""
    drop = hip[1] - hem_level
    down = curves.at_angle(-90.0 + math.degrees(math.atan2(flare, drop)))
    hem = curves.add(hip, down, drop)
    up = (-down[0], -down[1])
    rise = side_waist[1] - hip[1]
    curve = curves.from_tangents(hip, up, 0.45 * rise, side_waist, curves.at_angle(104.0), 0.30 * rise)
    return hem, curve, down


def skirt_half(name, behind, hip_width, side_intake, pieces, dart_lengths, waist_level, hip_level, hem_level, flare,
               side_rise=1.0):
    """Half a skirt piece from the middle's hem round to the middle's waist. `pieces` of the waist from the side to the
    middle are as long as asked; what the hip has more, but for `side_intake`, goes into equal darts between them."""
    side_waist = (hip_width - side_intake, waist_level + side_rise)
    waist = curves.from_tangents(side_waist, curves.at_angle(190.0), 0.33 * side_waist[0], (0.0, waist_level),
                                 (-1.0, 0.0), 0.40 * side_waist[0])
    intake = (curves.length(waist) - sum(pieces)) / len(dart_lengths)
    hip = (hip_width, hip_level)
    hem, side, down = skirt_side(hip, side_waist, flare, hem_level)
    half = Piece(name, "leg", BACK if behind else FRONT, behind)
    half.start((0.0, hem_level))
    along_hem = (-down[1], down[0])  # square to the side seam
    half.curve(curves.from_tangents((0.0, hem_level), (1.0, 0.0), 0.35 * hem[0], hem, along_hem, 0.35 * hem[0]), "hem",
               hem=30, seam_allowance_mm=30)
    half.line(hip, "side").curve(side, "side")
    waist_with_darts(half, waist, pieces, [(intake, dart_length) for dart_length in dart_lengths])
    return half


def sew_darts(garment, name, count):
    for hand in ("left", "right"):
        for k in range(1, count + 1):
            garment.sew(name, f"{hand} dart {k} outer", name, f"{hand} dart {k} inner")


def sew_sides(garment, front, back, edge="side"):
    for hand in ("left", "right"):
        garment.sew(front, f"{hand} {edge}", back, f"{hand} {edge}")


def a_line_skirt():
    p = WOMAN
    garment = Garment("A-line skirt", "cotton", 15)
    hip, waist = p["hip"] / 4 + 1.0, p["waist"] / 4 + 0.5
    # The seat is higher than the belly: two longer darts behind, one in front, and a wider front.
    for name, behind, more, shares, darts in (("front", False, 0.5, (0.5, 0.5), (9.5,)),
                                              ("back", True, -0.5, (0.30, 0.30, 0.40), (12.0, 13.5))):
        across = waist + more + (1.0 if not behind else -1.0)
        garment.add(unfolded(skirt_half(name, behind, hip + more, 3.0, [share * across for share in shares], darts,
                                        p["waist_level"], p["hip_level"], p["waist_level"] - 60.0, 6.0)))
    sew_sides(garment, "front", "back")
    sew_darts(garment, "front", 1)
    sew_darts(garment, "back", 2)
    return garment
