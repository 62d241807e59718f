# SPDX-License-Identifier: GPL-3.0-or-later
"""Leggings and trousers: the two-piece trouser block, front first, the back so that its seams are as long."""
import curves
from people import CHILD, MAN
from piece import Garment, Piece, mirrored

FRONT, BACK = 20.0, -20.0


def smooth(points, first, last):
    """Curves through the points; at inner ones along the line between the neighbours, at the ends along first and last."""
    tangents = [first] + [curves.direction(a, b) for a, b in zip(points, points[2:])] + [last]
    result = []
    for (p, q), (s, t) in zip(zip(points, points[1:]), zip(tangents, tangents[1:])):
        reach = 0.34 * curves.distance(p, q)
        result.append(curves.from_tangents(p, s, reach, q, t, reach))
    return result


class LegBlock:
    """Widths of the front; the back is `wider` on either side, hip and crotch as given.

    leg: (level, width) from the hem up to the knee; the same for both seams. x = 0 is the crotch's point."""

    def __init__(self, levels, leg, hip, reach, side_intake, wider):
        self.waist, self.hip, self.crotch = levels
        self.leg, self.hip_width, self.reach = leg, hip, reach
        self.side_intake, self.wider = side_intake, wider

    def outseam(self, crease, hip_side, more):
        """From the hem up: through the leg's widths, over the hip, to the waist."""
        points = [(crease + width / 2 + more, level) for level, width in self.leg]
        points += [(hip_side, self.hip), (hip_side - self.side_intake, self.waist + 0.6)]
        return smooth(points, curves.direction(points[0], points[1]), curves.at_angle(103.0))

    def inseam(self, crease, crotch_point, more):
        """From the crotch down; below the knee the outseam's mirror image."""
        points = [(crease - width / 2 - more, level) for level, width in self.leg][::-1]
        knee = points[0]
        # The thigh's part hollows: it leaves the crotch's point more level than the straight way.
        below = curves.direction(knee, points[1])
        thigh = curves.from_tangents(crotch_point, curves.direction(crotch_point, (crotch_point[0] + 2.6, crotch_point[1] - 8)),
                                     0.3 * (crotch_point[1] - knee[1]), knee, below, 0.35 * (crotch_point[1] - knee[1]))
        return [thigh] + smooth(points, below, curves.direction(points[-2], points[-1]))

    def front_crease(self):
        return (self.reach[0] + self.hip_width[0]) / 2

    def front(self, name, middle_intake, middle_rise):
        piece = Piece(name, "leg", FRONT, origin=(0.5, 0.0))
        crease, side = self.front_crease(), self.reach[0] + self.hip_width[0]
        out, inner = self.outseam(crease, side, 0.0), self.inseam(crease, (0.0, self.crotch), 0.0)
        top = (self.reach[0] + middle_intake, self.waist + middle_rise)
        self.outline(piece, out, inner, top, (self.reach[0], self.crotch + 0.55 * (self.hip - self.crotch)), 0.62)
        return piece

    def back(self, name, tilt, rise, dart):
        crease = self.reach[1] + self.hip_width[1] - (self.reach[0] + self.hip_width[0] - self.front_crease()) - self.wider
        side = self.reach[1] + self.hip_width[1]
        wanted = sum(curves.length(c) for c in self.inseam(self.front_crease(), (0.0, self.crotch), 0.0))
        length = lambda drop: sum(
            curves.length(c) for c in self.inseam(crease, (0.0, self.crotch - drop), self.wider))
        drop = curves.solve(lambda d: wanted - length(d), -4.0, 6.0)
        piece = Piece(name, "leg", BACK, True, origin=(0.5, 0.0))
        out, inner = self.outseam(crease, side, self.wider), self.inseam(crease, (0.0, self.crotch - drop), self.wider)
        top = (self.reach[1] + tilt, self.waist + rise)
        self.outline(piece, out, inner, top, (self.reach[1], self.hip), 0.80, dart)
        return piece

    def outline(self, piece, out, inner, top, bend, level_reach, dart=None):
        piece.start(inner[-1][3]).line(out[0][0], "hem", hem=20, seam_allowance_mm=20)
        for curve in out:
            piece.curve(curve, "outseam")
        self.top_edge(piece, top, dart)
        seat = curves.direction(top, bend)
        piece.line(bend, "crotch")
        point = inner[0][0]
        drop = bend[1] - point[1]
        piece.curve(curves.from_tangents(bend, seat, 0.62 * drop, point, (-1.0, 0.0), level_reach * bend[0]), "crotch")
        for curve in inner:
            piece.curve(curve, "inseam")

    @staticmethod
    def top_edge(piece, top, dart):
        """From the side to the middle, straight, with a dart (intake, length) in its middle."""
        if not dart:
            return piece.line(top, "waist", label="lower_interface")
        at, u = piece.at, curves.direction(piece.at, top)
        half = 0.5 * (curves.distance(at, top) - dart[0])
        opening = curves.add(at, u, half)
        end = curves.add(opening, u, dart[0])
        tip = curves.add(curves.mix(opening, end, 0.5), (-u[1], u[0]), dart[1])
        piece.line(opening, "waist", label="lower_interface")
        piece.line(tip, "dart outer").line(end, "dart inner")
        return piece.line(top, "waist", label="lower_interface")


