// SPDX-License-Identifier: GPL-3.0-or-later
// Finished stages by key, so that repeated work is skipped. The key is a hash of (stage version, inputs, options) in
// hexadecimal (ContentHash); the value is the stage's serialised result. A cache may forget, it may not lie: `get`
// answers exactly the bytes that were put under the key, or nothing.
#pragma once

#include <optional>
#include <string>

#include "engine/core/types.h"

namespace toile {

struct StageCache {
  virtual ~StageCache() = default;
  virtual std::optional<Bytes> get(const std::string& key) = 0;
  // A second put under one key is ignored. Never throws for want of space: the result is then simply not kept.
  virtual void put(const std::string& key, const Bytes& value) = 0;
};

}  // namespace toile
