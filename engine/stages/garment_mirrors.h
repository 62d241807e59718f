// SPDX-License-Identifier: GPL-3.0-or-later
// Which panels of a garment are mirror images as it is worn: left and right of a plane, or each of itself about its own
// axis. What find_panel_mirrors finds on the flat counts only where the worn garment agrees, so that a front is not
// taken for the image of a back of the same shape.  Source: [Eggler2024, Sec. 8, "Managing symmetry"].  Metres.
#pragma once

#include "engine/core/drape.h"
#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"

namespace toile {

struct PanelImage {
  int panel = -1;                      // where the mirror takes this panel, itself included; -1: no image
  Mat2 reflection = Mat2::Identity();  // of the flat plane: p_image = reflection * p + offset
  Vec2 offset = Vec2::Zero();
  std::vector<int> edge_of;  // edge of the image for every edge of this panel, walked the other way
};

struct GarmentMirrors {
  std::vector<PanelImage> panels;  // one per panel; the image of the image is the panel itself
  std::vector<int> vertex;         // #V, image of each pattern vertex; -1 where the mesh is not mirrored

  bool empty() const { return panels.empty(); }
  const PanelImage* image_of(int panel) const;  // null if there is none
};

// A plane a x + b y + c z = d of the world frame: (a, b, c, d), the normal of any length but zero.
using MirrorPlane = std::array<double, 4>;
inline constexpr MirrorPlane kMidPlane = {1, 0, 0, 0};

// Requires `worn` to be a drape of `mesh`, of `pattern`.
GarmentMirrors find_garment_mirrors(const Pattern& pattern, const PatternMesh& mesh, const Drape& worn,
                                    const MirrorPlane& plane = kMidPlane);

// Flat positions made exactly symmetric: the mean of each panel and its image, each about where it lies.
// Panels without mirrored meshes are left as they are.
void symmetrise(const PatternMesh& mesh, const GarmentMirrors& mirrors, Points2& rest);

// Forces on pattern vertices, or gradients by them, made symmetric in the same way: each becomes the mean over the two.
void symmetrise_forces(const PatternMesh& mesh, const GarmentMirrors& mirrors, Eigen::MatrixXd& forces);

}  // namespace toile
