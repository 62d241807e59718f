// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/tear_units.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "engine/alter/choose_tears.h"
#include "engine/alter/cut_sheet.h"
#include "engine/core/units.h"
#include "engine/geometry/disjoint_sets.h"
#include "engine/geometry/inner_point.h"

namespace toile {
namespace {

constexpr double kCurveBurden = 0.6;  // jobs per half turn along a side
constexpr double kPlyBurden = 0.1;    // jobs, of every ply that is opened
constexpr double kCutBurden = 0.5;    // jobs, of every panel that is cut: it has a new seam where none was
constexpr double kHemRelief = 0.2;    // jobs that a free edge is easier than a seam
constexpr double kStraightOn = 60.0;  // degrees: sides that turn less across a seam run on
constexpr double kSameCut = 0.03;     // m, along a side
constexpr double kProbe = 0.004;      // m, between the places where a line is looked at
constexpr double kBeside = 0.01;      // m, from a dart: nearer to one a cut leaves crumbs of cloth between them
constexpr int kMostCuts = 4;          // of one panel

double total_turn(const SideCurve& side) {
  double sum = 0.0;
  const auto& points = side.points();
  for (std::size_t i = 2; i < points.size(); ++i) {
    const Vec2 in = points[i - 1] - points[i - 2], out = points[i] - points[i - 1];
    sum += std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
  }
  return std::abs(sum);
}

int end_vertex(const Sheet& sheet, int side, bool at_end) {
  const auto& vertices = sheet.sides[static_cast<std::size_t>(side)].vertices;
  return at_end ? vertices.back() : vertices.front();
}

// Inner angle of the cloth where side `side` ends, rad.
double corner_angle(const Sheet& sheet, int side) {
  const auto& in = sheet.cloth_sides[static_cast<std::size_t>(side)].points();
  const auto& out = sheet.cloth_sides[(static_cast<std::size_t>(side) + 1) % sheet.sides.size()].points();
  const Vec2 a = in.back() - in[in.size() - 2], b = out[1] - out[0];
  return std::numbers::pi - std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

// Numbers the sides of all panels and joins those that are one job.
class SideJobs {
 public:
  SideJobs(const Pattern& pattern, const std::vector<Sheet>& sheets,
           const std::vector<std::vector<SeamPartner>>& partners, const std::vector<std::optional<PanelTwin>>& twins)
      : sheets_(sheets), partners_(partners), sets_(count(sheets)) {
    for (const Sheet& sheet : sheets) {
      first_.push_back(total_);
      total_ += static_cast<int>(sheet.sides.size());
    }
    join_plies(pattern);
    for (std::size_t p = 0; p < sheets.size(); ++p)
      if (twins[p])
        for (std::size_t s = 0; s < sheets[p].sides.size(); ++s)
          sets_.join(number(static_cast<int>(p), static_cast<int>(s)), number(twins[p]->panel, twins[p]->side_of[s]));
    for (const Sheet& sheet : sheets)
      for (int s = 0; s < static_cast<int>(sheet.sides.size()); ++s) join_continuations(sheet, s);
  }

  std::vector<std::vector<int>> numbered(int& job_count) {
    const auto [numbers, jobs] = sets_.numbering();
    job_count = jobs;
    std::vector<std::vector<int>> result;
    for (std::size_t p = 0; p < sheets_.size(); ++p)
      result.emplace_back(numbers.begin() + first_[p],
                          numbers.begin() + first_[p] + static_cast<std::ptrdiff_t>(sheets_[p].sides.size()));
    return result;
  }

 private:
  static int count(const std::vector<Sheet>& sheets) {
    int sum = 0;
    for (const Sheet& sheet : sheets) sum += static_cast<int>(sheet.sides.size());
    return sum;
  }
  int number(int panel, int side) const { return first_[static_cast<std::size_t>(panel)] + side; }

  void join_plies(const Pattern& pattern) {
    std::map<std::pair<int, int>, int> side_of_edge;
    for (const Sheet& sheet : sheets_)
      for (std::size_t s = 0; s < sheet.sides.size(); ++s)
        for (const int edge : sheet.sides[s].edges)
          side_of_edge[{sheet.panel, edge}] = number(sheet.panel, static_cast<int>(s));
    for (const Seam& seam : pattern.seams) {
      const auto a = side_of_edge.find({seam.a.panel.value, seam.a.edge}),
                 b = side_of_edge.find({seam.b.panel.value, seam.b.edge});
      if (a != side_of_edge.end() && b != side_of_edge.end()) sets_.join(a->second, b->second);
    }
  }

  // Side s ends at a corner; the next side there is sewn to another panel, on which side s may run on.
  void join_continuations(const Sheet& sheet, int s) {
    const int count = static_cast<int>(sheet.sides.size());
    if (count < 2) return;
    const int corner = end_vertex(sheet, s, true);
    for (const SeamPartner& partner : partners_[static_cast<std::size_t>(corner)]) {
      const Sheet& other = sheets_[static_cast<std::size_t>(partner.panel)];
      for (int t = 0; t < static_cast<int>(other.sides.size()); ++t) {
        const bool ends = end_vertex(other, t, true) == partner.vertex;  // t, then the side sewn to our next one ...
        const int sewn = ends ? (t + 1) % static_cast<int>(other.sides.size()) : t;
        if (!ends || !sewn_together(sheet, (s + 1) % count, other, sewn)) {
          // ... or our next side is sewn to the side that ends there, and t begins there.
          if (end_vertex(other, t, false) != partner.vertex) continue;
          const int before = (t + static_cast<int>(other.sides.size()) - 1) % static_cast<int>(other.sides.size());
          if (!sewn_together(sheet, (s + 1) % count, other, before)) continue;
          join_if_straight(sheet, s, other, t, before);
          continue;
        }
        join_if_straight(sheet, s, other, t, t);
      }
    }
  }

  // `angle_at`: the side of `other` whose end is the corner.
  void join_if_straight(const Sheet& sheet, int s, const Sheet& other, int t, int angle_at) {
    if (sheet.sides[static_cast<std::size_t>(s)].sewn != other.sides[static_cast<std::size_t>(t)].sewn) return;
    const double sum = corner_angle(sheet, s) + corner_angle(other, angle_at);
    if (std::abs(sum - std::numbers::pi) > kStraightOn * kRadianPerDegree) return;
    sets_.join(number(sheet.panel, s), number(other.panel, t));
  }

  // Whether some vertex in the middle of one side is sewn to the other.
  bool sewn_together(const Sheet& a, int side_a, const Sheet& b, int side_b) const {
    const auto& line = a.sides[static_cast<std::size_t>(side_a)].vertices;
    for (const SeamPartner& partner : partners_[static_cast<std::size_t>(line[line.size() / 2])])
      if (partner.panel == b.panel && b.sides[static_cast<std::size_t>(side_b)].holds(partner.vertex)) return true;
    return false;
  }

  const std::vector<Sheet>& sheets_;
  const std::vector<std::vector<SeamPartner>>& partners_;
  DisjointSets sets_;
  std::vector<int> first_;
  int total_ = 0;
};

double side_burden(const Sheet& sheet, int side) {
  const double curve = total_turn(sheet.cloth_sides[static_cast<std::size_t>(side)]) / std::numbers::pi;
  return kPlyBurden + kCurveBurden * curve;
}

bool is_own_twin(const std::optional<PanelTwin>& twin, int panel) {
  return twin && twin->panel == panel;
}

// The axis of the grain that leads into the cloth and is nearest to `direction`.
Vec2 along_grain(const Vec2& direction, const Vec2& inward) {
  Vec2 best = direction;
  double nearest = -1.0;
  for (const Vec2& axis : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)}) {
    if (axis.dot(inward) < 0.3 || axis.dot(direction) <= nearest) continue;
    nearest = axis.dot(direction);
    best = axis;
  }
  return best;
}

// Both ends of a straight cut on the outline, without carrying it out.
std::vector<TearMouth> cut_mouths(Sheet sheet, const Tear& tear) {
  std::vector<TearMouth> mouths;
  const int start = vertex_on_side(sheet, tear.side, tear.at);
  if (start < 0 || !cut_straight(sheet, start, tear.direction)) return mouths;
  for (const auto& lips : {sheet.cuts.back().lips.front(), sheet.cuts.back().lips.back()})
    for (const SheetAnchor& anchor : sheet.vertices[static_cast<std::size_t>(lips.first)].anchors)
      if (anchor.side >= 0) mouths.push_back({anchor.side, anchor.at});
  return mouths;
}

// Whether the straight way from a to b in the cloth leads through what a dart or slit has folded away, or close by.
bool meets_wedge(const Sheet& sheet, const Vec2& a, const Vec2& b) {
  const int steps = 1 + static_cast<int>((b - a).norm() / kProbe);
  for (std::size_t f = 0; f < sheet.faces.size(); ++f) {
    if (!sheet.folded[f]) continue;
    std::vector<Vec2> triangle;
    for (const int v : sheet.faces[f]) triangle.push_back(sheet.vertices[static_cast<std::size_t>(v)].flat);
    for (int i = 0; i <= steps; ++i) {
      const Vec2 probe = a + (b - a) * i / steps;
      if (inside_polygon(triangle, probe) || distance_to_polygon(triangle, probe) < kBeside) return true;
    }
  }
  return false;
}

class CutMaker {
 public:
  CutMaker(const std::vector<Sheet>& sheets, const std::vector<std::vector<SeamPartner>>& partners,
           const std::vector<std::optional<PanelTwin>>& twins, const CutUnitOptions& options, TearUnits& units)
      : sheets_(sheets), partners_(partners), twins_(twins), options_(options), units_(units) {}

