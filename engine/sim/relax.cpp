// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/relax.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/core/units.h"
#include "engine/sim/membrane.h"
#include "engine/sim/standstill.h"
#include "engine/sim/swing.h"

namespace toile {
namespace {

// Shares of the contact and hold stiffness in the matrix, and the length over which weight acts as a spring:
// measured best of a few (design/sewing.md F).
constexpr double kContactShare = 0.4, kHoldShare = 0.3, kWeightLength = 0.3, kLayerShare = 0.4;

// Nodes of a start this close to the body are taken as touching it, m: the sewing leaves them within 0.2 mm.
constexpr double kStartReach = 0.001;

constexpr double kCalmShare = 0.98;  // of the nodes by which settling is judged
constexpr int kPatience = 10;        // rounds in which a knot of layers may come to rest when all else has settled

// DrapeEnergy::residual of the nodes with the least forces.
double calm_residual(const DrapeEnergy& energy, const Points3& gradient) {
  Eigen::VectorXd squares = energy.squared_forces(gradient);
  const auto calm = static_cast<Eigen::Index>(std::ceil(kCalmShare * static_cast<double>(squares.size())));
  std::nth_element(squares.data(), squares.data() + calm - 1, squares.data() + squares.size());
  return std::sqrt(squares.head(calm).mean()) / energy.cloth().mean_node_weight();
}

// Share of the reach of the last look for pairs of layers that moves may use up before the next one.
constexpr double kUsedReach = 0.3;

// Planes a node above which cloth lies in a heap; layers that fold on one another have one or two.
constexpr int kHeaped = 4;

class Relaxation {
 public:
  Relaxation(DrapeEnergy& energy, const RelaxOptions& options)
      : energy_(energy),
        options_(options),
        base_(membrane_bound(energy.cloth())),
        contact_diagonal_(Eigen::VectorXd::Zero(energy.cloth().node_count)) {}

  void factor(const Points3& nodes) {
    const Cloth& cloth = energy_.cloth();
    SparseMatrix matrix = base_;
    contact_diagonal_.setZero();
    if (energy_.contact()) energy_.contact()->stiffness_diagonal(contact_diagonal_);
    if (energy_.edge_contact) energy_.edge_contact->add_stiffness(contact_diagonal_);
    const double weight = cloth.fabric.density * kGravity / kWeightLength;
    for (int i = 0; i < cloth.node_count; ++i)
      matrix.coeffRef(i, i) += weight * cloth.node_area[i] + kContactShare * contact_diagonal_[i];
    for (const Hold& hold : energy_.holds)
      if (nodes(hold.node, 1) < hold.height) matrix.coeffRef(hold.node, hold.node) += kHoldShare * hold.stiffness;
    for (const Pin& pin : energy_.pins) matrix.coeffRef(pin.node, pin.node) += pin.stiffness;
    if (energy_.cloth_contact) add_layers(nodes, matrix);
    if (!solver_.factor(matrix, cloth.middle))
      throw Error(ErrorCode::DrapeFailed, "garment",
                  "the cloth's stiffness matrix cannot be factored; check the fabric");
  }

  // Layers that touch move together easily, apart with difficulty.
  void add_layers(const Points3& nodes, SparseMatrix& matrix) const {
    std::vector<Eigen::Triplet<double>> entries;
    energy_.cloth_contact->add_stiffness(nodes, entries);
    if (entries.empty()) return;
    SparseMatrix layers(nodes.rows(), nodes.rows());
    layers.setFromTriplets(entries.begin(), entries.end());
    matrix += kLayerShare * layers;
  }

  RelaxResult run(const Points3& whole_start, Progress* progress) {
    const Points3 start = energy_.half ? energy_.half->folded(whole_start) : whole_start;
    QuasiNewton minimiser(energy_.cloth().node_count, options_.quasi_newton);
    minimiser.set_helper(&helper_);
    energy_.helper = &helper_;
    const QuasiNewton::Energy evaluate = [this](const Points3& x, Points3& g) { return energy_.evaluate(x, g); };
    if (energy_.contact() && !energy_.contact()->frozen()) freeze_at_start(start);
    if (energy_.edge_contact) energy_.edge_contact->look(start);
    if (energy_.cloth_contact) energy_.cloth_contact->refresh(start);
    if (energy_.cloth_contact || energy_.mirror)
      minimiser.set_limit([this](const Points3& from, Points3& to, double longest) {
        const bool limited = energy_.cloth_contact && energy_.cloth_contact->limit(from, to, longest);
        if (energy_.mirror) symmetrise(*energy_.mirror, to);
        if (limited) energy_.cloth().hold_middle(to);
        return limited || energy_.mirror;
      });
    minimiser.start(start, evaluate);
    watched_ = watched_means(whole_start);
    swing_.emplace(whole_start);
    while (result_.iterations < options_.iterations && !done()) {
      report(progress, "drape", static_cast<double>(result_.iterations) / options_.iterations);
      helper_.call();
      const bool whole = run_round(minimiser, evaluate, progress);
      if (energy_.contact()) energy_.contact()->freeze_friction(minimiser.nodes());
      if (energy_.edge_contact) energy_.edge_contact->look(minimiser.nodes());
      if (energy_.cloth_contact) energy_.cloth_contact->swell(minimiser.nodes());
      if (energy_.cloth_contact) energy_.cloth_contact->refresh(minimiser.nodes());
      minimiser.refresh(evaluate);
      helper_.dismiss();
      judge(minimiser, whole);
    }
    energy_.helper = nullptr;
    result_.nodes = whole(minimiser.nodes());
    result_.energy = (energy_.half ? 2 : 1) * minimiser.energy();
    result_.evaluations = minimiser.evaluations();
    return result_;
  }

