// SPDX-License-Identifier: GPL-3.0-or-later
// panels GARMENT.json OUT.png|OUT.svg|OUT.pdf: the flat pattern drawn.
#include <cstdio>
#include <fstream>
#include <iterator>

#include "engine/io/pdf.h"
#include "engine/io/svg.h"
#include "engine/render/drawing_picture.h"
#include "engine/render/png.h"
#include "engine/stages/draw_pattern.h"
#include "engine/stages/import_pattern.h"
#include "tests/bench/bench.h"

namespace toile::bench {

namespace {

Bytes file_of(const Drawing& drawing, const std::string& name, const std::string& sheet) {
  if (name.ends_with(".svg")) return write_svg(drawing);
  if (!name.ends_with(".pdf")) return write_png(draw_picture(drawing));
  if (sheet == "Letter") return write_pdf(drawing, {PdfSheet::Letter, {}});
  if (sheet == "A0") return write_pdf(drawing, {PdfSheet::A0, {}});
  if (sheet == "projector") return write_pdf(drawing, {PdfSheet::Projector, {}});
  return write_pdf(drawing);
}

}  // namespace

int bench_panels(const Arguments& arguments) {
  if (arguments.words.size() < 2 || arguments.words.size() > 3) {
    std::fprintf(stderr, "usage: toile-bench panels GARMENT.json OUT.png|OUT.svg|OUT.pdf [A4|Letter|A0|projector]\n");
    return 2;
  }
  std::ifstream in(arguments.words[0], std::ios::binary);
  const Bytes file{std::istreambuf_iterator<char>(in), {}};
  const Pattern pattern = import_pattern(file);
  const double start = cpu_seconds();
  const Drawing drawing = draw_pattern(pattern);
  const double drawn = cpu_seconds();
  const std::string& out = arguments.words[1];
  const std::string sheet = arguments.words.size() > 2 ? arguments.words[2] : "A4";
  const Bytes bytes = file_of(drawing, out, sheet);
  std::printf("drawing %.1f ms, file %.1f ms (CPU), %zu bytes\n", 1e3 * (drawn - start), 1e3 * (cpu_seconds() - drawn),
              bytes.size());
  std::ofstream(out, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return 0;
}

}  // namespace toile::bench
