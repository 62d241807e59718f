// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/byte_range.h"

#include <gtest/gtest.h>

#include "server/http/problem.h"

namespace toile::http {

namespace {

std::pair<std::int64_t, std::int64_t> range(const char* header, std::int64_t size) {
  const ByteRange found = byte_range_of(header, size);
  EXPECT_EQ(found.size(), found.last - found.first + 1);
  return {found.first, found.last};
}

}  // namespace

TEST(ByteRange, NamesBytesFromTheStartOrFromTheEnd) {
  EXPECT_EQ(range("bytes=0-9", 100), std::pair(0L, 9L));
  EXPECT_EQ(range("bytes=99-99", 100), std::pair(99L, 99L));
  EXPECT_EQ(range("bytes=90-", 100), std::pair(90L, 99L));
  EXPECT_EQ(range("bytes=90-500", 100), std::pair(90L, 99L));
  EXPECT_EQ(range("bytes=-10", 100), std::pair(90L, 99L));
  EXPECT_EQ(range("bytes=-500", 100), std::pair(0L, 99L));
}

TEST(ByteRange, OfBytesThatAreNotThereIsRefusedWithTheSize) {
  for (const auto& [header, size] : {std::pair("bytes=100-", 100),
                                     {"bytes=100-200", 100},
                                     {"bytes=-0", 100},
                                     {"bytes=0-", 0},
                                     {"bytes=-5", 0},
                                     {"bytes=999999999999999-", 100}}) {
    try {
      byte_range_of(header, size);
      ADD_FAILURE() << header << " of " << size;
    } catch (const Problem& problem) {
      EXPECT_EQ(problem.status, 416);
      ASSERT_EQ(problem.headers.size(), 1u);
      EXPECT_EQ(problem.headers[0].second, "bytes */" + std::to_string(size));
    }
  }
}

TEST(ByteRange, IsToldFromWhatIsNone) {
  EXPECT_TRUE(is_byte_range("bytes=0-0"));
  for (const char* header : {"", "bytes", "bytes=", "bytes=-", "bytes=a-b", "bytes=5-4", "bytes=0-1,3-4", "lines=1-2",
                             "bytes=0--1", "bytes= 0-1", "bytes=0-99999999999999999999"})
    EXPECT_FALSE(is_byte_range(header)) << header;
}

}  // namespace toile::http
