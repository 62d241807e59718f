# SPDX-License-Identifier: GPL-3.0-or-later
"""T-shirt with set-in sleeves, and a dress: close-fitting bodice block with waist and side bust darts, and a skirt."""
import math

import curves
from people import ARM_ANGLE, MAN, WOMAN
from piece import Garment, Piece, mirrored, unfolded
from skirts import sew_darts, sew_sides, skirt_half, waist_with_darts

FRONT, BACK = 24.0, -24.0


def shoulder_line(neck_side, half_width, slope):
    tip = (half_width, neck_side[1] - (half_width - neck_side[0]) * math.tan(math.radians(slope)))
    return tip, curves.direction(tip, neck_side)


def armhole(underarm, tip, towards_neck, scoop):
    """Level at the underarm, square to the shoulder; scoop: how far it follows the underarm's level."""
    square = (-towards_neck[1], towards_neck[0])
    if square[1] < 0:
        square = (-square[0], -square[1])
    drop = tip[1] - underarm[1]
    return curves.from_tangents(underarm, (-1.0, 0.0), scoop, tip, square, 0.52 * drop)


def neckline(neck_side, towards_neck, depth):
    """Square to the shoulder, level at the middle."""
    down = (towards_neck[1], -towards_neck[0])
    if down[1] > 0:
        down = (-down[0], -down[1])
    end = (0.0, neck_side[1] - depth)
    return curves.from_tangents(neck_side, down, 0.55 * depth, end, (-1.0, 0.0), 0.55 * neck_side[0])


def sleeve_cap(height, cap_length):
    """Half a sleeve's cap from the shoulder to the underarm: an S level at both ends, made this long by its width."""
    def cap(width):
        return curves.from_tangents((0.0, 0.0), (-1.0, 0.0), 0.42 * width, (-width, -height), (-1.0, 0.0), 0.36 * width)

    return cap(curves.solve(lambda w: curves.length(cap(w)) - cap_length, 0.1, 60.0))


def sleeve_half(name, behind, cap, top_length, hem_narrower, shoulder_tip):
    """Half a sleeve, its grain along the arm."""
    top, underarm = cap[0], cap[3]
    half = Piece(name, "arm", -14.0 if behind else 14.0, behind, turn=90.0 - ARM_ANGLE,
                 origin=curves.add(shoulder_tip, curves.at_angle(-ARM_ANGLE), 5.0))
    half.start(underarm)
    half.line((underarm[0] + hem_narrower, -top_length), "underarm")
    half.line((0.0, -top_length), "hem", hem=20, seam_allowance_mm=20)
    half.line(top, "top").curve(cap, "cap")
    return half


def set_in_sleeves(garment, front, back, ease, width, **sizes):
    """Front and back halves for both arms; each cap is `ease` longer than its armhole and as high as leaves the sleeve
    `width` wide under the arm."""
    lengths = [garment.pieces[body].seam_length("left armhole") * (1.0 + ease) for body in (front, back)]
    wide = lambda height: -sum(sleeve_cap(height, cap_length)[3][0] for cap_length in lengths)
    height = curves.solve(lambda h: width - wide(h), 1.0, 0.9 * min(lengths))
    for behind, body, cap_length in ((False, front, lengths[0]), (True, back, lengths[1])):
        name = "sleeve_back" if behind else "sleeve_front"
        half = sleeve_half("left_" + name, behind, sleeve_cap(height, cap_length), **sizes)
        garment.add(half, mirrored(half, "right_" + name))
        for hand in ("left", "right"):
            garment.sew(body, f"{hand} armhole", f"{hand}_{name}", "cap")
    for hand in ("left", "right"):
        for edge in ("top", "underarm"):
            garment.sew(f"{hand}_sleeve_front", edge, f"{hand}_sleeve_back", edge)


def t_shirt():
    p = MAN
    garment = Garment("T-shirt with set-in sleeves", "jersey", 10)
    quarter = (p["chest"] + 10.0) / 4
    neck_side = (p["neck"] / 6 + 2.0, p["neck_side_level"])
    tip, towards_neck = shoulder_line(neck_side, p["shoulder_half"], p["shoulder_slope"])
    underarm = (quarter, p["armpit_level"] - 6.0)
    hem = p["waist_level"] - 22.0
    for name, behind, neck_depth, scoop in (("front", False, p["neck"] / 6 + 3.0, 6.0), ("back", True, 2.5, 4.5)):
        half = Piece(name, "body", BACK if behind else FRONT, behind).start((0.0, hem))
        half.line((quarter - 0.5, hem), "hem", hem=25, seam_allowance_mm=25)
        half.line(underarm, "side").curve(armhole(underarm, tip, towards_neck, scoop), "armhole")
        half.line(neck_side, "shoulder")
        half.curve(neckline(neck_side, towards_neck, neck_depth), "neckline")
        garment.add(unfolded(half))
    for edge in ("side", "shoulder"):
        sew_sides(garment, "front", "back", edge)
    set_in_sleeves(garment, "front", "back", ease=0.02, width=p["upper_arm"] + 9.0, top_length=23.0, hem_narrower=1.5,
                   shoulder_tip=tip)
    return garment


