// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/registration/registration_score.h"

#include <algorithm>
#include <numeric>
#include <random>

#include "engine/bodies/body_bones.h"
#include "engine/bodies/import_body.h"
#include "engine/geometry/closest_point.h"
#include "tests/support/shared_body.h"
#include "tests/support/sidecar.h"

namespace toile::test {
namespace {

constexpr double kMasked = 0.3;  // a vertex with more of hand, head or foot than this is not judged

bool judged(const Eigen::MatrixXd& weights, Eigen::Index v, bool arms) {
  double masked = weights(v, Head);
  for (const Side side : {Left, Right}) {
    masked += weights(v, bone_of(Hand, side)) + weights(v, bone_of(Foot, side));
    if (!arms) masked += weights(v, bone_of(UpperArm, side)) + weights(v, bone_of(Forearm, side));
  }
  return masked < kMasked;
}

}  // namespace

Points3 moved(const Points3& points, const Mat4& m) {
  return (points * m.topLeftCorner<3, 3>().transpose()).rowwise() + m.topRightCorner<3, 1>().transpose();
}

double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(fraction * static_cast<double>(values.size())))];
}

RegistrationCase scan_case(const std::string& scan) {
  const ScanSidecar sidecar = load_scan_sidecar(scan);
  RegistrationCase out;
  const ImportBodyResult imported = import_body(shared_scan_bytes(scan), scan);
  out.target = without_patches(imported.body, imported.repairs.added_triangles());
  const Mat4 frame = out.target.normalised_from_file * sidecar.scan_from_body;
  out.truth = load_shared_body(sidecar.source_body).surface;
  out.truth.vertices = moved(out.truth.vertices, frame);
  for (const auto& [name, p] : sidecar.landmarks) out.landmarks[name] = (frame * p.homogeneous()).head<3>();
  out.arms_differ = scan == "scan_d";
  return out;
}

RegistrationCase shuffled_case(const std::string& body, unsigned seed) {
  RegistrationCase out;
  out.truth = load_shared_body(body).surface;
  out.landmarks = load_body_sidecar(body).landmarks;
  out.target.name = body;
  std::mt19937 random(seed);
  std::vector<int> to_of_from(static_cast<std::size_t>(out.truth.vertex_count())),
      order(static_cast<std::size_t>(out.truth.triangle_count()));
  std::iota(to_of_from.begin(), to_of_from.end(), 0), std::iota(order.begin(), order.end(), 0);
  std::shuffle(to_of_from.begin(), to_of_from.end(), random), std::shuffle(order.begin(), order.end(), random);
  TriangleMesh& mesh = out.target.surface;
  mesh = out.truth;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    mesh.vertices.row(to_of_from[static_cast<std::size_t>(v)]) = out.truth.vertices.row(v);
  for (int f = 0; f < mesh.triangle_count(); ++f)
    for (int k = 0; k < 3; ++k)
      mesh.triangles(f, k) =
          to_of_from[static_cast<std::size_t>(out.truth.triangles(order[static_cast<std::size_t>(f)], k))];
  return out;
}

RegistrationScore score_registration(const Points3& mapped, const Eigen::MatrixXd& weights,
                                     const RegistrationCase& known, const std::string& reference_name,
                                     bool same_family) {
  std::vector<double> correspondence, surface, landmarks;
  const SurfaceTree tree(known.truth.vertices, known.truth.triangles);
  int near = -1;
  for (Eigen::Index v = 0; v < mapped.rows(); ++v) {
    if (!judged(weights, v, !known.arms_differ)) continue;
    if (same_family) correspondence.push_back((mapped.row(v) - known.truth.vertices.row(v)).norm());
    const SurfacePoint c = tree.closest_point(mapped.row(v), 1e30, near);
    near = c.triangle;
    surface.push_back(c.distance());
  }
  for (const auto& [name, vertex] : load_body_sidecar(reference_name).landmark_vertex)
    landmarks.push_back((mapped.row(vertex).transpose() - known.landmarks.at(name)).norm());
  RegistrationScore score;
  score.median = quantile(correspondence, 0.5), score.p95 = quantile(correspondence, 0.95);
  score.surface_mean = std::accumulate(surface.begin(), surface.end(), 0.0) / static_cast<double>(surface.size());
  score.surface_p95 = quantile(surface, 0.95);
  score.landmark_median = quantile(landmarks, 0.5), score.landmark_max = quantile(landmarks, 1.0);
  return score;
}

}  // namespace toile::test
