// SPDX-License-Identifier: GPL-3.0-or-later
// How far each triangle of cloth is stretched, compressed and sheared when worn.
//
// F = Ds Dm^-1 = [Fu Fv] maps the flat triangle to the drape; its tensor in the tangent frame e1 = Fu/|Fu|,
// n = Fu x Fv / |Fu x Fv|, e2 = n x e1 is [[|Fu|, |Fv| sin s], [0, |Fv| cos s]], s the shear angle.
// Tensors are those of the triangles, which the derivation reproduces; stretch and shear, which are shown and compared,
// are recovered from their neighbours' (recover_stretch.h).
// Source: [Eggler2024, Sec. 4]. Lengths in metres; stretch dimensionless; shear in radians.
#pragma once

#include "engine/core/drape.h"
#include "engine/core/fitting_map.h"
#include "engine/core/pattern_mesh.h"

namespace toile {

// Requires: drape.nodes has mesh.node_count rows, all finite. A triangle whose drape has no usable tangent frame gets
// the tensor of the polar frame (symmetric part of F) and is marked degenerate. Throws GarmentInvalid when a triangle
// of the flat mesh is inverted or has no area.
FittingMap build_fitting_map(const PatternMesh& mesh, const Drape& drape);

// The same against other flat positions (#V x 2, m) of the same pattern vertices, for example a target pattern.
FittingMap build_fitting_map(const PatternMesh& mesh, const Points2& rest, const Drape& drape);

// The map of given tensors (#F) in the tangent frame, [[a, b], [0, c]] with a, c > 0. Throws as above.
FittingMap fitting_map_of(const PatternMesh& mesh, std::vector<Mat2> tensors);

// The tensor of one deformation gradient; false where the frame is not usable and the polar frame stands in for it.
bool fitting_tensor(const Mat32& gradient, Mat2& tensor);

}  // namespace toile
