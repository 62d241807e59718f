// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/operation_words.h"

#include <gtest/gtest.h>

namespace toile {
namespace {

TEST(SpokenList, MirrorImagesAreSaidTogether) {
  EXPECT_EQ(spoken_list({"left side", "right side"}), "left and right side");
  EXPECT_EQ(spoken_list({"right side", "left side", "right side"}), "left and right side");
  EXPECT_EQ(spoken_list({"seam of pant b l and pant f l", "seam of pant b r and pant f r"}),
            "seam of pant b and pant f, left and right");
  EXPECT_EQ(spoken_list({"left_sleeve", "right_sleeve"}), "sleeve, left and right");
}

TEST(SpokenList, NamesAreJoinedSoThatTheyStayApart) {
  EXPECT_EQ(spoken_list({}), "");
  EXPECT_EQ(spoken_list({"waist", "waist"}), "waist");
  EXPECT_EQ(spoken_list({"left neckline"}), "left neckline");
  EXPECT_EQ(spoken_list({"waist", "hem", "outseam"}), "waist, hem and outseam");
  EXPECT_EQ(spoken_list({"left side", "right side", "underarm"}), "left and right side; underarm");
}

TicketOperation strip() {
  TicketOperation operation;
  operation.kind = OperationKind::InsertStrip;
  operation.where = "left and right side";
  operation.sides = {{"front", {1}, "left side", 0.034}, {"back", {2}, "left side", 0.033}};
  operation.per_ply = 0.034, operation.total = 0.135;
  operation.largest_at = "at the waist";
  operation.fabric = FabricNeed::NeedsFabric;
  return operation;
}

TEST(OperationSentence, SaysWhereItEasesOrEnds) {
  TicketOperation operation = strip();
  operation.least = 0.01, operation.least_at = "at the hem";
  EXPECT_EQ(
      operation_sentence(operation),
      "Left and right side: insert a strip 34 mm per ply (135 mm in all) at the waist, easing to 10 mm at the hem; "
      "needs new cloth.");
  operation.least_at.clear();
  operation.tapers_to = operation.largest_at, operation.taper_length = 0.16;
  EXPECT_EQ(
      operation_sentence(operation),
      "Left and right side: insert a strip 34 mm per ply (135 mm in all) at the waist, tapering to nothing 160 mm "
      "away; needs new cloth.");
}

TEST(OperationSentence, PliesThatDifferAreAtMostTheLargest) {
  TicketOperation operation = strip();
  operation.sides[1].amount = 0.02;
  EXPECT_NE(operation_sentence(operation).find("insert a strip up to 34 mm per ply"), std::string::npos);
}

TEST(OperationSentence, SaysWhatIsLeftOfTheAllowanceAndWhatComesWithAnotherStep) {
  TicketOperation operation = strip();
  operation.kind = OperationKind::LetOut, operation.fabric = FabricNeed::WithinAllowance;
  operation.per_ply = operation.total = 0.009, operation.allowance = {0.015, 0.009, 0.006};
  operation.largest_at = "all along", operation.with_step = 2, operation.below_accuracy = true;
  operation.sides.resize(1);
  operation.sides[0].amount = 0.009;
  EXPECT_EQ(operation_sentence(operation),
            "Left and right side: let out 9 mm all along; the seam allowance gives it, 6 mm of it are left, together "
            "with step 2; less than a body can be measured to.");
}

TEST(OperationSentence, WholePanelsAreCutAnew) {
  TicketOperation operation;
  operation.kind = OperationKind::CutAnew, operation.where = "front and back";
  operation.fabric = FabricNeed::NeedsFabric;
  EXPECT_EQ(operation_sentence(operation), "Front and back: cut anew from new cloth; what is there cannot be pieced.");
  operation.fabric = FabricNeed::None, operation.touches = {"pocket", "zip"};
  EXPECT_EQ(operation_sentence(operation),
            "Front and back: cut anew out of the cloth that is there; unpick all round and lay the new pattern on; "
            "take off and set again: pocket and zip.");
}

}  // namespace
}  // namespace toile
