#pragma once
// All sign changes of a polynomial on [0, 1], found rigorously: g(s) = sum_k c_k s^k, coefficients ascending.
//
// With M = sum k (k - 1) |c_k| b^(k-2) >= |g''| on [a, b], an interval of length h is decided as in
// fourier/reversals.hpp: no change where both ends lie at least M h^2/8 from zero on the same side; one
// where they differ in sign and g is monotone, |g'| > M h/2 in the middle; else it is halved. What is left
// out are pairs of changes between which |g| is below rounding, eps sum |c_k| b^k.

#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace arcslip::time {

using Coefficients = std::span<const double>;

/// Of a sum of size 1 after all the operations behind it: for first_fall().
inline constexpr double sum_rounding = 64 * std::numeric_limits<double>::epsilon();

/// g(s).
double value(Coefficients c, double s);

/// All s in (0, 1] where g changes its sign, ascending, to the last digit. `found` is overwritten.
void sign_changes(Coefficients c, std::vector<double>& found);

/// The first s in [0, 1] beyond which g < 0, for a g that is not negative before. Coefficients up to
/// `rounding` count as zero at the start of the series, so that a g which begins at zero is judged by where
/// it goes: s = 0 where its first coefficient above rounding is negative.
std::optional<double> first_fall(Coefficients c, double rounding);

}  // namespace arcslip::time
