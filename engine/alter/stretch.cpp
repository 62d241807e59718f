// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/stretch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/units.h"

namespace toile {
namespace {

constexpr double kAttachment = 1e3;                // weight of sliding sides, relative to the membrane
constexpr double kProximal = 1e-6;                 // of the diagonal: holds cloth that nothing else holds
constexpr double kShear = 5.0 * kRadianPerDegree;  // kept pieces are isometric only if shear is held too
const double kSineOfShear = std::sin(kShear);
constexpr double kQuarter = 0.5 * std::numbers::pi;

Mat2 edges_to(const Sheet& sheet, const std::array<int, 3>& face, Vec2 SheetVertex::*where) {
  const auto at = [&](int i) -> const Vec2& {
    return sheet.vertices[static_cast<std::size_t>(face[static_cast<std::size_t>(i)])].*where;
  };
  Mat2 edges;
  edges.col(0) = at(1) - at(0);
  edges.col(1) = at(2) - at(0);
  return edges;
}

Vec2 turned(const Vec2& v, double angle) {
  return Eigen::Rotation2Dd(angle) * v;
}

// Nearest gradient whose fibres have the lengths `length` and stand within the shear limit of a right angle.
Mat2 fibre_projection(const Mat2& gradient, const Vec2& length) {
  Vec2 u = gradient.col(0), v = gradient.col(1);
  if (u.norm() < 1e-9) u = Vec2(v.y(), -v.x());
  if (v.norm() < 1e-9) v = Vec2(-u.y(), u.x());
  if (u.norm() < 1e-9) return Mat2(length.asDiagonal());
  u.normalize();
  v.normalize();
  Mat2 shape;
  shape.col(0) = u * length[0];
  shape.col(1) = v * length[1];
  const double across = u.x() * v.y() - u.y() * v.x(), along = u.dot(v);
  if (across <= 0.0 || std::abs(along) > kSineOfShear) {  // beyond the shear limit: both fibres turn back half each
    const double angle = std::atan2(across, along);
    const double back = 0.5 * (angle - std::clamp(angle, kQuarter - kShear, kQuarter + kShear));
    shape.col(0) = turned(shape.col(0), back);
    shape.col(1) = turned(shape.col(1), -back);
  }
  const Mat2 moment = gradient * shape.transpose();
  const double c = moment.trace(), s = moment(1, 0) - moment(0, 1), norm = std::sqrt(c * c + s * s);
  if (norm < 1e-12) return shape;
  return (Mat2() << c, -s, s, c).finished() / norm * shape;
}

// Cloth may shrink as the plain map has it and never grows; what is folded takes any width.
Vec2 wanted_lengths(const Mat2& guide, bool folded) {
  const Vec2 length = guide.colwise().norm().transpose();
  return length.cwiseMin(folded ? 5.0 : 1.0).cwiseMax(0.2);
}

class Relaxation {
 public:
  Relaxation(Sheet& sheet, double hold, SparseSolver& solver) : sheet_(sheet), solver_(solver) {
    const std::size_t count = sheet.faces.size();
    inverse_.resize(count);
    area_.resize(count);
    length_.resize(count);
    hold_.assign(sheet.vertices.size(), 0.0);
    for (std::size_t f = 0; f < count; ++f) {
      const Mat2 flat = edges_to(sheet, sheet.faces[f], &SheetVertex::flat);
      inverse_[f] = flat.inverse();
      area_[f] = 0.5 * flat.determinant();
      const Mat2 guide = edges_to(sheet, sheet.faces[f], &SheetVertex::guide) * inverse_[f];
      length_[f] = wanted_lengths(guide, sheet.folded[f]);
      for (const int v : sheet.faces[f]) hold_[static_cast<std::size_t>(v)] += hold * area_[f] / 3.0;
    }
    add_membrane();
  }

  void renew();
  double sweep();  // returns the energy before the step

 private:
  void add_membrane();
  Mat2 gradient(std::size_t f) const { return edges_to(sheet_, sheet_.faces[f], &SheetVertex::now) * inverse_[f]; }
  void add(int row, int col, double value) {
    if (row >= col) entries_.emplace_back(row, col, value);
  }

