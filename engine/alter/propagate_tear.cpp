// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/propagate_tear.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/alter/cut_sheet.h"
#include "engine/core/units.h"

namespace toile {
namespace {

Vec2 inward(const Sheet& sheet, const SheetVertex& vertex, int side) {
  return -sheet.cloth_sides[static_cast<std::size_t>(side)].closest(vertex.flat).normal;
}

// Attaches again what lies within reach of the wanted side or beyond it; returns the largest gap left open.
double attach_shut(Sheet& sheet, int side, double least_gap) {
  double largest = 0.0;
  for (int v = 0; v < sheet.vertex_count(); ++v) {
    SheetAnchor* anchor = sheet.vertices[static_cast<std::size_t>(v)].anchor(side);
    if (!anchor) continue;
    const double open = gap_to_side(sheet, v, side);
    anchor->attached = open < least_gap;
    if (!anchor->attached) largest = std::max(largest, open);
  }
  return largest;
}

// Ends of a released side that stand open break the neighbouring sides there.
void add_release_mouths(const Sheet& sheet, int side, TearOutcome& outcome) {
  for (const SheetVertex& vertex : sheet.vertices) {
    const SheetAnchor* anchor = vertex.anchor(side);
    if (!anchor || anchor->attached) continue;
    for (const SheetAnchor& other : vertex.anchors)
      if (other.side >= 0 && other.side != side) outcome.mouths.push_back({other.side, other.at});
  }
}

void release_sides(Sheet& sheet, const std::vector<Tear>& tears, const TearOptions& options, Progress* progress,
                   SheetEquations* shared, std::vector<TearOutcome>& outcomes) {
  bool any = false;
  for (const Tear& tear : tears)
    if (tear.kind == TearKind::Release)
      for (SheetVertex& vertex : sheet.vertices)
        if (SheetAnchor* anchor = vertex.anchor(tear.side)) {
          anchor->attached = false;
          any = true;
        }
  if (!any) return;
  relax(sheet, options.relaxation, progress, shared);
  for (std::size_t i = 0; i < tears.size(); ++i) {
    if (tears[i].kind != TearKind::Release) continue;
    outcomes[i].largest_gap = attach_shut(sheet, tears[i].side, options.least_gap);
    outcomes[i].opened = outcomes[i].largest_gap > 0.0;
  }
  relax(sheet, options.relaxation, progress, shared);
  for (std::size_t i = 0; i < tears.size(); ++i)
    if (tears[i].kind == TearKind::Release) add_release_mouths(sheet, tears[i].side, outcomes[i]);
}

void add_cut_mouths(const Sheet& sheet, const Cut& cut, TearOutcome& outcome) {
  for (const auto& [left, right] : {cut.lips.front(), cut.lips.back()}) {
    if (left == right) continue;
    for (const SheetAnchor& anchor : sheet.vertices[static_cast<std::size_t>(left)].anchors)
      if (anchor.side >= 0) outcome.mouths.push_back({anchor.side, anchor.at});
  }
}

TearOutcome tear_edge(Sheet& sheet, const Tear& tear, const TearOptions& options, Progress* progress) {
  TearOutcome outcome;
  const int start = vertex_on_side(sheet, tear.side, tear.at);
  if (start < 0) return outcome;
  const bool cut = options.mesh_edges ? cut_along_edges(sheet, start, tear.direction, options.smoothness)
                                      : cut_straight(sheet, start, tear.direction);
  if (!cut) return outcome;
  const std::size_t number = sheet.cuts.size() - 1;
  relax(sheet, options.relaxation, progress);
  const std::size_t lips = sheet.cuts[number].lips.size();
  std::size_t open = 0;
  while (open < lips && gap(sheet, sheet.cuts[number], open) >= options.least_gap) ++open;
  if (open < lips) {
    zip_from(sheet, number, open);
    relax(sheet, options.relaxation, progress);
  }
  outcome.opened = open > 0;
  if (!outcome.opened) {
    sheet.cuts.pop_back();
    return outcome;
  }
  for (std::size_t i = 0; i < sheet.cuts[number].lips.size(); ++i)
    outcome.largest_gap = std::max(outcome.largest_gap, gap(sheet, sheet.cuts[number], i));
  add_cut_mouths(sheet, sheet.cuts[number], outcome);
  return outcome;
}

}  // namespace

double gap_to_side(const Sheet& sheet, int vertex, int side) {
  const Vec2& now = sheet.vertices[static_cast<std::size_t>(vertex)].now;
  const SideFoot foot = sheet.wanted_sides[static_cast<std::size_t>(side)].closest(now);
  return foot.normal.dot(foot.point - now);
}

int vertex_on_side(const Sheet& sheet, int side, double at) {
  int best = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (const BorderEdge& edge : border_edges(sheet)) {
    if (edge.side != side) continue;
    const SheetVertex& vertex = sheet.vertices[static_cast<std::size_t>(edge.from)];
    if (vertex.anchors[1].side >= 0) continue;  // a corner
    const double distance = std::abs(vertex.anchors[0].at - at);
    if (distance < nearest) {
      nearest = distance;
      best = edge.from;
    }
  }
  return best;
}

Vec2 tear_direction(const Sheet& sheet, int vertex, const TearOptions& options) {
  const SheetVertex& start = sheet.vertices[static_cast<std::size_t>(vertex)];
  Mat2 stretch = Mat2::Zero();
  for (std::size_t f = 0; f < sheet.faces.size(); ++f) {
    if (sheet.folded[f]) continue;
    const auto& face = sheet.faces[f];
    Vec2 centre = Vec2::Zero();
    for (const int v : face) centre += sheet.vertices[static_cast<std::size_t>(v)].flat / 3.0;
    if ((centre - start.flat).norm() > std::max(options.stress_radius, 2.0 * sheet.edge_length)) continue;
    const Mat2 gradient = sheet_gradient(sheet, f);
    stretch += gradient.transpose() * gradient;
  }
  const Vec2 most = Eigen::SelfAdjointEigenSolver<Mat2>(stretch).eigenvectors().col(1);
  Vec2 direction(-most.y(), most.x());
  const Vec2 in = inward(sheet, start, start.anchors[0].side);
  if (std::abs(direction.dot(in)) < 0.26) direction = in;  // a tear that would run along its side cuts across instead
  if (direction.dot(in) < 0.0) direction = -direction;
  for (const Vec2& grain : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)})
    if (direction.dot(grain) > std::cos(options.grain_snap * kRadianPerDegree) && grain.dot(in) > 0.26) return grain;
  return direction;
}

std::vector<TearOutcome> propagate_tears(Sheet& sheet, const std::vector<Tear>& tears, const TearOptions& options,
                                         Progress* progress, SheetEquations* shared) {
  std::vector<TearOutcome> outcomes(tears.size());
  release_sides(sheet, tears, options, progress, shared, outcomes);
  for (std::size_t i = 0; i < tears.size(); ++i)
    if (tears[i].kind == TearKind::Edge) outcomes[i] = tear_edge(sheet, tears[i], options, progress);
  return outcomes;
}

TearOutcome propagate_tear(Sheet& sheet, const Tear& tear, const TearOptions& options, Progress* progress) {
  return propagate_tears(sheet, {tear}, options, progress).front();
}

}  // namespace toile
