// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/refine_map.h"

#include "engine/bodies/body_bones.h"
#include "engine/core/error.h"
#include "engine/geometry/half_edges.h"
#include "engine/geometry/surface_operators.h"
#include "engine/numerics/sparse_solver.h"

namespace toile {
namespace {

constexpr int kTaubinSteps = 4;
constexpr double kTangential = 0.15;  // share of the pull along the surface
// A vertex and the middle of a triangle, so weighted, measure a quadratic gap between curved skins without bias.
constexpr double kFaceShare = 0.75;
constexpr double kLeastCotangent = 1e-3, kMostCotangent = 10.0;
constexpr double kPinAreas = 30.0;  // weight of a pin: this many times ell^2, so that it wins
constexpr double kHead = 0.3;       // a vertex with more of the head may be the mouth's inside
constexpr double kSettled = 5e-5;   // of the height: a level ends when the mean move is under it

// Lengths as fractions of the height.
struct Level {
  bool proxy;
  double ell;  // reach of the plate
  int iterations;
  double within;  // closest points are sought up to here
  double soft;    // distance at which a match counts a quarter
  double cosine;  // of the normals of a match, at least
  bool faces;     // pull at the middles of triangles too: vertices on the skin alone leave flat triangles inside it
};
constexpr Level kLevels[] = {
    {true, 0.15, 12, 0.20, 0.05, 0.3, false},   {true, 0.10, 12, 0.12, 0.04, 0.4, false},
    {true, 0.06, 12, 0.08, 0.03, 0.5, false},   {true, 0.03, 12, 0.06, 0.02, 0.5, false},
    {false, 0.012, 6, 0.04, 0.012, 0.5, false}, {false, 0.006, 8, 0.03, 0.010, 0.5, false},
    {false, 0.004, 3, 0.02, 0.008, 0.5, true},
};
// Only where the target has no noise to follow: a model's breasts are sharper than the last level of all bends.
constexpr Level kCleanLevel = {false, 0.0015, 4, 0.02, 0.006, 0.5, true};

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

// One mesh (proxy or whole body) with its rest operators and its present displacement.
class Plate {
 public:
  Plate(Points3 base, const Triangles& triangles, const Eigen::VectorXd& visible, std::vector<Pin> pins)
      : base_(std::move(base)), triangles_(triangles), visible_(visible), pins_(std::move(pins)) {
    areas_ = vertex_areas(base_, triangles_).cwiseMax(1e-12);
    const SparseMatrix laplacian = cotangent_laplacian(base_, triangles_, kLeastCotangent, kMostCotangent);
    bending_ = laplacian * areas_.cwiseInverse().asDiagonal() * laplacian;
    displacement_ = Points3::Zero(base_.rows(), 3);
    near_.assign(at(base_.rows()), -1);
  }

  Points3 displacement_;

  Points3 positions() const { return base_ + displacement_; }
  void set_visible(Eigen::VectorXd visible) { visible_ = std::move(visible); }

  void run(const Level& level, const FitTarget& target, double height) {
    const double ell = level.ell * height;
    pin_weight_ = kPinAreas * ell * ell;
    SparseMatrix system = std::pow(ell, 4) * bending_;
    Eigen::VectorXd mass = areas_;
    for (const Pin& pin : pins_) mass[pin.vertex] += pin.share * pin_weight_;
    for (Eigen::Index i = 0; i < mass.size(); ++i) system.coeffRef(i, i) += mass[i];
    if (!solver_.factor(system))
      throw Error(ErrorCode::RegistrationFailed, "target_body",
                  "the registration's system could not be factored; the reference body has triangles without area");
    for (int i = 0; i < level.iterations; ++i)
      if (step(level, target, height) < kSettled * height) break;
  }

 private:
  // One pull towards the target and one plate solve. Returns the mean move.
  double step(const Level& level, const FitTarget& target, double height) {
    const Points3 x = positions();
    const Points3 normals = vertex_normals(x, triangles_);
    Eigen::MatrixXd right(x.rows(), 3);
    for (Eigen::Index i = 0; i < right.rows(); ++i) {
      const Vec3 r =
          visible_[i] > 0 ? pull(x.row(i), normals.row(i), near_[at(i)], level, target, height) : Vec3::Zero();
      right.row(i) = areas_[i] * (displacement_.row(i) + (level.faces ? 1.0 - kFaceShare : 1.0) * r.transpose());
    }
    if (level.faces) add_face_pulls(x, level, target, height, right);
    for (const Pin& pin : pins_)
      right.row(pin.vertex) += pin.share * pin_weight_ * (pin.place.transpose() - base_.row(pin.vertex));
    const Points3 next = solver_.solve(right);
    const double move = (next - displacement_).rowwise().norm().mean();
    displacement_ = next;
    return move;
  }

  // The share of the pull that is taken at the middles of triangles, and spread to their corners.
  void add_face_pulls(const Points3& x, const Level& level, const FitTarget& target, double height,
                      Eigen::MatrixXd& right) {
    near_face_.resize(at(triangles_.rows()), -1);
    for (Eigen::Index f = 0; f < triangles_.rows(); ++f) {
      const auto t = triangles_.row(f);
      if (visible_[t[0]] * visible_[t[1]] * visible_[t[2]] == 0) continue;
      const Vec3 a = x.row(t[0]), b = x.row(t[1]), c = x.row(t[2]), cross = (b - a).cross(c - a);
      const Vec3 r = pull((a + b + c) / 3.0, cross.normalized(), near_face_[at(f)], level, target, height);
      for (int k = 0; k < 3; ++k) right.row(t[k]) += kFaceShare * cross.norm() / 6.0 * r.transpose();
    }
  }

