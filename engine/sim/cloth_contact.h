// SPDX-License-Identifier: GPL-3.0-or-later
// Cloth against cloth. A refresh looks at which nodes and triangles, and which pairs of edges, are near each other.
// Until the next one
//   repulsion  drives layers apart that are closer than the thickness (layer_pairs.h),
//   planes     half-way between the closest points found may not be crossed by the nodes of the pair, and no node may
//              move further than half the reach: together no pair can pass through each other, however large the step,
//   untangling where an edge pierces a triangle already, both are drawn along the direction that shortens the line of
//              intersection [Volino2006]; pairs close by have no known sides and are left free.
// Planes and reach also keep every pair that was not listed further apart than the thickness: a refresh does not change
// the energy of layers that do not pierce each other.
// Pairs are found by patches (cloth_patches.h): smooth cloth costs next to nothing. SI units.
#pragma once

#include <limits>

#include "engine/core/pattern_mesh.h"
#include "engine/sim/cloth.h"
#include "engine/sim/cloth_features.h"
#include "engine/sim/cloth_patches.h"
#include "engine/sim/half_cloth.h"
#include "engine/sim/layer_pairs.h"
#include "engine/sim/node_planes.h"

namespace toile {

struct ClothContactOptions {
  double thickness = 0.0015;    // d, gap at which layers begin to repel, m, > 0
  double stiffness = 4e5;       // k, N/m^3, > 0: of the repulsion where it begins; softer layers are pinched in folds
                                // until their gap, hence the step, is nothing
  double push = 0.002;          // how far one refresh wants to draw a piercing pair, m
  double push_stiffness = 1e7;  // N/m^3: as firm as the cloth itself; legs sewn through each other stay so below 4e5
  const NodeMirror* mirror = nullptr;  // must outlive the contact; not null: nodes are symmetric, and so are the limits
  // Must outlive the contact; not null: nodes everywhere are those of this half, which also touches the other one.
  const HalfCloth* half = nullptr;
};

class ClothContact {
 public:
  // `cloth`, the whole of it, must outlive this; `mesh` need not.
  ClothContact(const Cloth& cloth, const PatternMesh& mesh, const ClothContactOptions& options);

  // Finds the pairs at `nodes` (#N x 3). True where cloth is or was pierced: the energy changes, evaluate again.
  bool refresh(const Points3& nodes);

  // Lets layers swell that are pressed together (layer_pairs.h): the energy changes with the next refresh.
  void swell(const Points3& nodes);

  // Forces between layers as found by the last refresh, of the whole cloth.
  const LayerPairs& pairs() const { return pairs_; }
  // Theirs; see LayerPairs.
  double energy_gradient(const Points3& nodes, Points3& gradient);
  void add_stiffness(const Points3& nodes, std::vector<Eigen::Triplet<double>>& entries);
  // Fixes their closest points and directions, until the next refresh.
  void hold(const Points3& nodes) { pairs_.hold(whole(nodes)); }

  // Shortens the moves from `from`, where all planes hold, to `to` so that they still hold; no node goes further than
  // `longest`, m. False: all did. Where nothing can have come near a limit, no node is looked at.
  bool limit(const Points3& from, Points3& to, double longest = std::numeric_limits<double>::infinity());
  // Some node was stopped for want of knowledge about what lies ahead: refresh soon.
  bool stale() const { return stale_; }
  // Some node was stopped by the plane of a pair.
  bool hindered() const { return hindered_; }
  // Whether some node is further than `distance` (m) from where it was at the last refresh. `nodes`: last limited.
  bool moved_beyond(double distance, const Points3& nodes);
  double reach() const { return reach_; }  // within which the last refresh looked for pairs, m

  int piercings() const { return static_cast<int>(piercings_.size()); }
  double tangle() const;                          // piercings per triangle of the cloth that moves
  static constexpr double kTangled = 0.1;         // worn and transported garments have under 0.01
  int planes() const { return planes_.count(); }  // 0: nothing is within reach

 private:
  struct PiercedTriangle {
    int edge, triangle;
    double s;
    Vec3 barycentric;
  };

  const Points3& whole(const Points3& nodes);
  void leave_out_other_half();
  bool keep_within(double ball, Points3& to);  // of where nodes were seen; false: all were
  void find_near(const Points3& nodes);
  void find_involved();
  void find_piercings(const Points3& nodes);
  void mark_around_piercings();
  void find_vertex_pairs(const Points3& nodes, int f, int g);
  void find_edge_pairs(const Points3& nodes, int f, int g);
  double swelling(const LayerPair& pair, const std::array<double, 4>& weight) const;
  void add_planes(const LayerPair& pair, double distance, double along);
  void add_plane(int node, const Vec3& normal, double offset);
  template <class Distance>
  double thickness_of(int f, int g, Distance distance_at_rest) const;
  void add_push(const Points3& nodes, const PiercedTriangle& piercing);
  Vec3 shortening(const Points3& nodes, const PiercedTriangle& piercing) const;
  bool unfolded(int f, int g) const;
  int corner(int triangle, int k) const { return features_.triangles(triangle, k); }

  const Cloth& cloth_;
  ClothContactOptions options_;
  ClothFeatures features_;
  Points2 rest_centre_;  // #T x 2, m
  ClothPatches patches_;

  // What counts of a vertex' or an edge's pairs: 1; of the half's garment half on the middle, none on the other side.
  std::vector<double> vertex_share_, edge_share_;
  Points3 whole_, forces_;  // #N x 3 of the half's garment

  double reach_;
  Points3 seen_at_;     // #N x 3, of the last refresh
  double moved_ = 0.0;  // upper bound of the moves since, m
  bool fresh_ = false, stale_ = false, hindered_ = false;
  std::vector<TriangleBox> boxes_;         // per triangle, of those involved
  Points3 centre_, normal_;                // the same
  std::vector<std::pair<int, int>> near_;  // pairs of triangles within reach_
  std::vector<int> involved_;              // triangles of those that patches_ finds near, ascending
  std::vector<PiercedTriangle> piercings_;
  std::vector<char> marked_;  // nodes near a piercing
  LayerPairs pairs_;
  Points3 swelling_;  // #N x 3, m
  bool swollen_ = false;
  NodePlanes planes_;
};

}  // namespace toile
