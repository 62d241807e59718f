// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>

#include "engine/core/error.h"
#include "engine/io/mesh_file.h"
#include "engine/io/obj_islands.h"
#include "engine/io/text_scanner.h"

namespace toile {

namespace {

constexpr std::size_t kLongestName = 100;
constexpr std::size_t kMostGroups = 10'000;
constexpr std::size_t kMostCorners = 1000;  // of one polygon
constexpr double kMostWanted = 10.0;        // of a wanted fit's entries: no cloth is stretched or squeezed by more

// Plain printable ASCII; anything else becomes an underscore.
std::string printable(std::string_view text) {
  std::string name(text.substr(0, kLongestName));
  for (char& c : name)
    if (c <= ' ' || c > '~') c = '_';
  return name;
}

class TexturedReader {
 public:
  TexturedReader(std::span<const std::uint8_t> bytes, const std::string& name)
      : scanner_(bytes, name, LineJoin::Backslash) {
    if (bytes.size() > limits_.bytes)
      throw Error(ErrorCode::LimitExceeded, name, "an OBJ garment may have at most 64 MiB; export a coarser mesh");
  }

  ObjTextured read() {
    std::string_view word;
    while (scanner_.next_line()) {
      if (!scanner_.next_word(word)) continue;
      if (word == "v")
        read_position();
      else if (word == "vt")
        read_texture();
      else if (word == "f")
        read_face();
      else if (word == "o" || word == "g")
        read_group();
      else if (word == "#fit")
        read_wanted_fit();
    }
    if (!obj_.wanted.empty() && obj_.wanted.size() != obj_.triangles.size())
      scanner_.fail("not every face has its \"#fit\"; have the file written again, or remove these lines");
    if (obj_.triangles.empty()) scanner_.fail("the file has no faces; export the garment as a mesh");
    return std::move(obj_);
  }

 private:
  double coordinate(std::string_view what) {
    const double value = scanner_.number(what);
    if (!(std::abs(value) <= limits_.coordinate)) scanner_.fail("a coordinate lies beyond 100,000; check the unit");
    return value;
  }
  void require_room(std::size_t count, std::int64_t most, const char* what) {
    if (static_cast<std::int64_t>(count) >= most)
      throw Error(ErrorCode::LimitExceeded, scanner_.subject(),
                  "line " + std::to_string(scanner_.line()) + ": more than " + std::to_string(most) + " " + what +
                      "; export a coarser mesh");
  }
  void read_position() {
    require_room(obj_.positions.size(), limits_.vertices, "vertices");
    const double x = coordinate("x"), y = coordinate("y"), z = coordinate("z");
    obj_.positions.emplace_back(x, y, z);
  }
  void read_texture() {
    require_room(obj_.texture.size(), 3 * limits_.triangles, "texture coordinates");
    const double u = coordinate("u"), v = coordinate("v");
    obj_.texture.emplace_back(u, v);
  }
  void read_group() {
    std::string_view word;
    const std::string name = scanner_.next_word(word) ? printable(word) : std::string();
    const auto [place, fresh] = group_numbers_.emplace(name, static_cast<int>(obj_.groups.size()));
    if (fresh) {
      if (obj_.groups.size() >= kMostGroups) scanner_.fail("more than 10,000 groups; export the garment alone");
      obj_.groups.push_back(name);
    }
    group_ = place->second;
  }
  void read_face() {
    std::vector<std::array<std::int32_t, 2>> corners;
    for (std::string_view word; scanner_.next_word(word) && !word.starts_with('#');) {
      if (corners.size() >= kMostCorners) scanner_.fail("a face has more than 1000 corners; export triangles");
      corners.push_back(read_corner(word));
    }
    if (corners.size() < 3) scanner_.fail("a face needs at least three corners; export the file again");
    require_room(obj_.triangles.size() + corners.size() - 3, limits_.triangles, "triangles");
    if (group_ < 0) group_ = 0, obj_.groups.emplace_back(), group_numbers_.emplace("", 0);
    for (std::size_t i = 2; i < corners.size(); ++i) {
      obj_.triangles.push_back({corners[0], corners[i - 1], corners[i]});
      obj_.group_of_triangle.push_back(group_);
    }
  }
  void read_wanted_fit() {
    const double weft = scanner_.number("the fit along the weft"), across = scanner_.number("the fit across"),
                 warp = scanner_.number("the fit along the warp");
    const auto usual = [](double value) { return value > 1.0 / kMostWanted && value < kMostWanted; };
    if (!usual(weft) || !usual(warp) || !(std::abs(across) < kMostWanted))
      scanner_.fail("the fit of a face is none that cloth can have; have the file written again");
    if (obj_.wanted.size() + 1 != obj_.triangles.size())
      scanner_.fail("\"#fit\" belongs behind a face with three corners; have the file written again");
    obj_.wanted.push_back((Mat2() << weft, across, 0.0, warp).finished());
  }
  std::array<std::int32_t, 2> read_corner(std::string_view word) {
    const std::size_t slash = word.find('/');
    const std::size_t second = slash == word.npos ? word.npos : word.find('/', slash + 1);
    if (slash == word.npos || second == slash + 1 || slash + 1 == word.size())
      scanner_.fail("a face has no texture coordinates; export the garment with its pattern as UVs");
    return {index(word.substr(0, slash), obj_.positions.size(), "vertex"),
            index(word.substr(slash + 1, second - slash - 1), obj_.texture.size(), "texture coordinate")};
  }
  std::int32_t index(std::string_view word, std::size_t count, const std::string& what) {
    const std::int64_t number = scanner_.to_integer(word, "the " + what + " of a face");
    const std::int64_t zero_based = number > 0 ? number - 1 : static_cast<std::int64_t>(count) + number;
    if (number == 0 || zero_based < 0 || zero_based >= static_cast<std::int64_t>(count))
      scanner_.fail("a face names " + what + " " + std::to_string(number) +
                    ", which is not there before it; export the file again");
    return static_cast<std::int32_t>(zero_based);
  }

  MeshLimits limits_;
  TextScanner scanner_;
  ObjTextured obj_;
  std::map<std::string, int> group_numbers_;
  int group_ = -1;
};

}  // namespace

ObjTextured read_textured_obj(std::span<const std::uint8_t> bytes, const std::string& name) {
  return TexturedReader(bytes, name).read();
}

}  // namespace toile
