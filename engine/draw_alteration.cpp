// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/draw_alteration.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/core/units.h"
#include "engine/geometry/curve.h"
#include "engine/geometry/inner_point.h"
#include "engine/stages/draw_pattern.h"

namespace toile {
namespace {

// "+2" for the second insertion of a panel, "-2" for its second removal.
std::string short_name(const AlteredRegion& region, char sign) {
  const std::size_t digits = region.name.find_last_not_of("0123456789") + 1;
  return sign + region.name.substr(digits);
}

// Words along the longer side of an outline, line under line, in the middle of the room there and no taller than fits.
std::vector<DrawingText> along_outline(const std::vector<Vec2>& outline, const std::vector<std::string>& lines) {
  Vec2 mean = Vec2::Zero();
  for (const Vec2& p : outline) mean += p / static_cast<double>(outline.size());
  Mat2 spread = Mat2::Zero();
  for (const Vec2& p : outline) spread += (p - mean) * (p - mean).transpose();
  Vec2 along = Eigen::SelfAdjointEigenSolver<Mat2>(spread).eigenvectors().col(1);
  if (along.x() < -1e-9 || (std::abs(along.x()) <= 1e-9 && along.y() < 0)) along = -along;
  const Vec2 up(-along.y(), along.x());
  const InnerPoint roomiest = roomiest_point(outline);
  const auto [back, ahead] = chord_through(outline, roomiest.at, along);
  const Vec2 middle = roomiest.at + 0.5 * (back + ahead) * along;
  std::vector<DrawingText> texts;
  double baseline = 1.0;
  for (const std::string& words : lines) {
    const double fitting = 0.9 * (ahead - back) / (0.8 * static_cast<double>(words.size()));
    const double height = std::clamp(fitting, 1.5, texts.empty() ? 4.5 : 3.0);
    texts.push_back({middle + baseline * up, height, words, std::atan2(along.y(), along.x())});
    baseline -= 1.8 * height;
  }
  return texts;
}

DrawingLine closed(LineKind kind, std::vector<Vec2> points) {
  return {kind, std::move(points), true, {}};
}

// The border of a piece where it lies in the wanted panel.
std::vector<Vec2> border_in_target(const PieceMap& map) {
  std::vector<Vec2> outline;
  for (int v = 0; v < map.border_count; ++v) outline.emplace_back(map.target.row(v).transpose() * kMmPerMetre);
  return outline;
}

void name_region(const std::vector<Vec2>& outline, const std::string& words, DrawingPiece& piece) {
  piece.texts.push_back({roomiest_point(outline).at, 4.0, words});
}

class AlterationDrawer {
 public:
  AlterationDrawer(const Pattern& pattern, const AlterPatternResult& alteration)
      : pattern_(pattern), alteration_(alteration), pieces_(draw_pattern(alteration.sewn.pattern)) {
    for (std::size_t i = 0; i < alteration.sewn.pieces.size(); ++i) {
      const SewnPiece& piece = alteration.sewn.pieces[i];
      (piece.insertion >= 0 ? new_ : kept_)[piece.panel].push_back(i);
    }
  }

  Drawing draw() {
    drawing_.title = pattern_.name;
    for (int p = 0; p < static_cast<int>(alteration_.panels.size()); ++p) draw_panel(p);
    return std::move(drawing_);
  }

 private:
  void draw_panel(int p) {
    const PanelAlteration& panel = alteration_.panels[static_cast<std::size_t>(p)];
    const bool altered = !panel.insertions.empty() || !panel.removals.empty();
    for (const std::size_t i : kept_[p]) {
      DrawingPiece piece = std::move(pieces_.pieces[i]);
      const SewnPiece& sewn = alteration_.sewn.pieces[i];
      if (sewn.recut && !sewn.own_cloth) piece.role = PieceRole::Insertion;
      if (kept_[p].size() == 1 && (sewn.own_cloth || (altered && !sewn.recut))) show_original(panel, piece);
      drawing_.pieces.push_back(std::move(piece));
    }
    if (kept_[p].size() > 1) drawing_.pieces.push_back(as_cut(p));
    if (new_[p].empty()) return;
    drawing_.pieces.push_back(as_sewn(p));
    for (const std::size_t i : new_[p]) drawing_.pieces.push_back(insertion(i));
  }

  // What the cloth was before, and what of it is taken away.
  static void show_original(const PanelAlteration& panel, DrawingPiece& piece) {
    std::vector<DrawingLine> lines = {closed(LineKind::Original, in_mm(panel.original))};
    for (const AlteredRegion& region : panel.removals) {
      const std::vector<Vec2> outline = in_mm(region.shape.outline);
      lines.push_back(closed(LineKind::Removal, outline));
      name_region(outline, short_name(region, '-'), piece);
    }
    piece.lines.insert(piece.lines.begin(), lines.begin(), lines.end());
  }

