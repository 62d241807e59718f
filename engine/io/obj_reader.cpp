// SPDX-License-Identifier: GPL-3.0-or-later
#include <string_view>

#include "engine/io/mesh_builder.h"
#include "engine/io/mesh_readers.h"
#include "engine/io/text_scanner.h"

namespace toile {

namespace {

// The vertex of a face corner "v", "v/vt", "v//vn" or "v/vt/vn": counted from 1, or from the end when negative.
std::int64_t corner_vertex(const TextScanner& scanner, std::string_view corner, std::int64_t vertex_count) {
  const std::int64_t index = scanner.to_integer(corner.substr(0, corner.find('/')), "the vertex of a face");
  if (index == 0) scanner.fail("a face names vertex 0; OBJ counts from 1, export the file again");
  if (index < -vertex_count)
    scanner.fail("a face names vertex " + std::to_string(index) + " with only " + std::to_string(vertex_count) +
                 " before it; export the file again");
  return index > 0 ? index - 1 : vertex_count + index;
}

}  // namespace

TriangleMesh read_obj(std::span<const std::uint8_t> bytes, const std::string& name, const MeshLimits& limits) {
  TextScanner scanner(bytes, name, LineJoin::Backslash);
  MeshBuilder builder(name, limits);
  const auto place = [&] { return "line " + std::to_string(scanner.line()); };
  std::vector<std::int64_t> corners;
  std::string_view word;
  while (scanner.next_line()) {
    if (!scanner.next_word(word)) continue;
    if (word == "v") {
      const double x = scanner.number("x"), y = scanner.number("y"), z = scanner.number("z");
      builder.add_vertex(x, y, z, place);
    } else if (word == "f") {
      corners.clear();
      while (scanner.next_word(word) && !word.starts_with('#')) {
        corners.push_back(corner_vertex(scanner, word, builder.vertex_count()));
        if (static_cast<std::int64_t>(corners.size()) > limits.triangles + 2) break;  // refused by the builder
      }
      builder.add_polygon(corners, place);
    }
  }
  return builder.finish();
}

}  // namespace toile
