// SPDX-License-Identifier: GPL-3.0-or-later
// pictures GARMENT.json BODY.obj FOLDER: drapes a garment and makes everything a job shows of it, with the time of
// each.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "engine/io/pdf.h"
#include "engine/io/report_html.h"
#include "engine/io/svg.h"
#include "engine/io/ticket_document.h"
#include "engine/pipeline_inputs.h"
#include "engine/render/drawing_picture.h"
#include "engine/render/png.h"
#include "engine/stages/build_fitting_map.h"
#include "engine/stages/drape.h"
#include "engine/stages/draw_pattern.h"
#include "engine/stages/mesh_panels.h"
#include "engine/stages/render_views.h"
#include "tests/bench/bench.h"
#include "tests/support/sample_ticket.h"

namespace toile::bench {
namespace {

Bytes read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return Bytes{std::istreambuf_iterator<char>(in), {}};
}

class Folder {
 public:
  explicit Folder(std::string path) : path_(std::move(path)) { std::filesystem::create_directories(path_); }

  // Makes a file, notes its time and writes it.
  Bytes make(const std::string& name, const std::function<Bytes()>& work) {
    const double start = cpu_seconds();
    const Bytes bytes = work();
    const double took = cpu_seconds() - start;
    total_ += took;
    table_.add({name, fixed(1e3 * took, 1), std::to_string(bytes.size() / 1024)});
    std::ofstream(path_ + "/" + name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return bytes;
  }
  void print(const std::string& csv) {
    table_.add({"all", fixed(1e3 * total_, 1), ""});
    table_.print(csv);
  }

 private:
  std::string path_;
  double total_ = 0.0;
  Table table_{{"file", "CPU ms", "KiB"}};
};

}  // namespace

int bench_pictures(const Arguments& arguments) {
  if (arguments.words.size() != 3) {
    std::fprintf(stderr, "usage: toile-bench pictures GARMENT.json BODY.obj FOLDER\n");
    return 2;
  }
  const Pattern pattern = read_garment({arguments.words[0], read(arguments.words[0])});
  const Body body = read_body({arguments.words[1], read(arguments.words[1])});
  const PatternMesh mesh = mesh_panels(pattern);
  const DrapeResult draped = drape(pattern, mesh, body, {}, nullptr);
  const FittingMap fit = build_fitting_map(mesh, draped.drape);
  Folder folder(arguments.words[2]);
  ViewOptions views;
  views.title = "placed panels";
  folder.make("placed.png", [&] { return render_placed_panels(&body.surface, pattern, mesh, views); });
  views.title = "drape";
  folder.make("drape.png", [&] { return render_views(&body.surface, &mesh, &draped.drape, nullptr, views); });
  views.title = "fit", views.marks = 3;
  const Bytes fit_png =
      folder.make("fit.png", [&] { return render_views(&body.surface, &mesh, &draped.drape, &fit, views); });
  const Drawing drawing = draw_pattern(pattern);
  folder.make("pattern.png", [&] { return write_png(draw_picture(drawing)); });
  folder.make("pattern.svg", [&] { return write_svg(drawing); });
  folder.make("pattern.pdf", [&] { return write_pdf(drawing); });
  const Ticket ticket = test::sample_ticket();
  const Bytes inlined = write_svg(drawing, {false, true});
  folder.make("ticket.html", [&] { return write_ticket_html(ticket, inlined, "2026-01-31"); });
  Report report;
  report.title = "Alteration of " + pattern.name, report.subtitle = "sample data of the test ticket";
  report.summary = {"Three operations; the largest stretch falls from 12 % to 3 %."};
  report.fits = {{fit_png, "Fit of the drape"}};
  report.zones = {
      {"Stretch by panel", {"panel", "weft", "warp"}, {{"front", "+1.2 %", "-0.3 %"}, {"back", "+0.8 %", "0.1 %"}}}};
  report.ticket = &ticket, report.pattern_svg = inlined;
  for (const auto& [name, value] : body.measurements) report.measurements.add(name + "_m", value);
  folder.make("report.html", [&] { return write_report_html(report); });
  folder.print(arguments.csv);
  return 0;
}

}  // namespace toile::bench
