// SPDX-License-Identifier: GPL-3.0-or-later
// The numeric vocabulary of every room. Lengths in metres, angles in radians, unless a name carries a unit.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Dense>

namespace toile {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat2 = Eigen::Matrix2d;
using Mat3 = Eigen::Matrix3d;
using Mat4 = Eigen::Matrix4d;
using Mat32 = Eigen::Matrix<double, 3, 2>;

// One row per point: `points.row(i)`; rows are contiguous in memory.
using Points2 = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
using Points3 = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
// One row per triangle, corners as row numbers of the points they index.
using Triangles = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

using Bytes = std::vector<std::uint8_t>;

}  // namespace toile
