// SPDX-License-Identifier: GPL-3.0-or-later
// The texture islands of an OBJ garment: flat vertices, their triangles and one outline each. Inner header of io.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "engine/core/types.h"

namespace toile {

// As in the file, polygons cut into triangles. File units.
struct ObjTextured {
  std::vector<Vec3> positions;
  std::vector<Vec2> texture;
  std::vector<std::array<std::array<std::int32_t, 2>, 3>> triangles;  // per corner: position, texture
  std::vector<int> group_of_triangle;
  std::vector<std::string> groups;
  std::vector<Mat2> wanted;  // per triangle, the fit it is to have; empty when the file says nothing
};

struct ObjIsland {
  std::string name;
  std::vector<int> vertices;                  // of the flat vertices below
  std::vector<std::array<int, 3>> triangles;  // flat vertices, in the order of the file's faces
  std::vector<int> outline;                   // closed loop of flat vertices, in the direction of the faces
  bool clockwise = false;                     // in the plane of the texture coordinates
};

struct ObjIslands {
  std::vector<Vec2> flat;     // per flat vertex, file units
  std::vector<int> position;  // per flat vertex, number into ObjTextured::positions
  std::vector<int> texture;   // per flat vertex, number of its vt line, from 0
  std::vector<ObjIsland> islands;
};

ObjTextured read_textured_obj(std::span<const std::uint8_t> bytes, const std::string& name);

// Throws Error{GarmentInvalid} for islands with holes, folds, pinched outlines or faces of both turns.
ObjIslands find_islands(const ObjTextured& obj, const std::string& name);

}  // namespace toile
