// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/registration/posed_body.h"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <random>

#include <Eigen/Geometry>

#include "engine/bodies/body_bones.h"
#include "engine/bodies/find_skeleton.h"
#include "engine/bodies/import_body.h"
#include "engine/core/units.h"
#include "engine/geometry/components.h"
#include "engine/geometry/surface_operators.h"
#include "tests/support/shared_body.h"
#include "tests/support/sidecar.h"

namespace toile::test {
namespace {

using Move = Eigen::Isometry3d;

Move turn(const Vec3& about, const Vec3& axis, double degrees) {
  Move move = Move::Identity();
  move.translate(about).rotate(Eigen::AngleAxisd(degrees * kRadianPerDegree, axis)).translate(-about);
  return move;
}

std::array<Move, kBoneCount> bone_moves(const Skeleton& skeleton, const BodyPose& pose) {
  std::array<Move, kBoneCount> moves;
  moves.fill(Move::Identity());
  for (const Side side : {Left, Right}) {
    const double outward = side == Left ? 1.0 : -1.0;
    const auto move_of = [&](Bone bone) -> Move& { return moves[static_cast<std::size_t>(bone_of(bone, side))]; };
    const Skeleton::Arm& arm = skeleton.arms[side];
    const Vec3 bend = (arm.wrist - arm.elbow).cross(Vec3::UnitZ()).normalized();
    move_of(UpperArm) = turn(arm.shoulder, Vec3::UnitZ(), outward * pose.arms);
    move_of(Forearm) = move_of(UpperArm) * turn(arm.elbow, bend, pose.forearms);
    move_of(Hand) = move_of(Forearm);
    const Skeleton::Leg& leg = skeleton.legs[side];
    move_of(Thigh) = turn(leg.hip, Vec3::UnitZ(), outward * pose.feet_apart) * turn(leg.hip, Vec3::UnitX(), -pose.hips);
    move_of(Shin) = move_of(Thigh) * turn(leg.knee, Vec3::UnitX(), pose.knees);
    move_of(Foot) = move_of(Shin);
  }
  return moves;
}

// Numbers that are the same on every machine.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_()) / 4294967296.0);
  }
  int below(int count) { return static_cast<int>(between(0.0, count)); }
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += between(0.0, 1.0);
    return sum;
  }
  std::mt19937& engine() { return random_; }

 private:
  std::mt19937 random_;
};

struct Ball {
  Vec3 centre;
  double radius;
};

std::vector<Ball> draw_holes(const TriangleMesh& mesh, const Skeleton& s, const Landmarks& marks, Draw& draw) {
  const double h = s.height;
  std::vector<Ball> holes = {{marks.at("head_top"), draw.between(0.015, 0.03) * h},
                             {marks.at("crotch"), draw.between(0.015, 0.025) * h}};
  for (const Side side : {Left, Right}) {
    const Skeleton::Arm& arm = s.arms[side];
    holes.push_back({{0.8 * arm.shoulder.x(), s.armpit_y, arm.shoulder.z()}, draw.between(0.015, 0.022) * h});
  }
  for (int i = 0; i < 3; ++i)
    holes.push_back({mesh.vertices.row(draw.below(mesh.vertex_count())), draw.between(0.004, 0.008) * h});
  return holes;
}

TriangleMesh with_holes(const TriangleMesh& mesh, const std::vector<Ball>& holes, double sole) {
  std::vector<bool> keep(static_cast<std::size_t>(mesh.triangle_count()), true);
  for (int f = 0; f < mesh.triangle_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = mesh.vertices.row(mesh.triangles(f, k));
      bool gone = p.y() < sole;
      for (const Ball& ball : holes) gone |= (p - ball.centre).norm() < ball.radius;
      if (gone) keep[static_cast<std::size_t>(f)] = false;
    }
  return extract_triangles(mesh, keep);
}

void add_noise(TriangleMesh& mesh, double sigma, Draw& draw) {
  const Points3 normals = vertex_normals(mesh.vertices, mesh.triangles);
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    mesh.vertices.row(v) += sigma * draw.normal() * normals.row(v);
    for (int c = 0; c < 3; ++c) mesh.vertices(v, c) += sigma / 3.0 * draw.normal();
  }
}

