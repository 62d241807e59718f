// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers points by position: bit-equal positions get one number, in the order of first use.
#pragma once

#include <vector>

#include "engine/core/types.h"

namespace toile {

// An open-addressed hash table. +0 and -0 are one position. Positions must not be NaN.
class PositionIndex {
 public:
  PositionIndex();

  // The number of this position; a new one is `count()` before the call.
  std::int32_t add(const Vec3& position);
  std::int32_t count() const { return static_cast<std::int32_t>(positions_.size()); }
  Points3 positions() const;  // #count x 3

 private:
  std::size_t slot_of(const Vec3& position) const;
  void grow();

  std::vector<Vec3> positions_;
  std::vector<std::int32_t> slots_;  // -1: free; size a power of two, at most half full
};

}  // namespace toile
