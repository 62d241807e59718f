// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/draper.h"

#include <algorithm>

#include "engine/stages/arrange_panels.h"
#include "engine/stages/carry_drape.h"
#include "engine/stages/come_to_rest.h"
#include "engine/stages/find_node_mirror.h"

namespace toile {
namespace {

constexpr double kMoreLift = 0.03;  // m
constexpr SewingStage kFirmStage{10000, 1.0, 40};

constexpr double kHalfDeep = 5e-4;  // m: a half with nodes deeper inside the body is no rest
constexpr double kPinShare = 50;    // stiffness of a pin over that of contact: 1 N/m of tension moves it by 0.2 mm

}  // namespace

Draper::Draper(const Pattern& pattern, const PatternMesh& mesh, PreparedBody& body, const DrapeOptions& options,
               Progress* progress)
    : pattern_(pattern),
      mesh_(mesh),
      prepared_(body),
      body_(body.body()),
      options_(options),
      progress_(progress),
      cloth_(make_cloth(pattern, mesh)) {
  thickness_ = options.thickness + cloth_.mean_edge * cloth_.mean_edge / (8 * options.sag_radius);
}

void Draper::from_flat() {
  prepare(placed_vertices(pattern_, mesh_));
  for (int rung = options_.first_rung;; ++rung) {
    attempt_from_flat(rung);
    const DrapeFinding* refused = refusal();
    if (!refused) return;
    if (rung == kLastRung)
      throw Error(ErrorCode::DrapeFailed, "garment",
                  "no acceptable drape on this body: " + refused->message +
                      "; check that the garment is placed round a body of this size and that its seams are right");
  }
}

bool Draper::from_coarser(const Draper& coarse) {
  const DrapeEnd start = carry_drape(pattern_, coarse.mesh_, {coarse.result_.drape, coarse.end_}, mesh_);
  prepare(placed_vertices(pattern_, mesh_));
  const DrapeDiagnostics& before = coarse.result_.diagnostics;
  result_.diagnostics.rung = before.rung;
  result_.diagnostics.upper_shift = before.upper_shift;
  result_.diagnostics.sewing_iterations = before.sewing_iterations;
  Points3 nodes = start.drape.nodes;
  make_symmetric(nodes);
  start_ = &start.held;
  rested_ = true;
  if (!result_.diagnostics.bodice) hold_waist(nodes);
  finish(nodes);
  start_ = nullptr;
  return refusal() == nullptr;
}

DrapeResult Draper::from_start(Points3 start) {
  Points3 vertices(mesh_.vertex_count(), 3);
  for (int v = 0; v < mesh_.vertex_count(); ++v)
    vertices.row(v) = start.row(mesh_.node_of_vertex[static_cast<std::size_t>(v)]);
  worn_ = rested_ = true;
  prepare(vertices);
  if (!options_.keep_drape) make_symmetric(start);
  if (!result_.diagnostics.bodice) hold_waist(start);
  if (options_.pin_openings)
    for (const std::vector<int>& line : free_lines(pattern_, mesh_)) pin(line, start);
  if (!options_.keep_drape && tangled(start))
    finish(smoothed(start, SewingOptions()));
  else
    finish(start);
  for (const DrapeFinding& finding : result_.diagnostics.findings)
    if (finding.name == "not_finite") throw Error(ErrorCode::DrapeFailed, "garment", finding.message);
  return result_;
}

void Draper::prepare(const Points3& vertices) {
  if (body_.skeleton) {
    guides_ = prepared_.guides();
    const BodyGuides& placed_round = worn_ ? guides_ : options_.drafted_for ? *options_.drafted_for : guides_;
    levels_ = placed_round.levels;
    garment_ = classify_panels(pattern_, mesh_, vertices, placed_round);
    result_.diagnostics.bodice = garment_.bodice;
  }
  field_ = &prepared_.field(body_.skeleton && !garment_.bodice);
}

const DrapeFinding* Draper::refusal() const {
  const std::vector<DrapeFinding>& findings = result_.diagnostics.findings;
  const auto refused = std::find_if(findings.begin(), findings.end(), [](const auto& f) { return f.refused; });
  return refused == findings.end() ? nullptr : &*refused;
}

void Draper::attempt_from_flat(int rung) {
  report(progress_, "sew", 0);
  result_.diagnostics.rung = rung;
  result_.diagnostics.iterations = result_.diagnostics.evaluations = 0;
  SewingOptions sewing;
  if (rung == 1) sewing.stages.insert(sewing.stages.begin(), kFirmStage);
  const Points3 start = body_.skeleton ? arranged(rung == 1 ? options_.lift + kMoreLift : options_.lift)
                                       : welded(mesh_, placed_vertices(pattern_, mesh_));
  holds_.clear();
  pins_.clear();
  if (!result_.diagnostics.bodice) hold_waist(start);
  find_mirror(start);
  Points3 sewn = smoothed(start, sewing);
  if (mirror_ && !part_sides(*mirror_, sewn)) {
    mirror_.reset(), half_.reset();
    sewn = smoothed(start, sewing);
  }
  finish(sewn);
}

void Draper::find_mirror(const Points3& start) {
  mirror_ = find_node_mirror(pattern_, mesh_, cloth_, body_.surface.vertices, start);
  if (mirror_ && !pinned_alike(*mirror_)) mirror_.reset();
  half_.reset();
  if (mirror_ && options_.halve && options_.solver == SolverKind::Default && !hold_friction_)
    half_ = half_of(cloth_, *mirror_, start);
}

void Draper::make_symmetric(Points3& start) {
  find_mirror(start);
  if (!mirror_) return;
  Points3 symmetric = start;
  symmetrise(*mirror_, symmetric);
  if (part_sides(*mirror_, symmetric))
    start = symmetric;
  else
    mirror_.reset(), half_.reset();
}

bool Draper::pinned_alike(const NodeMirror& mirror) const {
  const std::vector<int> nodes = pinned_nodes();
  return std::all_of(nodes.begin(), nodes.end(), [&](int n) {
    return std::find(nodes.begin(), nodes.end(), mirror.image[static_cast<std::size_t>(n)]) != nodes.end();
  });
}

Points3 Draper::smoothed(Points3 start, const SewingOptions& options) {
  if (mirror_) symmetrise(*mirror_, start);
  DrapeEnergy energy(half_ ? half_->cloth : cloth_, nullptr, 0.0);
  energy.holds = half_ ? half_->folded(holds_) : holds_;
  energy.half = half_ ? &*half_ : nullptr;
  energy.mirror = mirror_ && !half_ ? &*mirror_ : nullptr;
  const SewingResult sewn = sew(energy, *field_, thickness_, start, options, progress_);
  result_.diagnostics.sewing_iterations = sewn.iterations;
  return sewn.nodes;
}

bool Draper::tangled(const Points3& start) const {
  ClothContact layers(cloth_, mesh_, ClothContactOptions{});
  layers.refresh(start);
  return layers.tangle() > ClothContact::kTangled;
}

Points3 Draper::arranged(double lift) {
  ArrangeOptions options;
  options.lift = lift;
  options.thickness = thickness_;
  const ArrangeResult arrangement = arrange_panels(pattern_, mesh_, garment_, guides_, levels_, *field_, options);
  result_.diagnostics.upper_shift = arrangement.upper_shift;
  return arrangement.nodes;
}

void Draper::hold_waist(const Points3& start) {
  waist_ = waist_nodes(pattern_, mesh_, placed_vertices(pattern_, mesh_));
  const std::vector<int>& nodes = waist_;
  double height = 0;
  for (int n : nodes) height += start(n, 1) / static_cast<double>(nodes.size());
  if (start_) height = start_->hold_height;
  for (int n : nodes) holds_.push_back({n, height, options_.contact_stiffness * cloth_.node_area[n]});
  result_.diagnostics.hold_height = height;
}

void Draper::pin(const std::vector<int>& nodes, const Points3& start) {
  for (int n : nodes) pins_.push_back({n, start.row(n), kPinShare * options_.contact_stiffness * cloth_.node_area[n]});
}

std::vector<int> Draper::pinned_nodes() const {
  std::vector<int> nodes;
  for (const SeamSide& side : pattern_.pins)
    for (int v : mesh_.edge_vertices[static_cast<std::size_t>(side.panel.value)][static_cast<std::size_t>(side.edge)])
      nodes.push_back(mesh_.node_of_vertex[static_cast<std::size_t>(v)]);
  return nodes;
}

void Draper::finish(const Points3& start) {
  pin(pinned_nodes(), start);
  if (options_.keep_drape)
    result_.drape.nodes = start, result_.quality.rest = Rest::AsGiven;
  else
    rest_from(start);
  measure();
  if (half_ && !rests_well() && !result_.diagnostics.tangled) half_.reset(), rest_from(start), measure();
  GuardScene scene{mesh_, nullptr, nullptr, waist_, result_.diagnostics.hold_height, result_.diagnostics.tangled};
  if (body_.skeleton) scene.garment = &garment_, scene.guides = &guides_;
  result_.diagnostics.findings = check_drape(scene, result_.drape, result_.quality);
  report(progress_, "drape", 1);
}

void Draper::measure() {
  const DrapeQuality solved = result_.quality;
  if (result_.drape.nodes.allFinite()) result_.quality = measure_drape(mesh_, field_->tree(), result_.drape);
  result_.quality.rest = solved.rest;
  result_.quality.residual = solved.residual;
  result_.quality.settling_move = solved.settling_move;
}

bool Draper::rests_well() const {
  return result_.quality.rest != Rest::NotAtRest && result_.drape.nodes.allFinite() &&
         result_.quality.deepest_node < kHalfDeep;
}

void Draper::rest_from(const Points3& start) {
  const GarmentOnBody garment{.mesh = mesh_,
                              .cloth = cloth_,
                              .field = *field_,
                              .thickness = thickness_,
                              .holds = holds_,
                              .pins = pins_,
                              .mirror = mirror_ ? &*mirror_ : nullptr,
                              .half = half_ ? &*half_ : nullptr,
                              .watched = free_lines(pattern_, mesh_),
                              .worn = rested_,
                              .friction = start_ ? &start_->friction : nullptr,
                              .hold_friction = hold_friction_};
  end_ = {come_to_rest(garment, start, options_, result_, progress_), result_.diagnostics.hold_height};
}

}  // namespace toile
