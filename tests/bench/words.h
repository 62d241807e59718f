// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace toile::bench {

// A benchmark's own flags among its words: each is taken out when it is asked for.
class Words {
 public:
  explicit Words(std::vector<std::string> words) : words_(std::move(words)) {}
  bool flag(const std::string& name);                                     // --name
  std::optional<std::string> text(const std::string& name);               // --name VALUE
  std::optional<double> number(const std::string& name);                  // --name 1.5; 0 for a word
  std::optional<int> integer(const std::string& name);                    // --name 15
  std::optional<std::vector<std::string>> list(const std::string& name);  // --name A,B
  const std::vector<std::string>& rest() const { return words_; }         // what was not asked for

 private:
  std::vector<std::string> words_;
};

}  // namespace toile::bench
