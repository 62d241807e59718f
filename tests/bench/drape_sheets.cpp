// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/drape_sheets.h"

#include <filesystem>
#include <fstream>

#include "engine/render/png.h"

namespace toile::bench {

std::string names_of(const std::vector<DrapeFinding>& findings) {
  std::string names;
  for (const DrapeFinding& finding : findings) names += (names.empty() ? "" : " ") + finding.name;
  return names;
}

void write_picture(const std::string& folder, const std::string& name, const Image& image) {
  std::filesystem::create_directories(folder);
  const Bytes png = write_png(image);
  std::ofstream(folder + "/" + name + ".png", std::ios::binary)
      .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
}

}  // namespace toile::bench
