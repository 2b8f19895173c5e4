#pragma once
// Conserved sums of u' = F(u, p): combinations L u of the unknowns with L F = 0 for all u, as of reactions in
// a closed vessel. J has the left null vectors L everywhere, and equilibria are not isolated but for the
// values of the sums.
//
//   const ConservedSums sums = conserved_sums(*reactions, u0, p0);       // sums.words: "u[0] + 2 u[3]"
//   const auto closed = with_conserved_sums(reactions, sums, u0);        // a new parameter for each sum
//
// takes L (u - u_0) = c in the place of one of the equations of each sum, with c a further parameter, 0 by
// default, which may be free as any other.

#include <arcslip/continuation/problem/problem.hpp>

#include <memory>
#include <string>
#include <vector>

namespace arcslip::continuation {

struct ConservedSums {
  Matrix L;  // k x n, in echelon form: each sum has an unknown with the coefficient 1 that no
             // other one has
  std::vector<Eigen::Index> rows;  // k: the equation that each takes the place of
  std::vector<std::string> words;  // k: "u[0] + 2 u[3]"; empty for one of more than 8 terms
};

/// The sums that are conserved around (u, p): found where F vanishes in combinations at n + 3 generic places,
/// and confirmed as left null vectors of J at three more. None for more than 100 unknowns, or where F cannot
/// be evaluated. along: index of a parameter that is moved as well. Throws std::invalid_argument for sizes
/// that do not fit.
ConservedSums conserved_sums(const Problem& problem, const Vector& u, const Vector& p, int along = 0);

/// The problem with these sums for equations: that of row rows[k] becomes L_k (u - u_0) = c_k. The parameters
/// c follow those of the problem, by names[k], or "sum_1", "sum_2", .. without names. Throws
/// std::invalid_argument for sizes that do not fit, two sums in one row, or a matrix-free Jacobian, which has
/// no rows.
std::shared_ptr<const Problem> with_conserved_sums(std::shared_ptr<const Problem> problem, ConservedSums sums,
                                                   const Vector& u0, std::vector<std::string> names = {});

}  // namespace arcslip::continuation
