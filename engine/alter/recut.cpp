// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/recut.h"

#include <algorithm>

#include "engine/alter/part_openings.h"
#include "engine/alter/propagate_tear.h"
#include "engine/geometry/inner_point.h"

namespace toile {
namespace {

constexpr double kSamePoint = 1e-6;   // m, along a side: cloth and outline share one point there
constexpr double kLeastPart = 2e-5;   // m^2: what a dart leaves of an opening and is smaller is crumbs
constexpr double kJustInside = 1e-3;  // m
constexpr double kWideEnough = 0.98;  // of the least strip: widths are measured to a few per cent
constexpr int kPlaces = 16;           // of a run that are looked at
constexpr int kDeepenings = 4;        // of strips that are too narrow

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

void add_without_wedges(const PolygonWithHoles& opening, const Loops& wedges, std::vector<PolygonWithHoles>& openings) {
  if (wedges.empty() || !opening.holes.empty()) {
    openings.push_back(opening);
    return;
  }
  for (PolygonWithHoles& part : polygon_difference({opening.outline}, wedges))
    if (area(part) > kLeastPart) openings.push_back(std::move(part));
}

// What the kept cloth leaves open, in parts that can be sewn.
void find_openings(const RecutOptions& options, RecutPanel& panel) {
  panel.openings.clear();
  panel.dropped = 0;
  const PartOpeningOptions parting{options.least_area, options.least_width, options.least_strip, options.l_shapes};
  for (PolygonWithHoles& opening : polygon_difference({panel.wanted}, panel.kept)) {
    fill_crumbs(options.least_area, opening);
    if (!opening.holes.empty()) {
      panel.openings.push_back(std::move(opening));
      continue;
    }
    for (const auto& part : parted_at_necks(opening.outline, panel.wanted, parting)) {
      if (!worth_sewing(part, parting)) {
        ++panel.dropped;
        continue;
      }
      for (auto& strip : strips_of(part, parting))
        add_without_wedges({std::move(strip), {}}, options.wedges, panel.openings);
    }
  }
}

// A run that needs a strip, and how far the cloth is cut back there: 0 while the strip is deep enough by itself.
struct StripRun {
  int side;
  OpenRun run;
  double depth;
};

std::vector<StripRun> strip_runs(const Sheet& sheet, const RecutOptions& options) {
  std::vector<StripRun> strips;
  for (int side = 0; side < static_cast<int>(options.side_room.size()); ++side)
    for (OpenRun& run : open_runs(all_along(sheet, side), options.least_width)) {
      const double open = run.largest();
      if (open <= std::max(options.side_room[static_cast<std::size_t>(side)], options.least_width)) continue;
      strips.push_back({side, std::move(run), open < options.least_strip ? options.least_strip : 0.0});
    }
  return strips;
}

std::vector<std::vector<Vec2>> cut_back(const Sheet& sheet, const std::vector<StripRun>& strips, double least_area,
                                        const std::vector<std::vector<Vec2>>& cloth) {
  Loops bands;
  for (const auto& [side, run, depth] : strips) {
    if (depth == 0.0) continue;
    const SideCurve& curve = sheet.wanted_sides[static_cast<std::size_t>(side)];
    for (auto& part : run.from_start&& run.to_end ? band_along(curve, depth) : deeper_run(curve, run, depth))
      bands.push_back(std::move(part));
  }
  if (bands.empty()) return cloth;
  std::vector<std::vector<Vec2>> kept;
  for (const auto& outline : cloth)
    for (PolygonWithHoles& part : polygon_difference({outline}, bands))
      if (area(part) >= least_area) kept.push_back(std::move(part.outline));
  return kept;
}

// Whether a strip lies at some place of a run.
bool lies_at(const std::vector<Vec2>& strip, const Sheet& sheet, const StripRun& at) {
  const SideCurve& side = sheet.wanted_sides[static_cast<std::size_t>(at.side)];
  const double from = at.run.at.front(), to = at.run.at.back();
  for (int i = 1; i < kPlaces; ++i) {
    const SideFoot foot = side.closest(side.point(from + (to - from) * i / kPlaces));
    if (inside_polygon(strip, foot.point - kJustInside * foot.normal)) return true;
  }
  return false;
}

// Deepens the runs of strips in which the circle does not lie; false where all are wide enough.
bool deepen(const Sheet& sheet, const RecutOptions& options, const RecutPanel& panel, std::vector<StripRun>& strips) {
  bool changed = false;
  std::vector<double> missing(strips.size(), 0.0);
  for (const PolygonWithHoles& opening : panel.openings) {
    const double width = 2.0 * roomiest_point(opening.outline).clearance;
    if (width >= kWideEnough * options.least_strip) continue;
    for (std::size_t i = 0; i < strips.size(); ++i)
      if (lies_at(opening.outline, sheet, strips[i])) missing[i] = std::max(missing[i], options.least_strip - width);
  }
  for (std::size_t i = 0; i < strips.size(); ++i) {
    if (missing[i] == 0.0) continue;
    double& depth = strips[i].depth;
    const bool whole = strips[i].run.from_start && strips[i].run.to_end;
    const double before = depth > 0.0 ? depth : whole ? options.least_strip : strips[i].run.largest();
    depth = before + (depth > 0.0 || !whole ? missing[i] : 0.0);
    changed = true;
  }
  return changed;
}

void make_room_for_strips(const Sheet& sheet, const RecutOptions& options, RecutPanel& panel) {
  std::vector<StripRun> strips = strip_runs(sheet, options);
  const std::vector<std::vector<Vec2>> cloth = panel.kept;
  for (int pass = 0; pass <= kDeepenings; ++pass) {
    panel.kept = cut_back(sheet, strips, options.least_area, cloth);
    find_openings(options, panel);
    if (!deepen(sheet, options, panel, strips)) break;
  }
  panel.cut_back = sum_of_areas(cloth) - sum_of_areas(panel.kept);
}

}  // namespace

RecutPanel recut(const Sheet& sheet, const RecutOptions& options) {
  const SharedPoints shared(sheet);
  RecutPanel result;
  result.wanted = wanted_outline(sheet, shared);
  for (const auto& loop : border_loops(sheet)) result.kept.push_back(kept_outline(sheet, loop, shared));
  const bool whole = sheet.cuts.empty() && std::all_of(sheet.vertices.begin(), sheet.vertices.end(), [](const auto& v) {
                       return std::all_of(v.anchors.begin(), v.anchors.end(),
                                          [](const SheetAnchor& a) { return a.side < 0 || a.attached; });
                     });
  if (!whole) make_room_for_strips(sheet, options, result);
  return result;
}

}  // namespace toile
