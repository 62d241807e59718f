// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/altered_regions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/alter/panel_tracks.h"
#include "engine/alter/trim_slivers.h"
#include "engine/core/units.h"
#include "engine/geometry/conform_loops.h"
#include "engine/geometry/inner_point.h"

namespace toile {
namespace {

constexpr double kSamePoint = 2e-5;   // m
constexpr double kSlit = 5e-5;        // m: half the width of a cut that is sewn up again, so that lips are apart
constexpr double kOnBorder = 3e-4;    // m: a lip this near to an insertion opens into it
constexpr double kLeastPiece = 4e-4;  // m^2: smaller kept pieces go with the insertion beside them
constexpr double kCorner = 30.0 * kRadianPerDegree;
constexpr double kReach = 4e-3;  // m: over which the direction of a border is taken

double turn(const Vec2& in, const Vec2& out) {
  return std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
}

Vec2 left_of(const Vec2& way) {
  const double length = way.norm();
  return length > 0 ? Vec2(-way.y() / length, way.x() / length) : Vec2::Zero();
}

// Borders that a cut made in the stretched cloth, each in one go; cloth on the left.
std::vector<std::vector<Vec2>> lips_of(const Sheet& sheet) {
  std::vector<std::vector<Vec2>> lips;
  const auto now = [&](int v) { return sheet.vertices[static_cast<std::size_t>(v)].now; };
  for (const auto& loop : border_loops(sheet)) {
    const std::size_t count = loop.size();
    std::size_t first = 0;
    while (first < count && !(loop[first].side < 0 && loop[(first + count - 1) % count].side >= 0)) ++first;
    for (std::size_t k = 0; k < count && first < count; ++k) {
      const BorderEdge& edge = loop[(first + k) % count];
      if (edge.side >= 0) continue;
      if (loop[(first + k + count - 1) % count].side >= 0) lips.push_back({now(edge.from)});
      lips.back().push_back(now(edge.to));
    }
  }
  return lips;
}

// The parts of a lip that open into an insertion.
std::vector<std::vector<Vec2>> open_runs(const std::vector<Vec2>& lip, const std::vector<Vec2>& insertion) {
  std::vector<std::vector<Vec2>> runs;
  bool open = false;
  for (std::size_t i = 0; i + 1 < lip.size(); ++i) {
    const bool opens = distance_to_polygon(insertion, 0.5 * (lip[i] + lip[i + 1])) < kOnBorder;
    if (opens && !open) runs.push_back({lip[i]});
    if (opens) runs.back().push_back(lip[i + 1]);
    open = opens;
  }
  return runs;
}

// A line moved to its left, mitred, and drawn out at both ends.
std::vector<Vec2> moved_left(const std::vector<Vec2>& line, double distance, double longer) {
  std::vector<Vec2> moved;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec2 in = i > 0 ? line[i] - line[i - 1] : line[1] - line[0];
    const Vec2 out = i + 1 < line.size() ? line[i + 1] - line[i] : in;
    const Vec2 a = left_of(in), b = left_of(out);
    Vec2 mitre = a + b;
    mitre = mitre.squaredNorm() > 1e-6 ? Vec2(mitre * (2.0 / std::max(0.5, mitre.squaredNorm()))) : in.normalized();
    Vec2 end = Vec2::Zero();
    if (i == 0) end = -longer * out.normalized();
    if (i + 1 == line.size()) end = longer * in.normalized();
    moved.emplace_back(line[i] + distance * mitre + end);
  }
  return moved;
}

// The strip of kept cloth along the lips that open into an insertion: what is turned in.
Loops turned_in(const std::vector<std::vector<Vec2>>& lips, const std::vector<Vec2>& insertion, double width) {
  Loops strips;
  for (const std::vector<Vec2>& lip : lips)
    for (const std::vector<Vec2>& run : open_runs(lip, insertion)) {
      std::vector<Vec2> strip = moved_left(run, -kSamePoint, width);
      const std::vector<Vec2> inner = moved_left(run, width, width);
      strip.insert(strip.end(), inner.rbegin(), inner.rend());
      strips.push_back(std::move(strip));
    }
  return strips;
}

// An outline that touches itself as outlines that do not: booleans leave pieces that hang together in one point.
std::vector<std::vector<Vec2>> parted_at_touches(const std::vector<Vec2>& outline) {
  const ConformedLoops shared = conform_loops({outline}, kSamePoint);
  std::vector<std::vector<Vec2>> parts;
  std::vector<int> open;
  const auto close = [&](std::size_t first) {
    parts.emplace_back();
    for (std::size_t i = first; i < open.size(); ++i)
      parts.back().push_back(shared.points[static_cast<std::size_t>(open[i])]);
    open.resize(first);
  };
  for (const int point : shared.loops[0]) {
    const auto seen = std::find(open.begin(), open.end(), point);
    if (seen != open.end()) close(static_cast<std::size_t>(seen - open.begin()));
    open.push_back(point);
  }
  close(0);
  std::erase_if(parts, [](const auto& part) { return part.size() < 3; });
  return parts;
}

std::vector<Vec2> largest_part(const std::vector<Vec2>& outline) {
  const auto parts = parted_at_touches(outline);
  const auto largest = std::max_element(parts.begin(), parts.end(),
                                        [](const auto& a, const auto& b) { return signed_area(a) < signed_area(b); });
  return largest == parts.end() ? outline : *largest;
}

// A cut of the removing pass as a slit of no noticeable width, open at the ends that reach the outline.
std::vector<Vec2> slit_of(const Sheet& sheet, const Cut& cut) {
  std::vector<Vec2> path;
  for (const auto& lips : cut.lips) path.push_back(sheet.vertices[static_cast<std::size_t>(lips.first)].flat);
  if (path.size() < 2) return {};
  const auto reaches_outline = [&](int v) { return sheet.vertices[static_cast<std::size_t>(v)].anchors[0].side >= 0; };
  const bool tip = cut.lips.back().first == cut.lips.back().second;
  const Vec2 first = (path[0] - path[1]).normalized(), last = (path.back() - path[path.size() - 2]).normalized();
  path.front() += kSlit * (reaches_outline(cut.lips.front().first) ? 3.0 : 1.0) * first;
  if (!tip) path.back() += kSlit * (reaches_outline(cut.lips.back().first) ? 3.0 : 1.0) * last;
  std::vector<Vec2> left, right;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec2 way = path[std::min(i + 1, path.size() - 1)] - path[i > 0 ? i - 1 : 0];
    const bool sharp = tip && i + 1 == path.size();
    left.emplace_back(path[i] + kSlit * left_of(way));
    if (!sharp) right.emplace_back(path[i] - kSlit * left_of(way));
    if (sharp) left.back() = path[i];
  }
  left.insert(left.end(), right.rbegin(), right.rend());
  std::reverse(left.begin(), left.end());
  return left;
}

