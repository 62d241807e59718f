// SPDX-License-Identifier: GPL-3.0-or-later
// How the core values are archived (archive.h), field by field. Every function names all fields of its type, so
// that it does not compile when one is added and forgotten here.
#pragma once

#include "engine/core/archive.h"
#include "engine/core/body.h"
#include "engine/core/drape.h"
#include "engine/core/fitting_map.h"
#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"

namespace toile {

template <class A>
void archive(A& a, Fabric& v) {
  auto& [name, weft_stiffness, warp_stiffness, shear_stiffness, bending_stiffness, density] = v;
  a(name, weft_stiffness, warp_stiffness, shear_stiffness, bending_stiffness, density);
}
template <class A>
void archive(A& a, EdgeCurve& v) {
  auto& [kind, control, radius, large_arc, bulges_right, points] = v;
  a(kind, control, radius, large_arc, bulges_right, points);
}
template <class A>
void archive(A& a, PanelEdge& v) {
  auto& [curve, label, name, seam_allowance, hem, locked, zip, straight, on_fold] = v;
  a(curve, label, name, seam_allowance, hem, locked, zip, straight, on_fold);
}
template <class A>
void archive(A& a, Notch& v) {
  auto& [edge, at, type] = v;
  a(edge, at, type);
}
template <class A>
void archive(A& a, KeepOut& v) {
  auto& [polygon, why] = v;
  a(polygon, why);
}
template <class A>
void archive(A& a, Panel& v) {
  auto& [name, label, corners, edges, rotation, translation, notches, keep_outs, grainline, quantity, material,
         piece_label, locked] = v;
  a(name, label, corners, edges, rotation, translation, notches, keep_outs, grainline, quantity, material, piece_label,
    locked);
}
template <class A>
void archive(A& a, SeamSide& v) {
  auto& [panel, edge] = v;
  a(panel, edge);
}
template <class A>
void archive(A& a, Seam& v) {
  auto& [first, second, right_wrong] = v;
  a(first, second, right_wrong);
}
template <class A>
void archive(A& a, Pattern& v) {
  auto& [name, panels, seams, fabric, seam_allowance, pins, symmetry, symmetry_plane] = v;
  a(name, panels, seams, fabric, seam_allowance, pins, symmetry, symmetry_plane);
}
template <class A>
void archive(A& a, PanelRange& v) {
  auto& [vertex_begin, vertex_end, triangle_begin, triangle_end] = v;
  a(vertex_begin, vertex_end, triangle_begin, triangle_end);
}
template <class A>
void archive(A& a, PatternMesh& v) {
  auto& [rest, triangles, panels, panel_of_vertex, panel_of_triangle, panel_reversed, edge_vertices, seam_vertices,
         node_of_vertex, node_count, target_edge_length] = v;
  a(rest, triangles, panels, panel_of_vertex, panel_of_triangle, panel_reversed, edge_vertices, seam_vertices,
    node_of_vertex, node_count, target_edge_length);
}
template <class A>
void archive(A& a, TriangleMesh& v) {
  auto& [vertices, triangles] = v;
  a(vertices, triangles);
}
template <class A>
void archive(A& a, Skeleton::Arm& v) {
  auto& [shoulder, elbow, wrist, hand_end, length, girth, centre_line] = v;
  a(shoulder, elbow, wrist, hand_end, length, girth, centre_line);
}
template <class A>
void archive(A& a, Skeleton::Leg& v) {
  auto& [hip, knee, ankle, toe] = v;
  a(hip, knee, ankle, toe);
}
template <class A>
void archive(A& a, Skeleton& v) {
  auto& [height, crotch_y, armpit_y, neck_y, waist_y, pelvis, waist, chest, neck, arms, legs] = v;
  a(height, crotch_y, armpit_y, neck_y, waist_y, pelvis, waist, chest, neck, arms, legs);
}
template <class A>
void archive(A& a, Body& v) {
  auto& [name, kind, surface, normalised_from_file, skeleton, landmarks, measurements] = v;
  a(name, kind, surface, normalised_from_file, skeleton, landmarks, measurements);
}
template <class A>
void archive(A& a, BodyMap& v) {
  auto& [mapped, exact] = v;
  a(mapped, exact);
}
template <class A>
void archive(A& a, Drape& v) {
  auto& [nodes] = v;
  a(nodes);
}
template <class A>
void archive(A& a, FittingMap& v) {
  auto& [tensor, stretch_weft, stretch_warp, shear, rest_area, degenerate] = v;
  a(tensor, stretch_weft, stretch_warp, shear, rest_area, degenerate);
}

}  // namespace toile
