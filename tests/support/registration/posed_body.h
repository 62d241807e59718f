// SPDX-License-Identifier: GPL-3.0-or-later
// A body in another pose, and imitated scans of bodies so posed: unlike those of ../shared/data, drawn from a seed.
#pragma once

#include "engine/core/body.h"
#include "tests/support/registration/registration_score.h"

namespace toile::test {

// Both sides alike. Degrees.
struct BodyPose {
  double arms = 0.0;        // raised to the side
  double forearms = 0.0;    // bent forward
  double feet_apart = 0.0;  // each leg turned outward
  double hips = 0.0;        // thighs raised forward: 90 sits
  double knees = 0.0;       // shins turned back
};
// Skinned by bone_weights about the joints of the body's own skeleton. #V x 3.
Points3 posed(const TriangleMesh& body, const BodyPose& pose);

// A body of shared/data as a scan nobody has seen: arms -18 to 30 degrees, forearms bent, feet apart, leant by 5
// degrees, noise, holes where scanners have them and elsewhere, random unit, axes and yaw. Imported.
RegistrationCase variant_case(const std::string& body, unsigned seed);

}  // namespace toile::test
