// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/draw_pattern.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/core/units.h"
#include "engine/geometry/curve.h"
#include "engine/geometry/inner_point.h"
#include "engine/geometry/offset_polygon.h"

namespace toile {
namespace {

constexpr double kTurnCosine = 0.985;   // 10 degrees: a sharper bend of the cut line is a corner
constexpr double kTextPerWidth = 0.78;  // width of a capital over its height, with its gap: for fitting labels

// A panel's outline in mm, counter-clockwise, and the edge each segment belongs to.
struct Outline {
  std::vector<Vec2> points;
  std::vector<int> edge_of_segment;
  std::vector<bool> turns;
};

Outline outline_of(const Panel& panel, double tolerance_mm) {
  Outline outline;
  for (int k = 0; k < panel.edge_count(); ++k) {
    const auto points = flatten_curve(edge_curve(panel, k), tolerance_mm * kMetrePerMm);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      outline.points.emplace_back(points[i] * kMmPerMetre);
      outline.edge_of_segment.push_back(k);
      outline.turns.push_back(i == 0);
    }
  }
  if (polygon_area(outline.points) < 0) {
    std::reverse(outline.points.begin(), outline.points.end());
    std::reverse(outline.turns.begin(), outline.turns.end());
    // Segment i now runs from point i to i + 1: the segments turn about one place further.
    std::reverse(outline.edge_of_segment.begin(), outline.edge_of_segment.end());
    std::rotate(outline.edge_of_segment.begin(), outline.edge_of_segment.begin() + 1, outline.edge_of_segment.end());
  }
  return outline;
}

// Edges of the panel that are legs of a dart narrow enough to be folded.
std::vector<bool> folded_edges(const Pattern& pattern, int panel_number, double widest_mm) {
  const Panel& panel = pattern.panels[static_cast<std::size_t>(panel_number)];
  const int count = panel.edge_count();
  std::vector<bool> folded(static_cast<std::size_t>(count), false);
  for (const Seam& seam : pattern.seams) {
    if (seam.a.panel.value != panel_number || seam.b.panel.value != panel_number || count < 4) continue;
    for (const auto& [first, second] : {std::pair(seam.a.edge, seam.b.edge), std::pair(seam.b.edge, seam.a.edge)}) {
      if ((first + 1) % count != second) continue;
      const double mouth = (panel.edge_start(first) - panel.edge_end(second)).norm() * kMmPerMetre;
      if (mouth < widest_mm) folded[static_cast<std::size_t>(first)] = folded[static_cast<std::size_t>(second)] = true;
    }
  }
  return folded;
}

DrawingLine cut_line(const Pattern& pattern, const Panel& panel, const Outline& outline,
                     const std::vector<bool>& folded) {
  std::vector<Vec2> points;
  std::vector<double> distances;
  const std::size_t count = outline.points.size();
  const auto is_folded = [&](std::size_t i) {
    return folded[static_cast<std::size_t>(outline.edge_of_segment[i % count])];
  };
  for (std::size_t i = 0; i < count; ++i) {
    // Across a folded dart one segment runs from the start of its first leg to the end of its second.
    if (is_folded(i) && is_folded(i + count - 1)) continue;
    const std::size_t like = is_folded(i) ? (i + count - 1) % count : i;
    const auto edge = static_cast<std::size_t>(outline.edge_of_segment[like]);
    points.push_back(outline.points[i]);
    distances.push_back(seam_allowance_of(pattern, panel.edges[edge]) * kMmPerMetre);
  }
  DrawingLine line{LineKind::Cut, offset_polygon(points, distances), true, {}};
  const std::size_t n = line.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 in = (line.points[i] - line.points[(i + n - 1) % n]).normalized();
    const Vec2 out = (line.points[(i + 1) % n] - line.points[i]).normalized();
    line.turns.push_back(in.dot(out) < kTurnCosine);
  }
  return line;
}

// The outline's points of one edge, in counter-clockwise order.
std::vector<Vec2> edge_points(const Outline& outline, int edge) {
  std::vector<Vec2> points;
  const std::size_t count = outline.points.size();
  std::size_t first = 0;
  while (first < count &&
         !(outline.edge_of_segment[first] == edge && outline.edge_of_segment[(first + count - 1) % count] != edge))
    ++first;
  for (std::size_t i = first; i < first + count && outline.edge_of_segment[i % count] == edge; ++i)
    points.push_back(outline.points[i % count]);
  if (!points.empty()) points.push_back(outline.points[(first + points.size()) % count]);
  return points;
}

