// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/mesh_slicer.h"

#include <algorithm>
#include <numeric>

#include "engine/geometry/convex_hull.h"

namespace toile {
namespace {

constexpr int kBins = 512;  // a body's slice then looks at ~1.5 times the triangles it cuts

struct EdgeEnd {
  std::uint64_t edge;  // both vertices of the mesh edge that a segment ends on
  int segment;
};

int root(std::vector<int>& parent, int i) {
  while (parent[static_cast<std::size_t>(i)] != i) {
    int& up = parent[static_cast<std::size_t>(i)];
    up = parent[static_cast<std::size_t>(up)];
    i = up;
  }
  return i;
}

void join(std::vector<int>& parent, int a, int b) {
  a = root(parent, a), b = root(parent, b);
  if (a != b) parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
}

void add_segment(SliceComponent& c, const std::array<Vec2, 2>& s) {
  c.segments.push_back(s);
  c.low = c.low.cwiseMin(s[0]).cwiseMin(s[1]);
  c.high = c.high.cwiseMax(s[0]).cwiseMax(s[1]);
}

// Crossing of edge (i, j) with the level; i < j so that both triangles of the edge find the same point.
Vec2 crossing(const Points3& v, int i, int j, double y) {
  if (i > j) std::swap(i, j);
  const double t = (y - v(i, 1)) / (v(j, 1) - v(i, 1));
  return {v(i, 0) + t * (v(j, 0) - v(i, 0)), v(i, 2) + t * (v(j, 2) - v(i, 2))};
}

bool boxes_near(const SliceComponent& a, const SliceComponent& b, double within) {
  return ((a.low.array() <= b.high.array() + within) && (b.low.array() <= a.high.array() + within)).all();
}

void merge_near(std::vector<SliceComponent>& components, double within) {
  for (bool merged = true; merged;) {
    merged = false;
    for (std::size_t i = 0; i < components.size(); ++i)
      for (std::size_t j = components.size(); j-- > i + 1;) {
        if (!boxes_near(components[i], components[j], within)) continue;
        components[i].add(components[j]);
        components.erase(components.begin() + static_cast<std::ptrdiff_t>(j));
        merged = true;
      }
  }
}

double box_size(const SliceComponent& c) {
  return (c.high - c.low).sum();
}

}  // namespace

std::vector<Vec2> SliceComponent::points(double x_low, double x_high) const {
  std::vector<Vec2> out;
  for (const auto& s : segments) {
    for (const Vec2& p : s)
      if (p.x() >= x_low && p.x() <= x_high) out.push_back(p);
    for (const double x : {x_low, x_high})
      if ((s[0].x() < x) != (s[1].x() < x)) {
        const double t = (x - s[0].x()) / (s[1].x() - s[0].x());
        out.emplace_back(x, s[0].y() + t * (s[1].y() - s[0].y()));
      }
  }
  return out;
}

void SliceComponent::add(const SliceComponent& other) {
  segments.insert(segments.end(), other.segments.begin(), other.segments.end());
  low = low.cwiseMin(other.low);
  high = high.cwiseMax(other.high);
}

double SliceComponent::hull_girth() const {
  return hull_perimeter(points());
}

MeshSlicer::MeshSlicer(const TriangleMesh& mesh) : mesh_(mesh) {
  const auto y = mesh.vertices.col(1);
  if (mesh.vertex_count() > 0) bottom_ = y.minCoeff(), top_ = y.maxCoeff();
  bin_height_ = std::max(top_ - bottom_, 1e-12) / kBins;
  const auto bin_of = [&](double h) { return std::clamp(static_cast<int>((h - bottom_) / bin_height_), 0, kBins - 1); };
  std::vector<std::array<int, 2>> bins(static_cast<std::size_t>(mesh.triangle_count()));
  bin_begin_.assign(kBins + 1, 0);
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const auto t = mesh.triangles.row(f);
    const double a = y[t[0]], b = y[t[1]], c = y[t[2]];
    auto& range = bins[static_cast<std::size_t>(f)];
    range = {bin_of(std::min({a, b, c})), bin_of(std::max({a, b, c}))};
    for (int i = range[0]; i <= range[1]; ++i) ++bin_begin_[static_cast<std::size_t>(i) + 1];
  }
  std::partial_sum(bin_begin_.begin(), bin_begin_.end(), bin_begin_.begin());
  bin_triangles_.resize(static_cast<std::size_t>(bin_begin_.back()));
  std::vector<int> next(bin_begin_.begin(), bin_begin_.end() - 1);
  for (int f = 0; f < mesh.triangle_count(); ++f)
    for (int i = bins[static_cast<std::size_t>(f)][0]; i <= bins[static_cast<std::size_t>(f)][1]; ++i)
      bin_triangles_[static_cast<std::size_t>(next[static_cast<std::size_t>(i)]++)] = f;
}

std::span<const int> MeshSlicer::triangles_near(double y) const {
  if (y < bottom_ || y > top_) return {};
  const auto bin = static_cast<std::size_t>(std::clamp(static_cast<int>((y - bottom_) / bin_height_), 0, kBins - 1));
  return std::span(bin_triangles_)
      .subspan(static_cast<std::size_t>(bin_begin_[bin]),
               static_cast<std::size_t>(bin_begin_[bin + 1] - bin_begin_[bin]));
}

std::vector<SliceComponent> MeshSlicer::slice(double y, double merge_within) const {
  const Points3& v = mesh_.vertices;
  std::vector<std::array<Vec2, 2>> segments;
  std::vector<EdgeEnd> ends;
  for (const int f : triangles_near(y)) {
    const auto t = mesh_.triangles.row(f);
    const bool above[3] = {v(t[0], 1) >= y, v(t[1], 1) >= y, v(t[2], 1) >= y};
    if (above[0] == above[1] && above[1] == above[2]) continue;
    std::array<Vec2, 2> segment;
    int count = 0;
    for (int e = 0; e < 3; ++e) {
      const int i = t[e], j = t[(e + 1) % 3];
      if (above[e] == above[(e + 1) % 3]) continue;
      segment[static_cast<std::size_t>(count++)] = crossing(v, i, j, y);
      const auto low = static_cast<std::uint64_t>(std::min(i, j)), high = static_cast<std::uint64_t>(std::max(i, j));
      ends.push_back({low << 32 | high, static_cast<int>(segments.size())});
    }
    segments.push_back(segment);
  }

  std::sort(ends.begin(), ends.end(), [](const EdgeEnd& a, const EdgeEnd& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.segment < b.segment;
  });
  std::vector<int> parent(segments.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t i = 1; i < ends.size(); ++i)
    if (ends[i].edge == ends[i - 1].edge) join(parent, ends[i].segment, ends[i - 1].segment);

  std::vector<int> component_of(segments.size(), -1);
  std::vector<SliceComponent> components;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    int& c = component_of[static_cast<std::size_t>(root(parent, static_cast<int>(i)))];
    if (c < 0) c = static_cast<int>(components.size()), components.emplace_back();
    add_segment(components[static_cast<std::size_t>(c)], segments[i]);
  }
  if (merge_within >= 0.0) merge_near(components, merge_within);
  std::stable_sort(components.begin(), components.end(),
                   [](const SliceComponent& a, const SliceComponent& b) { return box_size(a) > box_size(b); });
  return components;
}

}  // namespace toile
