// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/recut.h"

#include <algorithm>

#include "engine/alter/part_openings.h"
#include "engine/alter/propagate_tear.h"

namespace toile {
namespace {

constexpr double kSamePoint = 1e-6;  // m, along a side: cloth and outline share one point there

// Points of every wanted side, shared by the outline and by the cloth that hangs on it: equal places, equal numbers.
class SharedPoints {
 public:
  explicit SharedPoints(const Sheet& sheet) : sheet_(sheet) {
    for (const SideCurve& side : sheet.wanted_sides) at_.push_back(side.at());
    for (const SheetVertex& vertex : sheet.vertices)
      for (const SheetAnchor& anchor : vertex.anchors)
        if (anchor.side >= 0 && anchor.attached) add(anchor.side, foot(vertex, anchor.side));
  }

  // Arc length of a vertex's place on the wanted side, as shared.
  double place(const SheetVertex& vertex, int side) const {
    const auto& at = at_[static_cast<std::size_t>(side)];
    const double wanted = foot(vertex, side);
    const auto above = std::lower_bound(at.begin(), at.end(), wanted - kSamePoint);
    return above == at.end() ? at.back() : *above;
  }
  Vec2 point(int side, double at) const { return sheet_.wanted_sides[static_cast<std::size_t>(side)].point(at); }
  const std::vector<double>& of_side(int side) const { return at_[static_cast<std::size_t>(side)]; }

 private:
  double foot(const SheetVertex& vertex, int side) const {
    const SideCurve& curve = sheet_.wanted_sides[static_cast<std::size_t>(side)];
    // A corner that hangs on both its sides is the wanted corner.
    const int count = static_cast<int>(sheet_.sides.size());
    const auto hangs = [&](int other) {
      const SheetAnchor* anchor = vertex.anchor(other);
      return anchor && anchor->attached;
    };
    if (count > 1 && hangs((side + count - 1) % count) && vertex.anchor(side)->at == 0.0) return 0.0;
    if (count > 1 && hangs((side + 1) % count) && vertex.anchor(side)->at > 0.0 &&
        vertex.anchor((side + 1) % count)->at == 0.0)
      return curve.length();
    return std::clamp(curve.closest(vertex.now).at, 0.0, curve.length());
  }
  void add(int side, double place) {
    auto& at = at_[static_cast<std::size_t>(side)];
    const auto above = std::lower_bound(at.begin(), at.end(), place - kSamePoint);
    if (above == at.end() || *above > place + kSamePoint) at.insert(above, place);
  }

