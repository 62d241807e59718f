// SPDX-License-Identifier: GPL-3.0-or-later
#include <bit>
#include <charconv>
#include <string_view>

#include "engine/io/mesh_file.h"

namespace toile {

namespace {

class ByteWriter {
 public:
  void text(std::string_view words) { bytes_.insert(bytes_.end(), words.begin(), words.end()); }

  // Fixed notation with a point whatever the locale; micrometres for metres.
  void decimal(double value) {
    char buffer[400];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, 6).ptr;
    text({buffer, static_cast<std::size_t>(end - buffer)});
  }

  template <class T>
  void little_endian(T value) {
    std::uint64_t bits = 0;
    if constexpr (std::is_same_v<T, float>)
      bits = std::bit_cast<std::uint32_t>(value);
    else
      bits = static_cast<std::uint64_t>(value);
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes_.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
  }

  void point(const Vec3& p) {
    for (int k = 0; k < 3; ++k) little_endian(static_cast<float>(p[k]));
  }

  Bytes take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

Vec3 vertex(const TriangleMesh& mesh, int triangle, int corner) {
  return mesh.vertices.row(mesh.triangles(triangle, corner)).transpose();
}

}  // namespace

Bytes write_obj(const TriangleMesh& mesh) {
  ByteWriter out;
  for (int i = 0; i < mesh.vertex_count(); ++i) {
    out.text("v");
    for (int k = 0; k < 3; ++k) out.text(" "), out.decimal(mesh.vertices(i, k));
    out.text("\n");
  }
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    out.text("f");
    for (int k = 0; k < 3; ++k) out.text(" "), out.text(std::to_string(mesh.triangles(f, k) + 1));
    out.text("\n");
  }
  return out.take();
}

Bytes write_ply(const TriangleMesh& mesh) {
  ByteWriter out;
  out.text("ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertex_count()) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
           std::to_string(mesh.triangle_count()) + "\nproperty list uchar int vertex_indices\nend_header\n");
  for (int i = 0; i < mesh.vertex_count(); ++i) out.point(mesh.vertices.row(i).transpose());
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    out.little_endian(std::uint8_t{3});
    for (int k = 0; k < 3; ++k) out.little_endian(mesh.triangles(f, k));
  }
  return out.take();
}

Bytes write_stl(const TriangleMesh& mesh) {
  ByteWriter out;
  std::string header = "binary STL";
  header.resize(80, ' ');
  out.text(header);
  out.little_endian(static_cast<std::uint32_t>(mesh.triangle_count()));
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const Vec3 a = vertex(mesh, f, 0), b = vertex(mesh, f, 1), c = vertex(mesh, f, 2);
    out.point((b - a).cross(c - a).stableNormalized());
    for (const Vec3& p : {a, b, c}) out.point(p);
    out.little_endian(std::uint16_t{0});
  }
  return out.take();
}

}  // namespace toile
