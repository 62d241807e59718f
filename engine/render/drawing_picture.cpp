// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/render/drawing_picture.h"

#include <algorithm>

#include "engine/core/drawing_marks.h"
#include "engine/geometry/shelf_layout.h"
#include "engine/render/canvas.h"
#include "engine/render/label_room.h"
#include "engine/render/palette.h"
#include "engine/render/stretch_legend.h"

namespace toile {
namespace {

constexpr double kPieceGap = 24.0;  // mm between pieces
constexpr int kMargin = 16;         // pixels
constexpr double kLeastText = 7;    // pixels; smaller labels are left out ...
constexpr double kReadable = 4;     // mm; ... unless they are this tall on the cloth

// What a piece is filled with: its closed lines that bound cloth.
std::vector<const DrawingLine*> cloth_of(const DrawingPiece& piece) {
  std::vector<const DrawingLine*> cloth;
  for (const LineKind kind : {LineKind::Cut, LineKind::Stitch}) {
    for (const DrawingLine& line : piece.lines)
      if (line.kind == kind && line.closed) cloth.push_back(&line);
    if (!cloth.empty()) break;
  }
  return cloth;
}

class PicturePainter {
 public:
  PicturePainter(const Drawing& drawing, const DrawingPictureOptions& options) : drawing_(drawing), options_(options) {
    std::vector<Vec2> sizes;
    for (const DrawingPiece& piece : drawing.pieces) {
      const auto [low, high] = bounds(piece);
      sizes.emplace_back(high - low);
      lows_.push_back(low);
    }
    layout_ = lay_on_shelves(sizes, shelf_width(sizes, kPieceGap, 1.6), kPieceGap);
    const int width = std::clamp(options.width, 64, 8192);
    const int legend = options.stretch_scale ? kStretchLegendWidth + kMargin : 0;
    scale_ = std::max(16, width - 2 * kMargin - legend) / std::max(1.0, layout_.size.x());
    constexpr double kTallest = 8192.0;
    scale_ = std::min(scale_, kTallest / std::max(1.0, layout_.size.y()));
    top_ = kMargin + (options.title.empty() ? 0 : 28);
    const int least = options.stretch_scale ? 220 : 16;
    const int height = top_ + std::max(least, static_cast<int>(std::ceil(scale_ * layout_.size.y()))) + kMargin;
    canvas_.emplace(width, height, 2, kWhite);
  }

  Image paint() {
    if (!options_.title.empty()) canvas_->text({kMargin, kMargin + 14}, 14, options_.title, kInk);
    for (std::size_t i = 0; i < drawing_.pieces.size(); ++i) paint_piece(i);
    paint_labels();
    if (options_.stretch_scale) {
      const Vec2 corner(canvas_->width() - kMargin - kStretchLegendWidth, top_);
      draw_stretch_legend(*canvas_, corner, 220, *options_.stretch_scale);
    }
    return canvas_->finish();
  }

 private:
  Vec2 pixel(const Vec2& p) const {
    const Vec2 on_sheet = p + shift_;
    return {kMargin + scale_ * on_sheet.x(), top_ + scale_ * (layout_.size.y() - on_sheet.y())};
  }
  std::vector<Vec2> pixels(const std::vector<Vec2>& points) const {
    std::vector<Vec2> out;
    for (const Vec2& p : points) out.push_back(pixel(p));
    return out;
  }

  void paint_piece(std::size_t index) {
    const DrawingPiece& piece = drawing_.pieces[index];
    shift_ = layout_.corners[index] - lows_[index];
    const bool added = piece.role == PieceRole::Insertion;
    for (const DrawingLine* cloth : cloth_of(piece))
      canvas_->fill(pixels(cloth->points), added ? mix(kWhite, kInsertion, 0.25) : Rgb{246, 244, 240});
    if (index < options_.paint.size()) paint_triangles(options_.paint[index]);
    for (const DrawingLine& line : piece.lines)
      if (line.closed && (line.kind == LineKind::Insertion || line.kind == LineKind::Removal))
        canvas_->fill(pixels(line.points), mix(kWhite, line.kind == LineKind::Insertion ? kInsertion : kRemoval, 0.4));
    for (const DrawingLine& line : piece.lines) paint_line(line);
    for (const DrawingNotch& notch : piece.notches) canvas_->line(pixels(notch_outline(notch)), 1.2, kInk);
    for (const DrawingText& text : piece.texts) {
      const double height = std::min(14.0, std::max(scale_ * text.height, text.height >= kReadable ? kLeastText : 0.0));
      if (height >= kLeastText) labels_.push_back({pixel(text.at), height, text.text, text.angle});
    }
  }

  void paint_labels() {
    const std::vector<bool> room = labels_with_room(labels_);
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      const Label& label = labels_[i];
      if (room[i]) canvas_->text(label.at, label.height, label.text, kInk, Anchor::Middle, label.angle);
    }
  }

  void paint_triangles(const PiecePaint& paint) {
    for (int f = 0; f < paint.triangles.rows() && static_cast<std::size_t>(f) < paint.colours.size(); ++f) {
      std::vector<Vec2> corners;
      for (int k = 0; k < 3; ++k) corners.push_back(pixel(paint.vertices.row(paint.triangles(f, k)).transpose()));
      canvas_->fill(corners, paint.colours[static_cast<std::size_t>(f)]);
    }
  }

  void paint_line(const DrawingLine& line) {
    std::vector<Vec2> points = pixels(line.points);
    if (line.closed && !points.empty() && line.kind == LineKind::Stitch) points.push_back(points.front());
    switch (line.kind) {
      case LineKind::Cut: return canvas_->line(points, 1.4, kInk, line.closed);
      case LineKind::Stitch: return canvas_->dashed_line(points, 1.1, kInk, 5, 3);
      case LineKind::Fold: return canvas_->dashed_line(points, 1.1, kFaintInk, 10, 4);
      case LineKind::Internal: return canvas_->line(points, 1.0, kFaintInk, line.closed);
      case LineKind::Original: return canvas_->line(points, 1.4, {165, 165, 175}, line.closed);
      case LineKind::Insertion: return canvas_->line(points, 1.4, kInsertion, line.closed);
      case LineKind::Removal: return canvas_->line(points, 1.4, kRemoval, line.closed);
      case LineKind::Grainline:
        for (const auto& stroke : grainline_strokes(line)) canvas_->line(pixels(stroke), 1.0, kInk);
    }
  }

  const Drawing& drawing_;
  const DrawingPictureOptions& options_;
  std::vector<Vec2> lows_;
  ShelfLayout layout_;
  std::optional<Canvas> canvas_;
  std::vector<Label> labels_;  // of all pieces, in pixels
  Vec2 shift_ = Vec2::Zero();
  double scale_ = 1.0;
  int top_ = 0;
};

}  // namespace

Image draw_picture(const Drawing& drawing, const DrawingPictureOptions& options) {
  return PicturePainter(drawing, options).paint();
}

}  // namespace toile
