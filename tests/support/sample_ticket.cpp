// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/sample_ticket.h"

#include <numbers>

namespace toile::test {

namespace {

TicketOperation take_in() {
  TicketOperation operation;
  operation.kind = OperationKind::TakeIn;
  operation.where = "side seams left and right";
  operation.sides = {{"left_ftorso", {3, 4}, "side seam, front left"},
                     {"left_btorso", {1}, "side seam, back left"},
                     {"right_ftorso", {3, 4}, "side seam, front right"},
                     {"right_btorso", {1}, "side seam, back right"}};
  operation.per_ply = 0.012, operation.total = 0.048;
  operation.largest_at = "at the waist", operation.tapers_to = "at the hip", operation.taper_length = 0.16;
  operation.profile = {0.02, {0.002, 0.006, 0.01, 0.012, 0.012, 0.010, 0.008, 0.006, 0.004, 0.002, 0.001, 0.0}};
  operation.touches = {"zip"};
  operation.removed_area = 0.0061;
  operation.sentence =
      "Side seams left and right: take in 12 mm per ply (48 mm in all) at the waist, tapering to nothing at the hip, "
      "160 mm below.";
  return operation;
}

TicketOperation let_out() {
  TicketOperation operation;
  operation.kind = OperationKind::LetOut;
  operation.where = "centre back seam";
  operation.sides = {{"left_btorso", {5}, "centre back, left"}, {"right_btorso", {5}, "centre back, right"}};
  operation.per_ply = 0.003, operation.total = 0.006;
  operation.profile = {0.02, {0.003, 0.003, 0.003, 0.003}};
  operation.allowance = {0.01, 0.003, 0.007};
  operation.fabric = FabricNeed::WithinAllowance;
  operation.below_accuracy = true;
  operation.sentence = "Centre back seam: let out 3 mm per ply (6 mm in all) along its whole length.";
  return operation;
}

TicketOperation insert_strip() {
  TicketOperation operation;
  operation.kind = OperationKind::InsertStrip;
  operation.where = "hem <front> & back";
  operation.sides = {{"left_ftorso", {0}, "hem, front left"}};
  operation.per_ply = operation.total = 0.045;
  operation.profile = {0.02, {0.045, 0.045, 0.05, 0.045}};
  operation.allowance = {0.02, 0.045, -0.025};
  operation.fabric = FabricNeed::NeedsFabric;
  operation.pieces = {
      {"insertion_1", "sew to left_ftorso, edge 0", 0.31, 0.045, 0.01395, 12.0 * std::numbers::pi / 180, 0.01, 2}};
  operation.sentence = "Hem of front left: insert a strip of 310 x 45 mm; the seam allowance is 25 mm short.";
  return operation;
}

}  // namespace

Ticket sample_ticket() {
  Ticket ticket;
  ticket.garment = "shirt";
  ticket.reference_body = "mean", ticket.target_body = "tall";
  ticket.operations = {take_in(), let_out(), insert_strip()};
  ticket.notes = {"Check the length of the sleeve: 4 mm remain."};
  return ticket;
}

}  // namespace toile::test