  void from_side(int panel, int side) {
    const Sheet& sheet = sheets_[static_cast<std::size_t>(panel)];
    const double length = sheet.cloth_sides[static_cast<std::size_t>(side)].length();
    if (length < options_.least_cut_side) return;
    for (int i = 1; i <= options_.max_tears_per_side; ++i) {
      const int job = static_cast<int>(units_.job_cost.size());
      bool any = false;
      add(panel, {side, length * i / (options_.max_tears_per_side + 1)}, job, any);
      if (any) units_.job_cost.push_back(options_.seam_preference);
    }
  }

 private:
  struct KnownCut {
    int panel, job;
    std::vector<TearMouth> mouths;
  };

  const KnownCut* known_at(int panel, const TearMouth& place) const {
    for (const KnownCut& cut : known_)
      for (const TearMouth& mouth : cut.mouths)
        if (cut.panel == panel && mouth.side == place.side && std::abs(mouth.at - place.at) < kSameCut) return &cut;
    return nullptr;
  }

  // A cut from a place on a side, its mirror image, and their continuations across the seams they meet.
  void add(int panel, const TearMouth& place, int job, bool& any) {
    const auto p = static_cast<std::size_t>(panel);
    const Sheet& sheet = sheets_[p];
    if (sheet.sides[static_cast<std::size_t>(place.side)].locked || known_at(panel, place)) return;
    const auto& units = units_.of_panel[static_cast<std::size_t>(units_.chooser[p])];
    const auto cuts = std::count_if(units.begin(), units.end(),
                                    [](const TearUnit& unit) { return unit.tears[0].kind == TearKind::Edge; });
    if (cuts >= kMostCuts) return;
    const int start = vertex_on_side(sheet, place.side, place.at);
    if (start < 0) return;
    const SheetVertex& vertex = sheet.vertices[static_cast<std::size_t>(start)];
    const Vec2 inward = -sheet.cloth_sides[static_cast<std::size_t>(place.side)].closest(vertex.flat).normal;
    Tear tear{TearKind::Edge, panel, place.side, vertex.anchor(place.side)->at,
              along_grain(tear_direction(sheet, start, options_.tear), inward)};
    std::vector<TearMouth> mouths = cut_mouths(sheet, tear);
    if (mouths.empty()) return;
    for (const TearMouth& mouth : mouths)
      if (meets_wedge(sheet, vertex.flat, sheet.cloth_sides[static_cast<std::size_t>(mouth.side)].point(mouth.at)))
        return;
    any = true;
    known_.push_back({panel, job, mouths});
    add_unit(tear, job);
    for (const TearMouth& mouth : mouths)
      for (const PartnerPlace& partner : partner_places(sheets_, partners_, panel, mouth))
        if (partner.places.size() == 1) add(partner.panel, partner.places.front(), job, any);
  }

