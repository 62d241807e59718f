// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/alter/alter_pattern.h"

namespace toile::test {

// Tears of one kind that both passes made, in all panels.
inline std::size_t tears_of(const AlterPatternResult& result, TearKind kind) {
  std::size_t count = 0;
  for (const PanelAlteration& panel : result.panels)
    for (const PanelTearing* pass : {&panel.insertion_pass, &panel.removal_pass})
      for (const MadeTear& made : pass->tears) count += made.tear.kind == kind;
  return count;
}

}  // namespace toile::test
