// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/geometry/curve.h"
#include "engine/io/drape_obj.h"
#include "engine/io/worn_garment.h"
#include "engine/stages/build_fitting_map.h"
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

// Tensors that differ for every triangle, within what the file keeps of them.
FittingMap some_fit(const PatternMesh& mesh) {
  std::vector<Mat2> tensors;
  for (int f = 0; f < mesh.triangle_count(); ++f)
    tensors.push_back((Mat2() << 1.0 + 1e-5 * f, -0.02, 0.0, 1.1 - 1e-5 * f).finished());
  return fitting_map_of(mesh, std::move(tensors));
}

TEST(WornGarment, ComesBackVertexForVertexWithTheFitItWasDerivedFor) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const std::string& name : test::shared_garment_names()) {
    SCOPED_TRACE(name);
    const Pattern pattern =
        import_pattern(test::read_file(test::shared_data("garments/" + name + "_specification.json")));
    const PatternMesh mesh = mesh_panels(pattern, {2000, {}});
    const Drape drape = scattered_drape(pattern, mesh);
    const FittingMap fit = some_fit(mesh);
    const WornGarment worn = read_worn_garment(write_drape_obj(pattern, mesh, drape, &fit), "worn", pattern);
    EXPECT_LT((worn.mesh.rest - mesh.rest).cwiseAbs().maxCoeff(), 1e-7);
    EXPECT_LT((worn.drape.nodes - drape.nodes).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_EQ(worn.mesh.triangles, mesh.triangles);
    EXPECT_EQ(worn.mesh.node_of_vertex, mesh.node_of_vertex);
    EXPECT_EQ(worn.mesh.panel_reversed, mesh.panel_reversed);
    EXPECT_EQ(worn.mesh.edge_vertices, mesh.edge_vertices);
    EXPECT_EQ(worn.mesh.seam_vertices, mesh.seam_vertices);
    ASSERT_EQ(worn.wanted.size(), fit.tensor.size());
    for (std::size_t f = 0; f < fit.tensor.size(); ++f)
      EXPECT_LT((worn.wanted[f] - fit.tensor[f]).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_TRUE(read_worn_garment(write_drape_obj(pattern, mesh, drape), "worn", pattern).wanted.empty());
  }
}

TEST(WornGarment, OfAnotherPatternIsRefused) {
  TOILE_REQUIRE_SHARED_DATA();
  const auto read = [](const char* name) {
    return import_pattern(test::read_file(test::shared_data(std::string("garments/") + name + "_specification.json")));
  };
  const Pattern pattern = read("tshirt_fitted");
  const PatternMesh mesh = mesh_panels(pattern, {2000, {}});
  const Bytes worn = write_drape_obj(pattern, mesh, scattered_drape(pattern, mesh));
  EXPECT_THROW(read_worn_garment(worn, "worn", read("leggings_tight")), Error);
  Pattern longer = pattern;
  longer.panels[0].corners[0].y() += 0.01;
  EXPECT_THROW(read_worn_garment(worn, "worn", longer), Error);
  Pattern unsewn_elsewhere = pattern;
  std::swap(unsewn_elsewhere.seams[0].b, unsewn_elsewhere.seams[1].b);
  EXPECT_THROW(read_worn_garment(worn, "worn", unsewn_elsewhere), Error);
}

TEST(WornGarment, FilesThatAreNoneAreRefused) {
  Pattern pattern;
  pattern.panels.resize(1);
  pattern.panels[0].corners = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  pattern.panels[0].edges.resize(4);
  const std::string good =
      "v 0 0 0\nv 1 0 0\nv 1 1 .1\nv 0 1 0\nvt 0 0\nvt 100 0\nvt 100 100\nvt 0 100\n"
      "f 1/1 2/2 3/3\n#fit 1.05 -0.02 0.98\nf 1/1 3/3 4/4\n#fit 1.04 0.01 1.01\n";
  const auto read = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return read_worn_garment(Bytes(text.begin(), text.end()), "worn", pattern);
  };
  EXPECT_EQ(read("0.98", "0.99").wanted[0](1, 1), 0.99);
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"#fit 1.05", "#fit 0"},
                                                        {"#fit 1.05", "#fit nan"},
                                                        {"-0.02", "-20"},
                                                        {"-0.02", ""},
                                                        {"#fit 1.05 -0.02 0.98\n", ""},
                                                        {"#fit", "#fit 1 0 1\n#fit"},
                                                        {"vt 0 100", "vt 50 50"},
                                                        {"4/4", "4/2"},
                                                        {"f 1/1 3/3", "f 1/1 2/2 3/3\nf 1/1 3/3"},
                                                        {"v 0 0 0", "v 0 0 nan"}})
    EXPECT_THROW(read(from, to), Error) << from << " to " << to;
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
