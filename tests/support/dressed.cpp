// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/dressed.h"

#include <map>

#include "engine/bodies/find_skeleton.h"
#include "engine/stages/import_pattern.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"

namespace toile::test {
namespace {

Body body_with_skeleton(const std::string& name) {
  Body body = load_shared_body(name);
  body.skeleton = find_skeleton(body.surface).skeleton;
  return body;
}

BodyGuides guides_of(const Body& body) {
  return find_body_guides(body, SurfaceTree(body.surface.vertices, body.surface.triangles));
}

const std::map<std::string, Place>& places() {
  static const std::map<std::string, Place> table = {{"dress_loose", {1.066, 0.517}},
                                                     {"dress_sleeveless", {1.082, 0.546}},
                                                     {"f_dress_sleeveless", {1.040, 0.437}},
                                                     {"f_leggings", {1.053, 0.090}},
                                                     {"gc_dress_pencil", {0.911, 0.246}},
                                                     {"gc_hoody_mean", {0, 0.996}},
                                                     {"gc_jumpsuit_mean_all", {1.089, 0.079}},
                                                     {"gc_shirt_mean", {0, 1.020}},
                                                     {"leggings_tight", {1.098, 0.098}},
                                                     {"leggings_zero_ease", {1.097, 0.095}},
                                                     {"m_pants", {1.144, 0.113}},
                                                     {"m_tshirt", {0, 0.937}},
                                                     {"pants_straight", {1.098, 0.122}},
                                                     {"shirt_darts_long", {0, 1.008}},
                                                     {"shirt_lapel", {0, 0.889}},
                                                     {"skirt_aline", {1.083, 0.544}},
                                                     {"skirt_circle", {1.080, 0.548}},
                                                     {"skirt_panelled", {1.077, 0.502}},
                                                     {"skirt_pencil", {1.080, 0.412}},
                                                     {"sweater_loose_hood", {0, 0.880}},
                                                     {"tshirt_basic", {0, 0.942}},
                                                     {"tshirt_fitted", {0, 1.079}}};
  return table;
}

}  // namespace

Place expected_place(const std::string& garment) {
  return places().at(garment);
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

Dressing dress(const std::string& garment, int triangles, const std::string& body) {
  const std::string own = body_of_garment(garment), worn_by = body.empty() ? own : body;
  Dressing dressing;
  dressing.pattern = import_pattern(read_file(shared_data("garments/" + garment + "_specification.json")));
  dressing.mesh = mesh_panels(dressing.pattern, {.triangles = triangles, .edge_length = {}});
  dressing.body = body_with_skeleton(worn_by);
  if (worn_by != own) dressing.options.drafted_for = guides_of(body_with_skeleton(own));
  return dressing;
}

}  // namespace toile::test
