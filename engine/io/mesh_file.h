// SPDX-License-Identifier: GPL-3.0-or-later
// Triangle meshes as files: OBJ, PLY (ASCII, binary of both byte orders), STL (ASCII, binary).
#pragma once

#include <span>
#include <string>

#include "engine/core/body.h"

namespace toile {

// What a mesh file may hold [service.md, section 4]. Beyond: Error{LimitExceeded}, before anything is allocated.
struct MeshLimits {
  std::size_t bytes = std::size_t{64} << 20;
  std::int64_t vertices = 500'000;  // STL: of distinct positions
  std::int64_t triangles = 1'000'000;
  double coordinate = 1e5;  // largest magnitude, in the file's unit: 1e5 mm in the finest one
};

enum class MeshFormat { Obj, Ply, Stl };

// The format of untrusted bytes, by content; the extension of `name` decides only what the content leaves open.
// Throws Error{FormatUnknown}.
MeshFormat detect_mesh_format(std::span<const std::uint8_t> bytes, const std::string& name);

// A mesh from untrusted bytes, in the file's own unit and axes. Polygons become fans of triangles; vertices keep the
// order of the file. STL has no indices: corners with bit-equal positions become one vertex, numbered by first use.
//
// Ensures: at least one triangle; every coordinate finite and within the limits; every index in range.
// `name` is the subject of errors; they give the line or the byte offset, and what would mend the file.
// Throws Error{FormatUnknown, FileMalformed, LimitExceeded}.
TriangleMesh read_mesh(std::span<const std::uint8_t> bytes, const std::string& name, const MeshLimits& limits = {});

// OBJ: text, six decimals. PLY and STL: binary little endian, single precision.
Bytes write_obj(const TriangleMesh& mesh);
Bytes write_ply(const TriangleMesh& mesh);
Bytes write_stl(const TriangleMesh& mesh);

}  // namespace toile