void shuffle(TriangleMesh& mesh, Draw& draw) {
  std::vector<int> to_of_from(static_cast<std::size_t>(mesh.vertex_count()));
  std::iota(to_of_from.begin(), to_of_from.end(), 0);
  std::shuffle(to_of_from.begin(), to_of_from.end(), draw.engine());
  const Points3 old = mesh.vertices;
  for (Eigen::Index v = 0; v < old.rows(); ++v) mesh.vertices.row(to_of_from[static_cast<std::size_t>(v)]) = old.row(v);
  for (int f = 0; f < mesh.triangle_count(); ++f)
    for (int k = 0; k < 3; ++k) mesh.triangles(f, k) = to_of_from[static_cast<std::size_t>(mesh.triangles(f, k))];
}

// From the leant body to a file of some unit, up axis and turn.
Mat4 draw_frame(Draw& draw) {
  constexpr LengthUnit units[] = {LengthUnit::Metre, LengthUnit::Centimetre, LengthUnit::Millimetre, LengthUnit::Inch};
  constexpr UpAxis axes[] = {UpAxis::PlusX,  UpAxis::MinusX, UpAxis::PlusY,
                             UpAxis::MinusY, UpAxis::PlusZ,  UpAxis::MinusZ};
  const Mat3 yaw = Eigen::AngleAxisd(draw.between(-3.1, 3.1), Vec3::UnitY()).toRotationMatrix();
  Mat4 frame = Mat4::Identity();
  frame.topLeftCorner<3, 3>() = turn_upright(axes[draw.below(6)]).transpose() * yaw / metres_per(units[draw.below(4)]);
  return frame;
}

}  // namespace

Points3 posed(const TriangleMesh& body, const BodyPose& pose) {
  const Skeleton skeleton = find_skeleton(body).skeleton;
  const Eigen::MatrixXd weights = bone_weights(body, skeleton);
  const auto moves = bone_moves(skeleton, pose);
  Points3 out = Points3::Zero(body.vertex_count(), 3);
  for (Eigen::Index v = 0; v < out.rows(); ++v)
    for (int b = 0; b < kBoneCount; ++b)
      out.row(v) += weights(v, b) * (moves[static_cast<std::size_t>(b)] * Vec3(body.vertices.row(v))).transpose();
  return out;
}

RegistrationCase variant_case(const std::string& body, unsigned seed) {
  Draw draw(seed);
  RegistrationCase out;
  out.truth = load_shared_body(body).surface;
  const BodySidecar sidecar = load_body_sidecar(body);
  const BodyPose pose{.arms = draw.between(-18, 30), .forearms = draw.between(0, 20), .feet_apart = draw.between(0, 5)};
  out.truth.vertices = posed(out.truth, pose);
  for (const auto& [name, vertex] : sidecar.landmark_vertex) out.landmarks[name] = out.truth.vertices.row(vertex);

  const Skeleton skeleton = find_skeleton(out.truth).skeleton;
  const double sole = out.truth.vertices.col(1).minCoeff() + 0.003 * skeleton.height;
  TriangleMesh file = out.truth;
  add_noise(file, draw.between(0.001, 0.002), draw);
  file = with_holes(file, draw_holes(out.truth, skeleton, out.landmarks, draw), sole);
  shuffle(file, draw);
  const double lean = draw.between(0.0, 2.0 * std::numbers::pi);
  Mat4 to_file = Mat4::Identity();
  to_file.topLeftCorner<3, 3>() =
      Eigen::AngleAxisd(5.0 * kRadianPerDegree, Vec3(std::cos(lean), 0.0, std::sin(lean))).toRotationMatrix();
  to_file = draw_frame(draw) * to_file;
  file.vertices = moved(file.vertices, to_file);
  const ImportBodyResult imported = import_body(std::move(file), body);
  out.target = without_patches(imported.body, imported.repairs.added_triangles());
  const Mat4 frame = out.target.normalised_from_file * to_file;
  out.truth.vertices = moved(out.truth.vertices, frame);
  for (auto& [name, p] : out.landmarks) p = (frame * p.homogeneous()).head<3>();
  return out;
}

}  // namespace toile::test
