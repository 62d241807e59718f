// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies in: reading, repairing and normalising scans of 2.5k to 50k triangles, beside what the result misses.
#include <cstdio>

#include "engine/bodies/import_body.h"
#include "engine/geometry/closest_point.h"
#include "engine/geometry/decimate.h"
#include "engine/geometry/half_edges.h"
#include "engine/io/mesh_file.h"
#include "tests/bench/inputs.h"
#include "tests/support/shared_body.h"
#include "tests/support/sidecar.h"

namespace toile::bench {

namespace {

struct Split {
  double read = 0, clean = 0, normalise = 0, close = 0;  // CPU seconds
};

// The steps of import_body one by one, for their shares.
Split time_steps(const Bytes& bytes, const std::string& name, int repeats) {
  TriangleMesh read, clean, normal, closed;
  Split split;
  split.read = time_cpu(repeats, [&] { read = read_mesh(bytes, name); }).median;
  split.clean = time_cpu(repeats, [&] { clean = read, clean_mesh(clean); }).median;
  split.normalise = time_cpu(repeats, [&] { normal = normalise_body(clean).surface; }).median;
  split.close = time_cpu(repeats, [&] { closed = normal, close_holes(closed, {.lowest_y = 0.0}); }).median;
  return split;
}

// Mean distance of the imported skin to the body the scan was made of, mm (the arms of scan d were lowered).
double miss_mm(const Body& body, const test::ScanSidecar& sidecar) {
  const Mat4 m = body.normalised_from_file * sidecar.scan_from_body;
  TriangleMesh source = test::load_shared_body(sidecar.source_body).surface;
  source.vertices =
      (source.vertices * m.topLeftCorner<3, 3>().transpose()).rowwise() + m.topRightCorner<3, 1>().transpose();
  const SurfaceTree truth(source.vertices, source.triangles);
  double sum = 0;
  for (int v = 0; v < body.surface.vertex_count(); ++v)
    sum += truth.closest_point(body.surface.vertices.row(v).transpose()).distance();
  return 1e3 * sum / body.surface.vertex_count();
}

void add_row(Table& table, const std::string& scan, const Bytes& bytes, int repeats, std::vector<double>& sizes,
             std::vector<double>& times) {
  ImportBodyResult result;
  const Timing whole = time_cpu(repeats, [&] { result = import_body(bytes, scan); });
  const Split split = time_steps(bytes, scan, repeats);
  const bool closed = find_defects(result.body.surface.vertex_count(), result.body.surface.triangles).none();
  sizes.push_back(result.file_triangles);
  times.push_back(whole.median);
  table.add({scan, std::to_string(result.file_triangles), fixed(1e3 * whole.median, 1), fixed(1e3 * split.read, 1),
             fixed(1e3 * split.clean, 1), fixed(1e3 * split.normalise, 1), fixed(1e3 * split.close, 1),
             std::to_string(result.repairs.holes.size()), closed ? "yes" : "NO",
             fixed(miss_mm(result.body, test::load_scan_sidecar(scan)), 2)});
}

}  // namespace

void bench_bodies(const Arguments& arguments) {
  Table table({"scan", "triangles", "all_ms", "read_ms", "clean_ms", "normalise_ms", "close_ms", "holes", "closed",
               "mean_miss_mm"});
  std::string growth;
  for (const std::string scan : {"scan_a", "scan_b", "scan_c", "scan_d"}) {
    std::vector<double> sizes, times;
    if (scan == "scan_a") {
      TriangleMesh coarse = test::load_shared_scan(scan);
      clean_mesh(coarse);
      for (const int triangles : {2500, 5000, 10000, 20000, 40000})
        add_row(table, scan, write_ply(decimate(coarse, triangles / 2)), arguments.repeats, sizes, times);
      growth = fixed(growth_exponent(sizes, times), 2);
    }
    add_row(table, scan, test::shared_scan_bytes(scan), arguments.repeats, sizes, times);
  }
  std::printf("Bodies (CPU, median of %d); time grows with triangles^%s\n", arguments.repeats, growth.c_str());
  table.print(arguments.csv.empty() ? "" : arguments.csv + ".bodies.csv");
}

}  // namespace toile::bench
