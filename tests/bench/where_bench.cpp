// SPDX-License-Identifier: GPL-3.0-or-later
// where [--triangles N] [--mu X] GARMENT:BODY...: where an altered garment rests off the place its reference's drape is
// carried to on the target body, piece by piece and at every open edge, and how long its pieces' sides have become
// against the target pattern: what `alter --drape` tells as one number. Before that how far the target pattern itself
// rests off when it is meshed anew, a little coarser and finer: nearer than that no alteration can be expected to rest.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>

#include "engine/core/units.h"
#include "engine/geometry/flat_locator.h"
#include "engine/stage_options.h"
#include "tests/bench/alter_pairs.h"
#include "tests/bench/derive.h"

namespace toile::bench {
namespace {

constexpr double kSameSide = 3e-3;  // m, from a side of the target panel to all of a piece's edge that lies on it

double distance_to(const Vec2& p, const Points2& points, const std::vector<int>& line) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < line.size(); ++k) {
    const Vec2 a = points.row(line[k - 1]), along = points.row(line[k]).transpose() - a;
    const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (a + t * along - p).norm());
  }
  return least;
}

double length_of(const std::vector<Vec2>& line) {
  double length = 0.0;
  for (std::size_t k = 1; k < line.size(); ++k) length += (line[k] - line[k - 1]).norm();
  return length;
}

struct Where {
  const DerivedGarment& derived;
  const AlterPatternResult& altered;
  DrapedAlteration carried, rested;  // the altered garment where it should rest, and where it does

  const SewnPattern& sewn() const { return altered.sewn; }
  const PatternMesh& mesh() const { return rested.mesh; }
  Eigen::RowVector3d off(int vertex) const {
    const int node = mesh().node_of_vertex[static_cast<std::size_t>(vertex)];
    return kMmPerMetre * (rested.drape.drape.nodes.row(node) - carried.drape.drape.nodes.row(node));
  }
  std::string name_of(std::size_t piece) const {
    const SewnPiece& sewn_piece = sewn().pieces[piece];
    const std::string panel = derived.reference.pattern.panels[static_cast<std::size_t>(sewn_piece.panel)].name;
    return panel + (sewn_piece.insertion >= 0 ? " insertion" : sewn_piece.recut ? " cut anew" : "");
  }
};

std::vector<std::string> row_of(std::string name, std::string what, const std::vector<Eigen::RowVector3d>& off) {
  Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
  double squares = 0.0;
  for (const auto& d : off) mean += d, squares += d.squaredNorm();
  const double count = static_cast<double>(std::max<std::size_t>(1, off.size()));
  mean /= count;
  return {std::move(name),    std::move(what),    fixed(mean.x(), 1),
          fixed(mean.y(), 1), fixed(mean.z(), 1), fixed(std::sqrt(squares / count), 1)};
}

void print_positions(const Where& where) {
  Table table({"piece", "edge", "left mm", "up mm", "front mm", "rms mm"});
  std::vector<std::vector<Eigen::RowVector3d>> of_piece(where.sewn().pieces.size());
  for (int v = 0; v < where.mesh().vertex_count(); ++v)
    of_piece[static_cast<std::size_t>(where.mesh().panel_of_vertex[static_cast<std::size_t>(v)])].push_back(
        where.off(v));
  for (std::size_t p = 0; p < of_piece.size(); ++p) {
    table.add(row_of(where.name_of(p), "all", of_piece[p]));
    const PanelId panel{static_cast<int>(p)};
    for (int edge = 0; edge < where.sewn().pattern.panel(panel).edge_count(); ++edge) {
      const auto here = [&](const SeamSide& side) { return side.panel.value == panel.value && side.edge == edge; };
      const auto& seams = where.sewn().pattern.seams;
      if (std::any_of(seams.begin(), seams.end(), [&](const Seam& s) { return here(s.a) || here(s.b); })) continue;
      std::vector<Eigen::RowVector3d> off;
      for (const int v : where.mesh().edge_vertices[p][static_cast<std::size_t>(edge)]) off.push_back(where.off(v));
      table.add(row_of("", "open " + std::to_string(edge), off));
    }
  }
  table.print();
}

