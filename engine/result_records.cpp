// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/result_records.h"

#include "engine/core/units.h"

namespace toile {
namespace {

Record percentiles(const StrainPercentiles& strain) {
  return Record().add("p50", strain.p50).add("p99", strain.p99);
}

Record difference_record(const FitDifference& difference) {
  return Record()
      .add("rms_stretch", difference.rms_stretch)
      .add("rms_weft", difference.rms_weft)
      .add("rms_warp", difference.rms_warp)
      .add("rms_shear_deg", difference.rms_shear * kDegreePerRadian)
      .add("mean_weft", difference.mean_weft)
      .add("mean_warp", difference.mean_warp)
      .add("area_share_beyond_3_percent", difference.share_beyond)
      .add("area_cm2", difference.area * kCmPerMetre * kCmPerMetre);
}

}  // namespace

Record quality_record(const DrapeQuality& q) {
  Record record;
  record.add("rest", std::string(rest_name(q.rest)))
      .add("residual_node_weights", q.residual)
      .add("settling_move_mm", q.settling_move * kMmPerMetre)
      .add("weft_strain", percentiles(q.weft))
      .add("warp_strain", percentiles(q.warp))
      .add("shear_deg", Record().add("p50", q.shear.p50 * kDegreePerRadian).add("p99", q.shear.p99 * kDegreePerRadian))
      .add("deepest_node_mm", q.deepest_node * kMmPerMetre)
      .add("nodes_deeper_than_1_mm", q.nodes_inside)
      .add("deepest_edge_midpoint_mm", q.deepest_edge * kMmPerMetre)
      .add("edge_midpoints_deeper_than_3_mm", q.edges_inside)
      .add("crossing_pairs", q.crossing_pairs)
      .add("crossing_triangle_share", q.crossing_share)
      .add("seam_gap_mm", q.seam_gap * kMmPerMetre);
  return record;
}

Record drape_record(const DrapeResult& result) {
  const DrapeDiagnostics& d = result.diagnostics;
  Record record;
  record.add("quality", quality_record(result.quality))
      .add("sewing_iterations", d.sewing_iterations)
      .add("iterations", d.iterations)
      .add("energy_evaluations", d.evaluations)
      .add("energy_j", d.energy)
      .add("stalled", d.stalled)
      .add("rung", d.rung);
  std::vector<Record> findings;
  for (const DrapeFinding& finding : d.findings)
    findings.push_back(
        Record().add("name", finding.name).add("message", finding.message).add("refused", finding.refused));
  record.add("findings", std::move(findings));
  return record;
}

Record fit_record(const Pattern& pattern, const FitComparison& comparison) {
  std::vector<Record> panels;
  for (std::size_t p = 0; p < comparison.panels.size(); ++p) {
    Record panel;
    panel.add("panel", pattern.panels[p].name).add("difference", difference_record(comparison.panels[p]));
    panels.push_back(std::move(panel));
  }
  std::vector<Record> zones;
  for (std::size_t z = 0; z < comparison.zones.size(); ++z) {
    if (comparison.zones[z].area <= 0.0) continue;
    Record zone;
    zone.add("zone", std::string(zone_name(static_cast<BodyZone>(z))));
    zones.push_back(std::move(zone.add("difference", difference_record(comparison.zones[z]))));
  }
  Record record;
  record.add("whole", difference_record(comparison.whole))
      .add("panels", std::move(panels))
      .add("zones", std::move(zones))
      .add("degenerate_triangles", comparison.degenerate_triangles);
  return record;
}

namespace {

// What the energy was after every sweep, as parallel rows.
Record sweeps_record(const std::vector<DeriveSweep>& sweeps) {
  std::vector<double> weight, energy, fit, seam;
  for (const DeriveSweep& sweep : sweeps) {
    weight.push_back(sweep.edge_weight);
    energy.push_back(sweep.energy);
    fit.push_back(sweep.fit_residual);
    seam.push_back(sweep.seam_residual * kMmPerMetre);
  }
  return Record()
      .add("edge_weight", Record::Value(weight))
      .add("energy_m2", Record::Value(energy))
      .add("fit_residual", Record::Value(fit))
      .add("seam_residual_mm", Record::Value(seam));
}

}  // namespace

Record derivation_record(const DerivedPattern& derived) {
  const DerivePatternResult& d = derived.derivation;
  Record record;
  record.add("rms_stretch_error", derived.rms_stretch_error)
      .add("pass_errors", Record::Value(derived.pass_errors))
      .add("sweeps", static_cast<int>(d.sweeps.size()))
      .add("sweep_energies", sweeps_record(d.sweeps))
      .add("converged", d.converged)
      .add("fit_residual", d.fit_residual)
      .add("seam_residual_mm", d.seam_residual * kMmPerMetre)
      .add("flipped_triangles", d.flipped_triangles)
      .add("held_back_panels", static_cast<int>(derived.held_back.size()))
      .add("kept_change", derived.kept_change)
      .add("drape", drape_record(derived.drape));
  return record;
}

Record alteration_record(const AlterPatternResult& altered) {
  constexpr double kCm2 = kCmPerMetre * kCmPerMetre;
  std::vector<Record> panels;
  for (const PanelAlteration& panel : altered.panels) {
    const auto pass = [](const PanelTearing& tearing) {
      Record record;
      record.add("stretch_p98_before", tearing.before.p98).add("stretch_p98_after", tearing.after.p98);
      return record.add("tears", static_cast<int>(tearing.tears.size()))
          .add("done", tearing.done)
          .add("reason", tearing.reason);
    };
    Record record;
    record.add("panel", panel.panel)
        .add("insertions", static_cast<int>(panel.insertions.size()))
        .add("removals", static_cast<int>(panel.removals.size()))
        .add("insertion_pass", pass(panel.insertion_pass))
        .add("removal_pass", pass(panel.removal_pass));
    panels.push_back(std::move(record));
  }
  Record record;
  record.add("operations", static_cast<int>(altered.ticket.operations.size()))
      .add("original_area_cm2", altered.original_area * kCm2)
      .add("target_area_cm2", altered.target_area * kCm2)
      .add("inserted_area_cm2", altered.inserted_area * kCm2)
      .add("removed_area_cm2", altered.removed_area * kCm2)
      .add("area_imbalance", altered.area_imbalance)
      .add("planned_share", altered.planned_share)
      .add("strain_left", altered.strain_left)
      .add("insertion_rounds", altered.insertion_rounds)
      .add("removal_rounds", altered.removal_rounds)
      .add("trials", altered.trials)
      .add("reverted_tears", altered.reverted)
      .add("dropped_regions", altered.dropped_regions)
      .add("flags", Record::Value(altered.flags))
      .add("sewing_flags", Record::Value(altered.sewn.flags))
      .add("panels", std::move(panels));
  return record;
}

Record place_record(const PlacedPlans& place) {
  std::vector<Record> plans;
  for (const TriedPlan& plan : place.plans) {
    Record record;
    record.add("share_of_stretch_limit", plan.share).add("operations", plan.operations).add("faults", plan.faults);
    if (plan.problem.empty())
      record.add("triangles", plan.triangles).add("position_mm", plan.position * kMmPerMetre);
    else
      record.add("problem", plan.problem);
    plans.push_back(std::move(record));
  }
  Record record;
  record.add("in_place", place.in_place(place.kept_plan()));
  if (place.kept_plan().problem.empty()) record.add("position_mm", place.kept_plan().position * kMmPerMetre);
  record.add("ideal_mm", place.ideal * kMmPerMetre);
  if (place.meshed_anew) record.add("ideal_meshed_anew_mm", *place.meshed_anew * kMmPerMetre);
  return record.add("allowed_mm", place.allowed * kMmPerMetre)
      .add("kept_plan", place.kept)
      .add("plans", std::move(plans));
}

Record after_record(const DrapedAlteration& after) {
  Record record;
  record.add("problem", after.problem);
  if (!after.problem.empty()) return record;
  return record.add("triangles", after.mesh.triangle_count())
      .add("moved_from_target_drape_mm", Record()
                                             .add("rms", after.position.rms * kMmPerMetre)
                                             .add("p95", after.position.p95 * kMmPerMetre)
                                             .add("largest", after.position.largest * kMmPerMetre))
      .add("drape", drape_record(after.drape));
}

Record edges_record(const FitPatternEdgesResult& edges) {
  return Record()
      .add("largest_deviation_mm", edges.largest_deviation * kMmPerMetre)
      .add("largest_seam_mismatch_mm", edges.largest_seam_mismatch * kMmPerMetre)
      .add("bent_edges", edges.bent_edges)
      .add("polyline_edges", edges.polyline_edges);
}

}  // namespace toile
