// SPDX-License-Identifier: GPL-3.0-or-later
// Proportions of the human body for mannequins, in thousandths of body height.
//
// Provenance: distances from the body's axis to the skin, measured along fixed rays on the fourteen adult bodies of
// ../shared (MakeHuman assets, CC0, and the bodies of GarmentCode, MIT), reduced to a mean and its linear change with
// sex and fatness by least squares, and rounded. No vertex of those bodies is kept.
#pragma once

#include <array>
#include <cstdint>

namespace toile::mannequin_tables {

template <int Rows, int Columns>
using Table = std::array<std::array<std::int16_t, Columns>, Rows>;

template <int Rows, int Columns>
struct Fan {
  Table<Rows, Columns> mean, sex, fatness;  // radius = mean + sex * .. + fatness * ..
};

extern const Fan<9, 9> kTrunk;     // rows of MannequinCage::trunk
extern const Fan<4, 9> kShoulder;  // the first four rows of MannequinCage::shoulder
extern const Table<10, 10> kLeg;   // rows of MannequinCage::leg
extern const Table<10, 9> kHead;   // rows of MannequinCage::head, then the crown

}  // namespace toile::mannequin_tables
