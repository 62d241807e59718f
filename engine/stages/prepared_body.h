// SPDX-License-Identifier: GPL-3.0-or-later
// What drapes on one body share: its guides and the distance fields round it, each made when it is first asked for.
// Used by drape and drape_series only.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "engine/bodies/body_guides.h"
#include "engine/geometry/distance_field.h"

namespace toile {

class PreparedBody {
 public:
  explicit PreparedBody(const Body& given);  // finds a person's skeleton where it has none

  const Body& body() const { return body_; }
  const BodyGuides& guides();
  // `armless`: of the body without its arms.
  SurfaceField& field(bool armless);

 private:
  Body body_;
  std::optional<BodyGuides> guides_;
  std::array<std::unique_ptr<SurfaceField>, 2> fields_;
};

}  // namespace toile