  void add_unit(const Tear& tear, int job) {
    const auto p = static_cast<std::size_t>(tear.panel);
    TearUnit unit{{tear}, job, kCutBurden};
    if (twins_[p]) {
      const Sheet& other = sheets_[static_cast<std::size_t>(twins_[p]->panel)];
      const Tear image = mirrored(tear, *twins_[p], sheets_[p], other);
      const bool middle = twins_[p]->panel == tear.panel && image.side == tear.side &&
                          std::abs(image.at - tear.at) < 2.0 * other.edge_length;
      if (middle)
        unit.tears[0].at = 0.5 * (image.at + tear.at);
      else if (twins_[p]->panel != tear.panel) {
        known_.push_back({twins_[p]->panel, job, cut_mouths(other, image)});
        if (units_.chooser[p] != tear.panel) unit.tears = {image};
      } else if (!known_at(tear.panel, {image.side, image.at})) {
        known_.push_back({tear.panel, job, cut_mouths(other, image)});
        unit.tears.push_back(image);
      }
    }
    units_.of_panel[static_cast<std::size_t>(units_.chooser[p])].push_back(std::move(unit));
  }

  const std::vector<Sheet>& sheets_;
  const std::vector<std::vector<SeamPartner>>& partners_;
  const std::vector<std::optional<PanelTwin>>& twins_;
  const CutUnitOptions& options_;
  TearUnits& units_;
  std::vector<KnownCut> known_;
};

}  // namespace

