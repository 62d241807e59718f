// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/render_views.h"

#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "engine/core/content_hash.h"
#include "engine/core/error.h"
#include "engine/stages/build_fitting_map.h"
#include "tests/support/grid_garment.h"

namespace toile {
namespace {

// A flat sheet in front of a small box of a body, stretched by `stretch` across.
struct Scene {
  test::GridGarment garment =
      test::grid_garment({{"front", 0.4, 0.6, 8, 12}, {"back", 0.4, 0.6, 8, 12}}, {{0, 1, 1, 3}});
  TriangleMesh body;
  Drape drape;
  FittingMap fit;

  explicit Scene(double stretch) {
    body.vertices.resize(4, 3);
    body.vertices << -0.2, 0, 0, 0.2, 0, 0, 0, 1.7, 0, 0, 0.5, 0.1;
    body.triangles.resize(4, 3);
    body.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
    drape.nodes = Points3::Zero(garment.mesh.node_count, 3);
    for (int v = 0; v < garment.mesh.vertex_count(); ++v) {
      const double shift = garment.mesh.panel_of_vertex[static_cast<std::size_t>(v)] * 0.4;
      drape.nodes.row(garment.mesh.node_of_vertex[static_cast<std::size_t>(v)])
          << (1 + stretch) * (garment.mesh.rest(v, 0) + shift) - 0.4,
          garment.mesh.rest(v, 1) + 0.6, 0.2;
    }
    fit = build_fitting_map(garment.mesh, drape);
  }
  Bytes render(const ViewOptions& options = {}) const {
    return render_views(&body, &garment.mesh, &drape, &fit, options);
  }
};

int side(const Bytes& png, std::size_t at) {
  return png[at] << 24 | png[at + 1] << 16 | png[at + 2] << 8 | png[at + 3];
}
int width_of(const Bytes& png) {
  return side(png, 16);
}

TEST(RenderViews, TheSameGarmentGivesTheSameBytesOnOneAndOnTwoThreads) {
  const Scene scene(0.05);
  const std::string alone = sha256_hex(scene.render());
  EXPECT_EQ(alone, sha256_hex(scene.render()));
  std::array<std::string, 2> hashes;
  std::thread first([&] { hashes[0] = sha256_hex(scene.render()); });
  std::thread second([&] { hashes[1] = sha256_hex(scene.render()); });
  first.join();
  second.join();
  EXPECT_EQ(hashes[0], alone);
  EXPECT_EQ(hashes[1], alone);
}

TEST(RenderViews, StretchAndScaleChangeThePicture) {
  const Scene slack(0.0), tight(0.05);
  EXPECT_NE(slack.render(), tight.render());
  ViewOptions coarse;
  coarse.stretch_scale = 0.5;
  EXPECT_NE(tight.render(), tight.render(coarse));
}

TEST(RenderViews, ALegendIsDrawnForAMapOnly) {
  const Scene scene(0.05);
  ViewOptions without;
  without.legend = false;
  EXPECT_GT(width_of(scene.render()), width_of(scene.render(without)));
  const Bytes panels = render_views(&scene.body, &scene.garment.mesh, &scene.drape, nullptr, {});
  EXPECT_EQ(width_of(panels), width_of(scene.render(without)));
}

TEST(RenderViews, OneFrameGivesPicturesOfOneSize) {
  ViewOptions options;
  options.frame.emplace();
  options.frame->low = Vec3(-1, 0, -1), options.frame->high = Vec3(1, 2, 1);
  EXPECT_EQ(width_of(Scene(0.0).render(options)), width_of(Scene(0.3).render(options)));
}

TEST(RenderViews, MarksAppearAndShowDifferencesFromAReference) {
  const Scene slack(0.0), tight(0.05);
  ViewOptions marked;
  marked.marks = 2;
  const Bytes absolute = tight.render(marked);
  EXPECT_NE(absolute, tight.render());
  marked.reference = &tight.fit;
  EXPECT_NE(tight.render(marked), absolute);
}

TEST(RenderViews, AnyPartMayBeMissing) {
  const Scene scene(0.05);
  for (const Bytes& png : {render_views(&scene.body, nullptr, nullptr, nullptr, {}),
                           render_views(nullptr, &scene.garment.mesh, &scene.drape, &scene.fit, {}),
                           render_views(nullptr, nullptr, nullptr, nullptr, {}),
                           render_placed_panels(nullptr, scene.garment.pattern, scene.garment.mesh, {})})
    EXPECT_GT(png.size(), 100u);
}

TEST(RenderViews, BrokenDrapesAreDrawnAsFarAsTheyGo) {
  Scene scene(0.05);
  scene.drape.nodes.row(3).setConstant(std::numeric_limits<double>::quiet_NaN());
  scene.drape.nodes(5, 1) = 1e200;
  EXPECT_GT(scene.render().size(), 100u);
}

TEST(RenderViews, AStrangersDrapeOrMapIsRefused) {
  Scene scene(0.05);
  FittingMap other = scene.fit;
  other.tensor.pop_back();
  EXPECT_THROW(render_views(nullptr, &scene.garment.mesh, &scene.drape, &other, {}), Error);
  scene.drape.nodes.conservativeResize(3, 3);
  EXPECT_THROW(scene.render(), Error);
}

}  // namespace
}  // namespace toile
