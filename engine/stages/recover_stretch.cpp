// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/recover_stretch.h"

#include <algorithm>
#include <cmath>

namespace toile {
namespace {

constexpr double kFlatter = 1e-6;  // relative: where a patch is one line of triangles, the plane is level across it

constexpr std::size_t kLeastPatch = 6;  // triangles, for a plane that is not just the triangle itself

std::vector<std::vector<int>> triangles_at_vertices(const PatternMesh& mesh) {
  std::vector<std::vector<int>> at(static_cast<std::size_t>(mesh.vertex_count()));
  for (int f = 0; f < mesh.triangle_count(); ++f)
    for (int k = 0; k < 3; ++k) at[static_cast<std::size_t>(mesh.triangles(f, k))].push_back(f);
  return at;
}

// Triangles that share a corner with `f`, itself too.
void patch_of(const PatternMesh& mesh, const std::vector<std::vector<int>>& at_vertex, int f, std::vector<int>& patch) {
  patch.clear();
  for (int k = 0; k < 3; ++k) {
    const std::vector<int>& round = at_vertex[static_cast<std::size_t>(mesh.triangles(f, k))];
    patch.insert(patch.end(), round.begin(), round.end());
  }
  std::sort(patch.begin(), patch.end());
  patch.erase(std::unique(patch.begin(), patch.end()), patch.end());
}

Points2 middles_of(const PatternMesh& mesh, const Points2& rest) {
  Points2 middles(mesh.triangle_count(), 2);
  for (int f = 0; f < mesh.triangle_count(); ++f)
    middles.row(f) =
        (rest.row(mesh.triangles(f, 0)) + rest.row(mesh.triangles(f, 1)) + rest.row(mesh.triangles(f, 2))) / 3.0;
  return middles;
}

}  // namespace

void recover_stretch(const PatternMesh& mesh, const Points2& rest, FittingMap& map) {
  const auto at_vertex = triangles_at_vertices(mesh);
  const Points2 middles = middles_of(mesh, rest);
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> own(mesh.triangle_count(), 3);
  own << map.stretch_weft, map.stretch_warp, map.shear;
  std::vector<int> patch;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    patch_of(mesh, at_vertex, f, patch);
    if (patch.size() < kLeastPatch) continue;
    double area = 0;
    for (const int g : patch) area += map.rest_area[g];
    const double length = std::sqrt(area);
    Mat3 moments = Mat3::Zero(), right = Mat3::Zero();
    Eigen::RowVector3d least = own.row(f), most = least;
    for (const int g : patch) {
      least = least.cwiseMin(own.row(g)), most = most.cwiseMax(own.row(g));
      const Vec2 at = (middles.row(g) - middles.row(f)).transpose() / length;
      const Vec3 row(1.0, at.x(), at.y());
      moments += map.rest_area[g] * row * row.transpose();
      right += map.rest_area[g] * row * own.row(g);
    }
    moments.diagonal().tail<2>().array() += kFlatter * area;
    const Eigen::RowVector3d solved = moments.ldlt().solve(right).row(0), plane = solved.cwiseMax(least).cwiseMin(most);
    if (!plane.allFinite()) continue;
    map.stretch_weft[f] = plane[0], map.stretch_warp[f] = plane[1], map.shear[f] = plane[2];
  }
}

}  // namespace toile
