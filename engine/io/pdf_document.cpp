// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/pdf_document.h"

#include <cstdio>

#include "engine/io/text_format.h"

namespace toile {

int PdfDocument::reserve() {
  return add({});
}

void PdfDocument::set(int object, std::string body) {
  bodies_[static_cast<std::size_t>(object - 1)] = std::move(body);
}

int PdfDocument::add(std::string body) {
  bodies_.push_back(std::move(body));
  return static_cast<int>(bodies_.size());
}

int PdfDocument::add_stream(std::string_view dictionary, std::string_view content) {
  std::string body = "<<";
  append(body, {dictionary, "/Length ", std::to_string(content.size()), ">>\nstream\n", content, "\nendstream"});
  return add(std::move(body));
}

Bytes PdfDocument::finish(int catalog, int info) const {
  // Bytes above 127 in the comment tell transfer programs that the file is binary.
  std::string file = "%PDF-1.7\n%\xE2\xE3\xCF\xD3\n";
  std::string table = "xref\n0 ";
  append(table, {std::to_string(bodies_.size() + 1), "\n0000000000 65535 f \n"});
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    char entry[32];
    std::snprintf(entry, sizeof entry, "%010zu 00000 n \n", file.size());
    table += entry;
    append(file, {std::to_string(i + 1), " 0 obj\n", bodies_[i], "\nendobj\n"});
  }
  const std::string start = std::to_string(file.size());
  append(file, {table, "trailer\n<</Size ", std::to_string(bodies_.size() + 1), "/Root ", pdf_reference(catalog),
                "/Info ", pdf_reference(info), ">>\nstartxref\n", start, "\n%%EOF\n"});
  return Bytes(file.begin(), file.end());
}

std::string pdf_reference(int object) {
  std::string text = std::to_string(object);
  text += " 0 R";
  return text;
}

std::string pdf_string(std::string_view utf8) {
  std::string text = "(";
  for (std::size_t i = 0; i < utf8.size(); ++i) {
    auto byte = static_cast<unsigned char>(utf8[i]);
    if (byte >= 0x80) {
      const bool two_bytes = (byte == 0xC2 || byte == 0xC3) && i + 1 < utf8.size();
      const unsigned char latin = two_bytes ? static_cast<unsigned char>((byte & 3) << 6 | (utf8[i + 1] & 0x3F)) : '?';
      while (i + 1 < utf8.size() && (static_cast<unsigned char>(utf8[i + 1]) & 0xC0) == 0x80) ++i;
      byte = latin;
    }
    if (byte == '(' || byte == ')' || byte == '\\') text += '\\';
    if (byte >= 0x20) text += static_cast<char>(byte);
  }
  text += ")";
  return text;
}

}  // namespace toile
