// SPDX-License-Identifier: GPL-3.0-or-later
// Drapes on one body, one after the other: what depends on the body alone is prepared once, and the distance field
// keeps what it was asked for. A drape has the same bytes whatever was draped before it.
#pragma once

#include <memory>

#include "engine/stages/drape.h"

namespace toile {

class DrapeSeries {
 public:
  explicit DrapeSeries(const Body& body);
  ~DrapeSeries();
  DrapeSeries(const DrapeSeries&) = delete;
  DrapeSeries& operator=(const DrapeSeries&) = delete;

  // As drape_from() on the body of the series.
  DrapeResult drape_from(const Pattern& pattern, const PatternMesh& mesh, const Drape& start,
                         const DrapeOptions& options, Progress* progress);

 private:
  std::unique_ptr<class PreparedBody> body_;
};

}  // namespace toile
