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
  find_nodes();
  find_neighbours();
  boxes_.resize(order_.size());
  by_height_.resize(patches_.size());
  std::iota(by_height_.begin(), by_height_.end(), 0);
  moved_.assign(patches_.size(), true);
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
    patches_.push_back({begin, end, panel, 0, 0, {}, Vec3::Zero(), 1, 0});
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

void ClothPatches::find_nodes() {
  corners_.resize(order_.size());
  for (Patch& patch : patches_) {
    patch.first_node = static_cast<int>(nodes_.size());
    for (int k = patch.begin; k < patch.end; ++k)
      for (int c = 0; c < 3; ++c) nodes_.push_back(triangles_(order_[static_cast<std::size_t>(k)], c));
    const auto first = nodes_.begin() + patch.first_node;
    std::sort(first, nodes_.end());
    nodes_.erase(std::unique(first, nodes_.end()), nodes_.end());
    patch.end_node = static_cast<int>(nodes_.size());
    for (int k = patch.begin; k < patch.end; ++k)
      for (int c = 0; c < 3; ++c) {
        const int node = triangles_(order_[static_cast<std::size_t>(k)], c);
        const auto place = std::lower_bound(nodes_.begin() + patch.first_node, nodes_.end(), node);
        corners_[static_cast<std::size_t>(k)][static_cast<std::size_t>(c)] = static_cast<int>(place - nodes_.begin());
      }
  }
  seen_.setZero(static_cast<Eigen::Index>(nodes_.size()), 3);
}

void ClothPatches::find_neighbours() {
  std::vector<std::pair<int, int>> patch_of_node;
  for (std::size_t p = 0; p < patches_.size(); ++p)
    for (int k = patches_[p].first_node; k < patches_[p].end_node; ++k)
      patch_of_node.emplace_back(nodes_[static_cast<std::size_t>(k)], static_cast<int>(p));
  std::sort(patch_of_node.begin(), patch_of_node.end());
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

void ClothPatches::find_moved(const Points3& nodes, double most) {
  moved_count_ = 0;
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    bool moved = !measured_;
    for (int k = patches_[p].first_node; k < patches_[p].end_node && !moved; ++k)
      moved = (nodes.row(nodes_[static_cast<std::size_t>(k)]) - seen_.row(k)).squaredNorm() >= most * most;
    moved_[p] = moved;
    moved_count_ += moved;
  }
  measured_ = true;
}

void ClothPatches::measure(Patch& patch, const Points3& nodes) {
  std::array<Vec3, kPatchSize> normals;
  for (int k = patch.first_node; k < patch.end_node; ++k) seen_.row(k) = nodes.row(nodes_[static_cast<std::size_t>(k)]);
  patch.box = {};
  patch.axis.setZero();
  for (int k = patch.begin; k < patch.end; ++k) {
    const std::array<int, 3>& corner = corners_[static_cast<std::size_t>(k)];
    const Vec3 a = seen_.row(corner[0]), b = seen_.row(corner[1]), c = seen_.row(corner[2]);
    TriangleBox& box = boxes_[static_cast<std::size_t>(k)];
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
  patch.cosine = std::clamp(cosine, -1.0, 1.0);
  patch.sine = std::sqrt(1 - patch.cosine * patch.cosine);
}

// Half the angle between the axes and both spreads together is below kSmooth; told by cosines.
bool ClothPatches::smooth(const Patch& a, const Patch& b) const {
  static const double least = std::cos(kSmooth), cosine = std::cos(2 * kSmooth), sine = std::sin(2 * kSmooth);
  if (a.cosine <= least || b.cosine <= least) return false;
  const double alike = side_[static_cast<std::size_t>(a.panel)] * side_[static_cast<std::size_t>(b.panel)];
  return alike * a.axis.dot(b.axis) >
         cosine * (a.cosine * b.cosine - a.sine * b.sine) + sine * (a.sine * b.cosine + a.cosine * b.sine);
}

// Whether two patches lie in one smooth piece of cloth: they are neighbours, or have some, all of them in it.
bool ClothPatches::together(int a, int b) const {
  if (!smooth(patch(a), patch(b))) return false;
  const std::vector<int>&near_a = neighbours_[static_cast<std::size_t>(a)],
        &near_b = neighbours_[static_cast<std::size_t>(b)];
  if (std::binary_search(near_a.begin(), near_a.end(), b)) return true;
  bool between = false;
  for (auto i = near_a.begin(), j = near_b.begin(); i != near_a.end() && j != near_b.end();) {
    if (*i != *j) {
      ++(*i < *j ? i : j);
      continue;
    }
    if (!smooth(patch(a), patch(*i)) || !smooth(patch(*i), patch(b))) return false;
    between = true;
    ++i, ++j;
  }
  return between;
}

void ClothPatches::leave_out(const std::vector<char>& triangles) {
  out_ = triangles;
  all_out_.assign(patches_.size(), true);
  for (std::size_t p = 0; p < patches_.size(); ++p)
    for (int k = patches_[p].begin; k < patches_[p].end; ++k)
      if (!out_[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])]) all_out_[p] = false;
}

