// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/edge_sampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/geometry/curve.h"
#include "engine/geometry/disjoint_sets.h"

namespace toile {

namespace {

constexpr double kCollapse = 0.25;       // of the edge length: shorter edges become one vertex
constexpr double kMostCollapsed = 0.5;   // of the edge length: a run of collapsed edges is never longer
constexpr double kRoundingGuard = 1e-6;  // keeps mirrored edges of equal length on the same side of a half step
constexpr int kLeastSides = 3;           // of a panel that do not collapse
constexpr int kLoopSegments = 3;         // fewest on an edge whose two ends are sewn into one point

int rounded_steps(double length, double edge_length) {
  return std::max(1, static_cast<int>(std::lround(length / edge_length - kRoundingGuard)));
}

// Numbers all corners of the pattern one after another.
struct CornerNumbers {
  std::vector<int> first = {0};
  explicit CornerNumbers(const Pattern& pattern) {
    for (const Panel& panel : pattern.panels) first.push_back(first.back() + panel.edge_count());
  }
  int start(const Pattern& pattern, const SeamSide& side) const { return at(pattern, side.panel.value, side.edge); }
  int end(const Pattern& pattern, const SeamSide& side) const { return at(pattern, side.panel.value, side.edge + 1); }
  int at(const Pattern& pattern, int panel, int corner) const {
    return first[static_cast<std::size_t>(panel)] +
           corner % pattern.panels[static_cast<std::size_t>(panel)].edge_count();
  }
};

}  // namespace

EdgeSampling::EdgeSampling(const Pattern& pattern, const PanelMirrors& mirrors, double edge_length) {
  collect_groups(pattern);
  share_mirrored_lengths(mirrors);
  add_breaks(pattern, mirrors, edge_length);
  for (Group& group : groups_)
    for (std::size_t i = 0; i + 1 < group.breaks.size(); ++i)
      group.steps.push_back(rounded_steps((group.breaks[i + 1] - group.breaks[i]) * group.length, edge_length));
  collapse_short_groups(pattern, edge_length);
  keep_three_sides(pattern);
  open_closed_loops(pattern);
  fill_small_panels(pattern);
}

EdgeSampling::Group& EdgeSampling::group_of(int panel, int edge) {
  return groups_[static_cast<std::size_t>(place(panel, edge).group)];
}

const EdgeSampling::Group& EdgeSampling::group_of(int panel, int edge) const {
  return groups_[static_cast<std::size_t>(
      places_[static_cast<std::size_t>(panel)][static_cast<std::size_t>(edge)].group)];
}

void EdgeSampling::collect_groups(const Pattern& pattern) {
  for (const Panel& panel : pattern.panels) places_.emplace_back(panel.edges.size());
  const auto length = [&](const SeamSide& side) { return edge_length(pattern.panel(side.panel), side.edge); };
  for (const Seam& seam : pattern.seams) {
    const int group = static_cast<int>(groups_.size());
    groups_.push_back({});
    groups_.back().length = 0.5 * (length(seam.a) + length(seam.b));
    place(seam.a.panel.value, seam.a.edge) = {group, false};
    place(seam.b.panel.value, seam.b.edge) = {group, !seam.right_wrong};
  }
  for (int p = 0; p < static_cast<int>(places_.size()); ++p)
    for (int e = 0; e < pattern.panels[static_cast<std::size_t>(p)].edge_count(); ++e) {
      if (place(p, e).group >= 0) continue;
      place(p, e) = {static_cast<int>(groups_.size()), false};
      groups_.push_back({});
      groups_.back().length = length({PanelId(p), e});
    }
}

// Mirrored edges may be sewn to sides of slightly different length; without one common length they could be rounded to
// different numbers of steps, and mirrored panels would not mesh alike.
void EdgeSampling::share_mirrored_lengths(const PanelMirrors& mirrors) {
  DisjointSets alike(static_cast<int>(groups_.size()));
  const auto join = [&](int panel, const PanelMirror& mirror) {
    for (int e = 0; e < static_cast<int>(mirror.edge_of.size()); ++e)
      alike.join(place(mirror.source.value, e).group, place(panel, mirror.edge_of[static_cast<std::size_t>(e)]).group);
  };
  for (int p = 0; p < static_cast<int>(places_.size()); ++p) {
    if (mirrors.self[static_cast<std::size_t>(p)]) join(p, *mirrors.self[static_cast<std::size_t>(p)]);
    if (!mirrors.pairs[static_cast<std::size_t>(p)].empty())
      join(p, mirrors.pairs[static_cast<std::size_t>(p)].front());
  }
  const auto [class_of, count] = alike.numbering();
  std::vector<double> sum(static_cast<std::size_t>(count), 0.0), members(static_cast<std::size_t>(count), 0.0);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    sum[static_cast<std::size_t>(class_of[g])] += groups_[g].length;
    members[static_cast<std::size_t>(class_of[g])] += 1.0;
  }
  for (std::size_t g = 0; g < groups_.size(); ++g)
    groups_[g].length = sum[static_cast<std::size_t>(class_of[g])] / members[static_cast<std::size_t>(class_of[g])];
}

