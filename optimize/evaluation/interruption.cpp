#include <arcslip/optimize/evaluation/interruption.hpp>

#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/optimize/evaluation/reasons.hpp>

namespace arcslip::optimize {

observables::Stop interruption(const control::Control& control, const char* phase) {
  using continuation::text;
  const control::Ending ending = control.ending();
  if (ending.reason == control::EndReason::deadline)
    return {reasons::time_limit, ending.seconds, ending.limit,
            text("the limit of ", ending.limit, " s was reached at ", ending.seconds, " s in ", phase)};
  if (ending.reason == control::EndReason::user) return {reasons::user, 0, 0, text("interrupted in ", phase)};
  return {};
}

}  // namespace arcslip::optimize
