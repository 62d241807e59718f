// SPDX-License-Identifier: GPL-3.0-or-later
// What benchmarks that drape garments tell and draw alike.
#pragma once

#include <string>
#include <vector>

#include "engine/render/image.h"
#include "engine/stages/drape_guards.h"

namespace toile::bench {

std::string names_of(const std::vector<DrapeFinding>& findings);

// FOLDER/NAME.png
void write_picture(const std::string& folder, const std::string& name, const Image& image);

}  // namespace toile::bench
