// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/pdf.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "engine/io/pdf_content.h"
#include "engine/io/pdf_document.h"
#include "engine/io/pdf_tiles.h"
#include "tests/support/text_bytes.h"

namespace toile {
namespace {

namespace fs = std::filesystem;

// A rectangle and a disc, together larger than several A4 pages.
Drawing rectangle_and_disc() {
  Drawing drawing;
  drawing.title = "skirt";
  DrawingPiece rectangle, disc;
  rectangle.name = "rectangle", disc.name = "disc";
  rectangle.lines = {{LineKind::Cut, {{0, 0}, {420, 0}, {420, 610}, {0, 610}}, true, {}}};
  DrawingLine round{LineKind::Cut, {}, true, {}};
  for (int i = 0; i < 180; ++i)
    round.points.emplace_back(240 * std::cos(i * std::numbers::pi / 90), 240 * std::sin(i * std::numbers::pi / 90));
  disc.lines = {round};
  drawing.pieces = {rectangle, disc};
  return drawing;
}

TEST(Pdf, TheCrossReferenceTablePointsAtEveryObject) {
  for (const PdfSheet sheet : {PdfSheet::A4, PdfSheet::Letter, PdfSheet::A0, PdfSheet::Projector}) {
    const std::string pdf = test::text_of(write_pdf(rectangle_and_disc(), {sheet, "D:20260101120000Z"}));
    EXPECT_EQ(pdf.rfind("%PDF-1.7\n", 0), 0u);
    std::smatch match;
    ASSERT_TRUE(std::regex_search(pdf, match, std::regex("startxref\n([0-9]+)\n%%EOF\n$")));
    std::istringstream table(pdf.substr(std::stoul(match[1])));
    std::string word;
    int first = 0, entries = 0;
    table >> word >> first >> entries;
    ASSERT_EQ(word, "xref");
    ASSERT_GT(entries, 5);
    std::getline(table, word);
    std::getline(table, word);
    for (int i = 1; i < entries; ++i) {
      std::getline(table, word);
      ASSERT_EQ(word.size(), 19u);
      const std::string head = std::to_string(i) + " 0 obj\n";
      EXPECT_EQ(pdf.compare(std::stoul(word.substr(0, 10)), head.size(), head), 0) << i;
    }
  }
}

TEST(Pdf, EqualDrawingsGiveEqualBytesAndOnlyTheGivenDateIsWritten) {
  EXPECT_EQ(write_pdf(rectangle_and_disc()), write_pdf(rectangle_and_disc()));
  EXPECT_EQ(test::text_of(write_pdf(rectangle_and_disc())).find("CreationDate"), std::string::npos);
  const std::string dated = test::text_of(write_pdf(rectangle_and_disc(), {PdfSheet::A0, "D:20260101120000Z"}));
  EXPECT_NE(dated.find("/CreationDate(D:20260101120000Z)"), std::string::npos);
}

TEST(Pdf, PagesHaveTheSizeOfTheirPaper) {
  const auto box = [](PdfSheet sheet) {
    const std::string pdf = test::text_of(write_pdf(rectangle_and_disc(), {sheet, {}}));
    std::smatch match;
    EXPECT_TRUE(std::regex_search(pdf, match, std::regex("MediaBox\\[0 0 ([0-9.]+) ([0-9.]+)\\]")));
    return Vec2(std::stod(match[1]), std::stod(match[2])) * 25.4 / 72;
  };
  EXPECT_NEAR((box(PdfSheet::A4) - Vec2(210, 297)).norm(), 0, 1e-4);
  EXPECT_NEAR((box(PdfSheet::Letter) - Vec2(215.9, 279.4)).norm(), 0, 1e-4);
  EXPECT_NEAR((box(PdfSheet::A0) - Vec2(841, 1189)).norm(), 0, 1e-4);
}

TEST(Pdf, APageLongerThanReadersDrawUsesALargerUnit) {
  Drawing banner = rectangle_and_disc();
  banner.pieces[0].lines[0].points[1].x() = banner.pieces[0].lines[0].points[2].x() = 12000;
  const std::string pdf = test::text_of(write_pdf(banner, {PdfSheet::Projector, {}}));
  EXPECT_EQ(test::count_of(pdf, "/UserUnit 3"), 1);
}

TEST(Pdf, BlankTilesAreLeftOutAndFramesCoverTheSheet) {
  Drawing far_apart = rectangle_and_disc();
  SheetLayout layout;
  layout.size = {2000, 2000};
  layout.shifts = {{0, 1390}, {1760, 240}};
  const Paper paper{{210, 297}};
  const Tiling tiling = tile_sheet(far_apart, layout, paper);
  EXPECT_EQ(tiling.columns, 12);
  EXPECT_EQ(tiling.rows, 8);
  EXPECT_LT(tiling.tiles.size(), 30u);
  EXPECT_EQ(tiling.tiles[0].name(), "A1");
  EXPECT_EQ((Tile{27, 2, {}}.name()), "AB3");
}

TEST(PdfDocument, TextIsEscapedAndReducedToLatin) {
  EXPECT_EQ(pdf_string("a(b)\\"), "(a\\(b\\)\\\\)");
  EXPECT_EQ(pdf_string("\xC3\xA9"), "(\xE9)");
  EXPECT_EQ(pdf_string("\xE2\x82\xAC!"), "(?!)");
  EXPECT_NEAR(helvetica_width("00", 0.718), 2 * 0.556, 1e-9);
}

// Pages as grey pictures; empty where poppler's pdftoppm is not installed.
struct GreyPage {
  int width = 0, height = 0;
  std::string pixels;
  bool dark(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height &&
           static_cast<unsigned char>(pixels[static_cast<std::size_t>(y * width + x)]) < 140;
  }
};

std::vector<GreyPage> render(const Bytes& pdf, int dots_per_inch) {
  const fs::path folder = fs::temp_directory_path() / ("toile_pdf_test_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "in.pdf", std::ios::binary)
      .write(reinterpret_cast<const char*>(pdf.data()), static_cast<std::streamsize>(pdf.size()));
  const std::string command = "pdftoppm -gray -aa no -aaVector no -r " + std::to_string(dots_per_inch) + " '" +
                              (folder / "in.pdf").string() + "' '" + (folder / "page").string() + "' 2>/dev/null";
  std::vector<GreyPage> pages;
  if (std::system(command.c_str()) == 0) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".pgm") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
      std::ifstream in(file, std::ios::binary);
      std::string magic;
      int most = 0;
      GreyPage page;
      in >> magic >> page.width >> page.height >> most;
      in.get();
      page.pixels.assign(std::istreambuf_iterator<char>(in), {});
      pages.push_back(std::move(page));
    }
  }
  fs::remove_all(folder);
  return pages;
}

