// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/build_fitting_map.h"

#include <algorithm>

#include "engine/core/error.h"
#include "engine/geometry/triangle_gradient.h"
#include "engine/stages/recover_stretch.h"

namespace toile {
namespace {

// Below this sine between the fibres, or this stretch of a fibre, the tangent frame is noise.
constexpr double kLeastFrame = 1e-6;

Mat2 polar_tensor(const Mat32& gradient) {
  const Mat2 squared = gradient.transpose() * gradient;
  const Eigen::SelfAdjointEigenSolver<Mat2> eigen(squared);
  const Vec2 stretch = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return eigen.eigenvectors() * stretch.asDiagonal() * eigen.eigenvectors().transpose();
}

Points3 positions_of_vertices(const PatternMesh& mesh, const Drape& drape) {
  Points3 positions(mesh.vertex_count(), 3);
  for (int v = 0; v < mesh.vertex_count(); ++v)
    positions.row(v) = drape.nodes.row(mesh.node_of_vertex[static_cast<std::size_t>(v)]);
  return positions;
}

void refuse_inverted(const PatternMesh& mesh, const Points2& rest) {
  for (int f = 0; f < mesh.triangle_count(); ++f)
    if (!(doubled_area(rest, mesh.triangles, f) > 0.0))
      throw Error(ErrorCode::GarmentInvalid,
                  "panel:#" + std::to_string(mesh.panel_of_triangle[static_cast<std::size_t>(f)]),
                  "flat triangle " + std::to_string(f) + " is inverted or empty; mesh the panel again");
}

}  // namespace

bool fitting_tensor(const Mat32& gradient, Mat2& tensor) {
  const Vec3 fu = gradient.col(0), fv = gradient.col(1);
  const double length_u = fu.norm(), length_v = fv.norm();
  const double doubled = fu.cross(fv).norm();
  if (length_u < kLeastFrame || length_v < kLeastFrame || doubled < kLeastFrame * length_u * length_v) {
    tensor = polar_tensor(gradient);
    return false;
  }
  tensor << length_u, fu.dot(fv) / length_u, 0.0, doubled / length_u;
  return true;
}

FittingMap build_fitting_map(const PatternMesh& mesh, const Points2& rest, const Drape& drape) {
  refuse_inverted(mesh, rest);
  const TriangleGradients gradients = triangle_gradients(rest, mesh.triangles);
  const Points3 positions = positions_of_vertices(mesh, drape);
  const int count = mesh.triangle_count();
  FittingMap map;
  map.tensor.resize(static_cast<std::size_t>(count));
  map.degenerate.resize(static_cast<std::size_t>(count));
  map.stretch_weft.resize(count);
  map.stretch_warp.resize(count);
  map.shear.resize(count);
  map.rest_area = gradients.area;
  for (int f = 0; f < count; ++f) {
    const auto face = static_cast<std::size_t>(f);
    const Mat32 gradient = gradients.of(positions, f);
    map.degenerate[face] = !fitting_tensor(gradient, map.tensor[face]);
    const Vec3 fu = gradient.col(0), fv = gradient.col(1);
    map.stretch_weft[f] = fu.norm() - 1.0;
    map.stretch_warp[f] = fv.norm() - 1.0;
    const double lengths = fu.norm() * fv.norm();
    map.shear[f] = lengths > 0.0 ? std::asin(std::clamp(fu.dot(fv) / lengths, -1.0, 1.0)) : 0.0;
  }
  recover_stretch(mesh, rest, map);
  return map;
}

FittingMap fitting_map_of(const PatternMesh& mesh, std::vector<Mat2> tensors) {
  refuse_inverted(mesh, mesh.rest);
  const int count = mesh.triangle_count();
  FittingMap map;
  map.tensor = std::move(tensors);
  map.degenerate.assign(static_cast<std::size_t>(count), false);
  map.stretch_weft.resize(count);
  map.stretch_warp.resize(count);
  map.shear.resize(count);
  map.rest_area = triangle_gradients(mesh.rest, mesh.triangles).area;
  for (int f = 0; f < count; ++f) {
    const Mat2& tensor = map.tensor[static_cast<std::size_t>(f)];
    map.stretch_weft[f] = tensor(0, 0) - 1.0;
    map.stretch_warp[f] = tensor.col(1).norm() - 1.0;
    map.shear[f] = std::atan2(tensor(0, 1), tensor(1, 1));
  }
  recover_stretch(mesh, mesh.rest, map);
  return map;
}

FittingMap build_fitting_map(const PatternMesh& mesh, const Drape& drape) {
  return build_fitting_map(mesh, mesh.rest, drape);
}

}  // namespace toile
