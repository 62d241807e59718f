// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/fit_pattern_edges.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/fit_curve.h"
#include "engine/stages/match_seam_lengths.h"

namespace toile {

namespace {

constexpr double kGrainParallel = 0.02;  // sine of the angle within which an edge runs along the grain: a degree

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// How one panel moves: its flat triangles before and after.
class PanelMotion {
 public:
  PanelMotion(const PatternMesh& mesh, const Points2& target, int panel)
      : mesh_(mesh), target_(target), range_(mesh.panels[static_cast<std::size_t>(panel)]) {
    gradients_.reserve(static_cast<std::size_t>(range_.triangle_end - range_.triangle_begin));
    for (int f = range_.triangle_begin; f < range_.triangle_end; ++f) gradients_.push_back(gradient(f));
  }

  // Mean deformation round a vertex, weighted by area.
  Mat2 at_vertex(int v) const {
    Mat2 sum = Mat2::Zero();
    double area = 0.0;
    for (int f = range_.triangle_begin; f < range_.triangle_end; ++f)
      for (int k = 0; k < 3; ++k)
        if (mesh_.triangles(f, k) == v) {
          const double a = area_of(f);
          sum += a * gradients_[static_cast<std::size_t>(f - range_.triangle_begin)];
          area += a;
        }
    return area > 0 ? Mat2(sum / area) : Mat2(Mat2::Identity());
  }

  // Where a point of the panel goes, and how its surroundings turn (without stretch).
  Vec2 moved(const Vec2& point) const {
    const int f = triangle_at(point);
    return target_.row(mesh_.triangles(f, 0)).transpose() +
           gradients_[static_cast<std::size_t>(f - range_.triangle_begin)] * (point - rest(mesh_.triangles(f, 0)));
  }
  Mat2 turn_at(const Vec2& point) const {
    const Mat2& g = gradients_[static_cast<std::size_t>(triangle_at(point) - range_.triangle_begin)];
    const Vec2 polar(g(0, 0) + g(1, 1), g(1, 0) - g(0, 1));
    if (polar.norm() == 0.0) return Mat2::Identity();
    const Vec2 cs = polar.normalized();
    Mat2 turn;
    turn << cs.x(), -cs.y(), cs.y(), cs.x();
    return turn;
  }

 private:
  Vec2 rest(int v) const { return mesh_.rest.row(v); }

  Mat2 edges(const Points2& points, int f) const {
    const auto t = mesh_.triangles.row(f);
    Mat2 m;
    m.col(0) = (points.row(t[1]) - points.row(t[0])).transpose();
    m.col(1) = (points.row(t[2]) - points.row(t[0])).transpose();
    return m;
  }
  double area_of(int f) const { return 0.5 * std::abs(edges(mesh_.rest, f).determinant()); }
  Mat2 gradient(int f) const { return edges(target_, f) * edges(mesh_.rest, f).inverse(); }

  // The triangle that holds the point, or the one it is least outside of.
  int triangle_at(const Vec2& point) const {
    int best = range_.triangle_begin;
    double least = 1e300;
    for (int f = range_.triangle_begin; f < range_.triangle_end; ++f) {
      const Vec2 s = edges(mesh_.rest, f).inverse() * (point - rest(mesh_.triangles(f, 0)));
      const double outside = std::max({-s.x(), -s.y(), s.x() + s.y() - 1.0}) * std::sqrt(area_of(f));
      if (outside < least) least = outside, best = f;
      if (least <= 0.0) break;
    }
    return best;
  }

  const PatternMesh& mesh_;
  const Points2& target_;
  PanelRange range_;
  std::vector<Mat2> gradients_;
};

class EdgeFitter {
 public:
  EdgeFitter(const Pattern& original, const PatternMesh& mesh, const Points2& target,
             const FitPatternEdgesOptions& options)
      : original_(original), mesh_(mesh), target_(target), options_(options) {
    result_.pattern = original;
  }

  FitPatternEdgesResult run() {
    for (int p = 0; p < static_cast<int>(original_.panels.size()); ++p) fit_panel(p);
    if (options_.keep_seam_ratios) match_seam_lengths(result_.pattern, seam_ratios());
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
    for (int e = 0; e < before.edge_count(); ++e) {
      const Curve shape = fit_edge(p, e);
      after.edges[static_cast<std::size_t>(e)].curve = shape.shape;
    }
    move_marks(before, motion, p, after);
  }

  bool must_stay_straight(int p, int e) const {
    const PanelEdge& edge = original_.panels[static_cast<std::size_t>(p)].edges[static_cast<std::size_t>(e)];
    if (edge.curve.kind != CurveKind::Line) return false;
    if (edge.straight) return *edge.straight;
    if (!options_.keep_straight) return false;
    return edge.on_fold || edge.hem.has_value() || is_free(p, e) || runs_along_grain(p, e);
  }

  bool is_free(int p, int e) const {
    const SeamSide side{PanelId(p), e};
    return std::none_of(original_.seams.begin(), original_.seams.end(),
                        [&](const Seam& seam) { return seam.a == side || seam.b == side; });
  }

  bool runs_along_grain(int p, int e) const {
    const Panel& panel = original_.panels[static_cast<std::size_t>(p)];
    const Vec2 grain = panel.grainline ? Vec2((*panel.grainline)[1] - (*panel.grainline)[0]) : Vec2(0, 1);
    const Vec2 way = panel.edge_end(e) - panel.edge_start(e);
    return std::abs(cross(grain.normalized(), way.normalized())) < kGrainParallel;
  }

  Curve fit_edge(int p, int e) {
    const Curve before = edge_curve(original_.panels[static_cast<std::size_t>(p)], e);
    const Panel& after = result_.pattern.panels[static_cast<std::size_t>(p)];
    const Curve guess = carried(before, after.edge_start(e), after.edge_end(e));
    const std::vector<Vec2> points = inner_points(p, e);
    if (points.empty() || must_stay_straight(p, e)) return guess;
    const CurveFit fit = fit_curve(guess, points, original_parameters(before, p, e));
    if (fit.deviation <= options_.tolerance) return fit.curve;
    const CurveFit bent = fit_curve(as_cubic(fit.curve), points, original_parameters(as_cubic(before), p, e));
    if (bent.deviation > options_.tolerance) {
      ++result_.polyline_edges;
      Curve chain = bent.curve;
      chain.shape.kind = CurveKind::Polyline;
      chain.shape.points = points;
      return chain;
    }
    ++result_.bent_edges;
    return bent.curve;
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

  void measure() {
    for (int p = 0; p < static_cast<int>(original_.panels.size()); ++p) {
      const Panel& panel = result_.pattern.panels[static_cast<std::size_t>(p)];
      result_.deviation.emplace_back();
      for (int e = 0; e < panel.edge_count(); ++e) {
        const auto points = inner_points(p, e);
        double farthest = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
          const double t = static_cast<double>(i + 1) / static_cast<double>(points.size() + 1);
          farthest = std::max(farthest, distance_to_curve(edge_curve(panel, e), points[i], t).first);
        }
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
  const FitPatternEdgesOptions& options_;
  FitPatternEdgesResult result_;
};

}  // namespace

FitPatternEdgesResult fit_pattern_edges(const Pattern& original, const PatternMesh& mesh, const Points2& target_rest,
                                        const FitPatternEdgesOptions& options) {
  return EdgeFitter(original, mesh, target_rest, options).run();
}

}  // namespace toile
