// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/mannequin_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/bodies/mannequin_limbs.h"
#include "engine/bodies/mannequin_rows.h"
#include "engine/bodies/mannequin_tables.h"
#include "engine/core/units.h"

namespace toile {
namespace {

constexpr int kAround = MannequinCage::kAround;
using Azimuths = std::array<double, kAround>;
constexpr Azimuths kTrunkAzimuth = {0, 27, 50, 71, 90, 109, 130, 153, 180};
constexpr Azimuths kShoulderAzimuth = {0, 22, 42, 60, 90, 120, 138, 158, 180};
constexpr Azimuths kHeadAzimuth = {0, 15, 36, 62, 90, 116, 138, 158, 180};

class CagePoints {
 public:
  CagePoints(const MannequinShape& shape, const MannequinCage& cage)
      : shape_(shape), cage_(cage), levels_(mannequin_levels(shape)), points_(cage.half_count, 3) {}

  Points3 build() {
    trunk();
    shoulders();
    neck();
    head();
    place_leg(shape_, cage_, points_);
    place_arm(shape_, cage_, points_);
    for (const int point : cage_.midline) points_(point, 0) = 0.0;
    return points_ * shape_.height;
  }

 private:
  void put(int point, const Vec3& position) { points_.row(point) = position.transpose(); }
  Vec3 at(int point) const { return points_.row(point).transpose(); }

  void trunk() {
    for (std::size_t r = 0; r < cage_.trunk.size(); ++r) {
      const double t = kTrunkRows[r], factor = trunk_factor(shape_, t);
      const Vec3 axis(0.0, levels_.on_trunk(t), trunk_axis_z(shape_, r));
      const double breadth = r + 1 == cage_.trunk.size() ? std::sqrt(shape_.shoulder_width) : 1.0;
      for (std::size_t i = 0; i < kAround; ++i) {
        const double radius = fan_radius(mannequin_tables::kTrunk, r, i, shape_) * factor;
        put(cage_.trunk[r][i], axis + radius * ray(kTrunkAzimuth[i], 0.0).cwiseProduct(Vec3(breadth, 1.0, 1.0)));
      }
    }
    const auto& low = cage_.trunk.front();
    put(cage_.bridge, Vec3(0.0, levels_.crotch, (2.0 * at(low[0]).z() + 3.0 * at(low[8]).z()) / 5.0));
  }

  void shoulders() {
    constexpr std::array<double, 4> kElevation = {0.0, 12.0, 25.0, 45.0};
    const Vec3 axis(0.0, levels_.armpit + 0.022, shoulder_axis_z(shape_));
    for (std::size_t r = 0; r < kElevation.size(); ++r) {
      const double factor = shoulder_factor(shape_, (static_cast<double>(r) + 1.0) / 5.0);
      for (std::size_t i = 0; i < kAround; ++i) {
        if (cage_.shoulder[r][i] < 0) continue;
        const double radius = fan_radius(mannequin_tables::kShoulder, r, i, shape_) * factor;
        const Vec3 breadth(shape_.shoulder_width, 1.0, 1.0);
        put(cage_.shoulder[r][i], axis + radius * ray(kShoulderAzimuth[i], kElevation[r]).cwiseProduct(breadth));
      }
    }
  }

  void neck() {
    constexpr std::array<double, kAround> kRadius = {37, 35, 31, 30, 33, 38, 40, 38, 37};  // thousandths
    const double factor = shape_.factor(Girth::Neck) * (1.0 + 0.1 * shape_.fatness) * 1e-3;
    // A thick neck grows to the back and the sides: in front the throat stays under the chin.
    const double back_shift = 0.015 * std::max(0.0, factor * 1e3 - 1.0);
    const double middle_z = neck_axis_z(shape_) - back_shift, base_z = 0.5 * neck_axis_z(shape_) - 0.008 - back_shift;
    constexpr double kUnderNeck = 0.006;
    for (std::size_t i = 0; i < kAround; ++i) {
      const Vec3 out = ray(kHeadAzimuth[i], 0.0);
      const double back = 0.5 * (1.0 - out.z());
      const Vec3 middle(0.0, levels_.neck + 0.014 * (back - 0.5), middle_z);
      const Vec3 base(0.0, levels_.neck - 0.030 + 0.022 * back, base_z);
      put(cage_.neck[i], middle + factor * kRadius[i] * out);
      put(cage_.shoulder[4][i], base + factor * kRadius[i] * (0.92 + 0.10 * back + 0.20 * std::abs(out.x())) * out);
      // A stout chest rises towards the neck, not over its base.
      double& chest_y = points_(cage_.shoulder[3][i], 1);
      chest_y = std::min(chest_y, base.y() - kUnderNeck);
    }
  }

