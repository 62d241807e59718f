// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/make_builtin_body.h"

#include "engine/bodies/make_form.h"
#include "engine/bodies/mannequin_names.h"
#include "engine/core/error.h"

namespace toile {

Body make_builtin_body(std::string_view name) {
  if (name.starts_with("tube-")) return make_builtin_form(name);
  const auto named = find_named_mannequin(name);
  if (!named)
    throw Error(
        ErrorCode::NotFound, "builtin:" + std::string(name),
        "no built-in body of this name; there are woman-SIZE-HEIGHT (32 to 56 by 2; 145 to 195 cm), "
        "man-SIZE-HEIGHT (44 to 60 by 2; 155 to 205 cm), child-HEIGHT (86 to 176 cm) and tube-RADIUS-HEIGHT (cm), "
        "such as woman-38-168");
  Body body = make_mannequin(named->measurements, {.figure = named->figure}).body;
  body.name = name;
  return body;
}

}  // namespace toile
