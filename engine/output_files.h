// SPDX-License-Identifier: GPL-3.0-or-later
// The files of a job while they are made: each one made once, and only when a job's option `outputs` asks for it or
// another file shows it.
#pragma once

#include <functional>
#include <optional>

#include "engine/core/record.h"
#include "engine/output_file.h"

namespace toile {

// Made when it is first asked for.
template <class T>
class OnDemand {
 public:
  explicit OnDemand(std::function<T()> make) : make_(std::move(make)) {}
  const T& value() {
    if (!value_) value_ = make_();
    return *value_;
  }

 private:
  std::function<T()> make_;
  std::optional<T> value_;
};

class OutputFiles {
 public:
  // `wanted`: names of files, or "all".
  explicit OutputFiles(const std::vector<std::string>& wanted) : wanted_(wanted) {}

  // Whether a file is made by make(), and whether also by make_if_named().
  bool wanted(const std::string& name) const { return named("all") || named(name); }
  bool named(const std::string& name) const;
  void make(const std::string& name, const char* type, const std::function<Bytes()>& work);
  // Diagnostics: "all" does not mean them.
  void make_if_named(const std::string& name, const char* type, const std::function<Bytes()>& work);
  // All files; result.json is always made, last: it lists the others with their sha256.
  std::vector<OutputFile> finish(Record result);

 private:
  std::vector<std::string> wanted_;
  std::vector<OutputFile> files_;
};

}  // namespace toile
