// SPDX-License-Identifier: GPL-3.0-or-later
// Bring a body of unknown unit, axes, turn and place into the normalised frame: metres, Y up, facing +Z, wearer's left
// +X, soles at y = 0, mid-plane at x = 0.
//
// up    the axis along which slices show two legs below and one trunk or head above
// unit  the one that gives a height a person has
// yaw   turn that makes the body most symmetric about x = 0 (mirrored body registered to the body)
// front toes reach further from the ankle than heels
// Source: shared design page "registration", section 1.1; guards of its section 4.
#pragma once

#include <string_view>

#include "engine/bodies/upright.h"
#include "engine/core/body.h"

namespace toile {

enum class LengthUnit { Metre, Centimetre, Millimetre, Inch };
double metres_per(LengthUnit unit);
std::string_view unit_name(LengthUnit unit);  // "m", "cm", "mm", "in"

struct NormaliseBodyOptions {
  BodyKind kind = BodyKind::Human;  // Form: unit, up (+Y unless given) and floor only; it stays turned as it is
  std::optional<LengthUnit> unit;   // of the file; empty: found from the height
  std::optional<UpAxis> up;         // of the file; empty: found from the slices
};

struct NormaliseBodyResult {
  TriangleMesh surface;  // as given, moved and, if moved, rounded to 1 um; same order of vertices and triangles
  Mat4 normalised_from_file = Mat4::Identity();  // similarity, 4x4
  LengthUnit unit = LengthUnit::Metre;
  UpAxis up = UpAxis::PlusY;
  double up_score = 0.0;          // 0..2, 2 is a standing person
  double yaw = 0.0;               // rad, turn about the up axis found; applied unless the coordinates were kept
  double front = 0.0;             // (toe - heel) / height
  double mirror_residual = 0.0;   // m, median distance of the mirrored body to the body
  bool kept_coordinates = false;  // the file already stood so: nothing was moved
  std::vector<std::string> warnings;
};

// Requires: welded vertices (components are found by shared vertices). Small stray components are ignored, not removed.
// Throws BodyUnusable (size), BodyNotRecognised (not one upright person).
NormaliseBodyResult normalise_body(const TriangleMesh& in_file, const NormaliseBodyOptions& options = {});

}  // namespace toile
