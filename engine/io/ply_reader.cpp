// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/byte_reader.h"
#include "engine/io/mesh_builder.h"
#include "engine/io/mesh_readers.h"
#include "engine/io/ply_header.h"
#include "engine/io/text_scanner.h"

namespace toile {

namespace {

// Values of the body of an ASCII file: words, wherever the lines end.
class AsciiValues {
 public:
  AsciiValues(std::span<const std::uint8_t> bytes, const PlyHeader& header, const std::string& name)
      : scanner_(bytes, name), size_(bytes.size()) {
    for (int i = 0; i <= header.lines; ++i) scanner_.next_line();
  }
  double number(PlyType) { return scanner_.to_number(word(), "a value"); }
  std::int64_t integer(PlyType) { return scanner_.to_integer(word(), "a count or index"); }
  std::size_t remaining() const { return size_ - scanner_.offset(); }
  std::string place() const { return "line " + std::to_string(scanner_.line()); }
  std::size_t size_of(PlyType) const { return 1; }  // the least a value takes

 private:
  std::string_view word() {
    std::string_view found;
    while (!scanner_.next_word(found))
      if (!scanner_.next_line())
        scanner_.fail("the file ends here although more is announced; copy or export it again");
    return found;
  }
  TextScanner scanner_;
  std::size_t size_;
};

class BinaryValues {
 public:
  BinaryValues(std::span<const std::uint8_t> bytes, const PlyHeader& header, const std::string& name)
      : reader_(bytes, header.size, header.encoding == PlyEncoding::BigEndian, name) {}
  double number(PlyType type) {
    if (type == PlyType::Float32) return reader_.read<float>();
    if (type == PlyType::Float64) return reader_.read<double>();
    return static_cast<double>(integer(type));
  }
  std::int64_t integer(PlyType type) {
    switch (type) {
      case PlyType::Int8: return reader_.read<std::int8_t>();
      case PlyType::UInt8: return reader_.read<std::uint8_t>();
      case PlyType::Int16: return reader_.read<std::int16_t>();
      case PlyType::UInt16: return reader_.read<std::uint16_t>();
      case PlyType::Int32: return reader_.read<std::int32_t>();
      case PlyType::UInt32: return reader_.read<std::uint32_t>();
      default: return -1;  // indices are never fractions: checked before
    }
  }
  std::size_t remaining() const { return reader_.remaining(); }
  std::string place() const { return reader_.place(); }
  std::size_t size_of(PlyType type) const { return static_cast<std::size_t>(ply_size_of(type)); }

 private:
  ByteReader reader_;
};

template <class Values>
class BodyReader {
 public:
  BodyReader(Values& values, MeshBuilder& builder) : values_(values), builder_(builder) {}

  void read(const PlyElement& element) {
    require_room(element);
    if (element.properties.empty()) return;
    const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
    if (is_vertex) find_axes(element);
    if (is_face) find_corners(element);
    for (std::int64_t i = 0; i < element.count; ++i) {
      for (std::size_t k = 0; k < element.properties.size(); ++k) read_property(element.properties[k], k);
      if (is_vertex) builder_.add_vertex(row_[axes_[0]], row_[axes_[1]], row_[axes_[2]], place());
      if (is_face) builder_.add_polygon(corners_, place());
    }
    corners_property_ = kNone;
  }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};

  auto place() const {
    return [this] { return values_.place(); };
  }

  // The announced rows must fit in the bytes that are left, so that no count can cost more than the file itself.
  void require_room(const PlyElement& element) {
    const std::string line = "line " + std::to_string(element.line);
    if (element.name == "vertex") builder_.expect_vertices(element.count, line);
    if (element.name == "face") builder_.expect_triangles(element.count, line);
    std::size_t least = 0;
    for (const PlyProperty& property : element.properties)
      least += values_.size_of(property.list_count ? *property.list_count : property.type);
    if (least > 0 && static_cast<std::uint64_t>(element.count) > values_.remaining() / least)
      builder_.fail(line, std::to_string(element.count) + " of '" + element.name + "' are announced, but only " +
                              std::to_string(values_.remaining()) +
                              " bytes follow; the file is cut short, copy or export it again");
    row_.assign(element.properties.size(), 0.0);
  }

  void find_axes(const PlyElement& element) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      axes_[axis] = kNone;
      for (std::size_t k = 0; k < element.properties.size(); ++k)
        if (element.properties[k].name == std::string(1, "xyz"[axis]) && !element.properties[k].list_count)
          axes_[axis] = k;
      if (axes_[axis] == kNone)
        builder_.fail("line " + std::to_string(element.line), "vertices have no x, y and z; export positions");
    }
  }

  void find_corners(const PlyElement& element) {
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if ((property.name == "vertex_indices" || property.name == "vertex_index") && property.list_count) {
        if (!ply_is_integer(property.type))
          builder_.fail("line " + std::to_string(element.line),
                        "faces name vertices by fractions; export the file again");
        corners_property_ = k;
      }
    }
    if (corners_property_ == kNone)
      builder_.fail("line " + std::to_string(element.line), "faces have no vertex_indices; export triangles");
  }

  void read_property(const PlyProperty& property, std::size_t k) {
    if (!property.list_count) {
      row_[k] = values_.number(property.type);
      return;
    }
    const std::int64_t count = values_.integer(*property.list_count);
    const std::size_t size = values_.size_of(property.type);
    if (count < 0 || static_cast<std::uint64_t>(count) > values_.remaining() / size)
      builder_.fail(values_.place(),
                    "a list of " + std::to_string(count) +
                        " values does not fit in the file; it is cut short or broken, export it again");
    if (k == corners_property_) corners_.clear();
    for (std::int64_t i = 0; i < count; ++i) {
      if (k == corners_property_)
        corners_.push_back(values_.integer(property.type));
      else
        values_.number(property.type);
    }
  }

  Values& values_;
  MeshBuilder& builder_;
  std::vector<double> row_;
  std::array<std::size_t, 3> axes_ = {0, 0, 0};
  std::size_t corners_property_ = kNone;
  std::vector<std::int64_t> corners_;
};

template <class Values>
void read_body(Values values, const PlyHeader& header, MeshBuilder& builder) {
  BodyReader<Values> reader(values, builder);
  for (const PlyElement& element : header.elements) reader.read(element);
}

}  // namespace

TriangleMesh read_ply(std::span<const std::uint8_t> bytes, const std::string& name, const MeshLimits& limits) {
  const PlyHeader header = read_ply_header(bytes, name);
  MeshBuilder builder(name, limits);
  if (header.encoding == PlyEncoding::Ascii)
    read_body(AsciiValues(bytes, header, name), header, builder);
  else
    read_body(BinaryValues(bytes, header, name), header, builder);
  return builder.finish();
}

}  // namespace toile
