// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of one relaxation step of a sheet (stretch.h): what depends on the flat cloth and the plain map alone
// is made once and serves a sheet and all its copies, as long as none of them is cut. Metres.
#pragma once

#include "engine/alter/sheet.h"
#include "engine/numerics/plane_solver.h"

namespace toile {

class SheetEquations {
 public:
  // `hold`: see RelaxOptions.
  SheetEquations(const Sheet& sheet, double hold);

  // Begins where the cloth of `sheet` is: the sheet of the constructor or an uncut copy of it.
  void start(const Sheet& sheet);
  // New feet and normals of everything attached in `sheet`, and the factorisation that goes with them. Throws
  // Error{AlterationFailed}.
  void renew(const Sheet& sheet);
  // Moves the cloth to the least energy with the fibres' gradients as they are. Returns sum A |G - P|^2 before, m^2.
  double sweep();
  // Puts the vertices of `sheet` where they are now.
  void finish(Sheet& sheet) const;

  double area() const { return area_; }  // of all faces, m^2

 private:
  struct Face {
    std::array<int, 3> corner;
    Mat2 inverse;  // of its edges in the flat cloth
    double area;
    Vec2 length;  // wanted, of weft and warp
  };
  struct Pull {
    int vertex;
    Vec2 normal;
    double offset;  // n.c
  };
  // Cloth that can slide does not shift across the axis as a whole: sum A (x - g).a = 0.
  struct Middle {
    Points2 way;         // A a per vertex
    double wanted;       // the sum in the plain map
    Points2 answer;      // how the cloth gives way when pushed so
    double given = 0.0;  // how far that moves the sum
    bool holds = false;  // the cloth can slide
  };

  Mat2 gradient(const Face& face) const;
  bool slides() const;
  Middle middle_of(const Sheet& sheet) const;
  PlaneSolver solver_of(const Sheet& sheet);

  std::vector<Face> faces_;
  double area_ = 0.0, proximal_ = 0.0;
  double shear_kept_ = 1.0;
  std::vector<double> hold_;  // per vertex
  Points2 held_;              // what hold and the plain map add to the right-hand side
  double firmness_ = 1.0;     // times the hold: more for cloth that slides
  PlaneSolver solver_;
  std::vector<Mat2> ties_;  // per vertex: what the attachments add to the diagonal
  std::vector<Pull> pulls_;
  std::optional<Middle> middle_;  // of cloth that is its own mirror image
  Points2 now_, right_;
};

}  // namespace toile
