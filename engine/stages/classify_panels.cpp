// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/classify_panels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace toile {
namespace {

constexpr double kSideTolerance = 0.03;   // m a one-sided panel may reach over the middle
constexpr double kWaistTolerance = 0.03;  // m a lower panel may reach above the waist
constexpr double kLegDrop = 0.20;         // m below the crotch that a one-sided long panel must reach to be a leg
constexpr double kTorsoTop = 0.03;        // m below the armpits that a torso panel's top may end

struct Extent {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low, centre = Vec3::Zero();
};

double distance_xy(const Vec3& p, const std::vector<Vec3>& line) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const Vec2 a = line[k].head<2>(), ab = line[k + 1].head<2>() - a;
    const double t = ab.squaredNorm() > 0 ? std::clamp(ab.dot(p.head<2>() - a) / ab.squaredNorm(), 0.0, 1.0) : 0.0;
    least = std::min(least, (p.head<2>() - a - t * ab).norm());
  }
  return least;
}

class Classifier {
 public:
  Classifier(const Pattern& pattern, const PatternMesh& mesh, const Points3& placed, const BodyGuides& guides)
      : pattern_(pattern), mesh_(mesh), placed_(placed), guides_(guides), levels_(guides.levels) {}

  GarmentClass run() {
    const std::size_t count = pattern_.panels.size();
    GarmentClass result;
    result.panels.resize(count);
    candidate_.assign(count, false);
    for (std::size_t p = 0; p < count; ++p) result.panels[p] = first_guess(p);
    for (const Side side : {Left, Right}) confirm_legs(result, side);
    for (const PanelClass& panel : result.panels) result.bodice = result.bodice || panel.torso;
    return result;
  }

 private:
  Extent extent_of(std::size_t p) const {
    Extent e;
    const PanelRange& range = mesh_.panels[p];
    for (int v = range.vertex_begin; v < range.vertex_end; ++v) {
      const Vec3 at = placed_.row(v);
      e.low = e.low.cwiseMin(at), e.high = e.high.cwiseMax(at);
      e.centre += at / (range.vertex_end - range.vertex_begin);
    }
    return e;
  }

  PanelClass first_guess(std::size_t p) {
    const Extent e = extent_of(p);
    PanelClass result;
    result.side = e.centre.x() >= 0 ? Left : Right;
    const bool one_sided = result.side == Left ? e.low.x() > -kSideTolerance : e.high.x() < kSideTolerance;
    const std::string& label = pattern_.panels[p].label;
    const double to_arm = distance_xy(e.centre, guides_.arm[result.side]);
    const double to_leg = distance_xy(e.centre, guides_.leg[result.side]);
    const double to_trunk =
        distance_xy(e.centre, {Vec3(0, levels_.crotch_y, 0), Vec3(0, levels_.shoulder_y + kSideTolerance, 0)});
    const bool lower =
        e.high.y() <= levels_.waist_y + kWaistAboveMiddle + kWaistTolerance && e.low.y() < levels_.crotch_y;
    if (label == "arm" || (label.empty() && one_sided && to_arm < to_trunk && to_arm < to_leg)) {
      result.kind = PanelKind::Arm;
    } else if (label == "leg" || (label.empty() && lower)) {
      result.kind = PanelKind::Skirt;
      candidate_[p] = one_sided;
    } else if (label.empty() && one_sided && e.low.y() < levels_.crotch_y - kLegDrop && to_leg < to_trunk) {
      result.kind = PanelKind::Skirt;
      candidate_[p] = true;
    } else {
      result.torso = e.low.y() < levels_.armpit_y && e.high.y() > levels_.armpit_y - kTorsoTop;
    }
    return result;
  }

  // Candidates of one side are trouser legs only if they close into a tube: at least as many seam chains (runs of
  // consecutive stitched edges) between them as there are panels. Two skirt panels of one side share one seam only.
  void confirm_legs(GarmentClass& garment, Side side) const {
    int panels = 0, chains = 0;
    for (std::size_t p = 0; p < garment.panels.size(); ++p) panels += is_candidate(garment, static_cast<int>(p), side);
    for (std::size_t p = 0; p < garment.panels.size(); ++p)
      if (is_candidate(garment, static_cast<int>(p), side)) chains += seam_chains(garment, static_cast<int>(p), side);
    if (panels == 0 || chains / 2 < panels) return;
    for (std::size_t p = 0; p < garment.panels.size(); ++p)
      if (is_candidate(garment, static_cast<int>(p), side)) garment.panels[p].kind = PanelKind::TrouserLeg;
  }

  bool is_candidate(const GarmentClass& garment, int panel, Side side) const {
    return candidate_[static_cast<std::size_t>(panel)] && garment.panels[static_cast<std::size_t>(panel)].side == side;
  }

  // Runs of consecutive edges of `panel` sewn to other candidates of the side.
  int seam_chains(const GarmentClass& garment, int panel, Side side) const {
    const int edges = pattern_.panels[static_cast<std::size_t>(panel)].edge_count();
    std::vector<int> partner(static_cast<std::size_t>(edges), -1);
    for (const Seam& seam : pattern_.seams)
      for (const auto& [mine, other] : {std::pair(seam.a, seam.b), std::pair(seam.b, seam.a)})
        if (mine.panel.value == panel && other.panel.value != panel && is_candidate(garment, other.panel.value, side))
          partner[static_cast<std::size_t>(mine.edge)] = other.panel.value;
    int chains = 0;
    for (int e = 0; e < edges; ++e) {
      const int here = partner[static_cast<std::size_t>(e)],
                before = partner[static_cast<std::size_t>((e + edges - 1) % edges)];
      chains += here >= 0 && here != before;
    }
    return chains;
  }

  static constexpr double kWaistAboveMiddle = 0.06;  // m: worn waists lie above the middle between crotch and armpits

  const Pattern& pattern_;
  const PatternMesh& mesh_;
  const Points3& placed_;
  const BodyGuides& guides_;
  const BodyLevels& levels_;
  std::vector<bool> candidate_;  // per panel: may be a trouser leg
};

}  // namespace

GarmentClass classify_panels(const Pattern& pattern, const PatternMesh& mesh, const Points3& placed,
                             const BodyGuides& guides) {
  return Classifier(pattern, mesh, placed, guides).run();
}

}  // namespace toile
