// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "engine/geometry/curve.h"
#include "engine/geometry/self_crossing.h"
#include "tests/bench/derive.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

class Stages : public StageCache {
 public:
  explicit Stages(std::string folder) : folder_(std::move(folder)) {
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
      kept_.emplace(key, value);
      return;
    }
    std::ofstream(folder_ + "/" + key, std::ios::binary)
        .write(reinterpret_cast<const char*>(value.data()), static_cast<std::streamsize>(value.size()));
  }

 private:
  std::string folder_;
  std::map<std::string, Bytes> kept_;
};

}  // namespace

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

std::unique_ptr<StageCache> stage_store(const std::string& folder) {
  return std::make_unique<Stages>(folder);
}

DerivedGarment derive_pair(const std::string& garment, const std::string& body, const AlterOptions& options,
                           StageCache* stages) {
  StageRunner runner(stages, nullptr, kDeriveStages);
  return derive_garment(shared_garment(garment), shared_wearer(test::body_of_garment(garment)), shared_wearer(body),
                        options, runner)
      .value;
}

bool crosses_itself(const Panel& panel) {
  constexpr double kChords = 2e-5, kTouch = 1e-6;  // m
  std::vector<Vec2> polygon;
  for (int e = 0; e < panel.edge_count(); ++e) {
    const std::vector<Vec2> points = flatten_curve(edge_curve(panel, e), kChords);
    polygon.insert(polygon.end(), points.begin(), points.end() - 1);
  }
  return find_self_crossing(polygon, kTouch).has_value();
}

}  // namespace toile::bench
