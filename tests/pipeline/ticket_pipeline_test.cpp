// SPDX-License-Identifier: GPL-3.0-or-later
// Tickets of the shipped examples say what the drawings show: every piece drawn is on the ticket and every number of a
// sentence is that of the drawing.
#include <regex>

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "engine/draw_alteration.h"
#include "engine/geometry/inner_point.h"
#include "engine/geometry/offset_polygon.h"
#include "engine/outputs.h"
#include "engine/pipeline.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

constexpr double kMm2 = kMmPerMetre * kMmPerMetre;  // per m^2

AlterResult alter(const std::string& example, const std::string& from, const std::string& to) {
  const std::string path = std::string(TOILE_SOURCE_DIR) + "/schemas/examples/" + example;
  AlterOptions options;
  options.triangles = 2000;
  options.outputs = {"ticket.json"};
  StageRunner runner(nullptr, nullptr, kAlterStages);
  return alter_garment({example, test::read_file(path)}, {.name = "builtin:" + from, .bytes = {}},
                       {.name = "builtin:" + to, .bytes = {}}, options, runner);
}

const DrawingPiece* find_piece(const Drawing& drawing, const std::string& name) {
  for (const DrawingPiece& piece : drawing.pieces)
    if (piece.name == name) return &piece;
  return nullptr;
}

const DrawingLine* closed_line(const DrawingPiece& piece, LineKind kind) {
  for (const DrawingLine& line : piece.lines)
    if (line.kind == kind && line.closed) return &line;
  return nullptr;
}

// Every piece of new cloth that is drawn is on the ticket, once and with its size; and the other way round.
void expect_same_pieces(const Drawing& drawing, const Ticket& ticket) {
  std::map<std::string, int> listed, drawn;
  for (const TicketOperation& operation : ticket.operations)
    for (const TicketPiece& piece : operation.pieces) {
      ++listed[piece.name];
      const DrawingPiece* found = find_piece(drawing, piece.name);
      ASSERT_NE(found, nullptr) << piece.name;
      const DrawingLine* stitch = closed_line(*found, LineKind::Stitch);
      ASSERT_NE(stitch, nullptr) << piece.name;
      const Vec2 box = least_box(stitch->points);
      EXPECT_NEAR(piece.area * kMm2, polygon_area(stitch->points), 1.0 + 1e-3 * piece.area * kMm2) << piece.name;
      EXPECT_NEAR(piece.width * kMmPerMetre, box.x(), 1.0) << piece.name;
      EXPECT_NEAR(piece.length * kMmPerMetre, box.y(), 1.0) << piece.name;
    }
  for (const DrawingPiece& piece : drawing.pieces)
    if (piece.role == PieceRole::Insertion) ++drawn[piece.name];
  EXPECT_EQ(listed, drawn);
}

// How far the far side of what is drawn lies from the panel's outline.
double width_drawn(const std::vector<Vec2>& region, const std::vector<Vec2>& outline) {
  constexpr double kOnOutline = 0.5;  // mm
  std::vector<Vec2> near, far;
  for (std::size_t i = 0; i < region.size(); ++i)
    for (int k = 0; k < 8; ++k) {
      const Vec2 p = region[i] + k / 8.0 * (region[(i + 1) % region.size()] - region[i]);
      (distance_to_polygon(outline, p) < kOnOutline ? near : far).push_back(p);
    }
  double widest = 0.0;
  for (const Vec2& p : near) {
    double least = 1e9;
    for (const Vec2& q : far) least = std::min(least, (p - q).norm());
    if (least < 1e9) widest = std::max(widest, least);
  }
  return widest;
}

struct Drawn {
  double widest = 0.0, roomiest = 0.0, removed = 0.0;
};

// What the drawing shows of an operation: how far its regions reach from the panels' outlines, the widest circle in
// them, what is taken away. mm, mm^2.
Drawn drawn_of(const AlterResult& result, const Drawing& drawing, int operation) {
  Drawn drawn;
  const auto look = [&](const std::string& name, LineKind kind, LineKind outline, const std::vector<int>& operations) {
    const DrawingPiece* piece = find_piece(drawing, name);
    const DrawingLine* border = piece ? closed_line(*piece, outline) : nullptr;
    std::size_t number = 0;
    for (const DrawingLine& line : border ? piece->lines : std::vector<DrawingLine>()) {
      if (line.kind != kind || !line.closed || number >= operations.size()) continue;
      if (operations[number++] != operation) continue;
      drawn.widest = std::max(drawn.widest, width_drawn(line.points, border->points));
      drawn.roomiest = std::max(drawn.roomiest, 2.0 * roomiest_point(line.points).clearance);
      if (kind == LineKind::Removal) drawn.removed += polygon_area(line.points);
    }
  };
  const auto& sewn = result.altered.sewn.pieces;
  for (std::size_t p = 0; p < result.altered.panels.size(); ++p) {
    const PanelAlteration& panel = result.altered.panels[p];
    std::vector<int> inserting, removing;  // operations in the order drawn
    for (const SewnPiece& piece : sewn)
      if (piece.panel == static_cast<int>(p) && piece.insertion >= 0)
        inserting.push_back(panel.insertions[static_cast<std::size_t>(piece.insertion)].operation);
    for (const AlteredRegion& region : panel.removals) removing.push_back(region.operation);
    look(panel.panel + "_as_sewn", LineKind::Insertion, LineKind::Stitch, inserting);
    look(panel.panel, LineKind::Removal, LineKind::Original, removing);
    look(panel.panel + "_as_cut", LineKind::Removal, LineKind::Original, removing);
  }
  return drawn;
}