TEST(PdfRendered, TheTestSquareMeasures100Millimetres) {
  const auto pages = render(write_pdf(rectangle_and_disc()), 254);  // 10 pixels a millimetre
  if (pages.empty()) GTEST_SKIP() << "pdftoppm is not installed";
  const GreyPage& page = pages[0];
  // Columns that are dark over most of the square's height are its sides; the same for rows.
  std::vector<int> columns, rows;
  for (int x = 0; x < page.width; ++x) {
    int n = 0;
    for (int y = 0; y < page.height; ++y) n += page.dark(x, y);
    if (n > 900) columns.push_back(x);
  }
  for (int y = 0; y < page.height; ++y) {
    int n = 0;
    for (int x = 150; x < 1150 && x < page.width; ++x) n += page.dark(x, y);
    if (n > 900) rows.push_back(y);
  }
  ASSERT_GE(columns.size(), 2u);
  ASSERT_GE(rows.size(), 2u);
  EXPECT_NEAR((columns.back() - columns.front()) / 10.0, 100, 0.5);
  EXPECT_NEAR((rows.back() - rows.front()) / 10.0, 100, 0.5);
}

TEST(PdfRendered, TheTilesAssembleToTheOutline) {
  const Drawing drawing = rectangle_and_disc();
  const auto pages = render(write_pdf(drawing), 127);  // 5 pixels a millimetre
  if (pages.empty()) GTEST_SKIP() << "pdftoppm is not installed";
  const Paper paper{{210, 297}};
  // The same sheet as the writer's: a whole number of frames wide.
  SheetLayoutOptions options;
  options.margin_mm = 5;
  options.width_mm = 5 * paper.frame().x() - 10;
  const SheetLayout layout = lay_out(drawing, options);
  const Tiling tiling = tile_sheet(drawing, layout, paper);
  ASSERT_EQ(pages.size(), tiling.tiles.size() + 1);
  int seen = 0, inside_blank = 0;
  for (std::size_t i = 0; i < drawing.pieces.size(); ++i) {
    const auto& points = drawing.pieces[i].lines[0].points;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vec2 at = 0.5 * (points[k] + points[(k + 1) % points.size()]) + layout.shifts[i];
      for (std::size_t t = 0; t < tiling.tiles.size(); ++t) {
        const Vec2 on_page = at - tiling.tiles[t].low + Vec2(10, 20);
        const Vec2 in_frame = at - tiling.tiles[t].low;
        if ((in_frame.array() < 0).any() || ((paper.frame() - in_frame).array() < 0).any()) continue;
        const GreyPage& page = pages[t + 1];
        const int x = static_cast<int>(5 * on_page.x()), y = static_cast<int>(5 * (297 - on_page.y()));
        bool near = false;
        for (int dy = -2; dy <= 2; ++dy)
          for (int dx = -2; dx <= 2; ++dx) near |= page.dark(x + dx, y + dy);
        EXPECT_TRUE(near) << "piece " << i << " point " << k << " tile " << tiling.tiles[t].name();
        ++seen;
        inside_blank += !page.dark(x + 15, y + 15);
      }
    }
  }
  EXPECT_GE(seen, 184);
  EXPECT_GT(inside_blank, seen / 2);  // the page is not simply black
}

}  // namespace
}  // namespace toile
