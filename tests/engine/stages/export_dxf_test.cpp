// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "engine/io/dxf.h"
#include "engine/stages/draw_pattern.h"
#include "engine/stages/import_pattern.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

namespace fs = std::filesystem;

std::string upper(std::string name) {
  for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name.substr(0, 20);
}

void expect_line(std::ofstream& out, const std::string& block, int layer, const DrawingLine& line) {
  out << block << " " << layer << " " << (line.closed ? "closed" : "open");
  for (const Vec2& p : line.points) out << " " << p.x() << " " << p.y();
  out << "\n";
}

// What read_dxf.py shall find: cut lines, sew lines and notches, from the drawing itself.
void write_expected(const Drawing& drawing, const fs::path& path) {
  std::ofstream out(path);
  out.precision(12);
  for (const DrawingPiece& piece : drawing.pieces) {
    const std::string block = upper(piece.name);
    for (const DrawingLine& line : piece.lines) {
      if (line.kind == LineKind::Cut) expect_line(out, block, 1, line);
      if (line.kind == LineKind::Stitch) expect_line(out, block, 14, line);
      if (line.kind == LineKind::Grainline) expect_line(out, block, 7, line);
    }
    for (const DrawingNotch& notch : piece.notches) {
      double angle = std::atan2(notch.inward.y(), notch.inward.x()) * 180.0 / M_PI;
      if (angle < 0) angle += 360.0;
      const int layer = notch.type == NotchType::V ? 4 : notch.type == NotchType::Castle ? 81 : 80;
      out << block << " " << layer << " notch " << notch.at.x() << " " << notch.at.y() << " " << notch.depth << " "
          << angle << "\n";
    }
  }
}

// 0: agrees; 1: not; 77: no ezdxf here.
int read_back(const Drawing& drawing, const DxfOptions& options, const std::string& name) {
  const fs::path folder = fs::temp_directory_path() / ("toile_dxf_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const fs::path dxf = folder / (name + ".dxf"), expected = folder / (name + ".txt");
  const Bytes bytes = write_dxf(drawing, options);
  std::ofstream(dxf, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  write_expected(drawing, expected);
  const std::string command = "/usr/bin/python3 '" TOILE_SOURCE_DIR "/tests/support/read_dxf.py' '" + dxf.string() +
                              "' '" + expected.string() + "'";
  const int status = std::system(command.c_str());
  fs::remove_all(folder);
  return WEXITSTATUS(status);
}

Pattern with_marks(Pattern pattern) {
  for (Panel& panel : pattern.panels) {
    panel.notches.push_back({0, 0.4, NotchType::V});
    panel.notches.push_back({1, 0.5, NotchType::Castle});
  }
  return pattern;
}

TEST(ExportDxf, AnotherProgramReadsOutlinesNotchesAndSewLinesBack) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const char* name : {"tshirt_fitted", "skirt_circle"}) {
    SCOPED_TRACE(name);
    const Pattern pattern = with_marks(
        import_pattern(test::read_file(test::shared_data("garments/" + std::string(name) + "_specification.json"))));
    const Drawing drawing = draw_pattern(pattern);
    const int astm = read_back(drawing, {}, name);
    if (astm == 77) GTEST_SKIP() << "python3-ezdxf is not installed";
    EXPECT_EQ(astm, 0);
    DxfOptions aama;
    aama.dialect = DxfDialect::Aama;
    EXPECT_EQ(read_back(drawing, aama, name), 0);
  }
}

std::string text_of(const Drawing& drawing, const DxfOptions& options) {
  const Bytes bytes = write_dxf(drawing, options);
  return {bytes.begin(), bytes.end()};
}

Drawing small_drawing() {
  Drawing drawing;
  drawing.title =
      "Jupe \xC3\xA9vas\xC3\xA9"
      "e";
  for (const char* name : {"a very long name of a piece 1", "a very long name of a piece 2"}) {
    DrawingPiece piece;
    piece.name = name;
    piece.lines.push_back({LineKind::Cut, {{0, 0}, {100, 0}, {100, 50.125}, {-0.001, 50}}, true, {}});
    piece.lines.push_back({LineKind::Fold, {{0, 0}, {0, 50}}, false, {}});
    piece.lines.push_back({LineKind::Fold, {{10, 10}, {90, 10}}, false, {}});
    drawing.pieces.push_back(piece);
  }
  return drawing;
}

TEST(ExportDxf, IsSevenBitWithShortUniqueNamesAndTwoDecimals) {
  const std::string text = text_of(small_drawing(), {});
  EXPECT_TRUE(std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 128; }));
  EXPECT_NE(text.find("Style Name: Jupe _vas_e"), std::string::npos);
  EXPECT_NE(text.find("A_VERY_LONG_NAME_OF_\r\n"), std::string::npos);
  EXPECT_NE(text.find("A_VERY_LONG_NAME_O_2\r\n"), std::string::npos);
  EXPECT_EQ(text.find("-0.00"), std::string::npos);
  EXPECT_NE(text.find(" 20\r\n50.12\r\n"), std::string::npos);
  EXPECT_EQ(text, text_of(small_drawing(), {}));
}

TEST(ExportDxf, AFoldOnTheCutLineIsTheMirrorLine) {
  const std::string text = text_of(small_drawing(), {});
  const auto count = [&](const std::string& words) {
    int n = 0;
    for (std::size_t at = text.find(words); at != text.npos; at = text.find(words, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("LINE\r\n  8\r\n6\r\n"), 2);
  EXPECT_EQ(count("LINE\r\n  8\r\n8\r\n"), 2);
}

TEST(ExportDxf, OldImportersGetPlainLinesAndAamaNoValidationCopies) {
  DxfOptions options;
  options.lines_only = true;
  options.dialect = DxfDialect::Aama;
  const std::string text = text_of(small_drawing(), options);
  EXPECT_EQ(text.find("POLYLINE"), std::string::npos);
  EXPECT_EQ(text.find("\r\n84\r\n"), std::string::npos);
  EXPECT_NE(text_of(small_drawing(), {}).find("\r\n84\r\n"), std::string::npos);
}

}  // namespace
}  // namespace toile
