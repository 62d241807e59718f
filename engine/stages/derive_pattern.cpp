// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/derive_pattern.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "engine/geometry/triangle_gradient.h"
#include "engine/numerics/sparse_solver.h"
#include "engine/stages/build_fitting_map.h"
#include "engine/stages/edge_terms.h"

namespace toile {
namespace {

// Singular values of the wanted tensor stay in this range, so that its inverse stays bounded [method, Sec. 1].
constexpr double kLeastStretch = 0.5, kMostStretch = 2.0;
constexpr int kNewtonSteps = 8;
constexpr double kAngleTolerance = 1e-9;  // rad; far below what a sweep moves
constexpr double kRelativeFloor = 1e-24;  // of the area: an energy below it is rounding

// Inverse of a tensor of positive determinant with its singular values clamped.
Mat2 clamped_inverse(const Mat2& tensor) {
  const Eigen::SelfAdjointEigenSolver<Mat2> eigen(tensor.transpose() * tensor);
  const double least = std::sqrt(std::max(0.0, eigen.eigenvalues()[0])), most = std::sqrt(eigen.eigenvalues()[1]);
  if (least >= kLeastStretch && most <= kMostStretch) return tensor.inverse();
  const Vec2 v = eigen.eigenvectors().col(1), v_across(-v.y(), v.x());
  const Vec2 u = most > 0.0 ? Vec2(tensor * v / most) : v, u_across(-u.y(), u.x());
  return v * u.transpose() / std::clamp(most, kLeastStretch, kMostStretch) +
         v_across * u_across.transpose() / std::clamp(least, kLeastStretch, kMostStretch);
}

double dot(const Mat2& a, const Mat2& b) {
  return a.cwiseProduct(b).sum();
}

// Per triangle: the wanted gradient is A cos + B sin; the angle is the local unknown.
struct Face {
  Mat2 a, b;          // J^-1 M and J^-1 Rot90 M
  double aa, bb, ab;  // their inner products
  double cosine = 1.0, sine = 0.0;

  Mat2 wanted() const { return a * cosine + b * sine; }
};

double face_energy(const Face& f, double c, double s, double p, double q) {
  return f.aa * c * c + f.bb * s * s + 2.0 * f.ab * c * s - 2.0 * (p * c + q * s);
}

// Minimum over the angle of |A cos + B sin - G|^2, by Newton steps that never let it grow.
void turn(Face& f, const Mat2& gradient) {
  const double p = dot(f.a, gradient), q = dot(f.b, gradient);
  double c = f.cosine, s = f.sine, energy = face_energy(f, c, s, p, q);
  for (int i = 0; i < kNewtonSteps; ++i) {
    const double slope = 2.0 * ((f.bb - f.aa) * c * s + f.ab * (c * c - s * s) + p * s - q * c);
    const double bend = 2.0 * ((f.bb - f.aa) * (c * c - s * s) - 4.0 * f.ab * c * s + p * c + q * s);
    double step = bend > 0.0 ? -slope / bend : (slope > 0.0 ? -0.5 : 0.5);
    step = std::clamp(step, -1.0, 1.0);
    double next_c = c, next_s = s, next = energy;
    for (int halving = 0; halving < 8; ++halving, step *= 0.5) {
      const double dc = std::cos(step), ds = std::sin(step);
      next_c = c * dc - s * ds;
      next_s = s * dc + c * ds;
      next = face_energy(f, next_c, next_s, p, q);
      if (next <= energy) break;
    }
    if (next > energy) break;
    c = next_c;
    s = next_s;
    energy = next;
    if (std::abs(step) < kAngleTolerance) break;
  }
  const double length = std::hypot(c, s);  // products of many small turns drift off the unit circle
  f.cosine = c / length;
  f.sine = s / length;
}

class Derivation {
 public:
  Derivation(const Pattern& pattern, const PatternMesh& mesh, const FittingMap& fit, const Drape& drape,
             const DerivePatternOptions& options, Progress* progress)
      : mesh_(mesh), options_(options), progress_(progress), edges_(pattern, mesh, options.keep_straight) {
    gradients_ = triangle_gradients(mesh.rest, mesh.triangles);
    result_.rest = mesh.rest;
    prepare_faces(fit, build_fitting_map(mesh, drape));
    hold_vertices(pattern);
  }

  DerivePatternResult run();

 private:
  void prepare_faces(const FittingMap& reference, const FittingMap& target);
  void hold_vertices(const Pattern& pattern);
  void factor(double weight);
  bool run_stage(double weight, int sweeps);
  void local_step();
  void global_step(double weight);
  double fit_energy() const;
  void finish();

