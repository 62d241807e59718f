// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/coarse_fit.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "engine/bodies/body_bones.h"
#include "engine/bodies/body_slices.h"
#include "engine/bodies/trunk_sides.h"
#include "engine/geometry/convex_hull.h"

namespace toile {
namespace {

// Share of the full skinning. Within one family less is better, across sexes more; joints of head and arms are sure,
// finger tips are not: scans cut them off.
constexpr double kFullTrunk = 0.7, kFullLimb = 0.7, kFullHead = 1.0, kFullArm = 1.0;
constexpr double kByProfile = 0.5;  // share of the trunk's profile in its full skinning
constexpr int kProfileSmoothing = 20;
constexpr double kTrunkAtAll = 1e-3;  // least share of the trunk's bones in a vertex that slides with it

double full_share(std::size_t bone) {
  if (bone < Head) return kFullTrunk;
  if (bone == Head) return kFullHead;
  return bone < Hand ? kFullArm : kFullLimb;
}

// v -> linear (v - from) + to
struct BoneMove {
  Mat3 linear = Mat3::Identity();
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();

  Vec3 operator()(const Vec3& v) const { return linear * (v - from) + to; }
};
using Moves = std::array<BoneMove, kBoneCount>;

Mat3 least_rotation(const Vec3& from, const Vec3& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

struct Segment {
  Vec3 start, end;
  double length() const { return (end - start).norm(); }
};

// Takes one segment onto the other, stretched along it to fit and by `radial` across it.
BoneMove segment_move(const Segment& a, const Segment& b, double radial) {
  const Vec3 u = (a.end - a.start).normalized();
  const Mat3 along = u * u.transpose();
  const Mat3 stretch = radial * (Mat3::Identity() - along) + b.length() / a.length() * along;
  return {least_rotation(a.end - a.start, b.end - b.start) * stretch, a.start, b.start};
}

// Upright stretch by width and depth that takes one axis of the trunk onto the other by a shear.
BoneMove trunk_move(const Segment& a, const Segment& b, double width, double depth) {
  const Vec3 d = a.end - a.start, e = b.end - b.start;
  Mat3 linear = Mat3::Zero();
  linear(0, 0) = width, linear(2, 2) = depth;
  linear.col(1) = (e - Vec3(width * d.x(), 0.0, depth * d.z())) / d.y();
  return {linear, a.start, b.start};
}

BoneMove scaling(double factor, const Vec3& from, const Vec3& to) {
  return {Mat3::Identity() * factor, from, to};
}

Moves full_moves(const BodyProportions& reference, const BodyProportions& target) {
  const Skeleton &r = reference.skeleton, &t = target.skeleton;
  Moves moves;
  const std::array<Segment, 3> trunk_r = {{{r.pelvis, r.waist}, {r.waist, r.chest}, {r.chest, r.neck}}};
  const std::array<Segment, 3> trunk_t = {{{t.pelvis, t.waist}, {t.waist, t.chest}, {t.chest, t.neck}}};
  for (std::size_t i = 0; i < 3; ++i)
    moves[i] = trunk_move(trunk_r[i], trunk_t[i], target.trunk_width[i] / reference.trunk_width[i],
                          target.trunk_depth[i] / reference.trunk_depth[i]);
  moves[Head] = scaling((t.height - t.neck_y) / (r.height - r.neck_y), r.neck, t.neck);
  const double leg =
      0.5 * (t.height + t.crotch_y) / (r.height + r.crotch_y) + 0.5 * target.leg_girth / reference.leg_girth;
  for (const Side side : {Left, Right}) {
    const Skeleton::Arm &ra = r.arms[side], &ta = t.arms[side];
    const double arm = ta.girth / ra.girth;
    const auto set = [&](Bone bone, const Segment& a, const Segment& b, double radial) {
      moves[static_cast<std::size_t>(bone_of(bone, side))] = segment_move(a, b, radial);
    };
    set(UpperArm, {ra.shoulder, ra.elbow}, {ta.shoulder, ta.elbow}, arm);
    set(Forearm, {ra.elbow, ra.wrist}, {ta.elbow, ta.wrist}, arm);
    set(Hand, {ra.wrist, ra.hand_end}, {ta.wrist, ta.hand_end},
        (ta.hand_end - ta.wrist).norm() / (ra.hand_end - ra.wrist).norm());
    const Skeleton::Leg &rl = r.legs[side], &tl = t.legs[side];
    set(Thigh, {rl.hip, rl.knee}, {tl.hip, tl.knee}, leg);
    set(Shin, {rl.knee, rl.ankle}, {tl.knee, tl.ankle}, leg);
    set(Foot, {rl.ankle, rl.toe}, {tl.ankle, tl.toe}, (tl.toe - tl.ankle).norm() / (rl.toe - rl.ankle).norm());
  }
  return moves;
}

Moves soft_moves(const BodyProportions& reference, const BodyProportions& target) {
  const Skeleton &r = reference.skeleton, &t = target.skeleton;
  const double scale = t.height / r.height;
  const BoneMove whole = scaling(scale, 0.5 * (r.pelvis + r.chest), 0.5 * (t.pelvis + t.chest));
  Moves moves;
  for (const Bone bone : {Pelvis, Abdomen, Chest, Head}) moves[static_cast<std::size_t>(bone)] = whole;
  for (const Side side : {Left, Right}) {
    const Skeleton::Arm &ra = r.arms[side], &ta = t.arms[side];
    const auto set = [&](Bone bone, const Segment& a, const Segment& b) {
      moves[static_cast<std::size_t>(bone_of(bone, side))] = segment_move(a, b, scale);
    };
    const Vec3 shoulder = 0.5 * (whole(ra.shoulder) + ta.shoulder);
    set(UpperArm, {ra.shoulder, ra.elbow}, {shoulder, ta.elbow});
    set(Forearm, {ra.elbow, ra.wrist}, {ta.elbow, ta.wrist});
    set(Hand, {ra.wrist, ra.hand_end}, {ta.wrist, ta.hand_end});
    const Skeleton::Leg& rl = r.legs[side];
    for (const Bone bone : {Thigh, Shin, Foot}) set(bone, {rl.hip, rl.ankle}, {whole(rl.hip), t.legs[side].ankle});
  }
  return moves;
}

// The trunk level by level: each box of the reference onto the target's. Three bones pinch it between the waist, where
// they have its width, and the chest.
class TrunkProfile {
 public:
  TrunkProfile(const BodyProportions& reference, const BodyProportions& target, const Moves& full)
      : reference_(reference), target_(target), full_(full) {}

  Vec3 operator()(const Vec3& v) const {
    const Skeleton &r = reference_.skeleton, &t = target_.skeleton;
    const double up = (v.y() - r.pelvis.y()) / (r.chest.y() - r.pelvis.y());
    if (up <= 0.0) return full_[Pelvis](v);
    if (up >= 1.0) return full_[Chest](v);
    const Vec2 low = at(reference_.trunk_low, up), high = at(reference_.trunk_high, up);
    const Vec2 to_low = at(target_.trunk_low, up), to_high = at(target_.trunk_high, up);
    const Vec2 p = to_low + (to_high - to_low).cwiseQuotient(high - low).cwiseProduct(Vec2(v.x(), v.z()) - low);
    return {p.x(), t.pelvis.y() + up * (t.chest.y() - t.pelvis.y()), p.y()};
  }

 private:
  template <std::size_t n>
  static Vec2 at(const std::array<Vec2, n>& levels, double up) {
    const double s = up * static_cast<double>(n - 1);
    const std::size_t i = std::min(n - 2, static_cast<std::size_t>(s));
    const double t = s - static_cast<double>(i);
    return (1.0 - t) * levels[i] + t * levels[i + 1];
  }

  const BodyProportions &reference_, &target_;
  const Moves& full_;
};

// Folds, bellies and holes are left to the refinement: only how the trunk widens on the whole is taken. Ends stay.
template <std::size_t n>
void smooth_levels(std::array<Vec2, n>& levels) {
  for (int k = 0; k < kProfileSmoothing; ++k) {
    const std::array<Vec2, n> old = levels;
    for (std::size_t i = 1; i + 1 < n; ++i) levels[i] = 0.25 * old[i - 1] + 0.5 * old[i] + 0.25 * old[i + 1];
  }
}

void find_trunk_boxes(const BodySlices& slices, const Skeleton& skeleton, BodyProportions& found) {
  const double most = 0.075 * skeleton.height;  // half of the size taken where there is no slice
  const std::size_t n = found.trunk_low.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 c =
        skeleton.pelvis + static_cast<double>(i) / static_cast<double>(n - 1) * (skeleton.chest - skeleton.pelvis);
    const auto piece = slices.middle(c.y());
    found.trunk_low[i] = piece ? piece->low : Vec2(c.x() - most, c.z() - most);
    found.trunk_high[i] = piece ? piece->high : Vec2(c.x() + most, c.z() + most);
  }
  smooth_levels(found.trunk_low), smooth_levels(found.trunk_high);
}

// Slides the skin of legs and pelvis along them to the levels the target has it at; bones alone stretch each segment
// evenly.
class LegSlide {
 public:
  LegSlide(const BodyProportions& reference, const BodyProportions& target)
      : skeleton_(reference.skeleton), levels_(reference.legs, target.legs) {}

