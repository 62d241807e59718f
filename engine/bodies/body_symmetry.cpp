// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/body_symmetry.h"

#include <algorithm>

#include <Eigen/Eigenvalues>

#include "engine/core/units.h"
#include "engine/geometry/closest_point.h"
#include "engine/geometry/components.h"
#include "engine/geometry/surface_operators.h"

namespace toile {
namespace {

constexpr int kSamples = 2000;         // about
constexpr int kSteps = 30;             // point to plane settles in 10 to 30
constexpr double kNormalCosine = 0.5;  // a match must face the same way
constexpr double kSoftness = 2.0;  // matches this many medians away count a quarter; a sharp bound makes the end chancy
constexpr double kLowest = 0.5;    // of the height: feet and legs are placed at will, trunk and arms have the lever
constexpr double kUpright = 0.004;  // m: a body this near to its mirror image does not lean
constexpr double kLeastLean = 1.0 * kRadianPerDegree;
constexpr double kHeld = 1e12;     // weight that forbids a motion
constexpr double kSettled = 1e-5;  // rad and m: under what a normalised body is compared by

Mat3 turn_about_y(double angle) {
  return Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix();
}

struct Sample {
  Vec3 point, normal;
  int triangle;
};

Vec3 centre(const TriangleMesh& body, int f) {
  const auto t = body.triangles.row(f);
  return (body.vertices.row(t[0]) + body.vertices.row(t[1]) + body.vertices.row(t[2])).transpose() / 3.0;
}

struct Footprint {
  Vec3 centre;       // of the area, at height 0
  double yaw = 0.0;  // turn that brings the longer principal axis onto x
};

// The surface seen from above.
Footprint footprint(const TriangleMesh& body) {
  double area = 0.0, sx = 0.0, sz = 0.0, sxx = 0.0, sxz = 0.0, szz = 0.0;
  for (int f = 0; f < body.triangle_count(); ++f) {
    const double a = triangle_cross(body, f).norm();
    const Vec3 c = centre(body, f);
    area += a, sx += a * c.x(), sz += a * c.z();
    sxx += a * c.x() * c.x(), sxz += a * c.x() * c.z(), szz += a * c.z() * c.z();
  }
  const double xx = sxx - sx * sx / area, xz = sxz - sx * sz / area, zz = szz - sz * sz / area;
  return {Vec3(sx / area, 0.0, sz / area), 0.5 * std::atan2(2.0 * xz, xx - zz)};
}

// Mirror at x = 0 of the turned frame.
Mat3 mirror_after(double yaw) {
  const Mat3 turn = turn_about_y(yaw);
  return turn.transpose() * Vec3(-1, 1, 1).asDiagonal() * turn;
}

// Triangle centres evenly over the list of triangles, mirrored.
std::vector<Sample> mirrored_samples(const TriangleMesh& body, const Mat3& mirror) {
  const double bottom = body.vertices.col(1).minCoeff();
  const double lowest = bottom + kLowest * (body.vertices.col(1).maxCoeff() - bottom);
  std::vector<Sample> samples;
  const int step = std::max(1, body.triangle_count() / (2 * kSamples));
  for (int f = 0; f < body.triangle_count(); f += step) {
    const Vec3 c = centre(body, f);
    if (c.y() > lowest) samples.push_back({mirror * c, mirror * triangle_cross(body, f).normalized(), -1});
  }
  return samples;
}

struct Match {
  Vec3 at, normal;  // moved sample and the surface normal at its closest point
  double gap;       // along the normal
  double distance;
};

class MirrorFit {
 public:
  explicit MirrorFit(const TriangleMesh& body)
      : body_(body), tree_(body.vertices, body.triangles), normals_(vertex_normals(body.vertices, body.triangles)) {}

  // Turn and shift of the mirrored samples onto the body: about and along the ground, or any.
  void run(std::vector<Sample>& samples, bool any) {
    for (int step = 0; step < kSteps; ++step) {
      const std::vector<Match> matches = find_matches(samples);
      if (matches.size() < 10) return;
      const Motion move = solve(matches, any);
      const double angle = move.head<3>().norm();
      const Mat3 turn =
          Eigen::AngleAxisd(angle, angle > 0 ? Vec3(move.head<3>() / angle) : Vec3::UnitY()).toRotationMatrix();
      turn_ = turn * turn_;
      shift_ = turn * shift_ + move.tail<3>();
      if (std::max(angle, move.tail<3>().norm()) < kSettled) return;  // whichever way the body is turned
    }
  }

