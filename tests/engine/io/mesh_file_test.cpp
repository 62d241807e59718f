// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/mesh_file.h"

#include <gtest/gtest.h>

#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"
#include "tests/support/text_bytes.h"

namespace toile {
namespace {

TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1.25;
  mesh.triangles.resize(4, 3);
  mesh.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  return mesh;
}

TEST(MeshFile, ObjReadsFansOfPolygonsSlashFormsNegativeIndicesAndJoinedLines) {
  const TriangleMesh mesh =
      read_mesh(test::bytes_of("# comment\r\nmtllib x.mtl\nv 0 0 0\nv +1 0 0 0.5 0.5 0.5\nv 1 1 0\r\n"
                               "v 0 1 0\nvt 0 0\nf 1/1 2//3 3/4/5 \\\n 4\nf -4 -3 -2 # last\n"),
                "quad.obj");
  ASSERT_EQ(mesh.vertex_count(), 4);
  Triangles expected(3, 3);
  expected << 0, 1, 2, 0, 2, 3, 0, 1, 2;
  EXPECT_EQ(mesh.triangles, expected);
  EXPECT_EQ(mesh.vertices(1, 0), 1.0);
}

TEST(MeshFile, AsciiPlyReadsForeignElementsAndProperties) {
  const TriangleMesh mesh = read_mesh(
      test::bytes_of("ply\nformat ascii 1.0\ncomment made by hand\\\nelement camera 1\nproperty float f\n"
                     "element vertex 4\nproperty uchar red\nproperty double z\nproperty double y\nproperty float x\n"
                     "element face 1\nproperty list uchar float weights\nproperty list uchar int vertex_index\n"
                     "end_header\n1.5\n255 3 2 1\n0 0 0 4\n0 5 0 0\n0 0 0 0\n2 .5 .5 4 0 1\n2 3\n"),
      "hand.ply");
  EXPECT_EQ(mesh.vertices.row(0), Eigen::RowVector3d(1, 2, 3));
  Triangles expected(2, 3);
  expected << 0, 1, 2, 0, 2, 3;
  EXPECT_EQ(mesh.triangles, expected);
}

TEST(MeshFile, BinaryPlyOfBothByteOrdersIsTheSameMesh) {
  const TriangleMesh mesh = tetrahedron();
  const Bytes little = write_ply(mesh);
  std::string text(little.begin(), little.end());
  const std::size_t body = text.find("end_header\n") + 11;
  std::string big = text.substr(0, body);
  big.replace(big.find("little"), 6, "big");
  std::size_t at = body;
  const auto swapped = [&](std::size_t size) {
    for (std::size_t i = size; i-- > 0;) big += text[at + i];
    at += size;
  };
  for (int i = 0; i < 12; ++i) swapped(4);
  for (int f = 0; f < 4; ++f) {
    swapped(1);
    for (int k = 0; k < 3; ++k) swapped(4);
  }
  ASSERT_EQ(at, text.size());
  const TriangleMesh again = read_mesh(test::bytes_of(big), "big");
  EXPECT_EQ(again.vertices, mesh.vertices);
  EXPECT_EQ(again.triangles, mesh.triangles);
}

TEST(MeshFile, WhatIsWrittenIsReadBack) {
  const TriangleMesh mesh = tetrahedron();
  for (const Bytes& bytes : {write_obj(mesh), write_ply(mesh)}) {
    const TriangleMesh again = read_mesh(bytes, "no_extension");
    EXPECT_EQ(again.vertices, mesh.vertices);
    EXPECT_EQ(again.triangles, mesh.triangles);
  }
  const TriangleMesh stl = read_mesh(write_stl(mesh), "no_extension");
  ASSERT_EQ(stl.vertex_count(), 4);
  for (int f = 0; f < 4; ++f)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(stl.vertices.row(stl.triangles(f, k)), mesh.vertices.row(mesh.triangles(f, k)));
}

TEST(MeshFile, AsciiStlWeldsEqualCornersSignedZeroIncluded) {
  const TriangleMesh mesh =
      read_mesh(test::bytes_of("solid a b\n facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 "
                               "0 0\n vertex 1 1 0\n endloop\n endfacet\n"
                               " facet normal 0 0 1\n outer loop\n vertex -0.0 0 0\n vertex 1 1 0\n "
                               "vertex 0 1e0 0\n endloop\n endfacet\nendsolid\n"),
                "quad");
  EXPECT_EQ(mesh.vertex_count(), 4);
  Triangles expected(2, 3);
  expected << 0, 1, 2, 0, 2, 3;
  EXPECT_EQ(mesh.triangles, expected);
}

TEST(MeshFile, SharedBodiesAndScansHaveTheirDocumentedCounts) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const std::string& name : test::shared_body_names()) {
    const Body body = test::load_shared_body(name);
    EXPECT_EQ(body.surface.vertex_count(), name.starts_with("ggg") ? 23752 : 13380) << name;
    EXPECT_EQ(body.surface.triangle_count(), name.starts_with("ggg") ? 47500 : 26756) << name;
  }
  const TriangleMesh a = test::load_shared_scan("scan_a");
  EXPECT_EQ(a.vertex_count(), 24056);
  EXPECT_EQ(a.triangle_count(), 47662);
  EXPECT_EQ(test::load_shared_scan("scan_d").triangle_count(), 40671);
}

}  // namespace
}  // namespace toile
