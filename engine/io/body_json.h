// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies, landmarks and measurements as documents (schemas/body, landmarks, measurements).
#pragma once

#include <span>

#include "engine/core/body.h"
#include "engine/core/record.h"

namespace toile {

// "name", "kind", "normalised_from_file" (row-major rows), "measurements_m", "landmarks_m". Metres, normalised frame.
Record describe_body(const Body& body);

// Points in the file's own frame and unit, or already in the normalised one.
struct GivenLandmarks {
  Landmarks points;
  bool in_file_frame = true;
};
// A landmarks document: {"landmarks": {NAME: [x, y, z], ...}} in the frame of the body's file, or "landmarks_m" in the
// normalised frame, as `toile body` prints them. Throws FileMalformed, LimitExceeded.
GivenLandmarks read_landmarks(std::span<const std::uint8_t> bytes, const std::string& subject);

// Brings points given in the file's frame along with the body.
Landmarks normalised_landmarks(const GivenLandmarks& given, const Mat4& normalised_from_file);

// A measurements document: {"measurements_m": {...}} or {"measurements_cm": {...}} under ISO 8559-1 names, and whose
// proportions are to complete them ("figure": "woman", "man", "child" or "person"; empty if not said).
struct MeasurementsDocument {
  Measurements measurements;  // m
  std::string figure;
};
// Throws FileMalformed, LimitExceeded.
MeasurementsDocument read_measurements(std::span<const std::uint8_t> bytes, const std::string& subject);

}  // namespace toile
