// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/alter_pairs.h"

#include <filesystem>
#include <fstream>

#include "engine/pipeline.h"
#include "engine/stages/mesh_panels.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

namespace fs = std::filesystem;

BodyInput body_input(const std::string& name) {
  for (const std::string& place : {"bodies/" + name + ".obj", "scans/" + name + ".obj", "scans/" + name + ".ply"})
    if (fs::exists(test::shared_data(place))) return {place, test::read_file(test::shared_data(place))};
  throw Error(ErrorCode::NotFound, "body:" + name, "no such body or scan in ../shared/data");
}

Points2 derive(const GarmentInput& garment, const AlterPair& pair, int triangles) {
  AlterOptions options;
  options.triangles = triangles;
  StageRunner runner(nullptr, nullptr, kDeriveStages);
  return derive_garment(garment, body_input(test::body_of_garment(pair.garment)), body_input(pair.body), options,
                        runner)
      .value.derived.mesh.rest;
}

}  // namespace

std::vector<AlterPair> acceptance_pairs() {
  std::vector<AlterPair> pairs;
  for (const char* garment : {"leggings_tight", "leggings_zero_ease", "tshirt_fitted", "pants_straight", "skirt_pencil",
                              "dress_sleeveless", "shirt_darts_long", "sweater_loose_hood"})
    for (const char* body : {"ggg_small_female", "ggg_mean_female", "ggg_male_extra", "ggg_large_male", "scan_b"})
      pairs.push_back({garment, body});
  return pairs;
}

DerivedPair derive_pair(const AlterPair& pair, int triangles, const std::string& cache) {
  const std::string file = "garments/" + pair.garment + "_specification.json";
  const GarmentInput garment{file, test::read_file(test::shared_data(file))};
  DerivedPair derived;
  derived.pattern = read_garment(garment);
  derived.mesh = mesh_panels(derived.pattern, {.triangles = triangles});
  const fs::path kept = fs::path(cache) / (pair.garment + "_" + pair.body + "_" + std::to_string(triangles));
  derived.target_rest.resize(derived.mesh.vertex_count(), 2);
  const auto bytes = static_cast<std::streamsize>(sizeof(double)) * derived.target_rest.size();
  std::ifstream in(kept, std::ios::binary);
  if (!cache.empty() && in.read(reinterpret_cast<char*>(derived.target_rest.data()), bytes)) return derived;
  derived.target_rest = derive(garment, pair, triangles);
  if (cache.empty()) return derived;
  fs::create_directories(cache);
  std::ofstream(kept, std::ios::binary).write(reinterpret_cast<const char*>(derived.target_rest.data()), bytes);
  return derived;
}

}  // namespace toile::bench
