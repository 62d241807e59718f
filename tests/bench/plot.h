// SPDX-License-Identifier: GPL-3.0-or-later
// Plots as SVG: curves over two axes, or bars. Small, for results that are looked at beside their table.
#pragma once

#include <string>
#include <vector>

namespace toile::bench {

struct Curve {
  std::string name;
  std::vector<double> x, y;
  std::vector<std::string> labels = {};  // beside the points; may be empty
  bool line = true;                      // false: points alone
};

struct Plot {
  std::string title, x_axis, y_axis;
  bool log_x = true, log_y = true;  // then values must be positive; others are left out
  std::vector<Curve> curves;
};
void write_plot(const Plot& plot, const std::string& file);

struct Bars {
  std::string title, axis;
  std::vector<std::string> names;
  std::vector<double> values, low, high;  // the spread; may be empty
};
void write_bars(const Bars& bars, const std::string& file);

}  // namespace toile::bench
