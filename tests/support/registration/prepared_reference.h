// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/bodies/register_bodies.h"

namespace toile::test {

// A body of the shared data as registration wants it, prepared once a process: most tests share two of them.
const RegistrationReference& reference(const std::string& name);

}  // namespace toile::test
