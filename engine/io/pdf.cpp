// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/pdf.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/shelf_layout.h"
#include "engine/io/drawing_layout.h"
#include "engine/io/pdf_content.h"
#include "engine/io/pdf_document.h"
#include "engine/io/pdf_tiles.h"
#include "engine/io/text_format.h"

namespace toile {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;
constexpr double kLongestSide =
    5000.0;  // mm; readers draw no more than 14400 units a side, longer pages use larger units
constexpr PdfStroke kThin{{0.55, 0.55, 0.6}, 0.2, {}};

Paper paper_of(PdfSheet sheet) {
  switch (sheet) {
    case PdfSheet::Letter: return {{215.9, 279.4}};
    case PdfSheet::A0: return {{841.0, 1189.0}};
    case PdfSheet::A4:
    case PdfSheet::Projector: break;
  }
  return {{210.0, 297.0}};
}

void test_square(PdfContent& content, const Vec2& corner) {
  content.stroke({corner, corner + Vec2(100, 0), corner + Vec2(100, 100), corner + Vec2(0, 100)}, true,
                 {{0, 0, 0}, 0.3, {}});
  content.text(corner + Vec2(50, 52), 6, "100 mm", PdfAlign::Middle);
  content.text(corner + Vec2(50, 42), 3.5, "print at 100 %, then measure this square", PdfAlign::Middle);
}

class PdfWriter {
 public:
  PdfWriter(const Drawing& drawing, const PdfOptions& options) : drawing_(drawing), options_(options) {
    pages_ = document_.reserve();
    font_ = document_.add("<</Type/Font/Subtype/Type1/BaseFont/Helvetica/Encoding/WinAnsiEncoding>>");
  }

  Bytes write() {
    const bool tiled = options_.sheet == PdfSheet::A4 || options_.sheet == PdfSheet::Letter;
    tiled ? write_tiled() : write_large();
    return finish();
  }

 private:
  // The whole sheet as one form, so that tiles do not repeat it.
  void make_form(const PdfContent* header) {
    PdfContent content;
    for (std::size_t i = 0; i < drawing_.pieces.size(); ++i) content.piece(drawing_.pieces[i], layout_.shifts[i]);
    std::string bytes = content.bytes();
    if (header) bytes += header->bytes();
    std::string dictionary = "/Type/XObject/Subtype/Form/BBox[-10 -10 ";
    append(dictionary, {number(layout_.size.x() + 10, 3), " ", number(layout_.size.y() + 10, 3), "]",
                        "/Resources<</Font<</F1 ", pdf_reference(font_), ">>>>"});
    form_ = document_.add_stream(dictionary, bytes);
  }

  void add_page(const Vec2& size_mm, const PdfContent& content) {
    const double unit = std::max(1.0, std::ceil(size_mm.maxCoeff() / kLongestSide));
    PdfContent page;
    page.transform(kPointsPerMm / unit, Vec2::Zero());
    const int stream = document_.add_stream("", page.bytes() + content.bytes());
    std::string body = "<</Type/Page/Parent ";
    append(body, {pdf_reference(pages_), "/MediaBox[0 0 ", number(size_mm.x() * kPointsPerMm / unit, 6), " ",
                  number(size_mm.y() * kPointsPerMm / unit, 6), "]"});
    if (unit > 1) append(body, {"/UserUnit ", number(unit, 0)});
    append(body, {"/Resources<</Font<</F1 ", pdf_reference(font_), ">>/XObject<</Sheet ", pdf_reference(form_), ">>>>",
                  "/Contents ", pdf_reference(stream), ">>"});
    page_numbers_.push_back(document_.add(std::move(body)));
  }

  void write_tiled() {
    const Paper paper = paper_of(options_.sheet);
    layout_ = lay_out(drawing_, tiled_layout(paper));
    make_form(nullptr);
    const Tiling tiling = tile_sheet(drawing_, layout_, paper);
    add_page(paper.size, overview(paper, tiling));
    for (const Tile& tile : tiling.tiles) add_page(paper.size, tile_page(paper, tile, tiling, true));
  }

  // As wide as a whole number of pages.
  SheetLayoutOptions tiled_layout(const Paper& paper) const {
    SheetLayoutOptions sheet;
    sheet.margin_mm = 5;
    std::vector<Vec2> sizes;
    for (const DrawingPiece& piece : drawing_.pieces) sizes.emplace_back(bounds(piece)[1] - bounds(piece)[0]);
    const double width = shelf_width(sizes, sheet.gap_mm, 1.2) + 2 * sheet.margin_mm;
    const double columns = std::max(1.0, std::round(width / paper.frame().x()));
    sheet.width_mm = columns * paper.frame().x() - 2 * sheet.margin_mm;
    return sheet;
  }

  PdfContent overview(const Paper& paper, const Tiling& tiling) const {
    PdfContent content;
    const double left = 15, top = paper.size.y() - 20;
    content.text({left, top - 6}, 6, drawing_.title.empty() ? "pattern" : drawing_.title);
    const std::string count = std::to_string(tiling.tiles.size());
    content.text({left, top - 16}, 3.2,
                 count + " sheets follow. Cut each along its left and upper frame line, lay it on");
    content.text({left, top - 22}, 3.2, "the overlap of its neighbour, diamond to diamond. Blank sheets are left out.");
    test_square(content, {left, top - 130});
    map_of_tiles(content, paper, tiling, {left, 15}, {paper.size.x() - 2 * left, top - 130 - 25});
    return content;
  }