void EdgeSampling::add_breaks(const Pattern& pattern, const PanelMirrors& mirrors, double edge_length) {
  for (int p = 0; p < static_cast<int>(places_.size()); ++p) {
    for (const Notch& notch : pattern.panels[static_cast<std::size_t>(p)].notches)
      group_of(p, notch.edge).breaks.push_back(place(p, notch.edge).backwards ? 1.0 - notch.at : notch.at);
    if (const auto& mirror = mirrors.self[static_cast<std::size_t>(p)])
      for (int e = 0; e < static_cast<int>(mirror->edge_of.size()); ++e)
        if (mirror->edge_of[static_cast<std::size_t>(e)] == e) group_of(p, e).breaks.push_back(0.5);
  }
  for (Group& group : groups_) {
    // Notches closer to each other or to an end than a quarter step become one vertex.
    std::sort(group.breaks.begin(), group.breaks.end());
    const double apart = std::min(0.25, kCollapse * edge_length / group.length);
    std::vector<double> kept = {0.0};
    for (const double b : group.breaks)
      if (b - kept.back() >= apart && 1.0 - b >= apart) kept.push_back(b);
    kept.push_back(1.0);
    group.breaks = std::move(kept);
  }
}

void EdgeSampling::collapse_short_groups(const Pattern& pattern, double edge_length) {
  std::vector<std::vector<SeamSide>> sides(groups_.size());
  for (int p = 0; p < static_cast<int>(places_.size()); ++p)
    for (int e = 0; e < static_cast<int>(places_[static_cast<std::size_t>(p)].size()); ++e)
      sides[static_cast<std::size_t>(place(p, e).group)].push_back({PanelId(p), e});
  std::vector<int> order(groups_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return groups_[static_cast<std::size_t>(a)].length < groups_[static_cast<std::size_t>(b)].length;
  });
  // Length of the run of collapsed edges that a side would become part of.
  const auto run = [&](const SeamSide& side) {
    const int n = pattern.panel(side.panel).edge_count();
    double total = group_of(side.panel.value, side.edge).length;
    for (const int step : {1, n - 1})
      for (int k = 1, e = (side.edge + step) % n; k < n && group_of(side.panel.value, e).collapsed;
           ++k, e = (e + step) % n)
        total += group_of(side.panel.value, e).length;
    return total;
  };
  for (const int g : order) {
    Group& group = groups_[static_cast<std::size_t>(g)];
    if (group.length >= kCollapse * edge_length) break;
    group.collapsed = std::all_of(sides[static_cast<std::size_t>(g)].begin(), sides[static_cast<std::size_t>(g)].end(),
                                  [&](const SeamSide& side) { return run(side) < kMostCollapsed * edge_length; });
  }
}

// Of a narrow strip whose both ends collapse two straight sides would be left between the same two vertices.
void EdgeSampling::keep_three_sides(const Pattern& pattern) {
  for (int p = 0; p < static_cast<int>(places_.size()); ++p) {
    const int edges = pattern.panels[static_cast<std::size_t>(p)].edge_count();
    int left = 0;
    for (int e = 0; e < edges; ++e) left += !group_of(p, e).collapsed;
    for (int e = 0; e < edges && left < kLeastSides; ++e) group_of(p, e).collapsed = false;
  }
}

void EdgeSampling::open_closed_loops(const Pattern& pattern) {
  const CornerNumbers corners(pattern);
  DisjointSets points(corners.first.back());
  for (const Seam& seam : pattern.seams) {
    points.join(corners.start(pattern, seam.a),
                seam.right_wrong ? corners.start(pattern, seam.b) : corners.end(pattern, seam.b));
    points.join(corners.end(pattern, seam.a),
                seam.right_wrong ? corners.end(pattern, seam.b) : corners.start(pattern, seam.b));
  }
  for (int p = 0; p < static_cast<int>(places_.size()); ++p)
    for (int e = 0; e < pattern.panels[static_cast<std::size_t>(p)].edge_count(); ++e)
      if (points.find(corners.at(pattern, p, e)) == points.find(corners.at(pattern, p, e + 1)))
        while (segment_count(PanelId(p), e) < kLoopSegments) refine(PanelId(p), e);
}

void EdgeSampling::fill_small_panels(const Pattern& pattern) {
  for (int p = 0; p < static_cast<int>(places_.size()); ++p) {
    const int edges = pattern.panels[static_cast<std::size_t>(p)].edge_count();
    int longest = 0, total = 0;
    for (int e = 0; e < edges; ++e) {
      total += segment_count(PanelId(p), e);
      if (group_of(p, e).length > group_of(p, longest).length) longest = e;
    }
    while (total < 3) {
      total -= segment_count(PanelId(p), longest);
      refine(PanelId(p), longest);
      total += segment_count(PanelId(p), longest);
    }
  }
}

EdgeSamples EdgeSampling::samples(PanelId panel, int edge) const {
  const Place& place = places_[static_cast<std::size_t>(panel.value)][static_cast<std::size_t>(edge)];
  const Group& group = groups_[static_cast<std::size_t>(place.group)];
  EdgeSamples result;
  result.collapsed = group.collapsed;
  if (group.collapsed) return result;
  for (std::size_t i = 0; i < group.steps.size(); ++i)
    for (int k = 0; k < group.steps[i]; ++k)
      result.fractions.push_back(group.breaks[i] + (group.breaks[i + 1] - group.breaks[i]) * k / group.steps[i]);
  result.fractions.push_back(1.0);
  if (place.backwards) {
    std::reverse(result.fractions.begin(), result.fractions.end());
    for (double& f : result.fractions) f = 1.0 - f;
  }
  return result;
}

int EdgeSampling::segment_count(PanelId panel, int edge) const {
  const Group& group = group_of(panel.value, edge);
  return group.collapsed ? 0 : std::accumulate(group.steps.begin(), group.steps.end(), 0);
}

void EdgeSampling::refine(PanelId panel, int edge) {
  Group& group = group_of(panel.value, edge);
  if (group.collapsed)
    group.collapsed = false;
  else
    for (int& steps : group.steps) steps *= 2;
}

}  // namespace toile