  const Sheet& sheet_;
  std::vector<std::vector<double>> at_;
};

std::vector<Vec2> wanted_outline(const Sheet& sheet, const SharedPoints& shared) {
  std::vector<Vec2> outline;
  for (int s = 0; s < static_cast<int>(sheet.sides.size()); ++s) {
    const std::vector<double>& at = shared.of_side(s);
    for (std::size_t i = 0; i + 1 < at.size(); ++i) outline.push_back(shared.point(s, at[i]));
  }
  return outline;
}

bool hangs_on(const SheetVertex& vertex, int side) {
  const SheetAnchor* anchor = vertex.anchor(side);
  return anchor && anchor->attached;
}

Vec2 place_of(const SheetVertex& vertex, const SharedPoints& shared) {
  for (const SheetAnchor& anchor : vertex.anchors)
    if (anchor.side >= 0 && anchor.attached) return shared.point(anchor.side, shared.place(vertex, anchor.side));
  return vertex.now;
}

// Border of the cloth where it is now, following the wanted side wherever it hangs on it.
std::vector<Vec2> kept_outline(const Sheet& sheet, const std::vector<BorderEdge>& loop, const SharedPoints& shared) {
  std::vector<Vec2> outline;
  for (const BorderEdge& edge : loop) {
    const SheetVertex &from = sheet.vertices[static_cast<std::size_t>(edge.from)],
                      &to = sheet.vertices[static_cast<std::size_t>(edge.to)];
    outline.push_back(place_of(from, shared));
    if (edge.side < 0 || !hangs_on(from, edge.side) || !hangs_on(to, edge.side)) continue;
    const double begin = shared.place(from, edge.side), end = shared.place(to, edge.side);
    for (const double at : shared.of_side(edge.side))
      if (at > begin + kSamePoint && at < end - kSamePoint) outline.push_back(shared.point(edge.side, at));
  }
  return outline;
}

// A stretch of a wanted side that the cloth stands back from.
struct OpenRun {
  std::vector<double> at, gap;              // arc length along the wanted side, and how far the cloth is from there
  bool from_start = false, to_end = false;  // of the side
  double largest() const { return *std::max_element(gap.begin(), gap.end()); }
};

// Places of the cloth's border along a side, in order, with how far open each is.
OpenRun all_along(const Sheet& sheet, int side) {
  std::vector<std::pair<double, int>> places;  // on the cloth's side
  for (int v = 0; v < sheet.vertex_count(); ++v)
    if (const SheetAnchor* anchor = sheet.vertices[static_cast<std::size_t>(v)].anchor(side))
      places.emplace_back(anchor->at, v);
  std::sort(places.begin(), places.end());
  OpenRun whole{{}, {}, true, true};
  for (const auto& [at, v] : places) {
    const SheetVertex& vertex = sheet.vertices[static_cast<std::size_t>(v)];
    whole.at.push_back(sheet.wanted_sides[static_cast<std::size_t>(side)].closest(vertex.now).at);
    whole.gap.push_back(vertex.anchor(side)->attached ? 0.0 : std::max(0.0, gap_to_side(sheet, v, side)));
  }
  return whole;
}

// Parts of it that are open by more than what is eased in, each with the shut places it ends at.
std::vector<OpenRun> open_runs(const OpenRun& whole, double least_width) {
  std::vector<OpenRun> runs;
  const std::size_t count = whole.at.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (whole.gap[i] < least_width) continue;
    const std::size_t first = i > 0 ? i - 1 : 0;
    while (i < count && whole.gap[i] >= least_width) ++i;
    const std::size_t last = std::min(i, count - 1);
    const auto part = [&](const std::vector<double>& values) {
      return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(first),
                                 values.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    };
    runs.push_back({part(whole.at), part(whole.gap), whole.gap[first] >= least_width, i == count});
  }
  return runs;
}

// Whether it is less open than a strip that can be sewn, and more than the side's turned-in cloth gives.
bool too_narrow(const OpenRun& run, double room, const RecutOptions& options) {
  return run.largest() > std::max(room, options.least_width) && run.largest() < options.least_strip;
}

// What lies within `depth` of a wanted side, in pieces.
Loops band_along(const SideCurve& side, double depth) {
  Loops band;
  for (std::size_t i = 1; i < side.points().size(); ++i) {
    const Vec2 &a = side.points()[i - 1], &b = side.points()[i];
    band.push_back({a, b, b - depth * side.normals()[i], a - depth * side.normals()[i - 1]});
  }
  return band;
}

// The run as much deeper as makes its widest place `depth`; it ends where it ended.
Loops deeper_run(const SideCurve& side, const OpenRun& run, double depth) {
  const double share = depth / run.largest();
  const std::size_t count = run.at.size();
  const auto inside = [&](std::size_t i) {
    const bool shut = (i == 0 && !run.from_start) || (i + 1 == count && !run.to_end);
    const SideFoot foot = side.closest(side.point(run.at[i]));
    return Vec2(foot.point - (shut ? 1.0 : share) * run.gap[i] * foot.normal);
  };
  Loops band;
  for (std::size_t i = 1; i < count; ++i)
    band.push_back({side.point(run.at[i - 1]), side.point(run.at[i]), inside(i), inside(i - 1)});
  return band;
}

// Kept cloth in the middle of an opening is a crumb; more is left for the caller to refuse.
void fill_crumbs(double least_area, PolygonWithHoles& opening) {
  std::erase_if(opening.holes, [&](const auto& hole) { return std::abs(signed_area(hole)) < least_area; });
}

double sum_of_areas(const std::vector<std::vector<Vec2>>& outlines) {
  double sum = 0.0;
  for (const auto& outline : outlines) sum += std::abs(signed_area(outline));
  return sum;
}

void cut_back_narrow_sides(const Sheet& sheet, const RecutOptions& options, RecutPanel& panel) {
  Loops bands;
  for (int side = 0; side < static_cast<int>(options.side_room.size()); ++side)
    for (const OpenRun& run : open_runs(all_along(sheet, side), options.least_width)) {
      if (!too_narrow(run, options.side_room[static_cast<std::size_t>(side)], options)) continue;
      const SideCurve& curve = sheet.wanted_sides[static_cast<std::size_t>(side)];
      const double depth = options.least_strip;
      for (auto& part : run.from_start&& run.to_end ? band_along(curve, depth) : deeper_run(curve, run, depth))
        bands.push_back(std::move(part));
    }
  if (bands.empty()) return;
  panel.cut_back = sum_of_areas(panel.kept);
  std::vector<std::vector<Vec2>> kept;
  for (const auto& outline : panel.kept)
    for (PolygonWithHoles& part : polygon_difference({outline}, bands))
      if (area(part) >= options.least_area) kept.push_back(std::move(part.outline));
  panel.kept = std::move(kept);
  panel.cut_back -= sum_of_areas(panel.kept);
}

}  // namespace

RecutPanel recut(const Sheet& sheet, const RecutOptions& options) {
  const SharedPoints shared(sheet);
  RecutPanel result;
  result.wanted = wanted_outline(sheet, shared);
  result.wanted_area = signed_area(result.wanted);
  for (const auto& loop : border_loops(sheet)) result.kept.push_back(kept_outline(sheet, loop, shared));
  const bool whole = sheet.cuts.empty() && std::all_of(sheet.vertices.begin(), sheet.vertices.end(), [](const auto& v) {
                       return std::all_of(v.anchors.begin(), v.anchors.end(),
                                          [](const SheetAnchor& a) { return a.side < 0 || a.attached; });
                     });
  if (whole) return result;
  cut_back_narrow_sides(sheet, options, result);
  const PartOpeningOptions parting{options.least_area, options.least_width, options.least_strip, options.l_shapes};
  for (PolygonWithHoles& opening : polygon_difference({result.wanted}, result.kept)) {
    fill_crumbs(options.least_area, opening);
    if (!opening.holes.empty()) {
      result.opening_area += area(opening);
      result.openings.push_back(std::move(opening));
      continue;
    }
    for (const auto& part : parted_at_necks(opening.outline, result.wanted, parting)) {
      if (!worth_sewing(part, parting)) {
        ++result.dropped;
        continue;
      }
      result.opening_area += signed_area(part);
      for (auto& strip : strips_of(part, parting)) result.openings.push_back({std::move(strip), {}});
    }
  }
  return result;
}

}  // namespace toile
