// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scenes.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "engine/core/error.h"
#include "tests/support/shared_data.h"
#include "tests/support/shipped_examples.h"

namespace toile::test {
namespace {

struct SharedScene {
  const char *name, *garment, *target;
  bool fitted;
};
// The two bodies of a scene are of one family, so that nothing is registered; but for the scan.
constexpr std::array<SharedScene, 7> kShared = {{{"leggings_tight", "leggings_tight", "ggg_large_male", true},
                                                 {"tshirt_fitted", "tshirt_fitted", "ggg_large_male", true},
                                                 {"dress_sleeveless", "dress_sleeveless", "ggg_small_female", true},
                                                 {"skirt_pencil", "skirt_pencil", "ggg_mean_female", true},
                                                 {"skirt_circle", "skirt_circle", "ggg_mean_female", false},
                                                 {"dress_loose", "dress_loose", "ggg_mean_female", false},
                                                 {"leggings_scan", "leggings_tight", "scan_b", false}}};

struct ShippedScene {
  const char *name, *reference, *target;
};
constexpr std::array<ShippedScene, 6> kShipped = {{{"tube_skirt", "tube-14-100", "tube-18-100"},
                                                   {"a_line_skirt", "woman-38-168", "woman-46-164"},
                                                   {"dress", "woman-38-168", "woman-46-164"},
                                                   {"leggings", "child-128", "woman-38-168"},
                                                   {"t_shirt", "man-50-178", "man-54-186"},
                                                   {"trousers", "man-50-178", "man-54-186"}}};

BodyInput builtin(const std::string& name) {
  return {.name = "builtin:" + name, .bytes = {}};
}

Scene shared_scene(const std::string& name, const std::string& garment, const std::string& target, bool fitted) {
  const std::string file = "garments/" + garment + "_specification.json";
  if (!std::filesystem::exists(shared_data(file)))
    throw Error(ErrorCode::NotFound, "scene:" + name, "no such garment in ../shared/data");
  return {name,
          {file, read_file(shared_data(file))},
          shared_body_input(body_of_garment(garment)),
          shared_body_input(target),
          fitted};
}

}  // namespace

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const ShippedScene& scene : kShipped) names.emplace_back(scene.name);
  for (const SharedScene& scene : kShared) names.emplace_back(scene.name);
  return names;
}

BodyInput shared_body_input(const std::string& name) {
  for (const std::string& place :
       {"bodies/" + name + ".obj", "scans/" + name + ".obj", "scans/" + name + ".ply", "scans/" + name + ".stl"})
    if (std::filesystem::exists(shared_data(place))) return {place, read_file(shared_data(place))};
  throw Error(ErrorCode::NotFound, "body:" + name, "no such body or scan in ../shared/data");
}

Scene named_scene(const std::string& name) {
  for (const ShippedScene& scene : kShipped)
    if (name == scene.name) {
      const std::string file = name + ".json";
      return {name,
              {file, read_file(shipped_example_folder() + file)},
              builtin(scene.reference),
              builtin(scene.target),
              name == "tube_skirt" || name == "leggings"};
    }
  for (const SharedScene& scene : kShared)
    if (name == scene.name) return shared_scene(name, scene.garment, scene.target, scene.fitted);
  if (const std::size_t colon = name.find(':'); colon != std::string::npos)
    return shared_scene(name, name.substr(0, colon), name.substr(colon + 1), false);
  throw Error(ErrorCode::NotFound, "scene:" + name, "no scene of that name, and not of the form GARMENT:BODY");
}

}  // namespace toile::test
