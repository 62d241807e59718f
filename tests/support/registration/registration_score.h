// SPDX-License-Identifier: GPL-3.0-or-later
// How far a body map is from the known truth of ../shared/data: scans whose source body is known, and bodies of one
// family.
#pragma once

#include <string>

#include "engine/core/body.h"

namespace toile::test {

// A target whose correspondence with one family of reference bodies is known.
struct RegistrationCase {
  Body target;               // as import_body hands it over, without patches over holes
  TriangleMesh truth;        // the source body's vertices where they lie on the target (noise free), target frame
  Landmarks landmarks;       // true, target frame
  bool arms_differ = false;  // the scan's arms are posed otherwise than the source's: judge trunk and legs only
};

RegistrationCase scan_case(const std::string& scan);
// A body of shared/data with vertices and triangles shuffled, so that nothing but its shape is known.
RegistrationCase shuffled_case(const std::string& body, unsigned seed = 1);

struct RegistrationScore {
  double median = 0, p95 = 0;                    // m, vertex to its true place; hands, head and feet left out
  double surface_mean = 0, surface_p95 = 0;      // m, vertex to the true surface; same vertices
  double landmark_median = 0, landmark_max = 0;  // m
};
// `weights`: bone_weights of the reference, whose vertices correspond to those of `truth` if `same_family`.
RegistrationScore score_registration(const Points3& mapped, const Eigen::MatrixXd& weights,
                                     const RegistrationCase& known, const std::string& reference_name,
                                     bool same_family);

double quantile(std::vector<double> values, double fraction);
Points3 moved(const Points3& points, const Mat4& m);  // each of them m * p

}  // namespace toile::test
