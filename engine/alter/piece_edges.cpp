// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/piece_edges.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/fit_curve.h"
#include "engine/geometry/part_of_curve.h"
#include "engine/geometry/polygon_boolean.h"
#include "engine/geometry/self_crossing.h"

namespace toile {
namespace {

// Chains that near to an original edge are a part of it, corners that near to one of its corners are that corner.
struct Nearness {
  double edge, corner, length;  // m
};
constexpr Nearness kAsCut = {6e-4, 1e-3, 1.0}, kAsDrawn = {6e-4, 2e-4, 2e-4}, kTrued = {2e-4, 2e-4, 1e-4};
constexpr double kStraight = 2e-4;    // m
constexpr double kSmooth = 8e-4;      // m: of a Bézier through the chain's points
constexpr double kSameLength = 1e-4;  // m: of an edge and its chain
constexpr double kPolyline = 5e-5;    // m: of the polyline where no Bézier follows
constexpr double kFlat = 2e-5;        // m: of the chords an outline is tested by
constexpr double kLeastChord = 2e-5;  // m between the ends of an edge: less is no edge
constexpr double kTouching = 2e-7;    // m: an outline this near to itself could not be read back
constexpr double kLeastArea = 2e-5;   // m^2: half as much could not be read back
constexpr double kOtherLength =
    2e-3;  // m an edge may differ from its chain, and a tenth: corners are snapped to places

struct OriginalPart {
  int edge = -1;
  double from = 0.0, to = 0.0;  // parameters; to < from against the edge's own way
};

double length_of(const std::vector<Vec2>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

double distance_to_chord(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 way = b - a;
  const double t = way.squaredNorm() > 0 ? std::clamp((p - a).dot(way) / way.squaredNorm(), 0.0, 1.0) : 0.0;
  return (a + t * way - p).norm();
}

OriginalPart part_of_edge(const Panel& original, int edge, const std::vector<Vec2>& points, const Nearness& near) {
  const Curve curve = edge_curve(original, edge);
  if ((curve.end - curve.start).norm() < 1e-9) return {};
  for (const Vec2& p : points)
    if (distance_to_chord(p, curve.start, curve.end) > curve_length(curve)) return {};
  const CurvePlace first = nearest_on_curve(curve, points.front()), last = nearest_on_curve(curve, points.back());
  if (first.distance > near.edge || last.distance > near.edge || std::abs(first.t - last.t) < 1e-6) return {};
  for (const Vec2& p : points)
    if (nearest_on_curve(curve, p).distance > near.edge) return {};
  const double length = curve_length(part_of_curve(curve, std::min(first.t, last.t), std::max(first.t, last.t)));
  if (std::abs(length - length_of(points)) > near.length) return {};
  return {edge, first.t, last.t};
}

OriginalPart original_part(const Panel& original, int likely, const std::vector<Vec2>& points, const Nearness& near) {
  if (likely >= 0)
    if (const OriginalPart part = part_of_edge(original, likely, points, near); part.edge >= 0) return part;
  for (int e = 0; e < original.edge_count(); ++e)
    if (e != likely)
      if (const OriginalPart part = part_of_edge(original, e, points, near); part.edge >= 0) return part;
  return {};
}

// Fewest of the inner points such that none is farther than the tolerance from the line.
std::vector<Vec2> thinned(const std::vector<Vec2>& points, double tolerance) {
  std::vector<bool> keep(points.size(), false);
  keep.front() = keep.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    std::size_t worst = a;
    double most = tolerance;
    for (std::size_t i = a + 1; i < b; ++i) {
      const double off = distance_to_chord(points[i], points[a], points[b]);
      if (off > most) most = off, worst = i;
    }
    if (worst == a) continue;
    keep[worst] = true;
    open.emplace_back(a, worst);
    open.emplace_back(worst, b);
  }
  std::vector<Vec2> inner;
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    if (keep[i]) inner.push_back(points[i]);
  return inner;
}

EdgeCurve polyline_through(const std::vector<Vec2>& points) {
  EdgeCurve curve;
  curve.points = thinned(points, kPolyline);
  if (!curve.points.empty()) curve.kind = CurveKind::Polyline;
  return curve;
}

// The simplest curve through the points.
EdgeCurve curve_through(const std::vector<Vec2>& points) {
  EdgeCurve curve;
  if (std::all_of(points.begin(), points.end(),
                  [&](const Vec2& p) { return distance_to_chord(p, points.front(), points.back()) < kStraight; }))
    return curve;
  const double length = length_of(points);
  Curve guess{points.front(), points.back(), {}};
  guess.shape.kind = CurveKind::CubicBezier;
  guess.shape.control = {points.front() + length / 3 * (points[1] - points[0]).normalized(),
                         points.back() - length / 3 * (points.back() - points[points.size() - 2]).normalized()};
  if (points.size() > 3) {
    std::vector<double> parameters;
    double walked = 0.0;
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
      parameters.push_back((walked += (points[i] - points[i - 1]).norm()) / length);
    const CurveFit fit = fit_curve(guess, {points.begin() + 1, points.end() - 1}, parameters);
    if (fit.deviation < kSmooth && std::abs(curve_length(fit.curve) - length) < kSameLength) return fit.curve.shape;
  }
  return polyline_through(points);
}

Curve drawn_edge(const PieceEdges& edges, std::size_t k) {
  return {edges.corners[k], edges.corners[(k + 1) % edges.corners.size()], edges.curves[k]};
}

// Whether the edges make an outline that encloses cloth and keeps clear of itself, each about as long as its chain.
bool can_be_cut(const PieceEdges& edges) {
  std::vector<Vec2> outline;
  for (std::size_t k = 0; k < edges.corners.size(); ++k) {
    const Curve curve = drawn_edge(edges, k);
    if (!((curve.end - curve.start).norm() > kLeastChord)) return false;
    if (!(std::abs(curve_length(curve) - edges.lengths[k]) < kOtherLength + 0.1 * edges.lengths[k])) return false;
    const std::vector<Vec2> points = flatten_curve(curve, kFlat);
    outline.insert(outline.end(), points.begin(), points.end() - 1);
  }
  return signed_area(outline) >= kLeastArea && !find_self_crossing(outline, kTouching);
}

class EdgeDrawer {
 public:
  EdgeDrawer(const PieceBorder& piece, const std::vector<const BorderChain*>& chains, const Panel* original)
      : original_(original), trued_(piece.trued), near_(piece.trued ? kTrued : kAsDrawn) {
    for (const BorderChain* chain : chains) {
      border_.emplace_back();
      for (const int v : chain->vertices) border_.back().push_back(piece.vertices[static_cast<std::size_t>(v)].rest);
      const int likely = chain->along.neighbour < 0 ? chain->along.track.edge : -1;
      parts_.push_back(original ? original_part(*original, likely, border_.back(), near_) : OriginalPart{});
      of_edge_.push_back(original ? original_part(*original, likely, border_.back(), kAsCut).edge : -1);
    }
    as_border_.assign(border_.size(), false);
  }

