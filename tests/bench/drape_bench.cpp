// SPDX-License-Identifier: GPL-3.0-or-later
// drape [GARMENT...] [--triangles N] [--body NAME] [--iterations N] [--pictures FOLDER]: sews and drapes garments of
// ../shared/data from flat; CPU time beside the quality reached; growth over 4k, 10k and 20k triangles with `growth`.
#include <cstdio>
#include <fstream>

#include "engine/core/error.h"
#include "engine/core/units.h"
#include "engine/render/contact_sheet.h"
#include "engine/stages/render_views.h"
#include "tests/bench/bench.h"
#include "tests/support/dressed.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

struct Request {
  std::vector<std::string> garments;
  std::string body, folder;
  int triangles = 4300, iterations = 1500;
  bool growth = false;
};

Request parse(const std::vector<std::string>& words) {
  Request request;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool more = i + 1 < words.size();
    if (words[i] == "--triangles" && more)
      request.triangles = std::atoi(words[++i].c_str());
    else if (words[i] == "--iterations" && more)
      request.iterations = std::atoi(words[++i].c_str());
    else if (words[i] == "--body" && more)
      request.body = words[++i];
    else if (words[i] == "--pictures" && more)
      request.folder = words[++i];
    else if (words[i] == "growth")
      request.growth = true;
    else
      request.garments.push_back(words[i]);
  }
  if (request.garments.empty()) request.garments = test::shared_garment_names();
  return request;
}

double waist_height(const Pattern& pattern, const PatternMesh& mesh, const Drape& drape) {
  double sum = 0;
  int count = 0;
  for (std::size_t p = 0; p < pattern.panels.size(); ++p)
    for (std::size_t e = 0; e < pattern.panels[p].edges.size(); ++e)
      if (pattern.panels[p].edges[e].label == "lower_interface")
        for (int v : mesh.edge_vertices[p][e])
          sum += drape.nodes(mesh.node_of_vertex[static_cast<std::size_t>(v)], 1), ++count;
  return count > 0 ? sum / count : 0.0;
}

std::string names_of(const std::vector<DrapeFinding>& findings) {
  std::string names;
  for (const DrapeFinding& finding : findings) names += (names.empty() ? "" : " ") + finding.name;
  return names;
}

void write_picture(const std::string& folder, const std::string& name, const test::Dressing& d, const Drape& drape) {
  ViewOptions options;
  options.views = {View::Front, View::Left, View::Back};
  options.view_height = options.max_view_width = 360;
  options.legend = false;
  options.title = name;
  const Bytes png = render_views(&d.body.surface, &d.mesh, &drape, nullptr, options);
  std::ofstream(folder + "/" + name + ".png", std::ios::binary)
      .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
}

double run_one(const Request& request, const std::string& name, int triangles, Table& table) {
  test::Dressing d = test::dress(name, triangles, request.body);
  d.options.iterations = request.iterations;
  const double start = cpu_seconds();
  try {
    const DrapeResult r = drape(d.pattern, d.mesh, d.body, d.options, nullptr);
    const double took = cpu_seconds() - start;
    const DrapeQuality& q = r.quality;
    table.add({name, std::to_string(d.mesh.triangle_count()), fixed(took, 2), std::to_string(r.diagnostics.iterations),
               std::string(rest_name(q.rest)), fixed(q.residual, 2), fixed(1e3 * q.settling_move, 2),
               fixed(100 * q.weft.p99, 1), fixed(100 * q.warp.p99, 1), std::to_string(q.nodes_inside),
               std::to_string(q.edges_inside), fixed(1e3 * q.deepest_edge, 1),
               fixed(waist_height(d.pattern, d.mesh, r.drape), 3), fixed(r.drape.nodes.col(1).minCoeff(), 3),
               fixed(100 * q.crossing_share, 2), std::to_string(r.diagnostics.rung), names_of(r.diagnostics.findings)});
    if (!request.folder.empty()) write_picture(request.folder, name, d, r.drape);
    return took;
  } catch (const Error& error) {
    table.add({name, std::to_string(d.mesh.triangle_count()), fixed(cpu_seconds() - start, 2), error.message});
    return 0;
  }
}

}  // namespace

int bench_drape(const Arguments& arguments) {
  if (!test::has_shared_data()) {
    std::fprintf(stderr, "toile-bench drape needs ../shared/data\n");
    return 2;
  }
  const Request request = parse(arguments.words);
  Table table({"garment", "triangles", "CPU s", "it", "rest", "residual", "move mm", "weft p99 %", "warp p99 %",
               "nodes > 1 mm", "edges > 3 mm", "edge mm", "waist m", "lowest m", "crossing %", "rung", "findings"});
  for (const std::string& name : request.garments) {
    if (!request.growth) {
      run_one(request, name, request.triangles, table);
      continue;
    }
    std::vector<double> sizes, times;
    for (int triangles : {4000, 10000, 20000}) {
      times.push_back(run_one(request, name, triangles, table));
      sizes.push_back(triangles);
    }
    table.add({name, "growth", "n^" + fixed(growth_exponent(sizes, times), 2)});
  }
  table.print(arguments.csv);
  std::printf("peak memory %.0f MB\n", peak_memory_mb());
  return 0;
}

}  // namespace toile::bench