// Whether cloth is taken away between the lips of a cut; else it is as if the cut had not been made.
bool takes_away(const Sheet& sheet, const Cut& cut, const PanelAlteration& alteration) {
  return std::any_of(cut.lips.begin(), cut.lips.end(), [&](const auto& lips) {
    const Vec2 middle = 0.5 * (sheet.vertices[static_cast<std::size_t>(lips.first)].now +
                               sheet.vertices[static_cast<std::size_t>(lips.second)].now);
    return lips.first != lips.second &&
           std::any_of(alteration.removals.begin(), alteration.removals.end(),
                       [&](const AlteredRegion& region) { return inside_polygon(region.shape.outline, middle); });
  });
}

class PanelParter {
 public:
  PanelParter(const PatternMesh& mesh, const Points2& target_rest, const Sheet& inserting, const Sheet& removing,
              const PanelAlteration& alteration, bool trims)
      : alteration_(alteration), removing_(removing), trims_(trims), tracks_(mesh, target_rest, inserting.panel) {
    for (const auto& ends : mesh.edge_vertices[static_cast<std::size_t>(inserting.panel)]) {
      corner_vertices_.insert(ends.front());
      corner_vertices_.insert(ends.back());
    }
    for (const SheetVertex& vertex : inserting.vertices)
      if (corner_vertices_.contains(vertex.origin)) cloth_corners_.push_back(vertex.now);
  }

  AlteredParts run(const Sheet& inserting, const std::vector<bool>& let_out, double turn_in) {
    grow_insertions(lips_of(inserting), let_out, turn_in);
    part_kept_cloth();
    if (result_.problem.empty()) share_borders();
    return std::move(result_);
  }

 private:
  void grow_insertions(const std::vector<std::vector<Vec2>>& lips, const std::vector<bool>& let_out, double turn_in);
  void part_kept_cloth();
  void give_away(const std::vector<Vec2>& piece);
  void share_borders();
  void name_border(RegionBorder& border, int part, const std::map<std::pair<int, int>, int>& owner);
  void mark_corners();

  struct Area {
    int insertion;
    std::vector<Vec2> outline;
  };
  const PanelAlteration& alteration_;
  const Sheet& removing_;
  bool trims_;
  PanelTracks tracks_;
  std::set<int> corner_vertices_;
  std::vector<Vec2> cloth_corners_;
  std::vector<Area> insertions_, kept_;
  AlteredParts result_;
};

