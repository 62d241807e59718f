// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/dxf.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>

namespace toile {

namespace {

constexpr std::size_t kLongestBlockName = 20;
constexpr double kGap = 50.0;         // mm between inserted pieces
constexpr double kTextHeight = 8.0;   // mm
constexpr double kTextLine = 12.0;    // mm from one line of system text to the next
constexpr double kOnBoundary = 0.05;  // mm; a fold this near to the cut line is the piece's mirror line

// Layers of the standard.
enum Layer {
  kBoundary = 1,
  kTurnPoints = 2,
  kCurvePoints = 3,
  kNotches = 4,
  kMirrorLine = 6,
  kGrainLine = 7,
  kInternalLines = 8,
  kSewLines = 14,
  kAnnotation = 15,
  kTNotches = 80,
  kCastleNotches = 81,
  kCheckNotches = 82,
  kUNotches = 83,
  kBoundaryCopy = 84,
  kInternalCopy = 85,
  kSewCopy = 87,
};

// Printable 7-bit ASCII; anything else becomes an underscore, one for each character of UTF-8.
std::string ascii(std::string_view text) {
  std::string plain;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0) == 0x80) continue;  // the rest of a character begun before
    plain += byte >= 32 && byte < 127 ? c : '_';
  }
  return plain;
}

// Letters, digits, - and _, at most 20, each once in the file.
std::string block_name(std::string_view piece, std::set<std::string>& used) {
  std::string name = ascii(piece);
  for (char& c : name)
    c = std::isalnum(static_cast<unsigned char>(c)) || c == '-'
            ? static_cast<char>(std::toupper(static_cast<unsigned char>(c)))
            : '_';
  if (name.empty()) name.assign("PIECE");
  name = name.substr(0, kLongestBlockName);
  std::string unique = name;
  for (int i = 2; !used.insert(unique).second; ++i) {
    const std::string suffix = std::string("_").append(std::to_string(i));
    unique = name.substr(0, kLongestBlockName - suffix.size()) + suffix;
  }
  return unique;
}

class DxfText {
 public:
  void group(int code, std::string_view value) {
    char head[16];
    std::snprintf(head, sizeof head, "%3d\r\n", code);
    text_ += head;
    text_ += value;
    text_ += "\r\n";
  }
  void group(int code, int value) { group(code, std::to_string(value)); }
  void group(int code, double millimetres) {
    char value[40];
    std::snprintf(value, sizeof value, "%.2f", millimetres);
    group(code, std::string_view(value) == "-0.00" ? "0.00" : value);
  }
  void entity(std::string_view kind, int layer) {
    group(0, kind);
    group(8, layer);
  }
  void place(const Vec2& p) {
    group(10, p.x());
    group(20, p.y());
  }
  void text(int layer, const Vec2& at, double height, std::string_view words) {
    entity("TEXT", layer);
    place(at);
    group(40, height);
    group(1, ascii(words));
  }
  void point(int layer, const Vec2& at) {
    entity("POINT", layer);
    place(at);
  }
  void line(int layer, const Vec2& from, const Vec2& to) {
    entity("LINE", layer);
    place(from);
    group(11, to.x());
    group(21, to.y());
  }
  void polyline(int layer, const std::vector<Vec2>& points, bool closed) {
    entity("POLYLINE", layer);
    group(66, 1);
    group(70, closed ? 1 : 0);
    for (const Vec2& p : points) {
      entity("VERTEX", layer);
      place(p);
    }
    entity("SEQEND", layer);
  }
  Bytes take() { return Bytes(text_.begin(), text_.end()); }

 private:
  std::string text_;
};

double distance_to_line(const Vec2& p, const DrawingLine& line) {
  double nearest = 1e300;
  const std::size_t n = line.points.size();
  for (std::size_t i = 0; i + (line.closed ? 0 : 1) < n; ++i) {
    const Vec2 &a = line.points[i], d = line.points[(i + 1) % n] - a;
    const double t = d.squaredNorm() > 0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (p - a - t * d).norm());
  }
  return nearest;
}

// A fold that is part of the cut line is where the cloth is cut folded; a hem's fold lies inside.
bool is_mirror_line(const DrawingPiece& piece, const DrawingLine& fold) {
  return std::any_of(piece.lines.begin(), piece.lines.end(), [&](const DrawingLine& cut) {
    return cut.kind == LineKind::Cut && !fold.points.empty() &&
           distance_to_line(fold.points.front(), cut) < kOnBoundary &&
           distance_to_line(fold.points.back(), cut) < kOnBoundary;
  });
}

int layer_of(const DrawingPiece& piece, const DrawingLine& line) {
  switch (line.kind) {
    case LineKind::Cut: return kBoundary;
    case LineKind::Stitch: return kSewLines;
    case LineKind::Grainline: return kGrainLine;
    case LineKind::Fold: return is_mirror_line(piece, line) ? kMirrorLine : kInternalLines;
    default: return kInternalLines;
  }
}

int layer_of(NotchType type) {
  switch (type) {
    case NotchType::T: return kTNotches;
    case NotchType::Castle: return kCastleNotches;
    case NotchType::Check: return kCheckNotches;
    case NotchType::U: return kUNotches;
    case NotchType::V: return kNotches;
  }
  return kNotches;
}

