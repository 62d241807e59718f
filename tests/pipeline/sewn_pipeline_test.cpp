// SPDX-License-Identifier: GPL-3.0-or-later
// The altered garment of the tube: exact strips and take-ins, worn again, read back, and a ticket that says what the
// drawing shows.
#include <regex>

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "engine/draw_alteration.h"
#include "engine/geometry/curve.h"
#include "engine/geometry/offset_polygon.h"
#include "engine/io/schema_check.h"
#include "engine/outputs.h"
#include "engine/stages/draw_pattern.h"
#include "engine/stages/import_pattern.h"
#include "tests/pipeline/tube_job.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

constexpr double kExact = 5e-3;  // relative: areas and widths against the difference of the two patterns
constexpr double kCm2 = 1e4;

BodyInput form(const std::string& name) {
  return {.name = "builtin:tube-" + name, .bytes = {}};
}

AlterResult alter(const GarmentInput& garment, const std::string& to) {
  StageRunner runner(nullptr, nullptr, kAlterStages);
  return alter_garment(garment, form("14-100"), form(to), test::small_job(), runner);
}

Vec2 extent(const AlterResult& result, const Points2& rest, std::size_t panel) {
  const PanelRange& range = result.reference.mesh.panels[panel];
  const auto rows = rest.middleRows(range.vertex_begin, range.vertex_end - range.vertex_begin);
  return (rows.colwise().maxCoeff() - rows.colwise().minCoeff()).transpose();
}

// Largest distance a fit may keep from the reference, and never more than before.
void expect_better_fit(const AlterResult& result) {
  ASSERT_TRUE(result.after && result.after->problem.empty());
  const auto rms = [](const PatternMesh& mesh, const FittingMap& reference, const FittingMap& fit) {
    return compare_fits(mesh, reference, fit).whole.rms_stretch;
  };
  const double before = rms(result.reference.mesh, result.reference.fit, result.fit_before);
  const double ideal = rms(result.reference.mesh, result.reference.fit, result.derived.fit);
  const double after = rms(result.after->mesh, result.after->reference, result.after->fit);
  EXPECT_LT(after, std::max(1.25 * ideal, ideal + 0.015));
  if (before > 0.02) {
    EXPECT_LT(after, 0.1 * before);
  }
  EXPECT_LT(result.after->position.p95, 3e-3);
}

TEST(SewnPipeline, AWiderFormWantsAStripOfJustThatWidth) {
  const AlterResult result = alter(test::tube_skirt(), "18-100");
  double wanted = 0.0;
  for (std::size_t p = 0; p < 2; ++p) {
    const Vec2 before = extent(result, result.reference.mesh.rest, p),
               after = extent(result, result.derived.mesh.rest, p);
    wanted += after.x() * after.y() - before.x() * before.y();
  }
  ASSERT_GT(wanted * kCm2, 1000);
  EXPECT_NEAR(result.altered.inserted_area, wanted, kExact * wanted);
  EXPECT_EQ(result.altered.removed_area, 0.0);
  ASSERT_EQ(result.altered.ticket.operations.size(), 1u);
  EXPECT_EQ(result.altered.ticket.operations[0].kind, OperationKind::InsertStrip);
  const double wider =
      extent(result, result.derived.mesh.rest, 0).x() - extent(result, result.reference.mesh.rest, 0).x();
  double strips = 0.0;  // at both sides alike
  for (const TicketPiece& piece : result.altered.ticket.operations[0].pieces)
    if (piece.name.starts_with("front")) {
      EXPECT_NEAR(piece.width, 0.5 * wider, kExact * wider);
      strips += piece.width;
    }
  EXPECT_NEAR(strips, wider, kExact * wider);
  expect_better_fit(result);
}

TEST(SewnPipeline, ATallerFormWantsAStripAlongTheHem) {
  const AlterResult result = alter(test::tube_skirt(), "14-125");
  ASSERT_EQ(result.altered.ticket.operations.size(), 1u);
  EXPECT_EQ(result.altered.ticket.operations[0].kind, OperationKind::Lengthen);
  const double longer =
      extent(result, result.derived.mesh.rest, 0).y() - extent(result, result.reference.mesh.rest, 0).y();
  EXPECT_NEAR(result.altered.ticket.operations[0].pieces.at(0).width, longer, kExact * longer);
  expect_better_fit(result);
}

