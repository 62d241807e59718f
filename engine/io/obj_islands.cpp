// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/obj_islands.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/core/error.h"
#include "engine/geometry/disjoint_sets.h"
#include "engine/io/garmentcode_json.h"

namespace toile {

namespace {

// Flat vertices of every triangle corner: equal position and equal texture number, or equal texture coordinates.
struct FlatVertices {
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> position, texture;

  FlatVertices(const ObjTextured& obj, bool by_coordinates) {
    const std::vector<int> same = by_coordinates ? first_of_equal(obj.texture) : std::vector<int>();
    std::map<std::pair<int, int>, int> number;
    for (const auto& corners : obj.triangles) {
      auto& triangle = triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const int t = same.empty() ? corners[k][1] : same[static_cast<std::size_t>(corners[k][1])];
        const auto [place, fresh] = number.emplace(std::pair(corners[k][0], t), static_cast<int>(position.size()));
        if (fresh) position.push_back(corners[k][0]), texture.push_back(t);
        triangle[k] = place->second;
      }
    }
  }

 private:
  static std::vector<int> first_of_equal(const std::vector<Vec2>& points) {
    std::map<std::pair<double, double>, int> first;
    std::vector<int> same;
    for (std::size_t i = 0; i < points.size(); ++i)
      same.push_back(first.emplace(std::pair(points[i].x(), points[i].y()), static_cast<int>(i)).first->second);
    return same;
  }
};

struct HalfEdge {
  int low, high, triangle;
  bool upward;  // runs from low to high
  auto operator<=>(const HalfEdge&) const = default;
};

std::vector<HalfEdge> sorted_half_edges(const std::vector<std::array<int, 3>>& triangles) {
  std::vector<HalfEdge> edges;
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = triangles[f][k], b = triangles[f][(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), static_cast<int>(f), a < b});
    }
  std::sort(edges.begin(), edges.end());
  return edges;
}

bool same_edge(const HalfEdge& a, const HalfEdge& b) {
  return a.low == b.low && a.high == b.high;
}

std::pair<std::vector<int>, int> components(const std::vector<std::array<int, 3>>& triangles) {
  const auto edges = sorted_half_edges(triangles);
  DisjointSets sets(static_cast<int>(triangles.size()));
  for (std::size_t i = 1; i < edges.size(); ++i)
    if (same_edge(edges[i - 1], edges[i])) sets.join(edges[i - 1].triangle, edges[i].triangle);
  return sets.numbering();
}

class IslandBuilder {
 public:
  IslandBuilder(const ObjTextured& obj, const std::string& file) : obj_(obj), file_(file) {}

  ObjIslands build() {
    FlatVertices flat(obj_, false);
    auto [component, count] = components(flat.triangles);
    if (count > kMaxPanels) {  // some programs write texture coordinates anew for every face
      flat = FlatVertices(obj_, true);
      std::tie(component, count) = components(flat.triangles);
    }
    if (count > kMaxPanels)
      throw Error(ErrorCode::LimitExceeded, file_,
                  "the texture has " + std::to_string(count) + " islands, at most 200 panels are read; weld the mesh");
    split_by_component(flat, component, count);
    for (ObjIsland& island : result_.islands) finish(island);
    return std::move(result_);
  }

 private:
  // A flat vertex that two islands touch becomes one vertex for each.
  void split_by_component(const FlatVertices& flat, const std::vector<int>& component, int count) {
    std::vector<std::map<int, int>> number(static_cast<std::size_t>(count));
    result_.islands.resize(static_cast<std::size_t>(count));
    for (std::size_t f = 0; f < flat.triangles.size(); ++f) {
      const auto c = static_cast<std::size_t>(component[f]);
      ObjIsland& island = result_.islands[c];
      if (island.triangles.empty()) island.name = name_of(obj_.group_of_triangle[f], component[f]);
      auto& triangle = island.triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const auto v = static_cast<std::size_t>(flat.triangles[f][k]);
        const auto [place, fresh] = number[c].emplace(flat.triangles[f][k], static_cast<int>(result_.flat.size()));
        if (fresh) {
          result_.flat.push_back(obj_.texture[static_cast<std::size_t>(flat.texture[v])]);
          result_.position.push_back(flat.position[v]);
          result_.texture.push_back(flat.texture[v]);
          island.vertices.push_back(place->second);
        }
        triangle[k] = place->second;
      }
    }
  }

  std::string name_of(int group, int component) {
    std::string name = obj_.groups[static_cast<std::size_t>(group)];
    if (name.empty()) name = "island_" + std::to_string(component + 1);
    std::string unique = name;
    for (int i = 2; !names_.insert(unique).second; ++i) unique = name + "_" + std::to_string(i);
    return unique;
  }

  [[noreturn]] void refuse(const ObjIsland& island, const std::string& message) const {
    throw Error(ErrorCode::GarmentInvalid, file_, "panel \"" + island.name + "\": " + message);
  }

  void finish(ObjIsland& island) const {
    double area = 0.0;
    int turned = 0;
    for (const auto& t : island.triangles) {
      const Vec2 &a = point(t[0]), &b = point(t[1]), &c = point(t[2]);
      const double twice = (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
      if (twice == 0.0) refuse(island, "a face is flat in the texture; remove faces without area");
      area += twice;
      turned += twice < 0 ? 1 : 0;
    }
    if (turned != 0 && turned != static_cast<int>(island.triangles.size()))
      refuse(island, "the texture is folded over itself; unfold the panel in the pattern window and export again");
    island.clockwise = area < 0;
    island.outline = outline(island);
  }

  const Vec2& point(int v) const { return result_.flat[static_cast<std::size_t>(v)]; }

  std::vector<int> outline(const ObjIsland& island) const {
    const auto edges = sorted_half_edges(island.triangles);
    std::map<int, int> next;
    for (std::size_t i = 0; i < edges.size();) {
      std::size_t j = i + 1;
      while (j < edges.size() && same_edge(edges[i], edges[j])) ++j;
      if (j - i > 2 || (j - i == 2 && edges[i].upward == edges[i + 1].upward))
        refuse(island,
               "faces do not join as a cloth does (an edge with more than two faces, or faces of both turns); "
               "export the garment without thickness");
      if (j - i == 1) {
        const int from = edges[i].upward ? edges[i].low : edges[i].high;
        if (!next.emplace(from, edges[i].upward ? edges[i].high : edges[i].low).second)
          refuse(island, "the outline touches itself in one point; separate the parts");
      }
      i = j;
    }
    if (next.empty()) refuse(island, "it has no outline; a panel must be flat");
    std::vector<int> loop;
    for (int v = next.begin()->first;;) {
      loop.push_back(v);
      v = next.at(v);
      if (v == loop.front()) break;
    }
    if (loop.size() != next.size())
      refuse(island, "it has a hole; panels with holes are not read, draw the hole as a cut to the outline");
    return loop;
  }

  const ObjTextured& obj_;
  std::string file_;
  std::set<std::string> names_;
  ObjIslands result_;
};

}  // namespace

ObjIslands find_islands(const ObjTextured& obj, const std::string& name) {
  return IslandBuilder(obj, name).build();
}

}  // namespace toile
