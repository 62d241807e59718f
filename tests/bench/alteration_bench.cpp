// SPDX-License-Identifier: GPL-3.0-or-later
// alteration GARMENT.json ACROSS ALONG FOLDER: alters a garment to itself scaled in weft and warp and draws the result
// in every format; shows drawings and ticket without a drape.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "engine/draw_alteration.h"
#include "engine/draw_tears.h"
#include "engine/io/pdf.h"
#include "engine/io/record_json.h"
#include "engine/io/svg.h"
#include "engine/io/ticket_document.h"
#include "engine/pipeline_inputs.h"
#include "engine/render/drawing_picture.h"
#include "engine/render/png.h"
#include "engine/stages/mesh_panels.h"
#include "tests/bench/bench.h"

namespace toile::bench {

int bench_alteration(const Arguments& arguments) {
  if (arguments.words.size() != 4) {
    std::fprintf(stderr, "usage: toile-bench alteration GARMENT.json ACROSS ALONG FOLDER\n");
    return 2;
  }
  std::ifstream in(arguments.words[0], std::ios::binary);
  const Pattern pattern = read_garment({arguments.words[0], Bytes{std::istreambuf_iterator<char>(in), {}}});
  const PatternMesh mesh = mesh_panels(pattern, {4000, {}});
  Points2 wanted = mesh.rest;
  wanted.col(0) *= std::atof(arguments.words[1].c_str());
  wanted.col(1) *= std::atof(arguments.words[2].c_str());
  const AlterPatternResult altered = alter_pattern(pattern, mesh, wanted);
  const Drawing drawing = draw_alteration(pattern, altered);
  const std::string folder = arguments.words[3];
  std::filesystem::create_directories(folder);
  const auto write = [&](const std::string& name, const Bytes& bytes) {
    std::ofstream(folder + "/" + name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  };
  write("altered_pattern.svg", write_svg(drawing));
  write("altered_pattern.pdf", write_pdf(drawing));
  write("pattern.png", write_png(draw_picture(drawing)));
  write("tears.png", write_png(picture_of_tears(draw_tears(pattern, mesh, wanted, altered, {}))));
  write("ticket.html", write_ticket_html(altered.ticket, write_svg(drawing, {false, true})));
  write("ticket.json", write_json(ticket_record(altered.ticket)));
  for (const TicketOperation& operation : altered.ticket.operations) std::printf("%s\n", operation.sentence.c_str());
  return 0;
}

}  // namespace toile::bench
