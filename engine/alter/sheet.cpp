// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/sheet.h"

#include <algorithm>
#include <limits>
#include <map>
#include <span>

namespace toile {
namespace {

std::vector<Vec2> points_of(const std::vector<int>& vertices, const Points2& positions) {
  std::vector<Vec2> points;
  for (const int v : vertices) points.emplace_back(positions.row(v));
  return points;
}

void attach_sides(Sheet& sheet, int first_vertex) {
  for (std::size_t s = 0; s < sheet.sides.size(); ++s) {
    const std::vector<int>& outline = sheet.sides[s].vertices;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      SheetVertex& vertex = sheet.vertices[static_cast<std::size_t>(outline[i] - first_vertex)];
      SheetAnchor& free = vertex.anchors[vertex.anchors[0].side < 0 ? 0 : 1];
      free = {static_cast<int>(s), sheet.cloth_sides[s].at()[i], true};
    }
  }
}

// The folded cloth of darts and slits takes part, so that cloth on both sides of a mouth keeps its distance. A wedge
// that is turned over somewhere stays open.
void fill_wedges(Sheet& sheet, const Points2& cloth, int first_vertex) {
  for (const DartWedge& wedge : sheet.wedges) {
    std::vector<std::array<int, 3>> triangles = wedge_triangles(wedge, cloth);
    const auto flat = [&](int v) { return Vec2(cloth.row(v)); };
    const bool sound = std::all_of(triangles.begin(), triangles.end(), [&](const auto& t) {
      const Vec2 a = flat(t[1]) - flat(t[0]), b = flat(t[2]) - flat(t[0]);
      return a.x() * b.y() - a.y() * b.x() > 1e-4 * a.squaredNorm();
    });
    if (!sound) continue;
    for (std::array<int, 3>& triangle : triangles) {
      for (int& v : triangle) v -= first_vertex;
      sheet.faces.push_back(triangle);
      sheet.folded.push_back(true);
    }
  }
}

// The side a border edge lies on: shared by both ends and neighbouring on it.
int side_of_edge(const Sheet& sheet, int from, int to) {
  for (const SheetAnchor& a : sheet.vertices[static_cast<std::size_t>(from)].anchors) {
    if (a.side < 0) continue;
    for (const SheetAnchor& b : sheet.vertices[static_cast<std::size_t>(to)].anchors)
      if (b.side == a.side && b.at > a.at) return a.side;
  }
  return -1;
}

}  // namespace

Sheet make_sheet(const Pattern& pattern, const PatternMesh& mesh, const Points2& cloth, const Points2& wanted,
                 int panel, const Sheet* like) {
  Sheet sheet;
  sheet.panel = panel;
  sheet.wedges = like ? same_wedges(like->wedges, mesh, panel) : find_dart_wedges(pattern, mesh, panel);
  sheet.sides = like ? same_sides(like->sides, mesh, panel) : find_panel_sides(pattern, mesh, panel, sheet.wedges);
  for (const PanelSide& side : sheet.sides) {
    sheet.cloth_sides.emplace_back(points_of(side.vertices, cloth));
    sheet.wanted_sides.emplace_back(points_of(side.vertices, wanted));
  }
  const PanelRange& range = mesh.panels[static_cast<std::size_t>(panel)];
  for (int v = range.vertex_begin; v < range.vertex_end; ++v) {
    SheetVertex vertex;
    vertex.flat = cloth.row(v);
    vertex.guide = vertex.now = wanted.row(v);
    vertex.origin = v;
    sheet.vertices.push_back(vertex);
  }
  double edges = 0.0;
  for (int f = range.triangle_begin; f < range.triangle_end; ++f) {
    const std::array<int, 3> face = {mesh.triangles(f, 0) - range.vertex_begin,
                                     mesh.triangles(f, 1) - range.vertex_begin,
                                     mesh.triangles(f, 2) - range.vertex_begin};
    sheet.faces.push_back(face);
    for (std::size_t i = 0; i < 3; ++i)
      edges += (sheet.vertices[static_cast<std::size_t>(face[i])].flat -
                sheet.vertices[static_cast<std::size_t>(face[(i + 1) % 3])].flat)
                   .norm();
  }
  sheet.edge_length = edges / std::max<double>(1.0, 3.0 * static_cast<double>(sheet.faces.size()));
  sheet.folded.assign(sheet.faces.size(), false);
  fill_wedges(sheet, cloth, range.vertex_begin);
  attach_sides(sheet, range.vertex_begin);
  return sheet;
}

std::vector<BorderEdge> border_edges(const Sheet& sheet) {
  // Where the edges that leave a vertex lead to, vertex by vertex.
  std::vector<int> begin(sheet.vertices.size() + 1, 0), ends(3 * sheet.faces.size());
  for (const auto& face : sheet.faces)
    for (const int v : face) ++begin[static_cast<std::size_t>(v) + 1];
  for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
  std::vector<int> next(begin.begin(), begin.end() - 1);
  for (const auto& face : sheet.faces)
    for (std::size_t i = 0; i < 3; ++i)
      ends[static_cast<std::size_t>(next[static_cast<std::size_t>(face[i])]++)] = face[(i + 1) % 3];
  const auto leaving = [&](int v) {
    const auto i = static_cast<std::size_t>(v);
    return std::span<int>(ends).subspan(static_cast<std::size_t>(begin[i]),
                                        static_cast<std::size_t>(begin[i + 1] - begin[i]));
  };
  std::vector<BorderEdge> border;
  for (int from = 0; from < sheet.vertex_count(); ++from) {
    const std::span<int> to = leaving(from);
    std::sort(to.begin(), to.end());
    for (const int v : to) {
      const std::span<int> back = leaving(v);
      if (std::find(back.begin(), back.end(), from) == back.end())
        border.push_back({from, v, side_of_edge(sheet, from, v)});
    }
  }
  return border;
}

std::vector<std::vector<BorderEdge>> border_loops(const Sheet& sheet) {
  const std::vector<BorderEdge> border = border_edges(sheet);
  std::multimap<int, std::size_t> leaving;
  for (std::size_t i = 0; i < border.size(); ++i) leaving.emplace(border[i].from, i);
  std::vector<bool> used(border.size(), false);
  std::vector<std::vector<BorderEdge>> loops;
  for (std::size_t start = 0; start < border.size(); ++start) {
    if (used[start]) continue;
    std::vector<BorderEdge> loop;
    for (std::size_t i = start; !used[i];) {
      used[i] = true;
      loop.push_back(border[i]);
      const auto [begin, end] = leaving.equal_range(border[i].to);
      for (auto next = begin; next != end; ++next)
        if (!used[next->second]) {
          i = next->second;
          break;
        }
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

Vec2 extent_of(const Sheet& sheet) {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const SheetVertex& vertex : sheet.vertices) {
    low = low.cwiseMin(vertex.flat);
    high = high.cwiseMax(vertex.flat);
  }
  return high - low;
}

}  // namespace toile
