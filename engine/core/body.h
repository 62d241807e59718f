// SPDX-License-Identifier: GPL-3.0-or-later
// A body in the normalised frame: metres, Y up, facing +Z, wearer's left on +X, soles at y = 0.
#pragma once

#include <map>

#include "engine/core/types.h"

namespace toile {

struct TriangleMesh {
  Points3 vertices;     // #V x 3, m
  Triangles triangles;  // #F x 3, counter-clockwise seen from outside

  int vertex_count() const { return static_cast<int>(vertices.rows()); }
  int triangle_count() const { return static_cast<int>(triangles.rows()); }
};

enum class BodyKind {
  Human,  // a person, scanned or modelled, upright in A- or T-pose
  Form,   // any closed upright shape (dress form, test solid): taken as it stands, without limbs
};

// Named points on the skin: "shoulder_l", "elbow_r", "bust_l", "neck_front", "waist_back", "crotch", "head_top", ...
using Landmarks = std::map<std::string, Vec3>;

// Measurements under ISO 8559-1 names: "height", "waist_girth", "hip_girth", "inside_leg_length", ...  m.
using Measurements = std::map<std::string, double>;

enum Side { Left = 0, Right = 1 };  // the wearer's; Left is +X

// Joint centres on the medial axis, and the levels that divide the body.
struct Skeleton {
  double height = 0.0;
  double crotch_y = 0.0, armpit_y = 0.0, neck_y = 0.0, waist_y = 0.0;
  Vec3 pelvis = Vec3::Zero(), waist = Vec3::Zero(), chest = Vec3::Zero(), neck = Vec3::Zero();  // trunk axis

  struct Arm {
    Vec3 shoulder = Vec3::Zero(), elbow = Vec3::Zero(), wrist = Vec3::Zero(), hand_end = Vec3::Zero();
    double length = 0.0;       // along the arm, finger tip to where the arm meets the trunk
    double girth = 0.0;        // median girth of the arm between 45 % and 85 % of its length
    Points3 centre_line;       // ring centres from the finger tip up, #rings x 3
  };
  struct Leg {
    Vec3 hip = Vec3::Zero(), knee = Vec3::Zero(), ankle = Vec3::Zero(), toe = Vec3::Zero();
  };
  std::array<Arm, 2> arms;  // by Side
  std::array<Leg, 2> legs;
};

struct Body {
  std::string name;
  BodyKind kind = BodyKind::Human;
  TriangleMesh surface;                          // closed, oriented
  Mat4 normalised_from_file = Mat4::Identity();  // 4x4, row-major in documents
  std::optional<Skeleton> skeleton;              // none for a form
  Landmarks landmarks;                           // found or given; normalised frame
  Measurements measurements;
};

// Where every vertex of the reference body lies on the target body.
struct BodyMap {
  Points3 mapped;      // #V(reference) x 3, in the target's normalised frame
  bool exact = false;  // both bodies share one topology: correspondence is known, not found
};

}  // namespace toile
