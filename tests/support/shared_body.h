// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of ../shared/data as values, read as they stand.
#pragma once

#include <string>

#include "engine/core/body.h"

namespace toile::test {

// bodies/NAME.obj: they stand in the normalised frame already, so the transform is the identity. No skeleton,
// landmarks or measurements. Call only after TOILE_REQUIRE_SHARED_DATA().
Body load_shared_body(const std::string& name);

// scans/NAME.{ply,obj,stl} in the file's own unit and axes, not repaired.
TriangleMesh load_shared_scan(const std::string& name);
Bytes shared_scan_bytes(const std::string& name);  // scan_a .. scan_d

}  // namespace toile::test
