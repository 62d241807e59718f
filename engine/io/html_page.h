// SPDX-License-Identifier: GPL-3.0-or-later
// A self-contained HTML page that reads well on a phone and prints well: no script, nothing loaded from elsewhere.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/record.h"
#include "engine/core/types.h"

namespace toile {

struct HtmlTable {
  std::string title;                           // caption, may be empty
  std::vector<std::string> columns;            // the first is left-aligned, the others right-aligned
  std::vector<std::vector<std::string>> rows;  // plain text, as many cells as columns
};

// Text arguments are plain text and are escaped here; `raw` is markup.
class HtmlPage {
 public:
  HtmlPage(std::string_view title, std::string_view subtitle);

  void heading(std::string_view text);
  void paragraph(std::string_view text, std::string_view css_class = {});
  void list(const std::vector<std::string>& items);
  void table(const HtmlTable& table);
  // PNG bytes inlined; wide pictures scroll sideways on a narrow screen.
  void picture(const Bytes& png, std::string_view caption);
  // The record as nested definition lists, names with their underscores opened.
  void record(const Record& record);
  void raw(std::string_view markup) { body_ += markup; }

  Bytes finish() const;

 private:
  std::string title_;
  std::string body_;
};

}  // namespace toile
