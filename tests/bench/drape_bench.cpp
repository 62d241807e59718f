// SPDX-License-Identifier: GPL-3.0-or-later
// drape [GARMENT...] [--triangles N] [--body NAME | --other-bodies] [--no-self-contact] [--whole]
//       [--iterations N] [--sheet FILE.png] [growth | halves]
// Sews and drapes garments of ../shared/data from flat, all of them by default, at 4,300 and 10,000 triangles or as
// told: CPU time beside the quality reached, and the distance of waist and hem from design/sewing.md's table.
// --sheet draws every garment from three sides, at the finest size, into one picture. --other-bodies: on two other
// bodies of the garment's family and on two of another one. growth: over 2.5k to 40k triangles, and how far the stretch
// of each is from that of the finest. halves: what it saves to move one half of what is symmetric, and how far the rest
// is from that of both.
#include <cstdio>
#include <fstream>

#include "engine/core/error.h"
#include "engine/core/units.h"
#include "engine/render/png.h"
#include "engine/stages/render_views.h"
#include "tests/bench/bench.h"
#include "tests/bench/drape_sheets.h"
#include "tests/bench/fine_reference.h"
#include "tests/bench/words.h"
#include "tests/support/dressed.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

constexpr int kCellWidth = 780, kCellHeight = 480, kCellsAcross = 4;  // of the sheet, pixels

struct DrapeRequest {
  std::vector<std::string> garments;
  std::vector<int> sizes = {4300, 10000};
  std::string body, sheet;
  std::optional<int> iterations;
  SelfContact self_contact = SelfContact::Auto;
  bool whole = false;  // not half of what is symmetric
  bool other_bodies = false, growth = false, halves = false;
};

DrapeRequest drape_request(Words words) {
  DrapeRequest request;
  if (const auto triangles = words.integer("--triangles")) request.sizes = {*triangles};
  request.iterations = words.integer("--iterations");
  if (words.flag("--no-self-contact")) request.self_contact = SelfContact::Off;
  request.whole = words.flag("--whole");
  request.body = words.text("--body").value_or("");
  request.sheet = words.text("--sheet").value_or("");
  request.other_bodies = words.flag("--other-bodies");
  request.growth = words.flag("growth");
  request.halves = words.flag("halves");
  if (request.growth) request.sizes = {2500, 5000, 10000, 20000, 40000};
  request.garments = words.rest();
  if (request.garments.empty()) request.garments = test::shared_garment_names();
  return request;
}

// Bodies a garment is put on; the empty name is its own.
std::vector<std::string> bodies_for(const DrapeRequest& request, const std::string& garment) {
  if (!request.other_bodies) return {request.body};
  const std::string own = test::body_of_garment(garment);
  if (own == "ggg_mean_female") return {"ggg_mean_all", "ggg_small_female", "mh_female_average", "mh_male_old_heavy"};
  if (own == "ggg_mean_male") return {"ggg_mean_all", "ggg_large_male", "mh_female_average", "mh_male_old_heavy"};
  return {"ggg_mean_female", "ggg_mean_male", "mh_female_average", "mh_male_old_heavy"};
}

Image picture(const std::string& title, const test::Dressing& d, const Drape& drape) {
  ViewOptions options;
  options.views = {View::Front, View::Left, View::Back};
  options.view_height = kCellHeight - 80;  // title and captions besides
  options.max_view_width = kCellWidth / 3;
  options.title = title;
  return draw_views(&d.body.surface, &d.mesh, &drape, nullptr, options);
}

class DrapeBench {
 public:
  explicit DrapeBench(const DrapeRequest& request) : request_(request) {}

  int run(const std::string& csv) {
    for (const std::string& garment : request_.garments)
      for (const std::string& body : bodies_for(request_, garment)) {
        times_.clear(), answers_.clear();
        for (int triangles : request_.sizes)
          request_.halves ? compare_halves(garment, body, triangles) : run_one(garment, body, triangles);
        if (request_.growth) add_growth(garment);
      }
    (request_.halves ? halves_ : table_).print(csv);
    if (request_.growth) growth_.print();
    std::printf("peak memory %.0f MB\n", peak_memory_mb());
    if (!request_.sheet.empty()) write_sheet();
    return 0;
  }

 private:
  // Of what was draped last, coarsest first.
  void add_growth(const std::string& garment) {
    std::vector<double> sizes;
    for (const Answer& answer : answers_) sizes.push_back(answer.mesh.triangle_count());
    for (std::size_t k = 0; k < answers_.size(); ++k) {
      const AnswerError error = compare(answers_.back(), answers_[k]);
      growth_.add({garment, fixed(sizes[k], 0), fixed(times_[k], 2), fixed(100 * error.stretch, 2),
                   fixed(100 * error.triangle_stretch, 2), fixed(1e3 * error.position, 2), fixed(1e3 * error.hem, 1)});
    }
    growth_.add({garment, "all", "n^" + fixed(growth_exponent(sizes, times_), 2), "", "", "", ""});
  }