def assemble(garment, front, back):
    garment.add(front, mirrored(front, "right_front"), back, mirrored(back, "right_back"))
    for hand in ("left", "right"):
        for edge in ("outseam", "inseam"):
            garment.sew(f"{hand}_front", edge, f"{hand}_back", edge)
    garment.sew("left_front", "crotch", "right_front", "crotch")
    garment.sew("left_back", "crotch", "right_back", "crotch")
    return garment


def leggings():
    p = CHILD
    garment = Garment("Leggings", "jersey", 7)
    wider = 0.25
    block = LegBlock(levels=(p["waist_level"], p["hip_level"], p["crotch_level"]),
                     leg=[(p[level + "_level"], p[level] / 2 + 0.5 - 2.0 * wider)
                          for level in ("ankle", "calf", "knee", "mid_thigh")],
                     hip=(p["hip"] / 4 - 0.25, p["hip"] / 4 + 0.75), reach=(p["hip"] / 24, p["hip"] / 12),
                     side_intake=1.0, wider=wider)
    return assemble(garment, block.front("left_front", 0.5, 0.9), block.back("left_back", tilt=1.5, rise=1.5, dart=None))


def trousers():
    p = MAN
    garment = Garment("Trousers with zip and patch pockets", "cotton", 15)
    block = LegBlock(levels=(p["waist_level"], p["hip_level"], p["crotch_level"] - 3.0),
                     leg=[(6.0, 20.5), (28.0, 21.5), (p["knee_level"] + 4.0, 23.0)],
                     hip=(p["hip"] / 4 + 1.0, p["hip"] / 4 + 2.0), reach=(p["hip"] / 16 - 1.0, p["hip"] / 8 - 2.0),
                     side_intake=2.2, wider=1.0)
    front, back = block.front("left_front", 1.0, 0.9), block.back("left_back", tilt=3.0, rise=2.5, dart=(1.8, 10.0))
    add_zip(front)
    add_pocket(back, p["waist_level"] - 8.0)
    assemble(garment, front, back)
    for hand in ("left", "right"):
        garment.sew(f"{hand}_back", "dart outer", f"{hand}_back", "dart inner")
    return garment


def add_zip(front):
    """The straight upper part of the front's middle seam carries the zip: its shape stays."""
    index = next(i for i, edge in enumerate(front.edges) if edge[1] == "crotch")
    curve, name, _ = front.edges[index]
    front.edges[index] = (curve, name, {"zip": True, "locked": True})


def add_pocket(back, top):
    """A patch pocket of 13 by 14 cm with a pointed bottom under the dart: no cut may cross it."""
    dart_tip = next(c for c, n, _ in back.edges if n == "dart outer")[3]
    middle = (dart_tip[0], top)
    corners = [(-6.5, 0.0), (-6.5, -12.5), (0.0, -14.0), (6.5, -12.5), (6.5, 0.0)]
    back.keep_out.append(([curves.add(middle, corner) for corner in corners], "patch pocket"))
