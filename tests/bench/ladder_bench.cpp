// SPDX-License-Identifier: GPL-3.0-or-later
// ladder [GARMENT...] [--people N] [--first I] [--triangles N] [--off METRES] [--from RUNG]: every garment of
// ../shared/data from flat on all of its bodies, or on N seeded people of the human range, its panels placed wrongly by
// up to --off in every direction. Which rung of the retry ladder gave each drape and who was refused; with --from, what
// that rung alone does where the one before failed.
#include <array>
#include <cstdio>

#include "engine/core/error.h"
#include "tests/bench/bench.h"
#include "tests/bench/words.h"
#include "tests/support/dice.h"
#include "tests/support/dressed.h"
#include "tests/support/random_people.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

constexpr int kRungs = 2;

struct LadderRequest {
  std::vector<std::string> garments;
  int people = 0, first = 0, triangles = 1500, from = 0;
  double off = 0.0;  // m
};

LadderRequest ladder_request(Words words) {
  LadderRequest request;
  const auto whole = [&](const char* name, int& value) { value = words.integer(name).value_or(value); };
  whole("--people", request.people);
  whole("--first", request.first);
  whole("--triangles", request.triangles);
  whole("--from", request.from);
  request.off = words.number("--off").value_or(request.off);
  request.garments = words.rest().empty() ? test::shared_garment_names() : words.rest();
  return request;
}

class LadderBench {
 public:
  explicit LadderBench(const LadderRequest& request) : request_(request) {
    for (const std::string& garment : request.garments) {
      dressed_.push_back(test::dress(garment, request.triangles));
      test::Dressing& d = dressed_.back();
      d.options.drafted_for = find_body_guides(d.body, SurfaceTree(d.body.surface.vertices, d.body.surface.triangles));
      d.options.first_rung = request.from;
    }
  }

  int run(const std::string& csv) {
    if (request_.people == 0)
      for (const std::string& body : test::shared_body_names())
        run_body(body, test::dress("tshirt_basic", 500, body).body);
    for (int i = 0; i < request_.people; ++i) {
      const int number = request_.first + i;
      const test::RandomPerson person = test::random_person(number);
      try {
        run_body("person " + std::to_string(number), make_mannequin(person.asked, {.figure = person.figure}).body);
      } catch (const Error& error) {
        std::printf("person %d: %s\n", number, error.message.c_str());
      }
    }
    table_.print(csv);
    std::printf("%d scenes: ", scenes_);
    for (int rung = request_.from; rung < kRungs; ++rung)
      std::printf("rung %d %d, ", rung, by_rung_[static_cast<std::size_t>(rung)]);
    std::printf("refused %d, not at rest %d\n", refused_, restless_);
    return 0;
  }

 private:
  void run_body(const std::string& name, const Body& body) {
    for (std::size_t g = 0; g < dressed_.size(); ++g) {
      test::Dressing d = dressed_[g];
      d.body = body;
      if (request_.off > 0) misplace(d.pattern);
      run_one(request_.garments[g], name, d);
    }
  }

  void misplace(Pattern& pattern) {
    test::Dice dice(static_cast<std::uint64_t>(scenes_) + 1);
    for (Panel& panel : pattern.panels)
      for (int k = 0; k < 3; ++k) panel.translation[k] += dice.between(-request_.off, request_.off);
  }

  void run_one(const std::string& garment, const std::string& body, const test::Dressing& d) {
    ++scenes_;
    const double start = cpu_seconds();
    std::string end, why;
    try {
      const DrapeResult r = drape(d.pattern, d.mesh, d.body, d.options, nullptr);
      ++by_rung_[static_cast<std::size_t>(r.diagnostics.rung)];
      restless_ += r.quality.rest == Rest::NotAtRest;
      if (r.diagnostics.rung == request_.from && r.quality.nodes_inside == 0 && r.quality.edges_inside == 0 &&
          r.quality.rest != Rest::NotAtRest)
        return;
      end = "rung " + std::to_string(r.diagnostics.rung) + ", " + std::string(rest_name(r.quality.rest));
      why = fixed(1e3 * r.quality.deepest_node, 1) + " / " + fixed(1e3 * r.quality.deepest_edge, 1) + " mm";
    } catch (const Error& error) {
      ++refused_;
      end = "refused", why = error.message;
    }
    table_.add({garment, body, end, fixed(cpu_seconds() - start, 2), why});
  }

  const LadderRequest& request_;
  std::vector<test::Dressing> dressed_;  // on their own bodies
  Table table_{{"garment", "body", "end", "CPU s", "node / edge inside, or why refused"}};
  std::array<int, kRungs> by_rung_{};
  int scenes_ = 0, refused_ = 0, restless_ = 0;
};

}  // namespace

int bench_ladder(const Arguments& arguments) {
  if (!test::has_shared_data()) {
    std::fprintf(stderr, "toile-bench ladder needs ../shared/data\n");
    return 2;
  }
  const LadderRequest request = ladder_request(Words(arguments.words));
  return LadderBench(request).run(arguments.csv);
}

}  // namespace toile::bench
