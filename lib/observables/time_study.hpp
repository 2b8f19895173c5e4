#pragma once
// Studies in time: steady motions by shooting, and transients from rest.

#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/observables/motion.hpp>

#include <vector>

namespace arcslip::observables {

/// study.kind time: one motion for each combination of the study's for_each lists, at study.frequency_from,
/// as study.time says. Shooting of a piecewise linear scene in which the integration between events ends
/// early, as with more than a million pieces in a period, goes over to Newmark's steps. It begins at rest and
/// goes on from harmonic balance where that leads nowhere. A motion that ends early is kept, with its reason;
/// after a stop by the callback no further one is begun. Reasons: "periodic", "steady", "periods" (as many as
/// were asked for), "period_limit", "user", and of failures "unbounded", "no_periodic_motion",
/// "no_convergence", "singular", "not_finite", "not_piecewise_linear", "massless", "event_limit".
std::vector<Motion> motions_in_time(const scene::Scene& scene, const scene::Study& study,
                                    const ProgressCallback& progress = {});

}  // namespace arcslip::observables
