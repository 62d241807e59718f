// SPDX-License-Identifier: GPL-3.0-or-later
// schemas/examples/tube_skirt.json, built into the program.
#pragma once

#include <string>

namespace toile::app {

std::string demo_garment_text();

}  // namespace toile::app
