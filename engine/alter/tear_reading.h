// SPDX-License-Identifier: GPL-3.0-or-later
// Every tear of a pass read for itself: what it is to a tailor, how far it opens and where, what allowance there is.
// Used by read_operations only.   Lengths in metres.
#pragma once

#include "engine/alter/alter_pattern.h"
#include "engine/alter/tear_profile.h"

namespace toile {

struct TearReading {
  bool inserts = true;
  int panel = 0;
  Tear tear;
  int job = -1;  // tears of one number are one job for the person who sews
  OperationKind kind = OperationKind::TakeIn;
  FabricNeed fabric = FabricNeed::None;
  TicketAllowance allowance;
  TearProfile profile;
  std::vector<TearMouth> mouths;
  std::vector<std::string> names;        // of the side
  std::string mirror_name;               // the same for what lies on the left and on the right
  std::array<std::string, 2> end_words;  // where the profile starts and ends: "at the waist"
  std::vector<double> height;            // of every place of the profile as the panels are placed, m
  bool upright = false;                  // runs up rather than round the body
  bool cuts() const { return tear.kind == TearKind::Edge; }
};

// Tears that open next to nothing are left out, and panels for which `skip` holds.
std::vector<TearReading> read_tears(const Pattern& pattern, const TornPattern& torn, bool inserts,
                                    const AlterPatternOptions& options, const std::vector<bool>& skip);

// The same place summed over all plies: round the body for what runs up, over both plies of one seam for what runs
// round it. `members` are one operation.
double total_amount(const Pattern& pattern, const TornPattern& torn, const std::vector<TearReading>& members);

}  // namespace toile