class DxfWriter {
 public:
  DxfWriter(const Drawing& drawing, const DxfOptions& options) : drawing_(drawing), options_(options) {
    std::set<std::string> used;
    for (const DrawingPiece& piece : drawing.pieces) names_.push_back(block_name(piece.name, used));
  }

  Bytes write() {
    section("HEADER");
    end_section();
    section("BLOCKS");
    for (std::size_t i = 0; i < drawing_.pieces.size(); ++i) write_block(drawing_.pieces[i], names_[i]);
    end_section();
    section("ENTITIES");
    write_style();
    write_inserts();
    end_section();
    out_.group(0, "EOF");
    return out_.take();
  }

 private:
  void section(std::string_view name) {
    out_.group(0, "SECTION");
    out_.group(2, name);
  }
  void end_section() { out_.group(0, "ENDSEC"); }

  void write_block(const DrawingPiece& piece, const std::string& name) {
    out_.entity("BLOCK", kBoundary);
    out_.group(2, name);
    out_.group(70, 64);
    out_.place(Vec2::Zero());
    for (const DrawingLine& line : piece.lines) write_line(piece, line);
    for (const DrawingNotch& notch : piece.notches) write_notch(notch);
    for (const DrawingText& text : piece.texts) out_.text(kAnnotation, text.at, text.height, text.text);
    write_piece_text(piece, name);
    out_.entity("ENDBLK", kBoundary);
  }

  void write_line(const DrawingPiece& piece, const DrawingLine& line) {
    if (line.points.size() < 2 || line.kind == LineKind::Original) return;  // the old outline is not for the cutter
    const int layer = layer_of(piece, line);
    write_points(layer, line);
    if (layer == kBoundary) write_turns(line);
    if (options_.dialect != DxfDialect::Astm) return;
    if (layer == kBoundary) write_points(kBoundaryCopy, line);
    if (layer == kInternalLines) write_points(kInternalCopy, line);
    if (layer == kSewLines) write_points(kSewCopy, line);
  }

  void write_points(int layer, const DrawingLine& line) {
    const std::size_t n = line.points.size();
    if (!options_.lines_only && n > 2) return out_.polyline(layer, line.points, line.closed);
    for (std::size_t i = 0; i + (line.closed ? 0 : 1) < n; ++i)
      out_.line(layer, line.points[i], line.points[(i + 1) % n]);
  }

  void write_turns(const DrawingLine& line) {
    for (std::size_t i = 0; i < line.points.size(); ++i)
      out_.point(line.is_turn(i) ? kTurnPoints : kCurvePoints, line.points[i]);
  }

  void write_notch(const DrawingNotch& notch) {
    out_.point(layer_of(notch.type), notch.at);
    out_.group(30, notch.depth);
    out_.group(39, notch.width);
    const double angle = std::atan2(notch.inward.y(), notch.inward.x()) * 180.0 / std::numbers::pi;
    out_.group(50, angle < 0 ? angle + 360.0 : angle);
  }

  void write_piece_text(const DrawingPiece& piece, const std::string& name) {
    const auto [low, high] = bounds(piece);
    Vec2 at(0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()));
    const auto line = [&](const std::string& words) {
      out_.text(kBoundary, at, kTextHeight, words);
      at.y() -= kTextLine;
    };
    line("Piece Name: " + name);
    line("Size: " + options_.size);
    line(std::string("Quantity: ").append(std::to_string(piece.quantity)).append(",0"));
    if (!piece.material.empty()) line("Material: " + piece.material);
    if (!piece.label.empty()) line("Annotation: " + piece.label);
  }

  void write_style() {
    Vec2 at(0, -kGap);
    const auto line = [&](const std::string& words) {
      out_.text(kBoundary, at, kTextHeight, words);
      at.y() -= kTextLine;
    };
    line("Style Name: " + drawing_.title);
    line("Creation Date: " + options_.creation_date);
    line("Creation Time: " + options_.creation_time);
    line("Author: " + options_.author);
    line("Sample Size: " + options_.size);
    line("Grade Rule Table: ");
    line("Units: METRIC");
    line("Curve Tolerance: 0.02");
    line(options_.dialect == DxfDialect::Astm ? "ASTM/D13Proposal 1 Version: D6673-10" : "ANSI/AAMA Version: 1.0.0");
  }

  // Side by side, so that a program that knows no apparel shows every piece.
  void write_inserts() {
    double right = 0.0;
    for (std::size_t i = 0; i < drawing_.pieces.size(); ++i) {
      const auto [low, high] = bounds(drawing_.pieces[i]);
      out_.entity("INSERT", kBoundary);
      out_.group(2, names_[i]);
      out_.place(Vec2(right - low.x(), -low.y()));
      right += high.x() - low.x() + kGap;
    }
  }

  const Drawing& drawing_;
  const DxfOptions& options_;
  std::vector<std::string> names_;
  DxfText out_;
};

}  // namespace

Bytes write_dxf(const Drawing& drawing, const DxfOptions& options) {
  return DxfWriter(drawing, options).write();
}

}  // namespace toile