  // Original curves, and smooth ones through the rest, can cross where the chains they stand for run close by each
  // other; then the piece is drawn as its border runs. So are single edges of a trued piece that lost their length.
  PieceEdges run() {
    PieceEdges smooth = draw();
    if (trued_ && follow_border_where_off(smooth)) smooth = draw();
    if (can_be_cut(smooth)) return smooth;
    as_border_.assign(border_.size(), true);
    PieceEdges plain = draw();
    plain.sound = can_be_cut(plain);
    return plain;
  }

 private:
  PieceEdges draw() const {
    PieceEdges edges;
    edges.of_edge = of_edge_;
    const std::size_t count = border_.size();
    for (std::size_t k = 0; k < count; ++k) edges.corners.push_back(corner((k + count - 1) % count, k));
    for (std::size_t k = 0; k < count; ++k) {
      edges.lengths.push_back(length_of(border_[k]));
      std::vector<Vec2> points = border_[k];
      points.front() = edges.corners[k];
      points.back() = edges.corners[(k + 1) % count];
      if (as_border_[k])
        edges.curves.push_back(polyline_through(points));
      else
        edges.curves.push_back(parts_[k].edge >= 0 ? original_curve(parts_[k], points) : curve_through(points));
    }
    return edges;
  }

  // Whether an edge was drawn shorter or longer than its chain: corners are snapped to places.
  bool follow_border_where_off(const PieceEdges& edges) {
    for (std::size_t k = 0; k < border_.size(); ++k)
      as_border_[k] = std::abs(curve_length(drawn_edge(edges, k)) - edges.lengths[k]) > kSameLength;
    return std::find(as_border_.begin(), as_border_.end(), true) != as_border_.end();
  }

  // Where chain `before` ends and `after` begins: an original corner, or a place on an original edge.
  Vec2 corner(std::size_t before, std::size_t after) const {
    const Vec2 here = border_[after].front();
    if (!original_ || as_border_[before] || as_border_[after]) return here;
    const OriginalPart &ending = parts_[before], &beginning = parts_[after];
    if (ending.edge >= 0 || beginning.edge >= 0)
      for (const Vec2& known : original_->corners)
        if ((known - here).norm() < near_.corner) return known;
    if (beginning.edge >= 0) return curve_point(edge_curve(*original_, beginning.edge), beginning.from);
    if (ending.edge >= 0) return curve_point(edge_curve(*original_, ending.edge), ending.to);
    return here;
  }

  EdgeCurve original_curve(const OriginalPart& part, const std::vector<Vec2>& points) const {
    const Curve whole = edge_curve(*original_, part.edge);
    const auto at = [&](double t, const Vec2& place) {  // a corner stands for the whole edge
      if ((place - whole.start).norm() < 1e-9) return 0.0;
      return (place - whole.end).norm() < 1e-9 ? 1.0 : t;
    };
    const double from = at(part.from, points.front()), to = at(part.to, points.back());
    return from < to ? part_of_curve(whole, from, to).shape : reversed(part_of_curve(whole, to, from)).shape;
  }

  const Panel* original_;
  const bool trued_;
  const Nearness& near_;
  std::vector<std::vector<Vec2>> border_;  // points of every chain
  std::vector<OriginalPart> parts_;
  std::vector<int> of_edge_;
  std::vector<bool> as_border_;  // is drawn as its chain runs
};

}  // namespace

PieceEdges draw_piece_edges(const PieceBorder& piece, const std::vector<const BorderChain*>& chains,
                            const Panel* original) {
  return EdgeDrawer(piece, chains, original).run();
}

}  // namespace toile