TEST(SewnPipeline, ANarrowerFormWantsATakeIn) {
  const AlterResult result = alter(test::tube_skirt(), "11-100");
  ASSERT_EQ(result.altered.ticket.operations.size(), 1u);
  EXPECT_EQ(result.altered.ticket.operations[0].kind, OperationKind::TakeIn);
  EXPECT_EQ(result.altered.inserted_area, 0.0);
  double wanted = 0.0;
  for (std::size_t p = 0; p < 2; ++p) {
    const Vec2 before = extent(result, result.reference.mesh.rest, p),
               after = extent(result, result.derived.mesh.rest, p);
    wanted += before.x() * before.y() - after.x() * after.y();
  }
  EXPECT_NEAR(result.altered.removed_area, wanted, kExact * wanted);
  expect_better_fit(result);
}

TEST(SewnPipeline, TheSameFormLeavesTheGarmentAsItIs) {
  const AlterResult result = alter(test::tube_skirt(), "14-100");
  EXPECT_TRUE(result.altered.ticket.operations.empty());
  const Pattern before = import_pattern(test::tube_skirt().bytes), &after = result.altered.sewn.pattern;
  ASSERT_EQ(after.panels.size(), before.panels.size());
  ASSERT_EQ(after.seams.size(), before.seams.size());
  for (std::size_t p = 0; p < before.panels.size(); ++p) {
    EXPECT_EQ(after.panels[p].name, before.panels[p].name);
    EXPECT_NEAR(outline_signed_area(after.panels[p]), outline_signed_area(before.panels[p]), 1e-9);
  }
  expect_better_fit(result);
}

std::string altered_document(const AlterResult& result) {
  AlterOptions options = test::small_job();
  options.outputs = {"altered_pattern.json"};
  for (const OutputFile& file :
       alter_outputs(result, options, job_info(test::tube_skirt(), form("14-100"), form("18-125"))))
    if (file.name == "altered_pattern.json") return {file.bytes.begin(), file.bytes.end()};
  return {};
}

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

TEST(SewnPipeline, TheAlteredPatternIsReadBackWithoutLossAndAlteredAgain) {
  const AlterResult result = alter(test::tube_skirt(), "18-125");
  const std::string document = altered_document(result);
  const SchemaCheck check = check_schema(bytes_of(document));
  EXPECT_EQ(check.schema, "altered_pattern");
  for (const SchemaProblem& problem : check.problems) ADD_FAILURE() << problem.pointer << " " << problem.message;
  const Pattern again = import_pattern(bytes_of(document));
  const Pattern& sewn = result.altered.sewn.pattern;
  ASSERT_EQ(again.panels.size(), sewn.panels.size());
  EXPECT_EQ(again.seams.size(), sewn.seams.size());
  for (std::size_t p = 0; p < sewn.panels.size(); ++p) {
    const Panel &a = again.panels[p], &b = sewn.panels[p];
    ASSERT_EQ(a.edge_count(), b.edge_count());
    EXPECT_EQ(a.notches.size(), b.notches.size());
    EXPECT_EQ(a.piece_label, b.piece_label);
    EXPECT_LT((a.rotation - b.rotation).norm() + (a.translation - b.translation).norm(), 1e-9);
    for (int e = 0; e < a.edge_count(); ++e) {
      EXPECT_LT((a.edge_start(e) - b.edge_start(e)).norm(), 1e-9);
      EXPECT_NEAR(edge_length(a, e), edge_length(b, e), 1e-9);
      EXPECT_EQ(a.edges[static_cast<std::size_t>(e)].hem.has_value(),
                b.edges[static_cast<std::size_t>(e)].hem.has_value());
    }
  }
  const GarmentInput garment{"altered_pattern.json", Bytes(document.begin(), document.end())};
  const AlterResult twice = alter(garment, "14-100");  // made for a wide form, worn by a narrow one, for that one again
  EXPECT_TRUE(twice.altered.ticket.operations.empty());
}

TEST(SewnPipeline, EveryDocumentOfAJobAgreesWithItsSchema) {
  const AlterResult result = alter(test::tube_skirt(), "11-125");
  AlterOptions options = test::small_job();
  options.outputs = {"altered_pattern.json", "target_pattern.json", "ticket.json"};
  std::vector<std::string> schemas;
  for (const OutputFile& file :
       alter_outputs(result, options, job_info(test::tube_skirt(), form("14-100"), form("11-125")))) {
    const SchemaCheck check = check_schema(file.bytes);
    schemas.push_back(check.schema);
    for (const SchemaProblem& problem : check.problems)
      ADD_FAILURE() << file.name << problem.pointer << " " << problem.message;
  }
  EXPECT_EQ(schemas, (std::vector<std::string>{"altered_pattern", "garment", "ticket", "result"}));
}

