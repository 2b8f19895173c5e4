#pragma once
// Events of one response found again in another that differs little from it.

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>

#include <cmath>

namespace same_event {

inline arcslip::observables::ResponseBranch response(const arcslip::scene::Scene& s) {
  return arcslip::observables::frequency_response(s, scenes::window(s)).front();
}

/// The event of the same kind that is nearest, relative to its frequency and amplitude; null: none within 1
/// %.
inline const arcslip::observables::ResponsePoint* find(const arcslip::observables::ResponseEvent& of,
                                                       const arcslip::observables::ResponseBranch& branch) {
  const arcslip::observables::ResponsePoint* found = nullptr;
  double nearest = 0.01;
  for (const auto& event : branch.events) {
    const double distance =
        std::hypot(event.point.omega / of.point.omega - 1, event.point.amplitude / of.point.amplitude - 1);
    if (event.kind != of.kind || distance >= nearest) continue;
    nearest = distance;
    found = &event.point;
  }
  return found;
}

}  // namespace same_event