  Sheet& sheet_;
  std::vector<Mat2> inverse_;
  std::vector<double> area_;
  std::vector<Vec2> length_;
  std::vector<Eigen::Triplet<double>> entries_;
  std::size_t membrane_entries_ = 0;
  double proximal_ = 0.0;
  std::vector<double> hold_;  // per vertex
  struct Pull {
    int vertex;
    Vec2 normal;
    double offset;  // n.c
  };
  std::vector<Pull> pulls_;
  SparseSolver& solver_;
  Eigen::MatrixXd right_, solution_;
};

void Relaxation::add_membrane() {
  double diagonal = 0.0;
  for (std::size_t f = 0; f < sheet_.faces.size(); ++f) {
    Eigen::Matrix<double, 3, 2> weights;
    weights.row(1) = inverse_[f].row(0);
    weights.row(2) = inverse_[f].row(1);
    weights.row(0) = -(weights.row(1) + weights.row(2));
    const Mat3 local = area_[f] * weights * weights.transpose();
    diagonal += local.trace();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 2; ++k)
          add(2 * sheet_.faces[f][static_cast<std::size_t>(i)] + k,
              2 * sheet_.faces[f][static_cast<std::size_t>(j)] + k, local(i, j));
  }
  proximal_ = kProximal * diagonal / std::max(1, sheet_.vertex_count());
  for (int i = 0; i < 2 * sheet_.vertex_count(); ++i) add(i, i, proximal_ + hold_[static_cast<std::size_t>(i / 2)]);
  membrane_entries_ = entries_.size();
}

// New feet and normals of everything attached, and the factorisation that goes with them.
void Relaxation::renew() {
  pulls_.clear();
  entries_.resize(membrane_entries_);
  for (int v = 0; v < sheet_.vertex_count(); ++v) {
    const SheetVertex& vertex = sheet_.vertices[static_cast<std::size_t>(v)];
    for (const SheetAnchor& anchor : vertex.anchors) {
      const bool on = anchor.side >= 0 && anchor.attached;
      const SideFoot foot =
          on ? sheet_.wanted_sides[static_cast<std::size_t>(anchor.side)].closest(vertex.now) : SideFoot{};
      if (on) pulls_.push_back({v, foot.normal, foot.normal.dot(foot.point)});
      // Zero entries of what hangs free keep the pattern of non-zeros, so that it is analysed once.
      if (anchor.side < 0) continue;
      add(2 * v, 2 * v, kAttachment * foot.normal.x() * foot.normal.x());
      add(2 * v + 1, 2 * v, kAttachment * foot.normal.x() * foot.normal.y());
      add(2 * v + 1, 2 * v + 1, kAttachment * foot.normal.y() * foot.normal.y());
    }
  }
  SparseMatrix matrix(2 * sheet_.vertex_count(), 2 * sheet_.vertex_count());
  matrix.setFromTriplets(entries_.begin(), entries_.end());
  matrix.makeCompressed();
  if (!solver_.factor(matrix))
    throw Error(ErrorCode::AlterationFailed, "panel:#" + std::to_string(sheet_.panel),
                "the stretched cloth has no stable position; mesh the panel again or look for empty triangles");
}

double Relaxation::sweep() {
  right_.setZero(2 * sheet_.vertex_count(), 1);
  double energy = 0.0;
  for (std::size_t f = 0; f < sheet_.faces.size(); ++f) {
    const Mat2 now = gradient(f), wanted = fibre_projection(now, length_[f]);
    energy += area_[f] * (now - wanted).squaredNorm();
    const Mat2 pull = area_[f] * wanted * inverse_[f].transpose();  // columns: corners 1 and 2
    for (int k = 0; k < 2; ++k) {
      right_(2 * sheet_.faces[f][1] + k) += pull(k, 0);
      right_(2 * sheet_.faces[f][2] + k) += pull(k, 1);
      right_(2 * sheet_.faces[f][0] + k) -= pull(k, 0) + pull(k, 1);
    }
  }
  for (const Pull& pull : pulls_)
    for (int k = 0; k < 2; ++k) right_(2 * pull.vertex + k) += kAttachment * pull.normal[k] * pull.offset;
  for (int v = 0; v < sheet_.vertex_count(); ++v) {
    const SheetVertex& vertex = sheet_.vertices[static_cast<std::size_t>(v)];
    const Vec2 pull = proximal_ * vertex.now + hold_[static_cast<std::size_t>(v)] * vertex.guide;
    for (int k = 0; k < 2; ++k) right_(2 * v + k) += pull[k];
  }
  solution_.resize(right_.rows(), 1);
  solver_.solve_into(right_, solution_);
  for (int v = 0; v < sheet_.vertex_count(); ++v)
    sheet_.vertices[static_cast<std::size_t>(v)].now = Vec2(solution_(2 * v), solution_(2 * v + 1));
  return energy;
}

Vec2 extent_of(const Sheet& sheet) {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const SheetVertex& vertex : sheet.vertices) {
    low = low.cwiseMin(vertex.flat);
    high = high.cwiseMax(vertex.flat);
  }
  return high - low;
}

}  // namespace

