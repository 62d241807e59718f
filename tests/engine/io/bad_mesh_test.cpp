// SPDX-License-Identifier: GPL-3.0-or-later
// What is refused, with which code, and what the message names.
#include <chrono>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/io/mesh_file.h"
#include "tests/support/text_bytes.h"

namespace toile {
namespace {

using ::testing::HasSubstr;

std::string ply(const std::string& encoding, const std::string& vertices, const std::string& faces,
                const std::string& body, const std::string& list = "list uchar int vertex_indices") {
  return "ply\nformat " + encoding + " 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces + "\nproperty " + list +
         "\nend_header\n" + body;
}

std::string binary_stl(std::uint32_t count, std::size_t triangles, float value = 1.0F) {
  std::string text(84 + 50 * triangles, '\0');
  std::memcpy(text.data() + 80, &count, 4);
  for (std::size_t i = 0; i < triangles; ++i)
    for (std::size_t k = 0; k < 9; ++k) {
      const float x = k % 4 == 0 ? value : 0.0F;
      std::memcpy(text.data() + 84 + 50 * i + 12 + 4 * k, &x, 4);
    }
  return text;
}

struct Bad {
  const char* what;
  std::string text;
  ErrorCode code;
  std::vector<std::string> said;
};

std::vector<Bad> bad_files() {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  return {
      {"empty", "", ErrorCode::FormatUnknown, {"empty"}},
      {"an image", "\x89PNG\r\n\x1a\n\0\0\0\rIHDR", ErrorCode::FormatUnknown, {"OBJ", "PLY", "STL"}},
      {"prose", "Dear Sir or Madam,\n", ErrorCode::FormatUnknown, {"export"}},
      {"OBJ without faces", triangle, ErrorCode::FileMalformed, {"no triangles", "3 points"}},
      {"OBJ cut in a number", triangle + "v 0.5 1\n", ErrorCode::FileMalformed, {"line 4", "z is missing"}},
      {"OBJ with NaN", "v 0 nan 0\n" + triangle + "f 1 2 3\n", ErrorCode::FileMalformed, {"line 1", "nan", "finite"}},
      {"OBJ with infinity", "v 0 0 inf\n" + triangle, ErrorCode::FileMalformed, {"line 1", "finite"}},
      {"OBJ with 1e999", "v 0 0 1e999\n" + triangle, ErrorCode::FileMalformed, {"line 1"}},
      {"OBJ far away", "v 0 0 100001\n" + triangle, ErrorCode::FileMalformed, {"line 1", "100000"}},
      {"OBJ index too large", triangle + "f 1 2 4\n", ErrorCode::FileMalformed, {"line 4", "vertex 4", "of 3"}},
      {"OBJ index far too large", triangle + "f 1 2 99999999999\n", ErrorCode::FileMalformed, {"line 4"}},
      {"OBJ index beyond 64 bits", triangle + "f 1 2 99999999999999999999\n", ErrorCode::FileMalformed, {"line 4"}},
      {"OBJ index zero", triangle + "f 0 1 2\n", ErrorCode::FileMalformed, {"line 4", "counts from 1"}},
      {"OBJ index before the start", triangle + "f -4 -1 -2\n", ErrorCode::FileMalformed, {"line 4", "-4"}},
      {"OBJ face of two", triangle + "f 1 2\n", ErrorCode::FileMalformed, {"line 4", "three corners"}},
      {"OBJ index is a word", triangle + "f a b c\n", ErrorCode::FileMalformed, {"line 4", "'a'"}},
      {"PLY without end_header", "ply\nformat ascii 1.0\nelement vertex 3\n", ErrorCode::FileMalformed, {"end_header"}},
      {"PLY of unknown encoding", "ply\nformat base64 1.0\n", ErrorCode::FileMalformed, {"line 2", "ascii"}},
      {"PLY of unknown type",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty quad x\n",
       ErrorCode::FileMalformed,
       {"line 4", "type"}},
      {"PLY of 10^9 vertices",
       ply("ascii", "1000000000", "1", points),
       ErrorCode::LimitExceeded,
       {"line 3", "1000000000", "500000"}},
      {"PLY of 10^9 faces",
       ply("binary_little_endian", "0", "1000000000", points),
       ErrorCode::LimitExceeded,
       {"1000000000", "1000000"}},
      {"PLY of 10^19 vertices",
       ply("ascii", "10000000000000000000", "1", points),
       ErrorCode::FileMalformed,
       {"line 3"}},
      {"PLY of negative count", ply("ascii", "-3", "1", points), ErrorCode::FileMalformed, {"line 3", "negative"}},
      {"PLY announcing more than it holds",
       ply("binary_big_endian", "400000", "1", points),
       ErrorCode::FileMalformed,
       {"line 3", "400000", "cut short"}},
      {"PLY of 10^9 of something else",
       "ply\nformat binary_little_endian 1.0\nelement stuff 1000000000\nproperty double d\nend_header\n",
       ErrorCode::FileMalformed,
       {"line 3", "1000000000"}},
      {"PLY of 10^9 of nothing",
       "ply\nformat ascii 1.0\nelement stuff 1000000000\nend_header\n",
       ErrorCode::FileMalformed,
       {"no triangles"}},
      {"PLY list of 3 GB",
       ply("binary_little_endian", "0", "1", "\xff\xff\xff\xbf", "list uint uchar vertex_indices"),
       ErrorCode::FileMalformed,
       {"byte", "3221225471", "does not fit"}},
      {"PLY list of negative length",
       ply("binary_little_endian", "0", "1", "\xff", "list char int vertex_indices"),
       ErrorCode::FileMalformed,
       {"byte", "-1"}},
      {"PLY ASCII cut short",
       ply("ascii", "3", "1", points + "3 0 1"),
       ErrorCode::FileMalformed,
       {"line", "ends here"}},
      {"PLY ASCII with NaN",
       ply("ascii", "3", "1", "0 0 NaN\n1 0 0\n0 1 0\n3 0 1 2\n"),
       ErrorCode::FileMalformed,
       {"line 10", "NaN"}},
      {"PLY index out of range",
       ply("ascii", "3", "1", points + "3 0 1 3\n"),
       ErrorCode::FileMalformed,
       {"line 13", "vertex 4"}},
      {"PLY negative index",
       ply("ascii", "3", "1", points + "3 0 1 -1\n"),
       ErrorCode::FileMalformed,
       {"line 13", "negative"}},
      {"PLY without faces", ply("ascii", "3", "0", points), ErrorCode::FileMalformed, {"no triangles"}},
      {"PLY faces by fractions",
       ply("ascii", "3", "1", points + "3 0 1 2\n", "list uchar float vertex_indices"),
       ErrorCode::FileMalformed,
       {"fractions"}},
      {"PLY without positions",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float u\nelement face 1\nproperty list uchar int "
       "vertex_indices\nend_header\n1 2 3\n3 0 1 2\n",
       ErrorCode::FileMalformed,
       {"x, y and z"}},
      {"STL of 10^9 triangles", binary_stl(1000000000, 2), ErrorCode::LimitExceeded, {"byte 80", "1000000000"}},
      {"STL cut short", binary_stl(700, 3), ErrorCode::FileMalformed, {"byte 80", "700", "cut short"}},
      {"STL of no triangles", binary_stl(0, 0), ErrorCode::FileMalformed, {"no triangles"}},
      {"STL with NaN",
       binary_stl(2, 2, std::numeric_limits<float>::quiet_NaN()),
       ErrorCode::FileMalformed,
       {"byte 96", "finite"}},
      {"STL ASCII without facets", "solid x\nendsolid x\n", ErrorCode::FileMalformed, {"no triangles"}},
      {"STL ASCII of two corners",
       "solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\n",
       ErrorCode::FileMalformed,
       {"line 5", "2 corners"}},
      {"STL ASCII of four corners",
       "solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendfacet\n",
       ErrorCode::FileMalformed,
       {"line 6", "three corners"}},
      {"STL ASCII cut short", "solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\n", ErrorCode::FileMalformed, {"cut short"}},
  };
}

// Whether a message says what to do about it.
bool mends(const std::string& message) {
  for (const char* verb : {"export", "copy", "decimate", "remove"})
    if (message.find(verb) != std::string::npos) return true;
  return false;
}

TEST(BadMesh, EveryBrokenFileIsRefusedWithPlaceAndMend) {
  for (const Bad& bad : bad_files()) {
    const std::string name = std::string(bad.what).substr(0, 3) == "STL" ? "input.stl" : "input.bin";
    try {
      read_mesh(test::bytes_of(bad.text), name);
      ADD_FAILURE() << bad.what << " was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.code, bad.code) << bad.what << ": " << error.message;
      EXPECT_EQ(exit_code(error.code), 3) << bad.what;
      EXPECT_EQ(error.subject, name) << bad.what;
      EXPECT_TRUE(mends(error.message)) << bad.what << ": " << error.message;
      for (const std::string& said : bad.said) EXPECT_THAT(error.message, HasSubstr(said)) << bad.what;
    }
  }
}

TEST(BadMesh, EveryTruncationOfAGoodFileIsRefusedOrReadAsAMesh) {
  TriangleMesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1.25;
  mesh.triangles.resize(4, 3);
  mesh.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  int refused = 0;
  for (const auto& [bytes, name] :
       {std::pair(write_obj(mesh), "a.obj"), std::pair(write_ply(mesh), "a.ply"), std::pair(write_stl(mesh), "a.stl")})
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      try {
        const TriangleMesh part = read_mesh({bytes.data(), size}, name);
        EXPECT_LT(part.triangles.maxCoeff(), part.vertex_count());
      } catch (const Error& error) {
        EXPECT_EQ(exit_code(error.code), 3);
        ++refused;
      }
    }
  // Only an OBJ may end after a whole face (or within its last number).
  EXPECT_GT(refused, 400);
}

TEST(BadMesh, LimitsHoldForFilesThatDoNotAnnounceTheirSize) {
  const MeshLimits limits{.bytes = 1000, .vertices = 3, .triangles = 2};
  const auto code = [&](const std::string& text) {
    try {
      read_mesh(test::bytes_of(text), "a.obj", limits);
    } catch (const Error& error) {
      return error.code;
    }
    return ErrorCode::Internal;
  };
  EXPECT_EQ(code("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n"), ErrorCode::LimitExceeded);
  EXPECT_EQ(code("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 1 2\n"), ErrorCode::LimitExceeded);
  EXPECT_EQ(code("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3\nf 1 2 3\n"), ErrorCode::LimitExceeded);
  EXPECT_EQ(code(std::string(1001, '#')), ErrorCode::LimitExceeded);
}

TEST(BadMesh, OneFaceOfMillionsOfCornersIsRefusedQuickly) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
  for (int i = 0; i < 8'000'000; ++i) text += " 1";
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THROW(read_mesh(test::bytes_of(text), "a.obj"), Error);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

}  // namespace
}  // namespace toile
