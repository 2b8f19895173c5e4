#pragma once
// Whether J and dF/dp are the derivatives of F: against central differences, entry by entry.

#include <arcslip/continuation/problem.hpp>

#include <string>

namespace arcslip::continuation {

/// The worst entry. row: of F; column: 0 .. n-1 of u, n and more of the parameters.
struct JacobianError {
  int row = -1, column = -1;
  double given = 0, difference = 0;
  double relative =
      0;  // |given - difference| over the largest entry of that column, and over F's own rounding
  std::string message;  // one sentence for people, empty where all entries agree
};

/// At (u, p), with steps in the scales of unknowns and parameters; 2 (n + parameters) evaluations of F.
/// Columns in which a difference crosses a kink (Evaluator::piece), or leaves the domain, are left out. The
/// differences themselves are good to about 1e-9 relative. Throws what the problem throws.
JacobianError check_jacobian(const Problem& problem, In u, In p);

/// To go on a message where Newton's method failed: "; " and what is wrong with the Jacobian. Empty where
/// nothing is, beyond 500 unknowns, and where F cannot be evaluated.
std::string doubt_of_jacobian(const Problem& problem, In u, In p);

}  // namespace arcslip::continuation
