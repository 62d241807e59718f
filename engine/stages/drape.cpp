// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/drape.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/sim/sewing.h"
#include "engine/stages/arrange_panels.h"
#include "engine/stages/carry_drape.h"
#include "engine/stages/come_to_rest.h"
#include "engine/stages/drape_series.h"
#include "engine/stages/find_node_mirror.h"
#include "engine/stages/mesh_panels.h"
#include "engine/stages/prepared_body.h"

namespace toile {

namespace {

// The retry ladder: 0 as designed; 1 lifted more and pushed out harder at first. Growing the body from inside the
// garment dresses none that these two do not (all garments on all bodies of ../shared/data).
constexpr int kLastRung = 1;
constexpr double kMoreLift = 0.03;  // m
constexpr SewingStage kFirmStage{10000, 1.0, 40};

constexpr double kTangledShare = 0.1;  // of piercings in the triangles: worn and transported garments have under 0.01

constexpr double kMuchFiner = 1.5;  // times the triangles of the coarse mesh are worth draping that first

constexpr double kHalfDeep = 5e-4;  // m: a half with nodes deeper inside the body is no rest
constexpr double kPinShare = 50;    // stiffness of a pin over that of contact: 1 N/m of tension moves it by 0.2 mm

void check_options(const DrapeOptions& o) {
  const auto check = [](bool good, const char* name, const char* range) {
    if (!good)
      throw Error(ErrorCode::OptionInvalid, std::string("options/drape/") + name,
                  std::string(name) + " must be " + range);
  };
  check(o.friction >= 0 && o.friction <= 2, "friction", "0 to 2");
  check(o.gravity >= 0 && o.gravity <= 100, "gravity", "0 to 100 m/s^2");
  check(o.thickness >= 0 && o.thickness <= 0.05, "thickness", "0 to 0.05 m");
  check(o.sag_radius > 0, "sag_radius", "positive");
  check(o.contact_stiffness > 0, "contact_stiffness", "positive");
  check(o.iterations >= 0 && o.iterations <= 100000, "iterations", "0 to 100000");
  check(o.stop_residual > 0, "stop_residual", "positive");
  check(o.stop_settled >= 0, "stop_settled", "0 or positive");
  check(o.fibre_slack >= 0 && o.fibre_slack <= 0.2, "fibre_slack", "0 to 0.2");
  check(o.shear_limit_deg >= 0 && o.shear_limit_deg <= 45, "shear_limit_deg", "0 to 45");
  check(o.lift >= 0 && o.lift <= 0.1, "lift", "0 to 0.1 m");
  check(o.first_rung >= 0 && o.first_rung <= kLastRung, "first_rung", "0 or 1");
  check(o.coarse_triangles == 0 || (o.coarse_triangles >= 500 && o.coarse_triangles <= 200000), "coarse_triangles",
        "0, or 500 to 200000");
}

void check_start(const PatternMesh& mesh, const Drape& start) {
  if (start.nodes.rows() != mesh.node_count || !start.nodes.allFinite())
    throw Error(ErrorCode::GarmentInvalid, "garment",
                "the given drape does not have one finite position for every node of the sewn garment");
}

class Draper {
 public:
  Draper(const Pattern& pattern, const PatternMesh& mesh, PreparedBody& body, const DrapeOptions& options,
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

  DrapeResult from_flat() {
    prepare(placed_vertices(pattern_, mesh_));
    for (int rung = options_.first_rung;; ++rung) {
      attempt_from_flat(rung);
      const DrapeFinding* refused = refusal();
      if (!refused) return result_;
      if (rung == kLastRung)
        throw Error(ErrorCode::DrapeFailed, "garment",
                    "no acceptable drape on this body: " + refused->message +
                        "; check that the garment is placed round a body of this size and that its seams are right");
    }
  }

  // From the end of the same garment from flat on a coarser mesh. False: a guard refuses the result.
  bool from_coarser(const Draper& coarse) {
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

  DrapeResult from_start(Points3 start) {
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

  void hold(const HeldDrape& held) { start_ = &held, hold_friction_ = true; }  // must outlive this
  const HeldDrape& end() const { return end_; }
  const DrapeResult& result() const { return result_; }

 private:
  // Which panel dresses what, told by `vertices` (#V x 3), and the field that suits.
  void prepare(const Points3& vertices) {
    if (body_.skeleton) {
      guides_ = prepared_.guides();
      const BodyGuides& placed_round = worn_ ? guides_ : options_.drafted_for ? *options_.drafted_for : guides_;
      levels_ = placed_round.levels;
      garment_ = classify_panels(pattern_, mesh_, vertices, placed_round);
      result_.diagnostics.bodice = garment_.bodice;
    }
    field_ = &prepared_.field(body_.skeleton && !garment_.bodice);
  }

  const DrapeFinding* refusal() const {
    const std::vector<DrapeFinding>& findings = result_.diagnostics.findings;
    const auto refused = std::find_if(findings.begin(), findings.end(), [](const auto& f) { return f.refused; });
    return refused == findings.end() ? nullptr : &*refused;
  }

  void attempt_from_flat(int rung) {
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

  // Where all is the same on both sides, the drape is sought among symmetric ones.
  void find_mirror(const Points3& start) {
    mirror_ = find_node_mirror(pattern_, mesh_, cloth_, body_.surface.vertices, start);
    if (mirror_ && !pinned_alike(*mirror_)) mirror_.reset();
    half_.reset();
    if (mirror_ && options_.halve && options_.solver == SolverKind::Default && !hold_friction_)
      half_ = half_of(cloth_, *mirror_, start);
  }

  void make_symmetric(Points3& start) {
    find_mirror(start);
    if (!mirror_) return;
    Points3 symmetric = start;
    symmetrise(*mirror_, symmetric);
    if (part_sides(*mirror_, symmetric))
      start = symmetric;
    else
      mirror_.reset(), half_.reset();
  }

  bool pinned_alike(const NodeMirror& mirror) const {
    const std::vector<int> nodes = pinned_nodes();
    return std::all_of(nodes.begin(), nodes.end(), [&](int n) {
      return std::find(nodes.begin(), nodes.end(), mirror.image[static_cast<std::size_t>(n)]) != nodes.end();
    });
  }

  // Without gravity, friction and contact between layers.
  Points3 smoothed(Points3 start, const SewingOptions& options) {
    if (mirror_) symmetrise(*mirror_, start);
    DrapeEnergy energy(half_ ? half_->cloth : cloth_, nullptr, 0.0);
    energy.holds = half_ ? half_->folded(holds_) : holds_;
    energy.half = half_ ? &*half_ : nullptr;
    energy.mirror = mirror_ && !half_ ? &*mirror_ : nullptr;
    const SewingResult sewn = sew(energy, *field_, thickness_, start, options, progress_);
    result_.diagnostics.sewing_iterations = sewn.iterations;
    return sewn.nodes;
  }

  // Crossing itself all over: contact between layers would hold such knots instead of undoing them.
  bool tangled(const Points3& start) const {
    ClothContact layers(cloth_, mesh_, ClothContactOptions{});
    layers.refresh(start);
    return layers.piercings() > kTangledShare * cloth_.triangle_count;
  }

  Points3 arranged(double lift) {
    ArrangeOptions options;
    options.lift = lift;
    options.thickness = thickness_;
    const ArrangeResult arrangement = arrange_panels(pattern_, mesh_, garment_, guides_, levels_, *field_, options);
    result_.diagnostics.upper_shift = arrangement.upper_shift;
    return arrangement.nodes;
  }

  // The waist line may not sink below the mean height it has at the start.
  void hold_waist(const Points3& start) {
    waist_ = waist_nodes(pattern_, mesh_, placed_vertices(pattern_, mesh_));
    const std::vector<int>& nodes = waist_;
    double height = 0;
    for (int n : nodes) height += start(n, 1) / static_cast<double>(nodes.size());
    if (start_) height = start_->hold_height;
    for (int n : nodes) holds_.push_back({n, height, options_.contact_stiffness * cloth_.node_area[n]});
    result_.diagnostics.hold_height = height;
  }

  void pin(const std::vector<int>& nodes, const Points3& start) {
    for (int n : nodes)
      pins_.push_back({n, start.row(n), kPinShare * options_.contact_stiffness * cloth_.node_area[n]});
  }

  // Of the pattern's own pins.
  std::vector<int> pinned_nodes() const {
    std::vector<int> nodes;
    for (const SeamSide& side : pattern_.pins)
      for (int v : mesh_.edge_vertices[static_cast<std::size_t>(side.panel.value)][static_cast<std::size_t>(side.edge)])
        nodes.push_back(mesh_.node_of_vertex[static_cast<std::size_t>(v)]);
    return nodes;
  }

  void finish(const Points3& start) {
    pin(pinned_nodes(), start);
    if (options_.keep_drape)
      result_.drape.nodes = start, result_.quality.rest = Rest::AsGiven;
    else
      rest_from(start);
    measure();
    if (half_ && !rests_well()) half_.reset(), rest_from(start), measure();
    GuardScene scene{mesh_, nullptr, nullptr, waist_, result_.diagnostics.hold_height};
    if (body_.skeleton) scene.garment = &garment_, scene.guides = &guides_;
    result_.diagnostics.findings = check_drape(scene, result_.drape, result_.quality);
    report(progress_, "drape", 1);
  }

  void measure() {
    const DrapeQuality solved = result_.quality;
    if (result_.drape.nodes.allFinite()) result_.quality = measure_drape(mesh_, field_->tree(), result_.drape);
    result_.quality.rest = solved.rest;
    result_.quality.residual = solved.residual;
    result_.quality.settling_move = solved.settling_move;
  }

  // Half a garment may catch in folds or on toes alike on both sides, where the whole frees itself.
  bool rests_well() const {
    return result_.quality.rest != Rest::NotAtRest && result_.drape.nodes.allFinite() &&
           result_.quality.deepest_node < kHalfDeep;
  }

  void rest_from(const Points3& start) {
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

  const Pattern& pattern_;
  const PatternMesh& mesh_;
  PreparedBody& prepared_;
  const Body& body_;
  const DrapeOptions& options_;
  Progress* progress_;
  Cloth cloth_;
  BodyGuides guides_;
  BodyLevels levels_;
  GarmentClass garment_;
  SurfaceField* field_ = nullptr;
  double thickness_ = 0;
  std::vector<int> waist_;
  std::vector<Hold> holds_;
  std::vector<Pin> pins_;
  std::optional<NodeMirror> mirror_;  // where body and garment are the same on both sides
  std::optional<HalfCloth> half_;     // which then moves alone
  const HeldDrape* start_ = nullptr;  // of the start; null: from flat, or none is known
  bool hold_friction_ = false;        // that of the start for good, instead of frozen anew in rounds
  HeldDrape end_;
  bool worn_ = false;    // the garment is judged where it hangs on this body, not where it was placed
  bool rested_ = false;  // it starts from a rest
  DrapeResult result_;
};

// Whether a coarse drape first makes a difference: without friction there is one way to rest only.
bool begins_coarse(const PatternMesh& mesh, const DrapeOptions& options) {
  return options.coarse_triangles > 0 && mesh.triangle_count() > kMuchFiner * options.coarse_triangles &&
         options.friction > 0 && options.solver != SolverKind::Pbd;
}

// The same coarse drape for every fine mesh, whatever is asked of that.
DrapeOptions coarse_options(const DrapeOptions& options) {
  DrapeOptions coarse = options;
  coarse.solver = SolverKind::Default;
  coarse.stop_residual = DrapeOptions().stop_residual;
  coarse.stop_settled = DrapeOptions().stop_settled;
  return coarse;
}

bool drape_from_coarse(Draper& draper, const Pattern& pattern, PreparedBody& body, const DrapeOptions& given,
                       const Progress* progress) {
  report(progress, "sew", 0);
  Progress quiet;
  if (progress) quiet.cancelled = progress->cancelled;
  const DrapeOptions options = coarse_options(given);
  const PatternMesh mesh = mesh_panels(pattern, {.triangles = options.coarse_triangles}, &quiet);
  Draper coarse(pattern, mesh, body, options, &quiet);
  coarse.from_flat();
  return draper.from_coarser(coarse);
}

DrapeResult drape_whole(const Pattern& pattern, const PatternMesh& mesh, const Body& given, const DrapeOptions& options,
                        HeldDrape* end, Progress* progress) {
  check_options(options);
  PreparedBody body(given);
  auto draper = std::make_unique<Draper>(pattern, mesh, body, options, progress);
  if (!begins_coarse(mesh, options) || !drape_from_coarse(*draper, pattern, body, options, progress)) {
    draper = std::make_unique<Draper>(pattern, mesh, body, options, progress);
    draper->from_flat();
  }
  if (end) *end = draper->end();
  return draper->result();
}

}  // namespace

DrapeResult drape(const Pattern& pattern, const PatternMesh& mesh, const Body& body, const DrapeOptions& options,
                  Progress* progress) {
  return drape_whole(pattern, mesh, body, options, nullptr, progress);
}

DrapeResult drape_to_hold(const Pattern& pattern, const PatternMesh& mesh, const Body& body,
                          const DrapeOptions& options, HeldDrape& end, Progress* progress) {
  return drape_whole(pattern, mesh, body, options, &end, progress);
}

DrapeResult drape_held(const Pattern& pattern, const PatternMesh& mesh, const Body& body, const Drape& start,
                       const HeldDrape& held, const DrapeOptions& options, Progress* progress) {
  check_options(options);
  check_start(mesh, start);
  const FrictionState& friction = held.friction;
  for (const Eigen::Index rows : {friction.load.size(), friction.anchor.rows(), friction.normal.rows()})
    if (rows != mesh.node_count)
      throw Error(ErrorCode::GarmentInvalid, "garment", "the given friction does not have a row for every node");
  PreparedBody prepared(body);
  Draper draper(pattern, mesh, prepared, options, progress);
  draper.hold(held);
  return draper.from_start(start.nodes);
}

DrapeResult drape_from(const Pattern& pattern, const PatternMesh& mesh, const Body& body, const Drape& start,
                       const DrapeOptions& options, Progress* progress) {
  return DrapeSeries(body).drape_from(pattern, mesh, start, options, progress);
}

DrapeSeries::DrapeSeries(const Body& body) : body_(std::make_unique<PreparedBody>(body)) {}
DrapeSeries::~DrapeSeries() = default;

DrapeResult DrapeSeries::drape_from(const Pattern& pattern, const PatternMesh& mesh, const Drape& start,
                                    const DrapeOptions& options, Progress* progress) {
  check_options(options);
  check_start(mesh, start);
  return Draper(pattern, mesh, *body_, options, progress).from_start(start.nodes);
}

}  // namespace toile