  // The sheet small, with the frames and names of its tiles.
  void map_of_tiles(PdfContent& content, const Paper& paper, const Tiling& tiling, const Vec2& corner,
                    const Vec2& room) const {
    const Vec2 frame = paper.frame(), whole(tiling.columns * frame.x(), tiling.rows * frame.y());
    const double scale = std::min(room.x() / whole.x(), room.y() / whole.y());
    // The lowest row of tiles may reach below the sheet.
    const Vec2 origin = corner + Vec2(0, scale * (whole.y() - layout_.size.y()));
    content.save();
    content.transform(scale, origin);
    content.form("Sheet");
    content.restore();
    for (const Tile& tile : tiling.tiles) {
      const Vec2 low = origin + scale * tile.low, high = low + scale * frame;
      content.stroke({low, {high.x(), low.y()}, high, {low.x(), high.y()}}, true, kThin);
      content.text(0.5 * (low + high) - Vec2(0, 1.2), 2.4, tile.name(), PdfAlign::Middle);
    }
  }

  PdfContent tile_page(const Paper& paper, const Tile& tile, const Tiling& tiling, bool frame_lines) const {
    PdfContent content;
    const Vec2 frame = paper.frame(), low = Vec2(paper.margin, paper.margin + paper.overlap), high = low + frame;
    content.save();
    content.clip({paper.margin, paper.margin}, paper.size - Vec2::Constant(paper.margin));
    content.save();
    content.transform(1.0, low - tile.low);
    content.form("Sheet");
    content.restore();
    if (frame_lines) {
      content.stroke({low, {high.x(), low.y()}, high, {low.x(), high.y()}}, true, kThin);
      const Vec2 middle = 0.5 * (low + high);
      for (const Vec2& at : {Vec2(low.x(), middle.y()), Vec2(high.x(), middle.y()), Vec2(middle.x(), low.y()),
                             Vec2(middle.x(), high.y())})
        content.stroke({at + Vec2(5, 0), at + Vec2(0, 5), at - Vec2(5, 0), at - Vec2(0, 5)}, true, kThin);
      content.text({low.x() + 3, high.y() - 6}, 3.5, tile.name());
    }
    content.restore();
    if (frame_lines) {
      std::string foot = drawing_.title;
      append(foot, {foot.empty() ? "" : ", ", "sheet ", tile.name(), " of ", std::to_string(tiling.rows), " rows, ",
                    std::to_string(tiling.columns), " columns"});
      content.text({low.x(), 4}, 2.4, foot);
    }
    return content;
  }

  void write_large() {
    const bool projector = options_.sheet == PdfSheet::Projector;
    Paper paper = paper_of(options_.sheet);
    SheetLayoutOptions sheet;
    sheet.header_mm = kHeaderMm;
    if (!projector) sheet.width_mm = paper.frame().x() - 2 * sheet.margin_mm;
    layout_ = lay_out(drawing_, sheet);
    layout_.size.x() = std::max(layout_.size.x(), 260.0);
    PdfContent header;
    test_square(header, layout_.size.y() * Vec2::UnitY() + Vec2(15, -110));
    header.text({125, layout_.size.y() - 24}, 10, drawing_.title);
    make_form(&header);
    if (projector) {
      PdfContent content;
      content.form("Sheet");
      return add_page(layout_.size, content);
    }
    const Tiling tiling = tile_sheet(drawing_, layout_, paper);
    Tiling with_header = tiling;
    // The test square stands on the first page even where no piece does.
    if (tiling.tiles.empty() || tiling.tiles[0].row != 0 || tiling.tiles[0].column != 0)
      with_header.tiles.insert(with_header.tiles.begin(), {0, 0, {0, layout_.size.y() - paper.frame().y()}});
    for (const Tile& tile : with_header.tiles)
      add_page(paper.size, tile_page(paper, tile, with_header, with_header.tiles.size() > 1));
  }

  Bytes finish() {
    std::string kids = "<</Type/Pages/Kids[";
    for (const int page : page_numbers_) append(kids, {pdf_reference(page), " "});
    append(kids, {"]/Count ", std::to_string(page_numbers_.size()), ">>"});
    document_.set(pages_, std::move(kids));
    std::string root = "<</Type/Catalog/Pages ";
    // Readers must not shrink the pages when printing.
    append(root, {pdf_reference(pages_), "/ViewerPreferences<</PrintScaling/None>>>>"});
    const int catalog = document_.add(std::move(root));
    std::string info = "<</Producer(Toile)/Title";
    info += pdf_string(drawing_.title);
    if (!options_.date.empty()) append(info, {"/CreationDate", pdf_string(options_.date)});
    info += ">>";
    return document_.finish(catalog, document_.add(std::move(info)));
  }

  const Drawing& drawing_;
  const PdfOptions& options_;
  PdfDocument document_;
  SheetLayout layout_;
  int pages_ = 0, font_ = 0, form_ = 0;
  std::vector<int> page_numbers_;
};

}  // namespace

Bytes write_pdf(const Drawing& drawing, const PdfOptions& options) {
  return PdfWriter(drawing, options).write();
}

}  // namespace toile
