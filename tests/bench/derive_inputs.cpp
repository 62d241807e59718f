// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "engine/render/drawing_picture.h"
#include "engine/stages/draw_pattern.h"
#include "tests/bench/derive.h"
#include "tests/bench/drape_sheets.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

class Stages : public StageCache {
 public:
  Stages(std::string folder, std::size_t most) : folder_(std::move(folder)), most_(most) {
    if (!folder_.empty()) std::filesystem::create_directories(folder_);
  }

  std::optional<Bytes> get(const std::string& key) override {
    if (const auto found = kept_.find(key); found != kept_.end()) return found->second;
    if (folder_.empty()) return std::nullopt;
    std::ifstream in(folder_ + "/" + key, std::ios::binary);
    if (!in) return std::nullopt;
    return Bytes{std::istreambuf_iterator<char>(in), {}};
  }

  void put(const std::string& key, const Bytes& value) override {
    if (folder_.empty()) {
      if (kept_.size() < most_) kept_.emplace(key, value);
      return;
    }
    std::ofstream(folder_ + "/" + key, std::ios::binary)
        .write(reinterpret_cast<const char*>(value.data()), static_cast<std::streamsize>(value.size()));
  }

 private:
  std::string folder_;
  std::size_t most_;
  std::map<std::string, Bytes> kept_;
};

std::vector<std::string> parts_of(const std::string& list) {
  std::vector<std::string> parts;
  std::istringstream in(list);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

// The garments and bodies that each table is asked for, where none are named.
void fill_in(DeriveRequest& request) {
  using Names = std::vector<std::string>;
  const bool pairs = request.what.empty();
  if (request.garments.empty() && pairs)
    request.garments = {"leggings_tight", "leggings_zero_ease", "tshirt_fitted",    "pants_straight",
                        "skirt_pencil",   "dress_sleeveless",   "shirt_darts_long", "sweater_loose_hood"};
  if (request.garments.empty())
    request.garments = request.what == "growth" || request.what == "sweeps"
                           ? Names{"tshirt_fitted"}
                           : Names{"leggings_tight", "tshirt_fitted", "dress_sleeveless"};
  if (!request.bodies.empty()) return;
  if (pairs) request.bodies = {"ggg_small_female", "ggg_mean_female", "ggg_male_extra", "ggg_large_male", "scan_b"};
  if (request.what == "trips") request.bodies = {"ggg_large_male", "ggg_small_female", "ggg_mean_male"};
  if (request.bodies.empty()) request.bodies = {"ggg_large_male"};
}

}  // namespace

DeriveRequest derive_request(const std::vector<std::string>& words) {
  DeriveRequest request;
  request.options.triangles = 4000;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const bool more = i + 1 < words.size();
    if (word == "trips" || word == "growth" || word == "random" || word == "sweeps")
      request.what = word;
    else if (word == "--asymmetric")
      request.options.symmetry = SymmetryMode::Off;
    else if (word == "--triangles" && more)
      request.options.triangles = std::atoi(words[++i].c_str());
    else if (word == "--count" && more)
      request.count = std::atoi(words[++i].c_str());
    else if (word == "--bodies" && more)
      request.bodies = parts_of(words[++i]);
    else if (word == "--pictures" && more)
      request.pictures = words[++i];
    else if (word == "--stages" && more)
      request.stages = words[++i];
    else
      request.garments.push_back(word);
  }
  fill_in(request);
  return request;
}

void write_changes(const std::string& folder, const std::string& name, const Pattern& original,
                   const Pattern& changed) {
  DrawingPictureOptions options;
  options.title = name;
  write_picture(folder, name, draw_picture(draw_changes(original, changed), options));
}

GarmentInput shared_garment(const std::string& name) {
  return {name, test::read_file(test::shared_data("garments/" + name + "_specification.json"))};
}

BodyInput shared_wearer(const std::string& name) {
  BodyInput body;
  body.name = name;
  body.bytes = name.starts_with("scan") ? test::shared_scan_bytes(name)
                                        : test::read_file(test::shared_data("bodies/" + name + ".obj"));
  return body;
}

std::unique_ptr<StageCache> stage_store(const std::string& folder, std::size_t most) {
  return std::make_unique<Stages>(folder, most);
}

DerivedGarment derive_pair(const std::string& garment, const std::string& body, const AlterOptions& options,
                           StageCache* stages) {
  StageRunner runner(stages, nullptr, kDeriveStages);
  return derive_garment(shared_garment(garment), shared_wearer(test::body_of_garment(garment)), shared_wearer(body),
                        options, runner)
      .value;
}

}  // namespace toile::bench
