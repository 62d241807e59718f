// SPDX-License-Identifier: GPL-3.0-or-later
// `derive trips`: from the reference body to another one and back; how far the pattern ends from where it began.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/core/error.h"
#include "engine/stage_options.h"
#include "tests/bench/derive.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

constexpr double kMm = 1e3, kGate = 2e-3;

// The target pattern of the first way is the reference of the way back.
DerivedPattern way_back(const DerivedGarment& there, const AlterOptions& options) {
  const DerivedPattern& d = there.derived;
  const BodyMap map = register_bodies(there.target_body, there.reference.body).map;
  const Drape transported =
      transport_garment(d.mesh, d.drape.drape, there.target_body, there.reference.body, map).drape;
  const auto plane = mirror_plane_of(options, d.drawn.pattern);
  const auto mirrors = plane ? find_garment_mirrors(d.drawn.pattern, d.mesh, d.drape.drape, *plane) : GarmentMirrors{};
  return derive_in_loop(d.drawn.pattern, d.mesh, d.fit, there.reference.body, transported, mirrors,
                        derive_options_of(options), drape_options_of(options), loop_options_of(options));
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
  int beyond = 0;
  for (const std::string& garment : request.garments)
    for (const std::string& body : request.bodies) {
      try {
        const DerivedGarment there = derive_pair(garment, body, request.options, stages.get());
        const DerivedPattern back = way_back(there, request.options);
        const PatternMesh& mesh = there.reference.mesh;
        const auto changed = distances(mesh, there.derived.mesh.rest, mesh.rest);
        const auto off = distances(mesh, back.mesh.rest, mesh.rest);
        const auto p95 = [](const std::vector<double>& d) { return d[d.size() * 95 / 100]; };
        beyond += p95(off) > kGate;
        table.add({garment, test::body_of_garment(garment) + " - " + body, fixed(kMm * p95(changed), 1),
                   fixed(kMm * off[off.size() / 2], 2), fixed(kMm * p95(off), 2),
                   fixed(kMm * p95(distances(mesh, back.mesh.rest, mesh.rest, true)), 2), fixed(kMm * off.back(), 2),
                   fixed(100 * there.derived.rms_stretch_error, 2), fixed(100 * back.rms_stretch_error, 2)});
      } catch (const Error& error) {
        ++beyond;
        table.add({garment, body, error.message});
      }
    }
  table.print(arguments.csv);
  std::printf("round trips beyond 2 mm (p95): %d\n", beyond);
  return beyond == 0 ? 0 : 1;
}

}  // namespace toile::bench