// Point at a fraction of the edge's arc length and the unit normal out of the panel there.
struct EdgePlace {
  Vec2 at, outward;
};
EdgePlace place_on_edge(const Panel& panel, int edge, double fraction, bool clockwise) {
  const Curve curve = edge_curve(panel, edge);
  const double step = 1e-4, low = std::max(0.0, fraction - step), high = std::min(1.0, fraction + step);
  const auto points = curve_points_at(curve, {low, std::clamp(fraction, 0.0, 1.0), high});
  const Vec2 along = (points[2] - points[0]).normalized();
  const Vec2 right(along.y(), -along.x());
  return {points[1] * kMmPerMetre, clockwise ? Vec2(-right) : right};
}

void add_notches(const Pattern& pattern, const Panel& panel, bool clockwise, bool on_cut, DrawingPiece& piece) {
  for (const Notch& notch : panel.notches) {
    const auto [at, outward] = place_on_edge(panel, notch.edge, notch.at, clockwise);
    const double allowance =
        on_cut ? seam_allowance_of(pattern, panel.edges[static_cast<std::size_t>(notch.edge)]) * kMmPerMetre : 0.0;
    // A snip must end short of the stitches.
    const double depth = allowance > 0 ? std::min(5.0, 0.5 * allowance) : 4.0;
    piece.notches.push_back({notch.type, at + allowance * outward, -outward, depth, 4.0, at});
  }
}

void add_seam_numbers(const Pattern& pattern, int panel_number, bool clockwise, DrawingPiece& piece) {
  const Panel& panel = pattern.panels[static_cast<std::size_t>(panel_number)];
  for (std::size_t s = 0; s < pattern.seams.size(); ++s) {
    for (const SeamSide& side : {pattern.seams[s].a, pattern.seams[s].b}) {
      if (side.panel.value != panel_number) continue;
      const double length = edge_length(panel, side.edge) * kMmPerMetre;
      const double height = std::clamp(0.12 * length, 2.0, 5.0);
      const auto [at, outward] = place_on_edge(panel, side.edge, 0.5, clockwise);
      // Middle of the text `height` + 6 mm inside; the baseline is half a height lower.
      piece.texts.push_back({at - (height + 6.0) * outward - Vec2(0, 0.5 * height), height, std::to_string(s + 1)});
    }
  }
}

double label_width(const DrawingPiece& piece, double height) {
  return kTextPerWidth * height * static_cast<double>(std::max<std::size_t>(4, piece.label.size()));
}

// The given grainline, or a vertical one that keeps clear of the label.
std::array<Vec2, 2> grainline_of(const Panel& panel, const Outline& outline, const InnerPoint& roomiest,
                                 double text_width) {
  if (panel.grainline) return {(*panel.grainline)[0] * kMmPerMetre, (*panel.grainline)[1] * kMmPerMetre};
  for (const double aside : {0.5 * text_width + 8.0, -0.5 * text_width - 8.0, 0.7 * roomiest.clearance}) {
    const Vec2 beside = roomiest.at - Vec2(aside, 0);
    if (!inside_polygon(outline.points, beside)) continue;
    const auto [down, up] = chord_through(outline.points, beside, Vec2::UnitY());
    if (up - down < std::min(40.0, 1.5 * roomiest.clearance)) continue;
    const double half = std::min(0.35 * (up - down), 150.0), middle = 0.5 * (up + down);
    return {beside + Vec2(0, middle - half), beside + Vec2(0, middle + half)};
  }
  return {roomiest.at - Vec2(0, 0.7 * roomiest.clearance), roomiest.at + Vec2(0, 0.7 * roomiest.clearance)};
}

