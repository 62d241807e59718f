// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/render/label_room.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/render/stroke_font.h"

namespace toile {
namespace {

struct TextBox {
  Vec2 middle, along, up;  // half axes
};

TextBox box_of(const Label& label) {
  const Vec2 along(std::cos(label.angle), -std::sin(label.angle)), up(along.y(), -along.x());
  return {label.at + 0.5 * label.height * up, 0.5 * text_width(label.text, label.height) * along,
          0.5 * label.height * up};
}

// Two rectangles are apart where they are so along a direction of one of their sides.
bool overlap(const TextBox& a, const TextBox& b) {
  const Vec2 between = b.middle - a.middle;
  for (const Vec2& side : {a.along, a.up, b.along, b.up}) {
    const auto reach = [&](const TextBox& box) { return std::abs(box.along.dot(side)) + std::abs(box.up.dot(side)); };
    if (std::abs(between.dot(side)) >= reach(a) + reach(b)) return false;
  }
  return true;
}

}  // namespace

std::vector<bool> labels_with_room(const std::vector<Label>& labels) {
  std::vector<std::size_t> order(labels.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return labels[a].text.size() > labels[b].text.size(); });
  std::vector<bool> room(labels.size());
  std::vector<TextBox> taken;
  for (const std::size_t i : order) {
    const TextBox box = box_of(labels[i]);
    room[i] = std::none_of(taken.begin(), taken.end(), [&](const TextBox& other) { return overlap(box, other); });
    if (room[i]) taken.push_back(box);
  }
  return room;
}

}  // namespace toile
