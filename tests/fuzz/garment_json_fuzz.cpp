// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes either become a pattern that keeps its guarantees and can be written and read again, or a named refusal.
#include <cstdlib>

#include "engine/core/error.h"
#include "engine/io/garmentcode_json.h"
#include "engine/stages/import_pattern.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const toile::Pattern pattern = toile::import_pattern({data, size});
    const std::string text = toile::write_garmentcode(pattern);
    const toile::Pattern again =
        toile::read_garmentcode({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    if (again.panels.size() != pattern.panels.size() || again.seams.size() != pattern.seams.size()) std::abort();
  } catch (const toile::Error& error) {
    if (error.subject.empty() || error.message.empty() || toile::exit_code(error.code) != 3) std::abort();
  }
  return 0;
}
