// SPDX-License-Identifier: GPL-3.0-or-later
// Options documents: options in range that are written and read back the same, or an Error that says what is wrong.
#include "engine/io/options_json.h"
#include "tests/fuzz/mesh_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace toile;
  try {
    const std::string written = write_options(read_options({data, size}));
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(written.data());
    fuzz::require(write_options(read_options({bytes, written.size()})) == written);
  } catch (const Error& error) {
    fuzz::require(!error.message.empty() && exit_code(error.code) != exit_code(ErrorCode::Internal));
  }
  return 0;
}
