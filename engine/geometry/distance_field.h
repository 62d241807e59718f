// SPDX-License-Identifier: GPL-3.0-or-later
// Signed distance to a body as the cloth meets it: negative inside, once continuously differentiable. Metres.
#pragma once

#include <memory>

#include "engine/core/types.h"
#include "engine/geometry/closest_point.h"

namespace toile {

// What contact needs to know of an obstacle. `evaluate` is not const: a field may compute itself where it is visited;
// the same visits in the same order give the same bytes. One field serves one thread at a time.
class SignedField {
 public:
  virtual ~SignedField() = default;

  // Signed distance and its gradient at p. Where the distance is beyond `reach`, any value in between may be returned
  // (a lower bound > reach), with an undefined gradient.
  virtual double evaluate(const Vec3& p, double reach, Vec3& gradient) = 0;

  // The same for a point that is asked for again and again while it moves little. `hint` is its memory, 0 at first and
  // only of use to this field; the answer does not depend on it.
  virtual double evaluate_again(const Vec3& p, double reach, Vec3& gradient, std::int32_t& hint);
  // That point will be asked for soon: its memory may be fetched.
  virtual void prepare(std::int32_t) const {}

  // Second derivatives at p, 1/m, where evaluate() gives the distance itself. Here by central differences of the
  // gradient, good to about 1e-6 of their size.
  virtual Mat3 hessian(const Vec3& p);
};

// Exact field of an endless upright cylinder about the y axis.
class CylinderField : public SignedField {
 public:
  explicit CylinderField(double radius) : radius_(radius) {}
  double evaluate(const Vec3& p, double reach, Vec3& gradient) override;
  Mat3 hessian(const Vec3& p) override;

 private:
  double radius_;
};

// Exact field of a solid of revolution about the y axis with radius R(y) = base + height exp(-((y - middle) /
// width)^2), distances taken along the horizontal radius over the slope: exact to first order at the surface.
class BellyField : public SignedField {
 public:
  BellyField(double base, double height, double middle, double width)
      : base_(base), height_(height), middle_(middle), width_(width) {}
  double evaluate(const Vec3& p, double reach, Vec3& gradient) override;

 private:
  double base_, height_, middle_, width_;
};

struct SurfaceFieldOptions {
  double spacing = 0.006;  // of the lattice, m; error about spacing^2 / (8 R) on a surface of radius R
  std::array<double, 2> coarse_spacings = {0.048, 0.012};  // of the lattices that tell where nothing is near, m
  double margin = 0.05;  // of the lattice round the surface, m; beyond it everything is far
};

// Field of a closed surface on a lattice that is filled node by node where it is visited: distance exact at the nodes,
// sign by the winding number (right where parts touch or cross), between the nodes a quadratic B-spline.
class SurfaceField : public SignedField {
 public:
  // Requires a closed, outward oriented surface. Throws Error{LimitExceeded} if it is too large for the spacing.
  explicit SurfaceField(const Points3& vertices, const Triangles& triangles, const SurfaceFieldOptions& options = {});
  ~SurfaceField() override;

  double evaluate(const Vec3& p, double reach, Vec3& gradient) override;
  double evaluate_again(const Vec3& p, double reach, Vec3& gradient, std::int32_t& hint) override;
  void prepare(std::int32_t hint) const override;
  Mat3 hessian(const Vec3& p) override;  // of the spline: exact, and constant along each axis within a cell

  // Computes what evaluate() will ask for at these points (#N x 3) where they are within `reach`, in two halves: an
  // idle thread of the job takes one. The same bytes with and without.
  void look_ahead(const Points3& points, double reach);

  int lattice_nodes_computed() const;
  const SurfaceTree& tree() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace toile
