// SPDX-License-Identifier: GPL-3.0-or-later
// How the core values are archived (archive.h), field by field.
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
  a(v.name, v.weft_stiffness, v.warp_stiffness, v.shear_stiffness, v.bending_stiffness, v.density);
}
template <class A>
void archive(A& a, EdgeCurve& v) {
  a(v.kind, v.control, v.radius, v.large_arc, v.bulges_right);
}
template <class A>
void archive(A& a, PanelEdge& v) {
  a(v.curve, v.label, v.name, v.seam_allowance, v.hem, v.locked, v.zip, v.straight, v.on_fold);
}
template <class A>
void archive(A& a, Notch& v) {
  a(v.edge, v.at, v.type);
}
template <class A>
void archive(A& a, KeepOut& v) {
  a(v.polygon, v.why);
}
template <class A>
void archive(A& a, Panel& v) {
  a(v.name, v.label, v.corners, v.edges, v.rotation, v.translation, v.notches, v.keep_outs, v.grainline, v.quantity,
    v.material, v.piece_label, v.locked);
}
template <class A>
void archive(A& a, SeamSide& v) {
  a(v.panel, v.edge);
}
template <class A>
void archive(A& a, Seam& v) {
  a(v.a, v.b, v.right_wrong);
}
template <class A>
void archive(A& a, Pattern& v) {
  a(v.name, v.panels, v.seams, v.fabric, v.seam_allowance, v.pins, v.symmetry, v.symmetry_plane);
}
template <class A>
void archive(A& a, PanelRange& v) {
  a(v.vertex_begin, v.vertex_end, v.triangle_begin, v.triangle_end);
}
template <class A>
void archive(A& a, PatternMesh& v) {
  a(v.rest, v.triangles, v.panels, v.panel_of_vertex, v.panel_of_triangle, v.panel_reversed, v.edge_vertices,
    v.seam_vertices, v.node_of_vertex, v.node_count, v.target_edge_length);
}
template <class A>
void archive(A& a, TriangleMesh& v) {
  a(v.vertices, v.triangles);
}
template <class A>
void archive(A& a, Skeleton::Arm& v) {
  a(v.shoulder, v.elbow, v.wrist, v.hand_end, v.length, v.girth, v.centre_line);
}
template <class A>
void archive(A& a, Skeleton::Leg& v) {
  a(v.hip, v.knee, v.ankle, v.toe);
}
template <class A>
void archive(A& a, Skeleton& v) {
  a(v.height, v.crotch_y, v.armpit_y, v.neck_y, v.waist_y, v.pelvis, v.waist, v.chest, v.neck, v.arms, v.legs);
}
template <class A>
void archive(A& a, Body& v) {
  a(v.name, v.kind, v.surface, v.normalised_from_file, v.skeleton, v.landmarks, v.measurements);
}
template <class A>
void archive(A& a, BodyMap& v) {
  a(v.mapped, v.exact);
}
template <class A>
void archive(A& a, Drape& v) {
  a(v.nodes);
}
template <class A>
void archive(A& a, FittingMap& v) {
  a(v.tensor, v.stretch_weft, v.stretch_warp, v.shear, v.rest_area, v.degenerate);
}

}  // namespace toile
