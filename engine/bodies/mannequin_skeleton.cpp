// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/mannequin_skeleton.h"

#include <algorithm>

#include "engine/bodies/mannequin_cage.h"

namespace toile {
namespace {

// Fractions and steps as in find_skeleton.
constexpr double kPelvisOverCrotch = 0.06, kHipOverCrotch = 0.05, kKnee = 0.56, kAnkle = 0.10;  // of height; of crotch
constexpr double kRingStep = 0.01, kHandEnd = 0.03, kShoulderBeyond = 0.13 / 0.22;

class Reader {
 public:
  explicit Reader(const Points3& vertices) : vertices_(vertices), cage_(mannequin_template().cage) {}

  Skeleton read() {
    s_.height = vertices_.col(1).maxCoeff();
    s_.crotch_y = at(cage_.bridge).y();
    s_.armpit_y = at(cage_.trunk.back()[4]).y();
    s_.neck_y = 0.5 * (at(cage_.neck.front()).y() + at(cage_.neck.back()).y());
    s_.waist_y = 0.5 * (s_.crotch_y + s_.armpit_y);
    s_.pelvis = on_trunk(s_.crotch_y + kPelvisOverCrotch * s_.height);
    s_.waist = on_trunk(s_.waist_y);
    s_.chest = on_trunk(s_.armpit_y);
    s_.neck = 0.5 * (at(cage_.neck.front()) + at(cage_.neck.back()));
    s_.legs[Left] = leg();
    s_.arms[Left] = arm();
    s_.legs[Right] = mirrored(s_.legs[Left]);
    s_.arms[Right] = mirrored(s_.arms[Left]);
    return std::move(s_);
  }

 private:
  Vec3 at(int point) const { return vertices_.row(point).transpose(); }

  template <std::size_t N>
  Vec3 centre(const std::array<int, N>& ring) const {
    Vec3 sum = Vec3::Zero();
    for (const int point : ring) sum += at(point);
    return sum / static_cast<double>(N);
  }

  template <std::size_t N>
  double girth(const std::array<int, N>& ring) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < N; ++i) sum += (at(ring[i]) - at(ring[(i + 1) % N])).norm();
    return sum;
  }

  // The point of a rising or falling line at height y, continued straight beyond its ends.
  static Vec3 at_height(const std::vector<Vec3>& line, double y) {
    std::size_t k = 1;
    while (k + 1 < line.size() && (line[k].y() - y) * (line[0].y() - y) > 0.0) ++k;
    const Vec3 &a = line[k - 1], &b = line[k];
    return a + (b - a) * (y - a.y()) / (b.y() - a.y());
  }

  Vec3 on_trunk(double y) const {
    std::vector<Vec3> axis;
    for (const auto& row : cage_.trunk) axis.push_back(0.5 * (at(row.front()) + at(row.back())));
    return at_height(axis, y);
  }

  Skeleton::Leg leg() const {
    std::vector<Vec3> axis;
    for (const auto& row : cage_.leg) axis.push_back(centre(row));
    Skeleton::Leg leg;
    leg.ankle = at_height(axis, kAnkle * s_.crotch_y);
    leg.knee = at_height(axis, kKnee * s_.crotch_y);
    leg.hip = at_height(axis, s_.crotch_y + kHipOverCrotch * s_.height);
    leg.toe = 0.5 * (at(cage_.toe[0]) + at(cage_.toe[1]));
    return leg;
  }

  Skeleton::Arm arm() const {
    std::vector<Vec3> line = {centre(cage_.finger[1].back())};
    for (auto row = cage_.hand.rbegin(); row != cage_.hand.rend(); ++row) line.push_back(centre(*row));
    for (auto row = cage_.arm.rbegin(); row != cage_.arm.rend(); ++row) line.push_back(centre(*row));
    line.push_back(centre(cage_.armhole()));
    Skeleton::Arm arm;
    arm.elbow = centre(cage_.arm[3]);
    arm.wrist = centre(cage_.arm.back());
    for (std::size_t i = 1; i < line.size(); ++i) arm.length += (line[i] - line[i - 1]).norm();
    arm.hand_end = along(line, kHandEnd * arm.length);
    const Vec3 low = along(line, 0.68 * arm.length), high = along(line, 0.90 * arm.length);
    arm.shoulder = high + kShoulderBeyond * (high - low);
    std::array<double, 7> girths{};
    for (std::size_t r = 0; r < girths.size(); ++r) girths[r] = girth(cage_.arm[r]);
    std::sort(girths.begin(), girths.end());
    arm.girth = girths[girths.size() / 2];
    const double step = kRingStep * s_.height;
    const int rings = static_cast<int>(arm.length / step);
    arm.centre_line.resize(rings, 3);
    for (int q = 0; q < rings; ++q) arm.centre_line.row(q) = along(line, (q + 1) * step).transpose();
    return arm;
  }

  static Vec3 along(const std::vector<Vec3>& line, double distance) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      const double length = (line[i] - line[i - 1]).norm();
      if (distance <= length) return line[i - 1] + (line[i] - line[i - 1]) * distance / length;
      distance -= length;
    }
    return line.back();
  }

  static Vec3 mirrored(const Vec3& p) { return {-p.x(), p.y(), p.z()}; }

  static Skeleton::Leg mirrored(const Skeleton::Leg& leg) {
    return {mirrored(leg.hip), mirrored(leg.knee), mirrored(leg.ankle), mirrored(leg.toe)};
  }

  static Skeleton::Arm mirrored(Skeleton::Arm arm) {
    for (Vec3* point : {&arm.shoulder, &arm.elbow, &arm.wrist, &arm.hand_end}) *point = mirrored(*point);
    arm.centre_line.col(0) *= -1.0;
    return arm;
  }

  const Points3& vertices_;
  const MannequinCage& cage_;
  Skeleton s_;
};

}  // namespace

Skeleton mannequin_skeleton(const Points3& vertices) {
  return Reader(vertices).read();
}

}  // namespace toile
