#pragma once
// The place of an event, for the coefficients of its normal form. Not installed.

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/normal_forms/directional_derivatives.hpp>

namespace arcslip::continuation {

/// Scales of 1 where there is no problem.
inline PlaceOfForms place_of_event(const Accepted& now) {
  const Eigen::Index n = now.u.size();
  PlaceOfForms place{now.u, now.p, now.free, Vector::Ones(n + 1)};
  place.p[now.free] = now.parameter;
  if (!now.problem) return place;
  place.scales << now.problem->scales(),
      now.problem->parameters()[static_cast<std::size_t>(now.free)].change();
  return place;
}

}  // namespace arcslip::continuation
