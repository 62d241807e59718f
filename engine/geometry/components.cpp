// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/components.h"

#include <algorithm>
#include <numeric>

namespace toile {
namespace {

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

int root(std::vector<int>& parent, int i) {
  while (parent[at(i)] != i) {
    parent[at(i)] = parent[at(parent[at(i)])];
    i = parent[at(i)];
  }
  return i;
}

}  // namespace

Vec3 triangle_cross(const TriangleMesh& mesh, int f) {
  const Vec3 a = mesh.vertices.row(mesh.triangles(f, 0));
  const Vec3 b = mesh.vertices.row(mesh.triangles(f, 1));
  const Vec3 c = mesh.vertices.row(mesh.triangles(f, 2));
  return (b - a).cross(c - a);
}

MeshComponents find_components(const TriangleMesh& mesh) {
  std::vector<int> parent(at(mesh.vertex_count()));
  std::iota(parent.begin(), parent.end(), 0);
  for (int f = 0; f < mesh.triangle_count(); ++f)
    for (int k = 1; k < 3; ++k) {
      const int a = root(parent, mesh.triangles(f, 0)), b = root(parent, mesh.triangles(f, k));
      if (a != b) parent[at(std::max(a, b))] = std::min(a, b);
    }

  std::vector<int> number(at(mesh.vertex_count()), -1);
  MeshComponents found;
  found.of_triangle.resize(at(mesh.triangle_count()));
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    int& c = number[at(root(parent, mesh.triangles(f, 0)))];
    if (c < 0) c = static_cast<int>(found.area.size()), found.area.push_back(0.0);
    found.of_triangle[at(f)] = c;
    found.area[at(c)] += 0.5 * triangle_cross(mesh, f).norm();
  }

  std::vector<int> order(found.area.size()), rank(found.area.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return found.area[at(a)] > found.area[at(b)]; });
  for (std::size_t i = 0; i < order.size(); ++i) rank[at(order[i])] = static_cast<int>(i);
  for (int& c : found.of_triangle) c = rank[at(c)];
  std::sort(found.area.begin(), found.area.end(), std::greater<>());
  return found;
}

TriangleMesh extract_triangles(const TriangleMesh& mesh, const std::vector<bool>& keep) {
  std::vector<int> number(at(mesh.vertex_count()), -1);
  int kept = 0, used = 0;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    if (!keep[at(f)]) continue;
    ++kept;
    for (int k = 0; k < 3; ++k) number[at(mesh.triangles(f, k))] = 0;
  }
  for (int& n : number)
    if (n == 0) n = used++;
  TriangleMesh out;
  out.vertices.resize(used, 3);
  out.triangles.resize(kept, 3);
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (number[at(v)] >= 0) out.vertices.row(number[at(v)]) = mesh.vertices.row(v);
  for (int f = 0, g = 0; f < mesh.triangle_count(); ++f) {
    if (!keep[at(f)]) continue;
    for (int k = 0; k < 3; ++k) out.triangles(g, k) = number[at(mesh.triangles(f, k))];
    ++g;
  }
  return out;
}

}  // namespace toile
