// SPDX-License-Identifier: GPL-3.0-or-later
// What pairs of cloth features do to each other. A vertex and a triangle, or two edges, of gap g repel each other when
// closer than their thickness d:
//   E = k A m d [ d ln(d / g) - (d - g) ],  below a floor of g continued as a parabola,
// with g the distance of their closest points wherever the nodes have gone, so that force does not jump where a closest
// point slides over a rim, nor when pairs are looked for anew. Closest points of parallel edges do jump: m fades the
// pair out towards parallel [Li2020]; the edges' ends have pairs of their own.
// Layers that are pressed together harder than the repulsion grows down to its floor swell, round by round, by what
// they lack to the floor: then they carry any pressure at that gap. Swelling is a vector per node, towards the side
// from which it is pressed; a pair is taken to be nearer by that of its closest points. Pushes draw pierced features
// along a fixed direction: E = k A min(0, n . (difference of points) - offset)^2 / 2. SI units.
#pragma once

#include "engine/sim/energy_hessian.h"

namespace toile {

struct LayerPair {
  enum class Kind : std::uint8_t { VertexTriangle, EdgeEdge };
  Kind kind = Kind::VertexTriangle;
  std::array<int, 4> node;  // vertex and corners of the triangle, or ends of one edge and of the other
  Vec3 normal;              // unit, from the second feature to the first when the pair was found
  double stiffness = 0.0;   // k A, N/m
  double thickness = 0.0;   // d, m
  double taken_up = 0.0;    // by which the pair is taken to be nearer than it is, m
};

struct LayerPush {
  std::array<int, 5> node;
  std::array<double, 5> weight;  // of the difference of points; 0 in unused places
  Vec3 normal;
  double stiffness = 0.0;  // k A, N/m
  double offset = 0.0;     // m
};

class LayerPairs {
 public:
  void clear();
  bool empty() const { return moving_.empty() && held_.empty() && pushes_.empty(); }
  void add(const LayerPair& pair, const Points3& nodes);
  void add(const LayerPush& push) { pushes_.push_back(push); }
  // Fixes closest points and directions as they are at `nodes`, until the next clear(): the Hessian is exact then.
  void hold(const Points3& nodes);

  // Adds the gradient (#N x 3, N) and returns the energy, J.
  double energy_gradient(const Points3& nodes, Points3& gradient) const;
  // Lets nodes swell by what the narrowest of their pairs lacks to the floor at `nodes`, or shrink by half of what it
  // exceeds it (#N x 3 each, m). Counts with the pairs added from then on. `image`, unless empty: node across x = 0 of
  // every node, which has the reflections of its pairs.
  void swell(const Points3& nodes, const std::vector<int>& image, Points3& swelling) const;

  // Adds the second derivatives but for those of the directions; never negative.
  void add_hessian(const Points3& nodes, BlockHessian& hessian) const;
  // Adds the lower triangle of the stiffness along the pairs' directions, N/m, as if it held for every coordinate.
  void add_stiffness(const Points3& nodes, std::vector<Eigen::Triplet<double>>& entries) const;

 private:
  struct Moving : LayerPair {
    double blunt = 0.0;  // edges: squared area spanned, below which they fade, m^4
  };
  struct Held {
    std::array<int, 4> node;
    std::array<double, 4> weight;
    Vec3 normal;
    double stiffness, thickness, taken_up;
  };
  // Closest points of a pair: weights of its nodes in their difference, its direction and length.
  struct Closest {
    std::array<double, 4> weight;
    Vec3 normal;
    double gap;
  };

  static bool beyond(const Moving& pair, const Points3& nodes);
  static Closest closest(const Moving& pair, const Points3& nodes);
  static double share(const Moving& pair, const Points3& nodes);  // m above
  static double add_moving(const Moving& pair, const Points3& nodes, Points3& gradient);
  template <class Visit>
  void visit_stiff(const Points3& nodes, Visit visit) const;

  std::vector<Moving> moving_;
  std::vector<Held> held_;
  std::vector<LayerPush> pushes_;
};

}  // namespace toile