// Lengths of the target panels' sides, and how much longer the altered pieces that lie along them are.
void print_lengths(const Where& where) {
  const PatternMesh& target = where.derived.derived.mesh;
  std::map<std::pair<int, int>, double> longer;
  for (std::size_t p = 0; p < where.sewn().pieces.size(); ++p) {
    const SewnPiece& piece = where.sewn().pieces[p];
    const FlatLocator flat(piece.map.rest, piece.map.triangles);
    for (const std::vector<int>& line : where.mesh().edge_vertices[p]) {
      std::vector<Vec2> rest, wanted;
      for (const int v : line) {
        rest.push_back(where.mesh().rest.row(v));
        wanted.push_back(flat.closest(rest.back()).of(piece.map.target, piece.map.triangles).transpose());
      }
      const auto& sides = target.edge_vertices[static_cast<std::size_t>(piece.panel)];
      for (std::size_t side = 0; side < sides.size(); ++side) {
        double farthest = 0.0;
        for (const Vec2& q : wanted) farthest = std::max(farthest, distance_to(q, target.rest, sides[side]));
        if (farthest < kSameSide) longer[{piece.panel, static_cast<int>(side)}] += length_of(rest) - length_of(wanted);
      }
    }
  }
  Table table({"panel", "side", "target mm", "longer mm", "%"});
  for (const auto& [key, difference] : longer) {
    const auto panel = static_cast<std::size_t>(key.first);
    std::vector<Vec2> line;
    for (const int v : target.edge_vertices[panel][static_cast<std::size_t>(key.second)])
      line.push_back(target.rest.row(v));
    const double length = length_of(line);
    table.add({where.derived.reference.pattern.panels[panel].name, std::to_string(key.second),
               fixed(kMmPerMetre * length, 0), fixed(kMmPerMetre * difference, 1),
               fixed(kPercent * difference / length, 1)});
  }
  table.print();
}

void print_target_itself(const DerivedGarment& derived, const DrapeOptions& options) {
  const SewnPattern sewn = uncut(derived.derived.drawn.pattern, derived.derived.mesh);
  DrapeSeries on_target(derived.target_body);
  std::printf("the target pattern itself: %.1f mm off; meshed anew:",
              kMmPerMetre * compare_positions(derived.transported.drape.nodes, derived.derived.drape.drape.nodes).rms);
  for (const double coarser : {0.93, 0.97, 1.03, 1.07}) {
    const TriedOn worn = try_on(scene_of(derived, derived.transported.drape), sewn,
                                coarser * derived.reference.mesh.target_edge_length, on_target, options);
    std::printf(" %.1f", kMmPerMetre * worn.position.rms);
  }
  std::printf("\n");
}

void tell(const AlterPair& pair, const AlterOptions& job, StageCache* stages) {
  const DerivedGarment derived = derive_pair(pair.garment, pair.body, job, stages);
  const AlterPatternResult altered = alter_derived(derived, job).altered;
  DrapeSeries on_target(derived.target_body);
  const auto drape = [&](bool keep) {
    DrapeOptions options = drape_options_of(job);
    options.keep_drape = keep;
    return drape_altered(scene_of(derived, derived.transported.drape), altered.sewn, {}, on_target, options);
  };
  const Where where{derived, altered, drape(true), drape(false)};
  std::printf("%s for %s: %zu operations, ", pair.garment.c_str(), pair.body.c_str(), altered.ticket.operations.size());
  if (!where.rested.problem.empty()) {
    std::printf("not draped: %s\n", where.rested.problem.c_str());
    return;
  }
  std::printf("%.1f mm off (rms)\n", kMmPerMetre * where.rested.position.rms);
  print_target_itself(derived, drape_options_of(job));
  print_positions(where);
  print_lengths(where);
}

}  // namespace

int bench_where(const Arguments& arguments) {
  AlterOptions job;
  job.triangles = 4000;
  std::vector<AlterPair> pairs;
  for (std::size_t i = 0; i < arguments.words.size(); ++i) {
    const std::string& word = arguments.words[i];
    const std::size_t colon = word.find(':');
    if (word == "--triangles" && i + 1 < arguments.words.size())
      job.triangles = std::atoi(arguments.words[++i].c_str());
    else if (word == "--mu" && i + 1 < arguments.words.size())
      job.stretch_limit = std::atof(arguments.words[++i].c_str());
    else if (colon != std::string::npos)
      pairs.push_back({word.substr(0, colon), word.substr(colon + 1)});
  }
  if (pairs.empty()) {
    std::fprintf(stderr, "usage: toile-bench where [--triangles N] [--mu X] GARMENT:BODY...\n");
    return 2;
  }
  const auto stages = stage_store({});
  for (const AlterPair& pair : pairs) tell(pair, job, stages.get());
  return 0;
}

}  // namespace toile::bench
