// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace toile::bench {
namespace {

constexpr double kWidth = 800, kHeight = 460, kLeft = 80, kRight = 230, kTop = 40, kBottom = 60;
constexpr std::array<const char*, 8> kColours = {"#1f77b4", "#d62728", "#2ca02c", "#9467bd",
                                                 "#ff7f0e", "#17becf", "#8c564b", "#7f7f7f"};

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return safe;
}

std::string text_at(double x, double y, const std::string& text, const char* anchor, const std::string& more = {}) {
  std::ostringstream out;
  out << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor << "\"" << more << ">" << escaped(text)
      << "</text>\n";
  return out.str();
}

std::string head(double height, const std::string& title) {
  std::ostringstream out;
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << kWidth << " " << height
      << "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
      << text_at(kWidth / 2, 22, title, "middle", " font-size=\"14\"");
  return out.str();
}

// A range of values and where they lie on the paper.
class Axis {
 public:
  Axis(bool logarithmic, double from, double to) : logarithmic_(logarithmic), from_(from), to_(to) {}

  bool usable(double value) const { return std::isfinite(value) && (!logarithmic_ || value > 0); }
  void include(double value) {
    if (!usable(value)) return;
    low_ = std::min(low_, scaled(value)), high_ = std::max(high_, scaled(value));
  }
  void finish() {
    if (low_ > high_) low_ = 0, high_ = 1;
    if (!logarithmic_) low_ = std::min(low_, 0.0);
    const double air = std::max(1e-9, 0.05 * (high_ - low_));
    high_ += air;
    if (logarithmic_) low_ -= air;
  }
  double at(double value) const { return from_ + (to_ - from_) * (scaled(value) - low_) / (high_ - low_); }
  // 1, 2, 5 times a power of ten, few enough to be read.
  std::vector<double> ticks() const {
    std::vector<double> found;
    if (logarithmic_) {
      const bool wide = high_ - low_ > 2;
      for (int power = static_cast<int>(std::floor(low_)); power <= high_; ++power)
        for (const double digit : {1.0, 2.0, 5.0}) {
          const double value = digit * std::pow(10.0, power);
          if (scaled(value) >= low_ && scaled(value) <= high_ && (digit == 1.0 || !wide)) found.push_back(value);
        }
      return found;
    }
    const double rough = (high_ - low_) / 6, power = std::pow(10.0, std::floor(std::log10(rough)));
    const double step = power * (rough < 2 * power ? 2 : rough < 5 * power ? 5 : 10);
    for (double value = 0; value <= high_; value += step) found.push_back(value);
    return found;
  }

 private:
  double scaled(double value) const { return logarithmic_ ? std::log10(value) : value; }
  bool logarithmic_;
  double from_, to_, low_ = 1e300, high_ = -1e300;
};

std::string grid(const Plot& plot, const Axis& x, const Axis& y) {
  std::ostringstream out;
  const double bottom = kHeight - kBottom, right = kWidth - kRight;
  for (const double value : x.ticks())
    out << "<path d=\"M" << x.at(value) << " " << kTop << "V" << bottom << "\" stroke=\"#ddd\"/>\n"
        << text_at(x.at(value), bottom + 16, short_number(value), "middle");
  for (const double value : y.ticks())
    out << "<path d=\"M" << kLeft << " " << y.at(value) << "H" << right << "\" stroke=\"#ddd\"/>\n"
        << text_at(kLeft - 6, y.at(value) + 4, short_number(value), "end");
  out << text_at((kLeft + right) / 2, kHeight - 18, plot.x_axis, "middle")
      << text_at(18, (kTop + bottom) / 2, plot.y_axis, "middle",
                 " transform=\"rotate(-90 18 " + short_number((kTop + bottom) / 2) + ")\"");
  return out.str();
}

std::string drawn(const Curve& curve, const char* colour, const Axis& x, const Axis& y) {
  std::ostringstream out, path;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (!x.usable(curve.x[i]) || !y.usable(curve.y[i])) continue;
    const double px = x.at(curve.x[i]), py = y.at(curve.y[i]);
    path << (path.tellp() > 0 ? "L" : "M") << px << " " << py;
    out << "<circle cx=\"" << px << "\" cy=\"" << py << "\" r=\"3.5\" fill=\"" << colour << "\"/>\n";
    if (i < curve.labels.size()) out << text_at(px + 6, py - 5, curve.labels[i], "start", " font-size=\"9\"");
  }
  if (curve.line) out << "<path d=\"" << path.str() << "\" fill=\"none\" stroke=\"" << colour << "\"/>\n";
  return out.str();
}

}  // namespace

void write_plot(const Plot& plot, const std::string& file) {
  Axis x(plot.log_x, kLeft, kWidth - kRight), y(plot.log_y, kHeight - kBottom, kTop);
  for (const Curve& curve : plot.curves) {
    for (const double value : curve.x) x.include(value);
    for (const double value : curve.y) y.include(value);
  }
  x.finish(), y.finish();
  std::ofstream out(file);
  out << head(kHeight, plot.title) << grid(plot, x, y);
  for (std::size_t c = 0; c < plot.curves.size(); ++c) {
    const char* colour = kColours[c % kColours.size()];
    out << drawn(plot.curves[c], colour, x, y);
    const double row = kTop + 10 + 18 * static_cast<double>(c);
    out << "<circle cx=\"" << kWidth - kRight + 14 << "\" cy=\"" << row - 4 << "\" r=\"4\" fill=\"" << colour
        << "\"/>\n"
        << text_at(kWidth - kRight + 24, row, plot.curves[c].name, "start");
  }
  out << "</svg>\n";
}

void write_bars(const Bars& bars, const std::string& file) {
  constexpr double kRow = 22, kNames = 190;
  const double height = kTop + kRow * static_cast<double>(bars.names.size()) + kBottom;
  Axis x(false, kNames, kWidth - 70);
  for (const double value : bars.values) x.include(value);
  for (const double value : bars.high) x.include(value);
  x.finish();
  std::ofstream out(file);
  out << head(height, bars.title);
  for (const double value : x.ticks())
    out << "<path d=\"M" << x.at(value) << " " << kTop << "V" << height - kBottom << "\" stroke=\"#ddd\"/>\n"
        << text_at(x.at(value), height - kBottom + 16, short_number(value), "middle");
  for (std::size_t i = 0; i < bars.names.size(); ++i) {
    const double top = kTop + kRow * static_cast<double>(i) + 4, middle = top + 7;
    out << text_at(kNames - 6, middle + 4, bars.names[i], "end") << "<rect x=\"" << x.at(0) << "\" y=\"" << top
        << "\" height=\"14\" width=\"" << std::max(0.0, x.at(bars.values[i]) - x.at(0)) << "\" fill=\"" << kColours[0]
        << "\"/>\n";
    if (i < bars.low.size() && i < bars.high.size())
      out << "<path d=\"M" << x.at(bars.low[i]) << " " << middle << "H" << x.at(bars.high[i])
          << "\" stroke=\"black\"/>\n";
    const double end = i < bars.high.size() ? std::max(bars.values[i], bars.high[i]) : bars.values[i];
    out << text_at(x.at(end) + 5, middle + 4, short_number(bars.values[i]), "start");
  }
  out << text_at((kNames + kWidth) / 2, height - 18, bars.axis, "middle") << "</svg>\n";
}

}  // namespace toile::bench
