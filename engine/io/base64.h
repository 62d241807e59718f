// SPDX-License-Identifier: GPL-3.0-or-later
// Base64 with padding [RFC 4648, Sec. 4]: pictures inside HTML.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/core/types.h"

namespace toile {

std::string base64(std::span<const std::uint8_t> bytes);

// "data:TYPE;base64,...", for the src attribute of an image.
std::string data_uri(std::string_view content_type, std::span<const std::uint8_t> bytes);

}  // namespace toile
