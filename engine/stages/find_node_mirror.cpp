// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/find_node_mirror.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/stages/garment_mirrors.h"

namespace toile {
namespace {

constexpr double kSameVertex = 5e-5;  // m
constexpr double kStartOff = 0.01;    // m rms
constexpr double kOverlap = 0.015;    // m
constexpr double kApart = 2e-4;       // m, of the middle

// Swept by height, so that few vertices are compared.
bool mirrored(const Points3& surface) {
  std::vector<Eigen::Index> by_height(static_cast<std::size_t>(surface.rows()));
  std::iota(by_height.begin(), by_height.end(), 0);
  std::sort(by_height.begin(), by_height.end(), [&](Eigen::Index a, Eigen::Index b) {
    return std::make_pair(surface(a, 1), a) < std::make_pair(surface(b, 1), b);
  });
  const auto has_image = [&](Eigen::Index i) {
    const Vec3 wanted(-surface(i, 0), surface(i, 1), surface(i, 2));
    auto at = std::lower_bound(by_height.begin(), by_height.end(), wanted.y() - kSameVertex,
                               [&](Eigen::Index v, double y) { return surface(v, 1) < y; });
    for (; at != by_height.end() && surface(*at, 1) <= wanted.y() + kSameVertex; ++at)
      if ((surface.row(*at).transpose() - wanted).norm() <= kSameVertex) return true;
    return false;
  };
  return std::all_of(by_height.begin(), by_height.end(), has_image);
}

// Of all vertices of a node the same, and there and back.
std::optional<std::vector<int>> node_images(const PatternMesh& mesh, const GarmentMirrors& mirrors) {
  if (mirrors.empty()) return {};
  std::vector<int> image(static_cast<std::size_t>(mesh.node_count), -1);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const int w = mirrors.vertex[static_cast<std::size_t>(v)];
    if (w < 0) return {};
    int& there = image[static_cast<std::size_t>(mesh.node_of_vertex[static_cast<std::size_t>(v)])];
    const int found = mesh.node_of_vertex[static_cast<std::size_t>(w)];
    if (there >= 0 && there != found) return {};
    there = found;
  }
  for (std::size_t i = 0; i < image.size(); ++i)
    if (image[i] < 0 || image[static_cast<std::size_t>(image[i])] != static_cast<int>(i)) return {};
  return image;
}

// By where the panels that have others for images are worn.
std::vector<int> node_sides(const PatternMesh& mesh, const GarmentMirrors& mirrors, const std::vector<int>& image,
                            const Points3& worn) {
  std::vector<int> sides(image.size(), 0);
  for (std::size_t p = 0; p < mirrors.panels.size(); ++p) {
    if (mirrors.panels[p].panel == static_cast<int>(p)) continue;
    const auto node_of = [&](int v) { return mesh.node_of_vertex[static_cast<std::size_t>(v)]; };
    double sum = 0;
    for (int v = mesh.panels[p].vertex_begin; v < mesh.panels[p].vertex_end; ++v) sum += worn(node_of(v), 0);
    for (int v = mesh.panels[p].vertex_begin; v < mesh.panels[p].vertex_end; ++v) {
      const auto n = static_cast<std::size_t>(node_of(v));
      if (image[n] != node_of(v)) sides[n] = sum < 0 ? -1 : 1;
    }
  }
  return sides;
}

}  // namespace

std::optional<NodeMirror> find_node_mirror(const Pattern& pattern, const PatternMesh& mesh, const Cloth& cloth,
                                           const Points3& surface, const Points3& start) {
  if (!mirrored(surface)) return {};
  Drape worn;
  worn.nodes = start;
  const GarmentMirrors mirrors = find_garment_mirrors(pattern, mesh, worn);
  const auto image = node_images(mesh, mirrors);
  if (!image) return {};
  const NodeMirror mirror{*image, node_sides(mesh, mirrors, *image, start)};
  Points3 symmetric = start;
  symmetrise(mirror, symmetric);
  if ((symmetric - start).norm() > kStartOff * std::sqrt(static_cast<double>(start.rows()))) return {};
  if (!pulls_alike(cloth, mirror, symmetric)) return {};
  return mirror;
}

bool part_sides(const NodeMirror& mirror, Points3& nodes) {
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    const int side = mirror.side[static_cast<std::size_t>(i)];
    if (side * nodes(i, 0) < -kOverlap) return false;
    if (side * nodes(i, 0) < kApart && side != 0) nodes(i, 0) = side * kApart;
  }
  return true;
}

}  // namespace toile
