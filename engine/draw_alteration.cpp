// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/draw_alteration.h"

#include <algorithm>
#include <cmath>

#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/geometry/inner_point.h"
#include "engine/geometry/offset_polygon.h"
#include "engine/stages/draw_pattern.h"

namespace toile {
namespace {

constexpr double kTouch = 0.3;  // mm: borders nearer than this are one seam

std::vector<Vec2> in_mm(const std::vector<Vec2>& metres) {
  std::vector<Vec2> points;
  for (const Vec2& p : metres) points.emplace_back(p * kMmPerMetre);
  return points;
}

std::vector<std::vector<Vec2>> in_mm(const std::vector<std::vector<Vec2>>& lines) {
  std::vector<std::vector<Vec2>> out;
  for (const auto& line : lines) out.push_back(in_mm(line));
  return out;
}

// The outline without the spikes that booleans leave where two nearly equal borders part: cloth nobody can cut.
std::vector<Vec2> without_spikes(std::vector<Vec2> outline) {
  constexpr double kThin = 0.8;  // mm
  const auto is_spike = [&](std::size_t i) {
    const std::size_t n = outline.size();
    const Vec2 &before = outline[(i + n - 1) % n], &tip = outline[i], &after = outline[(i + 1) % n];
    if ((tip - before).dot(after - tip) >= 0) return false;
    const bool before_is_nearer = (before - tip).norm() < (after - tip).norm();
    return (before_is_nearer ? distance_to_polygon({tip, after}, before) : distance_to_polygon({tip, before}, after)) <
           kThin;
  };
  for (std::size_t i = 0; i < outline.size() && outline.size() > 3;) {
    if (!is_spike(i)) {
      ++i;
      continue;
    }
    outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(i));
    i = i > 1 ? i - 2 : 0;  // what was beside the tip may be one now
  }
  return outline;
}

// The outline with the wedges of its darts filled: folded cloth is not cut out.
std::vector<Vec2> with_darts(const std::vector<Vec2>& outline, const std::vector<std::vector<Vec2>>& darts) {
  if (darts.empty()) return outline;
  Loops cloth = darts;
  cloth.push_back(outline);
  std::vector<Vec2> largest = outline;
  double most = 0.0;
  for (const PolygonWithHoles& part : polygon_union(cloth)) {
    if (area(part) <= most) continue;
    most = area(part);
    largest = part.outline;
  }
  return without_spikes(largest);
}

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

double distance_to_line(const std::vector<Vec2>& line, const Vec2& p) {
  double least = 1e300;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    least = std::min(least, distance_to_polygon({line[i], line[i + 1]}, p));
  return least;
}

// For every segment of a closed outline: does it lie on one of the lines (closed or open)?
std::vector<bool> lies_on(const std::vector<Vec2>& outline, const std::vector<std::vector<Vec2>>& lines,
                          bool lines_closed) {
  std::vector<bool> on;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 middle = 0.5 * (outline[i] + outline[(i + 1) % outline.size()]);
    on.push_back(std::any_of(lines.begin(), lines.end(), [&](const auto& line) {
      return (lines_closed ? distance_to_polygon(line, middle) : distance_to_line(line, middle)) < kTouch;
    }));
  }
  return on;
}

// The outline grown by `marked` on marked segments and by `other` on the rest.
std::vector<Vec2> grown(const std::vector<Vec2>& outline, const std::vector<bool>& mark, double marked, double other) {
  std::vector<double> distances;
  for (const bool on : mark) distances.push_back(on ? marked : other);
  return offset_polygon(outline, distances);
}

// Middle of a polyline by arc length, with the unit direction there.
struct Middle {
  Vec2 at = Vec2::Zero(), along = Vec2::UnitX();
};
Middle middle_of(const std::vector<Vec2>& line) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) length += (line[i + 1] - line[i]).norm();
  double rest = 0.5 * length;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double step = (line[i + 1] - line[i]).norm();
    if (step > 0 && rest <= step)
      return {line[i] + rest / step * (line[i + 1] - line[i]), (line[i + 1] - line[i]) / step};
    rest -= step;
  }
  return {line.empty() ? Vec2(Vec2::Zero()) : line.front(), Vec2::UnitX()};
}