void add_label_and_grainline(const Panel& panel, const Outline& outline, DrawingPiece& piece) {
  const InnerPoint roomiest = roomiest_point(outline.points);
  if (roomiest.clearance <= 0) return;
  const auto [left, right] = chord_through(outline.points, roomiest.at, Vec2::UnitX());
  const double fitting = 1.6 * std::min(-left, right) / label_width(piece, 1.0);
  const double height = std::clamp(std::min(fitting, 0.35 * roomiest.clearance), 2.0, 12.0);
  piece.texts.push_back({roomiest.at + Vec2(0, 0.4 * height), height, piece.label});
  std::string note = "cut " + std::to_string(panel.quantity);
  if (!panel.material.empty()) note += ", " + panel.material;
  piece.texts.push_back({roomiest.at - Vec2(0, 1.2 * height), 0.6 * height, note});
  const auto [from, to] = grainline_of(panel, outline, roomiest, label_width(piece, height));
  piece.lines.push_back({LineKind::Grainline, {from, to}, false, {}});
}

DrawingPiece draw_panel(const Pattern& pattern, int panel_number, const DrawPatternOptions& options) {
  const Panel& panel = pattern.panels[static_cast<std::size_t>(panel_number)];
  DrawingPiece piece;
  piece.name = panel.name;
  piece.label = panel.piece_label.empty() ? panel.name : panel.piece_label;
  piece.quantity = panel.quantity;
  piece.material = panel.material;
  const bool clockwise = outline_signed_area(panel) < 0;
  const Outline outline = outline_of(panel, options.tolerance_mm);
  if (options.seam_allowance)
    piece.lines.push_back(
        cut_line(pattern, panel, outline, folded_edges(pattern, panel_number, options.folded_dart_mm)));
  piece.lines.push_back({LineKind::Stitch, outline.points, true, outline.turns});
  for (int k = 0; k < panel.edge_count(); ++k) {
    const PanelEdge& edge = panel.edges[static_cast<std::size_t>(k)];
    if (edge.on_fold || edge.hem) piece.lines.push_back({LineKind::Fold, edge_points(outline, k), false, {}});
  }
  for (const KeepOut& region : panel.keep_outs) {
    DrawingLine line{LineKind::Internal, {}, true, {}};
    for (const Vec2& p : region.polygon) line.points.emplace_back(p * kMmPerMetre);
    piece.lines.push_back(line);
  }
  add_notches(pattern, panel, clockwise, options.seam_allowance, piece);
  add_label_and_grainline(panel, outline, piece);
  if (options.seam_numbers) add_seam_numbers(pattern, panel_number, clockwise, piece);
  return piece;
}

// The point of `changed` farthest from `original`, signed: > 0 outside.
std::pair<Vec2, double> largest_change(const std::vector<Vec2>& original, const std::vector<Vec2>& changed) {
  std::pair<Vec2, double> largest{Vec2::Zero(), 0.0};
  for (const Vec2& p : changed) {
    const double distance = distance_to_polygon(original, p);
    if (distance > std::abs(largest.second)) largest = {p, inside_polygon(original, p) ? -distance : distance};
  }
  return largest;
}

}  // namespace

double seam_allowance_of(const Pattern& pattern, const PanelEdge& edge) {
  if (edge.on_fold) return 0.0;
  if (edge.hem) return *edge.hem;
  return edge.seam_allowance.value_or(pattern.seam_allowance);
}

Drawing draw_pattern(const Pattern& pattern, const DrawPatternOptions& options) {
  Drawing drawing{pattern.name, {}};
  for (std::size_t p = 0; p < pattern.panels.size(); ++p)
    drawing.pieces.push_back(draw_panel(pattern, static_cast<int>(p), options));
  return drawing;
}

Drawing draw_changes(const Pattern& original, const Pattern& changed) {
  DrawPatternOptions options;
  options.seam_allowance = options.seam_numbers = false;
  Drawing drawing = draw_pattern(changed, options);
  for (std::size_t p = 0; p < changed.panels.size(); ++p) {
    const Panel& panel = changed.panels[p];
    const auto before = std::find_if(original.panels.begin(), original.panels.end(),
                                     [&](const Panel& other) { return other.name == panel.name; });
    if (before == original.panels.end()) continue;
    const Outline outline = outline_of(*before, options.tolerance_mm);
    DrawingPiece& piece = drawing.pieces[p];
    const auto [at, distance] = largest_change(outline.points, outline_of(panel, options.tolerance_mm).points);
    piece.lines.insert(piece.lines.begin(), {LineKind::Original, outline.points, true, outline.turns});
    char text[32];
    std::snprintf(text, sizeof text, "%+.1f mm", distance);
    if (std::abs(distance) >= 0.05) piece.texts.push_back({at, 5.0, text});
  }
  return drawing;
}

}  // namespace toile
