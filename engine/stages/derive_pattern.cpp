// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/derive_pattern.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "engine/geometry/unfold_triangles.h"
#include "engine/numerics/sparse_solver.h"
#include "engine/stages/build_fitting_map.h"
#include "engine/stages/edge_terms.h"
#include "engine/stages/smooth_sides.h"
#include "engine/stages/wanted_gradients.h"

namespace toile {
namespace {

constexpr double kRelativeFloor = 1e-24;  // of the area: an energy below it is rounding
// Of the roughness of sides against the area's energy, dimensionless: a speck of 1 mm would have to relieve a strain of
// some percent over a palm of cloth.
constexpr double kSmoothWeight = 100.0;
constexpr int kInsideSweeps = 20;
// Sweeps of the first stage and of every later one, at most: from the reference, and from a pattern that is nearly
// right already, where more change the fit of no garment by a hundredth of it.
struct StageSweeps {
  int first, later;
};
constexpr StageSweeps kSweeps{20, 15}, kNearSweeps{10, 10};
// Of a panel's fit energy, that it may cost to lay the panel over the original: half a percent of the strain left.
constexpr double kTurnShare = 0.01;
constexpr double kLeastDeterminant = 0.05;  // of a triangle whose outline leaves it room: no flip, no sliver

class Derivation {
 public:
  Derivation(const PatternMesh& mesh, const FittingMap& reference_fit, const Drape& target_drape,
             const GarmentMirrors& mirrors, const DerivePatternOptions& options, Progress* progress)
      : mesh_(mesh),
        mirrors_(mirrors),
        options_(options),
        progress_(progress),
        wanted_(reference_fit, build_fitting_map(mesh, target_drape)) {
    gradients_ = triangle_gradients(mesh.rest, mesh.triangles);
    result_.rest = mesh.rest;
    held_.assign(static_cast<std::size_t>(mesh.vertex_count()), false);
  }

  DerivePatternResult whole(const Pattern& pattern, const Points2* near);
  DerivePatternResult inside(const Points2& outline);

 private:
  void number_unknowns();
  void factor(double weight);
  bool run_stage(double weight, int sweeps);
  void local_step();
  void global_step(double weight);
  void gather_forces(double weight);
  double fit_energy() const;
  double fit_energy_of_turned(const PanelRange& panel);
  void lay_over_the_original(const PanelRange& panel);
  double rough_energy() const;
  void finish();