  void head() {
    constexpr std::array<double, 9> kFront = {-64, -48, -34, -20, -6, 8, 24, 42, 60};
    constexpr std::array<double, 9> kBack = {-38, -28, -18, -8, 2, 14, 28, 44, 60};
    const Vec3 centre(0.0, levels_.head, head_axis_z(shape_));
    const auto& table = mannequin_tables::kHead;
    for (std::size_t r = 0; r < cage_.head.size(); ++r) {
      for (std::size_t i = 0; i < kAround; ++i) {
        const double front = 0.5 * (1.0 + std::cos(kHeadAzimuth[i] * kRadianPerDegree));
        const double elevation = front * kFront[r] + (1.0 - front) * kBack[r];
        const double radius = 1e-3 * head_scale(shape_, elevation) * table[r][i];
        put(cage_.head[r][i], centre + radius * ray(kHeadAzimuth[i], elevation));
      }
    }
    fill_under_jaw();
    const auto& crown = table.back();
    const double size = 1e-3 * head_scale(shape_, 90.0);
    for (std::size_t k = 0; k < 3; ++k) {
      const double azimuth = 90.0 * static_cast<double>(k);
      put(cage_.crown[k][0], centre + size * crown[4 * k] * (k == 1 ? ray(0.0, 90.0) : ray(azimuth, 76.0)));
      put(cage_.crown[k][1], centre + size * crown[4 * k] * ray(45.0 + 0.5 * azimuth, k == 1 ? 76.0 : 71.0));
    }
  }

  // Above a thick neck the jaw's underside is no narrower than the neck: a double chin, not a fold.
  void fill_under_jaw() {
    constexpr double kShare = 0.99;
    const Vec3 middle = 0.5 * (at(cage_.neck.front()) + at(cage_.neck.back()));
    for (std::size_t i = 0; i < kAround; ++i) {
      for (const auto& [row, share] : {std::pair(0, kShare), std::pair(1, 0.95 * kShare)}) {
        Vec3 jaw = at(cage_.head[static_cast<std::size_t>(row)][i]);
        const Vec2 neck_out(at(cage_.neck[i]).x(), at(cage_.neck[i]).z() - middle.z());
        const Vec2 jaw_out(jaw.x(), jaw.z() - middle.z());
        if (jaw_out.norm() >= share * neck_out.norm()) continue;
        jaw.x() = share * neck_out.x();
        jaw.z() = middle.z() + share * neck_out.y();
        put(cage_.head[static_cast<std::size_t>(row)][i], jaw);
      }
    }
  }

  const MannequinShape& shape_;
  const MannequinCage& cage_;
  const MannequinLevels levels_;
  Points3 points_;  // in body heights
};

// What interpolation leaves ragged: the halves are exact images that keep off the midline, and the soles are flat.
// Vertex v and its image are told apart by the side on which their cage points lie.
void flatten(Points3& vertices, const std::vector<int>& mirror_of, const std::vector<bool>& left) {
  constexpr double kLeastGap = 5e-4;  // m, from the midline: inner thighs come no nearer than twice this
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const auto index = static_cast<std::size_t>(v);
    const int other = mirror_of[index];
    vertices(v, 1) = std::max(vertices(v, 1), 0.0);
    if (other == v) {
      vertices(v, 0) = 0.0;
    } else if (left[index]) {
      vertices(v, 0) = std::max(vertices(v, 0), kLeastGap);
      vertices.row(other) << -vertices(v, 0), vertices(v, 1), vertices(v, 2);
    }
  }
}

}  // namespace

Points3 mannequin_cage_points(const MannequinShape& shape, const MannequinCage& cage) {
  return CagePoints(shape, cage).build();
}

Points3 mannequin_surface(const MannequinShape& shape) {
  const MannequinTemplate& shared = mannequin_template();
  const Points3 half = mannequin_cage_points(shape, shared.cage);
  Points3 whole(shared.cage.point_count(), 3);
  for (int p = 0; p < shared.cage.half_count; ++p) {
    whole.row(shared.cage.mirror_of[static_cast<std::size_t>(p)]) << -half(p, 0), half(p, 1), half(p, 2);
    whole.row(p) = half.row(p);
  }
  constexpr int kSweeps = 8;  // leaves under 1 mm between the table's points and the surface, without ripples
  Points3 vertices = shared.surface * interpolating_control_points(shared.limit, whole, kSweeps);
  flatten(vertices, shared.mirror_of, shared.left);
  return vertices;
}

}  // namespace toile
