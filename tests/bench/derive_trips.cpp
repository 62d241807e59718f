// SPDX-License-Identifier: GPL-3.0-or-later
// `derive trips`: from the reference body to another one and back; how far the pattern ends from where it began.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/core/error.h"
#include "engine/io/drape_obj.h"
#include "engine/io/garmentcode_json.h"
#include "tests/bench/derive.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

constexpr double kGate = 2e-3;

// The way back as a user takes it: target_pattern.json of the first way with the target_worn.obj beside it.
DerivedGarment way_back(const DerivedGarment& there, const std::string& from, const std::string& to,
                        const AlterOptions& options, StageCache* stages) {
  const DerivedPattern& d = there.derived;
  const std::string pattern = write_garmentcode(d.drawn.pattern);
  GarmentInput garment{"target_pattern.json", Bytes(pattern.begin(), pattern.end())};
  garment.worn = write_drape_obj(d.drawn.pattern, d.mesh, there.transported.drape, &there.reference.fit);
  StageRunner runner(stages, nullptr, kDeriveStages);
  return derive_garment(garment, shared_wearer(from), shared_wearer(to), options, runner).value;
}

// Distances of pattern vertices, every panel shifted to the same centre, and turned as fits best where that is asked.
std::vector<double> distances(const PatternMesh& mesh, const Points2& a, const Points2& b, bool turn = false) {
  std::vector<double> all;
  for (const PanelRange& range : mesh.panels) {
    const int count = range.vertex_end - range.vertex_begin;
    Eigen::MatrixX2d pa = a.middleRows(range.vertex_begin, count), pb = b.middleRows(range.vertex_begin, count);
    pa.rowwise() -= pa.colwise().mean().eval();
    pb.rowwise() -= pb.colwise().mean().eval();
    const Mat2 moment = pb.transpose() * pa;
    const double angle = turn ? std::atan2(moment(0, 1) - moment(1, 0), moment.trace()) : 0.0;
    const Mat2 rotation = Eigen::Rotation2Dd(angle).toRotationMatrix();
    for (int i = 0; i < count; ++i) all.push_back((pa.row(i) - pb.row(i) * rotation.transpose()).norm());
  }
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

int derive_trips(const DeriveRequest& request, const Arguments& arguments) {
  const auto stages = stage_store(request.stages);
  Table table({"garment", "there and back", "changed by mm (p95)", "back: median mm", "p95 mm", "p95 turned mm",
               "largest mm", "fit there %", "fit back %"});
  int beyond = 0, beyond_turned = 0;
  for (const std::string& garment : request.garments)
    for (const std::string& body : request.bodies) {
      try {
        const DerivedGarment there = derive_pair(garment, body, request.options, stages.get());
        const DerivedGarment came =
            way_back(there, body, test::body_of_garment(garment), request.options, stages.get());
        const Points2& back = came.derived.mesh.rest;
        const PatternMesh& mesh = there.reference.mesh;
        const auto changed = distances(mesh, there.derived.mesh.rest, mesh.rest);
        const auto off = distances(mesh, back, mesh.rest);
        const auto p95 = [](const std::vector<double>& d) { return d[d.size() * 95 / 100]; };
        const auto turned = distances(mesh, back, mesh.rest, true);
        beyond += p95(off) > kGate;
        beyond_turned += p95(turned) > kGate;
        table.add({garment, test::body_of_garment(garment) + " - " + body, fixed(kMm * p95(changed), 1),
                   fixed(kMm * off[off.size() / 2], 2), fixed(kMm * p95(off), 2), fixed(kMm * p95(turned), 2),
                   fixed(kMm * off.back(), 2), fixed(100 * there.derived.rms_stretch_error, 2),
                   fixed(100 * came.derived.rms_stretch_error, 2)});
      } catch (const Error& error) {
        ++beyond;
        table.add({garment, body, error.message});
      }
    }
  table.print(arguments.csv);
  std::printf("round trips beyond 2 mm (p95): %d; with panels laid over each other as fits best: %d\n", beyond,
              beyond_turned);
  return beyond == 0 ? 0 : 1;
}

}  // namespace toile::bench
