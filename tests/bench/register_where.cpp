// SPDX-License-Identifier: GPL-3.0-or-later
// Where on the body a map slides off the truth, and which way: along the limb, round it, across its skin.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "engine/bodies/body_bones.h"
#include "engine/bodies/find_skeleton.h"
#include "engine/bodies/register_bodies.h"
#include "tests/bench/bench.h"
#include "tests/bench/register_tables.h"
#include "tests/support/registration/posed_body.h"
#include "tests/support/registration/registration_score.h"
#include "tests/support/shared_body.h"
#include "tests/support/sidecar.h"

namespace toile::bench {
namespace {

constexpr double kMasked = 0.3;  // as score_registration masks hands, head and feet

enum Part { PelvisPart, AbdomenPart, ChestPart, UpperArmPart, ForearmPart, ThighPart, ShinPart, kParts };
constexpr const char* kPartNames[] = {"pelvis", "abdomen", "chest", "upper arm", "forearm", "thigh", "shin"};
constexpr const char* kSectorNames[] = {"outer", "front", "inner", "back"};
constexpr int kBands = 3, kSectors = 4;

// One vertex's error in the frame of its limb on the truth; mirrored to the left.
struct Slip {
  int part = 0, band = 0, sector = 0;
  double level = 0.0, angle = 0.0;                // along the part, 0..1; about its axis
  double along = 0.0, round = 0.0, across = 0.0;  // m
};

struct LimbAxis {
  Vec3 low, high;
};

Vec3 to_left(Vec3 p, bool right) {
  if (right) p.x() = -p.x();
  return p;
}

LimbAxis axis_of(const Skeleton& s, int part, Side side) {
  const auto& leg = s.legs[side];
  const auto& arm = s.arms[side];
  switch (part) {
    case PelvisPart: return {Vec3(s.pelvis.x(), s.crotch_y - 0.02 * s.height, s.pelvis.z()), s.waist};
    case AbdomenPart: return {s.waist, s.chest};
    case ChestPart: return {s.chest, s.neck};
    case UpperArmPart: return {arm.elbow, arm.shoulder};
    case ForearmPart: return {arm.wrist, arm.elbow};
    case ThighPart: return {leg.knee, leg.hip};
    default: return {leg.ankle, leg.knee};
  }
}

int part_of(const Eigen::RowVectorXd& weights) {
  const auto both = [&](Bone b) { return weights[bone_of(b, Left)] + weights[bone_of(b, Right)]; };
  const double w[] = {weights[Pelvis], weights[Abdomen], weights[Chest], both(UpperArm),
                      both(Forearm),   both(Thigh),      both(Shin)};
  return static_cast<int>(std::max_element(w, w + kParts) - w);
}

bool is_judged(const Eigen::RowVectorXd& w, bool arms) {
  double masked = w[Head];
  for (const Side side : {Left, Right}) {
    masked += w[bone_of(Hand, side)] + w[bone_of(Foot, side)];
    if (!arms) masked += w[bone_of(UpperArm, side)] + w[bone_of(Forearm, side)];
  }
  return masked < kMasked;
}

std::vector<Slip> find_slips(const RegistrationReference& reference, const Points3& mapped,
                             const test::RegistrationCase& known) {
  const Skeleton skeleton = find_skeleton(known.truth).skeleton;
  std::vector<Slip> slips;
  for (Eigen::Index v = 0; v < mapped.rows(); ++v) {
    if (!is_judged(reference.weights.row(v), !known.arms_differ)) continue;
    const Vec3 truth = known.truth.vertices.row(v);
    const bool right = reference.surface.vertices(v, 0) < 0;
    Slip s;
    s.part = part_of(reference.weights.row(v));
    const LimbAxis axis = axis_of(skeleton, s.part, right ? Right : Left);
    const Vec3 low = to_left(axis.low, right), p = to_left(truth, right), up = to_left(axis.high, right) - low;
    const Vec3 error = to_left(Vec3(mapped.row(v)) - truth, right);
    const Vec3 along = up.normalized();
    const Vec3 off = (p - low) - (p - low).dot(along) * along;
    const Vec3 across = off.normalized(), round = along.cross(across);  // rising: outer, back, inner, front
    s.level = (p - low).dot(along) / up.norm();
    s.band = std::clamp(static_cast<int>(s.level * kBands), 0, kBands - 1);
    s.angle = std::atan2(off.z(), off.x());
    s.sector = ((static_cast<int>(std::lround(s.angle / (std::numbers::pi / 2))) % 4) + 4) % 4;
    s.along = error.dot(along), s.round = error.dot(round), s.across = error.dot(across);
    slips.push_back(s);
  }
  return slips;
}

double length(const Slip& s) {
  return std::sqrt(s.along * s.along + s.round * s.round + s.across * s.across);
}

template <class Of>
std::vector<double> values_of(const std::vector<Slip>& slips, const Of& of) {
  std::vector<double> out;
  for (const Slip& s : slips) out.push_back(of(s));
  return out;
}

void add_row(Table& table, const char* part, const std::string& band, const char* sector,
             const std::vector<Slip>& slips, std::size_t all) {
  if (slips.empty()) return;
  const auto off = values_of(slips, length);
  const auto far = std::count_if(off.begin(), off.end(), [](double v) { return v > 0.016; });
  table.add({part, band, sector, fixed(100.0 * static_cast<double>(slips.size()) / static_cast<double>(all), 1),
             mm(median(off)), fixed(100.0 * static_cast<double>(far) / static_cast<double>(off.size()), 0),
             mm(median(values_of(slips, [](const Slip& s) { return s.along; }))),
             mm(median(values_of(slips, [](const Slip& s) { return s.round; }))),
             mm(median(values_of(slips, [](const Slip& s) { return s.across; }))),
             mm(median(values_of(slips, [](const Slip& s) { return std::abs(s.along); }))),
             mm(median(values_of(slips, [](const Slip& s) { return std::abs(s.round); }))),
             mm(median(values_of(slips, [](const Slip& s) { return std::abs(s.across); })))});
}

std::vector<Slip> only(const std::vector<Slip>& slips, int part, int band, int sector) {
  std::vector<Slip> out;
  for (const Slip& s : slips)
    if (s.part == part && (band < 0 || s.band == band) && (sector < 0 || s.sector == sector)) out.push_back(s);
  return out;
}

bool in_group(int part, int group) {  // trunk, arms, legs, all
  if (group == 3) return true;
  if (part <= ChestPart) return group == 0;
  return (part <= ForearmPart) == (group == 1);
}

// The median were one component of the error nought in one part of the body, or its mean by level or by level and
// sector taken off.
void print_oracles(const std::vector<Slip>& slips) {
  const char* groups[] = {"trunk", "arms", "legs", "all"};
  Table table({"without", "in", "wholly", "level_mean", "level_sector_mean"});
  for (int component = 0; component < 3; ++component)
    for (int group = 0; group < 4; ++group) {
      std::vector<std::string> row = {component == 0   ? "along"
                                      : component == 1 ? "round"
                                                       : "along, round",
                                      groups[group]};
      for (int how = 0; how < 3; ++how) {
        constexpr int kLevels = 24, kTurns = 12;
        std::map<std::array<int, 3>, std::array<double, 3>> sums;
        const auto key = [&](const Slip& s) -> std::array<int, 3> {
          const int level = static_cast<int>(std::floor(s.level * kLevels));
          const int turn = static_cast<int>(std::floor((s.angle / std::numbers::pi + 1.0) * kTurns / 2));
          return {s.part, level, how == 2 ? turn : 0};
        };
        for (const Slip& s : slips) {
          auto& sum = sums[key(s)];
          sum[0] += s.along, sum[1] += s.round, sum[2] += 1.0;
        }
        std::vector<double> off;
        for (Slip s : slips) {
          if (in_group(s.part, group)) {
            const auto& sum = sums[key(s)];
            if (component != 1) s.along -= how == 0 ? s.along : sum[0] / sum[2];
            if (component != 0) s.round -= how == 0 ? s.round : sum[1] / sum[2];
          }
          off.push_back(length(s));
        }
        row.push_back(mm(median(off)));
      }
      table.add(std::move(row));
    }
  table.print();
}

void print_where(const std::string& name, const std::vector<Slip>& slips, const std::string& csv) {
  const auto off = values_of(slips, length);
  std::printf("%s: median %s, p95 %s mm of %zu vertices\n", name.c_str(), mm(median(off)).c_str(),
              mm(test::quantile(off, 0.95)).c_str(), off.size());
  Table table({"part", "band", "sector", "share_%", "median_mm", "over_16_%", "along", "round", "across", "|along|",
               "|round|", "|across|"});
  for (int part = 0; part < kParts; ++part) {
    add_row(table, kPartNames[part], "", "", only(slips, part, -1, -1), slips.size());
    for (int band = 0; band < kBands; ++band) {
      const std::string number = std::to_string(band + 1);
      add_row(table, kPartNames[part], number, "", only(slips, part, band, -1), slips.size());
      for (int sector = 0; sector < kSectors; ++sector)
        add_row(table, kPartNames[part], number, kSectorNames[sector], only(slips, part, band, sector), slips.size());
    }
  }
  table.print(csv);
  print_oracles(slips);
}

}  // namespace

int bench_register_where(const Arguments& arguments) {
  std::vector<std::string> names(arguments.words.begin() + 1, arguments.words.end());
  if (names.empty()) names = {"scan_c", "mh_male_old_heavy"};
  for (const std::string& name : names) {
    const test::RegistrationCase known = find_case(name);
    const std::string from = name.starts_with("ggg_") || name == "scan_b" ? "ggg_mean_all" : "mh_female_average";
    const RegistrationReference reference = prepare_reference(test::load_shared_body(from));
    const RegisterBodiesResult result = register_bodies(reference, known.target);
    print_where(name, find_slips(reference, result.map.mapped, known), arguments.csv);
    Table marks({"landmark", "off_mm", "x", "y", "z"});
    for (const auto& [landmark, vertex] : test::load_body_sidecar(from).landmark_vertex) {
      const Vec3 e = Vec3(result.map.mapped.row(vertex)) - known.landmarks.at(landmark);
      marks.add({landmark, mm(e.norm()), mm(e.x()), mm(e.y()), mm(e.z())});
    }
    marks.print();
  }
  return 0;
}

}  // namespace toile::bench
