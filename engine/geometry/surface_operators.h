// SPDX-License-Identifier: GPL-3.0-or-later
// Areas, normals and the cotangent Laplacian of a triangle surface.
#pragma once

#include <Eigen/Sparse>

#include "engine/core/body.h"

namespace toile {

// Unit normals per vertex, weighted by the area of the triangles round it; zero where those cancel.
Points3 vertex_normals(const Points3& vertices, const Triangles& triangles);

// A third of the area of the triangles round each vertex, m^2.
Eigen::VectorXd vertex_areas(const Points3& vertices, const Triangles& triangles);

// Cotangent Laplacian, #V x #V, symmetric positive semi-definite: (L x)_i = sum_j w_ij (x_i - x_j),
// w_ij = half the sum of the cotangents opposite to the edge, kept within [least, most] so that slivers do no harm.
Eigen::SparseMatrix<double> cotangent_laplacian(const Points3& vertices, const Triangles& triangles, double least,
                                                double most);

// Laplacian of equal weights 1 per edge, #V x #V, symmetric positive semi-definite.
Eigen::SparseMatrix<double> graph_laplacian(const TriangleMesh& mesh);

// How noisy the surface is: median over the vertices of how much their distance from their neighbours' mean differs
// from that of their neighbours, over the median edge length. Curvature alone gives little (clean models under 0.045),
// scanner noise of a sixth of an edge 0.1 and more.
double surface_roughness(const TriangleMesh& mesh);
inline constexpr double kRoughScan = 0.06;  // rougher is a scan

// Smoothed copy: `steps` times an umbrella step of 0.5 and one of -0.52, which takes off noise without shrinking.
// Vertices on open edges stay. Source: [Tau95].
Points3 taubin_smooth(const TriangleMesh& mesh, int steps);

}  // namespace toile
