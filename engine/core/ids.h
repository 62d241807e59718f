// SPDX-License-Identifier: GPL-3.0-or-later
// Small strong types for the things that are counted, so that a panel number is never taken for a seam number.
#pragma once

#include <compare>

namespace toile {

template <class Tag>
struct Id {
  int value = -1;

  constexpr Id() = default;
  constexpr explicit Id(int number) : value(number) {}
  constexpr bool valid() const { return value >= 0; }
  constexpr auto operator<=>(const Id&) const = default;
};

using PanelId = Id<struct PanelTag>;
using SeamId = Id<struct SeamTag>;

}  // namespace toile
