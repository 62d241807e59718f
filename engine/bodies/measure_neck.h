// SPDX-License-Identifier: GPL-3.0-or-later
// The tape round a neck.
#pragma once

#include "engine/core/body.h"

namespace toile {

struct NeckGirth {
  double y = 0.0;       // m, where the tape crosses the middle of the neck
  double length = 0.0;  // m, hull girth; 0 where there is no neck
};

// Least girth in planes that lean forward like the neck does, lower in front than behind: level planes meet chin and
// nape, and their least girth is a kink between both that no two surfaces of one person share.
NeckGirth measure_neck(const TriangleMesh& body, const Skeleton& skeleton);

}  // namespace toile
