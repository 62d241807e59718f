// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/import_pattern.h"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/core/units.h"
#include "engine/geometry/curve.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

// The report's areas are those of polygons with 24 chords, evenly spaced by parameter, in place of every curve.
double area_of_chords(const Panel& panel, int chords) {
  std::vector<Vec2> polygon;
  for (int e = 0; e < panel.edge_count(); ++e)
    for (int i = 0; i < chords; ++i)
      polygon.push_back(curve_point(edge_curve(panel, e), static_cast<double>(i) / chords));
  double area = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    area += 0.5 * (p.x() * q.y() - p.y() * q.x());
  }
  return area;
}

TEST(ImportPattern, LengthsAndAreasOfEverySharedGarmentAgreeWithTheStitchReport) {
  TOILE_REQUIRE_SHARED_DATA();
  constexpr double kTolerance = 0.01;  // cm and cm2
  const Bytes report_bytes = test::read_file(test::shared_data("garments/stitch_report.json"));
  const auto reports = nlohmann::json::parse(report_bytes.begin(), report_bytes.end());
  int stitches = 0, panels = 0;
  for (const std::string& name : test::shared_garment_names()) {
    SCOPED_TRACE(name);
    const Pattern pattern =
        import_pattern(test::read_file(test::shared_data("garments/" + name + "_specification.json")));
    const auto& expected = reports.at(name);
    ASSERT_EQ(expected.at("panels").size(), pattern.panels.size());
    for (const Panel& panel : pattern.panels) {
      const auto& row = expected.at("panels").at(panel.name);
      EXPECT_NEAR(std::abs(area_of_chords(panel, 24)) * 1e4, std::abs(row.at("area_cm2").get<double>()), kTolerance);
      EXPECT_EQ(outline_signed_area(panel) > 0, row.at("counter_clockwise").get<bool>());
      EXPECT_NEAR(outline_signed_area(panel) * 1e4, area_of_chords(panel, 2000) * 1e4, kTolerance);
      ++panels;
    }
    ASSERT_EQ(expected.at("stitches").size(), pattern.seams.size());
    for (std::size_t s = 0; s < pattern.seams.size(); ++s) {
      const auto& row = expected.at("stitches").at(s);
      const Seam& seam = pattern.seams[s];
      EXPECT_NEAR(edge_length(pattern.panel(seam.a.panel), seam.a.edge) * kCmPerMetre, row.at("len_a_cm").get<double>(),
                  kTolerance);
      EXPECT_NEAR(edge_length(pattern.panel(seam.b.panel), seam.b.edge) * kCmPerMetre, row.at("len_b_cm").get<double>(),
                  kTolerance);
      ++stitches;
    }
  }
  EXPECT_EQ(panels, 164);
  EXPECT_EQ(stitches, 484);
}

Pattern square_pair() {
  Pattern pattern;
  for (const char* name : {"front", "back"}) {
    Panel panel;
    panel.name = name;
    panel.corners = {{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}};
    panel.edges.resize(4);
    pattern.panels.push_back(panel);
  }
  pattern.seams.push_back({{PanelId(0), 1}, {PanelId(1), 3}, false});
  return pattern;
}

void expect_refused(const Pattern& pattern, ErrorCode code, const std::string& pointer) {
  try {
    validate_pattern(pattern);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error_name(error.code), error_name(code));
    EXPECT_EQ(error.subject, pointer) << error.message;
  }
}

TEST(ImportPattern, AcceptsAPlainPattern) {
  EXPECT_NO_THROW(validate_pattern(square_pair()));
}

TEST(ImportPattern, RefusesAnEdgeSewnTwice) {
  Pattern pattern = square_pair();
  pattern.seams.push_back({{PanelId(0), 0}, {PanelId(1), 3}, false});
  expect_refused(pattern, ErrorCode::SeamInvalid, "/pattern/stitches/1/1");
  pattern.seams[1] = {{PanelId(0), 0}, {PanelId(0), 0}, false};
  expect_refused(pattern, ErrorCode::SeamInvalid, "/pattern/stitches/1/1");
}

TEST(ImportPattern, RefusesASelfCrossingOutline) {
  Pattern pattern = square_pair();
  std::swap(pattern.panels[1].corners[1], pattern.panels[1].corners[2]);
  expect_refused(pattern, ErrorCode::GarmentInvalid, "/pattern/panels/back/edges/2");
}

TEST(ImportPattern, RefusesACurveThatCrossesAnotherEdge) {
  Pattern pattern = square_pair();
  EdgeCurve& curve = pattern.panels[0].edges[0].curve;
  curve.kind = CurveKind::QuadraticBezier;
  curve.control[0] = {0.05, 0.3};
  expect_refused(pattern, ErrorCode::GarmentInvalid, "/pattern/panels/front/edges/2");
}

TEST(ImportPattern, RefusesDegeneratePanelsAndEdges) {
  Pattern flat = square_pair();
  flat.panels[0].corners = {{0, 0}, {0.1, 0}, {0.2, 0}, {0.1, 1e-6}};
  expect_refused(flat, ErrorCode::GarmentInvalid, "/pattern/panels/front");
  Pattern point = square_pair();
  point.panels[0].corners[2] = point.panels[0].corners[1];
  expect_refused(point, ErrorCode::GarmentInvalid, "/pattern/panels/front/edges/1");
  Pattern nan = square_pair();
  nan.panels[0].corners[2].x() = std::nan("");
  expect_refused(nan, ErrorCode::GarmentInvalid, "/pattern/panels/front");
}

}  // namespace
}  // namespace toile
