// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/fit_pattern_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/geometry/fit_curve.h"
#include "engine/stages/match_seam_lengths.h"
#include "engine/stages/mirror_drawing.h"
#include "engine/stages/panel_motion.h"

namespace toile {

namespace {

// An edge leaves a corner nearly as the cloth about the corner carries it: what the last vertices do otherwise, in the
// crotch of a noisy scan, say, is no shape to cut. And edges that run on smoothly round a corner still do.
constexpr double kAbout = 0.06;         // m, of the cloth about a corner
constexpr double kFarthestTurn = 0.26;  // rad, 15 degrees: how much else the end of an edge may turn
constexpr double kSmoothCorner = 0.09;  // rad, 5 degrees: a corner that turns less is a smooth joint
constexpr double kKink = 0.035;         // rad, 2 degrees: what a smooth joint may turn afterwards

double angle_between(const Vec2& from, const Vec2& to) {
  return std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
}

Vec2 turned(const Vec2& v, double angle) {
  return Eigen::Rotation2Dd(angle) * v;
}

// `way`, but no farther than kFarthestTurn from `expected`; empty if it is near enough.
std::optional<Vec2> corrected(const Vec2& way, const Vec2& expected) {
  const double turn = angle_between(expected, way);
  if (std::abs(turn) <= kFarthestTurn) return std::nullopt;
  return turned(expected.normalized(), std::copysign(kFarthestTurn, turn));
}

class EdgeFitter {
 public:
  EdgeFitter(const Pattern& original, const PatternMesh& mesh, const Points2& target, const GarmentMirrors& mirrors,
             const FitPatternEdgesOptions& options)
      : original_(original),
        mesh_(mesh),
        target_(target),
        mirrors_(mirrors),
        options_(options),
        rules_(side_rules(original, mirrors, options.keep_straight)) {
    result_.pattern = original;
  }

  FitPatternEdgesResult run() {
    for (int p = 0; p < static_cast<int>(original_.panels.size()); ++p) fit_panel(p);
    mirror_drawing(mesh_, mirrors_, target_, result_.pattern);
    if (options_.keep_seam_ratios) {
      match_seam_lengths(result_.pattern, seam_ratios(), rules_);
      mirror_drawing(mesh_, mirrors_, target_, result_.pattern);  // equal again, to the last bit
    }
    for (std::size_t p = 0; p < original_.panels.size(); ++p)
      keep_in_place(original_.panels[p], result_.pattern.panels[p]);
    measure();
    return std::move(result_);
  }

 private:
  const std::vector<int>& vertices_of(int p, int e) const {
    return mesh_.edge_vertices[static_cast<std::size_t>(p)][static_cast<std::size_t>(e)];
  }
  Vec2 target(int v) const { return target_.row(v); }
  std::vector<Vec2> inner_points(int p, int e) const {
    std::vector<Vec2> points;
    const auto& vertices = vertices_of(p, e);
    for (std::size_t i = 1; i + 1 < vertices.size(); ++i) points.push_back(target(vertices[i]));
    return points;
  }

  void fit_panel(int p) {
    const Panel& before = original_.panels[static_cast<std::size_t>(p)];
    Panel& after = result_.pattern.panels[static_cast<std::size_t>(p)];
    const PanelMotion motion(mesh_, target_, p);
    for (int c = 0; c < before.edge_count(); ++c) {
      // A corner whose short edge collapsed stands beside its vertex; the surroundings carry the difference.
      const int v = vertices_of(p, c).front();
      const Vec2 offset = before.edge_start(c) - mesh_.rest.row(v).transpose();
      Vec2& corner = after.corners[static_cast<std::size_t>(c)];
      corner = target(v);
      if (offset.norm() > 1e-9) corner += motion.at_vertex(v) * offset;
    }
    std::vector<EndDirections> directions(before.edges.size());
    for (int e = 0; e < before.edge_count(); ++e)
      after.edges[static_cast<std::size_t>(e)].curve =
          fit_edge(p, e, motion, directions[static_cast<std::size_t>(e)]).shape;
    if (options_.smooth_corners) smooth_corners(p, std::move(directions));
    move_marks(before, motion, p, after);
  }

  // A panel that grew from its first corner on would be placed aside of the body, and be no one's mirror image there.
  // Its height is left alone: trousers of a child, kept about the middle of an adult's, would be taken for a shirt.
  static void keep_in_place(const Panel& before, Panel& after) {
    Vec2 way = Vec2::Zero();
    for (std::size_t c = 0; c < before.corners.size(); ++c) way += after.corners[c] - before.corners[c];
    const Vec3 placed = after.rotation.leftCols<2>() * way / static_cast<double>(before.corners.size());
    after.translation -= Vec3(placed.x(), 0.0, placed.z());
  }

