// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/render_views.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/render/palette.h"
#include "engine/render/png.h"

namespace toile {
namespace {

constexpr double kMarkDistance = 0.10;  // m between marked places

Surface body_surface(const TriangleMesh& body) {
  return {body.vertices, body.triangles, std::vector<Rgb>(static_cast<std::size_t>(body.triangles.rows()), kSkin), {}};
}

// Triangles in mesh order, corners as rows of `index_of_vertex`; panels whose right side faces -z are turned over.
Surface garment_surface(const PatternMesh& mesh, Points3 points, const std::vector<int>& index_of_vertex,
                        const FittingMap* map, double scale) {
  Surface surface{std::move(points), Triangles(mesh.triangle_count(), 3), {}, {}};
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const int panel = mesh.panel_of_triangle[static_cast<std::size_t>(f)];
    for (int k = 0; k < 3; ++k)
      surface.triangles(f, k) = index_of_vertex[static_cast<std::size_t>(mesh.triangles(f, k))];
    if (mesh.panel_reversed[static_cast<std::size_t>(panel)])
      std::swap(surface.triangles(f, 1), surface.triangles(f, 2));
    surface.colours.push_back(map ? stretch_colour(map->signed_stretch(f), scale) : panel_colour(panel));
  }
  for (const auto& panel : mesh.edge_vertices)
    for (const auto& edge : panel)
      for (std::size_t i = 0; i + 1 < edge.size(); ++i)
        surface.lines.emplace_back(index_of_vertex[static_cast<std::size_t>(edge[i])],
                                   index_of_vertex[static_cast<std::size_t>(edge[i + 1])]);
  return surface;
}

Points3 placed_vertices(const Pattern& pattern, const PatternMesh& mesh) {
  Points3 placed(mesh.vertex_count(), 3);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Panel& panel = pattern.panel(PanelId(mesh.panel_of_vertex[static_cast<std::size_t>(v)]));
    const Vec3 flat(mesh.rest(v, 0), mesh.rest(v, 1), 0.0);
    placed.row(v) = (panel.rotation * flat + panel.translation).transpose();
  }
  return placed;
}

// Signed stretch, or its difference from the reference, as a mean over each triangle's neighbours: one torn triangle
// is not a place where a garment pulls.
Eigen::VectorXd smoothed_stretch(const Surface& garment, const FittingMap& map, const FittingMap* reference) {
  const auto count = map.triangle_count();
  Eigen::VectorXd value(count), of_vertex(garment.vertices.rows()), weight(garment.vertices.rows());
  for (int f = 0; f < count; ++f) value[f] = map.signed_stretch(f) - (reference ? reference->signed_stretch(f) : 0.0);
  for (int round = 0; round < 2; ++round) {
    of_vertex.setZero(), weight.setZero();
    for (int f = 0; f < count; ++f) {
      if (map.degenerate[static_cast<std::size_t>(f)] || !std::isfinite(value[f])) continue;
      for (int k = 0; k < 3; ++k) {
        of_vertex[garment.triangles(f, k)] += map.rest_area[f] * value[f];
        weight[garment.triangles(f, k)] += map.rest_area[f];
      }
    }
    for (int f = 0; f < count; ++f) {
      double sum = 0.0;
      for (int k = 0; k < 3; ++k)
        sum += of_vertex[garment.triangles(f, k)] / std::max(1e-12, weight[garment.triangles(f, k)]);
      value[f] = sum / 3.0;
    }
  }
  return value;
}

// The largest values, each at least kMarkDistance from those before it.
std::vector<Mark> largest_stretches(const Surface& garment, const Eigen::VectorXd& value, int count) {
  std::vector<int> order(static_cast<std::size_t>(value.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return std::abs(value[a]) > std::abs(value[b]); });
  std::vector<Mark> marks;
  for (const int f : order) {
    if (static_cast<int>(marks.size()) >= count) break;
    const Vec3 a = garment.vertices.row(garment.triangles(f, 0)), b = garment.vertices.row(garment.triangles(f, 1)),
               c = garment.vertices.row(garment.triangles(f, 2));
    const Vec3 centre = (a + b + c) / 3.0;
    const bool apart = std::all_of(marks.begin(), marks.end(),
                                   [&](const Mark& m) { return (m.point - centre).norm() >= kMarkDistance; });
    if (apart) marks.push_back({centre, (b - a).cross(c - a).normalized(), print_text("%+.1f %%", 100 * value[f])});
  }
  return marks;
}

SheetOptions sheet_for(const std::vector<Surface>& surfaces, bool has_garment, const ViewOptions& options) {
  SheetOptions sheet;
  sheet.views = options.views;
  sheet.view_height = options.view_height;
  sheet.max_view_width = options.max_view_width;
  sheet.title = options.title;
  if (options.frame) {
    sheet.frame = *options.frame;
  } else {
    if (has_garment && options.framing == Framing::Garment) sheet.frame.add(surfaces.back().vertices);
    if (sheet.frame.empty())
      for (const Surface& surface : surfaces) sheet.frame.add(surface.vertices);
    if (!sheet.frame.empty()) sheet.frame.grow(std::max(1e-3, options.margin));
  }
  return sheet;
}

}  // namespace

Image draw_views(const TriangleMesh* body, const PatternMesh* mesh, const Drape* drape, const FittingMap* map,
                 const ViewOptions& options) {
  std::vector<Surface> surfaces;
  if (body) surfaces.push_back(body_surface(*body));
  const bool has_garment = mesh && drape;
  if (has_garment) {
    if (drape->nodes.rows() != mesh->node_count)
      throw Error(ErrorCode::Internal, "picture", "the drape does not belong to this pattern mesh");
    const bool same_mesh = !map || map->triangle_count() == mesh->triangle_count();
    if (!same_mesh || (map && options.reference && options.reference->triangle_count() != mesh->triangle_count()))
      throw Error(ErrorCode::Internal, "picture", "the fitting map does not belong to this pattern mesh");
    surfaces.push_back(garment_surface(*mesh, drape->nodes, mesh->node_of_vertex, map, options.stretch_scale));
  }
  SheetOptions sheet = sheet_for(surfaces, has_garment, options);
  if (has_garment && map) {
    if (options.legend) sheet.stretch_scale = options.stretch_scale;
    sheet.marks_drawn = options.marks;
    // Some places are hidden from all four sides: have others ready.
    if (options.marks > 0)
      sheet.marks = largest_stretches(surfaces.back(), smoothed_stretch(surfaces.back(), *map, options.reference),
                                      4 * options.marks);
  }
  return contact_sheet(surfaces, sheet);
}

Bytes render_views(const TriangleMesh* body, const PatternMesh* mesh, const Drape* drape, const FittingMap* map,
                   const ViewOptions& options) {
  return write_png(draw_views(body, mesh, drape, map, options));
}

Bytes render_placed_panels(const TriangleMesh* body, const Pattern& pattern, const PatternMesh& mesh,
                           const ViewOptions& options) {
  std::vector<Surface> surfaces;
  if (body) surfaces.push_back(body_surface(*body));
  std::vector<int> itself(static_cast<std::size_t>(mesh.vertex_count()));
  std::iota(itself.begin(), itself.end(), 0);
  surfaces.push_back(garment_surface(mesh, placed_vertices(pattern, mesh), itself, nullptr, options.stretch_scale));
  return write_png(contact_sheet(surfaces, sheet_for(surfaces, true, options)));
}

}  // namespace toile
