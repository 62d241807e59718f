// SPDX-License-Identifier: GPL-3.0-or-later
// toile-bench NAME [words] [--csv FILE] [--svg FILE] [--repeats N]: prints tables of run time against error.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <map>

#include "tests/bench/proof.h"

namespace toile::bench {
namespace {

struct Entry {
  const char* summary;
  int (*run)(const Arguments&);
};

const std::map<std::string, Entry>& benches() {
  static const std::map<std::string, Entry> all = {
      {"alter",
       {"alter shared garments for other bodies: [GARMENT[:BODY]...] [--drape] [--greedy] [--mesh-edges] [--mu X] "
        "[--gamma X] [--plans N] [--triangles N] [--stages FOLDER] [--pictures FOLDER] [--sentences] [--growth]",
        bench_alter}},
      {"worn",
       {"garments worn by MakeHuman bodies altered for others: [GARMENT...] [--triangles N] [--stages FOLDER] "
        "[--pictures FOLDER] [--sentences]",
        bench_worn}},
      {"alteration", {"draw an alteration: GARMENT.json ACROSS ALONG FOLDER", bench_alteration}},
      {"examples",
       {"drafted examples altered between five mannequins: [GARMENT...] [--triangles N] [--pictures FOLDER] "
        "[--sentences]",
        bench_examples}},
      {"inputs", {"time against quality of reading and meshing what users hand in", bench_inputs}},
      {"derive",
       {"target patterns: fit and position before and after, over garments and bodies: [trips|growth|random|sweeps] "
        "[GARMENT...] [--bodies NAME,...] [--triangles N] [--count N] [--asymmetric] [--stages FOLDER] [--pictures "
        "FOLDER]",
        bench_derive}},
      {"drape",
       {"sew and drape: [growth|halves] [GARMENT...] [--triangles N] [--body NAME | --other-bodies] "
        "[--no-self-contact] [--whole] [--iterations N] [--sheet FILE]",
        bench_drape}},
      {"fabrics", {"textile laboratory: [FABRIC...] [--rings N] [--growth] [--pictures FOLDER]", bench_fabrics}},
      {"oracle",
       {"default against Newton: [GARMENT...] [--triangles N] [--residual R] [--stop-settled R] [--frictionless | "
        "--finer]",
        bench_oracle}},
      {"ladder",
       {"which rung of the retry ladder drapes whom: [GARMENT...] [--people N] [--first I] [--triangles N] [--off "
        "METRES] [--from RUNG]",
        bench_ladder}},
      {"mannequins",
       {"made of tape measurements: [people N] misses of random people; likeness FOLDER pictures beside shared bodies",
        bench_mannequins}},
      {"panels", {"draw a flat pattern: GARMENT.json OUT.png|OUT.svg", bench_panels}},
      {"pictures", {"all a job shows of a drape: GARMENT.json BODY.obj FOLDER", bench_pictures}},
      {"queue", {"what the queue costs a job, in flushes of the disk: [FOLDER]", bench_queue}},
      {"register",
       {"body maps: time against error over resolutions, growth; [pairs [TARGET] | variants [BODY] | measures "
        "[TARGET...] | where [TARGET...] | skin [SCAN...]]",
        bench_register}},
      {"stages",
       {"a whole job stage by stage: [SCENE...] [--triangles N] [--outputs none|images|all] [--preset "
        "draft|standard|fine] [--threads N]",
        bench_stages}},
      {"transport",
       {"garments carried to other bodies and draped: [GARMENT...] [--body NAME] [--triangles N] [--pictures FOLDER]",
        bench_transport}},
      {"stress",
       {"random scenes in processes of their own: [--scenes N] [--seed S] [--kind KIND] [--limit SECONDS] [--all]",
        bench_stress}},
      {"batch",
       {"one garment for many bodies, stages shared: [GARMENT] [--bodies NAME,... | --count N] [--triangles N]",
        bench_batch}},
      {"growth", {"a whole job over mesh sizes: [SCENE] [--sizes N,N,...]", bench_growth}},
      {"ledger",
       {"tolerance and reached value of every comparison of the tests: [--slow] [--filter F] [PROGRAM...]",
        bench_ledger}},
      {"pareto",
       {"run time against error: [SCENE...] [--points N:R[:S],... | --sizes N,... --residuals R,...] [--newton] "
        "[--fine N] [--fine-residual R] [--held] [--flat]",
        bench_pareto}},
      {"skip", {"each saving off and on: [SCENE] [--triangles N]", bench_skip}},
      {"threads", {"the same job several times at once: [GARMENT] [--bodies NAME] [--triangles N]", bench_threads}},
      {"where",
       {"where altered garments rest off their place, and whose sides are too long: [--triangles N] [--mu X] "
        "GARMENT:BODY...",
        bench_where}},
      {"view", {"look at a body and a drape: BODY.obj [DRAPE.obj] OUT.png [--stretch 0.1]", bench_view}},
  };
  return all;
}

Arguments arguments_of(int argc, char** argv) {
  Arguments arguments;
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--csv" && i + 1 < argc)
      arguments.csv = argv[++i];
    else if (word == "--svg" && i + 1 < argc)
      arguments.svg = argv[++i];
    else if (word == "--repeats" && i + 1 < argc)
      arguments.repeats = std::max(1, std::atoi(argv[++i]));
    else
      arguments.words.push_back(word);
  }
  return arguments;
}

constexpr const char* usage = "usage: toile-bench %s [words] [--csv FILE] [--svg FILE] [--repeats N]\n";

void tell_all(std::FILE* out) {
  std::fprintf(out, usage, "NAME");
  for (const auto& [name, entry] : benches()) std::fprintf(out, "  %-12s %s\n", name.c_str(), entry.summary);
}

bool asks_for_help(const char* word) {
  return std::strcmp(word, "--help") == 0 || std::strcmp(word, "-h") == 0;
}

}  // namespace
}  // namespace toile::bench

int main(int argc, char** argv) {
  using namespace toile::bench;
  if (argc > 1 && asks_for_help(argv[1])) return tell_all(stdout), 0;
  const auto found = argc > 1 ? benches().find(argv[1]) : benches().end();
  if (found == benches().end()) return tell_all(stderr), 2;
  if (std::any_of(argv + 2, argv + argc, asks_for_help)) {
    std::printf(usage, argv[1]);
    std::printf("  %s\n", found->second.summary);
    return 0;
  }
  try {
    return found->second.run(arguments_of(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "toile-bench %s: %s\n", argv[1], error.what());
    return 1;
  }
}
