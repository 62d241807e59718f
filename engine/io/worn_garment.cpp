// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/worn_garment.h"

#include <algorithm>

#include "engine/core/error.h"
#include "engine/core/units.h"
#include "engine/geometry/curve.h"
#include "engine/geometry/flat_vectors.h"
#include "engine/geometry/half_edges.h"
#include "engine/geometry/inner_point.h"
#include "engine/geometry/triangle_gradient.h"
#include "engine/io/obj_islands.h"

namespace toile {
namespace {

constexpr double kOnOutline = 1e-3;  // m: of the border to the drawn outline
constexpr double kFlatness = 1e-4;   // m

class WornReader {
 public:
  WornReader(const ObjTextured& obj, const std::string& name, const Pattern& pattern)
      : obj_(obj), name_(name), pattern_(pattern) {}

  WornGarment read() {
    take_vertices();
    take_triangles();
    for (std::size_t p = 0; p < pattern_.panels.size(); ++p) take_outline(p);
    sew();
    worn_.mesh.target_edge_length = mean_edge_length(worn_.mesh.rest, worn_.mesh.triangles);
    for (const Vec3& p : obj_.positions) worn_.drape.nodes.row(node_++) = p.transpose();
    worn_.wanted = obj_.wanted;
    return std::move(worn_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(ErrorCode::GarmentInvalid, name_,
                what + "; hand in the target_pattern.json and target_worn.obj of one alteration together");
  }

  void take_vertices() {
    PatternMesh& mesh = worn_.mesh;
    const auto count = obj_.texture.size();
    mesh.rest.resize(static_cast<Eigen::Index>(count), 2);
    for (std::size_t v = 0; v < count; ++v)
      mesh.rest.row(static_cast<Eigen::Index>(v)) = obj_.texture[v].transpose() * kMetrePerCm;
    mesh.panel_of_vertex.assign(count, -1);
    mesh.node_of_vertex.assign(count, -1);
    mesh.node_count = static_cast<int>(obj_.positions.size());
    worn_.drape.nodes.resize(mesh.node_count, 3);
  }

  // Faces come panel by panel, and so do the vertices they name.
  void take_triangles() {
    PatternMesh& mesh = worn_.mesh;
    if (obj_.groups.size() != pattern_.panels.size()) refuse("it has other panels than the pattern");
    mesh.panels.resize(pattern_.panels.size());
    mesh.triangles.resize(static_cast<Eigen::Index>(obj_.triangles.size()), 3);
    int last = -1;
    for (int f = 0; f < static_cast<int>(obj_.triangles.size()); ++f) {
      const int p = obj_.group_of_triangle[static_cast<std::size_t>(f)];
      if (p != last && p != last + 1) refuse("its faces are not in the order of the panels");
      PanelRange& range = mesh.panels[static_cast<std::size_t>(p)];
      if (p != last) range.triangle_begin = f;
      range.triangle_end = f + 1;
      last = p;
      take_triangle(f, p);
    }
    if (last + 1 != static_cast<int>(pattern_.panels.size())) refuse("a panel of the pattern has no faces");
    take_ranges();
  }

  void take_triangle(int f, int p) {
    PatternMesh& mesh = worn_.mesh;
    const auto& corners = obj_.triangles[static_cast<std::size_t>(f)];
    for (int k = 0; k < 3; ++k) {
      const auto [position, texture] = corners[static_cast<std::size_t>(k)];
      int &panel = mesh.panel_of_vertex[static_cast<std::size_t>(texture)],
          &node = mesh.node_of_vertex[static_cast<std::size_t>(texture)];
      if ((panel >= 0 && panel != p) || (node >= 0 && node != position))
        refuse("a texture coordinate belongs to two panels or two places");
      panel = p;
      node = position;
      mesh.triangles(f, k) = texture;
    }
    mesh.panel_of_triangle.push_back(p);
    const double area = doubled_area(mesh.rest, mesh.triangles, f);
    if (!(area != 0.0)) refuse("a face has no area in its panel");
    if (static_cast<int>(mesh.panel_reversed.size()) == p) mesh.panel_reversed.push_back(area < 0.0);
    if (mesh.panel_reversed[static_cast<std::size_t>(p)] != (area < 0.0)) refuse("a panel is folded over itself");
    if (area < 0.0) std::swap(mesh.triangles(f, 1), mesh.triangles(f, 2));
  }

  void take_ranges() {
    PatternMesh& mesh = worn_.mesh;
    int last = -1;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      const int p = mesh.panel_of_vertex[static_cast<std::size_t>(v)];
      if (p < 0 || (p != last && p != last + 1)) refuse("its texture coordinates are not in the order of the panels");
      PanelRange& range = mesh.panels[static_cast<std::size_t>(p)];
      if (p != last) range.vertex_begin = v;
      range.vertex_end = v + 1;
      last = p;
    }
    std::vector<bool> used(static_cast<std::size_t>(mesh.node_count), false);
    for (const int node : mesh.node_of_vertex) used[static_cast<std::size_t>(node)] = true;
    if (std::find(used.begin(), used.end(), false) != used.end()) refuse("a position belongs to no face");
  }

