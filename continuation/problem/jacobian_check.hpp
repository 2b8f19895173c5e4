#pragma once
// Whether J and dF/dp are the derivatives of F: against central differences, entry by entry.

#include <arcslip/continuation/problem/problem.hpp>

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

constexpr double largest_jacobian_error = 1e-5;  // of a row, that doubt_jacobian() lets pass

/// An entry that is certainly wrong, of J or of dF/dp of the parameter `free`: by differences along two
/// directions, which cost one J and 4 residuals where all is right, and 2 log2(n) more to find the entry. An
/// error is seen where it makes 1e-5 of what its row gives along the directions, and is told from noise in F,
/// from kinks and from what is too curved for differences. `message` is empty where nothing is wrong, or
/// nothing is certain. Throws nothing that the problem throws.
JacobianError doubt_jacobian(const Problem& problem, In u, In p, int free);

/// The sentence for people.
std::string describe(const JacobianError& worst, const Problem& problem);

}  // namespace arcslip::continuation
