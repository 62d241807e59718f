// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter_in_loop.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace toile {
namespace {

constexpr double kFiner = 1.5;  // times the triangles a plan is tried on with: from there on with that many
const double kUsualStretch = AlterPatternOptions().stretch_limit;
constexpr double kMeshes[] = {0.95, 1.0, 1.05};  // times the edge length, that the target pattern is meshed with
constexpr double kStricter = 0.7;   // of the share before or of the strain that was left, whichever is less
constexpr double kStrictest = 0.1;  // of the allowed stretch: cloth that keeps less is not what is off its place

double check_edge_length(const PatternMesh& original, int triangles) {
  const double finer = static_cast<double>(original.triangle_count()) / triangles;
  return original.target_edge_length * (finer > kFiner ? std::sqrt(finer) : 1.0);
}

// What of two plans is better is less.
std::tuple<int, int, double> rank(const PlacedPlans& place, const TriedPlan& plan) {
  return {plan.faults + (place.in_place(plan) ? 0 : 1), plan.operations, plan.position};
}

}  // namespace

std::optional<double> position_meshed_anew(const AlterationScene& scene, const Pattern& target, double edge_length,
                                           DrapeSeries& on_target, const DrapeOptions& options, Progress* progress) {
  const SewnPattern whole = uncut(target, scene.target);
  double sum = 0.0;
  int worn = 0;
  for (const double coarser : kMeshes) {
    const TriedOn tried = try_on(scene, whole, coarser * edge_length, on_target, options, progress);
    if (!tried.problem.empty()) continue;
    sum += tried.position.rms;
    ++worn;
  }
  return worn > 0 ? std::optional(sum / worn) : std::nullopt;
}

AlterInLoopResult alter_in_loop(const Pattern& pattern, const AlterationScene& scene, const DerivedPattern& target,
                                DrapeSeries& on_target, const AlterPatternOptions& alter_options,
                                const DrapeOptions& drape_options, const AlterInLoopOptions& options,
                                Progress* progress, bool at_once) {
  const auto allowed_at = [&](double ideal) {
    return options.share_of_ideal * ideal +
           options.farther_off * std::max(1.0, alter_options.stretch_limit / kUsualStretch);
  };
  const double edge_length = check_edge_length(scene.original, options.check_triangles);
  AlterInLoopResult result;
  PlacedPlans& place = result.place;
  place.ideal = compare_positions(scene.start.nodes, target.drape.drape.nodes).rms;
  const double near = allowed_at(place.ideal);
  place.allowed = near;
  const bool rests = target.drape.quality.rest != Rest::NotAtRest;
  AlterPatternOptions planned = alter_options;
  PlanMemory memory;
  while (static_cast<int>(place.plans.size()) < options.max_plans) {
    AlterPatternResult altered =
        alter_pattern(pattern, scene.original, scene.target.rest, planned, progress, at_once, memory);
    TriedOn worn = try_on(scene, altered.sewn, edge_length, on_target, drape_options, progress);
    const TriedPlan plan{altered.planned_share,
                         static_cast<int>(altered.ticket.operations.size()),
                         static_cast<int>(faults_of(altered)),
                         worn.problem,
                         worn.mesh.triangle_count(),
                         worn.position.rms};
    if (rests && place.plans.empty() && !place.in_place(plan)) {
      place.meshed_anew =
          position_meshed_anew(scene, target.drawn.pattern, edge_length, on_target, drape_options, progress);
      place.allowed = std::max(place.allowed, allowed_at(place.meshed_anew.value_or(0.0)));
    }
    planned.planned_share = kStricter * std::min(altered.planned_share, altered.strain_left);
    place.plans.push_back(plan);
    if (place.plans.size() == 1 || rank(place, plan) < rank(place, place.kept_plan())) {
      place.kept = static_cast<int>(place.plans.size()) - 1;
      result.altered = std::move(altered);
      result.worn = edge_length == scene.original.target_edge_length ? std::move(worn) : TriedOn{};
    }
    if (!rests || (place.in_place(plan) && plan.position <= near) || planned.planned_share < kStrictest) break;
  }
  return result;
}

}  // namespace toile
