// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "engine/geometry/curve.h"
#include "engine/io/drape_obj.h"
#include "engine/stages/import_pattern.h"
#include "engine/stages/mesh_panels.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

// Positions that differ for every node and lie near the placed panels: a drape as far as joining borders goes.
Drape scattered_drape(const Pattern& pattern, const PatternMesh& mesh) {
  Drape drape;
  drape.nodes = Points3::Zero(mesh.node_count, 3);
  std::vector<double> members(static_cast<std::size_t>(mesh.node_count), 0.0);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Panel& panel = pattern.panels[static_cast<std::size_t>(mesh.panel_of_vertex[static_cast<std::size_t>(v)])];
    const auto node = static_cast<std::size_t>(mesh.node_of_vertex[static_cast<std::size_t>(v)]);
    drape.nodes.row(static_cast<Eigen::Index>(node)) +=
        (panel.rotation * Vec3(mesh.rest(v, 0), mesh.rest(v, 1), 0) + panel.translation).transpose();
    members[node] += 1.0;
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-1e-3, 1e-3);
  for (int n = 0; n < mesh.node_count; ++n) {
    drape.nodes.row(n) /= members[static_cast<std::size_t>(n)];
    for (int k = 0; k < 3; ++k) drape.nodes(n, k) += shift(random);
  }
  return drape;
}

TEST(ImportGarment, ADrapedGarmentWrittenAsObjComesBackWithItsPanelsAndSeams) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const std::string& name : test::shared_garment_names()) {
    SCOPED_TRACE(name);
    const Pattern pattern =
        import_pattern(test::read_file(test::shared_data("garments/" + name + "_specification.json")));
    const PatternMesh mesh = mesh_panels(pattern, {3000, {}});
    const Bytes obj = write_drape_obj(pattern, mesh, scattered_drape(pattern, mesh));
    ImportGarmentOptions options;
    options.metre_per_uv_unit = 0.01;
    const ImportedGarment garment = import_garment(obj, "garment.obj", options);
    ASSERT_TRUE(garment.mesh && garment.drape);
    EXPECT_EQ(garment.mesh->triangle_count(), mesh.triangle_count());
    EXPECT_EQ(garment.mesh->vertex_count(), mesh.vertex_count());
    EXPECT_EQ(garment.mesh->node_count, mesh.node_count);
    ASSERT_EQ(garment.pattern.panels.size(), pattern.panels.size());
    for (std::size_t p = 0; p < pattern.panels.size(); ++p) {
      EXPECT_EQ(garment.pattern.panels[p].name, pattern.panels[p].name);
      const double area = outline_signed_area(pattern.panels[p]);
      EXPECT_NEAR(outline_signed_area(garment.pattern.panels[p]), area, 0.01 * std::abs(area));
      EXPECT_EQ(garment.mesh->panel_reversed[p], mesh.panel_reversed[p]);
    }
    std::size_t sewn = 0, sewn_before = 0;
    for (const auto& seam : garment.mesh->seam_vertices) sewn += seam.size() - 1;
    for (const auto& seam : mesh.seam_vertices) sewn_before += seam.size() - 1;
    EXPECT_EQ(sewn, sewn_before);
  }
}

TEST(ImportGarment, ReadsASpecificationWithoutADrape) {
  TOILE_REQUIRE_SHARED_DATA();
  const ImportedGarment garment =
      import_garment(test::read_file(test::shared_data("garments/tshirt_basic_specification.json")), "tshirt.json");
  EXPECT_FALSE(garment.mesh);
  EXPECT_FALSE(garment.pattern.seams.empty());
}

}  // namespace
}  // namespace toile
