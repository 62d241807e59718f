// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/make_mannequin.h"

#include <algorithm>
#include <cmath>

#include "engine/bodies/mannequin_proportions.h"
#include "engine/bodies/mannequin_shape.h"
#include "engine/bodies/mannequin_skeleton.h"
#include "engine/bodies/mannequin_tape.h"
#include "engine/bodies/measure_body.h"
#include "engine/core/error.h"
#include "engine/core/units.h"

namespace toile {
namespace {

// A measurement and what it moves: a factor of the shape.
struct Knob {
  const char* name;
  double& (*of)(MannequinShape&);
  double least, most;  // share of the height that a person may have
};

template <Girth G>
double& girth(MannequinShape& shape) {
  return shape.factor(G);
}

const std::vector<Knob>& knobs() {
  static const std::vector<Knob> all = {
      {"neck_girth", girth<Girth::Neck>, 0.12, 0.40},
      {"chest_girth", girth<Girth::Chest>, 0.35, 1.20},
      {"bust_girth", girth<Girth::Bust>, 0.35, 1.20},
      {"underbust_girth", girth<Girth::Underbust>, 0.30, 1.10},
      {"waist_girth", girth<Girth::Waist>, 0.25, 1.20},
      {"belly_girth", girth<Girth::Belly>, 0.30, 1.20},
      {"hip_girth", girth<Girth::Hip>, 0.40, 1.20},
      {"thigh_girth", girth<Girth::Thigh>, 0.18, 0.60},
      {"knee_girth", girth<Girth::Knee>, 0.14, 0.40},
      {"calf_girth", girth<Girth::Calf>, 0.13, 0.40},
      {"upper_arm_girth", girth<Girth::UpperArm>, 0.09, 0.40},
      {"wrist_girth", girth<Girth::Wrist>, 0.06, 0.16},
      {"inside_leg_length", [](MannequinShape& s) -> double& { return s.crotch_height; }, 0.36, 0.54},
      {"shoulder_width", [](MannequinShape& s) -> double& { return s.shoulder_width; }, 0.15, 0.33},
      {"arm_length", [](MannequinShape& s) -> double& { return s.arm_length; }, 0.25, 0.42},
  };
  return all;
}

constexpr double kLeastHeight = 0.75, kMostHeight = 2.3;  // m

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw Error(ErrorCode::OptionInvalid, "measurements/" + name, why);
}

void check(const Measurements& asked) {
  const auto names = mannequin_measurements();
  for (const auto& [name, value] : asked) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      std::string known;
      for (const std::string& one : names) known += (known.empty() ? "" : ", ") + one;
      refuse(name, "a mannequin is not made to this measurement; known are " + known);
    }
    if (!std::isfinite(value) || value <= 0.0) refuse(name, "give a positive number of metres");
  }
  const auto height = asked.find("height");
  if (height != asked.end() && (height->second < kLeastHeight || height->second > kMostHeight))
    refuse("height", "mannequins are between 0.75 m and 2.3 m tall; is the unit right?");
}

void check_range(const Measurements& asked, double height) {
  for (const Knob& knob : knobs()) {
    const auto found = asked.find(knob.name);
    if (found == asked.end()) continue;
    const double share = found->second / height;
    if (share < knob.least || share > knob.most)
      refuse(knob.name, "no person of " + std::to_string(std::lround(height * kMmPerMetre)) + " mm height measures " +
                            std::to_string(std::lround(found->second * kMmPerMetre)) + " mm here; is the unit right?");
  }
}

// By their definitions (measurements.md) these girths enclose the waist, the least girth of the trunk's middle.
void check_together(const Measurements& asked, double tolerance) {
  const auto waist = asked.find("waist_girth");
  if (waist == asked.end()) return;
  for (const char* name : {"hip_girth", "belly_girth", "chest_girth"}) {
    const auto other = asked.find(name);
    if (other == asked.end() || other->second > waist->second - tolerance) continue;
    refuse(name, std::to_string(std::lround(other->second * kMmPerMetre)) + " mm is less than the waist_girth, " +
                     std::to_string(std::lround(waist->second * kMmPerMetre)) +
                     " mm; the waist is the least girth between hip and chest: give the girth of a belly as "
                     "belly_girth");
  }
}

class MannequinMaker {
 public:
  MannequinMaker(const Measurements& asked, const MakeMannequinOptions& options)
      : asked_(asked), options_(options), wanted_(complete_measurements(asked, options.figure)) {}

