// SPDX-License-Identifier: GPL-3.0-or-later
// What colours mean in Toile's pictures.
#pragma once

#include "engine/render/image.h"

namespace toile {

inline constexpr Rgb kWhite{255, 255, 255};
inline constexpr Rgb kInk{35, 35, 40};          // outlines and text
inline constexpr Rgb kFaintInk{130, 130, 138};  // secondary lines
inline constexpr Rgb kSkin{205, 190, 178};      // bodies
inline constexpr Rgb kInsertion{70, 110, 235};  // cloth added
inline constexpr Rgb kRemoval{225, 60, 50};     // cloth taken away

// Signed stretch as colour: blue at -scale and below, green at 0, red at +scale and above, with cyan and yellow half
// way. `scale` > 0, dimensionless; a value that is not finite is grey.
Rgb stretch_colour(double stretch, double scale);

// A colour that tells panel `index` from its neighbours; repeats after 12.
Rgb panel_colour(int index);

// (1 - t) a + t b, t in 0..1.
Rgb mix(Rgb a, Rgb b, double t);

}  // namespace toile
