#pragma once
// Bifurcations of periodic motions as zeros of functions of their multipliers, for curves in two parameters
// (continuation/special_points/test_functions.hpp). mu: the multipliers of the map over the period, or, where
// the motion is antisymmetric, lambda of the map over half a period and the reflection:
//
//   period_doubling     mu = -1       g = s |1 + mu_1| |1 + mu_2|, at_minus_one() of
//   stability/multipliers.hpp symmetry_breaking   lambda = -1   the same with lambda neimark_sacker      mu =
//   exp(+- i phi)       g_1 = mu_1 + mu_2 - 2 kappa,  g_2 = mu_1 mu_2 - 1
//
// kappa = cos phi is an unknown, which distinguishes the pairs: mu_1 and mu_2 are
// the pair nearest to those with this kappa. Their sum and product are smooth also where the two meet and
// become real, kappa = 1 and -1, beyond which there is no Neimark-Sacker point.
//
// Where mu_1 and mu_2 are exp(+- 2 pi i/q), the resonance 1:q is strong for q = 1, 2, 3, 4.

#include <arcslip/continuation/special_points/test_functions.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/stability/stability.hpp>

#include <memory>
#include <optional>
#include <string>

namespace arcslip::observables {

/// The sum and the product of the pair nearest to exp(+- i arccos(kappa)); of real ones for |kappa| > 1.
/// Nothing without a pair.
struct PairOfMultipliers {
  double sum, product;
};
std::optional<PairOfMultipliers> pair_near(const Multipliers& multipliers, double kappa);

/// Of the complex pair nearest to the unit circle: its cosine. Nothing without one.
std::optional<double> kappa_of(const Multipliers& multipliers);

/// The test functions of a kind of bifurcation, or of phase resonance (results/event_kinds.hpp), for
/// solutions of a problem.
continuation::TestFunctions test_functions(const std::shared_ptr<const hbm::HbmProblem>& problem,
                                           const std::string& kind);

/// At a point of a curve: `unstable` without the multipliers of the bifurcation itself, which are on the
/// circle up to rounding, and its rotation number. half: whether kappa, of Neimark-Sacker points, is of half
/// a period.
void set_apart(const std::string& kind, bool half, double kappa, Stability& stability);

}  // namespace arcslip::observables
