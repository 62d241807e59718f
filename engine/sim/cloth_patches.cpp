// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/cloth_patches.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace toile {
namespace {

constexpr int kPatchSize = 12;  // triangles at most: small enough that a sleeve's patch spans less than half of it
// Patches whose normals stay within this half angle of one direction are a graph over a plane, rad.
constexpr double kSmooth = 1.3;

}  // namespace

ClothPatches::ClothPatches(const Triangles& triangles, const Points2& rest, const std::vector<int>& panel)
    : triangles_(triangles), order_(static_cast<std::size_t>(triangles.rows())) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<int> number;  // of the panels there are, per triangle
  for (int begin = 0, end = 0, count = static_cast<int>(order_.size()); begin < count; begin = end) {
    while (end < count && panel[static_cast<std::size_t>(end)] == panel[static_cast<std::size_t>(begin)]) ++end;
    const int next = number.empty() ? 0 : number.back() + 1;
    number.resize(static_cast<std::size_t>(end), next);
    divide(rest, begin, end, next);
  }
  find_sides(number);
  boxes_.resize(order_.size());
  find_neighbours();
  by_height_.resize(patches_.size());
}

// Panels need not face the same way where they are sewn together: without knowing, the two layers of a sleeve pressed
// flat would count as one smooth piece.
void ClothPatches::find_sides(const std::vector<int>& panel) {
  struct Side {
    std::pair<int, int> nodes;
    int panel;
    bool forward;  // from the lower node to the higher one
  };
  std::vector<Side> sides;
  for (int f = 0; f < triangles_.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = triangles_(f, k), b = triangles_(f, (k + 1) % 3);
      sides.push_back({std::minmax({a, b}), panel[static_cast<std::size_t>(f)], a < b});
    }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return a.nodes != b.nodes ? a.nodes < b.nodes : a.panel < b.panel; });
  std::map<std::pair<int, int>, std::array<int, 2>> sewn;  // edges by which two panels face the same way, and not
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t j = i + 1; j < sides.size() && sides[j].nodes == sides[i].nodes; ++j)
      if (sides[i].panel != sides[j].panel)
        ++sewn[{sides[i].panel, sides[j].panel}][sides[i].forward == sides[j].forward ? 1 : 0];
  side_.assign(panel.empty() ? 0 : static_cast<std::size_t>(panel.back()) + 1, 0.0);
  const auto spread = [&](std::size_t from) {
    std::vector<std::size_t> next = {from};
    side_[from] = 1;
    while (!next.empty()) {
      const std::size_t p = next.back();
      next.pop_back();
      for (const auto& [pair, edges] : sewn) {
        const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
        if ((a != p && b != p) || side_[a == p ? b : a] != 0) continue;
        side_[a == p ? b : a] = edges[0] >= edges[1] ? side_[p] : -side_[p];
        next.push_back(a == p ? b : a);
      }
    }
  };
  for (std::size_t p = 0; p < side_.size(); ++p)
    if (side_[p] == 0) spread(p);
  for (const auto& [pair, edges] : sewn) {
    const bool alike = side_[static_cast<std::size_t>(pair.first)] == side_[static_cast<std::size_t>(pair.second)];
    if (edges[alike ? 1 : 0] > 0) twisted_.push_back(pair);
  }
}

void ClothPatches::divide(const Points2& rest, int begin, int end, int panel) {
  if (end - begin <= kPatchSize) {
    patches_.push_back({begin, end, {}, Vec3::Zero(), 0, panel});
    return;
  }
  const auto first = order_.begin() + begin, last = order_.begin() + end;
  Vec2 low = rest.row(*first), high = low;
  for (auto it = first; it != last; ++it) {
    low = low.cwiseMin(rest.row(*it).transpose());
    high = high.cwiseMax(rest.row(*it).transpose());
  }
  const int axis = high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
  std::sort(first, last,
            [&](int f, int g) { return rest(f, axis) != rest(g, axis) ? rest(f, axis) < rest(g, axis) : f < g; });
  const int middle = begin + (end - begin) / 2;
  divide(rest, begin, middle, panel);
  divide(rest, middle, end, panel);
}

