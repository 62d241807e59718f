// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/stretch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/alter/sheet_fibres.h"
#include "engine/core/weighted_quantile.h"

namespace toile {
namespace {

Mat2 edges_to(const Sheet& sheet, const std::array<int, 3>& face, Vec2 SheetVertex::*where) {
  const auto at = [&](int i) -> const Vec2& {
    return sheet.vertices[static_cast<std::size_t>(face[static_cast<std::size_t>(i)])].*where;
  };
  Mat2 edges;
  edges.col(0) = at(1) - at(0);
  edges.col(1) = at(2) - at(0);
  return edges;
}

Vec2 flat_middle(const Sheet& sheet, std::size_t face) {
  Vec2 middle = Vec2::Zero();
  for (const int v : sheet.faces[face]) middle += sheet.vertices[static_cast<std::size_t>(v)].flat / 3.0;
  return middle;
}

// Mean shear of the cloth, and how the strain of each fibre grows across it: both bring far edges off sideways.
class Lean {
 public:
  void add(double area, const Vec2& at, const Mat2& now, const Vec2& length) {
    const Vec2 strain = now.colwise().norm().transpose() - length, across(at.y(), at.x());
    area_ += area;
    shear_ += area * now.col(0).normalized().dot(now.col(1).normalized());
    strain_ += area * strain;
    at_ += area * across;
    squares_ += area * across.cwiseAbs2();
    products_ += area * across.cwiseProduct(strain);
  }
  // How far the mean shear brings the end of cloth so large off, or one long edge past the other.
  double way(const Vec2& extent) const {
    if (area_ <= 0.0) return 0.0;
    const Vec2 spread = squares_ / area_ - (at_ / area_).cwiseAbs2();
    const Vec2 grows = products_ / area_ - (at_ / area_).cwiseProduct(strain_ / area_);
    double way = std::abs(shear_) / area_ * extent.maxCoeff();
    for (int k = 0; k < 2; ++k)
      if (spread[k] > 0.0) way = std::max(way, std::abs(grows[k] / spread[k]) * extent.prod());
    return way;
  }

 private:
  double area_ = 0.0, shear_ = 0.0;
  Vec2 strain_ = Vec2::Zero(), at_ = Vec2::Zero(), squares_ = Vec2::Zero(), products_ = Vec2::Zero();
};

}  // namespace

Mat2 sheet_gradient(const Sheet& sheet, std::size_t face) {
  return edges_to(sheet, sheet.faces[face], &SheetVertex::now) *
         edges_to(sheet, sheet.faces[face], &SheetVertex::flat).inverse();
}

Mat2 guide_gradient(const Sheet& sheet, std::size_t face) {
  return edges_to(sheet, sheet.faces[face], &SheetVertex::guide) *
         edges_to(sheet, sheet.faces[face], &SheetVertex::flat).inverse();
}

void relax(Sheet& sheet, const RelaxOptions& options, Progress* progress, SheetEquations* shared) {
  if (sheet.faces.empty()) return;
  std::optional<SheetEquations> own;
  SheetEquations& equations = shared ? *shared : own.emplace(sheet, options.hold);
  equations.start(sheet);
  const double floor = options.energy_floor * equations.area();
  double before = std::numeric_limits<double>::infinity();
  for (int renewal = 0; renewal < options.max_renewals; ++renewal) {
    check_cancelled(progress);
    equations.renew(sheet);
    double energy = 0.0;
    for (int i = 0; i < options.sweeps; ++i) energy = equations.sweep();
    // Not the change of one renewal alone: the first may raise the energy while the cloth comes onto its sides.
    if (renewal > 0 && (energy < floor || std::abs(before - energy) < options.energy_drop * energy)) break;
    before = energy;
  }
  equations.finish(sheet);
}

SheetStress measure_stress(const Sheet& sheet) {
  SheetStress stress;
  WeightedValues tension;
  std::array<WeightedValues, 2> along;  // weft, warp
  Vec2 lengthened = Vec2::Zero();
  Lean lean;
  for (std::size_t f = 0; f < sheet.faces.size(); ++f) {
    if (sheet.folded[f]) continue;
    const double area = 0.5 * edges_to(sheet, sheet.faces[f], &SheetVertex::flat).determinant();
    const Mat2 now = sheet_gradient(sheet, f);
    const Vec2 length = wanted_lengths(guide_gradient(sheet, f), false);
    stress.energy += area * (now - fibre_projection(now, length)).squaredNorm();
    stress.area += area;
    tension.emplace_back(now.colwise().norm().maxCoeff() - 1.0, area);
    lengthened += area * (now.colwise().norm().transpose() - length);
    lean.add(area, flat_middle(sheet, f), now, length);
    for (int k = 0; k < 2; ++k) along[static_cast<std::size_t>(k)].emplace_back(now.col(k).norm() - 1.0, area);
  }
  stress.p95 = weighted_quantile(tension, 0.95);
  stress.p98 = weighted_quantile(tension, 0.98);
  const Vec2 extent = extent_of(sheet);
  for (int k = 0; k < 2; ++k)
    stress.way = std::max(stress.way, extent[k] * weighted_quantile(along[static_cast<std::size_t>(k)], 0.95));
  if (stress.area > 0.0) stress.shift = std::max(0.0, extent.cwiseProduct(lengthened).maxCoeff() / stress.area);
  stress.lean = lean.way(extent);
  return stress;
}

}  // namespace toile