  DrawingPiece guide(int p, const char* suffix, const char* words) const {
    const Panel& panel = pattern_.panels[static_cast<std::size_t>(p)];
    DrawingPiece piece;
    piece.name = panel.name + suffix;
    piece.label = (panel.piece_label.empty() ? panel.name : panel.piece_label) + words;
    piece.role = PieceRole::Guide;
    piece.quantity = 0;
    return piece;
  }

  // Where the kept pieces lie in the original cloth.
  DrawingPiece as_cut(int p) const {
    DrawingPiece piece = guide(p, "_as_cut", " as cut");
    for (const std::size_t i : kept_.at(p)) {
      const Panel& part = alteration_.sewn.pattern.panels[i];
      const std::vector<Vec2> outline = in_mm(flatten_outline(part, 1e-4));
      piece.lines.push_back(closed(LineKind::Stitch, outline));
      name_region(outline, part.piece_label.empty() ? part.name : part.piece_label, piece);
    }
    show_original(alteration_.panels[static_cast<std::size_t>(p)], piece);
    return piece;
  }

  // The wanted panel with everything in its place.
  DrawingPiece as_sewn(int p) const {
    const PanelAlteration& panel = alteration_.panels[static_cast<std::size_t>(p)];
    DrawingPiece piece = guide(p, "_as_sewn", " as sewn");
    for (const std::size_t i : new_.at(p)) {
      const SewnPiece& sewn = alteration_.sewn.pieces[i];
      const std::vector<Vec2> outline = border_in_target(sewn.map);
      piece.lines.push_back(closed(LineKind::Insertion, outline));
      name_region(outline, short_name(panel.insertions[static_cast<std::size_t>(sewn.insertion)], '+'), piece);
    }
    for (const std::size_t i : kept_.at(p))
      piece.lines.push_back(closed(LineKind::Internal, border_in_target(alteration_.sewn.pieces[i].map)));
    const std::vector<Vec2> target = in_mm(panel.target);
    piece.lines.push_back(closed(LineKind::Stitch, target));
    piece.texts.push_back({roomiest_point(target).at, 8.0, piece.label});
    return piece;
  }

  // New cloth is often a narrow strip: its words run along it.
  DrawingPiece insertion(std::size_t i) {
    DrawingPiece piece = std::move(pieces_.pieces[i]);
    const SewnPiece& sewn = alteration_.sewn.pieces[i];
    const PanelAlteration& panel = alteration_.panels[static_cast<std::size_t>(sewn.panel)];
    piece.role = PieceRole::Insertion;
    std::erase_if(piece.texts,
                  [&](const DrawingText& text) { return text.text == piece.label || text.text.starts_with("cut "); });
    const AlteredRegion& region = panel.insertions[static_cast<std::size_t>(sewn.insertion)];
    for (DrawingText& text :
         along_outline(in_mm(flatten_outline(alteration_.sewn.pattern.panels[i], 1e-4)),
                       {short_name(region, '+') + " " + panel.panel, "cut " + std::to_string(piece.quantity)}))
      piece.texts.push_back(std::move(text));
    return piece;
  }

  const Pattern& pattern_;
  const AlterPatternResult& alteration_;
  Drawing pieces_, drawing_;
  std::map<int, std::vector<std::size_t>> kept_, new_;  // per panel, numbers of sewn pieces
};

// Where no sewn pattern could be made: the panels as they were, with what is to be done to them.
Drawing draw_unsewn(const Pattern& pattern, const AlterPatternResult& alteration) {
  Drawing drawing = draw_pattern(pattern);
  for (std::size_t p = 0; p < alteration.panels.size(); ++p) {
    for (const AlteredRegion& region : alteration.panels[p].removals)
      drawing.pieces[p].lines.push_back(closed(LineKind::Removal, in_mm(region.shape.outline)));
    for (const auto& cut : alteration.panels[p].cut_lines)
      drawing.pieces[p].lines.push_back({LineKind::Insertion, in_mm(cut), false, {}});
  }
  return drawing;
}

}  // namespace

std::vector<Vec2> in_mm(const std::vector<Vec2>& metres) {
  std::vector<Vec2> points;
  for (const Vec2& p : metres) points.emplace_back(p * kMmPerMetre);
  return points;
}

Drawing draw_alteration(const Pattern& pattern, const AlterPatternResult& alteration) {
  if (alteration.sewn.pieces.empty()) return draw_unsewn(pattern, alteration);
  return AlterationDrawer(pattern, alteration).draw();
}

}  // namespace toile
