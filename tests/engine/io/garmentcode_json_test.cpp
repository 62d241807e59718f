// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/garmentcode_json.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/core/units.h"
#include "engine/geometry/curve.h"
#include "tests/support/shared_data.h"
#include "tests/support/text_bytes.h"

namespace toile {
namespace {

const char* const kSquarePair = R"({
 "pattern": { "panels": {
   "b": {"translation": [1, 2, 3], "rotation": [0, 0, 90], "vertices": [[0,0],[10,0],[10,10],[0,10]], "label": "body",
         "edges": [{"endpoints":[0,1],"label":"lower_interface"}, {"endpoints":[1,2],"curvature":{"type":"quadratic","params":[[0.5,-0.2]]}},
                   {"endpoints":[2,3],"curvature":{"type":"cubic","params":[[0.2,0.1],[0.7,-0.1]]}},
                   {"endpoints":[3,0],"curvature":{"type":"circle","params":[6,0,1]}}]},
   "a": {"vertices": [[0,0],[10,0],[10,10],[0,10]],
         "edges": [{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,0]}]}},
  "stitches": [[{"panel":"a","edge":1},{"panel":"b","edge":3}], [{"panel":"a","edge":2},{"panel":"b","edge":1},"right_wrong"]],
  "panel_order": ["b", "a"] },
 "properties": {"curvature_coords": "relative", "units_in_meter": 100},
 "toile": {
   "name": "sample", "fabric": {"weft_n_per_m": 500, "bending_n_m": 1e-5}, "seam_allowance_mm": 12,
   "edges": [{"panel":"a","edge":0,"name":"hem","hem":30,"seam_allowance_mm":5,"straight":true},
             {"panel":"b","edge":1,"zip":true,"locked":true}, {"panel":"a","edge":3,"on_fold":true}],
   "panels": [{"panel":"a","label":"Front","quantity":2,"material":"shell","grainline":[[1,1],[1,9]],"locked":true}],
   "notches": [{"panel":"a","edge":1,"at":0.25,"type":"castle"}],
   "keep_out": [{"panel":"a","polygon":[[2,2],[4,2],[4,4]],"why":"pocket"}],
   "pins": [{"panel":"b","edge":0}], "symmetry_plane": [1,0,0,5] } })";

TEST(GarmentCodeJson, ReadsPanelsInTheirOrderWithMetresAndEveryKindOfCurve) {
  const Pattern pattern = read_garmentcode(test::bytes_of(kSquarePair));
  ASSERT_EQ(pattern.panels.size(), 2u);
  const Panel& b = pattern.panels[0];
  EXPECT_EQ(b.name, "b");
  EXPECT_EQ(b.label, "body");
  EXPECT_EQ(b.edges[0].label, "lower_interface");
  EXPECT_NEAR((b.translation - Vec3(0.01, 0.02, 0.03)).norm(), 0, 1e-15);
  EXPECT_NEAR((b.rotation * Vec3(1, 0, 0) - Vec3(0, 1, 0)).norm(), 0, 1e-15);
  // Positive v is to the left of the way: edge 1 runs up, so -0.2 lies to the right, x = 10 + 2 cm.
  EXPECT_NEAR((b.edges[1].curve.control[0] - Vec2(0.12, 0.05)).norm(), 0, 1e-15);
  EXPECT_EQ(b.edges[2].curve.kind, CurveKind::CubicBezier);
  EXPECT_EQ(b.edges[3].curve.kind, CurveKind::Arc);
  EXPECT_DOUBLE_EQ(b.edges[3].curve.radius, 0.06);
  ASSERT_EQ(pattern.seams.size(), 2u);
  EXPECT_EQ(pattern.seams[0].a.panel.value, 1);
  EXPECT_EQ(pattern.seams[0].b.edge, 3);
  EXPECT_FALSE(pattern.seams[0].right_wrong);
  EXPECT_TRUE(pattern.seams[1].right_wrong);
}

TEST(GarmentCodeJson, TurnsAboutWorldXThenYThenZ) {
  std::string text = kSquarePair;
  text.replace(text.find("[0, 0, 90]"), 10, "[90,90,0]");
  const Pattern pattern = read_garmentcode(test::bytes_of(text));
  // +y turned by 90 degrees about X is +z, which 90 degrees about Y takes to +x.
  EXPECT_NEAR((pattern.panels[0].rotation * Vec3(0, 1, 0) - Vec3(1, 0, 0)).norm(), 0, 1e-15);
}

