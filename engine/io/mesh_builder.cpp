// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/mesh_builder.h"

#include "engine/core/error.h"

namespace toile {

namespace {
std::string limit_text(const char* what, std::int64_t count, std::int64_t limit) {
  return std::string(what) + ": " + std::to_string(count) + ", more than the " + std::to_string(limit) +
         " that are read; decimate the mesh and send it again";
}
}  // namespace

void MeshBuilder::expect_vertices(std::int64_t count, const std::string& place) {
  if (count < 0) fail(place, "a negative number of vertices; export the file again");
  if (count > limits_.vertices) refuse_vertices(count, place);
}

void MeshBuilder::expect_triangles(std::int64_t count, const std::string& place) {
  if (count < 0) fail(place, "a negative number of faces; export the file again");
  if (count > limits_.triangles) refuse_triangles(count, place);
}

void MeshBuilder::fail(const std::string& place, const std::string& message) const {
  throw Error(ErrorCode::FileMalformed, subject_, place + ": " + message);
}

void MeshBuilder::refuse_coordinate(const std::string& place) const {
  fail(place, "a coordinate is not a finite number within " +
                  std::to_string(static_cast<std::int64_t>(limits_.coordinate)) +
                  " of zero; remove stray points and move the mesh to the origin");
}

void MeshBuilder::refuse_vertices(std::int64_t count, const std::string& place) const {
  throw Error(ErrorCode::LimitExceeded, subject_, place + ": " + limit_text("vertices", count, limits_.vertices));
}

void MeshBuilder::refuse_triangles(std::int64_t count, const std::string& place) const {
  throw Error(ErrorCode::LimitExceeded, subject_, place + ": " + limit_text("triangles", count, limits_.triangles));
}

void MeshBuilder::note_index(std::int64_t index, const std::string& place) {
  if (index < 0) fail(place, "a face names a vertex of negative number; export the file again");
  if (index >= limits_.vertices)
    fail(place, "a face names vertex " + std::to_string(index + 1) + ", which cannot exist; export the file again");
  largest_index_ = index;
  place_of_largest_ = place;
}

TriangleMesh MeshBuilder::finish() {
  if (largest_index_ >= vertex_count())
    fail(place_of_largest_, "a face names vertex " + std::to_string(largest_index_ + 1) + " (counted from 1) of " +
                                std::to_string(vertex_count()) + "; the file is cut short or broken, export it again");
  if (indices_.empty())
    throw Error(ErrorCode::FileMalformed, subject_,
                "no triangles in " + std::to_string(vertex_count()) +
                    " points; export the surface as a mesh, not as a cloud of points");
  TriangleMesh mesh;
  mesh.vertices = Eigen::Map<const Points3>(coordinates_.data(), vertex_count(), 3);
  mesh.triangles = Eigen::Map<const Triangles>(indices_.data(), triangle_count(), 3);
  return mesh;
}

}  // namespace toile
