// SPDX-License-Identifier: GPL-3.0-or-later
// The file structure of PDF 1.7: numbered objects, cross-reference table, trailer. No clock, no random identifier:
// equal objects give equal bytes. Source: ISO 32000-1, 7.5.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/types.h"

namespace toile {

class PdfDocument {
 public:
  // Numbers an object that is described later.
  int reserve();
  void set(int object, std::string body);
  int add(std::string body);
  // `dictionary` without the brackets and without /Length.
  int add_stream(std::string_view dictionary, std::string_view content);

  // Ends the file. `catalog` and `info` are object numbers. Requires that every reserved object was set.
  Bytes finish(int catalog, int info) const;

 private:
  std::vector<std::string> bodies_;
};

// "12 0 R".
std::string pdf_reference(int object);
// A string object; UTF-8 becomes Latin-1 (WinAnsi), what has no place there a question mark.
std::string pdf_string(std::string_view utf8);

}  // namespace toile
