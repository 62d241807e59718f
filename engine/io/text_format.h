// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers and text for documents, without locale.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace toile {

// At most `decimals` digits after the point, no trailing zeros, no "-0"; "0" for what is not finite.
std::string number(double value, int decimals);

// Text for XML and HTML content and attributes: & < > " ' escaped, control characters left out.
std::string escape_xml(std::string_view text);

void append(std::string& out, std::initializer_list<std::string_view> parts);

}  // namespace toile
