// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/record_json.h"

#include <limits>

#include <gtest/gtest.h>

#include "engine/core/archive.h"

namespace toile {
namespace {

Record sample() {
  Record inner;
  inner.add("width_mm", 12.5).add("name", "side \"left\"");
  Record record;
  record.add("count", 3).add("ok", true).add("inner", inner).add("list", std::vector<Record>{inner, Record()});
  record.add("values", std::vector<double>{0.1, 1e300}).add("nothing", Record::Value());
  record.add("not_finite", std::numeric_limits<double>::quiet_NaN());
  return record;
}

TEST(RecordJson, KeepsOrderAndWritesExactNumbers) {
  const Bytes bytes = write_json(sample());
  std::string text(bytes.begin(), bytes.end());
  std::erase_if(text, [](char c) { return c == '\n'; });
  EXPECT_EQ(text,
            R"({ "count": 3, "ok": true, "inner": {  "width_mm": 12.5,  "name": "side \"left\"" }, "list": [  {   )"
            R"("width_mm": 12.5,   "name": "side \"left\""  },  {} ], "values": [  0.1,  1e+300 ], "nothing": null,)"
            R"( "not_finite": null})");
}

TEST(RecordJson, RecordsAreArchivedAndReadBack) {
  const Bytes bytes = to_bytes(sample());
  const auto read = from_bytes<Record>(bytes);
  EXPECT_EQ(write_json(read), write_json(sample()));
  EXPECT_EQ(to_bytes(read), bytes);
  EXPECT_THROW(from_bytes<Record>(Bytes(bytes.begin(), bytes.end() - 3)), Error);
}

}  // namespace
}  // namespace toile