// Runs of marked segments round a closed outline, as polylines.
std::vector<std::vector<Vec2>> marked_runs(const std::vector<Vec2>& outline, const std::vector<bool>& mark) {
  const std::size_t n = outline.size();
  std::vector<std::vector<Vec2>> runs;
  std::size_t start = 0;
  while (start < n && mark[start]) ++start;  // begin behind an unmarked segment; n: all are marked
  for (std::size_t step = 1; step <= n; ++step) {
    const std::size_t i = (start + step) % n;
    if (!mark[i]) continue;
    if (step == 1 || !mark[(i + n - 1) % n] || runs.empty()) runs.push_back({outline[i]});
    runs.back().push_back(outline[(i + 1) % n]);
  }
  return runs;
}

DrawingNotch notch_at(const Vec2& at, const Vec2& inward, double allowance) {
  return {NotchType::V, at - allowance * inward, inward, allowance > 0 ? std::min(5.0, 0.5 * allowance) : 4.0, 4.0, at};
}

class AlterationDrawer {
 public:
  AlterationDrawer(const Pattern& pattern, const AlterPatternResult& alteration)
      : pattern_(pattern), alteration_(alteration), before_(draw_pattern(pattern)) {
    allowance_ = pattern.seam_allowance * kMmPerMetre;
  }

  Drawing draw() {
    drawing_.title = pattern_.name;
    for (std::size_t p = 0; p < alteration_.panels.size(); ++p) {
      const PanelAlteration& panel = alteration_.panels[p];
      const bool altered = !panel.insertions.empty() || !panel.removals.empty();
      drawing_.pieces.push_back(altered ? kept_cloth(static_cast<int>(p)) : before_.pieces[p]);
      if (panel.insertions.empty()) continue;
      drawing_.pieces.push_back(as_sewn(panel, before_.pieces[p]));
      for (const AlteredRegion& region : panel.insertions) add_insertion(panel, region);
    }
    return std::move(drawing_);
  }

 private:
  // Labels and grainline stay; the lines are those of the cut cloth.
  DrawingPiece kept_cloth(int number) const {
    const PanelAlteration& panel = alteration_.panels[static_cast<std::size_t>(number)];
    DrawingPiece piece = before_.pieces[static_cast<std::size_t>(number)];
    const auto darts = folded_darts(pattern_, number);
    std::erase_if(piece.lines,
                  [](const DrawingLine& line) { return line.kind == LineKind::Cut || line.kind == LineKind::Stitch; });
    std::vector<DrawingLine> lines = {closed(LineKind::Original, in_mm(panel.original))};
    for (const AlteredRegion& region : panel.removals) {
      lines.push_back(closed(LineKind::Removal, in_mm(region.shape.outline)));
      piece.texts.push_back({roomiest_point(in_mm(region.shape.outline)).at, 4.0, short_name(region, '-')});
    }
    const auto cuts = in_mm(panel.cut_lines);
    for (const PolygonWithHoles& part : panel.kept) {
      const std::vector<Vec2> outline = without_spikes(in_mm(part.outline));
      const std::vector<Vec2> cloth = with_darts(outline, darts);
      lines.push_back(closed(LineKind::Cut, grown(cloth, lies_on(cloth, cuts, false), 0.0, allowance_)));
      lines.push_back(closed(LineKind::Stitch, outline));
      for (const auto& hole : part.holes) lines.push_back(closed(LineKind::Stitch, in_mm(hole)));
    }
    for (const auto& cut : cuts) {
      lines.push_back({LineKind::Insertion, cut, false, {}});
      const auto [at, along] = middle_of(cut);
      const Vec2 left(-along.y(), along.x());
      piece.notches.push_back(notch_at(at, left, 0.0));
      piece.notches.push_back(notch_at(at, -left, 0.0));
    }
    piece.lines.insert(piece.lines.begin(), lines.begin(), lines.end());
    return piece;
  }

  DrawingPiece as_sewn(const PanelAlteration& panel, const DrawingPiece& before) const {
    DrawingPiece piece;
    piece.name = panel.panel + "_as_sewn";
    piece.label = before.label + " as sewn";
    piece.role = PieceRole::Guide;
    piece.quantity = 0;
    for (const AlteredRegion& region : panel.insertions) {
      const std::vector<Vec2> outline = in_mm(region.shape.outline);
      piece.lines.push_back(closed(LineKind::Insertion, outline));
      piece.texts.push_back({roomiest_point(outline).at, 4.0, short_name(region, '+')});
    }
    for (const auto& part : panel.kept_in_target) piece.lines.push_back(closed(LineKind::Internal, in_mm(part)));
    const std::vector<Vec2> target = in_mm(panel.target);
    piece.lines.push_back(closed(LineKind::Stitch, target));
    const Vec2 middle = roomiest_point(target).at;
    piece.texts.push_back({middle, 8.0, piece.label});
    return piece;
  }

