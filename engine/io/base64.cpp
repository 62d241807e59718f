// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/base64.h"

#include <algorithm>

#include "engine/io/text_format.h"

namespace toile {

std::string base64(std::span<const std::uint8_t> bytes) {
  static constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t have = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < have ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= have ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string data_uri(std::string_view content_type, std::span<const std::uint8_t> bytes) {
  std::string uri = "data:";
  append(uri, {content_type, ";base64,", base64(bytes)});
  return uri;
}

}  // namespace toile
