// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/multipart.h"

#include <gmock/gmock.h>

namespace toile::http {

namespace {

using ::testing::ElementsAre;
using Parts = std::vector<std::pair<std::string, std::string>>;  // name and bytes

Parts read_in_pieces(const std::string& body, std::size_t piece) {
  Parts parts;
  MultipartReader reader(
      "b", {}, [&](const PartHead& head) { parts.emplace_back(head.name + "|" + head.filename, ""); },
      [&](std::span<const std::uint8_t> bytes) { parts.back().second.append(bytes.begin(), bytes.end()); });
  for (std::size_t at = 0; at < body.size(); at += piece) {
    const std::string part = body.substr(at, piece);
    reader.feed(std::span(reinterpret_cast<const std::uint8_t*>(part.data()), part.size()));
  }
  reader.finish();
  return parts;
}

const std::string kBody =
    "preamble\r\n--b\r\nContent-Disposition: form-data; name=\"file\"; filename=\"a.obj\"\r\nContent-Type: x/y\r\n\r\n"
    "v 0 0 0\r\n--not the boundary\r\n-\r\n--b\r\ncontent-disposition: form-data; name=\"empty\"\r\n\r\n\r\n--b\r\n"
    "Content-Disposition: form-data; name=\"labels\"\r\n\r\na,b\r\n--b--\r\nepilogue";

}  // namespace

TEST(Multipart, GivesTheSamePartsWhereverTheBodyIsCut) {
  const Parts whole = read_in_pieces(kBody, kBody.size());
  EXPECT_THAT(whole, ElementsAre(std::pair("file|a.obj", "v 0 0 0\r\n--not the boundary\r\n-"), std::pair("empty|", ""),
                                 std::pair("labels|", "a,b")));
  for (std::size_t piece = 1; piece < kBody.size(); ++piece) EXPECT_EQ(read_in_pieces(kBody, piece), whole) << piece;
}

TEST(Multipart, RefusesBrokenBodies) {
  for (const std::string& body :
       {std::string(""), std::string("--b\r\n"), kBody.substr(0, kBody.size() - 20),
        std::string("--b\r\nContent-Type: x\r\n\r\nno name\r\n--b--"), std::string("--bx\r\n\r\n--b--"),
        "--b\r\nA: " + std::string(5000, 'x') + "\r\n\r\n\r\n--b--"}) {
    try {
      read_in_pieces(body, 7);
      ADD_FAILURE() << "taken: " << body.substr(0, 60);
    } catch (const Problem& problem) {
      EXPECT_EQ(problem.status, 400);
      EXPECT_EQ(problem.code, "malformed_multipart");
    }
  }
}

TEST(Multipart, RefusesTooManyParts) {
  std::string body;
  for (int i = 0; i < 40; ++i) body += "--b\r\nContent-Disposition: form-data; name=\"x\"\r\n\r\n\r\n";
  try {
    read_in_pieces(body + "--b--", body.size());
    ADD_FAILURE() << "taken";
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.status, 413);
  }
}

TEST(Multipart, FindsTheBoundary) {
  EXPECT_EQ(multipart_boundary("multipart/form-data; boundary=abc"), "abc");
  EXPECT_EQ(multipart_boundary("Multipart/Form-Data; charset=x; Boundary=\"a b\""), "a b");
  for (const char* bad : {"", "application/json", "multipart/mixed; boundary=abc", "multipart/form-data",
                          "multipart/form-data; boundary=", "multipart/form-data; boundary=a\"b"})
    EXPECT_EQ(multipart_boundary(bad), "") << bad;
  EXPECT_EQ(multipart_boundary("multipart/form-data; boundary=" + std::string(71, 'a')), "");
}

}  // namespace toile::http