TEST(GarmentCodeJson, ReadsTheToileBlock) {
  const Pattern pattern = read_garmentcode(test::bytes_of(kSquarePair));
  const Panel& a = pattern.panels[1];
  EXPECT_EQ(pattern.name, "sample");
  EXPECT_EQ(pattern.fabric.weft_stiffness, 500);
  EXPECT_EQ(pattern.fabric.warp_stiffness, Fabric().warp_stiffness);
  EXPECT_NEAR(pattern.seam_allowance, 0.012, 1e-15);
  EXPECT_EQ(a.edges[0].name, "hem");
  EXPECT_NEAR(a.edges[0].hem.value(), 0.03, 1e-15);
  EXPECT_NEAR(a.edges[0].seam_allowance.value(), 0.005, 1e-15);
  EXPECT_TRUE(a.edges[0].straight.value());
  EXPECT_TRUE(pattern.panels[0].edges[1].zip);
  EXPECT_TRUE(a.edges[3].on_fold);
  EXPECT_EQ(a.piece_label, "Front");
  EXPECT_EQ(a.quantity, 2);
  EXPECT_TRUE(a.locked);
  EXPECT_NEAR(((*a.grainline)[1] - Vec2(0.01, 0.09)).norm(), 0, 1e-15);
  ASSERT_EQ(a.notches.size(), 1u);
  EXPECT_EQ(a.notches[0].type, NotchType::Castle);
  ASSERT_EQ(a.keep_outs.size(), 1u);
  EXPECT_EQ(a.keep_outs[0].why, "pocket");
  ASSERT_EQ(pattern.pins.size(), 1u);
  EXPECT_EQ(pattern.symmetry, Pattern::Symmetry::Plane);
  EXPECT_NEAR(pattern.symmetry_plane[3], 0.05, 1e-15);
}

// Both documents describe the same pattern within 1e-9 cm.
void expect_equal(const Pattern& a, const Pattern& b) {
  constexpr double kTolerance = 1e-11;  // m
  ASSERT_EQ(a.panels.size(), b.panels.size());
  for (std::size_t p = 0; p < a.panels.size(); ++p) {
    EXPECT_EQ(a.panels[p].name, b.panels[p].name);
    EXPECT_EQ(a.panels[p].label, b.panels[p].label);
    EXPECT_LT((a.panels[p].rotation - b.panels[p].rotation).norm(), 1e-12);
    EXPECT_LT((a.panels[p].translation - b.panels[p].translation).norm(), kTolerance);
    ASSERT_EQ(a.panels[p].edges.size(), b.panels[p].edges.size());
    for (int e = 0; e < a.panels[p].edge_count(); ++e) {
      const Curve x = edge_curve(a.panels[p], e), y = edge_curve(b.panels[p], e);
      EXPECT_EQ(x.shape.kind, y.shape.kind);
      EXPECT_EQ(a.panels[p].edges[static_cast<std::size_t>(e)].label,
                b.panels[p].edges[static_cast<std::size_t>(e)].label);
      for (const double t : {0.0, 0.3, 0.7, 1.0}) EXPECT_LT((curve_point(x, t) - curve_point(y, t)).norm(), kTolerance);
    }
  }
  ASSERT_EQ(a.seams.size(), b.seams.size());
  for (std::size_t s = 0; s < a.seams.size(); ++s) {
    EXPECT_EQ(a.seams[s].a, b.seams[s].a);
    EXPECT_EQ(a.seams[s].b, b.seams[s].b);
    EXPECT_EQ(a.seams[s].right_wrong, b.seams[s].right_wrong);
  }
}

TEST(GarmentCodeJson, WritesWhatItReads) {
  const Pattern pattern = read_garmentcode(test::bytes_of(kSquarePair));
  const std::string text = write_garmentcode(pattern);
  const Pattern again = read_garmentcode(test::bytes_of(text));
  expect_equal(pattern, again);
  EXPECT_EQ(again.panels[1].grainline.has_value(), true);
  EXPECT_EQ(again.symmetry, Pattern::Symmetry::Plane);
  EXPECT_EQ(again.panels[1].notches.size(), 1u);
  EXPECT_EQ(again.fabric.weft_stiffness, 500);
  EXPECT_EQ(write_garmentcode(again).find("\"toile\"") != std::string::npos, true);
}

TEST(GarmentCodeJson, EveryTurnSurvivesTheRoundTrip) {
  for (const char* angles : {"[30,40,50]", "[-170,20,10]", "[10,90,0]", "[25,-90,0]", "[25,90,40]", "[0,180,0]"}) {
    std::string text = kSquarePair;
    text.replace(text.find("[0, 0, 90]"), 10, angles);
    const Pattern pattern = read_garmentcode(test::bytes_of(text));
    const Pattern again = read_garmentcode(test::bytes_of(write_garmentcode(pattern)));
    EXPECT_LT((pattern.panels[0].rotation - again.panels[0].rotation).norm(), 1e-7) << angles;
  }
}

