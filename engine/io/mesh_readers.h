// SPDX-License-Identifier: GPL-3.0-or-later
// One reader a format; `read_mesh` chooses. Contract and errors as in mesh_file.h.
#pragma once

#include "engine/io/mesh_file.h"

namespace toile {

TriangleMesh read_obj(std::span<const std::uint8_t> bytes, const std::string& name, const MeshLimits& limits);
TriangleMesh read_ply(std::span<const std::uint8_t> bytes, const std::string& name, const MeshLimits& limits);
TriangleMesh read_stl(std::span<const std::uint8_t> bytes, const std::string& name, const MeshLimits& limits);

// Whether the bytes are a binary STL by its one reliable mark: the size its count announces.
bool has_binary_stl_size(std::span<const std::uint8_t> bytes);
// Whether the first kilobyte holds nothing but printable characters, blanks and line ends (or UTF-8).
bool looks_like_text(std::span<const std::uint8_t> bytes);

}  // namespace toile
