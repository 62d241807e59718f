// SPDX-License-Identifier: GPL-3.0-or-later
// Where a scan does not show the crotch: how low it is by the skin of the mid-plane that leads to it from behind and
// from the front. Metres, normalised frame.
#pragma once

#include <optional>

#include "engine/core/body.h"

namespace toile {

// The underside goes on from its seen ends with their slopes and levels out within `reach`; the lower of both ends
// tells. `seen`: smoothed skin without webs (without_leg_web). `bridged`: a body's lowest point there by a map, which
// parts behind from front. None where no skin leads to it.
std::optional<double> crotch_by_profile(const TriangleMesh& seen, const Vec3& bridged, double height, double reach);

}  // namespace toile