TEST(GarmentCodeJson, RoundTripsEverySharedGarment) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const std::string& name : test::shared_garment_names()) {
    SCOPED_TRACE(name);
    const Pattern pattern =
        read_garmentcode(test::read_file(test::shared_data("garments/" + name + "_specification.json")));
    ASSERT_FALSE(pattern.panels.empty());
    const std::string text = write_garmentcode(pattern);
    expect_equal(pattern, read_garmentcode(test::bytes_of(text)));
    EXPECT_EQ(text, write_garmentcode(pattern));
  }
}

struct BadCase {
  const char* what;
  const char* from;
  const char* to;
  ErrorCode code;
  const char* pointer;
};

TEST(GarmentCodeJson, RefusesBadInputNamingThePlace) {
  const BadCase cases[] = {
      {"not JSON", "\"pattern\":", "\"pattern\"", ErrorCode::FileMalformed, "garment"},
      {"missing pattern", "\"pattern\":", "\"patter\":", ErrorCode::FileMalformed, "/"},
      {"vertex number", "[0,1],\"label\"", "[0,9],\"label\"", ErrorCode::FileMalformed,
       "/pattern/panels/b/edges/0/endpoints/1"},
      {"negative vertex", "[0,1],\"label\"", "[-1,1],\"label\"", ErrorCode::FileMalformed,
       "/pattern/panels/b/edges/0/endpoints/0"},
      {"open outline", "[0,1],\"label\"", "[0,2],\"label\"", ErrorCode::FileMalformed,
       "/pattern/panels/b/edges/0/endpoints"},
      {"infinite", "[10,10]", "[10,1e400]", ErrorCode::FileMalformed, "garment"},
      {"too far", "[10,10]", "[10,1e9]", ErrorCode::FileMalformed, "/pattern/panels/b/vertices/2/1"},
      {"text for a number", "[10,10]", "[10,\"x\"]", ErrorCode::FileMalformed, "/pattern/panels/b/vertices/2/1"},
      {"unknown curve", "\"quadratic\"", "\"spline\"", ErrorCode::FileMalformed,
       "/pattern/panels/b/edges/1/curvature/type"},
      {"unknown stitch edge", "{\"panel\":\"a\",\"edge\":1},", "{\"panel\":\"a\",\"edge\":7},", ErrorCode::SeamInvalid,
       "/pattern/stitches/0/0/edge"},
      {"unknown stitch panel", "{\"panel\":\"b\",\"edge\":3}", "{\"panel\":\"c\",\"edge\":3}", ErrorCode::SeamInvalid,
       "/pattern/stitches/0/1/panel"},
      {"unknown option", "\"hem\":30", "\"hemm\":30", ErrorCode::FileMalformed, "/toile/edges/0/hemm"},
      {"unknown fabric", "{\"weft_n_per_m\": 500, \"bending_n_m\": 1e-5}", "\"steel\"", ErrorCode::FileMalformed,
       "/toile/fabric"},
      {"notch off the edge", "\"at\":0.25", "\"at\":1.25", ErrorCode::FileMalformed, "/toile/notches/0/at"},
  };
  for (const BadCase& bad : cases) {
    SCOPED_TRACE(bad.what);
    std::string text = kSquarePair;
    const std::size_t at = text.find(bad.from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, std::string(bad.from).size(), bad.to);
    try {
      read_garmentcode(test::bytes_of(text));
      ADD_FAILURE() << "accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error_name(error.code), error_name(bad.code)) << error.what();
      EXPECT_EQ(error.subject, bad.pointer) << error.message;
      EXPECT_FALSE(error.message.empty());
    }
  }
}

TEST(GarmentCodeJson, RefusesDeepAndHugeDocuments) {
  const auto code_of = [](const std::string& text) {
    try {
      read_garmentcode(test::bytes_of(text));
    } catch (const Error& error) {
      return error.code;
    }
    return ErrorCode::Internal;
  };
  EXPECT_EQ(code_of(std::string(100'000, '[')), ErrorCode::LimitExceeded);
  std::string wide = "[1";
  for (int i = 0; i < 2'100'000; ++i) wide += ",1";
  EXPECT_EQ(code_of(wide + "]"), ErrorCode::LimitExceeded);
  EXPECT_EQ(code_of(""), ErrorCode::FileMalformed);
  std::string many = "{\"pattern\":{\"panels\":{\"p0\":{}";
  for (int i = 1; i <= 200; ++i) many += ",\"p" + std::to_string(i) + "\":{}";
  EXPECT_EQ(code_of(many + "}}}"), ErrorCode::LimitExceeded);
  std::string edges = R"({"endpoints":[0,1]})";
  for (int i = 0; i < 2000; ++i) edges += R"(,{"endpoints":[0,1]})";
  EXPECT_EQ(code_of(R"({"pattern":{"panels":{"p":{"vertices":[[0,0],[1,0]],"edges":[)" + edges + "]}}}}"),
            ErrorCode::LimitExceeded);
}

}  // namespace
}  // namespace toile
