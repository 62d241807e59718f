// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/draw_tears.h"

#include <algorithm>

#include "engine/alter/tear_steps.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/draw_alteration.h"
#include "engine/render/palette.h"

namespace toile {
namespace {

constexpr double kCaption = 9.0;      // mm, height of letters
constexpr double kLine = 16.0;        // mm, between lines of a caption
constexpr double kLeastWide = 250.0;  // mm, of a frame: its caption has room
constexpr double kPercent = 100.0;

std::vector<Vec2> wanted_outline(const Sheet& sheet) {
  std::vector<Vec2> outline;
  for (const SideCurve& side : sheet.wanted_sides)
    outline.insert(outline.end(), side.points().begin(), side.points().end() - 1);
  return outline;
}

// The cloth's faces; what darts fold away is left out.
PiecePaint paint_of(const Sheet& sheet, double scale) {
  PiecePaint paint;
  paint.vertices.resize(sheet.vertex_count(), 2);
  for (int v = 0; v < sheet.vertex_count(); ++v)
    paint.vertices.row(v) = kMmPerMetre * sheet.vertices[static_cast<std::size_t>(v)].now.transpose();
  std::vector<Eigen::RowVector3i> faces;
  for (std::size_t f = 0; f < sheet.faces.size(); ++f) {
    if (sheet.folded[f]) continue;
    faces.emplace_back(sheet.faces[f][0], sheet.faces[f][1], sheet.faces[f][2]);
    paint.colours.push_back(stretch_colour(sheet_gradient(sheet, f).colwise().norm().maxCoeff() - 1.0, scale));
  }
  paint.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t f = 0; f < faces.size(); ++f) paint.triangles.row(static_cast<Eigen::Index>(f)) = faces[f];
  return paint;
}

// "insert 2: side 3" and "opens 12.0 mm, releases 40 %" for every tear of the step, then the stretch that is left.
std::vector<std::string> words_of(const TearStep& step) {
  const char* pass = step.removing ? "remove" : "insert";
  std::vector<std::string> words;
  for (const MadeTear& made : step.tears) {
    words.push_back(print_text("%s %d: %s %d", pass, made.round + 1,
                               made.tear.kind == TearKind::Edge ? "cut into side" : "side", made.tear.side));
    words.push_back(
        print_text("opens %.1f mm, releases %.0f %%", made.largest_gap * kMmPerMetre, kPercent * made.release));
  }
  if (words.empty()) words.push_back(print_text("%s: stretched", pass));
  words.push_back(print_text("stretch left %.1f %%", kPercent * std::max(0.0, step.stress.p95)));
  return words;
}

DrawingPiece frame_of(const Pattern& pattern, const TearStep& step) {
  DrawingPiece piece;
  const std::string& panel = pattern.panels[static_cast<std::size_t>(step.panel)].name;
  const int round = step.tears.empty() ? 0 : step.tears.front().round + 1;
  piece.name = panel + (step.removing ? "_remove_" : "_insert_") + std::to_string(round);
  piece.label = panel;
  piece.role = PieceRole::Guide;
  piece.lines.push_back({LineKind::Original, in_mm(wanted_outline(step.sheet)), true, {}});
  for (const auto& loop : border_loops(step.sheet)) {
    std::vector<Vec2> border;
    for (const BorderEdge& edge : loop) border.push_back(step.sheet.vertices[static_cast<std::size_t>(edge.from)].now);
    piece.lines.push_back({LineKind::Internal, in_mm(border), true, {}});
  }
  return piece;
}

// Caption and room: every frame from its own foot as tall as the tallest.
void write_caption(const std::vector<std::string>& words, double tallest, DrawingPiece& piece) {
  const auto [low, high] = bounds(piece);
  const double middle = 0.5 * (low.x() + high.x()), top = low.y() + tallest;
  const double half = 0.5 * std::max(kLeastWide, high.x() - low.x());
  piece.lines.push_back({LineKind::Original, {{middle - half, low.y()}, {middle - half, low.y()}}, false, {}});
  piece.lines.push_back({LineKind::Original, {{middle + half, top}, {middle + half, top}}, false, {}});
  double baseline = top - kCaption;
  piece.texts.push_back({Vec2(middle, baseline), kCaption, piece.label});
  for (const std::string& line : words) piece.texts.push_back({Vec2(middle, baseline -= kLine), kCaption, line});
}

}  // namespace

TearDrawing draw_tears(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
                       const AlterPatternResult& altered, const AlterPatternOptions& options) {
  TearDrawing tears{{pattern.name, {}}, {}, 2.0 * options.stretch_limit};
  std::vector<std::vector<std::string>> captions;
  double tallest = 0.0;
  for (const bool removing : {false, true})
    for (const TearStep& step : tear_steps(pattern, mesh, target_rest, altered, options, removing)) {
      tears.drawing.pieces.push_back(frame_of(pattern, step));
      tears.paint.push_back(paint_of(step.sheet, tears.stretch_scale));
      captions.push_back(words_of(step));
      const auto [low, high] = bounds(tears.drawing.pieces.back());
      tallest = std::max(tallest, high.y() - low.y() + kLine * (2.0 + static_cast<double>(captions.back().size())));
    }
  for (std::size_t i = 0; i < captions.size(); ++i) write_caption(captions[i], tallest, tears.drawing.pieces[i]);
  return tears;
}

Image picture_of_tears(const TearDrawing& tears) {
  DrawingPictureOptions options;
  options.width = 2400;
  options.paint = tears.paint;
  options.stretch_scale = tears.stretch_scale;
  options.title = tears.drawing.title + ": tears, round by round";
  return draw_picture(tears.drawing, options);
}

}  // namespace toile
