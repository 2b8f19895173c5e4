#pragma once
// Reasons why a time integration stopped early.

#include <arcslip/results/reason.hpp>

namespace arcslip::time::reasons {

using results::Reason;
using results::reasons::user;

inline constexpr Reason no_convergence{
    "no_convergence", "Newton's method did not converge in a step: use more steps per period"};
inline constexpr Reason singular{"singular",
                                 "the equations of a step are singular: a degree of freedom without mass "
                                 "needs a spring or damper in addition to slipping elements"};
inline constexpr Reason not_finite{"not_finite", "the motion overflowed"};
inline constexpr Reason event_limit{
    "event_limit", "event-driven integration reached its limit of slip events or of pieces of the motion"};

// Models without an equation of motion, or without one motion to follow.
inline constexpr Reason set_valued{
    "set_valued", "friction without a stiffness has a force at rest that integration in time does not take"};
inline constexpr Reason loss_factor{"loss_factor",
                                    "damping by a loss factor has no equation of motion in time"};
inline constexpr Reason sector{"sector", "one sector of a ring has no equation of motion in time by itself"};
inline constexpr Reason several_places{
    "several_places",
    "the response is the largest of several places, and motions in time are followed at one"};

}  // namespace arcslip::time::reasons
