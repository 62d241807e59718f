// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/wanted_gradients.h"

#include <algorithm>
#include <cmath>

namespace toile {
namespace {

// Singular values of the wanted tensor stay in this range, so that its inverse stays bounded [method, Sec. 1].
constexpr double kLeastStretch = 0.5, kMostStretch = 2.0;
constexpr int kNewtonSteps = 8;
constexpr double kAngleTolerance = 1e-8;  // rad; far below what a sweep moves, still told apart by the energy

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

// Cosine and sine of nearly `angle`, exactly on the unit circle: a Newton step need not be hit to the last digit.
Vec2 unit_turned_by(double angle) {
  const double t = 0.5 * angle, scale = 1 / (1 + t * t);
  return {(1 - t * t) * scale, 2 * t * scale};
}

double dot(const Mat2& a, const Mat2& b) {
  return a.cwiseProduct(b).sum();
}

}  // namespace

WantedGradients::WantedGradients(const FittingMap& reference, const FittingMap& target) {
  const Mat2 quarter = (Mat2() << 0, -1, 1, 0).finished();
  faces_.resize(reference.tensor.size());
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

double WantedGradients::energy(const Face& f, double c, double s, double p, double q) {
  return f.aa * c * c + f.bb * s * s + 2.0 * f.ab * c * s - 2.0 * (p * c + q * s);
}

// Newton steps on the angle, halved until the energy does not grow.
void WantedGradients::turn(int f, const Mat2& gradient) {
  Face& face = faces_[static_cast<std::size_t>(f)];
  const double p = dot(face.a, gradient), q = dot(face.b, gradient);
  double c = face.cosine, s = face.sine, best = energy(face, c, s, p, q);
  for (int i = 0; i < kNewtonSteps; ++i) {
    const double slope = 2.0 * ((face.bb - face.aa) * c * s + face.ab * (c * c - s * s) + p * s - q * c);
    const double bend = 2.0 * ((face.bb - face.aa) * (c * c - s * s) - 4.0 * face.ab * c * s + p * c + q * s);
    double step = bend > 0.0 ? -slope / bend : (slope > 0.0 ? -0.5 : 0.5);
    if (std::abs(step) < kAngleTolerance) break;
    step = std::clamp(step, -1.0, 1.0);
    double next_c = c, next_s = s, next = best;
    for (int halving = 0; halving < 8; ++halving, step *= 0.5) {
      const Vec2 turned = Mat2{{c, -s}, {s, c}} * unit_turned_by(step);
      next_c = turned[0];
      next_s = turned[1];
      next = energy(face, next_c, next_s, p, q);
      if (next <= best) break;
    }
    if (next > best) break;
    c = next_c;
    s = next_s;
    best = next;
  }
  const double length = std::hypot(c, s);  // products of many small turns drift off the unit circle
  face.cosine = c / length;
  face.sine = s / length;
}

Mat2 WantedGradients::wanted(int f) const {
  const Face& face = faces_[static_cast<std::size_t>(f)];
  return face.a * face.cosine + face.b * face.sine;
}

}  // namespace toile
