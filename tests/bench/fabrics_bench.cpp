// SPDX-License-Identifier: GPL-3.0-or-later
// fabrics [FABRIC...] [--rings N] [--growth]: the textile laboratory. Cantilever (ASTM D1388) against the heavy
// elastica, drape meter (ISO 9073-9) against the band published for such cloth, tensile strips in warp, weft and bias.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <numbers>

#include "engine/core/units.h"
#include "engine/stages/render_views.h"
#include "tests/bench/bench.h"
#include "tests/bench/words.h"
#include "tests/support/fabric_lab.h"

namespace toile::bench {
namespace {

struct FabricsRequest {
  std::vector<std::string> fabrics;
  std::string folder;
  int rings = 11;
  bool growth = false;
};

FabricsRequest fabrics_request(Words words) {
  FabricsRequest request;
  request.rings = words.integer("--rings").value_or(request.rings);
  request.folder = words.text("--pictures").value_or("");
  request.growth = words.flag("--growth");
  request.fabrics = words.rest();
  if (request.fabrics.empty()) request.fabrics = fabric_names();
  return request;
}

void write_picture(const FabricsRequest& request, const std::string& name, const test::Specimen& s) {
  if (request.folder.empty()) return;
  ViewOptions options;
  options.views = {View::Front, View::Left};
  options.view_height = options.max_view_width = 420;
  options.legend = false;
  options.title = name;
  const Bytes png = render_views(nullptr, &s.mesh, &s.drape, nullptr, options);
  std::ofstream(request.folder + "/" + name + ".png", std::ios::binary)
      .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
}

std::string triangles_of(const test::DrapeMeter& meter) {
  return std::to_string(meter.drops.front().specimen.mesh.triangle_count());
}

// Of every drop.
std::string folds_of(const test::DrapeMeter& meter) {
  std::string folds;
  for (const test::DrapeDrop& drop : meter.drops) folds.append(folds.empty() ? 0 : 1, ' ').append(fixed(drop.folds, 0));
  return folds;
}

std::string worst_residual(const test::DrapeMeter& meter) {
  double worst = 0;
  for (const test::DrapeDrop& drop : meter.drops) worst = std::max(worst, drop.specimen.residual);
  return fixed(worst, 3);
}

// Extension at the load at which cloth is compared: 98 N/m (100 gf/cm, FAST-3).
constexpr double kLoad = 98.1;

void run_one(const FabricsRequest& request, const Fabric& fabric, Table& table) {
  const double start = cpu_seconds();
  const test::Cantilever strip = test::cantilever(fabric, 12);
  const test::DrapeMeter meter = test::drape_meter(fabric, request.rings);
  constexpr double kPi = std::numbers::pi;
  const test::TensileStrip warp = test::tensile_strip(fabric, 0, kLoad),
                           weft = test::tensile_strip(fabric, kPi / 2, kLoad),
                           bias = test::tensile_strip(fabric, kPi / 4, kLoad);
  write_picture(request, fabric.name + "_cantilever", strip.specimen);
  write_picture(request, fabric.name + "_drape", meter.drops.front().specimen);
  write_picture(request, fabric.name + "_bias", bias.specimen);
  table.add({fabric.name, fixed(1e3 * strip.bending_length(), 1), percent(strip.overhang / strip.exact_overhang - 1),
             triangles_of(meter), percent(meter.coefficient), percent(meter.spread), folds_of(meter),
             worst_residual(meter), percent(warp.extension), percent(weft.extension), percent(bias.extension),
             fixed(cpu_seconds() - start, 1)});
}

void run_growth(const Fabric& fabric, Table& table) {
  for (int rings : {7, 11, 15, 23}) {
    const double start = cpu_seconds();
    const test::DrapeMeter meter = test::drape_meter(fabric, rings);
    table.add({fabric.name, triangles_of(meter), percent(meter.coefficient), percent(meter.spread), folds_of(meter),
               worst_residual(meter), fixed(cpu_seconds() - start, 1)});
  }
}

}  // namespace

int bench_fabrics(const Arguments& arguments) {
  const FabricsRequest request = fabrics_request(Words(arguments.words));
  Table table(request.growth
                  ? std::vector<std::string>{"fabric", "triangles", "drape %", "spread", "folds", "residual", "CPU s"}
                  : std::vector<std::string>{"fabric", "bending length mm", "off elastica %", "triangles", "drape %",
                                             "spread", "folds", "residual", "warp % at 98 N/m", "weft %", "bias %",
                                             "CPU s"});
  for (const std::string& name : request.fabrics) {
    const std::optional<Fabric> fabric = fabric_named(name);
    if (!fabric) {
      std::fprintf(stderr, "no fabric is called %s\n", name.c_str());
      return 2;
    }
    if (request.growth)
      run_growth(*fabric, table);
    else
      run_one(request, *fabric, table);
  }
  table.print(arguments.csv);
  return 0;
}

}  // namespace toile::bench
