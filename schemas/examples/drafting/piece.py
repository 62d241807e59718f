# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces of a garment and their document. A piece is drawn counter-clockwise as seen from in front of the wearer, x to the
wearer's left, y up, in centimetres."""
import curves


class Piece:
    """An outline of named edges. Several edges may bear one name; seams join names, in the order of drawing."""

    def __init__(self, name, label, depth, behind=False, turn=0.0, origin=(0.0, 0.0), **facts):
        self.name, self.label, self.behind, self.turn, self.facts = name, label, behind, turn, facts
        self.depth, self.origin = depth, origin  # where it lies before sewing: z, and what is added to x and y
        self.edges = []  # (curve, name, facts of the edge)
        self.keep_out, self.notches = [], []

    def start(self, p):
        self.at = self.first = p
        return self

    def curve(self, curve, name="", **facts):
        assert curves.distance(curve[0], self.at) < 1e-6, (self.name, name, curve[0], self.at)
        self.edges.append(((self.at,) + curve[1:], name, facts))
        self.at = curve[3]
        return self

    def line(self, p, name="", **facts):
        return self.curve(curves.straight(self.at, p), name, **facts)

    def close(self, name="", **facts):
        if curves.distance(self.at, self.first) > 1e-6:
            self.line(self.first, name, **facts)
        return self

    def seam_length(self, name):
        return sum(curves.length(c) for c, n, _ in self.edges if n == name)

    def numbers(self, name):
        """Edges of this name in the written order."""
        found = [i for i, edge in enumerate(self.edges) if edge[1] == name]
        assert found, (self.name, name)
        return [len(self.edges) - 1 - i for i in reversed(found)] if self.behind else found

    def notch(self, name, at):
        self.notches.append((name, at))
        return self


def mirrored(piece, name):
    """The same for the other side of the body."""
    other = Piece(name, piece.label, piece.depth, piece.behind, -piece.turn, (-piece.origin[0], piece.origin[1]),
                  **piece.facts)
    flip = lambda p: (-p[0], p[1])
    other.edges = [(tuple(flip(p) for p in reversed(c)), n, f) for c, n, f in reversed(piece.edges)]
    other.keep_out = [([flip(p) for p in polygon], why) for polygon, why in piece.keep_out]
    other.notches = [(n, 1.0 - at) for n, at in piece.notches]
    return other


def unfolded(half):
    """The whole of a half drawn from the middle's lower end over the wearer's left to the middle's upper end. Edges get
    `left` and `right` before their names."""
    whole = Piece(half.name, half.label, half.depth, half.behind, half.turn, half.origin, **half.facts)
    other = mirrored(half, half.name)
    whole.edges = [(c, "left " + n, f) for c, n, f in half.edges] + [(c, "right " + n, f) for c, n, f in other.edges]
    whole.notches = [("left " + n, at) for n, at in half.notches] + [("right " + n, at) for n, at in other.notches]
    assert abs(half.edges[0][0][0][0]) < 1e-9 and abs(half.edges[-1][0][3][0]) < 1e-9, half.name
    return whole


class Garment:
    def __init__(self, name, fabric, seam_allowance_mm):
        self.name, self.fabric, self.allowance = name, fabric, seam_allowance_mm
        self.pieces, self.stitches = {}, []

    def add(self, *pieces):
        for piece in pieces:
            self.pieces[piece.name] = piece

    def sew(self, a, a_edge, b, b_edge):
        """Joins the edges of one name to those of another, the first of one to the last of the other."""
        first, second = self.pieces[a].numbers(a_edge), self.pieces[b].numbers(b_edge)
        assert len(first) == len(second), (a, a_edge, b, b_edge)
        for i, j in zip(first, reversed(second)):
            self.stitches.append([{"panel": a, "edge": i}, {"panel": b, "edge": j}])

    def document(self):
        panels = {piece.name: panel(piece) for piece in self.pieces.values()}
        toile = {"name": self.name, "fabric": self.fabric, "seam_allowance_mm": self.allowance,
                 "edges": [], "panels": [], "notches": [], "keep_out": []}
        for piece in self.pieces.values():
            describe(piece, toile)
        return {"pattern": {"panels": panels, "stitches": self.stitches, "panel_order": list(panels)},
                "properties": {"curvature_coords": "relative", "units_in_meter": 100},
                "toile": {key: value for key, value in toile.items() if value != []}}


def number(value):
    value = round(value, 4)
    return int(value) if value == int(value) else value


def written_edges(piece):
    """In the order of the document: clockwise behind the wearer, so that the outside faces away."""
    if not piece.behind:
        return piece.edges
    return [(tuple(reversed(c)), n, f) for c, n, f in reversed(piece.edges)]


def relative(curve):
    """Control points as (u, v): u along the edge, v to its left, both in edge lengths."""
    p, a, b, q = curve
    d = (q[0] - p[0], q[1] - p[1])
    squared = d[0] ** 2 + d[1] ** 2
    return [[round(((c[0] - p[0]) * d[0] + (c[1] - p[1]) * d[1]) / squared, 6),
             round(((c[1] - p[1]) * d[0] - (c[0] - p[0]) * d[1]) / squared, 6)] for c in (a, b)]


def panel(piece):
    edges = written_edges(piece)
    result = {"translation": [number(piece.origin[0]), number(piece.origin[1]), piece.depth],
              "rotation": [0, 0, number(piece.turn)], "vertices": [], "edges": [], "label": piece.label}
    for i, (curve, _, facts) in enumerate(edges):
        result["vertices"].append([number(x) for x in curve[0]])
        edge = {"endpoints": [i, (i + 1) % len(edges)]}
        if not curves.is_straight(curve):
            edge["curvature"] = {"type": "cubic", "params": relative(curve)}
        if facts.get("label"):
            edge["label"] = facts["label"]
        result["edges"].append(edge)
    return result


def describe(piece, toile):
    for i, (_, name, facts) in enumerate(written_edges(piece)):
        entry = {"panel": piece.name, "edge": i, "name": name}
        entry.update({key: value for key, value in facts.items() if key != "label"})
        toile["edges"].append(entry)
    if piece.facts:
        toile["panels"].append({"panel": piece.name, **piece.facts})
    for name, at in piece.notches:
        edges = piece.numbers(name)
        toile["notches"].append({"panel": piece.name, "edge": edges[0], "at": number(1 - at if piece.behind else at)})
    for polygon, why in piece.keep_out:
        toile["keep_out"].append({"panel": piece.name, "polygon": [[number(x), number(y)] for x, y in polygon],
                                  "why": why})