  const PatternMesh& mesh_;
  const DerivePatternOptions& options_;
  Progress* progress_;
  TriangleGradients gradients_;
  EdgeTerms edges_;
  std::vector<Face> faces_;
  std::vector<bool> held_;  // vertices that do not move
  std::vector<int> unknown_of_vertex_;
  int unknowns_ = 0;
  SparseSolver solver_;
  Eigen::MatrixXd right_, solution_;
  Eigen::MatrixXd held_pull_;  // what the held vertices add to the right side at this lambda
  DerivePatternResult result_;
};

void Derivation::prepare_faces(const FittingMap& reference, const FittingMap& target) {
  const Mat2 quarter = (Mat2() << 0, -1, 1, 0).finished();
  faces_.resize(static_cast<std::size_t>(mesh_.triangle_count()));
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    Face& face = faces_[f];
    const Mat2 &wanted = reference.tensor[f], &draped = target.tensor[f];
    const Mat2 inverse = clamped_inverse(wanted);
    face.a = inverse * draped;
    face.b = inverse * quarter * draped;
    face.aa = face.a.squaredNorm();
    face.bb = face.b.squaredNorm();
    face.ab = dot(face.a, face.b);
    const Mat2 turned = wanted * draped.transpose();  // polar factor of J G M^T with G = I: start of the rotation
    const double c = turned(0, 0) + turned(1, 1), s = turned(1, 0) - turned(0, 1), length = std::hypot(c, s);
    if (length > 0.0) {
      face.cosine = c / length;
      face.sine = s / length;
    }
  }
}

// A locked panel is held whole; of every other panel one vertex, since translations cost nothing.
void Derivation::hold_vertices(const Pattern& pattern) {
  held_.assign(static_cast<std::size_t>(mesh_.vertex_count()), false);
  for (std::size_t p = 0; p < mesh_.panels.size(); ++p) {
    const PanelRange& range = mesh_.panels[p];
    if (pattern.panels[p].locked) std::fill(held_.begin() + range.vertex_begin, held_.begin() + range.vertex_end, true);
    const auto& outline = mesh_.edge_vertices[p];
    held_[static_cast<std::size_t>(outline.empty() ? range.vertex_begin : outline[0].front())] = true;
  }
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
      held_pull_.row(row) -= value * mesh_.rest.row(w);
    else if (row >= col)
      entries.emplace_back(row, col, value);
  };
  for (int f = 0; f < mesh_.triangle_count(); ++f) {
    const Eigen::Matrix<double, 3, 2> weights = gradients_.corner_weights(f);
    const Mat3 local = gradients_.area[f] * weights * weights.transpose();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) add(mesh_.triangles(f, i), mesh_.triangles(f, j), local(i, j));
  }
  for (const EdgeTerm& term : edges_.terms()) {  // kept in the pattern of non-zeros at weight 0: analysed once
    add(term.from, term.from, weight);
    add(term.to, term.to, weight);
    add(term.from, term.to, -weight);
    add(term.to, term.from, -weight);
  }
  SparseMatrix matrix(unknowns_, unknowns_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  matrix.makeCompressed();
  if (!solver_.factor(matrix))
    throw Error(
        ErrorCode::DerivationFailed, "garment",
        "the system of the target pattern is singular: a panel is in several pieces or its drape is not finite");
}

void Derivation::local_step() {
  for (int f = 0; f < mesh_.triangle_count(); ++f)
    turn(faces_[static_cast<std::size_t>(f)], gradients_.of(result_.rest, f));
  edges_.update(result_.rest);
}

void Derivation::global_step(double weight) {
  right_ = held_pull_;
  const auto add = [&](int v, const Vec2& value) {
    const int row = unknown_of_vertex_[static_cast<std::size_t>(v)];
    if (row >= 0) right_.row(row) += value.transpose();
  };
  for (int f = 0; f < mesh_.triangle_count(); ++f) {
    const Mat2 wanted = gradients_.area[f] * faces_[static_cast<std::size_t>(f)].wanted();
    const Eigen::Matrix<double, 3, 2> weights = gradients_.corner_weights(f);
    for (int i = 0; i < 3; ++i) add(mesh_.triangles(f, i), wanted * weights.row(i).transpose());
  }
  if (weight > 0.0)
    for (const EdgeTerm& term : edges_.terms()) {
      add(term.to, weight * term.wanted);
      add(term.from, -weight * term.wanted);
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
    sum += gradients_.area[f] *
           (gradients_.of(result_.rest, f) - faces_[static_cast<std::size_t>(f)].wanted()).squaredNorm();
  return sum;
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
    const double fit = fit_energy(), energy = fit + weight * edges_.energy(result_.rest);
    result_.sweeps.push_back({weight, energy, std::sqrt(fit / area), edges_.pair_residual(result_.rest)});
    if (energy <= kRelativeFloor * area || before - energy < options_.energy_drop * energy) return true;
    before = energy;
  }
  return false;
}

DerivePatternResult Derivation::run() {
  if (unknowns_ == 0) return result_;
  const auto left = [&] { return options_.max_sweeps - static_cast<int>(result_.sweeps.size()); };
  const bool constrained = !edges_.terms().empty() && options_.seam_weight > 0.0;
  // Starting with the final weight locks the seams where they are; so it grows, each stage starting from the last.
  result_.converged = run_stage(0.0, constrained ? std::min(left(), 40) : left());
  if (constrained)
    for (double weight = 10.0; weight <= options_.seam_weight * 1.000001; weight *= 10.0) {
      report(progress_, "derive", 1.0 - static_cast<double>(left()) / options_.max_sweeps);
      result_.converged = run_stage(weight, std::min(left(), 30));
    }
  finish();
  return std::move(result_);
}

void Derivation::finish() {
  result_.fit_residual = result_.sweeps.back().fit_residual;
  result_.seam_residual = edges_.side_residual(result_.rest);
  for (int f = 0; f < mesh_.triangle_count(); ++f)
    result_.flipped_triangles += gradients_.of(result_.rest, f).determinant() <= 0.0;
}

}  // namespace

DerivePatternResult derive_pattern(const Pattern& pattern, const PatternMesh& reference_mesh,
                                   const FittingMap& reference_fit, const Drape& target_drape,
                                   const DerivePatternOptions& options, Progress* progress) {
  assert(reference_fit.triangle_count() == reference_mesh.triangle_count());
  assert(target_drape.nodes.rows() == reference_mesh.node_count && options.max_sweeps >= 1);
  return Derivation(pattern, reference_mesh, reference_fit, target_drape, options, progress).run();
}

}  // namespace toile
