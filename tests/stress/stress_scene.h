// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes nobody would choose, from a number: random bodies, garments and fabrics inside and far beyond what people
// wear, and what must hold on every one of them.
//
// A scene ends well in two ways: done, and then every check below holds; or refused with a classified error. All else
// is bad: an unclassified exception, a number that is not finite, an answer that is wrong without saying so.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace toile::stress {

enum class Ending { Done, Refused, Bad };

struct Outcome {
  std::string kind, what;    // "patchwork", and what is odd about the scene in words
  bool human_range = false;  // a person's measures, a garment that suits, a fabric sold as such
  Ending ending = Ending::Done;
  std::string error;               // name of the error's code and its message, when refused
  std::vector<std::string> wrong;  // every check that failed
  double cpu_s = 0.0;

  void fail(std::string complaint) {
    wrong.push_back(std::move(complaint));
    ending = Ending::Bad;
  }
};

// Never throws. The same seed gives the same scene and the same outcome (but for the clock) on every machine.
Outcome run_scene(std::uint64_t seed);
// The same of one kind: "patchwork" (panels round random forms), "person" (drafted garments on random people),
// "body" (broken and hostile body files), "cut" (random target patterns, altered), "derive" (random drapes).
Outcome run_scene(const std::string& kind, std::uint64_t seed);
const std::vector<std::string>& scene_kinds();

}  // namespace toile::stress
