// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/come_to_rest.h"

#include <algorithm>

#include "engine/core/units.h"
#include "engine/sim/newton.h"
#include "engine/sim/position_based.h"
#include "engine/sim/relax.h"

namespace toile {
namespace {

constexpr double kUsualTension = 1000;  // N/m, of the cloth that the default contact stiffness suits

constexpr int kPairs = 5;  // of the minimiser: 4 to 20 need as many iterations on garments, and fewer fit the cache

constexpr int kLeastFromWorn = 150;  // iterations before a garment that was worn already may count as settled

// Contact of a garment that is far too small is made stiffer until no node, and no middle of an edge, is that deep in
// the body, m.
constexpr double kDeep = 0.001, kDeepEdge = 0.003, kFirmer = 4;
constexpr int kMostFirmings = 2;

constexpr double kStartReach = 0.001;  // m, within which friction at the start takes nodes as touching the body

class RestSeeker {
 public:
  RestSeeker(const GarmentOnBody& garment, const DrapeOptions& options, DrapeResult& result, Progress* progress)
      : garment_(garment),
        cloth_(garment.half ? garment.half->cloth : garment.cloth),
        options_(options),
        result_(result),
        progress_(progress) {}

  void run(const Points3& start) {
    report(progress_, "drape", 0);
    Points3 from = start;
    double stiffness = contact_stiffness();
    for (int firmings = 0; relax_on(stiffness, from) && firmings < kMostFirmings; ++firmings) {
      from = result_.drape.nodes;
      stiffness *= kFirmer;
    }
  }

  const FrictionState& friction() const { return friction_; }  // of the whole garment

 private:
  // True: the cloth rests, but pulls so hard that nodes lie deep in the body. Firmer contact does not bring cloth to
  // rest that comes to none.
  bool relax_on(double stiffness, const Points3& start) {
    garment_.field.look_ahead(moved(start), garment_.thickness + kStartReach);
    ContactOptions contact_options;
    contact_options.thickness = garment_.thickness;
    contact_options.stiffness = stiffness;
    contact_options.friction = options_.friction;
    Contact contact(cloth_, garment_.field, contact_options);
    if (garment_.friction)
      contact.start_friction(garment_.half ? garment_.half->folded(*garment_.friction) : *garment_.friction,
                             garment_.hold_friction);
    EdgeContact edges(cloth_, garment_.field, contact_options);
    DrapeEnergy energy(cloth_, &contact, options_.gravity);
    energy.edge_contact = &edges;
    take_ties(energy);
    std::optional<ClothContact> layers;
    if (options_.self_contact != SelfContact::Off) {
      ClothContactOptions layers_options;
      layers_options.mirror = garment_.mirror;
      layers_options.half = garment_.half;
      layers.emplace(garment_.cloth, garment_.mesh, layers_options);
      energy.cloth_contact = &*layers;
    }
    if (options_.solver == SolverKind::Pbd) return average_targets(energy, start), false;
    if (options_.solver == SolverKind::Newton && options_.friction == 0) return refine(energy, start), false;
    const RelaxResult relaxed = relax(energy, start, relax_options(), progress_);
    take_over(relaxed);
    result_.diagnostics.tangled = relaxed.tangled;
    friction_ = garment_.half ? garment_.half->unfolded(contact.friction()) : contact.friction();
    result_.quality.settling_move = relaxed.last_move;
    result_.quality.rest = rest_of(relaxed);
    if (options_.solver == SolverKind::Newton) return refine(energy, relaxed.nodes), false;
    return result_.quality.rest != Rest::NotAtRest && presses_deep(energy, contact.distances(), edges);
  }

  // Of the nodes of the garment those that the solver moves.
  Points3 moved(const Points3& nodes) const { return garment_.half ? garment_.half->folded(nodes) : nodes; }

  void take_ties(DrapeEnergy& energy) const {
    energy.half = garment_.half;
    if (!garment_.half) energy.mirror = garment_.mirror;
    energy.holds = garment_.half ? garment_.half->folded(garment_.holds) : garment_.holds;
    energy.pins = garment_.half ? garment_.half->folded(garment_.pins) : garment_.pins;
  }

