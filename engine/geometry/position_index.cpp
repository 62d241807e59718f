// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/position_index.h"

#include <bit>
#include <cstdint>

namespace toile {

namespace {

// Finaliser of the SplitMix64 generator: every input bit reaches every output bit.
std::uint64_t mix(std::uint64_t x) {
  x ^= x >> 30, x *= 0xbf58476d1ce4e5b9ULL;
  x ^= x >> 27, x *= 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

std::uint64_t hash_of(const Vec3& p) {
  std::uint64_t h = 0x9e3779b97f4a7c15ULL;
  for (int k = 0; k < 3; ++k) h = mix(h + std::bit_cast<std::uint64_t>(p[k]));
  return h;
}

}  // namespace

PositionIndex::PositionIndex() : slots_(1024, -1) {}

std::size_t PositionIndex::slot_of(const Vec3& position) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash_of(position) & mask;
  while (slots_[slot] >= 0 && positions_[static_cast<std::size_t>(slots_[slot])] != position) slot = (slot + 1) & mask;
  return slot;
}

std::int32_t PositionIndex::add(const Vec3& position) {
  const Vec3 unsigned_zeros = position + Vec3::Zero();  // -0 + 0 = +0: one bit pattern per position
  const std::size_t slot = slot_of(unsigned_zeros);
  if (slots_[slot] >= 0) return slots_[slot];
  slots_[slot] = count();
  positions_.push_back(unsigned_zeros);
  const std::int32_t number = slots_[slot];
  if (2 * positions_.size() > slots_.size()) grow();
  return number;
}

void PositionIndex::grow() {
  slots_.assign(slots_.size() * 2, -1);
  for (std::size_t i = 0; i < positions_.size(); ++i) slots_[slot_of(positions_[i])] = static_cast<std::int32_t>(i);
}

Points3 PositionIndex::positions() const {
  Points3 out(count(), 3);
  for (std::int32_t i = 0; i < count(); ++i) out.row(i) = positions_[static_cast<std::size_t>(i)];
  return out;
}

}  // namespace toile
