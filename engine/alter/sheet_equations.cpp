// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/sheet_equations.h"

#include <algorithm>
#include <cassert>

#include "engine/alter/sheet_fibres.h"
#include "engine/alter/stretch.h"
#include "engine/core/error.h"

namespace toile {
namespace {

constexpr double kAttachment = 1e3;  // weight of sliding sides, relative to the membrane
constexpr double kProximal = 1e-6;   // of the diagonal: holds cloth that nothing else holds
constexpr double kLoose = 0.01;      // least stiffness of attachments, of an attached vertex, below which cloth slides
// Times the hold for cloth that slides: else it comes to lie aside, where it is bent least.
constexpr double kFirmer = 10.0;
// How stiff long cloth is to shear within the limit, relative to stretch: free shear would let a trouser leg lean as
// far as the limit allows, a hand's breadth at the hem, where letting a side go upright costs hardly any stretch. Short
// cloth leans little, and what is sewn on fewer than two sides leans without taking other panels along: there free
// shear spares cuts.
constexpr double kShear = 1.0;
constexpr double kShort = 0.5, kLong = 0.6;  // m

double shear_stiffness(const Sheet& sheet) {
  const auto sewn =
      std::count_if(sheet.sides.begin(), sheet.sides.end(), [](const PanelSide& side) { return side.sewn; });
  if (sewn < 2) return 0.0;
  return kShear * std::clamp((extent_of(sheet).maxCoeff() - kShort) / (kLong - kShort), 0.0, 1.0);
}

Mat2 flat_edges(const Sheet& sheet, const std::array<int, 3>& face) {
  const auto at = [&](std::size_t i) -> const Vec2& { return sheet.vertices[static_cast<std::size_t>(face[i])].flat; };
  Mat2 edges;
  edges << at(1) - at(0), at(2) - at(0);
  return edges;
}

}  // namespace

SheetEquations::SheetEquations(const Sheet& sheet, double hold)
    : shear_kept_(1.0 / (1.0 + shear_stiffness(sheet))), hold_(sheet.vertices.size(), 0.0), solver_(solver_of(sheet)) {
  held_.setZero(sheet.vertex_count(), 2);
  for (const Face& face : faces_)
    for (const int v : face.corner) hold_[static_cast<std::size_t>(v)] += hold * face.area / 3.0;
  for (int v = 0; v < sheet.vertex_count(); ++v) {
    const auto i = static_cast<std::size_t>(v);
    held_.row(v) = hold_[i] * sheet.vertices[i].guide.transpose();
  }
  ties_.resize(sheet.vertices.size());
  right_.resize(sheet.vertex_count(), 2);
  if (sheet.across) middle_ = middle_of(sheet);
}

// The sum of the plain map, and its weights.
SheetEquations::Middle SheetEquations::middle_of(const Sheet& sheet) const {
  Middle middle;
  middle.way.setZero(sheet.vertex_count(), 2);
  for (const Face& face : faces_)
    for (const int v : face.corner) middle.way.row(v) += face.area / 3.0 * sheet.across->transpose();
  middle.wanted = 0.0;
  for (int v = 0; v < sheet.vertex_count(); ++v)
    middle.wanted += middle.way.row(v).dot(sheet.vertices[static_cast<std::size_t>(v)].guide);
  return middle;
}

// Also fills the faces, which the links are made of.
PlaneSolver SheetEquations::solver_of(const Sheet& sheet) {
  std::vector<PlaneSolver::Link> links;
  double diagonal = 0.0;
  for (std::size_t f = 0; f < sheet.faces.size(); ++f) {
    const Mat2 flat = flat_edges(sheet, sheet.faces[f]);
    faces_.push_back({sheet.faces[f], flat.inverse(), 0.5 * flat.determinant(),
                      wanted_lengths(guide_gradient(sheet, f), sheet.folded[f])});
    const Face& face = faces_.back();
    area_ += face.area;
    Eigen::Matrix<double, 3, 2> weights;
    weights.row(1) = face.inverse.row(0);
    weights.row(2) = face.inverse.row(1);
    weights.row(0) = -(weights.row(1) + weights.row(2));
    const Mat3 local = face.area * weights * weights.transpose();
    diagonal += local.trace();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j)
        links.push_back(
            {face.corner[static_cast<std::size_t>(i)], face.corner[static_cast<std::size_t>(j)], local(i, j)});
  }
  proximal_ = kProximal * diagonal / std::max(1, sheet.vertex_count());
  return {sheet.vertex_count(), links};
}

