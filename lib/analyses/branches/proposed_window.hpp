#pragma once
// A window of frequencies around the first resonance.

#include <arcslip/control/run_control.hpp>
#include <arcslip/scene/scene.hpp>

#include <optional>
#include <string>
#include <vector>

namespace arcslip::observables {

/// The range of the values that a parameter takes.
struct ValuesTaken {
  std::string parameter;
  double lower, upper;
};

/// In the scene's unit. reason: what lies between its ends, and the margins, for people.
struct ProposedWindow {
  double lower, upper;
  std::string reason;
};

/// The window from the first resonance with all contacts free to that with all contacts stuck, over the
/// ranges, and beyond both by the share
///
///   max(3 zeta, 3 kappa/(2 pi), 0.05), at most 0.5,   kappa = (omega_stuck/omega_free)^2 - 1
///
/// zeta is the damping ratio of these modes, and kappa/(2 pi) the largest that sliders may add: a slider of
/// stiffness kappa k on a spring k dissipates at most kappa k A^2 a period, where its slip limit is kappa k
/// A/2. At a distance of 3 zeta a resonance has fallen to a third. Springs that stiffen move the upper end to
/// where the response, at the largest amplitude that the damping leaves, would be in resonance with the
/// stiffness that they have there. Natural frequencies grow with stiffnesses and fall with masses (Rayleigh),
/// so that of each range an end counts. Nothing where no resonance is known. Throws Interrupted.
std::optional<ProposedWindow> proposed_window(const scene::Scene& scene,
                                              const std::vector<ValuesTaken>& ranges,
                                              const control::Control& control = {});

}  // namespace arcslip::observables
