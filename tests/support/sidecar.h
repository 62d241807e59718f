// SPDX-License-Identifier: GPL-3.0-or-later
// What ../shared/data knows about its bodies and scans: measured truth, landmarks, correspondence.
#pragma once

#include <map>
#include <string>

#include "engine/core/body.h"

namespace toile::test {

// ISO 20685-1, what scanners are held to, m: small girths and heights, large girths.
inline constexpr double kSmallError = 4e-3, kLargeError = 9e-3;

struct BodySidecar {
  std::map<std::string, double> measurements;  // "waist", "hips", "bust_at_bust_points", ... m
  std::map<std::string, double> levels;        // m
  std::map<std::string, int> landmark_vertex;
  Landmarks landmarks;
};
BodySidecar load_body_sidecar(const std::string& name);

struct ScanSidecar {
  std::string source_body;
  Mat4 scan_from_body = Mat4::Identity();
  Landmarks landmarks;  // true positions in the body's frame, posed as the scan is
};
ScanSidecar load_scan_sidecar(const std::string& name);

}  // namespace toile::test