void ClothPatches::find_neighbours() {
  std::vector<std::pair<int, int>> patch_of_node;
  for (std::size_t p = 0; p < patches_.size(); ++p)
    for (int k = patches_[p].begin; k < patches_[p].end; ++k)
      for (int c = 0; c < 3; ++c)
        patch_of_node.emplace_back(triangles_(order_[static_cast<std::size_t>(k)], c), static_cast<int>(p));
  std::sort(patch_of_node.begin(), patch_of_node.end());
  patch_of_node.erase(std::unique(patch_of_node.begin(), patch_of_node.end()), patch_of_node.end());
  neighbours_.resize(patches_.size());
  for (std::size_t i = 0; i < patch_of_node.size(); ++i)
    for (std::size_t j = i + 1; j < patch_of_node.size() && patch_of_node[j].first == patch_of_node[i].first; ++j) {
      const int a = patch_of_node[i].second, b = patch_of_node[j].second;
      const auto panels =
          std::minmax(patches_[static_cast<std::size_t>(a)].panel, patches_[static_cast<std::size_t>(b)].panel);
      if (std::binary_search(twisted_.begin(), twisted_.end(), std::pair<int, int>(panels))) continue;
      neighbours_[static_cast<std::size_t>(patch_of_node[i].second)].push_back(patch_of_node[j].second);
      neighbours_[static_cast<std::size_t>(patch_of_node[j].second)].push_back(patch_of_node[i].second);
    }
  for (std::vector<int>& list : neighbours_) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

void ClothPatches::measure(const Points3& nodes) {
  std::array<Vec3, 2 * kPatchSize> normals;
  for (Patch& patch : patches_) {
    patch.box = {};
    patch.axis.setZero();
    for (int k = patch.begin; k < patch.end; ++k) {
      const int f = order_[static_cast<std::size_t>(k)];
      const Vec3 a = nodes.row(triangles_(f, 0)), b = nodes.row(triangles_(f, 1)), c = nodes.row(triangles_(f, 2));
      TriangleBox& box = boxes_[static_cast<std::size_t>(f)];
      box = {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
      patch.box.low = patch.box.low.cwiseMin(box.low);
      patch.box.high = patch.box.high.cwiseMax(box.high);
      const Vec3 normal = (b - a).cross(c - a);
      patch.axis += normal;
      normals[static_cast<std::size_t>(k - patch.begin)] = normal;
    }
    const double length = patch.axis.norm();
    double cosine = length > 0 ? 1 : -1;
    if (length > 0) patch.axis /= length;
    for (int k = 0; k < patch.end - patch.begin; ++k) {
      const Vec3& normal = normals[static_cast<std::size_t>(k)];
      cosine = std::min(cosine, patch.axis.dot(normal) / std::max(normal.norm(), 1e-300));
    }
    patch.spread = std::acos(std::clamp(cosine, -1.0, 1.0));
  }
}

bool ClothPatches::smooth(const Patch& a, const Patch& b) const {
  if (a.spread + b.spread >= 2 * kSmooth) return false;
  const double alike = side_[static_cast<std::size_t>(a.panel)] * side_[static_cast<std::size_t>(b.panel)];
  const double between = std::acos(std::clamp(alike * a.axis.dot(b.axis), -1.0, 1.0));
  return std::max({a.spread, b.spread, 0.5 * (between + a.spread + b.spread)}) < kSmooth;
}

void ClothPatches::find_pairs(double reach) {
  pairs_.clear();
  const auto patch = [this](int p) -> const Patch& { return patches_[static_cast<std::size_t>(p)]; };
  std::iota(by_height_.begin(), by_height_.end(), 0);
  std::sort(by_height_.begin(), by_height_.end(), [&](int a, int b) {
    return patch(a).box.low.y() != patch(b).box.low.y() ? patch(a).box.low.y() < patch(b).box.low.y() : a < b;
  });
  for (std::size_t i = 0; i < by_height_.size(); ++i) {
    const int a = by_height_[i];
    if (patch(a).spread >= kSmooth) pairs_.emplace_back(a, a);
    for (std::size_t j = i + 1;
         j < by_height_.size() && patch(by_height_[j]).box.low.y() <= patch(a).box.high.y() + reach; ++j) {
      const int b = by_height_[j];
      if (!patch(a).box.near(patch(b).box, reach)) continue;
      const std::vector<int>& near = neighbours_[static_cast<std::size_t>(a)];
      if (std::binary_search(near.begin(), near.end(), b) && smooth(patch(a), patch(b))) continue;
      pairs_.push_back(std::minmax(a, b));
    }
  }
}

const std::vector<std::pair<int, int>>& ClothPatches::find_near(const Points3& nodes, double reach) {
  measure(nodes);
  find_pairs(reach);
  near_.clear();
  const auto box_of = [this](int f) -> const TriangleBox& { return boxes_[static_cast<std::size_t>(f)]; };
  const auto collect = [&](const Patch& from, const TriangleBox& at, std::vector<int>& found) {
    found.clear();
    for (int k = from.begin; k < from.end; ++k)
      if (const int f = order_[static_cast<std::size_t>(k)]; box_of(f).near(at, reach)) found.push_back(f);
  };
  for (const auto& [a, b] : pairs_) {
    const Patch &pa = patches_[static_cast<std::size_t>(a)], &pb = patches_[static_cast<std::size_t>(b)];
    collect(pa, pb.box, near_a_);
    collect(pb, pa.box, near_b_);
    for (std::size_t i = 0; i < near_a_.size(); ++i)
      for (std::size_t j = a == b ? i + 1 : 0; j < near_b_.size(); ++j)
        if (box_of(near_a_[i]).near(box_of(near_b_[j]), reach)) near_.emplace_back(near_a_[i], near_b_[j]);
  }
  return near_;
}

}  // namespace toile
