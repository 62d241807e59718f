// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of a cloth's edges with a body, where that of its nodes does not do: fingers, toes and chins find their way
// between nodes that all lie outside. An edge whose middle was seen inside is kept out by its middle from then on:
//   E = 4 kc A f(-phi(middle)),  A the mean area of its ends, f and kc as in contact.h; firmer than nodes, since within
// a finger the field's slope is little.
// SI units.
#pragma once

#include "engine/sim/contact.h"

namespace toile {

class EdgeContact {
 public:
  // `field` must outlive the contact. Of the options, `stiffness` and `linear_beyond` count.
  EdgeContact(const Cloth& cloth, SignedField& field, const ContactOptions& options);

  // Takes up the edges whose middles lie inside at `nodes` (#N x 3). True if there are new ones: the energy changes,
  // evaluate again.
  bool look(const Points3& nodes);
  // Middles, at `nodes`, of the edges taken up that lie inside.
  std::vector<Vec3> inside(const Points3& nodes);
  int count() const { return static_cast<int>(kept_.size()); }  // of edges taken up

  // Adds the gradient (#N x 3, N) and returns the energy, J.
  double energy_gradient(const Points3& nodes, Points3& gradient);
  // Adds the second derivatives at `nodes`.
  void add_hessian(const Points3& nodes, Curvature curvature, BlockHessian& hessian);
  // Adds the diagonal of an upper bound of the Hessian, N/m.
  void add_stiffness(Eigen::VectorXd& diagonal) const;

 private:
  struct Edge {
    int a, b;
    double area;            // mean of its ends', m^2
    std::int32_t hint = 0;  // of the field
    bool kept = false;
    Vec3 looked_at = Vec3::Zero();  // where the middle was when it was last looked up ...
    double clear = 0.0;             // ... and so far from there, m, it is not inside
  };
  static constexpr double kFirmer = 4;
  static Vec3 middle(const Edge& edge, const Points3& nodes);
  // Depth of the middle, with the field's gradient there; 0 or less outside.
  double depth(Edge& edge, const Points3& nodes, Vec3& normal);
  double stiffness(const Edge& edge) const { return kFirmer * options_.stiffness * edge.area; }
  Edge& edge(int k) { return edges_[static_cast<std::size_t>(k)]; }

  SignedField& field_;
  ContactOptions options_;
  std::vector<Edge> edges_;
  std::vector<int> kept_;  // of edges_
};

}  // namespace toile
