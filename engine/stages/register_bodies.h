// SPDX-License-Identifier: GPL-3.0-or-later
// Register: put a reference body in correspondence with a target body. The result is a body map.
//
// Bodies that share one topology (equal triangles, vertex by vertex) correspond exactly; the report says so.
#pragma once

#include "engine/core/archive_values.h"
#include "engine/core/progress.h"
#include "engine/core/record.h"

namespace toile {

struct RegisterBodiesOptions {
  bool use_shared_topology = true;  // take equal triangle lists as exact correspondence
};

struct RegisterBodiesResult {
  BodyMap map;
  Record diagnostics;
};

template <class A>
void archive(A& a, RegisterBodiesResult& v) {
  a(v.map, v.diagnostics);
}

// Throws: RegistrationFailed when the bodies cannot be put in correspondence.
RegisterBodiesResult register_bodies(const Body& reference, const Body& target,
                                     const RegisterBodiesOptions& options = {}, const Progress* progress = nullptr);

}  // namespace toile
