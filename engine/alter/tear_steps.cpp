// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/tear_steps.h"

#include <algorithm>

namespace toile {
namespace {

std::vector<MadeTear> tears_up_to(const std::vector<MadeTear>& all, int round) {
  std::vector<MadeTear> tears;
  std::copy_if(all.begin(), all.end(), std::back_inserter(tears),
               [round](const MadeTear& made) { return made.round <= round; });
  return tears;
}

// Every step from the untorn cloth, as the alteration itself does it: all sides let go at once, then the cuts.
Sheet torn(const Sheet& stretched, const std::vector<MadeTear>& made, const TearOptions& options) {
  Sheet sheet = stretched;
  std::vector<Tear> tears;
  for (const MadeTear& tear : made) tears.push_back(tear.tear);
  if (!tears.empty()) propagate_tears(sheet, tears, options);
  return sheet;
}

}  // namespace

std::vector<TearStep> tear_steps(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
                                 const AlterPatternResult& altered, const AlterPatternOptions& options, bool removing) {
  TearOptions tearing;
  tearing.mesh_edges = options.mesh_edge_cuts;
  tearing.smoothness = options.cut_smoothness;
  std::vector<TearStep> steps;
  for (int p = 0; p < static_cast<int>(altered.panels.size()); ++p) {
    const PanelAlteration& panel = altered.panels[static_cast<std::size_t>(p)];
    const std::vector<MadeTear>& all = (removing ? panel.removal_pass : panel.insertion_pass).tears;
    if (all.empty()) continue;
    Sheet stretched =
        make_sheet(pattern, mesh, removing ? target_rest : mesh.rest, removing ? mesh.rest : target_rest, p);
    relax(stretched, tearing.relaxation);
    std::size_t known = 0;
    int last = 0;
    for (const MadeTear& made : all) last = std::max(last, made.round);
    for (int round = -1; round <= last; ++round) {
      const std::vector<MadeTear> tears = tears_up_to(all, round);
      if (round >= 0 && tears.size() == known) continue;
      TearStep step{p, removing, {}, torn(stretched, tears, tearing), {}};
      std::copy_if(tears.begin(), tears.end(), std::back_inserter(step.tears),
                   [round](const MadeTear& made) { return made.round == round; });
      step.stress = measure_stress(step.sheet);
      steps.push_back(std::move(step));
      known = tears.size();
    }
  }
  return steps;
}

}  // namespace toile
