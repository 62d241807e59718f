// SPDX-License-Identifier: GPL-3.0-or-later
// Collects vertices and polygons from a parser and keeps every limit while it does.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/io/mesh_file.h"

namespace toile {

// `place` in the calls is where the parser stands ("line 12", "byte 840"); it goes into the error message.
class MeshBuilder {
 public:
  MeshBuilder(std::string subject, const MeshLimits& limits) : subject_(std::move(subject)), limits_(limits) {}

  // Announced counts, before anything is read; throws Error{LimitExceeded}.
  void expect_vertices(std::int64_t count, const std::string& place);
  void expect_triangles(std::int64_t count, const std::string& place);

  template <class Place>
  void add_vertex(double x, double y, double z, Place&& place) {
    if (!within_limit(x) || !within_limit(y) || !within_limit(z)) refuse_coordinate(place());
    if (vertex_count() >= limits_.vertices) refuse_vertices(vertex_count() + 1, place());
    coordinates_.insert(coordinates_.end(), {x, y, z});
  }

  // Zero-based corner indices, at least three; they may name vertices that follow later.
  template <class Place>
  void add_polygon(std::span<const std::int64_t> corners, Place&& place) {
    if (corners.size() < 3) fail(place(), "a face needs at least three corners; export the file again");
    if (triangle_count() + static_cast<std::int64_t>(corners.size()) - 2 > limits_.triangles)
      refuse_triangles(triangle_count() + static_cast<std::int64_t>(corners.size()) - 2, place());
    for (const std::int64_t corner : corners)
      if (corner < 0 || corner > largest_index_) note_index(corner, place());
    for (std::size_t i = 2; i < corners.size(); ++i)
      for (const std::int64_t corner : {corners[0], corners[i - 1], corners[i]})
        indices_.push_back(static_cast<std::int32_t>(corner));
  }

  std::int64_t vertex_count() const { return static_cast<std::int64_t>(coordinates_.size() / 3); }
  std::int64_t triangle_count() const { return static_cast<std::int64_t>(indices_.size() / 3); }

  // Checks what only the whole file can tell, and moves the mesh out.
  TriangleMesh finish();

  [[noreturn]] void fail(const std::string& place, const std::string& message) const;

 private:
  bool within_limit(double x) const { return x >= -limits_.coordinate && x <= limits_.coordinate; }  // false for NaN
  void note_index(std::int64_t index, const std::string& place);
  [[noreturn]] void refuse_coordinate(const std::string& place) const;
  [[noreturn]] void refuse_vertices(std::int64_t count, const std::string& place) const;
  [[noreturn]] void refuse_triangles(std::int64_t count, const std::string& place) const;

  std::string subject_;
  MeshLimits limits_;
  std::vector<double> coordinates_;
  std::vector<std::int32_t> indices_;
  std::int64_t largest_index_ = -1;
  std::string place_of_largest_;
};

}  // namespace toile
