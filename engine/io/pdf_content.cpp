// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/pdf_content.h"

#include <cmath>

#include "engine/core/drawing_marks.h"
#include "engine/io/pdf_document.h"
#include "engine/io/text_format.h"

namespace toile {
namespace {

constexpr double kCapitals = 0.718;  // height of Helvetica's capitals over the font size

// Advance widths of Helvetica from ' ' to '~', thousandths of the font size (Adobe font metrics).
constexpr std::array<int, 95> kWidths = {
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333,  278, 278, 556, 556, 556,
    556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667,
    611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778, 722, 667,  611, 722, 667, 944, 667,
    667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278,  556, 556, 222, 222, 500,
    222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500,  500, 334, 260, 334, 584};

constexpr std::array<double, 3> kBlue = {0.18, 0.36, 0.85}, kRed = {0.78, 0.16, 0.12};
constexpr std::array<double, 3> kPaleBlue = {0.84, 0.88, 0.98}, kPaleRed = {0.98, 0.85, 0.84};

PdfStroke style_of(LineKind kind, PieceRole role) {
  PdfStroke style;
  switch (kind) {
    case LineKind::Cut:
      style.width = 0.5;
      if (role == PieceRole::Insertion) style.colour = kBlue;
      break;
    case LineKind::Stitch: style.dash = "4 2"; break;
    case LineKind::Fold: style.dash = "8 2 1 2"; break;
    case LineKind::Internal: style.colour = {0.45, 0.45, 0.5}; break;
    case LineKind::Original: style.colour = {0.6, 0.6, 0.65}; break;
    case LineKind::Insertion: style.colour = kBlue, style.width = 0.5; break;
    case LineKind::Removal: style.colour = kRed, style.width = 0.5; break;
    case LineKind::Grainline: break;
  }
  return style;
}

std::string colour(const std::array<double, 3>& rgb, std::string_view operation) {
  std::string text;
  for (const double channel : rgb) append(text, {number(channel, 3), " "});
  append(text, {operation, "\n"});
  return text;
}

std::vector<Vec2> moved(std::vector<Vec2> points, const Vec2& shift) {
  for (Vec2& p : points) p += shift;
  return points;
}

}  // namespace

double helvetica_width(std::string_view utf8, double height) {
  int width = 0;
  for (const char c : utf8) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0) == 0x80) continue;
    width += byte >= 0x20 && byte < 0x7F ? kWidths[static_cast<std::size_t>(byte - 0x20)] : 556;
  }
  return width * 1e-3 * height / kCapitals;
}

void PdfContent::transform(double scale, const Vec2& move) {
  const std::string s = number(scale, 9);
  append(out_, {s, " 0 0 ", s, " ", number(move.x(), 6), " ", number(move.y(), 6), " cm\n"});
}

void PdfContent::clip(const Vec2& low, const Vec2& high) {
  append(out_, {number(low.x(), 3), " ", number(low.y(), 3), " ", number(high.x() - low.x(), 3), " ",
                number(high.y() - low.y(), 3), " re W n\n"});
}

void PdfContent::path(const std::vector<Vec2>& points, bool closed) {
  for (std::size_t i = 0; i < points.size(); ++i)
    append(out_, {number(points[i].x(), 3), " ", number(points[i].y(), 3), i == 0 ? " m\n" : " l\n"});
  if (closed) out_ += "h ";
}

void PdfContent::stroke(const std::vector<Vec2>& points, bool closed, const PdfStroke& style) {
  if (points.size() < 2) return;
  append(out_, {colour(style.colour, "RG"), number(style.width, 3), " w [", style.dash, "] 0 d\n"});
  path(points, closed);
  out_ += "S\n";
}

void PdfContent::fill(const std::vector<Vec2>& points, const std::array<double, 3>& rgb) {
  if (points.size() < 3) return;
  out_ += colour(rgb, "rg");
  path(points, true);
  out_ += "f*\n";
}

void PdfContent::text(const Vec2& at, double height, std::string_view utf8, PdfAlign align, double angle) {
  const double shift = align == PdfAlign::Left ? 0.0 : align == PdfAlign::Middle ? 0.5 : 1.0;
  const double c = std::cos(angle), s = std::sin(angle);
  const Vec2 start = at - shift * helvetica_width(utf8, height) * Vec2(c, s);
  append(out_, {"0.1 0.1 0.12 rg BT /F1 ", number(height / kCapitals, 3), " Tf ", number(c, 6), " ", number(s, 6), " ",
                number(-s, 6), " ", number(c, 6), " ", number(start.x(), 3), " ", number(start.y(), 3), " Tm ",
                pdf_string(utf8), " Tj ET\n"});
}

void PdfContent::form(std::string_view name) {
  append(out_, {"/", name, " Do\n"});
}

void PdfContent::piece(const DrawingPiece& piece, const Vec2& shift) {
  for (const DrawingLine& line : piece.lines) {
    if (!line.closed) continue;
    if (line.kind == LineKind::Insertion) fill(moved(line.points, shift), kPaleBlue);
    if (line.kind == LineKind::Removal) fill(moved(line.points, shift), kPaleRed);
  }
  for (const DrawingLine& line : piece.lines) {
    const PdfStroke style = style_of(line.kind, piece.role);
    if (line.kind != LineKind::Grainline) {
      stroke(moved(line.points, shift), line.closed, style);
      continue;
    }
    for (const auto& part : grainline_strokes(line)) stroke(moved(part, shift), false, style);
  }
  for (const DrawingNotch& notch : piece.notches)
    stroke(moved(notch_outline(notch), shift), false, {{0.1, 0.1, 0.12}, 0.5, {}});
  for (const DrawingText& label : piece.texts)
    text(label.at + shift, label.height, label.text, PdfAlign::Middle, label.angle);
}

}  // namespace toile
