// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/svg.h"

#include <algorithm>

#include "engine/core/drawing_marks.h"
#include "engine/core/units.h"
#include "engine/io/drawing_layout.h"
#include "engine/io/text_format.h"

namespace toile {
namespace {

// Embedded drawings are shown about this wide; there words that matter are raised to what can be read and the others,
// seam numbers mostly, left out.
constexpr double kPageWidth = 960.0;      // pixels
constexpr double kReadable = 8.0;         // pixels, of capitals
constexpr double kWordsThatMatter = 4.0;  // mm on the cloth
constexpr const char* kStyle =
    ".drawing path{fill:none;stroke-linejoin:round;stroke-linecap:round}"
    ".drawing .cut{stroke:#1c1c20;stroke-width:.6}"
    ".drawing .stitch{stroke:#1c1c20;stroke-width:.35;stroke-dasharray:4 2}"
    ".drawing .fold{stroke:#1c1c20;stroke-width:.35;stroke-dasharray:8 2 1 2}"
    ".drawing .internal{stroke:#6b6b75;stroke-width:.35}"
    ".drawing .grainline{stroke:#1c1c20;stroke-width:.35}"
    ".drawing .notch{stroke:#1c1c20;stroke-width:.5}"
    ".drawing .original{stroke:#8a8a94;stroke-width:.5}"
    ".drawing .insertion{stroke:#2f5bd8;stroke-width:.5;fill:#4670eb;fill-opacity:.22}"
    ".drawing .removal{stroke:#c8281e;stroke-width:.5;fill:#e13c32;fill-opacity:.22}"
    ".drawing .label{font-family:Helvetica,Arial,sans-serif;fill:#1c1c20;text-anchor:middle;stroke:none}"
    ".drawing .open{fill:none}"
    ".drawing.page path{vector-effect:non-scaling-stroke;stroke-width:.7px}"
    ".drawing .added .cut{stroke:#2f5bd8}"
    ".drawing.page .added .cut{fill:#4670eb;fill-opacity:.12}";

// Filled kinds have a second class for lines that bound nothing.
std::string_view open_line_name(LineKind kind) {
  if (kind == LineKind::Insertion) return "insertion open";
  return kind == LineKind::Removal ? "removal open" : line_kind_name(kind);
}

class SvgWriter {
 public:
  SvgWriter(const Drawing& drawing, const SvgOptions& options) : drawing_(drawing), options_(options) {
    SheetLayoutOptions sheet;
    sheet.header_mm = options.test_square ? kHeaderMm : 0.0;
    layout_ = lay_out(drawing, sheet);
    if (options.test_square) layout_.size.x() = std::max(layout_.size.x(), 260.0);
  }

  Bytes write() {
    head();
    if (options_.test_square) test_square();
    for (std::size_t i = 0; i < drawing_.pieces.size(); ++i) {
      shift_ = layout_.shifts[i];
      piece(drawing_.pieces[i], i);
    }
    out_ += "</svg>\n";
    return Bytes(out_.begin(), out_.end());
  }

 private:
  // Sheet coordinates: y down.
  std::string point(const Vec2& p) const {
    std::string text = number(p.x() + shift_.x(), 3);
    append(text, {" ", number(layout_.size.y() - p.y() - shift_.y(), 3)});
    return text;
  }

  void head() {
    const std::string width = number(layout_.size.x(), 3), height = number(layout_.size.y(), 3);
    if (!options_.inlined) out_ += "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    // Its own class keeps the styles inside when the drawing stands in a page.
    out_ += options_.inlined ? "<svg class=\"drawing page\" " : "<svg class=\"drawing\" ";
    out_ +=
        "xmlns=\"http://www.w3.org/2000/svg\" "
        "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" ";
    if (!options_.inlined) append(out_, {"width=\"", width, "mm\" height=\"", height, "mm\" "});
    append(out_, {"viewBox=\"0 0 ", width, " ", height, "\">\n"});
    append(out_, {"<title>", escape_xml(drawing_.title), "</title>\n<style>", kStyle, "</style>\n"});
  }

  void test_square() {
    shift_ = Vec2::Zero();
    const double top = layout_.size.y() - 10;
    out_ += "<g id=\"scale\" inkscape:groupmode=\"layer\" inkscape:label=\"scale\">\n";
    path("cut", {{15, top}, {115, top}, {115, top - 100}, {15, top - 100}}, true);
    label({Vec2(65, top - 48), 6, "100 mm"});
    label({Vec2(65, top - 60), 4, "print at 100 %"});
    append(out_, {"<text class=\"label\" style=\"text-anchor:start\" x=\"125\" y=\"26\" font-size=\"14\">",
                  escape_xml(drawing_.title), "</text>\n</g>\n"});
  }

  void path(std::string_view kind, const std::vector<Vec2>& points, bool closed) {
    if (points.empty()) return;
    append(out_, {"<path class=\"", kind, "\" d=\"M", point(points[0])});
    for (std::size_t i = 1; i < points.size(); ++i) append(out_, {i == 1 ? "L" : " ", point(points[i])});
    out_ += closed ? "Z\"/>\n" : "\"/>\n";
  }

  // Height of a text's capitals, mm; 0 leaves it out.
  double shown_height(const DrawingText& text) const {
    if (!options_.inlined) return text.height;
    const double readable = kReadable * layout_.size.x() / kPageWidth;
    return text.height >= kWordsThatMatter ? std::max(text.height, readable)
           : text.height < readable        ? 0.0
                                           : text.height;
  }

  void label(const DrawingText& text) {
    const double height = shown_height(text);
    if (height <= 0.0) return;
    const double x = text.at.x() + shift_.x(), y = layout_.size.y() - text.at.y() - shift_.y();
    const std::string at_x = number(x, 2), at_y = number(y, 2);
    // Capitals are 0.72 of the font size tall.
    append(out_, {"<text class=\"label\" x=\"", at_x, "\" y=\"", at_y, "\" font-size=\"", number(height / 0.72, 2)});
    const std::string degrees = number(-text.angle * kDegreePerRadian, 2);
    if (degrees != "0") append(out_, {"\" transform=\"rotate(", degrees, " ", at_x, " ", at_y, ")"});
    append(out_, {"\">", escape_xml(text.text), "</text>\n"});
  }

  void piece(const DrawingPiece& piece, std::size_t index) {
    append(out_, {"<g id=\"piece-", std::to_string(index + 1), "\" class=\"",
                  piece.role == PieceRole::Insertion ? "piece added" : "piece",
                  "\" inkscape:groupmode=\"layer\" inkscape:label=\"", escape_xml(piece.name), "\">\n"});
    for (const DrawingLine& line : piece.lines) {
      if (line.kind == LineKind::Grainline)
        for (const auto& stroke : grainline_strokes(line)) path(line_kind_name(line.kind), stroke, false);
      else
        path(line.closed ? line_kind_name(line.kind) : open_line_name(line.kind), line.points, line.closed);
    }
    for (const DrawingNotch& notch : piece.notches) path("notch", notch_outline(notch), false);
    for (const DrawingText& text : piece.texts) label(text);
    out_ += "</g>\n";
  }

  const Drawing& drawing_;
  const SvgOptions& options_;
  SheetLayout layout_;
  Vec2 shift_ = Vec2::Zero();
  std::string out_;
};

}  // namespace

Bytes write_svg(const Drawing& drawing, const SvgOptions& options) {
  return SvgWriter(drawing, options).write();
}

}  // namespace toile
