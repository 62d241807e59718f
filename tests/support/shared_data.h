// SPDX-License-Identifier: GPL-3.0-or-later
// Real bodies, scans and garments that stand beside the checkout as ../shared/data; tests skip where they are absent.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/types.h"

namespace toile::test {

// Path of ../shared/data/<relative>, whether or not it exists. TOILE_SHARED_DATA overrides the folder.
std::filesystem::path shared_data(const std::string& relative);
bool has_shared_data();
Bytes read_file(const std::filesystem::path& path);

const std::vector<std::string>& shared_body_names();        // 15, without extension
const std::vector<std::string>& shared_garment_names();     // 22, without _specification.json
inline constexpr const char* kWoman = "mh_female_average";  // of each of the two topologies the body that stands for it
inline constexpr const char* kMean = "ggg_mean_all";
// The body a garment was drafted for: f_* ggg_mean_female, m_* ggg_mean_male, else ggg_mean_all.
std::string body_of_garment(const std::string& garment);

}  // namespace toile::test

#define TOILE_REQUIRE_SHARED_DATA() \
  if (!toile::test::has_shared_data()) GTEST_SKIP() << "../shared/data is not beside this checkout"
