// SPDX-License-Identifier: GPL-3.0-or-later
// Finished stages as files of a folder: what `toile batch` shares between its bodies and finds again when it is
// resumed.
#pragma once

#include <filesystem>

#include "engine/core/stage_cache.h"

namespace toile::app {

class FolderStages : public StageCache {
 public:
  explicit FolderStages(std::filesystem::path folder);  // made if needed

  std::optional<Bytes> get(const std::string& key) override;
  void put(const std::string& key, const Bytes& value) override;

 private:
  std::filesystem::path folder_;
};

}  // namespace toile::app