// The widest a strip is said to be where a circle of the diameter may lie: no nearer to its ends than half of it. mm.
double widest_for_circle(const TicketOperation& operation, double diameter) {
  const std::vector<double>& open = operation.profile.amounts;
  const double length = operation.profile.spacing * static_cast<double>(open.size() - 1) * kMmPerMetre;
  double widest = 0.0;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const double at = operation.profile.spacing * static_cast<double>(i) * kMmPerMetre;
    if (at >= 0.5 * diameter && length - at >= 0.5 * diameter) widest = std::max(widest, open[i] * kMmPerMetre);
  }
  return widest;
}

double first_number(const std::string& sentence, const char* pattern) {
  std::smatch found;
  return std::regex_search(sentence, found, std::regex(pattern)) ? std::stod(found[1]) : -1.0;
}

void expect_true_sentences(const AlterResult& result, const Drawing& drawing) {
  const double least_strip = AlterOptions().min_strip_mm;
  const auto& operations = result.altered.ticket.operations;
  double removed_said = 0.0, removed_drawn = 0.0;
  for (std::size_t o = 0; o < operations.size(); ++o) {
    const TicketOperation& operation = operations[o];
    const std::string& sentence = operation.sentence;
    const Drawn drawn = drawn_of(result, drawing, static_cast<int>(o));
    if (operation.kind == OperationKind::CutAnew) continue;
    removed_said += operation.removed_area * kMm2, removed_drawn += drawn.removed;
    const double per_ply = first_number(sentence, R"((\d+) mm)"),
                 total = first_number(sentence, R"(\((\d+) mm in all\))");
    EXPECT_NEAR(per_ply, operation.per_ply * kMmPerMetre, 0.51) << sentence;
    double most = 0.0, sum = 0.0;
    for (const TicketSide& side : operation.sides) most = std::max(most, side.amount), sum += side.amount;
    EXPECT_EQ(most, operation.per_ply) << sentence;
    EXPECT_LE(operation.total, sum + 1e-9) << sentence;
    if (total >= 0.0) {
      EXPECT_NEAR(total, operation.total * kMmPerMetre, 0.51) << sentence;
    }
    EXPECT_TRUE(operation.fabric != FabricNeed::NeedsFabric || operation.with_step > 0 || !operation.pieces.empty())
        << sentence;
    const bool alone = operation.with_step == 0 &&
                       std::none_of(operations.begin(), operations.end(),
                                    [&](const auto& other) { return other.with_step == static_cast<int>(o) + 1; });
    if (!alone || drawn.widest == 0.0) continue;
    const double tolerance = std::max(2.0, 0.06 * per_ply);
    if (sentence.find("rom the ") == std::string::npos) {
      EXPECT_NEAR(drawn.widest, operation.pieces.empty() ? per_ply : std::max(per_ply, least_strip), tolerance)
          << sentence;
    } else {  // let into a cut, on both sides of which cloth turns in
      const double turned_in = 2.0 * kMmPerMetre * result.reference.pattern.seam_allowance;
      EXPECT_NEAR(drawn.roomiest - turned_in, widest_for_circle(operation, drawn.roomiest), tolerance) << sentence;
    }
  }
  EXPECT_NEAR(removed_said, removed_drawn, 1e-3 * removed_drawn + 1.0);
}

void expect_ticket_agrees(const std::string& example, const std::string& from, const std::string& to) {
  SCOPED_TRACE(example + " from " + from + " to " + to);
  const AlterResult result = alter(example, from, to);
  const Drawing drawing = draw_alteration(result.reference.pattern, result.altered);
  EXPECT_FALSE(result.altered.ticket.operations.empty());
  expect_same_pieces(drawing, result.altered.ticket);
  expect_true_sentences(result, drawing);
  for (const PanelAlteration& panel : result.altered.panels)
    for (const auto* regions : {&panel.insertions, &panel.removals})
      for (const AlteredRegion& region : *regions)
        EXPECT_GE(region.operation, 0) << region.name << " is in no operation";
}

TEST(SlowTicketPipeline, AWiderSkirtsTicketSaysWhatIsDrawn) {
  expect_ticket_agrees("a_line_skirt.json", "woman-38-168", "woman-44-168");
}

TEST(SlowTicketPipeline, ANarrowerSkirtsTicketSaysWhatIsDrawn) {
  expect_ticket_agrees("a_line_skirt.json", "woman-38-168", "woman-34-168");
}

TEST(SlowTicketPipeline, LongerTrousersTicketSaysWhatIsDrawn) {
  expect_ticket_agrees("trousers.json", "man-50-178", "man-50-188");
}

TEST(SlowTicketPipeline, ASmallerChildsLeggingsTicketSaysWhatIsDrawn) {
  expect_ticket_agrees("leggings.json", "child-128", "child-116");
}

TEST(SlowTicketPipeline, AWiderTShirtsTicketSaysWhatIsDrawn) {
  expect_ticket_agrees("t_shirt.json", "man-50-178", "man-56-178");
}

TEST(SlowTicketPipeline, AWiderDresssTicketSaysWhatIsDrawn) {
  expect_ticket_agrees("dress.json", "woman-38-168", "woman-42-168");
}

// The darts of skirt and bodice move apart: the skirt's cloth between its darts is far from what is sewn to it.
TEST(TicketPipeline, PanelsWhoseClothDoesNotMeetItsNeighboursAreCutAnew) {
  const AlterResult result = alter("dress.json", "woman-38-168", "woman-50-165");
  EXPECT_TRUE(unlike_seams(result.altered.sewn).empty()) << unlike_seams(result.altered.sewn).front();
  EXPECT_FALSE(result.altered.flags.empty());
}

}  // namespace
}  // namespace toile
