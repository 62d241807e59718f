// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/random_body.h"

#include <random>

#include "engine/io/mesh_file.h"
#include "tests/support/shared_body.h"

namespace toile::bench {
namespace {

const std::vector<std::string> kFamily = {"ggg_mean_all",     "ggg_mean_female", "ggg_mean_male",
                                          "ggg_small_female", "ggg_large_male",  "ggg_male_extra"};

// Uniform numbers are made from the engine's bits alone.
class Draw {
 public:
  explicit Draw(int number) : engine_(static_cast<std::uint64_t>(number) + 1) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1.0p-53;
  }
  std::size_t index(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace

std::vector<TriangleMesh> shared_family() {
  std::vector<TriangleMesh> family;
  for (const std::string& name : kFamily) family.push_back(test::load_shared_body(name).surface);
  return family;
}

BodyInput random_body(int number, const std::vector<TriangleMesh>& family) {
  Draw draw(number);
  const TriangleMesh &a = family[draw.index(family.size())], &b = family[draw.index(family.size())];
  const double mix = draw.between(0.0, 1.0), height = draw.between(1.45, 2.0);
  TriangleMesh mesh = a;
  mesh.vertices = (1.0 - mix) * a.vertices + mix * b.vertices;
  const double tall = height / (mesh.vertices.col(1).maxCoeff() - mesh.vertices.col(1).minCoeff());
  mesh.vertices.col(0) *= tall * draw.between(0.92, 1.1);
  mesh.vertices.col(1) *= tall;
  mesh.vertices.col(2) *= tall * draw.between(0.92, 1.1);
  BodyInput body;
  body.name = "random-" + std::to_string(number);
  body.bytes = write_obj(mesh);
  return body;
}

}  // namespace toile::bench
