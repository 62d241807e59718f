// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/triangulate.h"

#include <deque>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "engine/core/error.h"

namespace toile {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;

constexpr int kUnvisited = -1;

[[noreturn]] void refuse() {
  throw Error(ErrorCode::GarmentInvalid, "outline",
              "parts of an outline cross or touch each other; move the corners or curve points apart");
}

Cdt build(const std::vector<Vec2>& points, const std::vector<std::array<int, 2>>& segments) {
  Cdt cdt;
  std::vector<std::pair<Kernel::Point_2, int>> numbered;
  numbered.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    numbered.emplace_back(Kernel::Point_2(points[i].x(), points[i].y()), static_cast<int>(i));
  cdt.insert(numbered.begin(), numbered.end());
  if (cdt.number_of_vertices() != points.size()) refuse();
  std::vector<Cdt::Vertex_handle> handles(points.size());
  for (auto v = cdt.finite_vertices_begin(); v != cdt.finite_vertices_end(); ++v)
    handles[static_cast<std::size_t>(v->info())] = v;
  try {
    for (const auto& [a, b] : segments)
      cdt.insert_constraint(handles[static_cast<std::size_t>(a)], handles[static_cast<std::size_t>(b)]);
  } catch (const Cdt::Intersection_of_constraints_exception&) {
    refuse();
  }
  return cdt;
}

// info() of a face becomes the number of constraints crossed on the way in from infinity.
void mark_nesting(Cdt& cdt) {
  for (auto f = cdt.all_faces_begin(); f != cdt.all_faces_end(); ++f) f->info() = kUnvisited;
  std::deque<Cdt::Face_handle> queue = {cdt.infinite_face()};
  cdt.infinite_face()->info() = 0;
  while (!queue.empty()) {
    const Cdt::Face_handle face = queue.front();
    queue.pop_front();
    for (int i = 0; i < 3; ++i) {
      const Cdt::Face_handle next = face->neighbor(i);
      if (next->info() != kUnvisited) continue;
      const bool wall = cdt.is_constrained({face, i});
      next->info() = face->info() + (wall ? 1 : 0);
      // Faces of the same level first: the level is then the least number of walls.
      wall ? queue.push_back(next) : queue.push_front(next);
    }
  }
}

}  // namespace

Triangles triangulate(const std::vector<Vec2>& points, const std::vector<std::array<int, 2>>& segments) {
  Cdt cdt = build(points, segments);
  mark_nesting(cdt);
  std::vector<std::array<int, 3>> inside;
  for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f)
    if (f->info() % 2 == 1) inside.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
  Triangles triangles(static_cast<Eigen::Index>(inside.size()), 3);
  for (std::size_t i = 0; i < inside.size(); ++i)
    for (int k = 0; k < 3; ++k) triangles(static_cast<Eigen::Index>(i), k) = inside[i][static_cast<std::size_t>(k)];
  return triangles;
}

}  // namespace toile
