// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/raise_body.h"

namespace toile {
namespace {

void raise_skeleton(Skeleton& s, double by) {
  for (double* y : {&s.height, &s.crotch_y, &s.armpit_y, &s.neck_y, &s.waist_y}) *y += by;
  for (Vec3* p : {&s.pelvis, &s.waist, &s.chest, &s.neck}) p->y() += by;
  for (Skeleton::Arm& arm : s.arms) {
    for (Vec3* p : {&arm.shoulder, &arm.elbow, &arm.wrist, &arm.hand_end}) p->y() += by;
    arm.centre_line.col(1).array() += by;
  }
  for (Skeleton::Leg& leg : s.legs)
    for (Vec3* p : {&leg.hip, &leg.knee, &leg.ankle, &leg.toe}) p->y() += by;
}

}  // namespace

void raise_body(Body& body, double by) {
  body.surface.vertices.col(1).array() += by;
  body.normalised_from_file(1, 3) += by;
  if (body.skeleton) raise_skeleton(*body.skeleton, by);
  for (auto& [name, point] : body.landmarks) point.y() += by;
  for (const char* height : {"height", "inside_leg_length"})
    if (const auto found = body.measurements.find(height); found != body.measurements.end()) found->second += by;
}

}  // namespace toile
