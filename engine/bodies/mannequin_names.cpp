// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/mannequin_names.h"

#include <array>
#include <charconv>
#include <span>

#include "engine/core/units.h"

namespace toile {
namespace {

struct Size {
  int size;
  double bust_or_chest, waist, hip;  // cm
};

constexpr std::array<Size, 13> kWomen = {{{32, 76, 62, 86},
                                          {34, 80, 65, 90},
                                          {36, 84, 68, 94},
                                          {38, 88, 72, 97},
                                          {40, 92, 76, 100},
                                          {42, 96, 80, 103},
                                          {44, 100, 84, 106},
                                          {46, 104, 88, 109},
                                          {48, 110, 94.5, 114},
                                          {50, 116, 101, 119},
                                          {52, 122, 107.5, 124},
                                          {54, 128, 114, 129},
                                          {56, 134, 120.5, 134}}};
constexpr std::array<Size, 9> kMen = {{{44, 88, 76, 92},
                                       {46, 92, 80, 96},
                                       {48, 96, 84, 100},
                                       {50, 100, 88, 104},
                                       {52, 104, 92, 107},
                                       {54, 108, 97, 110},
                                       {56, 112, 102, 113},
                                       {58, 116, 107, 116},
                                       {60, 120, 112, 119}}};

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

struct Heights {
  int least, most;  // cm
};

// "SIZE-HEIGHT" in the table's sizes.
std::optional<NamedMannequin> adult(std::string_view rest, std::span<const Size> sizes, Heights heights,
                                    Figure figure) {
  const std::size_t dash = rest.find('-');
  if (dash == std::string_view::npos) return std::nullopt;
  const auto size = whole_number(rest.substr(0, dash)), height = whole_number(rest.substr(dash + 1));
  if (!size || !height || *height < heights.least || *height > heights.most) return std::nullopt;
  for (const Size& row : sizes) {
    if (row.size != *size) continue;
    return NamedMannequin{figure,
                          {{"height", *height * kMetrePerCm},
                           {figure == Figure::Woman ? "bust_girth" : "chest_girth", row.bust_or_chest * kMetrePerCm},
                           {"waist_girth", row.waist * kMetrePerCm},
                           {"hip_girth", row.hip * kMetrePerCm}}};
  }
  return std::nullopt;
}

}  // namespace

std::optional<NamedMannequin> find_named_mannequin(std::string_view name) {
  constexpr std::string_view kWoman = "woman-", kMan = "man-", kChild = "child-";
  if (name.starts_with(kWoman)) return adult(name.substr(kWoman.size()), kWomen, {145, 195}, Figure::Woman);
  if (name.starts_with(kMan)) return adult(name.substr(kMan.size()), kMen, {155, 205}, Figure::Man);
  if (name.starts_with(kChild)) {
    const auto height = whole_number(name.substr(kChild.size()));
    if (height && *height >= 86 && *height <= 176)
      return NamedMannequin{Figure::Child, {{"height", *height * kMetrePerCm}}};
  }
  return std::nullopt;
}

}  // namespace toile
