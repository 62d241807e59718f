// SPDX-License-Identifier: GPL-3.0-or-later
// `derive growth`: time of the derivation without its drapes against resolution; `derive sweeps`: pictures of it.
#include <algorithm>
#include <cstdio>

#include "engine/draw_target.h"
#include "engine/stage_options.h"
#include "tests/bench/derive.h"

namespace toile::bench {

int derive_growth(const DeriveRequest& request, const Arguments& arguments) {
  const auto stages = stage_store(request.stages);
  Table table({"garment", "triangles", "derive s", "draw s", "both s", "sweeps", "fit residual %", "seam mm"});
  bool met = true;
  for (const std::string& garment : request.garments) {
    std::vector<double> sizes, times;
    for (const int triangles : {2000, 5000, 10000, 20000}) {
      AlterOptions options = request.options;
      options.triangles = triangles;
      const DerivedGarment r = derive_pair(garment, request.bodies.front(), options, stages.get());
      const auto& [pattern, mesh, body, worn, fit] = r.reference;
      const GarmentMirrors mirrors = find_garment_mirrors(pattern, mesh, worn.drape);
      DerivePatternResult derived;
      const Timing derive = time_cpu(arguments.repeats, [&, &p = pattern, &m = mesh, &f = fit] {
        derived = derive_pattern(p, m, f, r.transported.drape, mirrors);
      });
      const Timing draw = time_cpu(arguments.repeats, [&, &p = pattern, &m = mesh, &f = fit] {
        draw_target(p, m, f, r.transported.drape, derived.rest, mirrors, {}, nullptr);
      });
      const double both = derive.median + draw.median;
      sizes.push_back(mesh.triangle_count());
      times.push_back(both);
      if (triangles == 10000) met = met && both <= 0.6;
      table.add({garment, std::to_string(mesh.triangle_count()), fixed(derive.median, 3), fixed(draw.median, 3),
                 fixed(both, 3), std::to_string(derived.sweeps.size()), fixed(100 * derived.fit_residual, 3),
                 fixed(1e3 * derived.seam_residual, 4)});
    }
    const double exponent = growth_exponent(sizes, times);
    met = met && exponent <= 1.2;
    table.add({garment, "growth", "n^" + fixed(exponent, 2)});
  }
  table.print(arguments.csv);
  std::printf("0.6 s at 10,000 triangles and growth below n^1.2: %s\n", met ? "met" : "NOT met");
  return met ? 0 : 1;
}

int derive_sweeps(const DeriveRequest& request) {
  const auto stages = stage_store(request.stages);
  const std::string folder = request.pictures.empty() ? "." : request.pictures;
  for (const std::string& garment : request.garments)
    for (const std::string& name : request.bodies) {
      const DerivedGarment r = derive_pair(garment, name, request.options, stages.get());
      const auto& [pattern, mesh, body, worn, fit] = r.reference;
      const GarmentMirrors mirrors = find_garment_mirrors(pattern, mesh, worn.drape);
      FitPatternEdgesOptions as_they_are;
      as_they_are.keep_straight = as_they_are.keep_seam_ratios = as_they_are.smooth_corners = false;
      as_they_are.cubic_tolerance = as_they_are.tolerance;
      for (const int sweeps : {1, 5, 40, 220}) {
        DerivePatternOptions options = derive_options_of(request.options);
        options.max_sweeps = sweeps;
        const DerivePatternResult derived = derive_pattern(pattern, mesh, fit, r.transported.drape, mirrors, options);
        const Pattern drawn = fit_pattern_edges(pattern, mesh, derived.rest, {}, as_they_are).pattern;
        write_changes(folder, garment + "_" + name + "_sweep_" + std::to_string(derived.sweeps.size()), pattern, drawn);
        const DeriveSweep& last = derived.sweeps.back();
        std::printf("%s -> %s, sweep %zu: weight %g, fit residual %.3f %%, seams %.4f mm\n", garment.c_str(),
                    name.c_str(), derived.sweeps.size(), last.edge_weight, 100 * last.fit_residual,
                    1e3 * last.seam_residual);
      }
    }
  return 0;
}

}  // namespace toile::bench
