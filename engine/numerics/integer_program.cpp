// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/numerics/integer_program.h"

#include <cmath>
#include <limits>
#include <memory>

#include <glpk.h>

#include "engine/core/error.h"

namespace toile {
namespace {

constexpr double kFeasibility = 1e-7;
constexpr int kMostNodes = 1000;  // of the search; garments need ten

void check(const IntegerProgram& program) {
  const auto refuse = [](const char* what) { throw Error(ErrorCode::AlterationFailed, "integer_program", what); };
  const int count = static_cast<int>(program.weights.size());
  for (const double weight : program.weights)
    if (!std::isfinite(weight)) refuse("a weight is not finite");
  for (const IntegerConstraint& row : program.constraints) {
    std::vector<bool> seen(program.weights.size(), false);
    if (!(row.lower <= row.upper)) refuse("a constraint's lower bound is above its upper one");
    for (const auto& [variable, coefficient] : row.terms) {
      if (variable < 0 || variable >= count) refuse("a constraint names an unknown variable");
      if (!std::isfinite(coefficient)) refuse("a coefficient is not finite");
      if (seen[static_cast<std::size_t>(variable)]) refuse("a constraint names a variable twice");
      seen[static_cast<std::size_t>(variable)] = true;
    }
  }
}

struct ProblemDeleter {
  void operator()(glp_prob* problem) const { glp_delete_prob(problem); }
};
using Problem = std::unique_ptr<glp_prob, ProblemDeleter>;

int bound_type(double lower, double upper) {
  if (lower == upper) return GLP_FX;
  if (std::isinf(lower) && std::isinf(upper)) return GLP_FR;
  if (std::isinf(lower)) return GLP_UP;
  if (std::isinf(upper)) return GLP_LO;
  return GLP_DB;
}

// GLPK keeps memory of its own for every thread that has called it.
struct ThreadMemory {
  ~ThreadMemory() { glp_free_env(); }
};

Problem build(const IntegerProgram& program) {
  thread_local const ThreadMemory memory;
  Problem problem(glp_create_prob());
  glp_set_obj_dir(problem.get(), GLP_MAX);
  const int columns = static_cast<int>(program.weights.size());
  glp_add_cols(problem.get(), columns);
  for (int j = 0; j < columns; ++j) {
    glp_set_col_kind(problem.get(), j + 1, GLP_BV);
    glp_set_obj_coef(problem.get(), j + 1, program.weights[static_cast<std::size_t>(j)]);
  }
  if (program.constraints.empty()) return problem;
  glp_add_rows(problem.get(), static_cast<int>(program.constraints.size()));
  for (std::size_t i = 0; i < program.constraints.size(); ++i) {
    const IntegerConstraint& row = program.constraints[i];
    const int number = static_cast<int>(i) + 1;
    glp_set_row_bnds(problem.get(), number, bound_type(row.lower, row.upper), row.lower, row.upper);
    std::vector<int> index = {0};  // GLPK counts from 1
    std::vector<double> value = {0.0};
    for (const auto& [variable, coefficient] : row.terms) {
      index.push_back(variable + 1);
      value.push_back(coefficient);
    }
    glp_set_mat_row(problem.get(), number, static_cast<int>(row.terms.size()), index.data(), value.data());
  }
  return problem;
}

// Ends a search that has looked at too many nodes; seconds instead of nodes would end equal programs differently.
void count_node(glp_tree* tree, void* nodes) {
  if (glp_ios_reason(tree) == GLP_ISELECT && ++*static_cast<int*>(nodes) > kMostNodes) glp_ios_terminate(tree);
}

}  // namespace

bool is_feasible(const IntegerProgram& program, const std::vector<bool>& chosen) {
  for (const IntegerConstraint& row : program.constraints) {
    double sum = 0.0, scale = 1.0;
    for (const auto& [variable, coefficient] : row.terms) {
      if (chosen[static_cast<std::size_t>(variable)]) sum += coefficient;
      scale = std::max(scale, std::abs(coefficient));
    }
    if (sum < row.lower - kFeasibility * scale || sum > row.upper + kFeasibility * scale) return false;
  }
  return true;
}

IntegerSolution solve_integer_program(const IntegerProgram& program) {
  check(program);
  IntegerSolution solution;
  if (program.weights.empty()) {
    solution.feasible = solution.optimal = is_feasible(program, {});
    return solution;
  }
  glp_term_out(GLP_OFF);
  const Problem problem = build(program);
  glp_iocp parameters;
  glp_init_iocp(&parameters);
  parameters.presolve = GLP_ON;
  parameters.msg_lev = GLP_MSG_OFF;
  int nodes = 0;
  parameters.cb_func = count_node;
  parameters.cb_info = &nodes;
  const int code = glp_intopt(problem.get(), &parameters);
  const int status = glp_mip_status(problem.get());
  if ((code != 0 && code != GLP_ESTOP) || (status != GLP_OPT && status != GLP_FEAS)) return solution;
  for (std::size_t j = 0; j < program.weights.size(); ++j) {
    const bool on = glp_mip_col_val(problem.get(), static_cast<int>(j) + 1) > 0.5;
    solution.chosen.push_back(on);
    if (on) solution.value += program.weights[j];
  }
  if (!is_feasible(program, solution.chosen))
    throw Error(ErrorCode::AlterationFailed, "integer_program", "the solver's answer breaks a constraint");
  solution.feasible = true;
  solution.optimal = status == GLP_OPT;
  return solution;
}

}  // namespace toile