BODICE_DART = 0.47  # of the quarter waist, from the middle


def bodice_half(p, behind):
    """Returns the half and the waist's pieces from the side seam to the middle."""
    ease_bust, ease_waist, side_slant, bust_dart = 6.0, 4.0, 1.6, 3.0
    more = -0.75 if behind else 0.75  # the front is the wider
    width, waist = (p["bust"] + ease_bust) / 4 + more, (p["waist"] + ease_waist) / 4 + more
    level = p["waist_level"]
    neck_side = (p["neck"] / 6 + 1.6, level + (p["back_length"] if behind else p["front_length"]) + 0.3)
    tip, towards_neck = shoulder_line(neck_side, p["shoulder_half"], p["shoulder_slope"])
    opening = 0.0 if behind else bust_dart
    underarm = (width, p["armpit_level"] - 1.5 + opening)
    half = Piece("bodice_back" if behind else "bodice_front", "body", BACK if behind else FRONT, behind)
    half.start((0.0, level))
    side_waist = (width - side_slant, level)
    pieces = [waist * (1.0 - BODICE_DART), waist * BODICE_DART]
    intake = side_waist[0] - waist
    dart_x = waist * BODICE_DART + intake / 2
    tip_level = level + (15.0 if behind else p["bust_level"] - level - 1.5)
    half.line((pieces[1], level), "waist").line((dart_x, tip_level), "dart 1 inner")
    half.line((pieces[1] + intake, level), "dart 1 outer").line(side_waist, "waist")
    share = 0.62  # of the side seam under the bust dart
    if behind:
        half.line(curves.mix(side_waist, underarm, share), "side").line(underarm, "side")
    else:
        # The dart's lower leg ends where the side seam, taken straight from waist to underarm when closed, passes.
        closed = (underarm[0], underarm[1] - opening)
        low = curves.mix(side_waist, closed, share)
        point = (p["bust_point"] + 2.5, p["bust_level"] + 0.5)
        reach = curves.distance(low, point)
        slant = math.degrees(math.atan2(low[1] - point[1], low[0] - point[0]))
        opened = 2.0 * math.degrees(math.asin(0.5 * opening / reach))
        high = curves.add(point, curves.at_angle(slant + opened), reach)
        rest = curves.distance(low, closed)
        turned = math.degrees(math.atan2(closed[1] - low[1], closed[0] - low[0])) + 0.5 * opened
        underarm = curves.add(high, curves.at_angle(turned), rest)
        half.line(low, "side").line(point, "bust dart lower").line(high, "bust dart upper").line(underarm, "side")
    half.curve(armhole(underarm, tip, towards_neck, 4.5 if behind else 5.0), "armhole")
    half.line(neck_side, "shoulder")
    half.curve(neckline(neck_side, towards_neck, 3.0 if behind else 9.0), "neckline")
    return half, pieces, intake


def dress():
    p = WOMAN
    garment = Garment("Dress with bodice and skirt", "cotton", 15)
    for behind in (False, True):
        half, pieces, intake = bodice_half(p, behind)
        bodice = half.name
        garment.add(unfolded(half))
        skirt = "skirt_back" if behind else "skirt_front"
        hip = p["hip"] / 4 + 2.0 + (-0.75 if behind else 0.75)
        part = skirt_half(skirt, behind, hip, 3.6, pieces, (12.0 if behind else 9.5,), p["waist_level"],
                          p["hip_level"], p["waist_level"] - 60.0, 9.0)
        for i, (curve, name, facts) in enumerate(part.edges):
            part.edges[i] = (curve, name, {k: v for k, v in facts.items() if k != "label"})
        garment.add(unfolded(part))
        for hand in ("left", "right"):
            garment.sew(bodice, f"{hand} waist", skirt, f"{hand} waist")
        sew_darts(garment, bodice, 1)
        sew_darts(garment, skirt, 1)
    sew_sides(garment, "bodice_front", "bodice_back")
    sew_sides(garment, "bodice_front", "bodice_back", "shoulder")
    sew_sides(garment, "skirt_front", "skirt_back")
    for hand in ("left", "right"):
        garment.sew("bodice_front", f"{hand} bust dart lower", "bodice_front", f"{hand} bust dart upper")
    return garment
