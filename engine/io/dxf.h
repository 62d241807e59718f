// SPDX-License-Identifier: GPL-3.0-or-later
// Drawings as DXF for apparel CAD: ASTM D6673-10, or the older ANSI/AAMA-292 it grew from.
//
// R12, 7-bit ASCII, HEADER empty, no TABLES; one BLOCK per piece, ENTITIES = style text and one INSERT per block;
// closed POLYLINEs, millimetres with two decimals, y up. Layers: 1 boundary and system text, 2 turn points, 3 curve
// points, 4 V notches (POINT: 30 depth, 50 angle, 39 width), 6 mirror line, 7 grain line, 8 internal lines, 14 sew
// lines, 15 annotation, 80-83 T, castle, check and U notches; 84, 85, 87 validation copies of 1, 8, 14 (ASTM only). DXF
// carries no seams: the JSON pattern keeps them. Source: design page "service", section 6.
#pragma once

#include "engine/core/drawing.h"

namespace toile {

enum class DxfDialect { Astm, Aama };

struct DxfOptions {
  DxfDialect dialect = DxfDialect::Astm;
  bool lines_only = false;  // LINE entities in place of POLYLINEs, for importers of R10
  std::string size = "ONE";
  std::string author;
  // Of the job, not of the clock, so that equal jobs give equal bytes.
  std::string creation_date = "01-01-2000";  // dd-mm-yyyy
  std::string creation_time = "00-00";       // hh-mm
};

Bytes write_dxf(const Drawing& drawing, const DxfOptions& options = {});

}  // namespace toile