Tear mirrored(const Tear& tear, const PanelTwin& twin, const Sheet& from, const Sheet& to) {
  Tear image = tear;
  image.panel = twin.panel;
  image.side = twin.side_of[static_cast<std::size_t>(tear.side)];
  const double length = to.cloth_sides[static_cast<std::size_t>(image.side)].length();
  image.at = length * (1.0 - tear.at / from.cloth_sides[static_cast<std::size_t>(tear.side)].length());
  image.direction = twin.reflection * tear.direction;
  return image;
}

TearUnits side_units(const Pattern& pattern, const std::vector<Sheet>& sheets,
                     const std::vector<std::vector<SeamPartner>>& partners,
                     const std::vector<std::optional<PanelTwin>>& twins) {
  TearUnits units;
  int job_count = 0;
  units.side_jobs = SideJobs(pattern, sheets, partners, twins).numbered(job_count);
  units.job_cost.assign(static_cast<std::size_t>(job_count), 1.0);
  units.of_panel.resize(sheets.size());
  for (std::size_t p = 0; p < sheets.size(); ++p) {
    const Sheet& sheet = sheets[p];
    const int panel = static_cast<int>(p);
    units.chooser.push_back(twins[p] ? std::min(panel, twins[p]->panel) : panel);
    for (std::size_t s = 0; s < sheet.sides.size(); ++s) {
      const int side = static_cast<int>(s), job = units.side_jobs[p][s];
      if (!sheet.sides[s].sewn) units.job_cost[static_cast<std::size_t>(job)] = 1.0 - kHemRelief;
      const int image = is_own_twin(twins[p], panel) ? twins[p]->side_of[s] : side;
      const bool locked =
          sheet.sides[s].locked || (twins[p] && sheets[static_cast<std::size_t>(twins[p]->panel)]
                                                    .sides[static_cast<std::size_t>(twins[p]->side_of[s])]
                                                    .locked);
      if (locked) units.side_jobs[p][s] = -1;
      if (locked || units.chooser[p] != panel || image < side) continue;
      TearUnit unit{{{TearKind::Release, panel, side, 0.0, Vec2::Zero()}}, job, side_burden(sheet, side)};
      if (image != side) {
        unit.tears.push_back({TearKind::Release, panel, image, 0.0, Vec2::Zero()});
        unit.burden += kPlyBurden;
      }
      units.of_panel[p].push_back(std::move(unit));
    }
  }
  return units;
}

void add_cut_units(const Pattern& pattern, const std::vector<Sheet>& sheets,
                   const std::vector<std::vector<SeamPartner>>& partners,
                   const std::vector<std::optional<PanelTwin>>& twins, const std::vector<int>& panels,
                   const CutUnitOptions& options, TearUnits& units) {
  CutMaker maker(sheets, partners, twins, options, units);
  for (const int panel : panels)
    for (std::size_t s = 0; s < sheets[static_cast<std::size_t>(panel)].sides.size(); ++s)
      if (!pattern.panels[static_cast<std::size_t>(panel)].locked) maker.from_side(panel, static_cast<int>(s));
}

}  // namespace toile