  const PatternMesh& mesh_;
  const GarmentMirrors& mirrors_;
  const DerivePatternOptions& options_;
  Progress* progress_;
  TriangleGradients gradients_;
  WantedGradients wanted_;
  std::optional<EdgeTerms> edges_;
  std::vector<SmoothSide> sides_;
  std::vector<bool> held_;  // vertices that do not move
  std::vector<int> unknown_of_vertex_;
  int unknowns_ = 0;
  SparseSolver solver_;
  Eigen::MatrixXd forces_;            // #V x 2, right side before anything is held
  Eigen::MatrixXd right_, solution_;  // of the unknowns
  Eigen::MatrixXd held_pull_;         // what the held vertices add to the right side at this lambda
  DerivePatternResult result_;
};

void Derivation::number_unknowns() {
  unknown_of_vertex_.assign(held_.size(), -1);
  for (std::size_t v = 0; v < held_.size(); ++v)
    if (!held_[v]) unknown_of_vertex_[v] = unknowns_++;
}

void Derivation::factor(double weight) {
  std::vector<Eigen::Triplet<double>> entries;
  held_pull_ = Eigen::MatrixXd::Zero(unknowns_, 2);
  const auto add = [&](int v, int w, double value) {
    const int row = unknown_of_vertex_[static_cast<std::size_t>(v)],
              col = unknown_of_vertex_[static_cast<std::size_t>(w)];
    if (row < 0) return;
    if (col < 0)
      held_pull_.row(row) -= value * result_.rest.row(w);
    else if (row >= col)
      entries.emplace_back(row, col, value);
  };
  for (int f = 0; f < mesh_.triangle_count(); ++f) {
    const Eigen::Matrix<double, 3, 2> weights = gradients_.corner_weights(f);
    const Mat3 local = gradients_.area[f] * weights * weights.transpose();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) add(mesh_.triangles(f, i), mesh_.triangles(f, j), local(i, j));
  }
  if (edges_)
    for (const EdgeTerm& term : edges_->terms()) {  // kept in the pattern of non-zeros at weight 0: analysed once
      const double stiffness = weight * term.stiffness;
      add(term.from, term.from, stiffness);
      add(term.to, term.to, stiffness);
      add(term.from, term.to, -stiffness);
      add(term.to, term.from, -stiffness);
    }
  for (const SmoothSide& side : sides_)
    for (std::size_t i = 0; i < side.vertices.size(); ++i)
      for (std::size_t j = 0; j < side.vertices.size(); ++j)
        add(side.vertices[i], side.vertices[j],
            kSmoothWeight * side.penalty(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  SparseMatrix matrix(unknowns_, unknowns_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  matrix.makeCompressed();
  if (!solver_.factor(matrix))
    throw Error(
        ErrorCode::DerivationFailed, "garment",
        "the system of the target pattern is singular: a panel is in several pieces or its drape is not finite");
}

void Derivation::local_step() {
  for (int f = 0; f < mesh_.triangle_count(); ++f) wanted_.turn(f, gradients_.of(result_.rest, f));
  if (edges_) edges_->update(result_.rest);
}

void Derivation::gather_forces(double weight) {
  forces_.setZero(mesh_.vertex_count(), 2);
  for (int f = 0; f < mesh_.triangle_count(); ++f) {
    const Mat2 wanted = gradients_.area[f] * wanted_.wanted(f);
    const Eigen::Matrix<double, 3, 2> weights = gradients_.corner_weights(f);
    for (int i = 0; i < 3; ++i) forces_.row(mesh_.triangles(f, i)) += (wanted * weights.row(i).transpose()).transpose();
  }
  if (edges_ && weight > 0.0)
    for (const EdgeTerm& term : edges_->terms()) {
      forces_.row(term.to) += weight * term.stiffness * term.wanted.transpose();
      forces_.row(term.from) -= weight * term.stiffness * term.wanted.transpose();
    }
}

// The matrix is the same for a panel and its image; so symmetric forces give the best symmetric pattern.
void Derivation::global_step(double weight) {
  gather_forces(weight);
  symmetrise_forces(mesh_, mirrors_, forces_);
  right_ = held_pull_;
  for (int v = 0; v < mesh_.vertex_count(); ++v) {
    const int row = unknown_of_vertex_[static_cast<std::size_t>(v)];
    if (row >= 0) right_.row(row) += forces_.row(v);
  }
  solution_.resize(unknowns_, 2);
  solver_.solve_into(right_, solution_);
  for (int v = 0; v < mesh_.vertex_count(); ++v) {
    const int row = unknown_of_vertex_[static_cast<std::size_t>(v)];
    if (row >= 0) result_.rest.row(v) = solution_.row(row);
  }
}

double Derivation::fit_energy() const {
  double sum = 0.0;
  for (int f = 0; f < mesh_.triangle_count(); ++f)
    sum += gradients_.area[f] * (gradients_.of(result_.rest, f) - wanted_.wanted(f)).squaredNorm();
  return sum;
}

double Derivation::rough_energy() const {
  double sum = 0.0;
  for (const SmoothSide& side : sides_) sum += side.energy(result_.rest);
  return kSmoothWeight * sum;
}

// Sweeps at one lambda; true when the energy stopped falling before they were used up.
bool Derivation::run_stage(double weight, int sweeps) {
  if (sweeps <= 0) return false;
  factor(weight);
  const double area = gradients_.area.sum();
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < sweeps; ++i) {
    check_cancelled(progress_);
    local_step();
    global_step(weight);
    const double fit = fit_energy();
    const double energy = fit + rough_energy() + (edges_ ? weight * edges_->energy(result_.rest) : 0.0);
    result_.sweeps.push_back(
        {weight, energy, std::sqrt(fit / area), edges_ ? edges_->pair_residual(result_.rest) : 0.0});
    if (energy <= kRelativeFloor * area || before - energy < options_.energy_drop * energy) return true;
    before = energy;
  }
  return false;
}

DerivePatternResult Derivation::whole(const Pattern& pattern, const Points2* near) {
  if (near) result_.rest = *near;
  const StageSweeps sweeps = near ? kNearSweeps : kSweeps;
  edges_.emplace(pattern, mesh_, side_rules(pattern, mirrors_, options_.keep_straight));
  if (options_.smooth) sides_ = smooth_sides(mesh_);
  for (std::size_t p = 0; p < mesh_.panels.size(); ++p) {
    const PanelRange& range = mesh_.panels[p];
    if (panel_locked(pattern, mirrors_, static_cast<int>(p)))
      std::fill(held_.begin() + range.vertex_begin, held_.begin() + range.vertex_end, true);
    const auto& outline = mesh_.edge_vertices[p];  // one vertex of every other panel: translations cost nothing
    held_[static_cast<std::size_t>(outline.empty() ? range.vertex_begin : outline[0].front())] = true;
  }
  number_unknowns();
  if (unknowns_ == 0) return result_;
  const auto left = [&] { return options_.max_sweeps - static_cast<int>(result_.sweeps.size()); };
  const bool constrained = !edges_->terms().empty() && options_.seam_weight > 0.0;
  // Starting with the final weight locks the seams where they are; so it grows, each stage starting from the last.
  result_.converged = run_stage(0.0, constrained ? std::min(left(), sweeps.first) : left());
  if (constrained)
    for (double weight = 10.0; weight <= options_.seam_weight * 1.000001; weight *= 10.0) {
      report(progress_, "derive", 1.0 - static_cast<double>(left()) / options_.max_sweeps);
      result_.converged = run_stage(weight, std::min(left(), sweeps.later));
    }
  for (std::size_t p = 0; p < mesh_.panels.size(); ++p)
    if (!panel_locked(pattern, mirrors_, static_cast<int>(p))) lay_over_the_original(mesh_.panels[p]);
  finish();
  result_.seam_residual = edges_->side_residual(result_.rest);
  return std::move(result_);
}

DerivePatternResult Derivation::inside(const Points2& outline) {
  result_.rest = outline;
  for (const auto& panel : mesh_.edge_vertices)
    for (const auto& edge : panel)
      for (const int v : edge) held_[static_cast<std::size_t>(v)] = true;
  number_unknowns();
  if (unknowns_ == 0) return result_;
  result_.converged = run_stage(0.0, kInsideSweeps);
  unfold_triangles(gradients_, held_, kLeastDeterminant, result_.rest);
  finish();
  return std::move(result_);
}

// With the rotations on the drape's side as suits the panel best.
double Derivation::fit_energy_of_turned(const PanelRange& panel) {
  double sum = 0.0;
  for (int f = panel.triangle_begin; f < panel.triangle_end; ++f) {
    const Mat2 gradient = gradients_.of(result_.rest, f);
    wanted_.turn(f, gradient);
    sum += gradients_.area[f] * (gradient - wanted_.wanted(f)).squaredNorm();
  }
  return sum;
}

// Where cloth is stretched alike both ways the fit hardly tells which way the grain lies in a panel, and the sweeps
// leave it turned by a fraction of a degree. The panel is turned back to where it lies best over the original, as far
// as that costs next to no fit.
void Derivation::lay_over_the_original(const PanelRange& panel) {
  const auto rows = [&](auto& points) {
    return points.middleRows(panel.vertex_begin, panel.vertex_end - panel.vertex_begin);
  };
  const Eigen::RowVector2d middle = rows(result_.rest).colwise().mean();
  const Points2 found = rows(result_.rest).rowwise() - middle;
  const Points2 original = rows(mesh_.rest).rowwise() - rows(mesh_.rest).colwise().mean();
  const double along = found.cwiseProduct(original).sum(),
               across = found.col(0).dot(original.col(1)) - found.col(1).dot(original.col(0));
  const auto turn_by = [&](double angle) {
    const Eigen::Rotation2Dd turn(angle);
    rows(result_.rest) = (found * turn.toRotationMatrix().transpose()).rowwise() + middle;
  };
  const double angle = std::atan2(across, along), before = fit_energy_of_turned(panel);
  turn_by(angle);
  const double rise = fit_energy_of_turned(panel) - before,
               allowed = kTurnShare * before + kRelativeFloor * gradients_.area.sum();
  if (rise > allowed) turn_by(angle * std::sqrt(allowed / rise));  // the rise is as the angle's square
}

void Derivation::finish() {
  symmetrise(mesh_, mirrors_, result_.rest);
  result_.fit_residual = result_.sweeps.back().fit_residual;
  for (int f = 0; f < mesh_.triangle_count(); ++f)
    result_.flipped_triangles += gradients_.of(result_.rest, f).determinant() <= 0.0;
}

}  // namespace

DerivePatternResult derive_pattern(const Pattern& pattern, const PatternMesh& reference_mesh,
                                   const FittingMap& reference_fit, const Drape& target_drape,
                                   const GarmentMirrors& mirrors, const DerivePatternOptions& options,
                                   Progress* progress, const Points2* near) {
  assert(reference_fit.triangle_count() == reference_mesh.triangle_count());
  assert(target_drape.nodes.rows() == reference_mesh.node_count && options.max_sweeps >= 1);
  assert(!near || near->rows() == reference_mesh.vertex_count());
  return Derivation(reference_mesh, reference_fit, target_drape, mirrors, options, progress).whole(pattern, near);
}

DerivePatternResult derive_inside(const PatternMesh& reference_mesh, const FittingMap& reference_fit,
                                  const Drape& target_drape, const Points2& outline, const GarmentMirrors& mirrors,
                                  const DerivePatternOptions& options, Progress* progress) {
  assert(outline.rows() == reference_mesh.vertex_count());
  return Derivation(reference_mesh, reference_fit, target_drape, mirrors, options, progress).inside(outline);
}

}  // namespace toile