  Vec3 operator()(int bone, const Vec3& v) const {
    if (bone >= Head && bone < bone_of(Thigh, Left)) return v;
    const double level = v.y() / skeleton_.crotch_y;
    const Vec3 up = axis(bone);
    return v + (levels_(level) - level) * skeleton_.crotch_y / up.y() * up;
  }

 private:
  Vec3 axis(int bone) const {
    if (bone < Head) return Vec3::UnitY();
    const Skeleton::Leg& leg = skeleton_.legs[static_cast<std::size_t>(bone % 2)];
    return bone < bone_of(Shin, Left) ? leg.hip - leg.knee : leg.knee - leg.ankle;
  }

  const Skeleton& skeleton_;
  LegLevels levels_;
};

// Between both skinnings: moves are affine, so are their means.
Moves mean_moves(const Moves& a, const Moves& b) {
  Moves mean;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    const double full = full_share(i);
    mean[i].linear = full * a[i].linear + (1.0 - full) * b[i].linear;
    mean[i].from = a[i].from;
    mean[i].to = full * a[i].to + (1.0 - full) * b[i](a[i].from);
  }
  return mean;
}

}  // namespace

BodyProportions find_proportions(const TriangleMesh& body, const Skeleton& skeleton) {
  const BodySlices slices(body);
  BodyProportions found;
  found.skeleton = skeleton;
  const double levels[] = {skeleton.pelvis.y(), skeleton.waist.y(), skeleton.chest.y()};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto piece = slices.middle(levels[i]);
    const Vec2 size = piece ? Vec2(piece->high - piece->low) : Vec2::Constant(0.15 * skeleton.height);
    found.trunk_width[i] = size.x(), found.trunk_depth[i] = size.y();
  }
  find_trunk_boxes(slices, skeleton, found);
  for (const Side side : {Left, Right})
    found.leg_girth += 0.5 * hull_perimeter(slices.leg(0.8 * skeleton.crotch_y, side));
  found.legs = find_leg_profile(body, skeleton);
  return found;
}

