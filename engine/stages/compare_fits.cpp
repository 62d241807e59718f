// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/compare_fits.h"

#include <algorithm>
#include <cassert>

namespace toile {
namespace {

// Area-weighted sums that become means at the end.
struct Sums {
  FitDifference sum;

  void add(double area, double weft, double warp, double shear, bool beyond) {
    sum.area += area;
    sum.rms_weft += area * weft * weft;
    sum.rms_warp += area * warp * warp;
    sum.rms_shear += area * shear * shear;
    sum.mean_weft += area * weft;
    sum.mean_warp += area * warp;
    if (beyond) sum.share_beyond += area;
  }

  FitDifference means() const {
    if (sum.area <= 0.0) return {};
    FitDifference mean = sum;
    const double weft = sum.rms_weft / sum.area, warp = sum.rms_warp / sum.area;
    mean.rms_weft = std::sqrt(weft);
    mean.rms_warp = std::sqrt(warp);
    mean.rms_stretch = std::sqrt(0.5 * (weft + warp));
    mean.rms_shear = std::sqrt(sum.rms_shear / sum.area);
    mean.mean_weft = sum.mean_weft / sum.area;
    mean.mean_warp = sum.mean_warp / sum.area;
    mean.share_beyond = sum.share_beyond / sum.area;
    return mean;
  }
};

}  // namespace

FitComparison compare_fits(const PatternMesh& mesh, const FittingMap& reference, const FittingMap& fit,
                           const CompareFitsOptions& options, const std::vector<BodyZone>& zones) {
  assert(reference.triangle_count() == mesh.triangle_count() && fit.triangle_count() == mesh.triangle_count());
  FitComparison result;
  Sums whole;
  std::vector<Sums> panels(mesh.panels.size()), by_zone(zones.empty() ? 0 : kBodyZoneCount);
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const auto face = static_cast<std::size_t>(f);
    if (reference.degenerate[face] || fit.degenerate[face]) {
      ++result.degenerate_triangles;
      continue;
    }
    const double weft = fit.stretch_weft[f] - reference.stretch_weft[f];
    const double warp = fit.stretch_warp[f] - reference.stretch_warp[f];
    const double shear = fit.shear[f] - reference.shear[f];
    const double larger = std::max(std::abs(weft), std::abs(warp));
    const bool beyond = larger > options.limit;
    const auto count = [&](Sums& sums) { sums.add(reference.rest_area[f], weft, warp, shear, beyond); };
    count(whole);
    count(panels[static_cast<std::size_t>(mesh.panel_of_triangle[face])]);
    if (!zones.empty()) count(by_zone[static_cast<std::size_t>(zones[face])]);
    if (larger > result.worst_difference) {
      result.worst_difference = larger;
      result.worst_triangle = f;
    }
  }
  result.whole = whole.means();
  for (const Sums& sums : panels) result.panels.push_back(sums.means());
  for (const Sums& sums : by_zone) result.zones.push_back(sums.means());
  return result;
}

PositionDifference compare_positions(const Points3& wanted, const Points3& reached) {
  assert(wanted.rows() == reached.rows());
  PositionDifference result;
  if (wanted.rows() == 0) return result;
  const Eigen::VectorXd distance = (wanted - reached).rowwise().norm();
  result.rms = std::sqrt(distance.squaredNorm() / static_cast<double>(distance.size()));
  result.largest = distance.maxCoeff(&result.worst_node);
  std::vector<double> sorted(distance.data(), distance.data() + distance.size());
  const auto rank = static_cast<std::size_t>(0.95 * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(rank), sorted.end());
  result.p95 = sorted[rank];
  return result;
}

}  // namespace toile
