// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the #include lines of the sources: rooms only know the rooms below them, heavy libraries stay in their folder.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file;  // from the project's root, with forward slashes
  std::string target;
  bool quoted = false;
};

std::vector<Include> read_includes() {
  std::vector<Include> includes;
  const fs::path root = TOILE_SOURCE_DIR;
  for (const char* folder : {"engine", "jobs", "server"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        if (!line.starts_with("#include ")) continue;
        const char close = line[9] == '"' ? '"' : '>';
        includes.push_back({fs::relative(entry.path(), root).generic_string(),
                            line.substr(10, line.find(close, 10) - 10), close == '"'});
      }
    }
  return includes;
}

// "engine/geometry/curve.h" -> "geometry"; files directly in engine/ are the pipeline; schemas are part of io.
std::string room_of(const std::string& path) {
  const std::size_t first = path.find('/'), second = path.find('/', first + 1);
  const std::string top = path.substr(0, first);
  if (second == std::string::npos) return top == "engine" ? "pipeline" : top;
  return path.substr(first + 1, second - first - 1);
}

// Who may include whom, besides itself.
const std::map<std::string, std::set<std::string>> kAllowed = {
    {"core", {}},
    {"geometry", {"core", "numerics"}},
    {"numerics", {"core"}},
    {"io", {"core", "geometry"}},
    {"render", {"core", "geometry"}},
    {"sim", {"core", "geometry", "numerics"}},
    {"bodies", {"core", "geometry", "numerics", "io"}},
    {"stages", {"core", "geometry", "numerics", "bodies", "sim", "io", "render"}},
    {"alter", {"core", "geometry", "numerics", "sim"}},
    {"pipeline", {"core", "geometry", "numerics", "sim", "io", "render", "bodies", "stages", "alter"}},
    {"store", {"core"}},
    {"worker", {"core", "geometry", "io", "render", "bodies", "stages", "alter", "pipeline", "store"}},
    {"http", {"core", "geometry", "io", "render", "bodies", "stages", "alter", "pipeline", "store", "worker"}},
    {"app", {"core", "geometry", "io", "render", "bodies", "stages", "alter", "pipeline", "store", "worker", "http"}},
};

TEST(Architecture, RoomsOnlyIncludeTheRoomsBelowThem) {
  const auto includes = read_includes();
  ASSERT_GT(includes.size(), 100u);
  for (const Include& include : includes) {
    if (!include.quoted) continue;
    const std::string from = room_of(include.file), to = room_of(include.target);
    ASSERT_TRUE(kAllowed.contains(from)) << include.file << " stands in no room of the house";
    EXPECT_TRUE(from == to || kAllowed.at(from).contains(to)) << include.file << " includes " << include.target;
  }
}

TEST(Architecture, IncludesAreWrittenFromTheRoot) {
  for (const Include& include : read_includes()) {
    if (!include.quoted) continue;
    EXPECT_TRUE(fs::exists(fs::path(TOILE_SOURCE_DIR) / include.target))
        << include.file << " includes " << include.target;
  }
}

TEST(Architecture, EveryHeavyLibraryIsSeenByOneFolder) {
  const std::map<std::string, std::set<std::string>> folders = {
      {"CGAL/", {"geometry"}},
      {"embree3/", {"geometry"}},
      {"cholmod.h", {"numerics"}},
      {"suitesparse/", {"numerics"}},
      {"glpk.h", {"numerics"}},
      {"GL/", {"render"}},
      {"png.h", {"render"}},
      {"sqlite3.h", {"store"}},
      {"httplib.h", {"http"}},
      {"CLI/", {"app"}},
      {"cairo", {"io", "render"}},
      {"valijson/", {"io"}},
      {"nlohmann/", {"io", "store", "worker", "http", "app"}},
  };
  int seen = 0;
  for (const Include& include : read_includes())
    for (const auto& [library, rooms] : folders) {
      if (include.quoted || !include.target.starts_with(library)) continue;
      ++seen;
      EXPECT_TRUE(rooms.contains(room_of(include.file))) << include.file << " includes " << include.target;
    }
  EXPECT_GT(seen, 0);
}

TEST(Architecture, OnlyEigenStandsInHeadersOfTheEngine) {
  for (const Include& include : read_includes()) {
    if (include.quoted || !include.file.starts_with("engine/") || !include.file.ends_with(".h")) continue;
    const bool library = include.target.find('/') != std::string::npos || include.target.ends_with(".h") ||
                         include.target.ends_with(".hpp");
    // The JSON helpers name the type without its definition.
    const bool allowed = include.target.starts_with("Eigen/") || include.target == "nlohmann/json_fwd.hpp" ||
                         include.target == "unsupported/Eigen/";
    EXPECT_TRUE(!library || allowed) << include.file << " includes " << include.target;
  }
}

TEST(Architecture, EverySourceNamesItsLicenceFirst) {
  for (const char* folder : {"engine", "jobs", "server", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(TOILE_SOURCE_DIR) / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream in(entry.path());
      std::string line;
      std::getline(in, line);
      EXPECT_EQ(line, "// SPDX-License-Identifier: GPL-3.0-or-later") << entry.path();
    }
}

}  // namespace
