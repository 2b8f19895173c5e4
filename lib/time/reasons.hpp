#pragma once
// Why an integration in time ended before its end.

#include <arcslip/results/reason.hpp>

namespace arcslip::time::reasons {

using results::Reason;
using results::reasons::user;

inline constexpr Reason no_convergence{
    "no_convergence", "Newton's method found no balance of forces in a step: take more steps per period"};
inline constexpr Reason singular{"singular",
                                 "nothing holds the structure in a step: a degree of freedom without mass "
                                 "needs a spring or damper besides elements that slip"};
inline constexpr Reason not_finite{"not_finite", "the motion grew beyond all numbers"};
inline constexpr Reason event_limit{
    "event_limit",
    "more slips begin and end, or the motion has more pieces, than the integration between events allows"};

}  // namespace arcslip::time::reasons
