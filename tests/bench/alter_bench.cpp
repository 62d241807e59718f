// SPDX-License-Identifier: GPL-3.0-or-later
// alter [GARMENT:BODY...] [--triangles N] [--cache FOLDER] [--pictures FOLDER] [--greedy] [--sentences] [--growth]:
// alters shared garments for other bodies (default: the derivation's 40 pairs) and prints operations, what stretch the
// cloth keeps, and the CPU time of the alteration alone.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "engine/alter/alter_pattern.h"
#include "engine/core/drawing.h"
#include "engine/core/units.h"
#include "engine/render/drawing_picture.h"
#include "engine/render/png.h"
#include "tests/bench/alter_pairs.h"
#include "tests/bench/bench.h"

namespace toile::bench {
namespace {

struct Request {
  std::vector<AlterPair> pairs;
  int triangles = 4000;
  std::string cache, pictures;
  bool greedy = false, sentences = false, growth = false;
  AlterPatternOptions options;
};

Request parse(const std::vector<std::string>& words) {
  Request request;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const auto value = [&] { return i + 1 < words.size() ? words[++i] : std::string(); };
    if (word == "--triangles")
      request.triangles = std::atoi(value().c_str());
    else if (word == "--cache")
      request.cache = value();
    else if (word == "--pictures")
      request.pictures = value();
    else if (word == "--mu")
      request.options.stretch_limit = std::atof(value().c_str());
    else if (word == "--gamma")
      request.options.seam_preference = std::atof(value().c_str());
    else if (word == "--mesh-edges")
      request.options.mesh_edge_cuts = true;
    else if (word == "--greedy")
      request.greedy = true;
    else if (word == "--sentences")
      request.sentences = true;
    else if (word == "--growth")
      request.growth = true;
    else if (const std::size_t colon = word.find(':'); colon != std::string::npos)
      request.pairs.push_back({word.substr(0, colon), word.substr(colon + 1)});
    else
      for (const AlterPair& pair : acceptance_pairs())
        if (pair.garment == word || pair.body == word) request.pairs.push_back(pair);
  }
  if (request.pairs.empty()) request.pairs = acceptance_pairs();
  return request;
}

std::vector<Vec2> in_mm(std::vector<Vec2> line, const Vec2& shift = Vec2::Zero()) {
  for (Vec2& p : line) p = p * kMmPerMetre + shift;
  return line;
}

// A panel as it is cut (left) and as it will be (right).
DrawingPiece panel_piece(const PanelAlteration& panel) {
  DrawingPiece piece;
  piece.name = panel.panel;
  double right = -1e9, left = 1e9, top = -1e9;
  for (const Vec2& p : panel.original) right = std::max(right, p.x()), top = std::max(top, p.y());
  for (const Vec2& p : panel.target) left = std::min(left, p.x()), top = std::max(top, p.y());
  const Vec2 shift((right - left) * kMmPerMetre + 40, 0);
  piece.lines.push_back({LineKind::Original, in_mm(panel.original), true, {}});
  for (const auto& region : panel.removals)
    piece.lines.push_back({LineKind::Removal, in_mm(region.shape.outline), true, {}});
  for (const auto& cut : panel.cut_lines) piece.lines.push_back({LineKind::Insertion, in_mm(cut), false, {}});
  for (const auto& part : panel.kept) piece.lines.push_back({LineKind::Stitch, in_mm(part.outline), true, {}});
  piece.lines.push_back({LineKind::Original, in_mm(panel.target, shift), true, {}});
  for (const auto& part : panel.kept_in_target) piece.lines.push_back({LineKind::Stitch, in_mm(part, shift), true, {}});
  for (const auto& region : panel.insertions)
    piece.lines.push_back({LineKind::Insertion, in_mm(region.shape.outline, shift), true, {}});
  piece.texts.push_back({Vec2(right * kMmPerMetre, top * kMmPerMetre + 12), 14.0, panel.panel});
  return piece;
}

void draw(const Request& request, const AlterPair& pair, const AlterPatternResult& result) {
  Drawing drawing{pair.garment, {}};
  for (const PanelAlteration& panel : result.panels) drawing.pieces.push_back(panel_piece(panel));
  DrawingPictureOptions options;
  options.title = pair.garment + " for " + pair.body + ": " + std::to_string(result.ticket.operations.size()) +
                  " operations; red taken away (left), blue let in (right)";
  const Bytes png = write_png(draw_picture(drawing, options));
  std::filesystem::create_directories(request.pictures);
  std::ofstream(request.pictures + "/" + pair.garment + "_" + pair.body + ".png", std::ios::binary)
      .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
}

struct Remaining {
  double before = 0.0, after = 0.0;  // worst panel's p98 of both passes, dimensionless
  std::size_t tears = 0;
};

Remaining remaining(const AlterPatternResult& result) {
  Remaining r;
  for (const PanelAlteration& panel : result.panels)
    for (const PanelTearing* pass : {&panel.insertion_pass, &panel.removal_pass}) {
      r.before = std::max(r.before, pass->before.p98);
      r.after = std::max(r.after, pass->after.p98);
      r.tears += pass->tears.size();
    }
  return r;
}

double alter_one(const Request& request, const AlterPair& pair, int triangles, Table& table) {
  const DerivedPair d = derive_pair(pair, triangles, request.cache);
  const double start = cpu_seconds();
  const AlterPatternResult result = alter_pattern(d.pattern, d.mesh, d.target_rest, request.options);
  const double took = cpu_seconds() - start;
  const Remaining left = remaining(result);
  std::string greedy = "-";
  if (request.greedy) {
    AlterPatternOptions options = request.options;
    options.choice = TearChoice::Greedy;
    const AlterPatternResult other = alter_pattern(d.pattern, d.mesh, d.target_rest, options);
    greedy = std::to_string(other.ticket.operations.size()) + " / " + fixed(100 * remaining(other).after, 1);
  }
  table.add({pair.garment, pair.body, std::to_string(d.mesh.triangle_count()),
             std::to_string(result.ticket.operations.size()), std::to_string(left.tears), greedy,
             fixed(100 * left.before, 1), fixed(100 * left.after, 1), std::to_string(result.flags.size()),
             fixed(1e4 * result.inserted_area, 0), fixed(1e4 * result.removed_area, 0),
             fixed(100 * result.area_imbalance, 2), std::to_string(result.trials), fixed(took, 2)});
  if (!request.pictures.empty()) draw(request, pair, result);
  if (request.sentences) {
    std::printf("%s for %s\n", pair.garment.c_str(), pair.body.c_str());
    for (const TicketOperation& operation : result.ticket.operations) std::printf("  %s\n", operation.sentence.c_str());
    for (const std::string& flag : result.flags) std::printf("  flag: %s\n", flag.c_str());
  }
  return took;
}

}  // namespace

int bench_alter(const Arguments& arguments) {
  const Request request = parse(arguments.words);
  Table table({"garment", "body", "triangles", "operations", "tears", "greedy", "p98 % before", "after", "flags",
               "inserted cm2", "removed cm2", "balance %", "trials", "CPU s"});
  for (const AlterPair& pair : request.pairs) {
    std::vector<double> sizes, times;
    for (const int triangles :
         request.growth ? std::vector<int>{2000, 4000, 10000, 20000} : std::vector<int>{request.triangles}) {
      try {
        times.push_back(alter_one(request, pair, triangles, table));
        sizes.push_back(triangles);
      } catch (const std::exception& e) {
        std::printf("%s for %s: %s\n", pair.garment.c_str(), pair.body.c_str(), e.what());
      }
      std::fflush(stdout);
    }
    if (request.growth)
      std::printf("%s for %s: time grows as n^%.2f\n", pair.garment.c_str(), pair.body.c_str(),
                  growth_exponent(sizes, times));
  }
  table.print(arguments.csv);
  return 0;
}

}  // namespace toile::bench