void SheetEquations::start(const Sheet& sheet) {
  assert(sheet.vertices.size() == ties_.size() && sheet.faces.size() == faces_.size());
  now_.resize(sheet.vertex_count(), 2);
  for (int v = 0; v < sheet.vertex_count(); ++v)
    now_.row(v) = sheet.vertices[static_cast<std::size_t>(v)].now.transpose();
}

void SheetEquations::finish(Sheet& sheet) const {
  for (int v = 0; v < sheet.vertex_count(); ++v)
    sheet.vertices[static_cast<std::size_t>(v)].now = now_.row(v).transpose();
}

// Whether the attachments let all of the cloth slide along them, straight or round a bend: the least of their stiffness
// against shifts and turns of the whole.
bool SheetEquations::slides() const {
  if (pulls_.empty()) return true;
  const Vec2 middle = now_.colwise().mean();
  const double radius =
      std::sqrt((now_.rowwise() - middle.transpose()).squaredNorm() / static_cast<double>(now_.rows()));
  Mat3 stiffness = Mat3::Zero();
  for (const Pull& pull : pulls_) {
    const Vec2 arm = (now_.row(pull.vertex).transpose() - middle) / radius;
    const Vec3 way(pull.normal.x(), pull.normal.y(), arm.x() * pull.normal.y() - arm.y() * pull.normal.x());
    stiffness += way * way.transpose();
  }
  const double least = Eigen::SelfAdjointEigenSolver<Mat3>(stiffness, Eigen::EigenvaluesOnly).eigenvalues()[0];
  return least < kLoose * static_cast<double>(pulls_.size());
}

void SheetEquations::renew(const Sheet& sheet) {
  pulls_.clear();
  for (int v = 0; v < sheet.vertex_count(); ++v)
    for (const SheetAnchor& anchor : sheet.vertices[static_cast<std::size_t>(v)].anchors) {
      if (anchor.side < 0 || !anchor.attached) continue;
      const SideFoot foot = sheet.wanted_sides[static_cast<std::size_t>(anchor.side)].closest(now_.row(v).transpose());
      pulls_.push_back({v, foot.normal, foot.normal.dot(foot.point)});
    }
  const bool sliding = slides();
  firmness_ = sliding ? kFirmer : 1.0;
  for (std::size_t v = 0; v < ties_.size(); ++v) ties_[v] = (proximal_ + firmness_ * hold_[v]) * Mat2::Identity();
  for (const Pull& pull : pulls_)
    ties_[static_cast<std::size_t>(pull.vertex)] += kAttachment * pull.normal * pull.normal.transpose();
  if (!solver_.factor(ties_))
    throw Error(ErrorCode::AlterationFailed, "panel:#" + std::to_string(sheet.panel),
                "the stretched cloth has no stable position; mesh the panel again or look for empty triangles");
  if (!middle_) return;
  middle_->holds = sliding;
  if (!sliding) return;
  middle_->answer.resize(now_.rows(), 2);
  solver_.solve(middle_->way, middle_->answer);
  middle_->given = middle_->way.cwiseProduct(middle_->answer).sum();
}

Mat2 SheetEquations::gradient(const Face& face) const {
  const Vec2 a = now_.row(face.corner[0]);
  Mat2 edges;
  edges << now_.row(face.corner[1]).transpose() - a, now_.row(face.corner[2]).transpose() - a;
  return edges * face.inverse;
}

double SheetEquations::sweep() {
  right_ = firmness_ * held_ + proximal_ * now_;
  double energy = 0.0;
  for (const Face& face : faces_) {
    const Mat2 now = gradient(face), wanted = fibre_projection(now, face.length, shear_kept_);
    energy += face.area * (now - wanted).squaredNorm();
    const Mat2 pull = face.area * wanted * face.inverse.transpose();  // columns: corners 1 and 2
    right_.row(face.corner[1]) += pull.col(0).transpose();
    right_.row(face.corner[2]) += pull.col(1).transpose();
    right_.row(face.corner[0]) -= (pull.col(0) + pull.col(1)).transpose();
  }
  for (const Pull& pull : pulls_) right_.row(pull.vertex) += kAttachment * pull.offset * pull.normal.transpose();
  solver_.solve(right_, now_);
  if (middle_ && middle_->holds) {
    const double off = middle_->way.cwiseProduct(now_).sum() - middle_->wanted;
    now_ -= off / middle_->given * middle_->answer;
  }
  return energy;
}

}  // namespace toile
