#pragma once
// Check of J and dF/dp against central differences of F, entry by entry.

#include <arcslip/continuation/problem/problem.hpp>

#include <string>

namespace arcslip::continuation {

/// The entry with the largest error. row: of F; column: 0 .. n-1 for u, n and above for the parameters.
struct JacobianError {
  int row = -1, column = -1;
  double given = 0, difference = 0;
  double relative = 0;          // |given - difference| over the largest entry of the column and F's rounding
  bool by_differences = false;  // the entry is itself a default difference (Evaluator::by_differences)
  std::string message;          // one sentence for the user, empty if all entries agree
};

/// Checks all entries at (u, p), with steps in the scales of unknowns and parameters and 2 (n + parameters)
/// evaluations of F. Columns whose difference crosses a kink (Evaluator::piece) or leaves the domain are
/// skipped. The differences are accurate to about 1e-9 relative. Exceptions of the problem are passed on.
JacobianError check_jacobian(const Problem& problem, In u, In p);

constexpr double largest_jacobian_error = 1e-5;  // of a row, tolerance of doubt_jacobian()

/// Finds an entry of J, or of dF/dp of the parameter `free`, that is certainly wrong, by differences along
/// two directions: one J and 4 residuals if all is right, and 2 log2(n) more residuals to find the entry. An
/// error is detected if it exceeds 1e-5 of the row's product with the directions, and is distinguished from
/// noise and rounding in F, kinks and strong curvature. `message` is empty if no error is certain. Exceptions
/// of the problem are caught.
JacobianError doubt_jacobian(const Problem& problem, In u, In p, int free);

/// The sentence for the user: an entry that is given is wrong; of a default difference, what makes it so.
std::string describe(const JacobianError& worst, const Problem& problem);

}  // namespace arcslip::continuation
