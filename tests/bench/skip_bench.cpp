// SPDX-License-Identifier: GPL-3.0-or-later
// skip [SCENE] [--triangles N]
// What is not done because a scene does not need it: each saving switched off and on in the same code, CPU seconds of
// both (median of the repeats), and what it changes: nothing to the last byte, or how much.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "engine/core/error.h"
#include "engine/core/units.h"
#include "engine/geometry/distance_field.h"
#include "engine/stage_options.h"
#include "tests/bench/derive.h"
#include "tests/bench/proof.h"
#include "tests/bench/whole_job.h"
#include "tests/bench/words.h"

namespace toile::bench {
namespace {

std::string same_bytes(bool same) {
  return same ? "same bytes" : "BYTES DIFFER";
}
std::string rms_mm(const Points3& a, const Points3& b) {
  return fixed(std::sqrt((a - b).rowwise().squaredNorm().mean()) * kMmPerMetre, 2) + " mm rms";
}

class SkipBench {
 public:
  SkipBench(const std::string& name, int triangles, int repeats) : scene_(test::named_scene(name)), repeats_(repeats) {
    options_.triangles = triangles;
    options_.outputs = outputs_named("none");
    job_ = run_job(scene_, options_, stages_.get());
    drape_options_ = drape_options_of(options_);
  }

  int run(const std::string& csv) {
    job_savings();
    registration();
    half_of_the_garment();
    start_of_the_target_drape();
    self_contact();
    field();
    derivation();
    table_.print(csv);
    return 0;
  }

 private:
  double seconds(const std::function<void()>& work) const { return time_cpu(repeats_, work).median; }
  void add(const std::string& saving, double off, double on, const std::string& difference) {
    table_.add({saving, fixed(off, 3), fixed(on, 3), off > 0 ? fixed(100 * (1 - on / off), 0) : "-", difference});
  }

  const AlterResult& result() const { return job_.result; }

  void job_savings() {
    JobRun cold, warm, with_all, with_after;
    const double off = seconds([&] { cold = run_job(scene_, options_); });
    const double on = seconds([&] { warm = run_job(scene_, options_, stages_.get()); });
    add("stages done before are read back", off, on, same_bytes(cold.files.back().bytes == warm.files.back().bytes));
    AlterOptions all = options_;
    all.outputs = outputs_named("all");
    run_job(scene_, all, stages_.get());  // so that what is compared is the making of the files alone
    const double made = seconds([&] { with_all = run_job(scene_, all, stages_.get()); });
    add("files nobody asked for are not made", made, on,
        same_bytes(with_all.result.altered.target_area == warm.result.altered.target_area));
    AlterOptions after = options_;
    after.outputs = {"target_after.obj"};
    const auto draped = [&] {
      DrapeSeries on_target(result().target_body);
      drape_altered(
          {result().reference.mesh, result().reference.fit, result().derived.mesh, result().derived.drape.drape},
          result().altered.sewn, {}, on_target, drape_options_);
    };
    add("altered garment not draped when no file shows it", seconds(draped), 0.0, same_bytes(true));
  }

  void registration() {
    RegisterBodiesOptions found;
    found.use_shared_topology = false;
    const Body &reference = result().reference.body, &target = result().target_body;
    if (reference.kind != BodyKind::Human || !register_bodies(reference, target).map.exact) return;
    RegisterBodiesResult sought, known;
    const double off = seconds([&] { sought = register_bodies(reference, target, found); });
    const double on = seconds([&] { known = register_bodies(reference, target); });
    add("bodies of one topology are not registered", off, on,
        "exact; registered: " + rms_mm(sought.map.mapped, known.map.mapped));
  }

  void half_of_the_garment() {
    const auto& [pattern, mesh, wearer, worn, fit] = result().reference;
    DrapeOptions whole_options = drape_options_;
    whole_options.halve = false;
    DrapeResult whole, half;
    const double off = seconds([&] { whole = drape(pattern, mesh, wearer, whole_options, nullptr); });
    const double on = seconds([&] { half = drape(pattern, mesh, wearer, drape_options_, nullptr); });
    const bool halved = half.diagnostics.moved_nodes < whole.diagnostics.moved_nodes;
    add("half of a symmetric garment moves, from flat", off, on,
        halved ? rms_mm(whole.drape.nodes, half.drape.nodes) + ", residual " + fixed(whole.quality.residual, 2) +
                     " -> " + fixed(half.quality.residual, 2)
               : "not symmetric: " + same_bytes(whole.drape.nodes == half.drape.nodes));
  }

  void start_of_the_target_drape() {
    const auto& [pattern, mesh, wearer, worn, fit] = result().reference;
    DrapeResult from_flat, carried;
    try {
      const double off =
          seconds([&] { from_flat = drape(pattern, mesh, result().target_body, drape_options_, nullptr); });
      const double on = seconds([&] {
        carried = drape_from(pattern, mesh, result().target_body, result().transported.drape, drape_options_, nullptr);
      });
      add("target drape starts from the transported one, not from flat", off, on,
          rms_mm(from_flat.drape.nodes, carried.drape.nodes));
    } catch (const Error& error) {
      std::printf("from flat on the target: %s\n", error.what());
    }
  }