  const SideRule& rule(int p, int e) const { return rules_[static_cast<std::size_t>(p)][static_cast<std::size_t>(e)]; }

  bool keeps_shape(int p, int e) const { return rule(p, e).straight || rule(p, e).locked; }

  Curve fit_edge(int p, int e, const PanelMotion& motion, EndDirections& directions) {
    const Curve before = edge_curve(original_.panels[static_cast<std::size_t>(p)], e);
    const Panel& after = result_.pattern.panels[static_cast<std::size_t>(p)];
    const Curve guess = carried(before, after.edge_start(e), after.edge_end(e));
    const std::vector<Vec2> points = inner_points(p, e);
    if (points.empty() || keeps_shape(p, e)) return guess;
    const CurveFit fit = fit_curve(guess, points, original_parameters(before, p, e));
    directions = directions_for(before, fit.curve, motion);
    if (fit.deviation <= options_.tolerance && !directions.start && !directions.end) return fit.curve;
    const CurveFit free = fit_cubic(p, e, {});
    directions = directions_for(before, free.curve, motion);
    const CurveFit bent = directions.start || directions.end ? fit_cubic(p, e, directions) : free;
    if (bent.deviation > options_.cubic_tolerance) {
      ++result_.polyline_edges;
      Curve chain = bent.curve;
      chain.shape.kind = CurveKind::Polyline;
      chain.shape.points = points;
      return chain;
    }
    if (before.shape.kind != CurveKind::CubicBezier) ++result_.bent_edges;
    return bent.curve;
  }

  // Corrections of a fitted curve's ends, where the cloth about them says otherwise.
  EndDirections directions_for(const Curve& before, const Curve& fitted, const PanelMotion& motion) const {
    if (!options_.smooth_corners || fitted.shape.kind == CurveKind::Polyline) return {};
    const double about = std::min(kAbout, 0.5 * curve_length(before));
    const auto correct = [&](double t, const Vec2& corner) {
      return corrected(curve_derivative(fitted, t), motion.around(corner, about) * curve_derivative(before, t));
    };
    return {correct(0.0, before.start), correct(1.0, before.end)};
  }

  CurveFit fit_cubic(int p, int e, const EndDirections& directions) const {
    const Curve before = as_cubic(edge_curve(original_.panels[static_cast<std::size_t>(p)], e));
    const Panel& after = result_.pattern.panels[static_cast<std::size_t>(p)];
    return fit_curve(carried(before, after.edge_start(e), after.edge_end(e)), inner_points(p, e),
                     original_parameters(before, p, e), directions);
  }

  // Where one edge ran on smoothly into the next, both take one direction: that of a straight edge, or their mean.
  void smooth_corners(int p, std::vector<EndDirections> directions) {
    const Panel& before = original_.panels[static_cast<std::size_t>(p)];
    Panel& after = result_.pattern.panels[static_cast<std::size_t>(p)];
    const int n = before.edge_count();
    std::vector<bool> again(before.edges.size());
    for (int in = 0; in < n; ++in) {
      const int out = (in + 1) % n;
      const auto turn = [&](const Panel& panel) {
        return angle_between(curve_derivative(edge_curve(panel, in), 1.0),
                             curve_derivative(edge_curve(panel, out), 0.0));
      };
      const double wanted = turn(before), excess = turn(after) - wanted;
      const bool in_keeps = keeps_shape(p, in), out_keeps = keeps_shape(p, out);
      if (std::abs(wanted) > kSmoothCorner || std::abs(excess) < kKink || (in_keeps && out_keeps)) continue;
      const double share = in_keeps ? 0.0 : out_keeps ? 1.0 : 0.5;
      const Vec2 way = turned(curve_derivative(edge_curve(after, in), 1.0).normalized(), share * excess);
      directions[static_cast<std::size_t>(in)].end = way;
      directions[static_cast<std::size_t>(out)].start = turned(way, wanted);
      if (!in_keeps) again[static_cast<std::size_t>(in)] = true;
      if (!out_keeps) again[static_cast<std::size_t>(out)] = true;
    }
    for (int e = 0; e < n; ++e) {
      EdgeCurve& curve = after.edges[static_cast<std::size_t>(e)].curve;
      if (!again[static_cast<std::size_t>(e)] || inner_points(p, e).empty() || curve.kind == CurveKind::Polyline)
        continue;
      if (curve.kind != CurveKind::CubicBezier) ++result_.bent_edges;
      curve = fit_cubic(p, e, directions[static_cast<std::size_t>(e)]).curve.shape;
    }
  }

