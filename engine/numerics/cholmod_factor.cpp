// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/numerics/cholmod_factor.h"

#include <cassert>
#include <cstring>

#include <cholmod.h>
#include <dlfcn.h>

extern "C" void openblas_set_num_threads(int threads);

namespace toile {
namespace {

// One BLAS thread: sums in another order would change bytes with the number of threads.
void use_one_blas_thread() {
  static const bool done = (openblas_set_num_threads(1), true);
  (void)done;
}

// CHOLMOD's own loops, too: four OpenMP threads waiting for each other cost more than the small matrices they share.
// The OpenMP that CHOLMOD brings along is asked for by name, as nothing else here is built with it; what is set holds
// for the calling thread.
void use_no_openmp_threads() {
  using SetLevels = void (*)(int);
  static const auto set_levels = reinterpret_cast<SetLevels>(dlsym(RTLD_DEFAULT, "omp_set_max_active_levels"));
  if (set_levels) set_levels(0);
}

cholmod_sparse view_of(const SparseMatrix& matrix) {
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(matrix.rows());
  view.nzmax = static_cast<std::size_t>(matrix.nonZeros());
  view.p = const_cast<int*>(matrix.outerIndexPtr());
  view.i = const_cast<int*>(matrix.innerIndexPtr());
  view.x = const_cast<double*>(matrix.valuePtr());
  view.stype = -1;  // symmetric, lower triangle
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  return view;
}

bool same(const Eigen::VectorXi& kept, const int* indices) {
  return std::memcmp(kept.data(), indices, sizeof(int) * static_cast<std::size_t>(kept.size())) == 0;
}

}  // namespace

CholmodFactor::CholmodFactor(FactorShape shape) : common_(std::make_unique<cholmod_common>()) {
  use_one_blas_thread();
  cholmod_start(common());
  common_->print = 0;
  common_->nmethods = 1;  // AMD only: METIS is not always there
  common_->method[0].ordering = CHOLMOD_AMD;
  common_->postorder = 1;
  if (shape == FactorShape::Simplicial) common_->supernodal = CHOLMOD_SIMPLICIAL;
}

CholmodFactor::~CholmodFactor() {
  cholmod_free_factor(&factor_, common());
  cholmod_finish(common());
}

bool CholmodFactor::same_pattern(const SparseMatrix& matrix, const std::vector<int>& last) const {
  return factor_ && last == last_ && outer_.size() == matrix.outerSize() + 1 && inner_.size() == matrix.nonZeros() &&
         same(outer_, matrix.outerIndexPtr()) && same(inner_, matrix.innerIndexPtr());
}

void CholmodFactor::analyse(const SparseMatrix& matrix, const std::vector<int>& last) {
  cholmod_sparse view = view_of(matrix);
  cholmod_free_factor(&factor_, common());
  if (last.empty()) {
    common_->method[0].ordering = CHOLMOD_AMD;
    factor_ = cholmod_analyze(&view, common());
  } else {
    std::vector<int> late(static_cast<std::size_t>(matrix.rows()), 0), order(late.size());
    for (const int i : last) late[static_cast<std::size_t>(i)] = 1;
    common_->method[0].ordering = CHOLMOD_GIVEN;
    if (cholmod_camd(&view, nullptr, 0, late.data(), order.data(), common()))
      factor_ = cholmod_analyze_p(&view, order.data(), nullptr, 0, common());
  }
}

bool CholmodFactor::compute(const SparseMatrix& matrix, const std::vector<int>& last) {
  assert(matrix.rows() == matrix.cols() && matrix.isCompressed());
  if (!Eigen::Map<const Eigen::VectorXd>(matrix.valuePtr(), matrix.nonZeros()).allFinite()) return false;
  use_no_openmp_threads();
  cholmod_sparse view = view_of(matrix);
  if (!same_pattern(matrix, last)) {
    analyse(matrix, last);
    if (!factor_) return false;
    last_ = last;
    outer_ = Eigen::Map<const Eigen::VectorXi>(matrix.outerIndexPtr(), matrix.outerSize() + 1);
    inner_ = Eigen::Map<const Eigen::VectorXi>(matrix.innerIndexPtr(), matrix.nonZeros());
  }
  cholmod_factorize(&view, factor_, common());
  return common_->status == CHOLMOD_OK && factor_->minor == factor_->n;
}

}  // namespace toile
