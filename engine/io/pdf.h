// SPDX-License-Identifier: GPL-3.0-or-later
// Drawings as PDF at true scale, to print on what a shop has.
//
// A4 and Letter: a first page with a 100 mm test square, what is inside and how the sheets join; then one page per tile
// that is not blank. Each tile carries 10 mm more than its frame on the right and below: cut the next page along its
// left and upper frame line and lay it on, diamond to diamond. A0: pieces laid out for that width, tiled only if they
// need more than one. Projector: one page as large as the pattern. Written without a clock: equal drawings, equal
// bytes.
#pragma once

#include <string>

#include "engine/core/drawing.h"

namespace toile {

enum class PdfSheet { A4, Letter, A0, Projector };

struct PdfOptions {
  PdfSheet sheet = PdfSheet::A4;
  std::string date;  // of the job, as "D:YYYYMMDDhhmmssZ"; empty: none is written
};

Bytes write_pdf(const Drawing& drawing, const PdfOptions& options = {});

}  // namespace toile