  MakeMannequinResult run() {
    check_range(asked_, wanted_.at("height"));
    check_together(asked_, options_.tolerance);
    begin();
    build();
    int sweeps = 1;
    for (;; ++sweeps) {
      if (close_enough() || sweeps >= options_.most_sweeps) {
        measure();
        if (close_enough() || sweeps >= options_.most_sweeps) break;
      }
      adjust();
      build();
    }
    refuse_missed();
    return result(sweeps);
  }

 private:
  bool close_enough() const {
    constexpr double kCompletedSlack = 3.0;  // what nobody asked for need not be met as closely
    return worst_miss(asked_) < options_.close_enough && worst_miss(wanted_) < kCompletedSlack * options_.close_enough;
  }

  bool wanted(const char* name) const { return wanted_.contains(name); }

  void begin() {
    constexpr double kFatnessUnit = 0.06, kThinnest = -2.0,
                     kFattest = 4.5;  // of waist over height, as the tables were fitted
    constexpr double kAverageShare = 0.47;
    shape_.height = wanted_.at("height");
    shape_.crotch_height = wanted_.at("inside_leg_length");
    shape_.sex = options_.figure == Figure::Woman ? -1.0 : options_.figure == Figure::Man ? 1.0 : 0.0;
    const double share = wanted_.at("waist_girth") / shape_.height;
    shape_.fatness = std::clamp((share - kAverageShare) / kFatnessUnit, kThinnest, kFattest);
    const HeadSize head = head_size(options_.figure, shape_.height);
    shape_.head_girth = head.girth;
    shape_.head_height = head.height;
    constexpr double kUsualNeck = 0.222;  // of the height: a first guess, so that the neck is found
    shape_.factor(Girth::Neck) = wanted_.at("neck_girth") / (kUsualNeck * shape_.height * (1.0 + 0.1 * shape_.fatness));
  }

  // Factors no measurement moves go with their neighbours.
  void follow() {
    const auto factor = [&](Girth girth) -> double& { return shape_.factor(girth); };
    const auto between = [&](Girth a, Girth b) { return 0.5 * (factor(a) + factor(b)); };
    if (!wanted("bust_girth")) factor(Girth::Bust) = factor(Girth::Chest);
    if (!wanted("chest_girth")) factor(Girth::Chest) = factor(Girth::Bust);
    if (!wanted("underbust_girth")) factor(Girth::Underbust) = ribs_ * between(Girth::Bust, Girth::Waist);
    if (!wanted("belly_girth")) factor(Girth::Belly) = belly_ * between(Girth::Waist, Girth::Hip);
    factor(Girth::MidThigh) = between(Girth::Thigh, Girth::Knee);
    factor(Girth::Ankle) = between(Girth::Calf, Girth::Ankle);
    factor(Girth::Elbow) = between(Girth::UpperArm, Girth::Wrist);
  }

  void build() {
    follow();
    const MannequinTemplate& shared = mannequin_template();
    body_.surface.triangles = shared.triangles;
    body_.surface.vertices = mannequin_surface(shape_);
    body_.surface.vertices *= shape_.height / body_.surface.vertices.col(1).maxCoeff();
    body_.skeleton = mannequin_skeleton(body_.surface.vertices);
    const double bust_y = bust_points().at("bust_l").y();
    body_.measurements = measure_mannequin(body_.surface, shared.left_arm, *body_.skeleton, bust_y);
    for (auto& [name, value] : body_.measurements)
      if (const auto found = corrections_.find(name); found != corrections_.end()) value *= found->second;
  }

  // Where the tape goes over the bust: marked on the cage, for a stout person's front has no crest to find.
  Landmarks bust_points() const {
    const MannequinCage& cage = mannequin_template().cage;
    const int left = cage.trunk[7][2], right = cage.mirror_of[static_cast<std::size_t>(left)];
    return {{"bust_l", body_.surface.vertices.row(left)}, {"bust_r", body_.surface.vertices.row(right)}};
  }

  // As any other body.
  void measure() {
    MeasureBodyResult measured = measure_body(body_.surface, *body_.skeleton, bust_points());
    for (const auto& [name, value] : body_.measurements) {
      double& correction = corrections_.try_emplace(name, 1.0).first->second;
      correction *= measured.measurements.at(name) / value;
    }
    body_.landmarks = std::move(measured.landmarks);
    body_.measurements = std::move(measured.measurements);
  }

  double worst_miss(const Measurements& wanted) const {
    double worst = 0.0;
    for (const Knob& knob : knobs())
      if (wanted.contains(knob.name) && body_.measurements.contains(knob.name))
        worst = std::max(worst, std::abs(body_.measurements.at(knob.name) - wanted.at(knob.name)));
    return worst;
  }

