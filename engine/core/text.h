// SPDX-License-Identifier: GPL-3.0-or-later
// Messages with numbers in them, as printf writes them (the compiler checks the arguments).
#pragma once

#include <string>

namespace toile {

[[gnu::format(printf, 1, 2)]] std::string print_text(const char* format, ...);

}  // namespace toile
