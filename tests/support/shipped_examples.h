// SPDX-License-Identifier: GPL-3.0-or-later
// The drafted garments of schemas/examples, whom they were drafted for, and five mannequins to alter them between.
#pragma once

#include <array>
#include <string>

namespace toile::test {

struct ShippedExample {
  const char* name;
  const char* wearer;  // a built-in body
};
inline constexpr std::array<ShippedExample, 5> kShippedExamples = {{{"a_line_skirt", "woman-38-168"},
                                                                    {"dress", "woman-38-168"},
                                                                    {"leggings", "child-128"},
                                                                    {"t_shirt", "man-50-178"},
                                                                    {"trousers", "man-50-178"}}};
inline constexpr std::array<const char*, 5> kFiveMannequins = {"woman-38-168", "woman-46-164", "man-50-178",
                                                               "man-54-186", "child-128"};

std::string shipped_example_folder();  // with a slash at the end

}  // namespace toile::test