Points3 coarse_fit(const Points3& reference_vertices, const Eigen::MatrixXd& weights, const BodyProportions& reference,
                   const BodyProportions& target) {
  const Moves full = full_moves(reference, target);
  const Moves moves = mean_moves(full, soft_moves(reference, target));
  const TrunkProfile profile(reference, target, full);
  const LegSlide slide(reference, target);
  const TrunkSides sides(reference, target);
  Points3 fitted(reference_vertices.rows(), 3);
  for (Eigen::Index v = 0; v < fitted.rows(); ++v) {
    const Vec3 p = reference_vertices.row(v);
    Vec3 x = Vec3::Zero(), side = Vec3::Zero();
    double trunk = 0.0;  // share of its bones
    for (int b = 0; b < kBoneCount; ++b)
      if (const double w = weights(v, b); w > 0) {
        const auto bone = static_cast<std::size_t>(b);
        const Vec3 q = slide(b, p);
        x += w * moves[bone](q);
        if (b >= Head) continue;
        x += w * kFullTrunk * kByProfile * (profile(q) - full[bone](q));
        const Vec3 beside = sides.beside(q);
        side += w * (moves[bone](beside) + kFullTrunk * kByProfile * (profile(beside) - full[bone](beside)));
        trunk += w;
      }
    if (trunk > kTrunkAtAll) x += trunk * sides.slide(p, side / trunk);
    fitted.row(v) = x;
  }
  return fitted;
}

}  // namespace toile