  void self_contact() {
    const auto& [pattern, mesh, wearer, worn, fit] = result().reference;
    DrapeOptions without = drape_options_;
    without.self_contact = SelfContact::Off;
    DrapeResult off_result, on_result;
    const auto from = [&](const DrapeOptions& options) {
      return drape_from(pattern, mesh, result().target_body, result().transported.drape, options, nullptr);
    };
    const double with = seconds([&] { on_result = from(drape_options_); });
    const double none = seconds([&] { off_result = from(without); });
    add("cloth on cloth (on: not looked at)", with, none,
        std::to_string(on_result.quality.crossing_pairs) + " -> " + std::to_string(off_result.quality.crossing_pairs) +
            " crossing pairs, " + rms_mm(on_result.drape.nodes, off_result.drape.nodes));
  }

  // Makes every node of the lattice, as if cloth might be anywhere.
  static void visit_all(SurfaceField& lattice, const TriangleMesh& surface) {
    const SurfaceFieldOptions usual;
    const Vec3 low = surface.vertices.colwise().minCoeff(), high = surface.vertices.colwise().maxCoeff();
    Vec3 p, slope;
    for (p.z() = low.z() - usual.margin; p.z() < high.z() + usual.margin; p.z() += 3 * usual.spacing)
      for (p.y() = low.y() - usual.margin; p.y() < high.y() + usual.margin; p.y() += 3 * usual.spacing)
        for (p.x() = low.x() - usual.margin; p.x() < high.x() + usual.margin; p.x() += 3 * usual.spacing)
          lattice.evaluate(p, 1e3, slope);
  }

  // Distances where the cloth lies, against the whole lattice of the body.
  void field() {
    const TriangleMesh& surface = result().reference.body.surface;
    const Points3& nodes = result().reference.drape.drape.nodes;
    const auto visit = [&](SurfaceField& lattice) {
      constexpr double kFar = 0.02;  // m, beyond which the field tells no more than that
      double sum = 0.0;
      Vec3 slope;
      for (Eigen::Index i = 0; i < nodes.rows(); ++i)
        sum += std::min(lattice.evaluate(nodes.row(i), kFar, slope), kFar);
      return sum;
    };
    double everywhere = 0.0, visited = 0.0;
    const double off = seconds([&] {
      SurfaceField lattice(surface.vertices, surface.triangles);
      visit_all(lattice, surface);
      everywhere = visit(lattice);
    });
    const double on = seconds([&] {
      SurfaceField lattice(surface.vertices, surface.triangles);
      visited = visit(lattice);
    });
    add("distance field only where cloth goes", off, on,
        "distances differ by " + fixed(std::abs(everywhere - visited) / static_cast<double>(nodes.rows()) * 1e9, 3) +
            " nm on average");
  }

  void derivation() {
    const auto& [pattern, mesh, wearer, worn, fit] = result().reference;
    const auto plane = mirror_plane_of(options_, pattern);
    const auto mirrors = plane ? find_garment_mirrors(pattern, mesh, worn.drape, *plane) : GarmentMirrors{};
    DeriveInLoopOptions all_passes = loop_options_of(options_), usual = all_passes;
    all_passes.good_enough = all_passes.least_gain = 0.0;
    DerivedPattern long_way, short_way;
    const auto derive = [&](const DeriveInLoopOptions& loop) {
      DrapeSeries on_target(result().target_body);
      return derive_in_loop(pattern, mesh, fit, on_target, result().transported.drape, mirrors,
                            derive_options_of(options_), drape_options_, loop);
    };
    const double off = seconds([&] { long_way = derive(all_passes); });
    const double on = seconds([&] { short_way = derive(usual); });
    add("derivation ends when a pass gains little", off, on,
        "rms stretch error " + fixed(100 * long_way.rms_stretch_error, 3) + " -> " +
            fixed(100 * short_way.rms_stretch_error, 3) + " %");
  }

  test::Scene scene_;
  int repeats_;
  AlterOptions options_;
  DrapeOptions drape_options_;
  std::unique_ptr<StageCache> stages_ = stage_store({});
  JobRun job_;
  Table table_{{"saving", "off CPU s", "on CPU s", "saved %", "difference"}};
};

}  // namespace

int bench_skip(const Arguments& arguments) {
  Words words(arguments.words);
  const int triangles = words.integer("--triangles").value_or(4000);
  const std::string scene = words.rest().empty() ? "leggings_tight" : words.rest().back();
  return SkipBench(scene, triangles, arguments.repeats).run(arguments.csv);
}

}  // namespace toile::bench
