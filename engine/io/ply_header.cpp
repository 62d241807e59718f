// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/ply_header.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "engine/io/text_scanner.h"

namespace toile {

namespace {

constexpr std::size_t kMaxHeaderBytes = 64 * 1024;
constexpr std::size_t kMaxDeclared = 64;  // elements, and properties of one element

struct TypeName {
  std::string_view name;
  PlyType type;
};
constexpr TypeName kTypeNames[] = {
    {"char", PlyType::Int8},      {"int8", PlyType::Int8},       {"uchar", PlyType::UInt8},
    {"uint8", PlyType::UInt8},    {"short", PlyType::Int16},     {"int16", PlyType::Int16},
    {"ushort", PlyType::UInt16},  {"uint16", PlyType::UInt16},   {"int", PlyType::Int32},
    {"int32", PlyType::Int32},    {"uint", PlyType::UInt32},     {"uint32", PlyType::UInt32},
    {"float", PlyType::Float32},  {"float32", PlyType::Float32}, {"double", PlyType::Float64},
    {"float64", PlyType::Float64}};

PlyType read_type(TextScanner& scanner) {
  const std::string_view word = scanner.word("the type of a property");
  const auto* found = std::find_if(std::begin(kTypeNames), std::end(kTypeNames),
                                   [&](const TypeName& entry) { return entry.name == word; });
  if (found == std::end(kTypeNames)) scanner.fail("a property has an unknown type; export the file again");
  return found->type;
}

PlyEncoding read_encoding(TextScanner& scanner) {
  const std::string_view word = scanner.word("the encoding");
  if (word == "ascii") return PlyEncoding::Ascii;
  if (word == "binary_little_endian") return PlyEncoding::LittleEndian;
  if (word == "binary_big_endian") return PlyEncoding::BigEndian;
  scanner.fail("unknown encoding; export as ascii, binary_little_endian or binary_big_endian");
}

PlyElement read_element(TextScanner& scanner) {
  PlyElement element;
  element.name = scanner.word("the name of an element");
  element.count = scanner.integer("the count of an element");
  element.line = scanner.line();
  if (element.count < 0) scanner.fail("a negative count; export the file again");
  return element;
}

PlyProperty read_property(TextScanner& scanner) {
  PlyProperty property;
  TextScanner ahead = scanner;
  if (ahead.word("the type of a property") == "list") {
    scanner = ahead;
    property.list_count = read_type(scanner);
    if (!ply_is_integer(*property.list_count)) scanner.fail("a list is counted by a fraction; export the file again");
  }
  property.type = read_type(scanner);
  property.name = scanner.word("the name of a property");
  return property;
}

}  // namespace

int ply_size_of(PlyType type) {
  switch (type) {
    case PlyType::Int8:
    case PlyType::UInt8: return 1;
    case PlyType::Int16:
    case PlyType::UInt16: return 2;
    case PlyType::Int32:
    case PlyType::UInt32:
    case PlyType::Float32: return 4;
    case PlyType::Float64: return 8;
  }
  return 8;
}

bool ply_is_integer(PlyType type) {
  return type != PlyType::Float32 && type != PlyType::Float64;
}

PlyHeader read_ply_header(std::span<const std::uint8_t> bytes, const std::string& name) {
  TextScanner scanner(bytes.first(std::min(bytes.size(), kMaxHeaderBytes)), name);
  PlyHeader header;
  std::string_view word;
  bool has_encoding = false;
  while (scanner.next_line()) {
    if (!scanner.next_word(word)) continue;
    if (word == "format") {
      header.encoding = read_encoding(scanner);
      has_encoding = true;
    } else if (word == "element") {
      if (header.elements.size() >= kMaxDeclared) scanner.fail("too many elements; export only vertices and faces");
      header.elements.push_back(read_element(scanner));
    } else if (word == "property") {
      if (header.elements.empty()) scanner.fail("a property before any element; export the file again");
      auto& properties = header.elements.back().properties;
      if (properties.size() >= kMaxDeclared) scanner.fail("too many properties; export only positions and faces");
      properties.push_back(read_property(scanner));
    } else if (word == "end_header") {
      if (!has_encoding) scanner.fail("the header names no format; export the file again");
      header.lines = scanner.line();
      scanner.next_line();
      header.size = scanner.offset();
      return header;
    }
  }
  scanner.fail("the header has no end_header; the file is cut short, copy or export it again");
}

}  // namespace toile
