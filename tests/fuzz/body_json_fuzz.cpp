// SPDX-License-Identifier: GPL-3.0-or-later
// Landmarks and measurements documents: values within their bounds, or an Error that names the file.
#include "engine/io/body_json.h"
#include "tests/fuzz/mesh_fuzz.h"

namespace {

template <class Read>
void try_read(Read read) {
  try {
    read();
  } catch (const toile::Error& error) {
    toile::fuzz::require(error.subject == "fuzz" && !error.message.empty() && toile::exit_code(error.code) == 3);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace toile;
  const std::span<const std::uint8_t> bytes(data, size);
  try_read([&] {
    for (const auto& [name, point] : read_landmarks(bytes, "fuzz").points) fuzz::require(point.allFinite());
  });
  try_read([&] {
    for (const auto& [name, metres] : read_measurements(bytes, "fuzz").measurements)
      fuzz::require(metres >= 0 && metres <= 5.0);
  });
  return 0;
}