  void compare_halves(const std::string& garment, const std::string& body, int triangles) {
    const test::Dressing d = test::dress(garment, triangles, body);
    DrapeOptions whole = d.options;
    whole.halve = false;
    DrapeResult off, on;
    const double off_s = time_cpu(1, [&] { off = drape(d.pattern, d.mesh, d.body, whole, nullptr); }).median;
    const double on_s = time_cpu(1, [&] { on = drape(d.pattern, d.mesh, d.body, d.options, nullptr); }).median;
    const Eigen::VectorXd apart = (on.drape.nodes - off.drape.nodes).rowwise().norm();
    const auto both = [](double a, double b, int digits) { return fixed(a, digits) + " " + fixed(b, digits); };
    halves_.add({garment, body, std::to_string(d.mesh.triangle_count()), std::to_string(off.diagnostics.moved_nodes),
                 std::to_string(on.diagnostics.moved_nodes), fixed(off_s, 2), fixed(on_s, 2), fixed(off_s / on_s, 2),
                 both(off.diagnostics.iterations, on.diagnostics.iterations, 0),
                 std::string(rest_name(off.quality.rest)) + " " + std::string(rest_name(on.quality.rest)),
                 both(off.quality.residual, on.quality.residual, 2),
                 both(1e3 * off.quality.deepest_node, 1e3 * on.quality.deepest_node, 2),
                 both(1e3 * off.quality.deepest_edge, 1e3 * on.quality.deepest_edge, 2),
                 both(off.quality.crossing_pairs, on.quality.crossing_pairs, 0),
                 fixed(1e3 * std::sqrt(apart.squaredNorm() / static_cast<double>(apart.size())), 2),
                 fixed(1e3 * apart.maxCoeff(), 2)});
  }

  void run_one(const std::string& garment, const std::string& body, int triangles) {
    test::Dressing d = test::dress(garment, triangles, body);
    if (request_.iterations) d.options.iterations = *request_.iterations;
    d.options.self_contact = request_.self_contact;
    d.options.halve = !request_.whole;
    const std::string count = std::to_string(d.mesh.triangle_count());
    const double start = cpu_seconds();
    try {
      const DrapeResult r = drape(d.pattern, d.mesh, d.body, d.options, nullptr);
      times_.push_back(cpu_seconds() - start);
      add_row(garment, body, d, r);
      if (request_.growth) answers_.push_back({d.mesh, r.drape, r.drape, d.mesh.rest, times_.back()});
      if (!request_.sheet.empty() && triangles == request_.sizes.back())
        cells_.push_back(picture(garment + " " + body, d, r.drape));
    } catch (const Error& error) {
      times_.push_back(cpu_seconds() - start);
      table_.add({garment, body, count, fixed(times_.back(), 2), error.message});
    }
  }

  void add_row(const std::string& garment, const std::string& body, const test::Dressing& d, const DrapeResult& r) {
    const DrapeQuality& q = r.quality;
    const test::Place place = test::expected_place(garment);
    const double waist = test::waist_height(d.pattern, d.mesh, r.drape), hem = r.drape.nodes.col(1).minCoeff();
    const bool compared = body.empty();
    table_.add({garment,
                body,
                std::to_string(d.mesh.triangle_count()),
                fixed(times_.back(), 2),
                std::to_string(r.diagnostics.moved_nodes),
                std::to_string(r.diagnostics.iterations),
                std::string(rest_name(q.rest)),
                fixed(q.residual, 2),
                fixed(1e3 * q.settling_move, 2),
                fixed(100 * q.weft.p99, 1),
                fixed(100 * q.warp.p99, 1),
                fixed(1e3 * q.deepest_node, 1),
                fixed(1e3 * q.deepest_edge, 1),
                std::to_string(q.crossing_pairs),
                fixed(100 * q.crossing_share, 2),
                fixed(waist, 3),
                compared && place.waist > 0 ? fixed(1e3 * (waist - place.waist), 1) : "-",
                fixed(hem, 3),
                compared ? fixed(1e3 * (hem - place.lowest), 1) : "-",
                std::to_string(r.diagnostics.rung),
                fixed(peak_memory_mb(), 0),
                names_of(r.diagnostics.findings)});
  }

  void write_sheet() const {
    const int count = static_cast<int>(cells_.size()), down = (count + kCellsAcross - 1) / kCellsAcross;
    Image sheet(kCellsAcross * kCellWidth, std::max(1, down) * kCellHeight, {255, 255, 255});
    for (int i = 0; i < count; ++i)
      paste(sheet, cells_[static_cast<std::size_t>(i)], i % kCellsAcross * kCellWidth, i / kCellsAcross * kCellHeight);
    const Bytes png = write_png(sheet);
    std::ofstream(request_.sheet, std::ios::binary)
        .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  }

  const DrapeRequest& request_;
  Table table_{{"garment", "body",     "triangles", "CPU s",   "moved",   "it",      "rest",       "residual",
                "move mm", "weft %",   "warp %",    "node mm", "edge mm", "cross",   "crossing %", "waist m",
                "diff mm", "lowest m", "diff mm",   "rung",    "peak MB", "findings"}};
  Table growth_{
      {"garment", "triangles", "CPU s", "stretch rms % off the finest", "recovered", "position mm", "hem mm"}};
  Table halves_{{"garment", "body", "triangles", "nodes", "moved", "both CPU s", "half CPU s", "ratio", "it", "rest",
                 "residual", "node mm", "edge mm", "cross", "apart rms mm", "largest mm"}};
  std::vector<Answer> answers_;  // drapes of one garment on one body
  std::vector<Image> cells_;
  std::vector<double> times_;
};

}  // namespace

int bench_drape(const Arguments& arguments) {
  if (!test::has_shared_data()) {
    std::fprintf(stderr, "toile-bench drape needs ../shared/data\n");
    return 2;
  }
  const DrapeRequest request = drape_request(Words(arguments.words));
  return DrapeBench(request).run(arguments.csv);
}

}  // namespace toile::bench
