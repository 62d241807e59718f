// SPDX-License-Identifier: GPL-3.0-or-later
// Does a document agree with its JSON Schema?
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/core/types.h"

namespace toile {

struct SchemaProblem {
  std::string pointer;  // JSON pointer into the document
  std::string message;
};

struct SchemaCheck {
  std::string schema;  // the one it was held against
  std::vector<SchemaProblem> problems;
};

// Names of the schemas that are known: "garment", "options", ...
std::vector<std::string> schema_names();

// Holds the document against `schema`, or when that is empty against the one it names in its member "schema"
// ("toile/NAME/VERSION"), or that its members give away (garments, options, measurements, landmarks).
// Throws Error{FileMalformed, LimitExceeded} when the bytes are not JSON within the limits, Error{FormatUnknown} when
// no schema fits.
SchemaCheck check_schema(std::span<const std::uint8_t> document, const std::string& schema = {});

}  // namespace toile