  static Vec3 pull(const Vec3& x, const Vec3& normal, int& near, const Level& level, const FitTarget& target,
                   double height) {
    const SurfacePoint c = target.tree().closest_point_facing(x, normal, level.cosine, level.within * height, near);
    if (!c.found()) return Vec3::Zero();
    near = c.triangle;
    if (target.on_open_edge(c)) return Vec3::Zero();
    const Vec3 r = c.point - x, n = target.normal(c);
    const double far = r.squaredNorm() / std::pow(level.soft * height, 2);
    const Vec3 along_normal = n * (n.dot(r) / std::max(n.squaredNorm(), 1e-30));
    return (kTangential * r + (1.0 - kTangential) * along_normal) / ((1.0 + far) * (1.0 + far));
  }

  Points3 base_;
  const Triangles& triangles_;
  Eigen::VectorXd visible_, areas_;
  std::vector<Pin> pins_;
  SparseMatrix bending_;
  SparseSolver solver_;
  std::vector<int> near_, near_face_;  // the last match's triangle, where the next search starts
  double pin_weight_ = 0.0;
};

// The proxy vertex that carries most of each pinned vertex.
std::vector<Pin> proxy_pins(const RegistrationReference& reference, const std::vector<Pin>& pins) {
  std::vector<Pin> out;
  for (const Pin& pin : pins) {
    Eigen::Index corner = 0;
    reference.body_on_proxy.weights.row(pin.vertex).maxCoeff(&corner);
    out.push_back({reference.body_on_proxy.corners(pin.vertex, corner), pin.place, pin.share});
  }
  return out;
}

// A scanner sees no skin where thighs or arm and trunk press on each other; a model has it, and left to the plate alone
// the crotch stays a tunnel above thighs that touch. A mouth has no counterpart anywhere.
Eigen::VectorXd visible_or_pressed(const RegistrationReference& reference) {
  Eigen::VectorXd visible = reference.visible;
  for (Eigen::Index v = 0; v < visible.size(); ++v)
    if (reference.weights(v, Head) < kHead) visible[v] = 1.0;
  return visible;
}

}  // namespace

// Smoothing a clean model would only round it off.
FitTarget::FitTarget(const TriangleMesh& seen)
    : clean_(surface_roughness(seen) <= kRoughScan),
      surface_{clean_ ? seen.vertices : taubin_smooth(seen, kTaubinSteps), seen.triangles},
      tree_(surface_.vertices, surface_.triangles),
      normals_(vertex_normals(surface_.vertices, surface_.triangles)),
      open_vertex_(at(seen.vertex_count()), false),
      open_edge_(at(seen.triangle_count()) * 3, false) {
  const HalfEdges edges = find_half_edges(surface_.triangles);
  for (std::size_t h = 0; h < edges.opposite.size(); ++h) {
    if (edges.opposite[h] >= 0) continue;
    open_edge_[h] = true;
    open_vertex_[at(half_edge_start(surface_.triangles, static_cast<int>(h)))] = true;
    open_vertex_[at(half_edge_end(surface_.triangles, static_cast<int>(h)))] = true;
  }
}

Vec3 FitTarget::normal(const SurfacePoint& p) const {
  const auto t = surface_.triangles.row(p.triangle);
  return p.barycentric[0] * normals_.row(t[0]) + p.barycentric[1] * normals_.row(t[1]) +
         p.barycentric[2] * normals_.row(t[2]);
}

bool FitTarget::on_open_edge(const SurfacePoint& p) const {
  if (p.feature == TriangleFeature::Edge) return open_edge_[at(p.triangle) * 3 + at(p.feature_index)];
  if (p.feature == TriangleFeature::Corner) return open_vertex_[at(surface_.triangles(p.triangle, p.feature_index))];
  return false;
}

Points3 refine_map(const RegistrationReference& reference, const Points3& coarse, const FitTarget& target,
                   double height, const std::vector<Pin>& pins, const Progress* progress) {
  Plate proxy(reference.proxy_on_body.carry(coarse), reference.proxy.triangles,
              reference.proxy_on_body.carry(reference.visible.replicate(1, 3)).col(0).array().round(),
              proxy_pins(reference, pins));
  Plate whole(coarse, reference.surface.triangles, reference.visible, pins);
  double done = 0.0;
  for (const Level& level : kLevels) {
    report(progress, "register", 0.2 + 0.7 * done / std::size(kLevels));
    if (!level.proxy && done == 4.0) whole.displacement_ = reference.body_on_proxy.carry(proxy.displacement_);
    (level.proxy ? proxy : whole).run(level, target, height);
    done += 1.0;
  }
  if (target.is_clean()) {
    whole.set_visible(visible_or_pressed(reference));
    whole.run(kCleanLevel, target, height);
  }
  return whole.positions();
}

}  // namespace toile
