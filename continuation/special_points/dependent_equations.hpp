#pragma once
// Equations that depend on each other: combinations of them that hold for all u, as where the rates of a
// conserved sum add up to zero. J has a rank of n - k everywhere then, and the solutions form sets of k
// dimensions more than a branch. Not installed.

#include <arcslip/continuation/problem/problem.hpp>

#include <optional>
#include <string>

namespace arcslip::continuation {

/// Combinations L F = 0 of the equations at generic places around v = (u, p), k x n in echelon form. Nothing
/// if F cannot be evaluated there, or of more than 100 equations.
std::optional<Matrix> dependent_combinations(const Problem& problem, const Vector& v, const Vector& p,
                                             int along);

/// The sum of terms of a combination, as "F[0] + 2 F[3]" of `name` F. Empty if it has more than 8.
std::string words_of_sum(const Eigen::Ref<const Vector>& l, const char* name);

/// A sentence that names the combinations that vanish at generic points around v = (u, p). Empty if there are
/// none, or if F cannot be evaluated there.
std::string doubt_of_dependence(const Problem& problem, const Vector& v, const Vector& p, int along);

/// A sentence if [J F_p] has a rank below n at v: at a branch point no tangent reports the branches apart.
std::string doubt_of_branch_point(const Problem& problem, const Vector& v, const Vector& p, int along);

}  // namespace arcslip::continuation
