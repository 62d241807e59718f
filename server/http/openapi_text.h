// SPDX-License-Identifier: GPL-3.0-or-later
// schemas/openapi.yaml, built into the program.
#pragma once

#include <string>

namespace toile::http {

std::string openapi_text();

}  // namespace toile::http
