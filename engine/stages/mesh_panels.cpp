// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/mesh_panels.h"

#include <cmath>
#include <numeric>

#include "engine/geometry/curve.h"
#include "engine/geometry/disjoint_sets.h"
#include "engine/stages/mesh_panel.h"
#include "engine/stages/panel_boundary.h"
#include "engine/stages/panel_mirrors.h"

namespace toile {

namespace {

constexpr int kLeastTriangles = 500, kMostTriangles = 200'000;
constexpr double kMostEstimatedTriangles = 1e6;  // for a target edge length
constexpr double kBorderStrip = 0.62;  // of the edge length: measured width of the border strip without lattice points

struct PatternSize {
  double area = 0.0, perimeter = 0.0;  // m^2, m; of all panels
  int panels = 0;
  explicit PatternSize(const Pattern& pattern) : panels(static_cast<int>(pattern.panels.size())) {
    for (const Panel& panel : pattern.panels) {
      area += std::abs(outline_signed_area(panel));
      for (int e = 0; e < panel.edge_count(); ++e) perimeter += edge_length(panel, e);
    }
  }

  // Euler: a disc with N inner and B border vertices has 2 N + B - 2 triangles.
  double estimated_triangles(double h) const {
    const double inner_area = std::max(0.0, area - kBorderStrip * h * perimeter);
    return 2.0 * inner_area / (0.5 * std::sqrt(3.0) * h * h) + perimeter / h - 2.0 * panels;
  }

  double edge_length_for(double triangles) const {
    double low = 1e-6, high = 10.0;  // m
    for (int i = 0; i < 60; ++i) {
      const double middle = std::sqrt(low * high);
      (estimated_triangles(middle) > triangles ? low : high) = middle;
    }
    return std::sqrt(low * high);
  }
};

double target_edge_length(const PatternSize& size, const MeshPanelsOptions& options) {
  if (options.edge_length) {
    if (!(*options.edge_length > 0) || size.estimated_triangles(*options.edge_length) > kMostEstimatedTriangles)
      throw Error(ErrorCode::OptionInvalid, "options/edge_length",
                  "the target edge length must be positive and give at most 1,000,000 triangles; ask for a longer one");
    return *options.edge_length;
  }
  if (options.triangles < kLeastTriangles || options.triangles > kMostTriangles)
    throw Error(ErrorCode::OptionInvalid, "options/triangles", "must lie between 500 and 200000");
  return size.edge_length_for(options.triangles);
}

class PanelsMesher {
 public:
  PanelsMesher(const Pattern& pattern, double edge_length)
      : pattern_(pattern),
        h_(edge_length),
        mirrors_(find_panel_mirrors(pattern)),
        sampling_(pattern, mirrors_, edge_length),
        boundaries_(sample_boundaries(pattern, sampling_)) {}

  PatternMesh run(Progress* progress) {
    number_boundary();
    for (std::size_t p = 0; p < boundaries_.size(); ++p) {
      report(progress, "mesh_panels", static_cast<double>(p) / static_cast<double>(boundaries_.size()));
      meshes_.push_back(mesh_one(p));
      split_pinched_edges(meshes_.back(), sewn_labels(p));
    }
    PatternMesh mesh = assemble();
    report(progress, "mesh_panels", 1.0);
    return mesh;
  }

 private:
  // Boundary vertices of all panels, numbered one after another and joined where they are sewn.
  void number_boundary() {
    first_.push_back(0);
    for (const PanelBoundary& boundary : boundaries_)
      first_.push_back(first_.back() + static_cast<int>(boundary.points.size()));
    DisjointSets sewn(first_.back());
    for (const Seam& seam : pattern_.seams)
      for (const auto& [a, b] : pairs_of(seam))
        sewn.join(first_[static_cast<std::size_t>(seam.a.panel.value)] + a,
                  first_[static_cast<std::size_t>(seam.b.panel.value)] + b);
    sewn_as_ = sewn.numbering().first;
  }

  // Boundary vertices (numbers within their panels) that meet along a seam, from the start of side a.
  std::vector<std::pair<int, int>> pairs_of(const Seam& seam) const {
    const auto& a = vertices_of(seam.a);
    const auto& b = vertices_of(seam.b);
    std::vector<std::pair<int, int>> pairs;
    for (std::size_t i = 0; i < a.size(); ++i) pairs.emplace_back(a[i], seam.right_wrong ? b[i] : b[b.size() - 1 - i]);
    return pairs;
  }

