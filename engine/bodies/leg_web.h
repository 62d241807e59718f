// SPDX-License-Identifier: GPL-3.0-or-later
// Skin between the legs that a scanner has invented: where thighs are close together no camera sees how far up the gap
// between them goes, and reconstruction joins them by a web, up to centimetres under the crotch.
//
// The bottom of a fold is not believed where, 15 mm out from it, the skin at both sides is less than 30 mm apart: all
// that could see it comes through a right angle. Walls of the fold are kept; they are seen from across.
// Judged on imitated scans whose truth is known: of the vertices between the legs that lie over 4 mm off the body this
// finds about seven in ten, at the cost of some thirty good ones deep in the fold of a scan. Metres, normalised frame.
#pragma once

#include "engine/core/body.h"

namespace toile {

// The surface without such skin; models, which are exact in folds too (surface_roughness tells them), as they are.
TriangleMesh without_leg_web(const TriangleMesh& scan);

}  // namespace toile