Mat2 sheet_gradient(const Sheet& sheet, std::size_t face) {
  return edges_to(sheet, sheet.faces[face], &SheetVertex::now) *
         edges_to(sheet, sheet.faces[face], &SheetVertex::flat).inverse();
}

Mat2 guide_gradient(const Sheet& sheet, std::size_t face) {
  return edges_to(sheet, sheet.faces[face], &SheetVertex::guide) *
         edges_to(sheet, sheet.faces[face], &SheetVertex::flat).inverse();
}

void relax(Sheet& sheet, const RelaxOptions& options, Progress* progress, SparseSolver* solver) {
  if (sheet.faces.empty()) return;
  SparseSolver own;
  Relaxation relaxation(sheet, options.hold, solver ? *solver : own);
  const double floor = options.energy_floor * measure_stress(sheet, 0.0).area;
  double before = std::numeric_limits<double>::infinity();
  for (int renewal = 0; renewal < options.max_renewals; ++renewal) {
    check_cancelled(progress);
    relaxation.renew();
    double energy = 0.0;
    for (int i = 0; i < options.sweeps; ++i) energy = relaxation.sweep();
    // Not the change of one renewal alone: the first may raise the energy while the cloth comes onto its sides.
    if (renewal > 0 && (energy < floor || std::abs(before - energy) < options.energy_drop * energy)) break;
    before = energy;
  }
}

SheetStress measure_stress(const Sheet& sheet, double limit) {
  SheetStress stress;
  using Strains = std::vector<std::pair<double, double>>;  // value, area
  Strains tension;
  std::array<Strains, 2> along;  // weft, warp
  for (std::size_t f = 0; f < sheet.faces.size(); ++f) {
    if (sheet.folded[f]) continue;
    const double area = 0.5 * edges_to(sheet, sheet.faces[f], &SheetVertex::flat).determinant();
    const Mat2 now = sheet_gradient(sheet, f);
    const Vec2 length = wanted_lengths(guide_gradient(sheet, f), false);
    stress.energy += area * (now - fibre_projection(now, length)).squaredNorm();
    stress.area += area;
    tension.emplace_back(now.colwise().norm().maxCoeff() - 1.0, area);
    for (int k = 0; k < 2; ++k) along[static_cast<std::size_t>(k)].emplace_back(now.col(k).norm() - 1.0, area);
  }
  const auto percentile = [&](Strains& strains, double share) {
    std::sort(strains.begin(), strains.end());
    double below = 0.0;
    for (const auto& [value, area] : strains)
      if ((below += area) >= share * stress.area) return value;
    return 0.0;
  };
  stress.p95 = percentile(tension, 0.95);
  stress.p98 = percentile(tension, 0.98);
  const Vec2 extent = extent_of(sheet);
  for (int k = 0; k < 2; ++k)
    stress.way = std::max(stress.way, extent[k] * percentile(along[static_cast<std::size_t>(k)], 0.95));
  for (const auto& [value, area] : tension)
    if (value > limit) stress.over += area;
  if (stress.area > 0.0) stress.over /= stress.area;
  return stress;
}

}  // namespace toile
