// SPDX-License-Identifier: GPL-3.0-or-later
// The tailor's work order (design: service contract, section 5). engine/alter fills it; engine/io writes ticket.json,
// ticket.html and the report from it. Lengths in metres, areas in square metres; the documents say millimetres.
#pragma once

#include <string_view>

#include "engine/core/types.h"

namespace toile {

enum class OperationKind {
  TakeIn,
  LetOut,
  Shorten,
  Lengthen,
  InsertStrip,
  InsertGusset,
  InsertGodet,
  DartNew,
  DartDeepen,
  CutAnew,  // whole panels that cannot be pieced
};
std::string_view operation_name(OperationKind kind);   // "take_in", ..., as in ticket.json
std::string_view operation_words(OperationKind kind);  // "take in", ..., as in a sentence

// The edges of one panel that an operation works on: one ply of its seam.
struct TicketSide {
  std::string panel;
  std::vector<int> edges;  // of the original pattern, in order
  std::string words;       // "side seam, front left"
  double amount = 0.0;     // largest on this ply
};

// Amounts along the seam: amounts[i] holds at i * spacing from the start; the last one at the end of the operation.
struct TicketProfile {
  double spacing = 0.02;
  std::vector<double> amounts;  // per ply, >= 0
};

enum class FabricNeed {
  None,             // nothing is let out
  WithinAllowance,  // the seam allowance gives it
  NeedsFabric,      // it does not
};
std::string_view fabric_need_name(FabricNeed need);  // "none", "within_allowance", "needs_fabric"

struct TicketAllowance {
  double available = 0.0, needed = 0.0, left = 0.0;  // left = available - needed, may be negative
};

// A piece of cloth to cut anew.
struct TicketPiece {
  std::string name;                  // as in the drawings: "insertion_1"
  std::string label;                 // printed on it
  double width = 0.0, length = 0.0;  // of the narrowest box round it, without seam allowance
  double area = 0.0;                 // without seam allowance
  double grain_angle = 0.0;          // of its grainline against that of the panel it joins, rad
  double seam_allowance = 0.0;
  int quantity = 1;
};

struct TicketOperation {
  OperationKind kind = OperationKind::TakeIn;
  std::string where;              // human words: "side seams left and right"
  std::vector<TicketSide> sides;  // every ply, left and right
  double per_ply = 0.0;           // largest amount on one ply, >= 0
  double total = 0.0;             // the same place summed over all plies, >= 0
  std::string largest_at;         // where along the seam: "at the waist"
  std::string tapers_to;          // where it ends in nothing: "at the hip"; empty: it keeps its amount
  double taper_length = 0.0;      // from the largest amount to nothing
  double least = 0.0;             // least amount on the ply that has the largest
  std::string least_at;           // where that is, if it neither keeps its amount nor tapers to nothing
  TicketProfile profile;
  TicketAllowance allowance;
  FabricNeed fabric = FabricNeed::None;
  std::vector<TicketPiece> pieces;
  int with_step = 0;  // number of the operation whose pieces hold what this one adds or takes away; 0: it has its own
  double removed_area = 0.0;
  std::vector<std::string> touches;  // "zip", "pocket", "hem of panel front_left", ...
  bool below_accuracy = false;       // smaller than what a body can be measured to (ISO 20685-1)
  std::string sentence;              // all of it in one line for the person who sews
};

struct Ticket {
  std::string garment, reference_body, target_body;
  std::vector<TicketOperation> operations;  // in the order of work
  std::vector<std::string> notes;           // what to check, what could not be done and why
};

}  // namespace toile
