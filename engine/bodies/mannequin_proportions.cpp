// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/mannequin_proportions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/units.h"

namespace toile {
namespace {

struct Proportion {
  const char* name;
  double average_cm;  // at the table's height
  double step_cm;     // a size up, same height; 0: a length
  bool leg = false;   // grows with the hip
};

using Proportions = std::vector<Proportion>;

struct FigureTable {
  double height_cm;
  Proportions rows;
};

const FigureTable& woman() {
  static const FigureTable table = {168.0,
                                    {{"bust_girth", 88.0, 4.0},
                                     {"waist_girth", 72.0, 4.1},
                                     {"hip_girth", 97.0, 3.2},
                                     {"thigh_girth", 56.0, 2.2, true},
                                     {"knee_girth", 36.5, 1.1, true},
                                     {"calf_girth", 36.0, 1.1, true},
                                     {"neck_girth", 33.5, 0.8},
                                     {"upper_arm_girth", 28.0, 1.4},
                                     {"wrist_girth", 15.5, 0.3},
                                     {"inside_leg_length", 78.5, 0.0}}};
  return table;
}

const FigureTable& man() {
  static const FigureTable table = {178.0,
                                    {{"chest_girth", 100.0, 4.0},
                                     {"waist_girth", 87.0, 4.3},
                                     {"hip_girth", 102.0, 3.0},
                                     {"thigh_girth", 58.0, 2.0, true},
                                     {"knee_girth", 38.5, 1.0, true},
                                     {"calf_girth", 38.5, 1.1, true},
                                     {"neck_girth", 38.5, 0.9},
                                     {"upper_arm_girth", 32.0, 1.4},
                                     {"wrist_girth", 17.0, 0.3},
                                     {"inside_leg_length", 84.5, 0.0}}};
  return table;
}

struct ChildRow {
  double height, chest, waist, hip, thigh, knee, calf, neck, upper_arm, wrist, inside_leg;  // cm
};
constexpr std::array<ChildRow, 6> kChildren = {{{92, 53, 51, 54, 30, 22.0, 20.5, 24.0, 16.0, 11.3, 37.5},
                                                {104, 56, 53, 58, 33, 24.0, 22.5, 25.0, 17.0, 11.8, 44.5},
                                                {116, 60, 55, 63, 36, 26.0, 24.5, 26.5, 18.0, 12.3, 52.0},
                                                {128, 64, 58, 69, 39, 28.0, 26.5, 28.0, 19.5, 12.9, 58.5},
                                                {146, 74, 65, 79, 45, 31.5, 30.5, 30.5, 22.5, 14.0, 67.5},
                                                {170, 88, 75, 93, 53, 36.0, 35.5, 34.5, 27.0, 15.8, 80.0}}};

// The row of this height, between the table's rows linearly, beyond them in proportion.
FigureTable child(double height_cm) {
  std::size_t k = 1;
  while (k + 1 < kChildren.size() && height_cm > kChildren[k].height) ++k;
  const ChildRow &a = kChildren[k - 1], &b = kChildren[k];
  const double at = std::clamp(height_cm, a.height, b.height), w = (at - a.height) / (b.height - a.height);
  const auto mix = [&](double ChildRow::*column) { return (1.0 - w) * a.*column + w * b.*column; };
  return {at,
          {{"chest_girth", mix(&ChildRow::chest), 4.0},
           {"waist_girth", mix(&ChildRow::waist), 4.2},
           {"hip_girth", mix(&ChildRow::hip), 3.6},
           {"thigh_girth", mix(&ChildRow::thigh), 2.2, true},
           {"knee_girth", mix(&ChildRow::knee), 1.1, true},
           {"calf_girth", mix(&ChildRow::calf), 1.1, true},
           {"neck_girth", mix(&ChildRow::neck), 0.8},
           {"upper_arm_girth", mix(&ChildRow::upper_arm), 1.3},
           {"wrist_girth", mix(&ChildRow::wrist), 0.3},
           {"inside_leg_length", mix(&ChildRow::inside_leg), 0.0}}};
}

// Half way between woman and man, at the mean of their heights; bust and chest are one.
FigureTable person() {
  FigureTable table = {0.5 * (woman().height_cm + man().height_cm), woman().rows};
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Proportion& other = man().rows[i];
    table.rows[i] = {other.name, 0.5 * (table.rows[i].average_cm + other.average_cm),
                     0.5 * (table.rows[i].step_cm + other.step_cm), other.leg};
  }
  return table;
}

FigureTable table_of(Figure figure, double height_cm) {
  switch (figure) {
    case Figure::Woman: return woman();
    case Figure::Man: return man();
    case Figure::Child: return child(height_cm);
    case Figure::Person: break;
  }
  return person();
}

double usual_height(Figure figure) {
  return figure == Figure::Child ? 1.28 : table_of(figure, 0.0).height_cm * kMetrePerCm;
}

// Bust and chest stand for each other where only one is known.
std::optional<double> known(const Measurements& asked, const std::string& name) {
  if (const auto found = asked.find(name); found != asked.end()) return found->second;
  const std::string other = name == "bust_girth" ? "chest_girth" : name == "chest_girth" ? "bust_girth" : "";
  if (const auto found = asked.find(other); found != asked.end()) return found->second;
  return std::nullopt;
}

// The waist is the least girth of the trunk's middle: what was completed gives way.
void keep_waist_least(const Measurements& asked, Measurements& complete) {
  constexpr double kOverWaist = 1.01;
  double& waist = complete.at("waist_girth");
  for (const char* name : {"hip_girth", "chest_girth", "bust_girth"}) {
    const auto found = complete.find(name);
    if (found == complete.end()) continue;
    if (!asked.contains(name))
      found->second = std::max(found->second, kOverWaist * waist);
    else if (!asked.contains("waist_girth"))
      waist = std::min(waist, found->second / kOverWaist);
  }
}

}  // namespace

