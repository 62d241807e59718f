// SPDX-License-Identifier: GPL-3.0-or-later
// Conversions at the edges: inside, everything is SI.
#pragma once

#include <numbers>

namespace toile {

inline constexpr double kMetrePerMm = 1e-3;
inline constexpr double kMetrePerCm = 1e-2;
inline constexpr double kMetrePerInch = 0.0254;
inline constexpr double kMmPerMetre = 1e3;
inline constexpr double kCmPerMetre = 1e2;
inline constexpr double kRadianPerDegree = std::numbers::pi / 180.0;
inline constexpr double kDegreePerRadian = 180.0 / std::numbers::pi;
inline constexpr double kGravity = 9.81;  // m/s^2, along -y

}  // namespace toile
