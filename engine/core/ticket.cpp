// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/ticket.h"

#include <string_view>

namespace toile {

std::string_view operation_name(OperationKind kind) {
  static constexpr std::array<std::string_view, 10> kNames = {
      "take_in",       "let_out",      "shorten",  "lengthen",    "insert_strip",
      "insert_gusset", "insert_godet", "dart_new", "dart_deepen", "cut_anew"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view operation_words(OperationKind kind) {
  static constexpr std::array<std::string_view, 10> kWords = {
      "take in",         "let out",        "shorten",        "lengthen",        "insert a strip",
      "insert a gusset", "insert a godet", "sew a new dart", "deepen the dart", "cut anew"};
  return kWords[static_cast<std::size_t>(kind)];
}

std::string_view fabric_need_name(FabricNeed need) {
  static constexpr std::array<std::string_view, 3> kNames = {"none", "within_allowance", "needs_fabric"};
  return kNames[static_cast<std::size_t>(need)];
}

}  // namespace toile
