// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/position_index.h"
#include "engine/io/byte_reader.h"
#include "engine/io/mesh_builder.h"
#include "engine/io/mesh_readers.h"
#include "engine/io/text_scanner.h"

namespace toile {

namespace {

constexpr std::size_t kHeaderBytes = 84;    // 80 of text, 4 of count
constexpr std::size_t kTriangleBytes = 50;  // normal, three corners, two bytes of attributes

// Gives corners their vertex numbers as they come.
class CornerWelder {
 public:
  CornerWelder(MeshBuilder& builder) : builder_(builder) {}

  template <class Place>
  void add_corner(double x, double y, double z, Place&& place) {
    const std::int32_t before = positions_.count();
    // Not a number would never equal itself: the builder refuses it before it can reach the table.
    if (!(x - x == 0 && y - y == 0 && z - z == 0)) builder_.add_vertex(x, y, z, place);
    const std::int32_t index = positions_.add({x, y, z});
    if (index == before) builder_.add_vertex(x, y, z, place);
    corners_[filled_++] = index;
  }

  template <class Place>
  void close_facet(Place&& place) {
    if (filled_ != 3)
      builder_.fail(place(),
                    "a facet has " + std::to_string(filled_) + " corners instead of three; export the file again");
    builder_.add_polygon(corners_, place);
    filled_ = 0;
  }

  std::size_t filled() const { return filled_; }

 private:
  MeshBuilder& builder_;
  PositionIndex positions_;
  std::array<std::int64_t, 3> corners_{};
  std::size_t filled_ = 0;
};

void read_binary(std::span<const std::uint8_t> bytes, const std::string& name, MeshBuilder& builder) {
  ByteReader reader(bytes, kHeaderBytes - 4, false, name);
  std::size_t start = 0;  // of the corner or triangle at hand
  const auto place = [&] { return "byte " + std::to_string(start); };
  const std::int64_t count = reader.read<std::uint32_t>();
  builder.expect_triangles(count, "byte 80");
  if (static_cast<std::uint64_t>(count) > reader.remaining() / kTriangleBytes)
    builder.fail("byte 80", std::to_string(count) + " triangles are announced, but only " +
                                std::to_string(reader.remaining()) +
                                " bytes follow; the file is cut short, copy or export it again");
  CornerWelder welder(builder);
  for (std::int64_t i = 0; i < count; ++i) {
    reader.skip(12);
    for (int k = 0; k < 3; ++k) {
      start = reader.offset();
      const float x = reader.read<float>(), y = reader.read<float>(), z = reader.read<float>();
      welder.add_corner(x, y, z, place);
    }
    reader.skip(2);
    welder.close_facet(place);
  }
}

void read_ascii(std::span<const std::uint8_t> bytes, const std::string& name, MeshBuilder& builder) {
  TextScanner scanner(bytes, name);
  const auto place = [&] { return "line " + std::to_string(scanner.line()); };
  CornerWelder welder(builder);
  std::string_view word;
  while (scanner.next_line()) {
    if (!scanner.next_word(word)) continue;
    if (word == "vertex") {
      if (welder.filled() == 3) scanner.fail("a facet has more than three corners; export the file again");
      const double x = scanner.number("x"), y = scanner.number("y"), z = scanner.number("z");
      welder.add_corner(x, y, z, place);
    } else if (word == "endfacet") {
      welder.close_facet(place);
    }
  }
  if (welder.filled() > 0) scanner.fail("the file ends inside a facet; it is cut short, copy or export it again");
}

}  // namespace

bool has_binary_stl_size(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kHeaderBytes) return false;
  ByteReader reader(bytes, kHeaderBytes - 4, false, {});
  return bytes.size() == kHeaderBytes + std::size_t{reader.read<std::uint32_t>()} * kTriangleBytes;
}

TriangleMesh read_stl(std::span<const std::uint8_t> bytes, const std::string& name, const MeshLimits& limits) {
  MeshBuilder builder(name, limits);
  const bool ascii = !has_binary_stl_size(bytes) && (looks_like_text(bytes) || bytes.size() < kHeaderBytes);
  ascii ? read_ascii(bytes, name, builder) : read_binary(bytes, name, builder);
  return builder.finish();
}

}  // namespace toile
