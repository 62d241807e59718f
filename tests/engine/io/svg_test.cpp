// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/svg.h"

#include <regex>

#include <gtest/gtest.h>

#include "engine/io/drawing_layout.h"
#include "engine/io/text_format.h"
#include "tests/support/text_bytes.h"

namespace toile {
namespace {

Drawing two_pieces() {
  Drawing drawing;
  drawing.title = "shirt & <tie>";
  DrawingPiece piece;
  piece.name = "front \"left\"";
  piece.label = "front";
  piece.lines = {{LineKind::Cut, {{-10, -10}, {110, -10}, {110, 210}, {-10, 210}}, true, {}},
                 {LineKind::Stitch, {{0, 0}, {100, 0}, {100, 200}, {0, 200}}, true, {}},
                 {LineKind::Grainline, {{50, 20}, {50, 180}}, false, {}},
                 {LineKind::Removal, {{0, 0}, {30, 0}, {0, 30}}, true, {}}};
  piece.notches = {{NotchType::V, {110, 100}, {-1, 0}, 5, 4, {100, 100}}};
  piece.texts = {{{50, 100}, 8, "front"}};
  drawing.pieces = {piece, piece};
  drawing.pieces[1].name = "insertion_1";
  drawing.pieces[1].role = PieceRole::Insertion;
  return drawing;
}

// Numbers of every path of a class.
std::vector<std::vector<double>> paths(const std::string& svg, const std::string& kind) {
  std::vector<std::vector<double>> found;
  const std::regex path("<path class=\"" + kind + "\" d=\"([^\"]*)\"");
  for (auto it = std::sregex_iterator(svg.begin(), svg.end(), path); it != std::sregex_iterator(); ++it) {
    const std::string data = (*it)[1];
    const std::regex value("-?[0-9.]+");
    found.emplace_back();
    for (auto v = std::sregex_iterator(data.begin(), data.end(), value); v != std::sregex_iterator(); ++v)
      found.back().push_back(std::stod(v->str()));
  }
  return found;
}

TEST(Svg, SizesAreMillimetresAndUserUnitsToo) {
  const std::string svg = test::text_of(write_svg(two_pieces()));
  std::smatch match;
  ASSERT_TRUE(std::regex_search(
      svg, match, std::regex("width=\"([0-9.]+)mm\" height=\"([0-9.]+)mm\" viewBox=\"0 0 ([0-9.]+) ([0-9.]+)\"")));
  EXPECT_EQ(match[1], match[3]);
  EXPECT_EQ(match[2], match[4]);
}

TEST(Svg, LinesKeepTheirTrueSize) {
  const auto stitch = paths(test::text_of(write_svg(two_pieces())), "stitch");
  ASSERT_EQ(stitch.size(), 2u);
  for (const auto& p : stitch) {
    ASSERT_EQ(p.size(), 8u);
    EXPECT_NEAR(p[2] - p[0], 100, 1e-9);
    EXPECT_NEAR(p[3] - p[5], 200, 1e-9);  // y runs down
  }
}

TEST(Svg, TheScaleSquareIs100Millimetres) {
  const auto cut = paths(test::text_of(write_svg(two_pieces())), "cut");
  ASSERT_EQ(cut.size(), 3u);
  EXPECT_DOUBLE_EQ(cut[0][2] - cut[0][0], 100);
  EXPECT_DOUBLE_EQ(cut[0][5] - cut[0][3], 100);
}

TEST(Svg, EveryPieceIsALayerAndNamesAreEscaped) {
  const std::string svg = test::text_of(write_svg(two_pieces()));
  EXPECT_NE(svg.find("inkscape:groupmode=\"layer\" inkscape:label=\"front &quot;left&quot;\""), std::string::npos);
  EXPECT_NE(svg.find("inkscape:label=\"insertion_1\""), std::string::npos);
  EXPECT_NE(svg.find("<title>shirt &amp; &lt;tie&gt;</title>"), std::string::npos);
  EXPECT_EQ(paths(svg, "removal").size(), 2u);
  EXPECT_EQ(paths(svg, "notch").size(), 2u);
  EXPECT_EQ(paths(svg, "grainline").size(), 6u);  // a shaft and two heads each
}

TEST(Svg, TagsAreBalancedAndEverythingLiesInsideTheSheet) {
  const std::string svg = test::text_of(write_svg(two_pieces()));
  const auto count = [&](const std::string& what) {
    int n = 0;
    for (std::size_t at = svg.find(what); at != std::string::npos; at = svg.find(what, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("<g "), count("</g>"));
  EXPECT_EQ(count("<text "), count("</text>"));
  const SheetLayout layout = lay_out(two_pieces());
  for (const auto& path : paths(svg, "cut"))
    for (std::size_t i = 0; i < path.size(); i += 2) {
      EXPECT_GE(path[i], 0);
      EXPECT_LE(path[i], std::max(260.0, layout.size.x()));
    }
}

TEST(Svg, AnEmptyDrawingIsStillAnSvg) {
  const std::string svg = test::text_of(write_svg({}, {false, true}));
  EXPECT_EQ(svg.rfind("<svg", 0), 0u);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(TextFormat, NumbersAreShortAndNeverMinusZero) {
  EXPECT_EQ(number(1.5, 3), "1.5");
  EXPECT_EQ(number(-0.0001, 3), "0");
  EXPECT_EQ(number(100, 3), "100");
  EXPECT_EQ(number(1234.56789, 2), "1234.57");
  EXPECT_EQ(number(std::numeric_limits<double>::quiet_NaN(), 3), "0");
  EXPECT_EQ(escape_xml("a\x01<b>"), "a&lt;b&gt;");
}

}  // namespace
}  // namespace toile
