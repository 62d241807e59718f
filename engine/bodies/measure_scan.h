// SPDX-License-Identifier: GPL-3.0-or-later
// Measure a scan through a mannequin registered to it, never on the scan's own skin: noise widens every girth of a raw
// slice, and where the scan had holes there is nothing to measure.
//
// scan -> mannequin of its height -> register the mannequin to the scan -> find_skeleton, measure_body on the result
// and once more with a mannequin of the measures so found: what the scan lacks is then bridged by a body of its build.
// Source: shared design page "registration", section 1.2: raw girths err by up to +13 mm. Metres, normalised frame.
#pragma once

#include "engine/bodies/measure_body.h"
#include "engine/bodies/register_bodies.h"
#include "engine/core/progress.h"

namespace toile {

struct MeasureScanResult {
  MeasureBodyResult measured;
  TriangleMesh skin;  // the mannequin in the shape of the scan: closed, smooth, every point known
  RegistrationReport registration;
  // Measures that hang on a crown or a crotch that is cut away in the scan, told from the mannequin's: to about 5 mm,
  // and worse where thighs press on each other for centimetres under it.
  std::vector<std::string> estimated;
};

// Requires a normalised scan; it may have holes, and is better off with them than with patches over them. `given`
// landmarks win over found ones. Throws BodyNotRecognised, RegistrationFailed, Cancelled.
MeasureScanResult measure_scan(const Body& scan, const Landmarks& given = {}, Progress* progress = nullptr);

}  // namespace toile