Measurements complete_measurements(const Measurements& asked, Figure figure) {
  Measurements complete = asked;
  const double height = complete.try_emplace("height", usual_height(figure)).first->second;
  const FigureTable table = table_of(figure, height * kCmPerMetre);
  const double scale = height / table.height_cm;  // metres of this body per centimetre of the table
  const auto sizes_above = [&](const Proportion& row) -> std::optional<double> {
    const auto value = row.step_cm >= 1.0 ? known(asked, row.name) : std::nullopt;
    if (!value) return std::nullopt;
    return (*value / scale - row.average_cm) / row.step_cm;
  };
  double build = 0.0, hip_build = 0.0;
  int count = 0;
  bool hip_known = false;
  for (const Proportion& row : table.rows) {
    const auto sizes = sizes_above(row);
    if (!sizes) continue;
    build += *sizes;
    ++count;
    if (std::string_view(row.name) == "hip_girth") hip_build = *sizes, hip_known = true;
  }
  if (count > 0) build /= count;
  for (const Proportion& row : table.rows) {
    const std::string name = row.name;
    if ((name == "bust_girth" || name == "chest_girth") && known(asked, name)) continue;
    complete.try_emplace(name, scale * (row.average_cm + row.step_cm * (row.leg && hip_known ? hip_build : build)));
  }
  keep_waist_least(asked, complete);
  return complete;
}

HeadSize head_size(Figure figure, double height) {
  if (figure != Figure::Child) return {};
  constexpr double kAdultGirth = 0.355, kAdultHeight = 0.129;  // of body height
  const double girth = 0.49 + 0.07 * (height - 0.88), tall = 0.175 + 0.056 * (height - 0.90);
  return {std::max(1.0, girth / (kAdultGirth * height)), std::max(1.0, tall / (kAdultHeight * height))};
}

}  // namespace toile
