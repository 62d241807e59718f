// SPDX-License-Identifier: GPL-3.0-or-later
// Random numbers that are the same on every machine (splitmix64): the standard library's distributions are not.
#pragma once

#include <cmath>
#include <cstdint>

namespace toile::test {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}

  double between(double low, double high) {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return low + (high - low) * static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
  }
  // Evenly by decades; both positive.
  double by_decades(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  // low .. high, both included.
  int whole(int low, int high) { return low + static_cast<int>(between(0.0, high - low + 1.0)); }
  bool chance(double share) { return between(0.0, 1.0) < share; }

 private:
  std::uint64_t state_;
};

}  // namespace toile::test
