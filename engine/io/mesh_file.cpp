// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/mesh_file.h"

#include <algorithm>
#include <iterator>

#include "engine/core/error.h"
#include "engine/io/mesh_readers.h"
#include "engine/io/text_scanner.h"

namespace toile {

namespace {

constexpr std::size_t kSample = 1024;

bool starts_with_word(std::span<const std::uint8_t> bytes, std::string_view word) {
  TextScanner scanner(bytes.first(std::min(bytes.size(), kSample)), {});
  std::string_view first;
  return scanner.next_line() && scanner.next_word(first) && first == word;
}

bool has_extension(const std::string& name, std::string_view extension) {
  if (name.size() < extension.size()) return false;
  return std::equal(extension.begin(), extension.end(), name.end() - static_cast<std::ptrdiff_t>(extension.size()),
                    [](char a, char b) { return a == (b >= 'A' && b <= 'Z' ? b - 'A' + 'a' : b); });
}

// Whether the first statement is one that OBJ files begin with.
bool looks_like_obj(std::span<const std::uint8_t> bytes) {
  static constexpr std::string_view kStatements[] = {"v", "vt", "vn", "vp", "f",      "o",
                                                     "g", "s",  "l",  "p",  "mtllib", "usemtl"};
  TextScanner scanner(bytes, {});
  std::string_view word;
  while (scanner.next_line())
    if (scanner.next_word(word) && !word.starts_with('#'))
      return std::find(std::begin(kStatements), std::end(kStatements), word) != std::end(kStatements);
  return false;
}

}  // namespace

bool looks_like_text(std::span<const std::uint8_t> bytes) {
  const auto sample = bytes.first(std::min(bytes.size(), kSample));
  return std::all_of(sample.begin(), sample.end(),
                     [](std::uint8_t c) { return c >= 32 ? c != 127 : (c >= 9 && c <= 13); });
}

MeshFormat detect_mesh_format(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (bytes.size() >= 4 && bytes[0] == 'p' && bytes[1] == 'l' && bytes[2] == 'y' &&
      (bytes[3] == '\n' || bytes[3] == '\r'))
    return MeshFormat::Ply;
  if (has_binary_stl_size(bytes)) return MeshFormat::Stl;
  if (looks_like_text(bytes)) {
    if (starts_with_word(bytes, "solid")) return MeshFormat::Stl;
    if (looks_like_obj(bytes)) return MeshFormat::Obj;
  }
  if (has_extension(name, ".obj")) return MeshFormat::Obj;
  if (has_extension(name, ".ply")) return MeshFormat::Ply;
  if (has_extension(name, ".stl")) return MeshFormat::Stl;
  throw Error(ErrorCode::FormatUnknown, name,
              bytes.empty() ? "the file is empty; export the mesh again"
                            : "byte 0: neither OBJ, PLY nor STL; export the mesh in one of these formats");
}

TriangleMesh read_mesh(std::span<const std::uint8_t> bytes, const std::string& name, const MeshLimits& limits) {
  if (bytes.size() > limits.bytes)
    throw Error(ErrorCode::LimitExceeded, name,
                std::to_string(bytes.size()) + " bytes, more than the " + std::to_string(limits.bytes) +
                    " that are read; decimate the mesh or export it as binary PLY");
  switch (detect_mesh_format(bytes, name)) {
    case MeshFormat::Obj: return read_obj(bytes, name, limits);
    case MeshFormat::Ply: return read_ply(bytes, name, limits);
    case MeshFormat::Stl: return read_stl(bytes, name, limits);
  }
  throw Error(ErrorCode::Internal, name, "no reader for this format");
}

}  // namespace toile
