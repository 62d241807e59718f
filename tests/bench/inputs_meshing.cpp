// SPDX-License-Identifier: GPL-3.0-or-later
// Meshing of panels: time and growth from 2.5k to 40k triangles, beside the quality it was reached with.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "engine/stages/import_pattern.h"
#include "engine/stages/mesh_panels.h"
#include "tests/bench/inputs.h"
#include "tests/support/shared_data.h"

namespace toile::bench {

namespace {

struct Quality {
  double least_inner_angle = 180.0;  // degrees, away from outline corners and paired borders
  double least_area = 1e9;           // m^2
};

Quality quality_of(const PatternMesh& mesh) {
  std::set<int> excused;
  for (const auto& seam : mesh.seam_vertices)
    for (const auto& [a, b] : seam) excused.insert(a), excused.insert(b);
  for (const auto& panel : mesh.edge_vertices)
    for (const auto& edge : panel) excused.insert(edge.front());
  Quality quality;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    std::array<Vec2, 3> p;
    bool inner = true;
    for (int k = 0; k < 3; ++k) {
      p[static_cast<std::size_t>(k)] = mesh.rest.row(mesh.triangles(f, k));
      inner = inner && !excused.contains(mesh.triangles(f, k));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 u = p[(k + 1) % 3] - p[k], w = p[(k + 2) % 3] - p[k];
      const double twice = u.x() * w.y() - u.y() * w.x();
      quality.least_area = std::min(quality.least_area, 0.5 * twice);
      if (inner)
        quality.least_inner_angle = std::min(quality.least_inner_angle, std::atan2(twice, u.dot(w)) * 180.0 / M_PI);
    }
  }
  return quality;
}

}  // namespace

void bench_meshing(const Arguments& arguments) {
  Table table({"garment", "asked", "triangles", "nodes", "mesh_ms", "import_ms", "least_angle_deg", "least_area_mm2",
               "growth"});
  for (const char* name : {"tshirt_basic", "dress_sleeveless", "shirt_lapel", "skirt_circle", "gc_jumpsuit_mean_all"}) {
    const Bytes bytes = test::read_file(test::shared_data("garments/" + std::string(name) + "_specification.json"));
    Pattern pattern;
    const Timing import = time_cpu(arguments.repeats, [&] { pattern = import_pattern(bytes); });
    std::vector<double> sizes, times;
    for (const int triangles : {2500, 5000, 10000, 20000, 40000}) {
      PatternMesh mesh;
      const Timing timing = time_cpu(arguments.repeats, [&] { mesh = mesh_panels(pattern, {triangles, {}}); });
      sizes.push_back(mesh.triangle_count());
      times.push_back(timing.median);
      const Quality quality = quality_of(mesh);
      table.add({name, std::to_string(triangles), std::to_string(mesh.triangle_count()),
                 std::to_string(mesh.node_count), fixed(timing.median * 1e3, 2), fixed(import.median * 1e3, 2),
                 fixed(quality.least_inner_angle, 1), fixed(quality.least_area * 1e6, 2),
                 triangles == 40000 ? "n^" + fixed(growth_exponent(sizes, times), 2) : ""});
    }
  }
  std::printf("Panels (CPU, median of %d)\n", arguments.repeats);
  table.print(arguments.csv.empty() ? "" : arguments.csv + ".meshing.csv");
}

}  // namespace toile::bench