  RelaxOptions relax_options() const {
    RelaxOptions options;
    options.iterations = options_.iterations;
    options.stop_residual = options_.stop_residual;
    options.stop_settled = options_.stop_settled;
    options.quasi_newton.memory = kPairs;
    if (garment_.worn) options.least_iterations = kLeastFromWorn;
    options.watched = garment_.watched;
    return options;
  }

  static Rest rest_of(const RelaxResult& relaxed) {
    if (relaxed.residual < DrapeOptions().stop_residual) return Rest::Converged;  // whatever was asked for
    return relaxed.converged || relaxed.settled ? Rest::Settled : Rest::NotAtRest;
  }

  // Whether nodes or middles of edges lie deep in the body itself: within toes and fingers the field is flatter. Pinned
  // nodes lie where they are wanted.
  bool presses_deep(const DrapeEnergy& energy, Eigen::VectorXd distances, EdgeContact& edges) const {
    for (const Pin& pin : energy.pins) distances[pin.node] = 0;
    const Points3 nodes = moved(result_.drape.nodes);
    for (Eigen::Index i = 0; i < distances.size(); ++i)
      if (distances[i] < 0 && depth_inside(garment_.field.tree(), nodes.row(i)) > kDeep) return true;
    if (!garment_.pins.empty()) return false;
    const std::vector<Vec3> middles = edges.inside(nodes);
    return std::any_of(middles.begin(), middles.end(),
                       [&](const Vec3& p) { return depth_inside(garment_.field.tree(), p) > kDeepEdge; });
  }

  template <class Solved>
  void take_over(const Solved& solved) {
    result_.drape.nodes = solved.nodes;
    DrapeDiagnostics& d = result_.diagnostics;
    d.moved_nodes = cloth_.node_count;
    d.iterations += solved.iterations;
    d.evaluations += solved.evaluations;
    d.energy = solved.energy;
    d.stalled = solved.stalled;
    result_.quality.residual = solved.residual;
  }

  // To the very minimum, contacts and friction as they stand in `energy`.
  void refine(DrapeEnergy& energy, const Points3& start) {
    NewtonOptions options;
    options.stop_residual = options_.newton_residual;
    if (energy.cloth_contact) energy.cloth_contact->hold(start);
    const NewtonResult refined = newton(energy, start, options, progress_);
    take_over(refined);
    if (refined.residual < options_.stop_residual) result_.quality.rest = Rest::Converged;
  }

  // Cloth that pulls harder presses harder: the depth stays what it is with the fabric the option was chosen for.
  double contact_stiffness() const {
    const double tension = std::max(garment_.cloth.fabric.weft_stiffness, garment_.cloth.fabric.warp_stiffness);
    return options_.contact_stiffness * std::max(1.0, tension / kUsualTension);
  }

  void average_targets(DrapeEnergy& energy, const Points3& start) {
    PositionBasedOptions options;
    options.iterations = options_.iterations;
    options.fibre_slack = options_.fibre_slack;
    options.shear_limit = options_.shear_limit_deg * kRadianPerDegree;
    options.gravity = options_.gravity;
    result_.drape.nodes = position_based(energy, garment_.field, garment_.thickness, start, options, progress_);
    Points3 gradient(start.rows(), 3);
    result_.diagnostics.iterations = options.iterations;
    result_.diagnostics.energy = energy.evaluate(result_.drape.nodes, gradient);
    result_.quality.residual = energy.residual(gradient);
  }

  const GarmentOnBody& garment_;
  const Cloth& cloth_;  // that moves
  const DrapeOptions& options_;
  DrapeResult& result_;
  Progress* progress_;
  FrictionState friction_;
};

}  // namespace

FrictionState come_to_rest(const GarmentOnBody& garment, const Points3& start, const DrapeOptions& options,
                           DrapeResult& result, Progress* progress) {
  RestSeeker seeker(garment, options, result, progress);
  seeker.run(start);
  return seeker.friction();
}

}  // namespace toile
