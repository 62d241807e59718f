// SPDX-License-Identifier: GPL-3.0-or-later
// The content of a PDF page or form, drawn in millimetres: lines of a drawing, marks and text in Helvetica (one of the
// fonts every reader has, named /F1 in the resources).
#pragma once

#include <string>
#include <string_view>

#include "engine/core/drawing.h"

namespace toile {

struct PdfStroke {
  std::array<double, 3> colour = {0.1, 0.1, 0.12};  // RGB, 0..1
  double width = 0.3;                               // mm
  std::string_view dash;                            // e.g. "4 2", mm; empty: solid
};

enum class PdfAlign { Left, Middle, Right };

class PdfContent {
 public:
  void save() { out_ += "q\n"; }
  void restore() { out_ += "Q\n"; }
  // Later coordinates are scaled about the origin, then moved.
  void transform(double scale, const Vec2& move);
  void clip(const Vec2& low, const Vec2& high);
  void stroke(const std::vector<Vec2>& points, bool closed, const PdfStroke& style);
  void fill(const std::vector<Vec2>& points, const std::array<double, 3>& colour);
  // `height` of capitals in mm; `at` on the baseline; `angle` of the baseline, rad, counter-clockwise.
  void text(const Vec2& at, double height, std::string_view utf8, PdfAlign align = PdfAlign::Left, double angle = 0.0);
  void form(std::string_view name);

  // One piece moved by `shift`: every line in the style of its kind, notches and labels.
  void piece(const DrawingPiece& piece, const Vec2& shift);

  const std::string& bytes() const { return out_; }

 private:
  void path(const std::vector<Vec2>& points, bool closed);

  std::string out_;
};

// Width of a text in Helvetica whose capitals are `height` tall, same unit. Latin-1 beyond ASCII counts as a digit.
double helvetica_width(std::string_view utf8, double height);

}  // namespace toile