void ClothPatches::add_pair(int a, int b, double reach) {
  if (!all_out_.empty() && all_out_[static_cast<std::size_t>(a)] && all_out_[static_cast<std::size_t>(b)]) return;
  if (!patch(a).box.near(patch(b).box, reach)) return;
  if (together(a, b)) return;
  found_.push_back({std::min(a, b), std::max(a, b), -1});
}

void ClothPatches::find_pairs(double reach) {
  found_.clear();
  const auto low = [&](int p) { return patch(p).box.low.y(); };
  std::sort(by_height_.begin(), by_height_.end(),
            [&](int a, int b) { return low(a) != low(b) ? low(a) < low(b) : a < b; });
  double tallest = 0;
  for (const Patch& p : patches_) tallest = std::max(tallest, p.box.high.y() - p.box.low.y());
  const auto moved = [&](int p) { return moved_[static_cast<std::size_t>(p)] != 0; };
  for (std::size_t i = 0; i < by_height_.size(); ++i) {
    const int a = by_height_[i];
    if (!moved(a)) continue;
    const bool out = !all_out_.empty() && all_out_[static_cast<std::size_t>(a)];
    if (!out && !smooth(patch(a), patch(a))) found_.push_back({a, a, -1});
    for (std::size_t j = i + 1; j < by_height_.size() && low(by_height_[j]) <= patch(a).box.high.y() + reach; ++j)
      add_pair(a, by_height_[j], reach);
    if (moved_count_ == static_cast<int>(patches_.size())) continue;
    for (std::size_t j = i; j-- > 0 && low(by_height_[j]) >= low(a) - reach - tallest;)
      if (!moved(by_height_[j])) add_pair(a, by_height_[j], reach);
  }
  std::sort(found_.begin(), found_.end(),
            [](const PatchPair& x, const PatchPair& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); });
}

void ClothPatches::add_near(const PatchPair& pair, double reach) {
  const auto box_of = [this](int k) -> const TriangleBox& { return boxes_[static_cast<std::size_t>(k)]; };
  const auto collect = [&](const Patch& from, const TriangleBox& at, std::vector<int>& found) {
    found.clear();
    for (int k = from.begin; k < from.end; ++k)
      if (box_of(k).near(at, reach)) found.push_back(k);
  };
  collect(patch(pair.a), patch(pair.b).box, near_a_);
  collect(patch(pair.b), patch(pair.a).box, near_b_);
  const auto triangle = [this](int k) { return order_[static_cast<std::size_t>(k)]; };
  const auto out = [&](int i, int j) {
    return !out_.empty() && out_[static_cast<std::size_t>(triangle(i))] && out_[static_cast<std::size_t>(triangle(j))];
  };
  for (std::size_t i = 0; i < near_a_.size(); ++i)
    for (std::size_t j = pair.a == pair.b ? i + 1 : 0; j < near_b_.size(); ++j)
      if (!out(near_a_[i], near_b_[j]) && box_of(near_a_[i]).near(box_of(near_b_[j]), reach))
        renewed_.emplace_back(triangle(near_a_[i]), triangle(near_b_[j]));
}

void ClothPatches::renew_near(double reach) {
  renewed_.clear(), merged_.clear();
  auto next = found_.begin();
  const auto take_found = [&](const PatchPair* before) {
    for (; next != found_.end() && (!before || std::pair(next->a, next->b) < std::pair(before->a, before->b)); ++next) {
      const std::size_t count = renewed_.size();
      add_near(*next, reach);
      merged_.push_back({next->a, next->b, static_cast<int>(renewed_.size() - count)});
    }
  };
  auto kept = near_.begin();
  for (const PatchPair& pair : pairs_) {
    const auto begin = kept;
    kept += pair.count;
    if (moved_[static_cast<std::size_t>(pair.a)] || moved_[static_cast<std::size_t>(pair.b)]) continue;
    take_found(&pair);
    renewed_.insert(renewed_.end(), begin, kept);
    merged_.push_back(pair);
  }
  take_found(nullptr);
  near_.swap(renewed_);
  pairs_.swap(merged_);
}

bool ClothPatches::update(const Points3& nodes, double reach, double wider) {
  find_moved(nodes, 0.5 * (wider - reach));
  if (moved_count_ == 0) return false;
  for (std::size_t p = 0; p < patches_.size(); ++p)
    if (moved_[p]) measure(patches_[p], nodes);
  find_pairs(wider);
  renew_near(wider);
  return true;
}

}  // namespace toile
