// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/shared_body.h"

#include "engine/io/mesh_file.h"
#include "tests/support/shared_data.h"

namespace toile::test {

Body load_shared_body(const std::string& name) {
  Body body;
  body.name = name;
  body.surface = read_mesh(read_file(shared_data("bodies/" + name + ".obj")), name + ".obj");
  return body;
}

Bytes shared_scan_bytes(const std::string& name) {
  const std::string extension = name == "scan_a" ? ".ply" : name == "scan_d" ? ".stl" : ".obj";
  return read_file(shared_data("scans/" + name + extension));
}

TriangleMesh load_shared_scan(const std::string& name) {
  return read_mesh(shared_scan_bytes(name), name);
}

}  // namespace toile::test
