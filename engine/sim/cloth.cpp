// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/cloth.h"

#include <cmath>

#include "engine/core/error.h"
#include "engine/core/units.h"
#include "engine/sim/bending.h"

namespace toile {
namespace {

struct Element {
  Eigen::Vector3i nodes;
  Mat2 inverse;  // Dm^-1 in the grain's frame: columns give Fu, Fv
  double area;
};

// Rotation that takes panel coordinates to (weft, warp) coordinates.
Mat2 grain_frame(const Panel& panel) {
  if (!panel.grainline) return Mat2::Identity();
  const Vec2 warp = ((*panel.grainline)[1] - (*panel.grainline)[0]).normalized();
  if (!warp.allFinite() || warp.squaredNorm() == 0) return Mat2::Identity();
  Mat2 frame;
  frame << warp.y(), -warp.x(), warp.x(), warp.y();
  return frame;
}

std::vector<Element> elements_of(const Pattern& pattern, const PatternMesh& mesh) {
  std::vector<Element> elements;
  elements.reserve(static_cast<std::size_t>(mesh.triangle_count()));
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const Eigen::Vector3i nodes = mesh.nodes_of_triangle(f);
    if (nodes[0] == nodes[1] || nodes[1] == nodes[2] || nodes[2] == nodes[0]) continue;
    const Panel& panel = pattern.panels[static_cast<std::size_t>(mesh.panel_of_triangle[static_cast<std::size_t>(f)])];
    const Vec2 a = mesh.rest.row(mesh.triangles(f, 0));
    Mat2 edges;
    edges.col(0) = mesh.rest.row(mesh.triangles(f, 1)).transpose() - a;
    edges.col(1) = mesh.rest.row(mesh.triangles(f, 2)).transpose() - a;
    const double area = 0.5 * edges.determinant();
    if (!(area > 0))
      throw Error(ErrorCode::GarmentInvalid, "panel:" + panel.name,
                  "a triangle of its mesh has no area or is reversed; mesh the panel again");
    elements.push_back({nodes, (grain_frame(panel) * edges).inverse(), area});
  }
  return elements;
}

void append_element(std::vector<TriangleBlock>& blocks, const Element& e, int index) {
  const auto lane = static_cast<std::size_t>(index % kLanes);
  if (lane == 0) {
    TriangleBlock block;  // every lane starts as this triangle without area
    for (std::size_t k = 0; k < 3; ++k) block.node[k].fill(e.nodes[static_cast<Eigen::Index>(k)]);
    block.u1.setConstant(e.inverse(0, 0)), block.u2.setConstant(e.inverse(1, 0));
    block.v1.setConstant(e.inverse(0, 1)), block.v2.setConstant(e.inverse(1, 1));
    block.area.setZero();
    blocks.push_back(block);
  }
  TriangleBlock& block = blocks.back();
  for (std::size_t k = 0; k < 3; ++k) block.node[k][lane] = e.nodes[static_cast<Eigen::Index>(k)];
  const auto l = static_cast<Eigen::Index>(lane);
  block.u1[l] = e.inverse(0, 0), block.u2[l] = e.inverse(1, 0);
  block.v1[l] = e.inverse(0, 1), block.v2[l] = e.inverse(1, 1);
  block.area[l] = e.area;
}

double mean_edge_length(const PatternMesh& mesh) {
  double sum = 0;
  for (int f = 0; f < mesh.triangle_count(); ++f)
    for (int k = 0; k < 3; ++k)
      sum += (mesh.rest.row(mesh.triangles(f, k)) - mesh.rest.row(mesh.triangles(f, (k + 1) % 3))).norm();
  return mesh.triangle_count() > 0 ? sum / (3 * mesh.triangle_count()) : 0.0;
}

}  // namespace

int Cloth::whole_node_count() const {
  return half ? 2 * node_count - static_cast<int>(middle.size()) : node_count;
}

double Cloth::mean_node_weight() const {
  const double area = (half ? 2 : 1) * node_area.sum();
  return node_count > 0 ? fabric.density * kGravity * area / whole_node_count() : 0.0;
}

void Cloth::hold_middle(Points3& rows) const {
  for (const int i : middle) rows(i, 0) = 0;
}

Cloth make_cloth(const Pattern& pattern, const PatternMesh& mesh) {
  Cloth cloth;
  cloth.fabric = pattern.fabric;
  cloth.node_count = mesh.node_count;
  cloth.node_area.setZero(mesh.node_count);
  for (const Element& e : elements_of(pattern, mesh)) {
    append_element(cloth.blocks, e, cloth.triangle_count++);
    for (int k = 0; k < 3; ++k) cloth.node_area[e.nodes[k]] += e.area / 3;
  }
  cloth.mean_edge = mean_edge_length(mesh);
  cloth.bending = bending_matrix(pattern, mesh);
  return cloth;
}

}  // namespace toile
