#pragma once
// A periodic response at given parameters, from nothing.

#include <arcslip/hbm/problem.hpp>

#include <functional>
#include <optional>

namespace arcslip::hbm {

/// The response of the structure without its elements, Z^-1 f, at the parameters p (with force_factor 1). Not
/// finite at an undamped resonance.
Vector linear_response(const HbmProblem& problem, const Vector& p);

/// Newton's method from a guess. Empty where it fails.
std::optional<Vector> response_near(const HbmProblem& problem, const Vector& p, const Vector& guess);

/// Newton's method from rest (all sliders stuck), from the response without elements, and, where neither
/// converges, a branch in the excitation factor from rest at 0 to 1 or -1, where the response is that of 1
/// reversed. Empty where that fails too, or go_on, asked along that branch, says false.
std::optional<Vector> steady_state(const std::shared_ptr<const HbmProblem>& problem, const Vector& p,
                                   const std::function<bool()>& go_on = {});

}  // namespace arcslip::hbm
