#pragma once
// The sparse factorization of A_ii = K_ii + sigma M_ii.

#include <arcslip/control/run_control.hpp>
#include <arcslip/structure/blocks.hpp>

#include <Eigen/CholmodSupport>
#include <Eigen/Core>

#include <optional>

namespace arcslip::structure {

class InteriorFactor {
 public:
  explicit InteriorFactor(const control::Control& control) : control_(control) {}

  /// False: A is not positive definite. Throws control::Interrupted, as solve() does.
  bool factorize(const Sparse& A);
  /// The column where it failed, in the order of the matrix.
  std::optional<Eigen::Index> failed_at() const { return of_.failed_at(); }
  /// A^-1 times the columns.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;
  Eigen::MatrixXd solve(const Sparse& right) const;

 private:
  class Cholesky : public Eigen::CholmodSupernodalLLT<Sparse> {
   public:
    std::optional<Eigen::Index> failed_at() const;
  };

  template <class Columns>
  Eigen::MatrixXd solve_some_at_once(const Columns& right) const;

  const control::Control& control_;
  Cholesky of_;
};

}  // namespace arcslip::structure
