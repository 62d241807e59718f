// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/head_guard.h"

#include <gtest/gtest.h>

namespace toile::http {

namespace {

std::string head(const std::string& lines, const std::string& first = "GET /v1/jobs HTTP/1.1") {
  return first + "\r\n" + lines + "\r\n";
}

struct Case {
  std::string bytes;
  int status;
  std::string code;
};

}  // namespace

TEST(HeadGuard, RefusesWhatTheLibraryDoesNotProtectFrom) {
  std::string many;
  for (int i = 0; i < 65; ++i) many.append("A").append(std::to_string(i)).append(": b\r\n");
  const std::vector<Case> cases = {
      {head("Transfer-Encoding: chunked\r\n"), 411, "length_required"},
      {head("transfer-ENCODING: identity\r\n"), 411, "length_required"},
      {head("Content-Encoding: gzip\r\n"), 415, "content_encoding"},
      {head("Range: bytes=0-1,2-3\r\n"), 416, "many_ranges"},
      {head("Range: bytes=9-3\r\n"), 416, "bad_range"},
      {head(many), 431, "too_many_headers"},
      {head("A: " + std::string(33000, 'x') + "\r\n"), 431, "headers_too_large"},
      {std::string(33000, 'x'), 431, "headers_too_large"},
      {std::string(100, '\n'), 431, "too_many_headers"},
      {head("Content-Length: abc\r\n"), 400, "bad_content_length"},
      {head("Content-Length: -1\r\n"), 400, "bad_content_length"},
      {head("Content-Length: 1 2\r\n"), 400, "bad_content_length"},
      {head("Content-Length: 99999999999999999999\r\n"), 400, "bad_content_length"},
      {head("Content-Length: 1\r\nContent-Length: 1\r\n"), 400, "bad_content_length"},
      {head("A b\r\n"), 400, "bad_header"},
      {head("A : b\r\n"), 400, "bad_header"},
      {head(" A: b\r\n"), 400, "bad_header"},
      {head("A: b\n C: d\r\n"), 400, "bad_header"},
      {head("", "GET  HTTP/1.1"), 400, "bad_request_line"},
      {head("", "GET http://x/ HTTP/1.1"), 400, "bad_request_line"},
      {head("", "GET / HTTP/2.0"), 505, "bad_version"},
      {head("", "TRACE / HTTP/1.1"), 405, "method_not_allowed"},
      {head("", "GET /" + std::string(3000, 'a') + " HTTP/1.1"), 414, "target_too_long"},
  };
  for (const Case& one : cases) {
    const HeadResult result = examine_head(one.bytes, {});
    EXPECT_EQ(result.state, HeadState::Refused) << one.bytes.substr(0, 80);
    EXPECT_EQ(result.refusal.status, one.status) << one.bytes.substr(0, 80);
    EXPECT_EQ(result.refusal.code, one.code) << one.bytes.substr(0, 80);
  }
}

TEST(HeadGuard, TakesAGoodHeadWhateverPiecesItComesIn) {
  const std::string bytes = head("Host: x\r\nContent-Length: 12\r\nExpect: 100-continue\r\nRange: bytes=0-5\r\n",
                                 "POST /v1/jobs?limit=3 HTTP/1.1");
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_EQ(examine_head(std::string_view(bytes).substr(0, length), {}).state, HeadState::Incomplete) << length;
  const HeadResult result = examine_head(bytes + "the body ...", {});
  EXPECT_EQ(result.state, HeadState::Complete);
  EXPECT_EQ(result.head.size, bytes.size());
  EXPECT_EQ(result.head.content_length, 12);
  EXPECT_TRUE(result.head.expects_continue);
}

}  // namespace toile::http
