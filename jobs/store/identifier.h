// SPDX-License-Identifier: GPL-3.0-or-later
// Names that cannot be guessed.
#pragma once

#include <string>
#include <string_view>

namespace toile {

// `prefix` + '_' + 32 hexadecimal digits from the system's random source. Throws Error{Internal} if there is none.
std::string random_identifier(std::string_view prefix);

}  // namespace toile