  const std::vector<int>& vertices_of(const SeamSide& side) const {
    return boundaries_[static_cast<std::size_t>(side.panel.value)].edge_vertices[static_cast<std::size_t>(side.edge)];
  }

  std::vector<int> sewn_labels(std::size_t panel) const {
    return {sewn_as_.begin() + first_[panel], sewn_as_.begin() + first_[panel + 1]};
  }

  PolygonMesh mesh_one(std::size_t p) const {
    for (const PanelMirror& mirror : mirrors_.pairs[p]) {
      const auto source = static_cast<std::size_t>(mirror.source.value);
      // Pinched edges of the source are split already; a copy has the same.
      if (auto mesh = mirrored_mesh(boundaries_[p], mirror, boundaries_[source], meshes_[source]))
        return std::move(*mesh);
    }
    if (mirrors_.self[p])
      if (auto mesh = mesh_symmetric_panel(boundaries_[p], *mirrors_.self[p], h_)) return std::move(*mesh);
    return mesh_panel(boundaries_[p], h_);
  }

  PatternMesh assemble() const {
    PatternMesh mesh;
    mesh.target_edge_length = h_;
    int vertices = 0, triangles = 0;
    for (const PolygonMesh& part : meshes_) {
      const int v = static_cast<int>(part.points.size()), f = static_cast<int>(part.triangles.rows());
      mesh.panels.push_back({vertices, vertices + v, triangles, triangles + f});
      vertices += v, triangles += f;
    }
    mesh.rest.resize(vertices, 2);
    mesh.triangles.resize(triangles, 3);
    for (std::size_t p = 0; p < meshes_.size(); ++p) copy_panel(p, mesh);
    sew(mesh);
    return mesh;
  }

  void copy_panel(std::size_t p, PatternMesh& mesh) const {
    const PanelRange& range = mesh.panels[p];
    for (int v = range.vertex_begin; v < range.vertex_end; ++v)
      mesh.rest.row(v) = meshes_[p].points[static_cast<std::size_t>(v - range.vertex_begin)];
    mesh.triangles.middleRows(range.triangle_begin, range.triangle_end - range.triangle_begin) =
        meshes_[p].triangles.array() + range.vertex_begin;
    mesh.panel_of_vertex.resize(static_cast<std::size_t>(range.vertex_end), static_cast<int>(p));
    mesh.panel_of_triangle.resize(static_cast<std::size_t>(range.triangle_end), static_cast<int>(p));
    mesh.panel_reversed.push_back(boundaries_[p].signed_area < 0);
    mesh.edge_vertices.push_back(boundaries_[p].edge_vertices);
    for (auto& edge : mesh.edge_vertices.back())
      for (int& v : edge) v += range.vertex_begin;
  }

  void sew(PatternMesh& mesh) const {
    DisjointSets nodes(mesh.vertex_count());
    for (const Seam& seam : pattern_.seams) {
      mesh.seam_vertices.push_back(pairs_of(seam));
      for (auto& [a, b] : mesh.seam_vertices.back()) {
        a += mesh.panels[static_cast<std::size_t>(seam.a.panel.value)].vertex_begin;
        b += mesh.panels[static_cast<std::size_t>(seam.b.panel.value)].vertex_begin;
        nodes.join(a, b);
      }
    }
    std::tie(mesh.node_of_vertex, mesh.node_count) = nodes.numbering();
  }

  const Pattern& pattern_;
  double h_;
  PanelMirrors mirrors_;
  EdgeSampling sampling_;
  std::vector<PanelBoundary> boundaries_;
  std::vector<int> first_;    // per panel its first boundary vertex in the common numbering
  std::vector<int> sewn_as_;  // per boundary vertex the number of its sewn point
  std::vector<PolygonMesh> meshes_;
};

}  // namespace

PatternMesh mesh_panels(const Pattern& pattern, const MeshPanelsOptions& options, Progress* progress) {
  report(progress, "mesh_panels", 0.0);
  const PatternSize size(pattern);
  return PanelsMesher(pattern, target_edge_length(size, options)).run(progress);
}

}  // namespace toile