TEST(SewnPipeline, TheDrawingShowsThePiecesOfTheDocument) {
  constexpr double kSame = 0.01;  // mm
  const AlterResult result = alter(test::tube_skirt(), "18-125");
  const std::string document = altered_document(result);
  const Drawing read_back = draw_pattern(import_pattern(bytes_of(document)));
  const Drawing drawing = draw_alteration(result.reference.pattern, result.altered);
  const auto same_points = [&](const DrawingLine& a, const DrawingLine& b) {
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t i = 0; i < a.points.size(); ++i) EXPECT_LT((a.points[i] - b.points[i]).norm(), kSame);
  };
  std::size_t compared = 0;
  for (const DrawingPiece& wanted : read_back.pieces)
    for (const DrawingPiece& piece : drawing.pieces) {
      if (piece.name != wanted.name) continue;
      for (const LineKind kind : {LineKind::Cut, LineKind::Stitch}) {
        const auto of_kind = [kind](const DrawingLine& line) { return line.kind == kind; };
        same_points(*std::find_if(wanted.lines.begin(), wanted.lines.end(), of_kind),
                    *std::find_if(piece.lines.begin(), piece.lines.end(), of_kind));
      }
      ASSERT_EQ(piece.notches.size(), wanted.notches.size());
      for (std::size_t n = 0; n < piece.notches.size(); ++n)
        EXPECT_LT((piece.notches[n].at - wanted.notches[n].at).norm(), kSame);
      ++compared;
    }
  EXPECT_EQ(compared, 8u);  // of each panel the kept piece, a strip at either side and one at the hem
}

// Both numbers of "118 mm per ply (237 mm in all)", or one of them twice.
std::array<double, 2> numbers_of(const std::string& sentence) {
  std::smatch found;
  if (std::regex_search(sentence, found, std::regex(R"((\d+) mm per ply \((\d+) mm in all\))")))
    return {std::stod(found[1]), std::stod(found[2])};
  if (std::regex_search(sentence, found, std::regex(R"((\d+) mm)"))) return {std::stod(found[1]), std::stod(found[1])};
  return {};
}

// Narrow sides of everything drawn in one colour for an operation, mm.
std::vector<double> drawn_widths(const AlterResult& result, const Drawing& drawing, int operation) {
  std::vector<double> widths;
  const auto measure = [&](const DrawingLine& line) {
    Vec2 low = line.points[0], high = low;
    for (const Vec2& p : line.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
    widths.push_back((high - low).minCoeff());
  };
  const auto lines_named = [&](const std::string& piece_name, LineKind kind,
                               const std::vector<AlteredRegion>& regions) {
    for (const DrawingPiece& piece : drawing.pieces) {
      if (piece.name != piece_name) continue;
      std::size_t number = 0;
      for (const DrawingLine& line : piece.lines)
        if (line.kind == kind && line.closed && number < regions.size())
          if (regions[number++].operation == operation) measure(line);
    }
  };
  for (const PanelAlteration& panel : result.altered.panels) {
    lines_named(panel.panel + "_as_sewn", LineKind::Insertion, panel.insertions);
    lines_named(panel.panel, LineKind::Removal, panel.removals);
  }
  return widths;
}

TEST(SewnPipeline, TheNumbersOfEverySentenceAreThoseOfTheDrawing) {
  int sentences = 0;
  for (const char* to : {"18-100", "15-100", "12-100", "14-125", "14-90", "18-125", "11-125", "16-90"}) {
    const AlterResult result = alter(test::tube_skirt(), to);
    const Drawing drawing = draw_alteration(result.reference.pattern, result.altered);
    const auto& operations = result.altered.ticket.operations;
    for (std::size_t o = 0; o < operations.size(); ++o) {
      const auto widths = drawn_widths(result, drawing, static_cast<int>(o));
      ASSERT_FALSE(widths.empty()) << to << ": " << operations[o].sentence;
      const auto [per_ply, total] = numbers_of(operations[o].sentence);
      EXPECT_NEAR(per_ply, *std::max_element(widths.begin(), widths.end()), 1.5)
          << to << ": " << operations[o].sentence;
      const bool length = per_ply == total;
      double sum = 0.0;
      for (const double width : widths) sum += width;
      EXPECT_NEAR(total, length ? widths[0] : sum, 2.5) << to << ": " << operations[o].sentence;
      for (const TicketPiece& piece : operations[o].pieces)
        for (const DrawingPiece& drawn : drawing.pieces)
          if (drawn.name == piece.name)
            for (const DrawingLine& line : drawn.lines)
              if (line.kind == LineKind::Stitch) {
                EXPECT_NEAR(piece.area * 1e6, polygon_area(line.points), 1.0);
              }
      ++sentences;
    }
  }
  EXPECT_GE(sentences, 8);
}

}  // namespace
}  // namespace toile