  double angle() const { return std::atan2(turn_(0, 2), turn_(0, 0)); }
  const Mat3& turn() const { return turn_; }
  const Vec3& shift() const { return shift_; }
  double residual() const { return median_; }

 private:
  std::vector<Match> find_matches(std::vector<Sample>& samples) {
    std::vector<Match> matches;
    for (Sample& s : samples) {
      const Vec3 p = turn_ * s.point + shift_;
      const SurfacePoint c = tree_.closest_point(p, std::numeric_limits<double>::infinity(), s.triangle);
      s.triangle = c.triangle;
      const Vec3 n = normal_at(c);
      if (n.dot(turn_ * s.normal) > kNormalCosine) matches.push_back({p, n, n.dot(c.point - p), c.distance()});
    }
    if (matches.empty()) return matches;
    std::vector<double> distances;
    for (const Match& m : matches) distances.push_back(m.distance);
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    median_ = *middle;
    return matches;
  }

  // Smooth at edges and corners: which of their triangles is found depends on how the body is turned.
  Vec3 normal_at(const SurfacePoint& c) const {
    if (c.feature == TriangleFeature::Face) return triangle_cross(body_, c.triangle).normalized();
    Vec3 normal = Vec3::Zero();
    for (int k = 0; k < 3; ++k) normal += c.barycentric[k] * normals_.row(body_.triangles(c.triangle, k)).transpose();
    return normal.normalized();
  }

  using Motion = Eigen::Matrix<double, 6, 1>;  // turn vector, shift

  // Least squares: n . (turn x at + shift) = gap.
  Motion solve(const std::vector<Match>& matches, bool any) const {
    const double soft = kSoftness * median_ + kSettled;
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Identity() * 1e-9;
    if (!any)
      for (const int held : {0, 2, 4}) normal(held, held) = kHeld;
    Motion right = Motion::Zero();
    for (const Match& m : matches) {
      Motion row;
      const Vec3 lever = m.at.cross(m.normal);
      row.head<3>() = lever, row.tail<3>() = m.normal;
      const double near = 1.0 / (1.0 + m.gap * m.gap / (soft * soft));
      normal += near * near * row * row.transpose();
      right += near * near * row * m.gap;
    }
    return normal.ldlt().solve(right);
  }

  const TriangleMesh& body_;
  SurfaceTree tree_;
  Points3 normals_;  // #V x 3
  Mat3 turn_ = Mat3::Identity();
  Vec3 shift_ = Vec3::Zero();
  double median_ = 0.0;
};

// The plane of a mirror image that fits: x -> image x + shift is I - 2 n n^T about the plane n . x = n . shift / 2.
std::optional<BodySymmetry> leaning_plane(const Mat3& image, const MirrorFit& fit, const Footprint& seen) {
  const Mat3 part = 0.5 * (Mat3::Identity() - 0.5 * (image + image.transpose()));
  Vec3 n = Eigen::SelfAdjointEigenSolver<Mat3>(part).eigenvectors().col(2);
  if ((turn_about_y(seen.yaw) * n).x() < 0) n = -n;
  BodySymmetry found;
  found.lean = std::asin(std::clamp(n.y(), -1.0, 1.0));
  if (std::abs(found.lean) < kLeastLean) return std::nullopt;
  found.yaw = std::atan2(n.z(), n.x());
  found.offset = n.dot(seen.centre + 0.5 * fit.shift());
  found.residual = fit.residual();
  return found;
}

}  // namespace

BodySymmetry find_symmetry(const TriangleMesh& body) {
  const Footprint seen = footprint(body);
  const TriangleMesh centred{body.vertices.rowwise() - seen.centre.transpose(), body.triangles};
  const Mat3 mirror = mirror_after(seen.yaw);
  std::vector<Sample> samples = mirrored_samples(centred, mirror);
  MirrorFit fit(centred);
  fit.run(samples, false);
  // In the frame turned by yaw - angle / 2 the mirrored body meets the body by a shift alone; half of it is the plane.
  BodySymmetry found;
  found.yaw = seen.yaw - 0.5 * fit.angle();
  found.offset = (turn_about_y(found.yaw) * (seen.centre + 0.5 * fit.shift())).x();
  found.residual = fit.residual();
  if (found.residual < kUpright) return found;
  fit.run(samples, true);
  if (fit.residual() > found.residual) return found;
  return leaning_plane(fit.turn() * mirror, fit, seen).value_or(found);
}

}  // namespace toile
