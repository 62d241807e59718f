// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/mesh_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return toile::fuzz::try_reader(toile::read_ply, data, size);
}
