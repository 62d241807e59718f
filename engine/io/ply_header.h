// SPDX-License-Identifier: GPL-3.0-or-later
// The header of a PLY file: which elements follow, how often, and of what properties.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/core/types.h"

namespace toile {

enum class PlyType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float32;
  std::optional<PlyType> list_count;  // type of the leading count; none for a single value
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  int line = 0;  // of the header
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { Ascii, LittleEndian, BigEndian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  // bytes, the line feed after end_header included
  int lines = 0;
};

int ply_size_of(PlyType type);  // bytes
bool ply_is_integer(PlyType type);

// Throws Error{FileMalformed} with the line. A header longer than 64 KiB or of more than 64 elements or properties is
// refused. Counts are as announced: nothing is allocated for them, the reader holds them against the bytes that follow.
PlyHeader read_ply_header(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace toile
