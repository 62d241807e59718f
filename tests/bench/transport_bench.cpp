// SPDX-License-Identifier: GPL-3.0-or-later
// transport [GARMENT...] [--body NAME] [--triangles N] [--pictures FOLDER]: garments carried from the body they were
// drafted for to the other bodies of ../shared/data, and draped there: depth after transport, the gates of a drape.
#include <cstdio>
#include <fstream>

#include "engine/bodies/register_bodies.h"
#include "engine/core/error.h"
#include "engine/render/contact_sheet.h"
#include "engine/stages/render_views.h"
#include "engine/stages/transport_garment.h"
#include "tests/bench/bench.h"
#include "tests/bench/drape_sheets.h"
#include "tests/bench/words.h"
#include "tests/support/dressed.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

struct TransportRequest {
  std::vector<std::string> garments, bodies;
  std::string folder;
  int triangles = 2500;
};

TransportRequest transport_request(Words words) {
  TransportRequest request;
  request.triangles = words.integer("--triangles").value_or(request.triangles);
  request.folder = words.text("--pictures").value_or("");
  while (const auto body = words.text("--body")) request.bodies.push_back(*body);
  request.garments = words.rest();
  if (request.garments.empty())
    request.garments = {"leggings_tight", "tshirt_fitted", "dress_sleeveless", "pants_straight", "skirt_circle"};
  if (request.bodies.empty()) request.bodies = test::shared_body_names();
  return request;
}

void write_picture(const std::string& file, const Body& body, const PatternMesh& mesh, const Drape& carried,
                   const Drape& draped) {
  ViewOptions options;
  options.views = {View::Front, View::Left, View::Back};
  options.view_height = options.max_view_width = 360;
  options.legend = false;
  for (const auto& [name, drape] : {std::pair("_carried", &carried), std::pair("_draped", &draped)}) {
    options.title = name + 1;
    const Bytes png = render_views(&body.surface, &mesh, drape, nullptr, options);
    std::ofstream(file + name + ".png", std::ios::binary)
        .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  }
}

// One garment, draped once on its own body, and everything that is worn by others.
class Wardrobe {
 public:
  Wardrobe(const TransportRequest& request, const std::string& garment)
      : request_(request), garment_(garment), own_(test::dress(garment, request.triangles)) {
    reference_drape_ = drape(own_.pattern, own_.mesh, own_.body, own_.options, nullptr).drape;
  }

  void try_on(const std::string& name, const BodyMap& map, const Body& body, Table& table) const {
    double start = cpu_seconds();
    const Drape carried = transport_garment(own_.mesh, reference_drape_, own_.body, body, map).drape;
    const double transport = cpu_seconds() - start;
    const SurfaceTree surface(body.surface.vertices, body.surface.triangles);
    const DrapeQuality before = measure_drape(own_.mesh, surface, carried);
    start = cpu_seconds();
    const DrapeResult r = drape_from(own_.pattern, own_.mesh, body, carried, own_.options, nullptr);
    const double draped = cpu_seconds() - start;
    const DrapeQuality& q = r.quality;
    table.add({garment_, name, map.exact ? "exact" : "found", fixed(transport, 2), fixed(draped, 2),
               fixed(1e3 * before.deepest_node, 2), std::to_string(before.crossing_pairs),
               std::string(rest_name(q.rest)), fixed(q.residual, 2), fixed(1e3 * q.deepest_node, 2),
               fixed(1e3 * q.deepest_edge, 1), fixed(100 * q.crossing_share, 2), fixed(r.diagnostics.hold_height, 3),
               names_of(r.diagnostics.findings)});
    if (!request_.folder.empty())
      write_picture(request_.folder + "/" + garment_ + "_" + name, body, own_.mesh, carried, r.drape);
  }

  const Body& body() const { return own_.body; }

 private:
  const TransportRequest& request_;
  std::string garment_;
  test::Dressing own_;
  Drape reference_drape_;
};

}  // namespace

int bench_transport(const Arguments& arguments) {
  if (!test::has_shared_data()) return std::fprintf(stderr, "../shared/data is not beside this checkout\n"), 3;
  const TransportRequest request = transport_request(Words(arguments.words));
  Table table({"garment", "body", "map", "transport s", "drape s", "carried mm", "crossings", "rest", "residual",
               "node mm", "edge mm", "crossing %", "hold m", "findings"});
  std::map<std::string, Body> bodies;
  std::map<std::pair<std::string, std::string>, BodyMap> maps;  // from the body a garment was drafted for
  for (const std::string& garment : request.garments) {
    const Wardrobe wardrobe(request, garment);
    for (const std::string& name : request.bodies) {
      if (!bodies.contains(name)) bodies[name] = test::dress(garment, 500, name).body;
      BodyMap& map = maps[{test::body_of_garment(garment), name}];
      if (map.mapped.rows() == 0) map = register_bodies(wardrobe.body(), bodies[name]).map;
      wardrobe.try_on(name, map, bodies[name], table);
    }
  }
  table.print(arguments.csv);
  return 0;
}

}  // namespace toile::bench
