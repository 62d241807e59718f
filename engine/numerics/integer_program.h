// SPDX-License-Identifier: GPL-3.0-or-later
// Linear programs in 0/1 variables: maximise w.x subject to lower <= a.x <= upper. Solved by GLPK's branch and cut;
// every answer is checked again here, since GLPK answers "optimal" even to a coefficient that is not a number.
#pragma once

#include <utility>
#include <vector>

#include "engine/core/types.h"

namespace toile {

struct IntegerConstraint {
  std::vector<std::pair<int, double>> terms;  // variable, coefficient; a variable at most once
  double lower = 0.0, upper = 0.0;            // may be infinite; lower <= upper
};

struct IntegerProgram {
  std::vector<double> weights;  // one per variable, finite; maximised
  std::vector<IntegerConstraint> constraints;
};

struct IntegerSolution {
  bool feasible = false;     // false also when the search was ended before it found an answer
  bool optimal = false;      // proved; false when the search was ended (after 1,000 nodes) with a feasible answer
  std::vector<bool> chosen;  // one per variable; empty when not feasible
  double value = 0.0;        // w.x
};

// Throws AlterationFailed when a number of the program is not finite (except infinite bounds), an index is out of
// range, or the solver's answer does not hold. Equal programs give equal answers.
IntegerSolution solve_integer_program(const IntegerProgram& program);

// Whether `chosen` keeps every constraint within rounding.
bool is_feasible(const IntegerProgram& program, const std::vector<bool>& chosen);

}  // namespace toile
