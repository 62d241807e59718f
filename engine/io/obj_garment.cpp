// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/obj_garment.h"

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "engine/core/units.h"
#include "engine/geometry/disjoint_sets.h"
#include "engine/geometry/fit_curve.h"
#include "engine/geometry/flat_vectors.h"
#include "engine/io/garmentcode_json.h"
#include "engine/io/obj_sidecar.h"

namespace toile {

namespace {

constexpr double kMeet = 5e-5;            // m; borders nearer than this in 3D are one place
constexpr double kFlat = 1e-3;            // m; positions thinner than this are no drape
constexpr double kUnitMatch = 1.25;       // factor within which a measured unit is taken for mm, cm or m
constexpr double kUsualExtent = 0.9;      // m; of garments: decides between units when nothing else does
constexpr double kStandOff = 0.03;        // m; between a placed panel and the farthest point of its drape
constexpr double kStraight = 1e-4;        // m; an edge this near to its chord is a line
constexpr double kCurveTolerance = 2e-4;  // m; an edge this near to a cubic Bézier is one
constexpr std::array<double, 3> kUnits = {1e-3, 1e-2, 1.0};

struct Units {
  double metre_per_uv = 0.0, metre_per_position = 0.0;
};

Vec3 extent_of(const std::vector<Vec3>& points) {
  Vec3 low = points.front(), high = points.front();
  for (const Vec3& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return high - low;
}

double nearest_unit(double measured) {
  return *std::min_element(kUnits.begin(), kUnits.end(), [&](double a, double b) {
    return std::abs(std::log(measured / a)) < std::abs(std::log(measured / b));
  });
}

bool matches(double measured, double unit) {
  return std::abs(std::log(measured / unit)) < std::log(kUnitMatch);
}

// Cloth hardly stretches: the areas of the faces in space and in the texture tell one unit from the other.
Units find_units(const ObjTextured& obj, const std::string& name, std::optional<double> metre_per_uv) {
  double area = 0.0, flat_area = 0.0;
  for (const auto& t : obj.triangles) {
    const auto position = [&](std::size_t k) { return obj.positions[static_cast<std::size_t>(t[k][0])]; };
    const auto texture = [&](std::size_t k) { return obj.texture[static_cast<std::size_t>(t[k][1])]; };
    area += 0.5 * (position(1) - position(0)).cross(position(2) - position(0)).norm();
    const Vec2 u = texture(1) - texture(0), v = texture(2) - texture(0);
    flat_area += 0.5 * std::abs(u.x() * v.y() - u.y() * v.x());
  }
  if (!(area > 0 && flat_area > 0))
    throw Error(ErrorCode::GarmentInvalid, name, "the faces or their texture have no area; export the garment again");
  const double position_per_uv = std::sqrt(area / flat_area);
  const double extent = extent_of(obj.positions).maxCoeff();
  Units best;
  for (const double unit : kUnits) {
    if (metre_per_uv && nearest_unit(*metre_per_uv / position_per_uv) != unit) continue;
    if (!metre_per_uv && !matches(unit * position_per_uv, nearest_unit(unit * position_per_uv))) continue;
    const double off = std::abs(std::log(extent * unit / kUsualExtent));
    if (best.metre_per_uv > 0 && off >= std::abs(std::log(extent * best.metre_per_position / kUsualExtent))) continue;
    best = {metre_per_uv.value_or(nearest_unit(unit * position_per_uv)), unit};
  }
  if (best.metre_per_uv > 0) return best;
  throw Error(
      ErrorCode::GarmentInvalid, name,
      "the texture coordinates are not in millimetres, centimetres or metres of the cloth (one texture unit is " +
          std::to_string(position_per_uv) + " units of the positions); export UVs to scale, or give --uv-unit");
}

class Assembler {
 public:
  Assembler(const ObjTextured& obj, const ObjIslands& islands, const OutlineEdges& edges, const Units& units)
      : obj_(obj), islands_(islands), edges_(edges), units_(units) {}

  Pattern pattern() const {
    Pattern pattern;
    for (std::size_t p = 0; p < islands_.islands.size(); ++p) {
      Panel panel;
      panel.name = islands_.islands[p].name;
      for (const auto& vertices : edges_.edge_vertices[p]) {
        panel.corners.push_back(flat(vertices.front()));
        panel.edges.emplace_back();
        panel.edges.back().curve = edge_shape(vertices);
      }
      pattern.panels.push_back(std::move(panel));
    }
    pattern.seams = edges_.seams;
    return pattern;
  }

  PatternMesh mesh() const {
    PatternMesh mesh;
    std::vector<int> number(islands_.flat.size());
    mesh.rest.resize(static_cast<Eigen::Index>(islands_.flat.size()), 2);
    mesh.triangles.resize(static_cast<Eigen::Index>(obj_.triangles.size()), 3);
    int vertex = 0, triangle = 0;
    for (std::size_t p = 0; p < islands_.islands.size(); ++p) {
      const ObjIsland& island = islands_.islands[p];
      const PanelRange begin{vertex, 0, triangle, 0};
      for (const int v : island.vertices) {
        number[static_cast<std::size_t>(v)] = vertex;
        mesh.rest.row(vertex++) = flat(v).transpose();
        mesh.panel_of_vertex.push_back(static_cast<int>(p));
      }
      for (const auto& t : island.triangles) {
        const int second = island.clockwise ? 2 : 1;  // counter-clockwise in the panel plane, whatever the outside
        mesh.triangles.row(triangle++) << number[static_cast<std::size_t>(t[0])],
            number[static_cast<std::size_t>(t[static_cast<std::size_t>(second)])],
            number[static_cast<std::size_t>(t[static_cast<std::size_t>(3 - second)])];
        mesh.panel_of_triangle.push_back(static_cast<int>(p));
      }
      mesh.panels.push_back({begin.vertex_begin, vertex, begin.triangle_begin, triangle});
      mesh.panel_reversed.push_back(island.clockwise);
      mesh.edge_vertices.push_back(edges_.edge_vertices[p]);
      for (auto& edge : mesh.edge_vertices.back())
        for (int& v : edge) v = number[static_cast<std::size_t>(v)];
    }
    sew(mesh, number);
    mesh.target_edge_length = mean_edge_length(mesh.rest, mesh.triangles);
    return mesh;
  }

  // Every node in the middle of the positions that are sewn into it.
  Drape drape(const PatternMesh& mesh) const {
    Drape drape;
    drape.nodes = Points3::Zero(mesh.node_count, 3);
    std::vector<int> members(static_cast<std::size_t>(mesh.node_count), 0);
    int vertex = 0;
    for (const ObjIsland& island : islands_.islands)
      for (const int v : island.vertices) {
        const int node = mesh.node_of_vertex[static_cast<std::size_t>(vertex++)];
        drape.nodes.row(node) += position(v).transpose();
        ++members[static_cast<std::size_t>(node)];
      }
    for (int n = 0; n < mesh.node_count; ++n) drape.nodes.row(n) /= members[static_cast<std::size_t>(n)];
    return drape;
  }

  // Each panel flat before its draped place, on the outside, clear of everything it covers.
  void place(Pattern& pattern) const {
    for (std::size_t p = 0; p < islands_.islands.size(); ++p) {
      const ObjIsland& island = islands_.islands[p];
      Vec2 flat_centre = Vec2::Zero();
      Vec3 centre = Vec3::Zero();
      for (const int v : island.vertices) flat_centre += flat(v), centre += position(v);
      flat_centre /= static_cast<double>(island.vertices.size());
      centre /= static_cast<double>(island.vertices.size());
      Mat3 covariance = Mat3::Zero();
      for (const int v : island.vertices) {
        const Vec2 f = flat(v) - flat_centre;
        covariance += (position(v) - centre) * Vec3(f.x(), f.y(), 0).transpose();
      }
      const Eigen::JacobiSVD<Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
      Mat3 keep = Mat3::Identity();
      keep(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant();
      Panel& panel = pattern.panels[p];
      panel.rotation = svd.matrixU() * keep * svd.matrixV().transpose();
      const Vec3 outward = panel.rotation.col(2) * (island.clockwise ? -1.0 : 1.0);
      double farthest = 0.0;
      for (const int v : island.vertices) farthest = std::max(farthest, outward.dot(position(v) - centre));
      panel.translation =
          centre + (farthest + kStandOff) * outward - panel.rotation * Vec3(flat_centre.x(), flat_centre.y(), 0);
    }
  }

 private:
  Vec2 flat(int v) const { return islands_.flat[static_cast<std::size_t>(v)] * units_.metre_per_uv; }
  Vec3 position(int v) const {
    return obj_.positions[static_cast<std::size_t>(islands_.position[static_cast<std::size_t>(v)])] *
           units_.metre_per_position;
  }

  EdgeCurve edge_shape(const std::vector<int>& vertices) const {
    Curve line{flat(vertices.front()), flat(vertices.back()), {}};
    std::vector<Vec2> points;
    std::vector<double> walked = {0.0};
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      walked.push_back(walked.back() + (flat(vertices[i]) - flat(vertices[i - 1])).norm());
      if (i + 1 < vertices.size()) points.push_back(flat(vertices[i]));
    }
    const bool closed = (line.end - line.start).norm() < kStraight;
    if (!closed && fit_curve(line, points, {}).deviation <= kStraight) return line.shape;
    if (!closed && points.size() >= 3) {
      std::vector<double> parameters;
      for (std::size_t i = 0; i < points.size(); ++i) parameters.push_back(walked[i + 1] / walked.back());
      const CurveFit fit = fit_curve(as_cubic(line), points, parameters);
      if (fit.deviation <= kCurveTolerance) return fit.curve.shape;
    }
    line.shape.kind = CurveKind::Polyline;
    line.shape.points = points;
    return line.shape;
  }

  void sew(PatternMesh& mesh, const std::vector<int>& number) const {
    DisjointSets nodes(mesh.vertex_count());
    std::vector<int> first_at(obj_.positions.size(), -1);
    for (std::size_t v = 0; v < islands_.flat.size(); ++v) {
      int& first = first_at[static_cast<std::size_t>(islands_.position[v])];
      if (first < 0)
        first = number[v];
      else
        nodes.join(first, number[v]);
    }
    for (const Seam& seam : edges_.seams) {
      const auto& a =
          mesh.edge_vertices[static_cast<std::size_t>(seam.a.panel.value)][static_cast<std::size_t>(seam.a.edge)];
      const auto& b =
          mesh.edge_vertices[static_cast<std::size_t>(seam.b.panel.value)][static_cast<std::size_t>(seam.b.edge)];
      if (a.size() != b.size())
        throw Error(ErrorCode::SeamInvalid,
                    "panel:" + islands_.islands[static_cast<std::size_t>(seam.a.panel.value)].name,
                    "the two sides of a seam have different numbers of vertices; weld the mesh and export again");
      auto& pairs = mesh.seam_vertices.emplace_back();
      for (std::size_t i = 0; i < a.size(); ++i) {
        pairs.emplace_back(a[i], seam.right_wrong ? b[i] : b[b.size() - 1 - i]);
        nodes.join(pairs.back().first, pairs.back().second);
      }
    }
    std::tie(mesh.node_of_vertex, mesh.node_count) = nodes.numbering();
  }

  const ObjTextured& obj_;
  const ObjIslands& islands_;
  const OutlineEdges& edges_;
  Units units_;
};

void require_whole_triangles(const PatternMesh& mesh, const std::string& name) {
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const auto n = mesh.nodes_of_triangle(f);
    if (n[0] == n[1] || n[1] == n[2] || n[2] == n[0])
      throw Error(ErrorCode::GarmentInvalid, name,
                  "a face has two corners at one place in space; remove faces without area and export again");
  }
}

}  // namespace

ObjGarment read_obj_garment(std::span<const std::uint8_t> bytes, const std::string& name,
                            const ObjGarmentOptions& options) {
  const ObjTextured obj = read_textured_obj(bytes, name);
  const ObjIslands islands = find_islands(obj, name);
  const Units units = find_units(obj, name, options.metre_per_uv_unit);
  const bool draped = extent_of(obj.positions).minCoeff() * units.metre_per_position > kFlat;
  BorderSegments borders = border_segments(islands);
  std::vector<NamedSeam> named;
  if (draped) {
    if (!options.sidecar.empty() && sidecar_names_seams(options.sidecar))
      throw Error(ErrorCode::SeamInvalid, "/seams",
                  "the garment is draped, its seams are where its borders meet; remove the seams of the sidecar");
    find_mates(obj, islands, kMeet / units.metre_per_position, borders);
  } else if (!options.sidecar.empty()) {
    named = apply_sidecar_seams(options.sidecar, islands, borders);
  }
  OutlineEdges edges = cut_outlines(islands, borders);
  for (const NamedSeam& seam : named)
    edges.seams.push_back({edges.side_of_segment[static_cast<std::size_t>(seam.a)],
                           edges.side_of_segment[static_cast<std::size_t>(seam.b)], seam.right_wrong});
  const Assembler assembler(obj, islands, edges, units);
  ObjGarment garment;
  garment.pattern = assembler.pattern();
  if (draped) {
    garment.mesh = assembler.mesh();
    require_whole_triangles(*garment.mesh, name);
    garment.drape = assembler.drape(*garment.mesh);
    assembler.place(garment.pattern);
  }
  if (!options.sidecar.empty()) apply_sidecar_panels(options.sidecar, garment.pattern);
  return garment;
}

}  // namespace toile
