// SPDX-License-Identifier: GPL-3.0-or-later
// A garment on a scan's own skin and on the reference that was registered to it, each against the same garment on the
// body the scan was made of.
#include "engine/bodies/find_skeleton.h"
#include "engine/bodies/register_bodies.h"
#include "engine/geometry/mesh_slicer.h"
#include "engine/pipeline_inputs.h"
#include "engine/stages/build_fitting_map.h"
#include "engine/stages/compare_fits.h"
#include "engine/stages/transport_garment.h"
#include "tests/bench/bench.h"
#include "tests/bench/register_tables.h"
#include "tests/support/dressed.h"
#include "tests/support/registration/registration_score.h"
#include "tests/support/shared_body.h"

namespace toile::bench {
namespace {

constexpr int kTriangles = 4000;

// A scan with what is known of it, all in the frame that stands on the registered soles.
struct Scanned {
  Body raw, skin, source;
  BodyMap map;
};

Body human(TriangleMesh surface) {
  Body body;
  body.surface = std::move(surface);
  body.skeleton = find_skeleton(body.surface).skeleton;
  return body;
}

Scanned scanned(const std::string& name, const Body& reference) {
  BodyInput input{name, test::shared_scan_bytes(name)};
  const TargetBody imported = read_target_body(input);
  RegisterBodiesResult registered = register_bodies(reference, imported.seen());
  Scanned out;
  out.raw = imported.body;
  const double raised = stand_on_soles(out.raw, registered);
  out.map = registered.map;
  out.skin = human({out.map.mapped, reference.surface.triangles});
  TriangleMesh truth = test::scan_case(name).truth;
  truth.vertices.col(1).array() += raised;
  out.source = human(std::move(truth));
  return out;
}

struct Worn {
  Drape drape;
  FittingMap fit;
  DrapeQuality quality;
  double seconds = 0.0;
};

Worn wear(const test::Dressing& own, const Drape& reference, const Body& body, const BodyMap& map) {
  const Drape carried = transport_garment(own.mesh, reference, own.body, body, map).drape;
  Worn worn;
  DrapeResult result;
  worn.seconds =
      time_cpu(1, [&] { result = drape_from(own.pattern, own.mesh, body, carried, own.options, nullptr); }).median;
  worn.fit = build_fitting_map(own.mesh, result.drape);
  worn.drape = std::move(result.drape);
  worn.quality = result.quality;
  return worn;
}

// Hull girth of the garment round the trunk at a level, m; 0 where it has none.
double girth_at(const PatternMesh& mesh, const Drape& drape, double level) {
  TriangleMesh cloth{drape.nodes, Triangles(mesh.triangles.rows(), 3)};
  for (int f = 0; f < mesh.triangle_count(); ++f) cloth.triangles.row(f) = mesh.nodes_of_triangle(f).transpose();
  double girth = 0.0;
  for (const SliceComponent& piece : MeshSlicer(cloth).slice(level)) girth = std::max(girth, piece.hull_girth());
  return girth;
}

void add_row(Table& table, const std::string& scan, const std::string& garment, const char* surface,
             const test::Dressing& own, const Worn& worn, const Worn& wanted, const Skeleton& levels) {
  const FitDifference fit = compare_fits(own.mesh, wanted.fit, worn.fit).whole;
  const PositionDifference off = compare_positions(wanted.drape.nodes, worn.drape.nodes);
  std::vector<std::string> row = {scan, garment, surface, fixed(worn.seconds, 2)};
  row.emplace_back(rest_name(worn.quality.rest));
  for (const double share : {fit.rms_stretch, fit.mean_weft, fit.mean_warp, fit.share_beyond})
    row.push_back(fixed(100 * share, 2));
  for (const double metres : {off.rms, off.p95, off.largest}) row.push_back(fixed(1e3 * metres, 1));
  for (const double level : {levels.pelvis.y(), levels.waist_y, levels.chest.y()})
    row.push_back(fixed(1e3 * (girth_at(own.mesh, worn.drape, level) - girth_at(own.mesh, wanted.drape, level)), 1));
  table.add(std::move(row));
}

}  // namespace

int bench_register_skin(const Arguments& arguments) {
  std::vector<std::string> names(arguments.words.begin() + 1, arguments.words.end());
  if (names.empty()) names = {"scan_a", "scan_b", "scan_c", "scan_d"};
  Table table({"scan", "garment", "on", "drape s", "rest", "stretch rms %", "weft %", "warp %", "beyond 3 %",
               "place rms mm", "p95 mm", "most mm", "hip mm", "waist mm", "chest mm"});
  for (const char* garment : {"leggings_tight", "tshirt_fitted"}) {
    const test::Dressing own = test::dress(garment, kTriangles);
    const Drape reference = drape(own.pattern, own.mesh, own.body, own.options, nullptr).drape;
    for (const std::string& name : names) {
      const Scanned scan = scanned(name, own.body);
      const Worn wanted = wear(own, reference, scan.source, scan.map);
      const auto add = [&](const char* surface, const Worn& worn) {
        add_row(table, name, garment, surface, own, worn, wanted, *scan.source.skeleton);
      };
      add("source", wanted);
      add("raw scan", wear(own, reference, scan.raw, scan.map));
      add("registered", wear(own, reference, scan.skin, scan.map));
    }
  }
  table.print(arguments.csv);
  return 0;
}

}  // namespace toile::bench