void PanelParter::grow_insertions(const std::vector<std::vector<Vec2>>& lips, const std::vector<bool>& let_out,
                                  double turn_in) {
  Loops others;  // grown already, or with cloth of their own
  for (std::size_t i = 0; i < alteration_.insertions.size(); ++i)
    if (!let_out[i]) others.push_back(alteration_.insertions[i].shape.outline);
  std::size_t own = 0;
  for (std::size_t i = 0; i < alteration_.insertions.size(); ++i) {
    if (let_out[i]) continue;
    const std::vector<Vec2>& outline = alteration_.insertions[i].shape.outline;
    if (!alteration_.insertions[i].shape.holes.empty()) result_.problem = "an insertion goes round kept cloth";
    Area grown{static_cast<int>(i), outline};
    Loops cloth = turned_in(lips, outline, turn_in);
    if (!cloth.empty()) {
      cloth.push_back(outline);
      Loops rest = others;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(own));
      Loops inside;
      for (const PolygonWithHoles& part : polygon_intersection({alteration_.target}, cloth))
        inside.push_back(part.outline);
      const auto parts = rest.empty() ? polygon_union(inside) : polygon_difference(inside, rest);
      const auto largest =
          std::max_element(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return area(a) < area(b); });
      if (largest != parts.end()) grown.outline = largest_part(largest->outline);
    }
    if (trims_) trim_slivers(grown.outline);
    others[own++] = grown.outline;
    insertions_.push_back(std::move(grown));
  }
}

// A kept piece too small to be handled is cut with the insertion it lies nearest to.
void PanelParter::give_away(const std::vector<Vec2>& piece) {
  Area* nearest = nullptr;
  double most = 0.0;
  for (Area& insertion : insertions_) {
    double shared = 0.0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Vec2 &a = piece[i], &b = piece[(i + 1) % piece.size()];
      if (distance_to_polygon(insertion.outline, 0.5 * (a + b)) < kSamePoint) shared += (b - a).norm();
    }
    if (shared > most) most = shared, nearest = &insertion;
  }
  if (!nearest) return;
  const auto joined = polygon_union({nearest->outline, piece});
  if (joined.size() == 1 && joined[0].holes.empty()) nearest->outline = joined[0].outline;
}

void PanelParter::part_kept_cloth() {
  Loops taken;
  for (const Area& insertion : insertions_) taken.push_back(insertion.outline);
  for (const Cut& cut : removing_.cuts)
    if (takes_away(removing_, cut, alteration_)) taken.push_back(slit_of(removing_, cut));
  std::erase_if(taken, [](const auto& loop) { return loop.size() < 3; });
  if (taken.empty()) {
    kept_.push_back({-1, alteration_.target});
    return;
  }
  for (PolygonWithHoles& piece : polygon_difference({alteration_.target}, taken)) {
    if (!piece.holes.empty()) result_.problem = "an insertion lies in the middle of the panel";
    for (std::vector<Vec2>& part : parted_at_touches(piece.outline)) {
      if (signed_area(part) < kLeastPiece) {
        give_away(part);
        continue;
      }
      if (trims_)
        for (const auto& sliver : trim_slivers(part)) give_away(sliver);
      kept_.push_back({-1, std::move(part)});
    }
  }
}

void PanelParter::share_borders() {
  std::vector<std::vector<Vec2>> loops;
  std::vector<Area> areas = kept_;
  areas.insert(areas.end(), insertions_.begin(), insertions_.end());
  for (const Area& part : areas) loops.push_back(part.outline);
  loops.push_back(alteration_.target);
  for (const Vec2& corner : cloth_corners_) loops.push_back({corner});
  ConformedLoops conformed = conform_loops(loops, kSamePoint);
  result_.points = std::move(conformed.points);
  std::map<std::pair<int, int>, int> owner;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const std::vector<int>& loop = conformed.loops[i];
    for (std::size_t k = 0; k < loop.size(); ++k)
      if (!owner.emplace(std::pair(loop[k], loop[(k + 1) % loop.size()]), static_cast<int>(i)).second)
        result_.problem = "pieces overlap";
  }
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const std::vector<int>& loop = conformed.loops[i];
    AlteredPart part{areas[i].insertion, {}};
    for (std::size_t k = 0; k < loop.size(); ++k) {
      part.loop.push_back({loop[k], loop[(k + 1) % loop.size()], -1, {}, 0.0, 0.0});
      name_border(part.loop.back(), static_cast<int>(i), owner);
    }
    if (part.loop.empty()) result_.problem = "a piece without area";
    result_.parts.push_back(std::move(part));
  }
  mark_corners();
}