  void add_insertion(const PanelAlteration& panel, const AlteredRegion& region) {
    const std::vector<Vec2> outline = without_spikes(in_mm(region.shape.outline));
    const std::vector<bool> joins = lies_on(outline, in_mm(panel.kept_in_target), true);
    DrawingPiece piece;
    piece.name = piece.label = region.name;
    piece.role = PieceRole::Insertion;
    piece.lines = {closed(LineKind::Cut, grown(outline, joins, 2 * allowance_, allowance_)),
                   closed(LineKind::Stitch, outline)};
    for (const auto& hole : region.shape.holes) piece.lines.push_back(closed(LineKind::Stitch, in_mm(hole)));
    const InnerPoint roomiest = roomiest_point(outline);
    const auto [down, up] = chord_through(outline, roomiest.at, Vec2::UnitY());
    const double half = 0.4 * std::min(-down, up);
    piece.lines.push_back({LineKind::Grainline, {roomiest.at - Vec2(0, half), roomiest.at + Vec2(0, half)}, false, {}});
    const std::vector<Vec2>& cut = piece.lines.front().points;
    piece.texts = along_outline(cut, {short_name(region, '+') + " " + panel.panel, "cut 1"});
    for (const auto& run : marked_runs(outline, joins)) {
      const auto [at, along] = middle_of(run);
      // The outline runs counter-clockwise: the piece lies on the left.
      piece.notches.push_back(notch_at(at, Vec2(-along.y(), along.x()), 2 * allowance_));
    }
    drawing_.pieces.push_back(std::move(piece));
  }

  const Pattern& pattern_;
  const AlterPatternResult& alteration_;
  Drawing before_, drawing_;
  double allowance_ = 10.0;  // mm
};

// One line per tear of a pass: "2: edge 4, 12.0 mm open".
std::vector<std::string> tear_words(const PanelTearing& tearing, const char* pass) {
  std::vector<std::string> words;
  for (const MadeTear& made : tearing.tears)
    words.push_back(print_text("%s %d: side %d, %.1f mm open, releases %.0f %%", pass, made.round + 1, made.tear.side,
                               made.largest_gap * kMmPerMetre, 100 * made.release));
  return words;
}

}  // namespace

Drawing draw_alteration(const Pattern& pattern, const AlterPatternResult& alteration) {
  return AlterationDrawer(pattern, alteration).draw();
}

Drawing draw_tears(const Pattern& pattern, const AlterPatternResult& alteration) {
  Drawing drawing{pattern.name, {}};
  for (const PanelAlteration& panel : alteration.panels) {
    std::vector<std::string> words = tear_words(panel.insertion_pass, "insert");
    for (std::string& word : tear_words(panel.removal_pass, "remove")) words.push_back(std::move(word));
    if (words.empty()) continue;
    DrawingPiece piece;
    piece.name = piece.label = panel.panel;
    piece.role = PieceRole::Guide;
    const std::vector<Vec2> original = in_mm(panel.original);
    piece.lines = {closed(LineKind::Stitch, original)};
    for (const AlteredRegion& region : panel.removals)
      piece.lines.push_back(closed(LineKind::Removal, in_mm(region.shape.outline)));
    for (const auto& cut : in_mm(panel.cut_lines)) piece.lines.push_back({LineKind::Insertion, cut, false, {}});
    const auto [low, high] = bounds(piece);
    piece.texts.push_back({Vec2(0.5 * (low.x() + high.x()), high.y() + 12), 10.0, panel.panel});
    for (std::size_t i = 0; i < words.size(); ++i)
      piece.texts.push_back(
          {Vec2(0.5 * (low.x() + high.x()), low.y() - 16.0 * static_cast<double>(i + 1)), 7.0, words[i]});
    drawing.pieces.push_back(std::move(piece));
  }
  return drawing;
}

}  // namespace toile
