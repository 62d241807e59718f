// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/pipeline.h"

#include <algorithm>

#include "engine/archive_stages.h"
#include "engine/bodies/registered_skin.h"
#include "engine/stage_options.h"

namespace toile {

namespace {

Keyed<Pattern> take_in(const GarmentInput& garment, StageRunner& runner) {
  return runner.run("import_pattern", 1, input_key(garment), [&] { return read_garment(garment); });
}

Keyed<Body> take_in(const BodyInput& body, StageRunner& runner) {
  return runner.run("import_body", 10, input_key(body), [&] { return read_body(body); });
}

Keyed<DrapedGarment> drape_on(const GarmentInput& garment, const Keyed<Pattern>& pattern, const Keyed<Body>& wearer,
                              const AlterOptions& options, StageRunner& runner) {
  const MeshPanelsOptions mesh_options = mesh_options_of(options);
  const DrapeOptions drape_options = drape_options_of(options);
  const auto mesh = runner.run("mesh_panels", 3, key_of(pattern.key, mesh_options), [&] {
    if (auto given = read_garment_mesh(garment)) return std::move(*given);
    return mesh_panels(pattern.value, mesh_options, runner.progress());
  });
  const auto worn = runner.run("drape", 26, key_of(pattern.key, mesh.key, wearer.key, drape_options), [&] {
    const auto given = read_garment_drape(garment, wearer.value);
    if (!given) return drape(pattern.value, mesh.value, wearer.value, drape_options, runner.progress());
    DrapeOptions from_given = drape_options;
    from_given.keep_drape = garment.keep_drape || !garment.worn.empty();
    return drape_from(pattern.value, mesh.value, wearer.value, *given, from_given, runner.progress());
  });
  auto wanted = read_garment_fit(garment);
  FittingMap fit = wanted ? std::move(*wanted) : build_fitting_map(mesh.value, worn.value.drape);
  return {{pattern.value, mesh.value, wearer.value, worn.value, std::move(fit)}, worn.key};
}

bool wants_any(const AlterOptions& options, std::initializer_list<std::string_view> files) {
  return std::any_of(files.begin(), files.end(), [&](std::string_view name) {
    return std::find(options.outputs.begin(), options.outputs.end(), name) != options.outputs.end();
  });
}

// A derived garment, and the target body as it was prepared for draping.
struct DerivedOnBody {
  Keyed<DerivedGarment> garment;
  std::unique_ptr<DrapeSeries> on_target;
};

DerivedOnBody derive_on_body(const GarmentInput& garment, const BodyInput& reference_body, const BodyInput& target_body,
                             const AlterOptions& options, StageRunner& runner) {
  const DrapeOptions drape_options = drape_options_of(options);
  const DerivePatternOptions derive_options = derive_options_of(options);
  const DeriveInLoopOptions loop_options = loop_options_of(options);

  auto [original, imported] = runner.run_both(
      [&](StageRunner& part) {
        auto taken_in = take_in(garment, part);
        return std::pair(std::move(taken_in), take_in(reference_body, part));
      },
      [&](StageRunner& part) {
        return part.run("import_target_body", 11, input_key(target_body),
                        [&] { return read_target_body(target_body); });
      });
  Body target = imported.value.body;
  auto [reference, found] = runner.run_both(
      [&](StageRunner& part) { return drape_on(garment, original.first, original.second, options, part); },
      [&](StageRunner& part) {
        return part.run("register_bodies", 15, key_of(input_key(reference_body), imported.key), [&] {
          const Landmarks given = given_landmarks(target_body, target.normalised_from_file);
          require_known(target_body, given, original.second.value);
          return register_bodies(original.second.value, imported.value.seen(), {.target_landmarks = given},
                                 part.progress());
        });
      });
  const auto& [pattern, mesh, wearer, worn, fit] = reference.value;
  RegisterBodiesResult registered = found.value;
  if (imported.value.patch_triangles > 0) stand_on_soles(target, registered);
  registered.diagnostics.add("draped_on_skin",
                             take_registered_skin(target, wearer.surface, registered, !target_body.landmarks.empty()));
  const auto transported = runner.run("transport_garment", 6, key_of(reference.key, found.key), [&] {
    return transport_garment(mesh, worn.drape, wearer, target, registered.map, {}, runner.progress());
  });
  auto on_target = std::make_unique<DrapeSeries>(target);
  const auto plane = mirror_plane_of(options, pattern);
  auto [before, derived] = runner.run_both(
      [&](StageRunner& part) -> std::optional<DrapeResult> {
        if (!wants_before(options)) return part.skip("drape_before"), std::nullopt;
        return part
            .run("drape_before", 23, key_of(transported.key, drape_options),
                 [&] {
                   DrapeSeries beside(target);
                   return (part.at_once() ? beside : *on_target)
                       .drape_from(pattern, mesh, transported.value.drape, drape_options, part.progress());
                 })
            .value;
      },
      [&](StageRunner& part) {
        return part.run("derive_pattern", 30, key_of(transported.key, derive_options, loop_options, plane), [&] {
          const auto mirrors = plane ? find_garment_mirrors(pattern, mesh, worn.drape, *plane) : GarmentMirrors{};
          DeriveInLoopOptions passes = loop_options;
          if (worn.quality.rest == Rest::NotAtRest) passes.max_passes = 1;  // its fit is worth no second one
          return derive_in_loop(pattern, mesh, fit, *on_target, transported.value.drape, mirrors, derive_options,
                                drape_options, passes, part.progress());
        });
      });

  FittingMap fit_before = before ? build_fitting_map(mesh, before->drape) : FittingMap();
  return {{{std::move(reference.value), target, registered, transported.value, std::move(before), std::move(fit_before),
            derived.value},
           derived.key},
          std::move(on_target)};
}

}  // namespace

Keyed<DrapedGarment> drape_garment(const GarmentInput& garment, const BodyInput& body, const AlterOptions& options,
                                   StageRunner& runner) {
  const auto pattern = take_in(garment, runner);
  return drape_on(garment, pattern, take_in(body, runner), options, runner);
}

bool wants_after(const AlterOptions& options) {
  return wants_any(options, {"all", "target_after.obj", "fit_after.png", "report.html"});
}

// Pictures share a frame in which this drape has its place, too.
bool wants_before(const AlterOptions& options) {
  return wants_any(options, {"all", "result.json", "target_before.obj", "fit_reference.png", "fit_before.png",
                             "fit_target.png", "fit_after.png", "transport.png", "report.html"});
}

Keyed<DerivedGarment> derive_garment(const GarmentInput& garment, const BodyInput& reference_body,
                                     const BodyInput& target_body, const AlterOptions& options, StageRunner& runner) {
  return derive_on_body(garment, reference_body, target_body, options, runner).garment;
}

AlterResult alter_garment(const GarmentInput& garment, const BodyInput& reference_body, const BodyInput& target_body,
                          const AlterOptions& options, StageRunner& runner) {
  const AlterPatternOptions alter_options = alter_options_of(options);
  const DrapeOptions drape_options = drape_options_of(options);
  const AlterInLoopOptions plan_options = plan_options_of(options);
  DerivedOnBody on_body = derive_on_body(garment, reference_body, target_body, options, runner);
  Keyed<DerivedGarment>& ideal = on_body.garment;
  const auto& [pattern, mesh, wearer, worn, fit] = ideal.value.reference;
  const DerivedPattern& derived = ideal.value.derived;
  const auto scene_from = [&](const Drape& start) { return AlterationScene{mesh, fit, derived.mesh, start}; };
  auto altered = runner.run("alter_pattern", 37, key_of(ideal.key, alter_options, drape_options, plan_options), [&] {
    return alter_in_loop(pattern, scene_from(ideal.value.transported.drape), derived, *on_body.on_target, alter_options,
                         drape_options, plan_options, runner.progress(), runner.at_once());
  });
  auto& [alteration, tried_on, place] = altered.value;
  if (!wants_after(options)) {
    runner.skip("drape_altered");
    return {std::move(ideal.value), std::move(alteration), std::move(place), {}};
  }
  auto after = runner.run("drape_altered", 23, key_of(altered.key, ideal.key, drape_options), [&] {
    return drape_altered(scene_from(derived.drape.drape), alteration.sewn, std::move(tried_on), *on_body.on_target,
                         drape_options, runner.progress());
  });
  return {std::move(ideal.value), std::move(alteration), std::move(place), std::move(after.value)};
}

}  // namespace toile