void PanelParter::name_border(RegionBorder& border, int part, const std::map<std::pair<int, int>, int>& owner) {
  const auto across = owner.find({border.to, border.from});
  if (across != owner.end() && across->second != part) {
    border.neighbour = across->second;
    return;
  }
  const Vec2 &a = result_.points[static_cast<std::size_t>(border.from)],
             &b = result_.points[static_cast<std::size_t>(border.to)];
  if (tracks_.along_edge(a, b, border)) return;
  for (std::size_t c = 0; c < removing_.cuts.size(); ++c)
    if (tracks_.along_cut(removing_, c, a, b, 4.0 * kSlit, border)) return;
  if ((b - a).norm() > 4.0 * kSlit) result_.problem = "a border belongs to nothing";
  tracks_.nearest_edge(a, b, border);
}

// How much a part's border turns at its point k, taken over a reach so that crumbs of borders do not count.
double turn_at(const AlteredParts& parts, const AlteredPart& part, std::size_t k) {
  const std::size_t count = part.loop.size();
  const auto at = [&](std::size_t i) -> const Vec2& {
    return parts.points[static_cast<std::size_t>(part.loop[i % count].from)];
  };
  std::size_t before = k + count, after = k;
  while (before > k + 1 && (at(before) - at(k)).norm() < kReach) --before;
  while (after + 1 < k + count && (at(after) - at(k)).norm() < kReach) ++after;
  return turn(at(k) - at(before), at(after) - at(k));
}

// Borders turn or end where what lies beyond changes, where they bend, and at corners of the cloth.
void PanelParter::mark_corners() {
  result_.corner.assign(result_.points.size(), false);
  for (const AlteredPart& part : result_.parts) {
    const std::size_t count = part.loop.size();
    std::vector<double> turns;
    for (std::size_t k = 0; k < count; ++k) turns.push_back(std::abs(turn_at(result_, part, k)));
    const auto at = [&](std::size_t k) -> const Vec2& {
      return result_.points[static_cast<std::size_t>(part.loop[k % count].from)];
    };
    const auto sharpest = [&](std::size_t k) {
      for (std::size_t i = k + 1; i < k + count && (at(i) - at(k)).norm() < kReach; ++i)
        if (turns[i % count] > turns[k]) return false;
      for (std::size_t i = k + count - 1; i > k && (at(i) - at(k)).norm() < kReach; --i)
        if (turns[i % count] > turns[k]) return false;
      return true;
    };
    for (std::size_t k = 0; k < count; ++k) {
      const RegionBorder &in = part.loop[(k + count - 1) % count], &out = part.loop[k];
      const bool changes = in.neighbour != out.neighbour || in.track != out.track;
      const bool bends = in.neighbour >= 0 && turns[k] > kCorner && sharpest(k);
      const bool cloth_corner =
          in.neighbour >= 0 && std::any_of(cloth_corners_.begin(), cloth_corners_.end(),
                                           [&](const Vec2& p) { return (p - at(k)).norm() < kSamePoint; });
      if (changes || bends || cloth_corner) result_.corner[static_cast<std::size_t>(out.from)] = true;
    }
  }
}

}  // namespace

AlteredParts part_altered_panel(const PatternMesh& mesh, const Points2& target_rest, const Sheet& inserting,
                                const Sheet& removing, const PanelAlteration& alteration,
                                const std::vector<bool>& let_out, double turn_in, bool trims) {
  return PanelParter(mesh, target_rest, inserting, removing, alteration, trims).run(inserting, let_out, turn_in);
}

AlteredParts whole_panel(const PatternMesh& mesh, const Points2& target_rest, const std::vector<Vec2>& wanted,
                         int panel) {
  const PanelTracks tracks(mesh, target_rest, panel);
  AlteredParts result;
  result.points = wanted;
  result.corner.assign(wanted.size(), false);
  AlteredPart part;
  const int count = static_cast<int>(wanted.size());
  for (int i = 0; i < count; ++i) {
    part.loop.push_back({i, (i + 1) % count, -1, {}, 0.0, 0.0});
    tracks.nearest_edge(wanted[static_cast<std::size_t>(i)], wanted[static_cast<std::size_t>((i + 1) % count)],
                        part.loop.back());
  }
  for (std::size_t i = 0; i < part.loop.size(); ++i) {
    const RegionBorder& next = part.loop[(i + 1) % part.loop.size()];
    if (part.loop[i].track != next.track) result.corner[static_cast<std::size_t>(next.from)] = true;
  }
  result.parts = {std::move(part)};
  return result;
}

}  // namespace toile