 private:
  bool done() const {
    if (result_.converged || result_.stalled) return true;
    const bool calm = calm_rounds_ > 0 && calm_residual_ < options_.stop_settled;
    return calm && ((result_.settled && !knotted_ && to_come_ < options_.settled_swing) || calm_rounds_ > kPatience);
  }

  // Iterations with friction as it stands; false if the residual was reached before the round was over.
  bool run_round(QuasiNewton& minimiser, const QuasiNewton::Energy& evaluate, Progress* progress) {
    const int round = result_.iterations < options_.first_round ? options_.first_round : options_.round;
    for (int i = 0; i < round && result_.iterations < options_.iterations; ++i) {
      check_cancelled(progress);
      if (energy_.residual(minimiser.gradient()) < options_.stop_residual) return false;
      look_around(minimiser, evaluate);
      if (result_.iterations % options_.refactor == 0) factor(minimiser.nodes());
      ++result_.iterations;
      bool moved = minimiser.step(evaluate, solver_);
      if (!moved && energy_.cloth_contact) {  // planes between layers may be in the way: take up new ones
        energy_.cloth_contact->refresh(minimiser.nodes());
        minimiser.refresh(evaluate);
        moved = minimiser.step(evaluate, solver_);
      }
      result_.stalled = !moved && i == 0;  // not even with friction frozen anew and the history forgotten
      if (!moved) return false;
    }
    return true;
  }

  void look_around(QuasiNewton& minimiser, const QuasiNewton::Energy& evaluate) {
    ClothContact* self = energy_.cloth_contact;
    if (!self || !outdated(*self, minimiser.nodes())) return;
    looked_at_ = result_.iterations;
    if (self->refresh(minimiser.nodes())) minimiser.refresh(evaluate);
  }

  // Planes that stop a node slow down all of the cloth: they are put where the layers are now before long. In a heap
  // something always stops something, and looks cost more than all else.
  bool outdated(ClothContact& self, const Points3& nodes) const {
    const int since = result_.iterations - looked_at_;
    const bool heaped = self.planes() > kHeaped * energy_.cloth().node_count;
    if (!heaped && (self.stale() || (self.hindered() && since >= options_.look_soon))) return true;
    return since >= options_.look_around &&
           (self.piercings() > 0 || self.moved_beyond(kUsedReach * self.reach(), nodes));
  }

  void judge(const QuasiNewton& minimiser, bool whole_round) {
    result_.residual = energy_.residual(minimiser.gradient());
    result_.converged = result_.residual < options_.stop_residual;
    if (!whole_round) return;
    if (standstill_.after_round(result_.residual, minimiser.energy(), tangle())) {
      result_.stalled = true;
      result_.tangled = standstill_.tangled();
    }
    const Points3 nodes = whole(minimiser.nodes());
    const std::vector<Vec3> means = watched_means(nodes);
    result_.last_move = 0;
    for (std::size_t k = 0; k < means.size(); ++k)
      result_.last_move = std::max(result_.last_move, (means[k] - watched_[k]).norm());
    watched_ = means;
    to_come_ = swing_->after_round(nodes);
    calm_residual_ = calm_residual(energy_, minimiser.gradient());
    const bool calm = result_.iterations >= options_.least_iterations && calm_residual_ < options_.settled_residual &&
                      result_.last_move < options_.settled_move;
    calm_rounds_ += calm;
    result_.settled = calm && result_.residual < options_.settled_everywhere;
    knotted_ = energy_.cloth_contact && energy_.cloth_contact->piercings() > 0;
  }

  double tangle() const { return energy_.cloth_contact ? energy_.cloth_contact->tangle() : 0.0; }

  Points3 whole(const Points3& nodes) const { return energy_.half ? energy_.half->unfolded(nodes) : nodes; }

  std::vector<Vec3> watched_means(const Points3& nodes) const {
    std::vector<Vec3> means;
    for (const std::vector<int>& line : options_.watched) {
      means.push_back(Vec3::Zero());
      for (int n : line) means.back() += nodes.row(n).transpose() / static_cast<double>(line.size());
    }
    return means;
  }

  void freeze_at_start(const Points3& start) {
    Points3 pull = Points3::Zero(start.rows(), 3);
    membrane_energy_gradient(energy_.cloth(), start, pull);
    energy_.cloth().hold_middle(pull);
    energy_.contact()->freeze_friction(start, pull, kStartReach);
  }

  DrapeEnergy& energy_;
  const RelaxOptions& options_;
  SparseMatrix base_;
  Eigen::VectorXd contact_diagonal_;
  RowSolver solver_;
  Helper helper_;
  std::vector<Vec3> watched_;
  int looked_at_ = 0;  // iteration of the last look around
  double calm_residual_ = 0.0;
  bool knotted_ = false;  // layers that cross still push
  int calm_rounds_ = 0;   // so far
  Standstill standstill_;
  std::optional<Swing> swing_;
  double to_come_ = 0.0;  // moves of all further rounds, m
  RelaxResult result_;
};

}  // namespace

RelaxResult relax(DrapeEnergy& energy, const Points3& start, const RelaxOptions& options, Progress* progress) {
  return Relaxation(energy, options).run(start, progress);
}

}  // namespace toile
