// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/shared_data.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace toile::test {

namespace fs = std::filesystem;

fs::path shared_data(const std::string& relative) {
  const char* folder = std::getenv("TOILE_SHARED_DATA");
  const fs::path root = folder ? fs::path(folder) : fs::path(TOILE_SOURCE_DIR).parent_path() / "shared" / "data";
  return root / relative;
}

bool has_shared_data() {
  return fs::exists(shared_data("bodies/ggg_mean_all.obj"));
}

Bytes read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + path.string());
  return Bytes(std::istreambuf_iterator<char>(in), {});
}

const std::vector<std::string>& shared_body_names() {
  static const std::vector<std::string> names = {"ggg_mean_all",          "ggg_mean_female",      "ggg_mean_male",
                                                 "ggg_male_extra",        "ggg_small_female",     "ggg_large_male",
                                                 "mh_female_average",     "mh_female_thin_short", "mh_female_thin_tall",
                                                 "mh_female_heavy_short", "mh_female_heavy_tall", "mh_male_average",
                                                 "mh_male_old_heavy",     "mh_child_8y",          "mh_female_athletic"};
  return names;
}

const std::vector<std::string>& shared_garment_names() {
  static const std::vector<std::string> names = {"dress_loose",
                                                 "dress_sleeveless",
                                                 "f_dress_sleeveless",
                                                 "f_leggings",
                                                 "gc_dress_pencil",
                                                 "gc_hoody_mean",
                                                 "gc_jumpsuit_mean_all",
                                                 "gc_shirt_mean",
                                                 "leggings_tight",
                                                 "leggings_zero_ease",
                                                 "m_pants",
                                                 "m_tshirt",
                                                 "pants_straight",
                                                 "shirt_darts_long",
                                                 "shirt_lapel",
                                                 "skirt_aline",
                                                 "skirt_circle",
                                                 "skirt_panelled",
                                                 "skirt_pencil",
                                                 "sweater_loose_hood",
                                                 "tshirt_basic",
                                                 "tshirt_fitted"};
  return names;
}

std::string body_of_garment(const std::string& garment) {
  if (garment.starts_with("f_")) return "ggg_mean_female";
  if (garment.starts_with("m_")) return "ggg_mean_male";
  return "ggg_mean_all";
}

}  // namespace toile::test
