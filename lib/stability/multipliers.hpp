#pragma once
// What Floquet multipliers tell: how many lie outside the unit circle, and functions of all of them that
// vanish where one is -1, or where a complex pair is on the circle,
//
//   at_minus_one     s |1 + mu_1| |1 + mu_2|      s: sign of prod (1 + mu_i)
//   at_unit_modulus  s |1 - mu_i mu_j|            s: sign of prod_{i < j} (1 - mu_i mu_j)
//
// with the factors nearest to 0 alone: the products of all of them vanish or overflow in structures with many
// modes. Both are continuous, and simple at their zeros. The first has two factors, as a complex pair meets
// at -1; it is smooth where a second one passes -1. The factors of the second come in pairs of conjugates,
// which do not change the sign, but for those of a conjugate pair, 1 - |mu|^2, and of two real multipliers.
// Where such two have the product 1 there is no pair on the circle.

#include <array>
#include <complex>
#include <vector>

namespace arcslip::observables {

using Multipliers = std::vector<std::complex<double>>;

/// Of functions of multipliers, such as 1 - |mu|^2, where the structure is undamped.
inline constexpr double multiplier_rounding = 1e-11;

/// How many lie outside the unit circle, by more than rounding.
int count_unstable(const Multipliers& multipliers);

/// The largest distance of one of the multipliers from the nearest of the others.
double distance(const Multipliers& multipliers, const Multipliers& others);

/// The two multipliers nearest to a value, the nearest first; of no others the value itself, plus 1.
std::array<std::complex<double>, 2> nearest_two(const Multipliers& multipliers, std::complex<double> value);

/// Positive for multipliers within the unit circle.
double at_minus_one(const Multipliers& multipliers);

/// Positive for multipliers within the unit circle, and on it up to rounding; at most 1.
double at_unit_modulus(const Multipliers& multipliers);

/// Of the complex pair nearest to the unit circle, the one above the real axis. 0: there is none.
std::complex<double> pair_nearest_circle(const Multipliers& multipliers);

/// Of that pair: its argument over 2 pi, in (0, 1/2). no_value: none.
double rotation_number(const Multipliers& multipliers);

/// The others, without those nearest to the values.
Multipliers without(Multipliers multipliers, const Multipliers& values);

}  // namespace arcslip::observables
