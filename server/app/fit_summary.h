// SPDX-License-Identifier: GPL-3.0-or-later
// What a result.json says about the fit, in short.
#pragma once

#include <map>
#include <string>

#include "engine/core/types.h"

namespace toile::app {

// Zone of the body -> the stretch that is left there (weft or warp, whichever is larger, with its sign): after the
// alteration, else of the ideal pattern, else before. Empty when the document tells no fit.
std::map<std::string, double> fit_by_zone(const Bytes& result_json);

}  // namespace toile::app
