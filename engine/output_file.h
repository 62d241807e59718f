// SPDX-License-Identifier: GPL-3.0-or-later
// A file that a job hands over.
#pragma once

#include <string>

#include "engine/core/types.h"

namespace toile {

struct OutputFile {
  std::string name;
  std::string content_type;
  Bytes bytes;
};

}  // namespace toile
