// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/draw_target.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/geometry/curve.h"
#include "engine/geometry/triangle_gradient.h"
#include "engine/stages/outline_crossing.h"
#include "engine/stages/place_on_edges.h"

namespace toile {
namespace {

constexpr std::array<double, 8> kKept = {1.0, 0.95, 0.9, 0.8, 0.6, 0.4, 0.2, 0.0};
constexpr double kSeamTolerance = 0.5e-3;  // m; sewn sides that agree so far can be sewn

// Whether nobody could cut it: it crosses itself, or there is next to nothing of it.
bool unusable(const Panel& panel) {
  for (int e = 0; e < panel.edge_count(); ++e)
    if (!((panel.edge_end(e) - panel.edge_start(e)).norm() >= kShortestEdge)) return true;
  return !(std::abs(outline_signed_area(panel)) >= kSmallestPanel) || find_outline_crossing(panel).has_value();
}

class TargetDrawer {
 public:
  TargetDrawer(const Pattern& pattern, const PatternMesh& mesh, const FittingMap& fit, const Drape& shape,
               const Points2& derived, const GarmentMirrors& mirrors, const DerivePatternOptions& options,
               Progress* progress)
      : pattern_(pattern),
        mesh_(mesh),
        fit_(fit),
        shape_(shape),
        derived_(derived),
        mirrors_(mirrors),
        options_(options),
        progress_(progress),
        held_back_(pattern.panels.size()) {}

  DrawnTarget run() {
    for (const double kept : kKept) {
      Attempt tried = attempt(kept);
      std::vector<bool> bad = bad_panels(tried);
      if (kept < 1.0 && tried.target.drawn.largest_seam_mismatch > kSeamTolerance) bad.assign(bad.size(), true);
      if (!any(bad)) return std::move(tried.target);
      for (std::size_t p = 0; p < bad.size(); ++p)
        if (bad[p]) hold_back(p);
    }
    return reference();
  }

 private:
  struct Attempt {
    DrawnTarget target;
    std::vector<bool> unusable;  // per panel
  };

  static bool any(const std::vector<bool>& flags) { return std::find(flags.begin(), flags.end(), true) != flags.end(); }

  void hold_back(std::size_t p) {
    held_back_[p] = true;
    if (const PanelImage* image = mirrors_.image_of(static_cast<int>(p)))
      held_back_[static_cast<std::size_t>(image->panel)] = true;
  }

  // The pattern as it was: its mesh has no inverted triangle.
  DrawnTarget reference() {
    held_back_.assign(held_back_.size(), true);
    DrawnTarget target = attempt(0.0).target;
    target.inside = {};
    target.inside.rest = blended(0.0);
    return target;
  }

  // The inside is left out where an outline is unusable: none would be without inverted triangles.
  Attempt attempt(double kept) const {
    Attempt tried;
    DrawnTarget& target = tried.target;
    for (std::size_t p = 0; p < held_back_.size(); ++p)
      if (held_back_[p]) target.held_back.push_back(static_cast<int>(p));
    if (!target.held_back.empty()) target.kept_change = kept;
    const Points2 rest = blended(kept);
    FitPatternEdgesOptions drawing;
    drawing.keep_straight = options_.keep_straight;
    target.drawn = fit_pattern_edges(pattern_, mesh_, rest, mirrors_, drawing);
    for (const Panel& panel : target.drawn.pattern.panels) tried.unusable.push_back(unusable(panel));
    if (any(tried.unusable)) return tried;
    const Points2 outline = place_on_edges(pattern_, target.drawn.pattern, mesh_, rest);
    target.inside = derive_inside(mesh_, fit_, shape_, outline, mirrors_, options_, progress_);
    return tried;
  }

  // Held back panels between the reference and the derived one about a common centre; the grain keeps its direction.
  Points2 blended(double kept) const {
    Points2 rest = derived_;
    for (std::size_t p = 0; p < held_back_.size(); ++p) {
      if (!held_back_[p]) continue;
      const PanelRange& range = mesh_.panels[p];
      const int count = range.vertex_end - range.vertex_begin;
      auto rows = rest.middleRows(range.vertex_begin, count);
      const auto reference = mesh_.rest.middleRows(range.vertex_begin, count);
      const Eigen::RowVector2d shift = rows.colwise().mean() - reference.colwise().mean();
      rows = (kept * rows + (1.0 - kept) * (reference.rowwise() + shift)).eval();
    }
    return rest;
  }

  std::vector<bool> bad_panels(const Attempt& tried) const {
    std::vector<bool> bad = tried.unusable;
    if (tried.target.inside.flipped_triangles > 0)
      for (int f = 0; f < mesh_.triangle_count(); ++f)
        if (doubled_area(tried.target.inside.rest, mesh_.triangles, f) <= 0.0)
          bad[static_cast<std::size_t>(mesh_.panel_of_triangle[static_cast<std::size_t>(f)])] = true;
    return bad;
  }

  const Pattern& pattern_;
  const PatternMesh& mesh_;
  const FittingMap& fit_;
  const Drape& shape_;
  const Points2& derived_;
  const GarmentMirrors& mirrors_;
  const DerivePatternOptions& options_;
  Progress* progress_;
  std::vector<bool> held_back_;
};

}  // namespace

DrawnTarget draw_target(const Pattern& pattern, const PatternMesh& reference_mesh, const FittingMap& reference_fit,
                        const Drape& shape, const Points2& derived, const GarmentMirrors& mirrors,
                        const DerivePatternOptions& options, Progress* progress) {
  return TargetDrawer(pattern, reference_mesh, reference_fit, shape, derived, mirrors, options, progress).run();
}

}  // namespace toile