  // The border of a panel's faces, counter-clockwise.
  std::vector<int> border_of(const PanelRange& range) const {
    const Triangles own =
        worn_.mesh.triangles.middleRows(range.triangle_begin, range.triangle_end - range.triangle_begin);
    for (Eigen::Index f = 0; f < own.rows(); ++f)
      if (own(f, 0) == own(f, 1) || own(f, 1) == own(f, 2) || own(f, 2) == own(f, 0)) refuse("a face has no area");
    const HalfEdges edges = find_half_edges(own);
    const SurfaceDefects defects = find_defects(worn_.mesh.vertex_count(), own);
    if (defects.tangled_edges + defects.twisted_edges + defects.pinched_vertices > 0)
      refuse("the faces of a panel do not join as a cloth does");
    const auto loops = boundary_loops(own, edges);
    if (loops.size() != 1) refuse("a panel is in several pieces or has a hole");
    return loops[0];
  }

  void take_outline(std::size_t p) {
    PatternMesh& mesh = worn_.mesh;
    const Panel& panel = pattern_.panels[p];
    std::vector<int> border = border_of(mesh.panels[p]);
    if (outline_signed_area(panel) < 0.0) std::reverse(border.begin(), border.end());
    const std::vector<Vec2> outline = flatten_outline(panel, kFlatness);
    for (const int v : border)
      if (distance_to_polygon(outline, mesh.rest.row(v)) > kOnOutline)
        refuse("panel \"" + panel.name + "\" has another outline");
    std::vector<std::size_t> at;  // both corners of a collapsed edge are one vertex
    for (const Vec2& corner : panel.corners) {
      const auto off = [&](int v) { return (mesh.rest.row(v).transpose() - corner).squaredNorm(); };
      const auto nearest =
          std::min_element(border.begin(), border.end(), [&](int i, int k) { return off(i) < off(k); });
      at.push_back(static_cast<std::size_t>(nearest - border.begin()));
    }
    auto& edges = mesh.edge_vertices.emplace_back();
    std::size_t walked = 0;
    for (std::size_t e = 0; e < at.size(); ++e) {
      std::vector<int>& edge = edges.emplace_back();
      const std::size_t end = at[(e + 1) % at.size()];
      for (std::size_t i = at[e];; i = (i + 1) % border.size()) {
        edge.push_back(border[i]);
        if (i == end) break;
      }
      walked += edge.size() - 1;
    }
    if (walked != border.size()) refuse("the corners of panel \"" + panel.name + "\" are in another order");
  }

  void sew() {
    PatternMesh& mesh = worn_.mesh;
    const auto along = [&](const SeamSide& side) -> const std::vector<int>& {
      return mesh.edge_vertices[static_cast<std::size_t>(side.panel.value)][static_cast<std::size_t>(side.edge)];
    };
    for (const Seam& seam : pattern_.seams) {
      const std::vector<int>&a = along(seam.a), &b = along(seam.b);
      if (a.size() != b.size()) refuse("the sides of a seam have different numbers of vertices");
      auto& pairs = mesh.seam_vertices.emplace_back();
      for (std::size_t i = 0; i < a.size(); ++i) {
        pairs.emplace_back(a[i], seam.right_wrong ? b[i] : b[b.size() - 1 - i]);
        if (mesh.node_of_vertex[static_cast<std::size_t>(pairs.back().first)] !=
            mesh.node_of_vertex[static_cast<std::size_t>(pairs.back().second)])
          refuse("a seam of the pattern is open");
      }
    }
  }

  const ObjTextured& obj_;
  const std::string& name_;
  const Pattern& pattern_;
  WornGarment worn_;
  Eigen::Index node_ = 0;
};

}  // namespace

WornGarment read_worn_garment(std::span<const std::uint8_t> bytes, const std::string& name, const Pattern& pattern) {
  const ObjTextured obj = read_textured_obj(bytes, name);
  return WornReader(obj, name, pattern).read();
}

}  // namespace toile
