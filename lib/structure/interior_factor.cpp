#include <arcslip/structure/interior_factor.hpp>

#include <arcslip/continuation/linear/lapack.hpp>

#include <algorithm>

namespace arcslip::structure {
namespace {

using Eigen::Index, Eigen::MatrixXd;

constexpr Index columns_at_once = 64;  // each takes memory of its own while it is solved for

void listen(const control::Control& control) {
  if (!control.keep_going()) throw control::Interrupted("interrupted while the structure was reduced");
}

}  // namespace

std::optional<Index> InteriorFactor::Cholesky::failed_at() const {
  if (m_cholmodFactor == nullptr || m_cholmodFactor->minor >= m_cholmodFactor->n) return {};
  return static_cast<const int*>(m_cholmodFactor->Perm)[m_cholmodFactor->minor];
}

bool InteriorFactor::factorize(const Sparse& A) {
  listen(control_);
  of_.cholmod().print = 0;
  // Minimum degree alone: METIS, which CHOLMOD also tries, takes SIGTERM for itself meanwhile.
  of_.cholmod().nmethods = 1;
  of_.cholmod().method[0].ordering = CHOLMOD_AMD;
  {
    const auto blas = continuation::lapack::use();
    of_.compute(A);
  }
  listen(control_);
  return of_.info() == Eigen::Success;
}

template <class Columns>
MatrixXd InteriorFactor::solve_some_at_once(const Columns& right) const {
  MatrixXd x(right.rows(), right.cols());
  for (Index from = 0; from < right.cols(); from += columns_at_once) {
    listen(control_);
    const Index count = std::min(columns_at_once, right.cols() - from);
    const auto blas = continuation::lapack::use();
    x.middleCols(from, count) = of_.solve(MatrixXd(right.middleCols(from, count)));
  }
  listen(control_);
  return x;
}

MatrixXd InteriorFactor::solve(const MatrixXd& right) const {
  return solve_some_at_once(right);
}

MatrixXd InteriorFactor::solve(const Sparse& right) const {
  return solve_some_at_once(right);
}

}  // namespace arcslip::structure
