// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/drape_guards.h"

#include <algorithm>
#include <cmath>

#include "engine/core/units.h"

namespace toile {
namespace {

constexpr double kNodesInside = 0.01;   // share of the nodes that may lie deeper than 1 mm
constexpr double kShoulderDrop = 0.03;  // m the shoulder seams may lie below the shoulders
constexpr double kShoulderBand = 0.09;  // m below the highest torso seam point that counts as shoulder
constexpr double kWaistDrop = 0.015;    // m the waist may hang below its hold
constexpr double kStrain = 0.35;        // p99 of weft or warp strain
constexpr double kCrossing = 0.01;      // share of triangles
constexpr double kTipShare = 0.85;      // of a limb's middle line that must not be pierced: hands and feet stick out

std::string in_mm(double metres) {
  return std::to_string(static_cast<int>(std::lround(metres * kMmPerMetre))) + " mm";
}
std::string in_percent(double share) {
  return std::to_string(static_cast<int>(std::lround(100 * share))) + " %";
}

bool segment_hits(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  const double dp = n.dot(p - a), dq = n.dot(q - a);
  if (!(dp * dq < 0)) return false;
  const Vec3 at = p + dp / (dp - dq) * (q - p);
  return n.dot((b - a).cross(at - a)) >= 0 && n.dot((c - b).cross(at - b)) >= 0 && n.dot((a - c).cross(at - c)) >= 0;
}

class Guards {
 public:
  Guards(const GuardScene& scene, const Drape& drape, const DrapeQuality& quality)
      : scene_(scene), x_(drape.nodes), quality_(quality) {}

  std::vector<DrapeFinding> run() {
    if (!x_.allFinite()) {
      refuse("not_finite", "some node positions are not finite");
      return findings_;
    }
    check_inside();
    if (scene_.garment && scene_.guides) {
      check_place();
      check_limbs();
      if (scene_.garment->bodice) check_shoulders();
    }
    check_waist();
    check_strain();
    if (quality_.crossing_share > kCrossing)
      warn("crosses_itself", in_percent(quality_.crossing_share) + " of the triangles cross another one");
    if (quality_.rest == Rest::NotAtRest)
      warn("not_at_rest", scene_.tangled ? "the cloth still moves: its layers are tangled and do not come free"
                                         : "the cloth still moves: more iterations are needed");
    return findings_;
  }

 private:
  void refuse(const char* name, std::string message) { findings_.push_back({name, std::move(message), true}); }
  void warn(const char* name, std::string message) { findings_.push_back({name, std::move(message), false}); }

  void check_inside() {
    if (quality_.nodes_inside == 0) return;
    const std::string message = std::to_string(quality_.nodes_inside) +
                                " nodes lie deeper than 1 mm in the body, the deepest " + in_mm(quality_.deepest_node);
    const bool many = quality_.nodes_inside > kNodesInside * static_cast<double>(x_.rows());
    many ? refuse("inside_body", message) : warn("inside_body", message);
  }

  void check_place() {
    const auto& panels = scene_.garment->panels;
    const bool sleeves =
        std::any_of(panels.begin(), panels.end(), [](const auto& p) { return p.kind == PanelKind::Arm; });
    if (sleeves && !scene_.garment->bodice)
      refuse("misplaced", "the garment has sleeves, but none of its panels is placed at the chest of this body");
  }

  // Limbs a sleeve or trouser leg was made for must run inside it.
  void check_limbs() {
    for (const Side side : {Left, Right}) {
      if (scene_.garment->bodice && pierced(scene_.guides->arm[side]))
        refuse("limb_pierces", std::string("the ") + (side == Left ? "left" : "right") + " arm pierces the garment");
      if (pierced(scene_.guides->leg[side]))
        refuse("limb_pierces", std::string("the ") + (side == Left ? "left" : "right") + " leg pierces the garment");
    }
  }

  bool pierced(const std::vector<Vec3>& line) const {
    const auto count = static_cast<std::size_t>(kTipShare * static_cast<double>(line.size()));
    for (std::size_t k = 0; k + 1 < count; ++k) {
      const Vec3 low = line[k].cwiseMin(line[k + 1]), high = line[k].cwiseMax(line[k + 1]);
      for (int f = 0; f < scene_.mesh.triangle_count(); ++f) {
        const Eigen::Vector3i n = scene_.mesh.nodes_of_triangle(f);
        const Vec3 a = x_.row(n[0]), b = x_.row(n[1]), c = x_.row(n[2]);
        if ((a.cwiseMin(b).cwiseMin(c).array() > high.array()).any() ||
            (a.cwiseMax(b).cwiseMax(c).array() < low.array()).any())
          continue;
        if (segment_hits(line[k], line[k + 1], a, b, c)) return true;
      }
    }
    return false;
  }

  // Mean height of the highest seams between torso panels.
  void check_shoulders() {
    std::vector<double> heights;
    const auto torso = [&](int v) {
      return scene_.garment->panels[static_cast<std::size_t>(scene_.mesh.panel_of_vertex[static_cast<std::size_t>(v)])]
          .torso;
    };
    for (const auto& seam : scene_.mesh.seam_vertices)
      for (const auto& [a, b] : seam)
        if (torso(a) && torso(b)) heights.push_back(x_(scene_.mesh.node_of_vertex[static_cast<std::size_t>(a)], 1));
    if (heights.empty()) return;
    const double top = *std::max_element(heights.begin(), heights.end());
    double sum = 0;
    int count = 0;
    for (double y : heights)
      if (y > top - kShoulderBand) sum += y, ++count;
    const double drop = scene_.guides->levels.shoulder_y - sum / count;
    if (drop > kShoulderDrop)
      refuse("shoulder_slipped", "the shoulder seams hang " + in_mm(drop) + " below the shoulders");
  }

  void check_waist() {
    if (scene_.waist.empty() || scene_.hold_height <= 0) return;
    double height = 0;
    for (int n : scene_.waist) height += x_(n, 1) / static_cast<double>(scene_.waist.size());
    const double drop = scene_.hold_height - height;
    if (drop > kWaistDrop) refuse("waist_slipped", "the waist hangs " + in_mm(drop) + " below where it is held");
  }

  void check_strain() {
    const double most = std::max(quality_.weft.p99, quality_.warp.p99);
    if (most > kStrain)
      warn("overstretched",
           "99 % of the cloth is stretched up to " + in_percent(most) + ": the garment is far too small");
  }

  const GuardScene& scene_;
  const Points3& x_;
  const DrapeQuality& quality_;
  std::vector<DrapeFinding> findings_;
};

}  // namespace

std::vector<DrapeFinding> check_drape(const GuardScene& scene, const Drape& drape, const DrapeQuality& quality) {
  return Guards(scene, drape, quality).run();
}

}  // namespace toile