  // Parameters of the inner mesh vertices on the original edge.
  std::vector<double> original_parameters(const Curve& before, int p, int e) const {
    const auto& vertices = vertices_of(p, e);
    std::vector<double> parameters;
    for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
      const double fraction = static_cast<double>(i) / static_cast<double>(vertices.size() - 1);
      const Vec2 point = mesh_.rest.row(vertices[i]);
      parameters.push_back(distance_to_curve(before, point, curve_parameters_at(before, {fraction})[0]).second);
    }
    return parameters;
  }

  void move_marks(const Panel& before, const PanelMotion& motion, int p, Panel& after) {
    for (std::size_t i = 0; i < before.notches.size(); ++i) after.notches[i].at = moved_fraction(before.notches[i], p);
    if (before.grainline) {
      const auto& [from, to] = *before.grainline;
      const Vec2 middle = 0.5 * (from + to), half = 0.5 * (to - from);
      const Vec2 moved = motion.moved(middle);
      after.grainline = {{moved - half, moved + half}};
    }
    for (std::size_t r = 0; r < before.keep_outs.size(); ++r) {
      Vec2 centre = Vec2::Zero();
      for (const Vec2& corner : before.keep_outs[r].polygon) centre += corner;
      centre /= static_cast<double>(before.keep_outs[r].polygon.size());
      const Vec2 moved = motion.moved(centre);
      const Mat2 turn = motion.turn_at(centre);
      for (Vec2& corner : after.keep_outs[r].polygon) corner = moved + turn * (corner - centre);
    }
  }

  // The notch stays with the cloth: its fraction among the moved vertices.
  double moved_fraction(const Notch& notch, int p) const {
    const auto& vertices = vertices_of(p, notch.edge);
    if (vertices.size() < 3) return notch.at;
    std::vector<double> before = {0.0}, after = {0.0};
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      before.push_back(before.back() + (mesh_.rest.row(vertices[i]) - mesh_.rest.row(vertices[i - 1])).norm());
      after.push_back(after.back() + (target(vertices[i]) - target(vertices[i - 1])).norm());
    }
    const double walked = notch.at * before.back();
    std::size_t i = 1;
    while (i + 1 < before.size() && before[i] < walked) ++i;
    const double s = std::clamp((walked - before[i - 1]) / (before[i] - before[i - 1]), 0.0, 1.0);
    return std::clamp((after[i - 1] + s * (after[i] - after[i - 1])) / after.back(), 0.0, 1.0);
  }

  double length(const Pattern& pattern, const SeamSide& side) const {
    return edge_length(pattern.panel(side.panel), side.edge);
  }

  std::vector<double> seam_ratios() const {
    std::vector<double> ratios;
    for (const Seam& seam : original_.seams) ratios.push_back(length(original_, seam.a) / length(original_, seam.b));
    return ratios;
  }

  // From several starts: the nearest place found from one alone may be a local one.
  static double nearest(const Curve& curve, const Vec2& point) {
    double least = std::numeric_limits<double>::infinity();
    for (const double t : {0.05, 0.25, 0.5, 0.75, 0.95})
      least = std::min(least, distance_to_curve(curve, point, t).first);
    return least;
  }

  void measure() {
    for (int p = 0; p < static_cast<int>(original_.panels.size()); ++p) {
      const Panel& panel = result_.pattern.panels[static_cast<std::size_t>(p)];
      result_.deviation.emplace_back();
      for (int e = 0; e < panel.edge_count(); ++e) {
        const auto points = inner_points(p, e);
        double farthest = 0.0;
        for (const Vec2& point : points) farthest = std::max(farthest, nearest(edge_curve(panel, e), point));
        result_.deviation.back().push_back(farthest);
        result_.largest_deviation = std::max(result_.largest_deviation, farthest);
      }
    }
    const std::vector<double> ratios = seam_ratios();
    for (std::size_t s = 0; s < ratios.size(); ++s) {
      const Seam& seam = original_.seams[s];
      const double mismatch = length(result_.pattern, seam.a) - ratios[s] * length(result_.pattern, seam.b);
      result_.largest_seam_mismatch = std::max(result_.largest_seam_mismatch, std::abs(mismatch));
    }
  }

  const Pattern& original_;
  const PatternMesh& mesh_;
  const Points2& target_;
  const GarmentMirrors& mirrors_;
  const FitPatternEdgesOptions& options_;
  SideRules rules_;
  FitPatternEdgesResult result_;
};

}  // namespace

FitPatternEdgesResult fit_pattern_edges(const Pattern& original, const PatternMesh& mesh, const Points2& target_rest,
                                        const GarmentMirrors& mirrors, const FitPatternEdgesOptions& options) {
  return EdgeFitter(original, mesh, target_rest, mirrors, options).run();
}

}  // namespace toile
