// SPDX-License-Identifier: GPL-3.0-or-later
// Help texts of the command line: one option a paragraph, wrapped, with its choices or range, default and variable
// written out; a command's help ends in what all commands share.
#pragma once

#include <CLI/CLI.hpp>

namespace toile::app {

class HelpText : public CLI::Formatter {
 public:
  HelpText() { column_width(30); }
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_footer(const CLI::App* app) const override;
};

}  // namespace toile::app
