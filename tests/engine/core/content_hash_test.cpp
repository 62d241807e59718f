// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/content_hash.h"

#include <set>

#include <gtest/gtest.h>

#include "engine/core/error.h"

namespace toile {
namespace {

TEST(ContentHash, AgreesWithThePublishedDigestOfAbc) {
  EXPECT_EQ(sha256_hex(std::string_view("abc")), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(ContentHash, KeepsTheBordersBetweenPieces) {
  EXPECT_NE(ContentHash().add("ab").add("c").hex(), ContentHash().add("a").add("bc").hex());
  EXPECT_EQ(ContentHash().add("ab").add(7).hex(), ContentHash().add("ab").add(7).hex());
}

TEST(ContentHash, TellsMatricesOfOtherShapeApart) {
  const Points2 wide = Points2::Ones(3, 2);
  const Points3 tall = Points3::Ones(2, 3);
  EXPECT_NE(ContentHash().add(wide).hex(), ContentHash().add(tall).hex());
}

TEST(ErrorCode, EveryCodeHasItsOwnName) {
  std::set<std::string_view> names;
  for (int code = 0; code <= static_cast<int>(ErrorCode::Internal); ++code)
    EXPECT_TRUE(names.insert(error_name(static_cast<ErrorCode>(code))).second) << code;
}

}  // namespace
}  // namespace toile