  // What nobody asked for keeps out of the way: over and under the waist the body is no narrower, lest the least girth
  // be found there, and the belly lies between waist and hip.
  void keep_waist_least() {
    constexpr double kWaistShare = 0.45, kOverWaist = 1.01, kBelly = 0.42, kRibs = 0.77, kMost = 1.3;
    const double waist = wanted_.at("waist_girth"), hip = wanted_.at("hip_girth");
    const double most = std::max(kOverWaist * waist, kWaistShare * waist + (1.0 - kWaistShare) * hip);
    const auto brought = [&](double scale, double t, double least, double most_girth) {
      const double girth = trunk_girth(body_.surface, *body_.skeleton, t);
      return std::clamp(scale * std::clamp(girth, least, most_girth) / girth, 1.0 / kMost, kMost);
    };
    if (!wanted("belly_girth")) belly_ = brought(belly_, kBelly, kOverWaist * waist, most);
    if (!wanted("underbust_girth")) ribs_ = std::max(1.0, brought(ribs_, kRibs, kOverWaist * waist, 1e9));
  }

  // One step for every measurement on its own, in logarithms: as long as the last steps' effect suggests, and bounded,
  // for neighbours pull at each other and a largest girth may jump to another level.
  void adjust() {
    constexpr double kBoldest = 0.15, kLeastEffect = 0.5, kMostEffect = 1.2, kTellingStep = 2e-3;
    constexpr double kLeastFactor = 0.55, kMostFactor = 1.8;
    steps_.resize(knobs().size());
    for (std::size_t k = 0; k < knobs().size(); ++k) {
      const Knob& knob = knobs()[k];
      const auto found = wanted_.find(knob.name);
      if (found == wanted_.end() || !body_.measurements.contains(knob.name)) continue;
      Step& step = steps_[k];
      const double miss = std::log(found->second / body_.measurements.at(knob.name));
      if (std::abs(step.taken) > kTellingStep)
        step.effect = 0.5 * (step.effect + std::clamp((step.miss - miss) / step.taken, kLeastEffect, kMostEffect));
      double& value = knob.of(shape_);
      if (step.start == 0.0) step.start = value;
      const double before = value;
      value = std::clamp(value * std::exp(std::clamp(miss / step.effect, -kBoldest, kBoldest)),
                         kLeastFactor * step.start, kMostFactor * step.start);
      step.miss = miss;
      step.taken = std::log(value / before);
    }
    keep_waist_least();
  }

  void refuse_missed() const {
    for (const auto& [name, value] : asked_) {
      const double reached = body_.measurements.at(name);
      if (std::abs(reached - value) <= options_.tolerance) continue;
      refuse(name, "no mannequin has all these measurements at once: asked " +
                       std::to_string(std::lround(value * kMmPerMetre)) + " mm, reached " +
                       std::to_string(std::lround(reached * kMmPerMetre)) + " mm; check it against the others");
    }
  }

  MakeMannequinResult result(int sweeps) {
    MakeMannequinResult made;
    made.diagnostics.add("sweeps", sweeps)
        .add("worst_miss_mm", worst_miss(asked_) * kMmPerMetre)
        .add("worst_completed_miss_mm", worst_miss(wanted_) * kMmPerMetre);
    std::vector<std::string> completed;
    for (const auto& [name, value] : wanted_)
      if (!asked_.contains(name)) completed.push_back(name);
    made.diagnostics.add("completed", Record::Value(completed));
    made.body = std::move(body_);
    made.body.name = "mannequin";
    return made;
  }

  // Of one knob: where it started, the relative miss it answered, the step it took, and what a step of 1 brings.
  struct Step {
    double start = 0.0, miss = 0.0, taken = 0.0, effect = 1.0;
  };

  const Measurements& asked_;
  const MakeMannequinOptions& options_;
  const Measurements wanted_;
  MannequinShape shape_;
  Body body_;
  std::map<std::string, double> corrections_;  // of the quick measurements by the full ones
  std::vector<Step> steps_;
  double belly_ = 1.0, ribs_ = 1.0;  // of what lies between their neighbours, where no girth is asked for
};

}  // namespace

MakeMannequinResult make_mannequin(const Measurements& asked, const MakeMannequinOptions& options) {
  check(asked);
  return MannequinMaker(asked, options).run();
}

std::vector<std::string> mannequin_measurements() {
  std::vector<std::string> names = {"height"};
  for (const Knob& knob : knobs()) names.emplace_back(knob.name);
  return names;
}

}  // namespace toile
